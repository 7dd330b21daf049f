"""Runs the steps of a figure: finds meshes, writes scenes that use them, starts `sahl`."""

import json
import os
import pathlib
import subprocess
import time
from dataclasses import dataclass, field

FETCHED = "../../../.assets/meshes/"  # how scenes in scenes/report name fetched meshes
QUICK_SIZE, QUICK_SPP = 40, 2


@dataclass
class StepResult:
    """How a step went. `error` and `skipped` say why there are no files; at most one is set."""
    name: str
    command: str = ""
    seconds: float = 0.0
    stats: dict = field(default_factory=dict)
    error: str = ""
    skipped: str = ""


@dataclass
class Setting:
    """Where things are and what the user wants."""
    root: pathlib.Path
    sahl: pathlib.Path
    out: pathlib.Path
    device: str
    quick: bool
    assets: pathlib.Path | None  # the report's own meshes

    @property
    def fetched(self):
        return self.root / ".assets"


class MissingMesh(Exception):
    pass


def own_mesh(setting, name):
    """The report's own mesh, or None."""
    if setting.assets is None:
        return None
    path = setting.assets / "meshes" / "miro" / f"{name}.obj"
    return path if path.is_file() else None


def fitted_shape(setting, shape, use_own_teapot, allowed):
    """`shape` with the best mesh that is at hand. Adds folders that it lies in to `allowed`."""
    if shape["type"] == "teapot" and use_own_teapot and own_mesh(setting, "teapot"):
        path = own_mesh(setting, "teapot")
        transform = {key: value for key, value in shape.get("transform", {}).items() if key != "scale"}
        allowed.add(path.parent)
        return {"type": "mesh", "name": shape["name"], "file": str(path), "material": shape["material"],
                "smoothNormals": True, "transform": transform}
    if shape["type"] == "mesh" and shape["file"].startswith(FETCHED):
        file = shape["file"][len(FETCHED):]
        path = own_mesh(setting, pathlib.Path(file).stem)
        if path is None and not (setting.fetched / "meshes" / file).is_file():
            hint = ("it cannot be fetched; a folder named by SAHL_ASSETS may have it as meshes/miro/sponza.obj"
                    if file == "sponza.obj" else "tools/fetch_assets fetches it")
            raise MissingMesh(f"The mesh {file} is not here: {hint}.")
        if path is not None:
            allowed.add(path.parent)
            return {**shape, "file": str(path)}
        allowed.add(setting.fetched)
    return shape


def fitted_scene(setting, step, folder, use_own_teapot):
    """The scene file to render and the folders it reads from: the step's own, or a copy with other meshes."""
    path = setting.root / "scenes" / "report" / step.scene
    scene = json.loads(path.read_text())
    allowed = set()
    lists = [scene] + list(scene.get("groups", {}).values())
    before = json.dumps(scene)
    for shapes in lists:
        shapes["shapes"] = [fitted_shape(setting, shape, use_own_teapot, allowed)
                            for shape in shapes["shapes"]]
    if json.dumps(scene) != before:
        scene.pop("$schema", None)
        path = folder / f"{path.stem}.json"
        path.write_text(json.dumps(scene, indent=1) + "\n")
    return path, sorted(allowed)


def arguments_of(setting, step, folder, use_own_teapot):
    """The command line of a step, as a list."""
    args = [word.replace("@", f"{folder}{os.sep}") for word in step.args]
    line = [str(setting.sahl), step.command]
    if step.command == "render":
        scene, allowed = fitted_scene(setting, step, folder, use_own_teapot)
        line.append(str(scene))
        for directory in allowed:
            line += ["--allow-path", str(directory)]
        spp = min(step.spp or QUICK_SPP, QUICK_SPP) if setting.quick else step.spp
        if spp and "--max-spp" not in step.quick:  # adaptive sampling has bounds of its own
            line += ["--spp", str(spp)]
        if setting.quick:
            line += ["--width", str(QUICK_SIZE), "--height", str(QUICK_SIZE)]
    line += args
    if setting.quick:
        line += step.quick
    if step.command == "bench" and setting.assets is not None:
        line += ["--assets", str(setting.assets)]
    if step.command != "tonemap":
        line += ["--device", setting.device]
    if step.command == "render":
        line += ["--stats", str(folder / f"{step.name}.json.stats")]
    return line


def shown(setting, line):
    """A command line as the page shows it: from the source tree, without statistics."""
    words, skip = [], False
    for word in line:
        if skip or word == "--stats":
            skip = word == "--stats"
            continue
        for path, name in ((setting.assets, "$SAHL_ASSETS"), (setting.root, ".")):
            if path is not None:
                word = word.replace(str(path), name)
        words.append(word[2:] if word.startswith("./") else word.replace("=./", "="))
    words[0] = "sahl"
    return " ".join(words)


def run_step(setting, step, folder, use_own_teapot):
    result = StepResult(step.name)
    try:
        line = arguments_of(setting, step, folder, use_own_teapot)
    except MissingMesh as missing:
        result.skipped = str(missing)
        return result
    result.command = shown(setting, line)
    started = time.monotonic()
    try:
        done = subprocess.run(line, cwd=setting.root, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, errors="replace", check=False)
    except OSError as error:
        result.error = f"cannot run {line[0]}: {error.strerror}"
        return result
    result.seconds = time.monotonic() - started
    if done.returncode != 0:
        words = "\n".join(done.stderr.strip().splitlines()[-6:])
        result.error = f"exit code {done.returncode}: {words}" if words else f"exit code {done.returncode}"
        return result
    for path in (folder / f"{step.name}.json.stats", folder / "bench.json"):
        if path.is_file() and (step.command == "render") == (path.suffix == ".stats"):
            result.stats = json.loads(path.read_text())
    return result


def run_figure(setting, figure, say):
    """Runs all steps of a figure and returns how they went; later steps of a failed figure still run."""
    folder = setting.out / f"fig{figure.number:02d}"
    folder.mkdir(parents=True, exist_ok=True)
    results = []
    for step in figure.steps:
        for word in step.args:  # what an earlier run left must not pass for this one's
            if "@" in word and word != "@film.exr":
                (folder / word.split("@", 1)[1]).unlink(missing_ok=True)
        result = run_step(setting, step, folder, figure.fitted_teapot)
        results.append(result)
        how = "failed" if result.error else "skipped" if result.skipped else f"{result.seconds:.1f} s"
        say(f"figure {figure.number}, {step.name}: {how}")
        if result.error:
            say(f"  {result.error}")
    return results
