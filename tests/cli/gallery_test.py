#!/usr/bin/env python3
"""tools/gallery and tools/fetch_assets as users meet them. Arguments: the source tree, the program."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, SAHL = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))


def run(tool, *arguments, **environment):
    """A tool with those arguments, without the assets that this machine may have."""
    variables = {key: value for key, value in os.environ.items() if key != "SAHL_ASSETS"}
    variables.update(environment)
    return subprocess.run([sys.executable, ROOT / "tools" / tool, *arguments], env=variables, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)


class Gallery(Folder):
    def test_quick_run_makes_a_complete_page_that_needs_no_network(self):
        done = run("gallery", "--quick", "--device", "cpu", "--sahl", SAHL, "--out", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.strip(), str(self.folder.resolve() / "index.html"))
        page = (self.folder / "index.html").read_text(encoding="utf-8")
        for figure in range(5, 22):
            self.assertIn(f'<section id="fig{figure}">', page)
        self.assertNotIn('class="error"', page)
        sections = page.split("<section ")[1:]
        for section in sections:
            number = re.match(r'id="fig(\d+)"', section).group(1)
            shown = "data:image/png;base64," in section or "<table>" in section
            self.assertTrue(shown or "The mesh " in section, f"nothing to see in figure {number}")
        # Of the meshes, Sahl has only the teapot itself: what needs others says so.
        for figure in (5, 7, 8, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21):
            section = next(s for s in sections if s.startswith(f'id="fig{figure}"'))
            self.assertNotIn('class="absent"', section, f"figure {figure}")
        sources = re.findall(r'\b(?:src|href|srcset|action|data)\s*=\s*"([^"]*)"', page)
        self.assertGreater(len(sources), 30)
        for source in sources:
            self.assertTrue(source.startswith(("data:", "#")), source[:80])
        words = re.sub(r'base64,[A-Za-z0-9+/=]*', "", page)
        self.assertNotRegex(words, r"(?:https?:)?//[a-z]|@import|url\(")

    def test_a_figure_that_fails_is_shown_with_its_error(self):
        program = self.folder / "sahl"
        program.write_text("#!/bin/sh\necho 'sahl: the device is <lost>' >&2\nexit 6\n")
        program.chmod(0o755)
        done = run("gallery", "--figure", "14", "--sahl", program, "--out", self.folder / "out")
        self.assertEqual(done.returncode, 1)
        self.assertIn("failed: figure 14", done.stderr)
        page = (self.folder / "out" / "index.html").read_text(encoding="utf-8")
        self.assertIn("exit code 6: sahl: the device is &lt;lost&gt;", page)
        self.assertNotIn("<section id=\"fig15\">", page)

    def test_unknown_figure_and_missing_program_are_usage_errors(self):
        for arguments, sentence in ((("--figure", "4"), "there is no figure 4; choose from 5 to 21"),
                                    (("--sahl", "/nowhere/sahl"), "/nowhere/sahl is not there; build it")):
            done = run("gallery", "--out", self.folder, "--sahl", SAHL, *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(sentence, done.stderr)


class FetchAssets(Folder):
    def test_list_names_packages_licences_and_what_is_here(self):
        done = run("fetch_assets", "--list", "--folder", self.folder)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(done.stdout.splitlines()), 4)
        self.assertIn("CC0-1.0): not here", done.stdout)

    def test_without_npm_it_says_what_would_help_and_leaves_nothing(self):
        done = run("fetch_assets", "bunny", "--folder", self.folder, PATH=str(self.folder))
        self.assertEqual(done.returncode, 1)
        self.assertIn("npm is not installed; apt-get install npm", done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_without_a_network_it_says_so_and_leaves_nothing(self):
        npm = self.folder / "bin" / "npm"
        npm.parent.mkdir()
        npm.write_text("#!/bin/sh\necho 'npm ERR! code ENOTFOUND'\necho 'npm ERR! more'\nexit 1\n")
        npm.chmod(0o755)
        done = run("fetch_assets", "bunny", "--folder", self.folder / "out",
                   PATH=f"{npm.parent}:{os.environ['PATH']}")
        self.assertEqual(done.returncode, 1)
        self.assertIn("npm cannot fetch bunny@1.0.1 (npm ERR! code ENOTFOUND); is there a network", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_a_package_with_another_check_sum_is_refused(self):
        (self.folder / "bunny-1.0.1.tgz").write_bytes(b"no bunny")
        done = run("fetch_assets", "bunny", "--from", self.folder, "--folder", self.folder / "out")
        self.assertEqual(done.returncode, 1)
        self.assertIn("bunny-1.0.1.tgz has the check sum", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_unknown_packages_are_usage_errors(self):
        done = run("fetch_assets", "cow", "--folder", self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("'cow' is not known; there are bunny, teapot, dragon, probes", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
