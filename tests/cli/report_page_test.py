#!/usr/bin/env python3
"""The page of `sahl compare --report` in a real browser. Arguments: the source tree, the program."""

import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT, SAHL = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tests" / "support"))

import browser  # noqa: E402 (found by the line above)

WIDTH, HEIGHT = 24, 16
SKIPPED = 77  # what ctest takes for a skipped test


def write_pfm(path, pixel):
    """pixel(x, y): three floats; y counts from the top."""
    rows = [struct.pack("<3f", *pixel(x, y)) for y in reversed(range(HEIGHT)) for x in range(WIDTH)]
    path.write_bytes(f"PF\n{WIDTH} {HEIGHT}\n-1.0\n".encode() + b"".join(rows))


def scene(folder):
    (folder / "ball.json").write_text(
        '{"camera": {"eye": [0, 1, 5], "lookAt": [0, 0, 0], "fovDeg": 35}, "film": {"width": 24, "height": 16},'
        '"materials": {"clay": {"type": "lambert", "baseColor": [0.7, 0.4, 0.2]}},'
        '"shapes": [{"type": "sphereMesh", "level": 2, "material": "clay"}], "environment": {"builtin": "studio"}}')


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_sahl(self, *arguments):
        return subprocess.run([SAHL, *arguments], cwd=self.folder, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def compare(self, a, b):
        done = self.run_sahl("compare", a, b, "--report", "page.html", "-q")
        self.assertIn(done.returncode, (0, 1, 2), done.stderr)
        return self.folder / "page.html"

    def opened(self, page):
        window = browser.Browser()
        self.addCleanup(window.__exit__)
        window.open(page)
        window.wait_for("document.body !== null && document.body.dataset.ready === 'yes'")
        window.drawn()
        return window

    def render_pair(self):
        scene(self.folder)
        for name, seed in (("a.exr", "1"), ("b.exr", "2")):
            done = self.run_sahl("render", "ball.json", "--device", "cpu", "--spp", "16", "--seed", seed,
                                 "-o", name, "-q")
            self.assertEqual(done.returncode, 0, done.stderr)

    def pressed(self, window):
        return window.value("views.findIndex((v) => v.button.getAttribute('aria-pressed') === 'true')")

    def visible(self, window):
        return window.value("views.map((v) => v.canvas.getClientRects().length > 0)")

    def test_page_needs_no_network_and_loads_without_a_complaint(self):
        self.render_pair()
        page = self.compare("a.exr", "b.exr")
        text = page.read_text(encoding="utf-8")
        self.assertIsNone(re.search(r'\b(?:src|href)\s*=\s*"(?!data:)', text))
        self.assertNotIn("http", re.sub(r'<script id="(comparison|planes)".*?</script>', "", text))
        window = self.opened(page)
        self.assertEqual(window.complaints, [])
        self.assertEqual(window.value("views.map((v) => v.name)"), ["A", "B", "A − B", "FLIP", "z"])
        self.assertGreater(window.value("byId('metrics').rows.length"), 8)
        self.assertGreater(window.value("byId('noise').rows.length"), 4)
        self.assertTrue(window.value("byId('metadata').innerText.includes('sahl.seed')"))

    def test_keys_choose_views_and_flip_between_them(self):
        self.render_pair()
        window = self.opened(self.compare("a.exr", "b.exr"))
        for key, index in (("2", 1), ("3", 2), ("4", 3), ("5", 4), ("1", 0)):
            window.key(key)
            self.assertEqual(self.pressed(window), index)
            self.assertEqual(self.visible(window), [i == index for i in range(5)])
        window.key(" ")
        self.assertEqual(self.pressed(window), 1)
        window.key(" ")
        self.assertEqual(self.pressed(window), 0)
        window.key("s")
        self.assertEqual(self.visible(window), [True] * 5)
        window.key("h")
        self.assertTrue(window.value("byId('keys').open"))
        self.assertEqual(window.complaints, [])

    def test_wheel_zooms_all_views_about_the_pointer_and_its_pixel_is_told(self):
        write_pfm(self.folder / "a.pfm", lambda x, y: (x / 8, y / 8, 0.25))
        write_pfm(self.folder / "b.pfm", lambda x, y: (x / 8, y / 8 + 0.5, 0.25))
        window = self.opened(self.compare("a.pfm", "b.pfm"))
        x, y = window.value("(() => { const b = views[0].canvas.getBoundingClientRect();"
                            " return [b.left + b.width / 2 + 30, b.top + b.height / 2 - 20]; })()")
        window.mouse("mouseMoved", x, y)
        before, scale = window.value("byId('pixel').textContent"), window.value("view.scale")
        place = [int(n) for n in re.match(r"pixel \((\d+), (\d+)\)", before).groups()]
        self.assertIn(f"A  {place[0] / 8:g}, {place[1] / 8:g}, 0.25", before)
        self.assertIn(f"B  {place[0] / 8:g}, {place[1] / 8 + 0.5:g}, 0.25", before)
        self.assertIn("A − B  -0.3576", before)  # 0.7152 of 0.5
        window.mouse("mouseWheel", x, y, deltaX=0, deltaY=-800)
        self.assertGreater(window.value("view.scale"), 2 * scale)
        window.mouse("mouseMoved", x, y)
        self.assertEqual(window.value("byId('pixel').textContent"), before)
        window.key("0")
        self.assertEqual(window.value("view.scale"), scale)
        self.assertEqual(window.complaints, [])

    def test_picture_has_the_srgb_colours_of_its_values_under_the_exposure(self):
        write_pfm(self.folder / "a.pfm", lambda x, y: (0.5, 1, float("nan") if (x, y) == (3, 2) else 0.125))
        write_pfm(self.folder / "b.pfm", lambda x, y: (0.5, 1, 0.125))
        window = self.opened(self.compare("a.pfm", "b.pfm"))
        self.assertEqual(window.complaints, [])  # before this test reads the canvas, which Chromium dislikes
        colour = "[...views[0].picture.getContext('2d').getImageData({}, {}, 1, 1).data].slice(0, 3)"
        self.assertEqual(window.value(colour.format(0, 0)), [188, 255, 99])
        self.assertEqual(window.value(colour.format(3, 2)), [255, 0, 255])
        window.key("E")
        window.key("E")  # a stop less
        self.assertEqual(window.value(colour.format(0, 0)), [137, 188, 71])

    def test_name_of_a_file_is_text_whatever_it_looks_like(self):
        name = "<img src=x onerror=alert(1)><b>.pfm"
        for file in (name, "b.pfm"):
            write_pfm(self.folder / file, lambda x, y: (x, y, 1))
        window = self.opened(self.compare(name, "b.pfm"))
        self.assertTrue(window.value("byId('title').textContent").startswith(name))
        self.assertEqual(window.value("document.querySelectorAll('img').length"), 0)
        self.assertEqual(window.complaints, [])


if __name__ == "__main__":
    if browser.program() is None:
        print("skipped: no Chromium to open the page in")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
