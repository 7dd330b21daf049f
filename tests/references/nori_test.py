#!/usr/bin/env python3
"""Nori's own t-tests: light of polygons on a floor, furnaces of finite and of endless bounces.
Arguments: the source tree, sahl, sahl_reference_pictures, the device, then those of unittest."""

import math
import pathlib
import statistics
import sys
import tempfile
import unittest

import nori_scene
import pictures
import witness

PROGRAMS = witness.Programs()
DEVICE = ("--device", sys.argv.pop(1))
WIDTH, HEIGHT = 125, 100  # of a picture whose pixels all show the same: more work at a time than in one pixel


class Nori(unittest.TestCase):
    def check(self, *names):
        path = PROGRAMS.references("nori", *names)
        if not path.exists():
            self.skipTest(f"missing: references/nori/{'/'.join(names)} (set SAHL_ASSETS)")
        test = nori_scene.StudentTest(path)
        # All references of a file together fail by chance with the probability `level` (Sidak).
        level = 1 - (1 - test.level) ** (1 / len(test.references))
        for i, ((integrator, scene), reference) in enumerate(zip(test.scenes, test.references)):
            with self.subTest(scene=i, integrator=integrator):
                mean, error = self.mean_luminance(scene, test.samples, i, nori_scene.strategy(integrator))
                # Student's distribution of 10^5 degrees of freedom is the normal one.
                t = (mean - reference) / error if error > 0 else 0 if math.isclose(mean, reference, rel_tol=1e-5) \
                    else math.inf
                p = 2 * statistics.NormalDist().cdf(-abs(t))
                print(f"{path.name} {i} {integrator}: {mean:.6g} for {reference:.6g}, t = {t:.2f}, p = {p:.3f}")
                self.assertGreaterEqual(p, level)

    def mean_luminance(self, scene, samples, seed, strategy):
        scene["film"] = {"width": WIDTH, "height": HEIGHT}
        scene["camera"]["fovAxis"] = "vertical"
        scene["integrator"].update(samplesPerPixel=samples // (WIDTH * HEIGHT), seed=seed)
        with tempfile.TemporaryDirectory() as folder:
            file = witness.render(PROGRAMS, scene, pathlib.Path(folder), device=DEVICE,
                                  options=("--light-sampling", strategy))
            picture = pictures.read_rendered(PROGRAMS.pictures, file)
        values = picture.luminances()
        return sum(values) / len(values), math.sqrt(sum(picture.variance)) / len(values)

    def test_irradiance_of_polygons_has_its_closed_form(self):
        self.check("pa4", "tests", "test-mesh.xml")

    def test_furnace_of_one_bounce_shows_one_plus_albedo(self):
        self.check("pa4", "tests", "test-mesh-furnace.xml")

    def test_irradiance_of_polygons_is_right_for_direct_integrators(self):
        self.check("pa5", "tests", "test-direct.xml")

    def test_furnace_of_endless_bounces_shows_the_geometric_series(self):
        self.check("pa5", "tests", "test-furnace.xml")


if __name__ == "__main__":
    unittest.main()
