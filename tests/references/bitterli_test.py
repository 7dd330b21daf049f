#!/usr/bin/env python3
"""Bitterli's coffee maker beside the picture that Tungsten made of it.
Arguments: the source tree, sahl, sahl_reference_pictures, the device, then those of unittest."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import pbrt_scene
import witness

PROGRAMS = witness.Programs()
DEVICE = ("--device", sys.argv.pop(1))
SAMPLES = 256
LARGEST_RELMSE = 0.05
FRAME = 0.02  # largest difference of the frame's mean luminance, relative to it


class Bitterli(unittest.TestCase):
    """Their pixel filter is a tent of two pixels, which shows at every edge, and their sample is small (64): so
    this is no test of blocks by their noise, but of the frame's mean and of relMSE."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def test_coffee_maker(self):
        path = PROGRAMS.references("bitterli", "coffee", "scene.pbrt")
        if not path.exists():
            self.skipTest("missing: references/bitterli/coffee/scene.pbrt (set SAHL_ASSETS)")
        scene = pbrt_scene.Reader(path).scene
        scene["integrator"]["samplesPerPixel"] = SAMPLES
        ours = witness.render(PROGRAMS, scene, self.folder, device=DEVICE)
        report = self.folder / "coffee.html"
        done = subprocess.run([PROGRAMS.sahl, "compare", ours, path.with_name("TungstenRender.exr"), "--json",
                               "--report", report], stdout=subprocess.PIPE, text=True, check=False)
        self.assertLessEqual(done.returncode, 2)
        keep(ours, report)
        metrics = json.loads(done.stdout)["metrics"]
        mean = self.mean_difference(ours, path.with_name("TungstenRender.exr"))
        print(f"| coffee | {100 * mean:+.2f} | relMSE {metrics['relMse']['all']:.4f} | trimmed "
              f"{metrics['relMse']['trimmed']:.4f} | {SAMPLES} |")
        self.assertLess(abs(mean), FRAME)
        self.assertLess(metrics["relMse"]["trimmed"], LARGEST_RELMSE)

    def mean_difference(self, *files):
        ours, theirs = (sum(witness.pictures.read(PROGRAMS.pictures, file)[0].luminances()) for file in files)
        return ours / theirs - 1


def keep(*files):
    """Where SAHL_KEEP names a folder, what there is to look at stays there."""
    if os.environ.get("SAHL_KEEP"):
        for file in files:
            shutil.copy(file, os.environ["SAHL_KEEP"])


if __name__ == "__main__":
    unittest.main()
