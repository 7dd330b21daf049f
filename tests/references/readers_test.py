#!/usr/bin/env python3
"""The readers of other renderers' scenes, on files small enough to know what must come out.
Arguments: the source tree, sahl, sahl_reference_pictures, the device, then those of unittest."""

import math
import pathlib
import random
import struct
import sys
import tempfile
import unittest
import zlib

import bitmaps
import mitsuba_materials
import mitsuba_scene
import pbrt_scene
import transforms as tr
import tungsten_scene
import witness

PROGRAMS = witness.Programs()
DEVICE = sys.argv.pop(1)

MITSUBA = """<scene version="3.0.0"><default name="depth" value="4"/>
    <integrator type="moment"><integrator type="path"><integer name="max_depth" value="$depth"/></integrator></integrator>
    <sensor type="perspective"><transform name="to_world"><lookat origin="1,2,3" target="1,2,8" up="0,1,0"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="60"/><integer name="height" value="40"/></film>
    </sensor>
    <shape type="rectangle"><transform name="to_world"><scale value="2"/><translate z="5"/></transform>
        <bsdf type="diffuse"/><emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter></shape>
    %s</scene>"""


class Folder(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def written(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def assertNear(self, found, expected, digits=9):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, digits)


class Transforms(Folder):
    def test_look_at_takes_z_to_the_target_and_y_up(self):
        m = tr.look_at([1, 2, 3], [4, 2, 3], [0, 1, 0])
        self.assertNear(tr.point(m, [0, 0, 3]), [4, 2, 3])
        self.assertNear(tr.vector(m, [0, 1, 0]), [0, 1, 0])
        self.assertNear(tr.vector(m, [1, 0, 0]), [0, 0, -1])

    def test_rotation_is_counter_clockwise_and_inverse_undoes_it(self):
        m = tr.times(tr.translation(1, 2, 3), tr.rotation([0, 0, 2], 90))
        self.assertNear(tr.point(m, [1, 0, 0]), [1, 3, 3])
        self.assertNear(tr.point(tr.inverse(m), [1, 3, 3]), [1, 0, 0])


class Mitsuba(Folder):
    def read(self, more="", **options):
        return mitsuba_scene.Reader(PROGRAMS, self.written("scene.xml", MITSUBA % more), self.folder, **options)

    def test_depth_counts_rays_and_the_default_lens_has_50_mm(self):
        scene = self.read().scene
        self.assertEqual(scene["integrator"]["maxBounces"], 3)
        self.assertNear(scene["camera"]["lookAt"], [1, 2, 4])
        self.assertAlmostEqual(scene["camera"]["fovDeg"], math.degrees(2 * math.atan(18 / 50)))  # 36 mm wide

    def test_surfaces_are_black_on_their_backs(self):
        scene = self.read().scene
        back, front = scene["shapes"]
        self.assertNear(back["corner"], [-2, -2, 5 - mitsuba_scene.BEHIND])
        self.assertNear(front["corner"], [-2, -2, 5])
        self.assertEqual(scene["materials"][back["material"]], {"type": "lambert", "baseColor": [0, 0, 0]})
        self.assertEqual(scene["materials"][front["material"]]["emission"], [1, 2, 3])

    def test_what_is_not_here_is_named_or_replaced(self):
        fog = '<shape type="sphere"><bsdf type="measured"/></shape><emitter type="sunsky"/>'
        with self.assertRaisesRegex(mitsuba_scene.Unsupported, "the bsdf measured"):
            self.read(fog)
        reader = self.read(fog, stand_ins=True)
        self.assertEqual([why for _, why in reader.left_out], ["the bsdf measured", "the emitter sunsky"])
        self.assertEqual(reader.scene["shapes"][-1]["type"], "sphere")

    def test_many_spots_fade_linearly_together(self):
        lights = mitsuba_scene.spot_lights([0, 0, 0], [0, 0, 1], [1, 1, 1], 15, 20)
        for angle in (3, 15, 16, 17.23, 19.9, 20, 25):
            linear = min(1, max(0, (20 - angle) / 5))
            self.assertAlmostEqual(sum(light["intensity"][0] * fade(light, angle) for light in lights), linear,
                                   delta=0.2 / len(lights))

    def test_a_surface_that_is_hardly_rough_reflects_by_fresnels_law(self):
        for eta in (1.5, 1 / 1.5):
            for cosine in (0.3, 0.6, 0.8, 1):  # 1e-4 is far from the critical cosine, 0.745, in units of alpha
                self.assertAlmostEqual(mitsuba_materials.rough_reflectance(cosine, eta, 1e-4),
                                       mitsuba_materials.fresnel(cosine, eta), 3)

    def test_a_rough_surface_loses_what_its_facets_hide(self):
        # Nothing is refracted below the critical cosine; what is missing was masked or went down
        whole = [mitsuba_materials.rough_reflectance(0.3, 1e-6, alpha) for alpha in (0.01, 0.3, 1)]
        self.assertGreater(whole[0], 0.99)
        self.assertGreater(whole[0], whole[1])
        self.assertGreater(whole[1], whole[2])

    def test_plastic_gives_the_light_that_theirs_gives(self):
        eta = 1.49
        k = mitsuba_materials.diffuse_reflectance(1 / eta)
        self.assertAlmostEqual(k, 0.5901, 3)  # (1 - t) with t = 0.4099 = (1 - F) / eta^2, the diffuse F = 0.0905
        for rho in (0, 0.3, 1):
            ours, = mitsuba_materials.linear_base([rho], eta)
            self.assertAlmostEqual(ours / (1 - k * ours), rho / (1 - k))


def fade(light, angle):
    """Of a spot of Sahl: a smooth step between the cosines."""
    inner, outer, here = (math.cos(math.radians(value)) for value in (light["innerDeg"], light["outerDeg"], angle))
    t = min(1, max(0, (here - outer) / (inner - outer)))
    return t * t * (3 - 2 * t)


class Others(Folder):
    def test_pbrt_directives_have_plain_words_and_parameters(self):
        found = pbrt_scene.directives('Transform [ 1 0 ] Shape "plymesh" "string filename" [ "a b.ply" ] WorldEnd')
        self.assertEqual(found, [("Transform", ["1", "0"], {}), ("Shape", ["plymesh"], {"filename": ["a b.ply"]}),
                                 ("WorldEnd", [], {})])

    def test_a_cube_of_tungsten_has_six_sides_that_face_outwards(self):
        sides = tungsten_scene.shapes({"type": "cube", "transform": {"position": [5, 0, 0], "scale": [2, 2, 2],
                                                                     "rotation": [10, 20, 30]}}, "white")
        self.assertEqual(len(sides), 6)
        for side in sides:
            normal = tr.cross(side["edgeU"], side["edgeV"])
            middle = tr.plus(side["corner"], tr.scaled(tr.plus(side["edgeU"], side["edgeV"]), 0.5))
            self.assertNear(tr.unit(normal), tr.minus(middle, [5, 0, 0]))

    def test_tungsten_turns_about_y_clockwise(self):
        self.assertNear(tr.point(tungsten_scene.matrix({"rotation": [0, 90, 0]}), [1, 0, 0]), [0, 0, 1])
        self.assertNear(tr.point(tungsten_scene.matrix({"rotation": [90, 0, 0]}), [0, 1, 0]), [0, 0, 1])


class Bitmaps(Folder):
    def test_png_files_of_every_filter_are_read(self):
        rows = [bytes(random.Random(y).randrange(256) for _ in range(12)) for y in range(5)]
        body, above = b"", bytes(12)
        for kind, row in enumerate(rows):
            body += bytes([kind]) + bytes((value - guess(kind, row, above, i)) & 255 for i, value in enumerate(row))
            above = row
        path = self.folder / "filters.png"
        bitmaps.write_png(path, bitmaps.constant(4, 5, (0, 0, 0)))
        data = path.read_bytes()
        at = data.index(b"IDAT")
        length, = struct.unpack(">I", data[at - 4:at])
        packed = zlib.compress(body)
        path.write_bytes(data[:at - 4] + struct.pack(">I", len(packed)) + b"IDAT" + packed + bytes(4) +
                         data[at + 8 + length:])
        self.assertEqual(bitmaps.read(path).rows, rows)

    def test_averages_and_lookups_agree_on_a_ramp(self):
        ramp = bitmaps.Bitmap(8, 1, 1, [bytes(range(0, 80, 10))])
        self.assertAlmostEqual(ramp.average(0.25, 0.5, 0.5, 0), (ramp.linear(2, 0, 0) + ramp.linear(3, 0, 0)) / 2)
        self.assertAlmostEqual(ramp.lookup(0.375, 0.5, 0), (ramp.linear(2, 0, 0) + ramp.linear(3, 0, 0)) / 2)


def guess(kind, row, above, i):
    left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
    return (0, left, above[i], (left + above[i]) // 2, bitmaps.paeth(left, above[i], corner))[kind]


if __name__ == "__main__":
    unittest.main()
