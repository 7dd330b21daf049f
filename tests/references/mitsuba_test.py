#!/usr/bin/env python3
"""Mitsuba's regression scenes against the mean and variance pictures that they come with.
Arguments: the source tree, sahl, sahl_reference_pictures, the device, then those of unittest."""

import array
import pathlib
import sys
import tempfile
import unittest

import mitsuba_scene
import pictures
import witness

PROGRAMS = witness.Programs()
DEVICE = ("--device", sys.argv.pop(1))
FOLDER = ("mitsuba", "tests", "scenes")
REFERENCE_SAMPLES = 32000  # a pixel, of all reference pictures
FRAME = 0.003  # largest difference of the frame's mean, relative to it
SURE = 0.001   # largest standard error at which that can be told


def reference(name):
    """A mean picture with the variance of its luminance. Both pictures were converted from XYZ to RGB, the
    variances as well: the luminance of the variance picture is the variance of the luminance. (And so red,
    green and blue are off by up to 0.1 %, but the luminance is not.)"""
    mean, _ = pictures.read(PROGRAMS.pictures, PROGRAMS.references(*FOLDER, name + "_ref_rgb.exr"))
    spread, _ = pictures.read(PROGRAMS.pictures, PROGRAMS.references(*FOLDER, name + "_ref_rgb_var.exr"))
    mean.variance = array.array("f", (max(0, value) / REFERENCE_SAMPLES for value in spread.luminances()))
    mean.samples = array.array("f", [REFERENCE_SAMPLES]) * len(mean.variance)
    return mean


class Mitsuba(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def require(self, scene):
        path = PROGRAMS.references(*FOLDER, scene)
        if not path.exists():
            self.skipTest(f"missing: references/mitsuba/tests/scenes/{scene} (set SAHL_ASSETS)")
        return path

    def rendered(self, scene, samples):
        scene["integrator"]["samplesPerPixel"] = samples
        return pictures.read_rendered(PROGRAMS.pictures,
                                      witness.render(PROGRAMS, scene, self.folder, device=DEVICE))

    def agree(self, name, ours, theirs, samples):
        """The frame's mean within FRAME, the frame and no block further off than noise explains."""
        found = witness.compare(PROGRAMS, ours, theirs, self.folder)["statistics"]
        difference, error = (found["frame"][key] / found["meanB"] for key in ("difference", "standardError"))
        print(f"| {name} | {100 * difference:+.3f} | {100 * error:.3f} | "
              f"{len(found['differingBlocks'])} of {found['testedBlocks']} | {samples} |", flush=True)
        self.assertLess(error, SURE, "too few samples to tell")
        self.assertLessEqual(abs(difference), FRAME)
        self.assertFalse(found["frameDiffers"], found["frame"])
        self.assertEqual(found["differingBlocks"], [])

    def check(self, scene, name, samples):
        """A whole picture."""
        reader = mitsuba_scene.Reader(PROGRAMS, self.require(scene), self.folder)
        self.agree(name, self.rendered(reader.scene, samples), reference(name), samples)

    def test_three_mirrors_in_a_museum(self):
        self.check("infinite_mirrors/scene_path.xml", "infinite_mirrors/refs/scene", 16384)

    def test_board_seen_by_an_orthographic_camera(self):
        self.check("orthographic_sensor/test_orthographic_path.xml", "orthographic_sensor/refs/test_orthographic", 64)

    def test_mixture_of_two_diffuse_materials_by_face(self):
        self.check("mesh_attributes/test_mesh_attributes_1_face_direct.xml",
                   "mesh_attributes/refs/test_mesh_attributes_1_face", 512)

    def test_diffuse_colors_of_faces(self):
        self.check("mesh_attributes/test_mesh_attributes_3_face_direct.xml",
                   "mesh_attributes/refs/test_mesh_attributes_3_face", 512)


if __name__ == "__main__":
    unittest.main()
