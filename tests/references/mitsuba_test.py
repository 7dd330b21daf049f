#!/usr/bin/env python3
"""Mitsuba's regression scenes against the mean and variance pictures that they come with.
Arguments: the source tree, sahl, sahl_reference_pictures, the device, then those of unittest."""

import array
import copy
import math
import pathlib
import sys
import tempfile
import unittest

import mitsuba_scene
import pictures
import projected_light
import transforms as tr
import witness

PROGRAMS = witness.Programs()
DEVICE = ("--device", sys.argv.pop(1))
FOLDER = ("mitsuba", "tests", "scenes")
REFERENCE_SAMPLES = 32000  # a pixel, of all reference pictures
FRAME = 0.003  # largest difference of the frame's mean, relative to it
SURE = 0.001   # largest standard error at which that can be told
NARROW = 0.02  # alpha at which Beckmann's distribution and GGX reflect alike but for 0.2 %
WINDOW = 9     # pixels around each sphere of the grid
FINE = 8       # as many pixels on a side for each of the picture, where a light's picture is put in afterwards
LIT = (-11, -2)         # where along x the paper gets light of pictures
TEXELS_PER_METRE = 100  # of what it then emits


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

    def rendered(self, scene, samples, name="scene"):
        scene["integrator"]["samplesPerPixel"] = samples
        return pictures.read_rendered(PROGRAMS.pictures,
                                      witness.render(PROGRAMS, scene, self.folder, name, device=DEVICE))

    def agree(self, name, ours, theirs, samples, sure=SURE, frame=FRAME, level=0.01, unlike=0):
        """The frame's mean within FRAME, the frame and no block further off than noise explains. Where blocks are
        known to be `unlike`, no more of them than that, and the frame within FRAME."""
        if not any(theirs.rgb):
            print(f"| {name} | black | | | {samples} |", flush=True)
            self.assertFalse(any(ours.rgb))
            return
        found = witness.compare(PROGRAMS, ours, theirs, self.folder, level)["statistics"]
        difference, error = (found["frame"][key] / found["meanB"] for key in ("difference", "standardError"))
        print(f"| {name} | {100 * difference:+.3f} | {100 * error:.3f} | "
              f"{len(found['differingBlocks'])} of {found['testedBlocks']} | {samples} |", flush=True)
        self.assertLess(error, sure, "too few samples to tell")
        self.assertLessEqual(abs(difference), frame)
        self.assertLessEqual(len(found["differingBlocks"]), unlike, found["differingBlocks"])
        if unlike == 0:
            self.assertFalse(found["frameDiffers"], found["frame"])

    def check(self, scene, name, samples, window=None, sampler="independent", judged=None, **options):
        """A whole picture, or x, y, width, height of it; judged as `agree` does, or otherwise."""
        reader = mitsuba_scene.Reader(PROGRAMS, self.require(scene), self.folder, **options)
        reader.scene["integrator"]["sampler"] = sampler
        both = [self.rendered(reader.scene, samples), reference(name)]
        if window:
            both = [picture.window(*window) for picture in both]
        self.agree(name, *both, samples, **(judged or {}))

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

    def windows(self, scene, name, samples, **options):
        """Of a grid of spheres, which do not light each other, those whose materials are here: each by itself, and
        all of them together."""
        reader = mitsuba_scene.Reader(PROGRAMS, self.require(scene), self.folder, stand_ins=True, **options)
        ours, theirs = self.rendered(reader.scene, samples), reference(name)
        lacking = {id(node): why for node, why in reader.left_out}
        kept = []
        for node in reader.document.nodes:
            if node.tag != "shape":
                continue
            center = tr.point(reader.document.transform(node), [0, 0, 0])
            what = f"{name} {node.find('bsdf').get('type')} at {center[1]:g}, {center[2]:g}"
            if id(node) in lacking:
                print(f"| {what} | not compared: {lacking[id(node)]} |")
            else:
                kept.append((what, window_of(reader.scene["camera"], center, ours.width)))
        level = 1 - 0.99 ** (1 / len(kept))
        for what, (x, y) in kept:
            with self.subTest(window=what):
                parts = [picture.window(x, y, WINDOW, WINDOW) for picture in (ours, theirs)]
                self.agree(what, *parts, samples, sure=10 * SURE, frame=10 * FRAME, level=level)
        together = [stacked([picture.window(x, y, WINDOW, WINDOW) for _, (x, y) in kept])
                    for picture in (ours, theirs)]
        self.agree(f"{name}: these together", *together, samples)

    def test_spheres_of_many_materials_in_white_light(self):
        self.windows("bsdf_spheres/test_constant_path.xml", "bsdf_spheres/refs/test_constant", 16384,
                     beckmann=NARROW)

    def test_spheres_of_many_materials_by_a_point_light(self):
        self.windows("bsdf_spheres/test_pointlight_path.xml", "bsdf_spheres/refs/test_pointlight", 16384)

    def test_glass_a_little_rough(self):
        """Small lamps in Beckmann's glass, and a reference with a standard error of 0.13 %. By quadrature of both
        distributions over this scene the frame is 0.07 % darker under GGX, but blocks are up to 4.6 % off, since
        highlights are less sharp."""
        self.check("bsdf_spheres/test_roughdielectric_path.xml", "bsdf_spheres/refs/test_roughdielectric", 32768,
                   beckmann=NARROW, sampler="sobol", judged={"sure": FRAME / 2, "unlike": 14})

    def test_plastic_that_is_hardly_rough(self):
        """One of four spheres: in theirs the diffuse base loses what the microfacets of a rough coat lose, in ours
        it gets that, so that the others differ by the more the rougher they are."""
        self.check("bsdf_spheres/test_roughplastic_linear_path.xml", "bsdf_spheres/refs/test_roughplastic_linear",
                   65536, window=(0, 0, 24, 24), sampler="sobol")

    def test_spot_light_that_shows_a_picture(self):
        """We have no such light. But the camera stands where it does, and there is only direct light: its picture
        is a factor that is known for every point of the frame."""
        path = self.require("spot_light/test_spot_direct.xml")
        reader = mitsuba_scene.Reader(PROGRAMS, path, self.folder, stand_ins=True)
        around = self.rendered(reader.scene, 1024, "around")
        (node, _), = reader.left_out
        light = projected_light.Spot(reader.document, node)
        matrix = light.matrix
        lit = {**reader.scene, "environment": {"radiance": [0, 0, 0]}, "lights": mitsuba_scene.spot_lights(
            tr.point(matrix, [0, 0, 0]), tr.vector(matrix, [0, 0, 1]), light.intensity, light.inner, light.outer)}
        lit["film"] = {key: FINE * value for key, value in reader.scene["film"].items()}
        spot = self.rendered(lit, 64, "spot")
        self.agree("spot_light/refs/test_spot", around + shown_through(light, spot, lit["camera"]["fovDeg"]),
                   reference("spot_light/refs/test_spot"), 1024)

    def test_emitters_of_many_kinds(self):
        """Two lights show pictures, which ours cannot. Their light first meets white paper, so the paper emits
        what it would send back, in a second picture of one bounce less."""
        path = self.require("various_emitters/test_various_emitters_ptracer.xml")
        reader = mitsuba_scene.Reader(PROGRAMS, path, self.folder, stand_ins=True)
        kinds = {"spot": projected_light.Spot, "projector": projected_light.Projector}
        lights = [kinds[node.get("type")](reader.document, node) for node, _ in reader.left_out]
        shining = copy.deepcopy(reader.scene)
        for material in shining["materials"].values():
            material.pop("emission", None)
            material.pop("emissionTexture", None)
        shining["lights"] = []
        shining["integrator"]["maxBounces"] -= 1
        paper, = (shape for shape in shining["shapes"] if shape.get("name") == "receiver-plane")
        split_paper(shining, paper, lights, self.folder)
        samples = 512
        ours = self.rendered(reader.scene, samples) + self.rendered(shining, samples, "projected")
        self.agree("various_emitters/refs/test_various_emitters", ours,
                   reference("various_emitters/refs/test_various_emitters"), samples)


def window_of(camera, center, width):
    """The top left pixel of the window around a sphere that a camera along +X sees; the picture is square."""
    scale = width / 2 / math.tan(math.radians(camera["fovDeg"]) / 2) / (center[0] - camera["eye"][0])
    return [max(0, min(width - WINDOW, round(width / 2 - scale * offset - WINDOW / 2))) for offset in center[1:]]


def stacked(parts):
    """Pictures of one width, one below the other."""
    def joined(name):
        values = array.array("f")
        for part in parts:
            values.extend(getattr(part, name))
        return values
    return pictures.Picture(parts[0].width, sum(part.height for part in parts), joined("rgb"), joined("variance"),
                            joined("samples"))


def shown_through(light, spot, fov):
    """A picture from where the light is, FINE times as large, through the light's picture."""
    half = math.tan(math.radians(fov) / 2)
    width, height = spot.width // FINE, spot.height // FINE
    rgb, variance = array.array("f", bytes(12 * width * height)), array.array("f", bytes(4 * width * height))
    for y in range(spot.height):
        for x in range(spot.width):
            left = half * (1 - 2 * (x + 0.5) / spot.width)
            above = half * (1 - 2 * (y + 0.5) / spot.height)
            color, pixel = spot.pixel(x, y), (y // FINE) * width + x // FINE
            if max(color) > 0:
                u, v = light.uv(left, above, 1)
                reach = half / spot.width / (2 * light.half)
                for i in range(3):
                    factor = light.bitmap.average(u - reach, u + reach, v, i)
                    rgb[3 * pixel + i] += color[i] * factor / FINE ** 2
                variance[pixel] += spot.variance[y * spot.width + x] / FINE ** 4
    return pictures.Picture(width, height, rgb, variance, array.array("f", [spot.samples[0] * FINE ** 2]) * len(variance))


def split_paper(scene, paper, lights, folder):
    """In place of the paper three parts, of which the middle one emits what the lights make it send back."""
    corner, u, v = (paper[key] for key in ("corner", "edgeU", "edgeV"))
    place = [(x - corner[0]) / u[0] for x in LIT]
    scene["shapes"].remove(paper)
    scene["materials"]["lit"] = {"type": "lambert", "baseColor": [1, 1, 1],
                                 "emissionTexture": {"file": "lit.png", "wrap": "clamp"}}
    cuts = [0, *sorted(place), 1]
    for i, material in enumerate((paper["material"], "lit", paper["material"])):
        scene["shapes"].append({"type": "rectangle", "material": material, "edgeV": v,
                                "corner": tr.plus(corner, tr.scaled(u, cuts[i])),
                                "edgeU": tr.scaled(u, cuts[i + 1] - cuts[i])})
    middle = scene["shapes"][-2]
    size = [round(TEXELS_PER_METRE * tr.length(middle[edge])) for edge in ("edgeU", "edgeV")]
    white = projected_light.as_emission(lights, middle["corner"], middle["edgeU"], v, *size, folder / "lit.png")
    scene["materials"]["lit"]["emission"] = [white] * 3


if __name__ == "__main__":
    unittest.main()
