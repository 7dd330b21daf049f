#!/usr/bin/env python3
"""Sahl against Cycles: bunny and Sponza under one radiance all around and under a probe, Cornell's box.
Arguments: the source tree, sahl, sahl_reference_pictures, the device, then those of unittest."""

import pathlib
import sys
import tempfile
import unittest

import cycles
import pictures
import tungsten_scene
import witness

PROGRAMS = witness.Programs()
DEVICE = ("--device", sys.argv.pop(1))
FRAME = 0.005  # largest difference of the frame's mean, relative to it
SURE = FRAME / 3  # largest standard error at which that can be told
SIZE = 192
BOUNCES = 5

WHITE = {"radiance": [1, 1, 1]}
PROBE = {"file": ("probes", "latlong", "uffizi.hdr")}


def mesh_scene(mesh, camera, ground, around):
    """A mesh of $SAHL_ASSETS, grey and flat, on a square of ground where it needs one."""
    shapes = [{"type": "mesh", "file": str(PROGRAMS.assets.joinpath("meshes", "miro", mesh)), "material": "grey"}]
    if ground is not None:
        shapes.append({"type": "rectangle", "corner": [-8, ground, -8], "edgeU": [0, 0, 16],
                       "edgeV": [16, 0, 0], "material": "grey"})
    return {"camera": camera, "film": {"width": SIZE, "height": SIZE}, "shapes": shapes,
            "integrator": {"maxBounces": BOUNCES, "normals": "flat"}, "environment": around,
            "materials": {"grey": {"type": "lambert", "baseColor": [0.7, 0.7, 0.7]}}}


def bunny(around):
    camera = {"eye": [1.2, 2.6, 5.5], "lookAt": [-0.25, 1.5, 0], "fovDeg": 35}
    return mesh_scene("bunny.obj", camera, 0.494, around)


def sponza(around):
    return mesh_scene("sponza.obj", {"eye": [-9.5, 3, 0], "lookAt": [0, 3.6, 0], "fovDeg": 65}, None, around)


class Cycles(unittest.TestCase):
    def setUp(self):
        if cycles.blender() is None:
            self.skipTest("missing: Blender (apt-get install blender, or set BLENDER to the program)")
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def require(self, *names):
        if not PROGRAMS.assets.joinpath(*names).exists():
            self.skipTest(f"missing: {'/'.join(names)} (set SAHL_ASSETS)")

    def around(self, light):
        """The light with its file where Sahl and Blender find it."""
        if "file" not in light:
            return light
        self.require(*light["file"])
        return {"file": str(PROGRAMS.assets.joinpath(*light["file"]))}

    def agree(self, name, scene, samples, theirs):
        """The frame's mean within FRAME; blocks are shown but not judged, as their variance is guessed from
        four pictures."""
        scene["integrator"]["samplesPerPixel"] = samples
        file = witness.render(PROGRAMS, scene, self.folder, device=DEVICE)
        ours = pictures.read_rendered(PROGRAMS.pictures, file)
        other = cycles.render(PROGRAMS, scene, self.folder, theirs)
        found = witness.compare(PROGRAMS, ours, other, self.folder)
        difference, error = (found["statistics"]["frame"][key] / found["statistics"]["meanB"]
                             for key in ("difference", "standardError"))
        print(f"| {name} | {100 * difference:+.3f} | {100 * error:.3f} | "
              f"{len(found['statistics']['differingBlocks'])} of {found['statistics']['testedBlocks']} | {samples} | "
              f"relMSE {found['metrics']['relMse']['all']:.2g}", flush=True)
        self.assertLess(error, SURE, "too few samples to tell")
        self.assertLessEqual(abs(difference), FRAME)

    def test_bunny_under_one_radiance(self):
        self.require("meshes", "miro", "bunny.obj")
        self.agree("bunny, white all around", bunny(WHITE), 64, 32)

    def test_bunny_under_a_probe(self):
        self.require("meshes", "miro", "bunny.obj")
        self.agree("bunny, uffizi", bunny(self.around(PROBE)), 64, 64)

    def test_sponza_under_one_radiance(self):
        self.require("meshes", "miro", "sponza.obj")
        self.agree("Sponza, white all around", sponza(WHITE), 256, 64)

    def test_sponza_under_a_probe(self):
        self.require("meshes", "miro", "sponza.obj")
        self.agree("Sponza, uffizi", sponza(self.around(PROBE)), 256, 64)

    def test_cornell_box(self):
        self.require("references", "bitterli", "cornell-box", "scene.json")
        scene = tungsten_scene.read(PROGRAMS.references("bitterli", "cornell-box", "scene.json"))
        scene["film"] = {"width": 250, "height": 141}
        scene["integrator"]["maxBounces"] = 9
        scene["environment"] = {"radiance": [0, 0, 0]}
        self.agree("Cornell box (Tungsten's scene)", scene, 4096, 128)


if __name__ == "__main__":
    unittest.main()
