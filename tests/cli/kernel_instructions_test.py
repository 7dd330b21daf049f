#!/usr/bin/env python3
"""tools/kernel_instructions with a valgrind that only pretends. Argument: the source tree."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))

# A kernel of 3 instructions of which the last two run twice as often, a function that it calls, a function of a file.
COUNTS = """fn=(1) main
ob=(1) ???
fn=(2) 0x5000
0x5000 10000
+4 20000
cob=(1)
cfn=(3) 0x6000
calls=20000 0x6000
* 900000
+4 20000
fn=(3)
0x6000 5000
ob=(2) /usr/lib/libc.so.6
fn=(4) memcpy
0x7000 1000000
"""


class KernelInstructions(unittest.TestCase):
    def run_tool(self, pretended, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            valgrind = pathlib.Path(folder) / "valgrind"
            if pretended is not None:
                valgrind.write_text("#!/bin/sh\n" + pretended)
                valgrind.chmod(0o755)
            path = folder if pretended is None else folder + os.pathsep + os.environ["PATH"]
            return subprocess.run([sys.executable, str(ROOT / "tools" / "kernel_instructions"), "scene.json", *arguments],
                                  env={**os.environ, "PATH": path}, capture_output=True, text=True)

    def test_counts_what_drivers_compiled_and_nothing_else(self):
        run = self.run_tool(f"cat > counts <<'END'\n{COUNTS}END\n", "--program", "a", "--program", "b")
        self.assertEqual(run.returncode, 0, run.stderr)
        lines = run.stdout.splitlines()
        self.assertEqual(lines[0], "a: 55000 instructions, 1.0000 of the first")
        self.assertEqual(lines[1].split(), "72.7 % 20000 times 2 instructions of 0x5000".split())
        self.assertEqual(lines[2].split(), "18.2 % 10000 times 1 instructions of 0x5000".split())
        self.assertEqual(lines[3].split(), "9.1 % 5000 times 1 instructions of 0x6000".split())
        self.assertEqual(lines[4], "b: 55000 instructions, 1.0000 of the first")

    def test_says_where_no_kernel_ran(self):
        run = self.run_tool("echo 'fn=(1) main' > counts")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("no kernel ran that a driver compiled", run.stderr)

    def test_hands_on_what_the_program_says(self):
        run = self.run_tool("echo 'sahl: scene.json: no such file' >&2; exit 3")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("no such file", run.stderr)

    def test_says_that_valgrind_is_missing(self):
        run = self.run_tool(None)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("valgrind is a package of that name", run.stderr)


if __name__ == "__main__":
    unittest.main()
