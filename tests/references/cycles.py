"""Scenes of Sahl rendered by Cycles, in Blender: lambert surfaces, flat triangles, one probe or radiance all
around. A scene becomes plain triangles here; cycles_in_blender.py, which Blender runs, makes its own of them."""

import array
import json
import os
import pathlib
import shutil
import subprocess

import pictures
import transforms as tr
from mitsuba_xml import Unsupported

RUNS = 4  # with different seeds: their spread is the variance that Cycles does not tell


def blender():
    """The program, or None."""
    return shutil.which(os.environ.get("BLENDER", "blender"))


def render(programs, scene, folder, samples):
    """The mean of RUNS pictures of `samples` each, with the variance of that mean by their spread."""
    plain = folder / "cycles.json"
    plain.write_text(json.dumps(plain_scene(scene, folder)), encoding="utf-8")
    script = pathlib.Path(__file__).with_name("cycles_in_blender.py")
    files = [folder / f"cycles-{seed}.exr" for seed in range(RUNS)]
    done = subprocess.run([blender(), "--background", "--factory-startup", "-noaudio", "--python-exit-code", "3",
                           "--python", script, "--", plain, str(samples), *files], stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.STDOUT, check=False,
                          env={**os.environ, "PATH": os.defpath})  # Blender's Python is that of the system
    if done.returncode != 0:
        raise RuntimeError(f"blender: exit code {done.returncode}: {done.stdout[-2000:]}")
    runs = [pictures.read(programs.pictures, file)[0] for file in files]
    return mean_of(runs, samples)


def mean_of(runs, samples):
    count = len(runs)
    rgb = array.array("f", (sum(values) / count for values in zip(*(run.rgb for run in runs))))
    mean = pictures.Picture(runs[0].width, runs[0].height, rgb)
    variances = (sum((value - middle) ** 2 for value in values) / (count - 1) / count for middle, *values in
                 zip(mean.luminances(), *(run.luminances() for run in runs)))
    mean.variance = array.array("f", variances)
    mean.samples = array.array("f", [samples * count]) * (mean.width * mean.height)
    return mean


def plain_scene(scene, folder):
    camera, film, around = scene["camera"], scene["film"], scene["environment"]
    if around.get("rotateDeg") or around.get("filter", "bilinear") != "bilinear":
        raise Unsupported("a probe that is turned or not filtered")
    plain = {"eye": camera["eye"], "lookAt": camera["lookAt"], "up": camera.get("up", [0, 1, 0]),
             "fovDeg": camera["fovDeg"], "vertical": camera.get("fovAxis", "vertical") == "vertical",
             "width": film["width"], "height": film["height"], "bounces": scene["integrator"]["maxBounces"],
             "radiance": around.get("radiance"), "scale": around.get("scale", 1), "objects": []}
    if "file" in around:
        plain["probe"] = str(folder / around["file"])
    for shape in scene["shapes"]:
        positions, polygons = triangles(shape)
        material = scene["materials"][shape["material"]]
        if material["type"] != "lambert":
            raise Unsupported(f"the material {material['type']}")
        plain["objects"].append({"positions": positions, "triangles": polygons,
                                 "color": material.get("baseColor", [0.7] * 3),
                                 "emission": material.get("emission", [0, 0, 0])})
    return plain


def triangles(shape):
    """Positions in the world, and triples of them."""
    if shape["type"] == "rectangle":
        corner, u, v = shape["corner"], shape["edgeU"], shape["edgeV"]
        both = tr.plus(u, v)
        return [corner, tr.plus(corner, u), tr.plus(corner, both), tr.plus(corner, v)], [[0, 1, 2], [0, 2, 3]]
    if shape["type"] != "mesh" or set(shape.get("transform", {})) - {"scale", "translate"}:
        raise Unsupported(f"the shape {shape['type']}, or how it is placed")
    positions, polygons = obj(shape["file"])
    place = shape.get("transform", {})
    factor, move = place.get("scale", 1), place.get("translate", [0, 0, 0])
    return [tr.plus(tr.scaled(p, factor), move) for p in positions], polygons


def obj(path):
    """Positions of a Wavefront file, and its polygons as fans."""
    positions, polygons = [], []
    with open(path, encoding="ascii", errors="replace") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                positions.append([float(word) for word in words[1:4]])
            elif words and words[0] == "f":
                corners = [int(word.split("/")[0]) for word in words[1:]]
                corners = [corner - 1 if corner > 0 else len(positions) + corner for corner in corners]
                polygons += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
    return positions, polygons
