"""What the witnesses share: where the programs and the others' files are, rendering, comparing."""

import json
import os
import pathlib
import subprocess
import sys

import pictures

CPU = ("--device", "cpu")


class Programs:
    """Arguments of a script: the source tree, sahl, sahl_reference_pictures. They are taken from argv."""

    def __init__(self):
        self.root, self.sahl, self.pictures = (pathlib.Path(sys.argv.pop(1)) for _ in range(3))
        self.assets = pathlib.Path(os.environ.get("SAHL_ASSETS") or self.root / "../shared/assets").resolve()

    def references(self, *names):
        return self.assets.joinpath("references", *names)


def render(programs, scene, folder, name="scene", device=CPU, options=()):
    """Renders a scene file's content; returns the path of the EXR file."""
    file, picture = folder / f"{name}.json", folder / f"{name}.exr"
    file.write_text(json.dumps(scene), encoding="utf-8")
    done = subprocess.run([programs.sahl, "render", file, "-o", picture, "--allow-path", programs.assets, "-q",
                           *device, *options], stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"sahl render: exit code {done.returncode}: {done.stderr}")
    return picture


def compare(programs, ours, theirs, folder, level=0.01):
    """What sahl compare finds about two pictures in memory that know their noise; as its JSON says it.
      level  the chance that equal scenes are called different"""
    files = [folder / f"{side}.exr" for side in ("ours", "theirs")]
    for file, picture in zip(files, (ours, theirs)):
        pictures.write(programs.pictures, file, picture)
    done = subprocess.run([programs.sahl, "compare", *files, "--json", "--level", str(level)], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode > 2:
        raise RuntimeError(f"sahl compare: exit code {done.returncode}: {done.stderr}")
    return json.loads(done.stdout)
