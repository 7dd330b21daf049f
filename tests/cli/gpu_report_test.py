#!/usr/bin/env python3
"""tools/gpu_report on a software device, and on a program that fails it. Arguments: the source tree, the program."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, SAHL = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))
VARIANT = "texel-8x8-by8"

# Knows one device, measures one ceiling, hangs at native verification, differs at exact, breaks at rays and writes no
# JSON of pictures.
FAKE = """#!/usr/bin/env python3
import json, sys, time
said = sys.argv[1:]
out = said[said.index("--json") + 1] if "--json" in said[:-1] else None
if said[:2] == ["devices", "--json"]:
    print(json.dumps({"vulkan": [{"index": 0, "kind": "discrete", "usable": True}]}))
elif said[:2] == ["devices", "--variants"]:
    print("one\\ntwo")
elif said[:2] == ["bench", "ceiling"]:
    rows = [{"name": "read", "perSecond": 2e9}, {"name": "copy", "failure": "lost"}]
    open(out, "w").write(json.dumps({"device": {"name": "card", "driver": "1"}, "rows": rows}))
elif "native" in said:
    time.sleep(60)
elif said[0] == "verify":
    equal = said[said.index("--math") + 1] == "auto"
    print(json.dumps({"equal": equal, "differingPixels": 0 if equal else 3}))
    sys.exit(0 if equal else 1)
elif said[:2] == ["bench", "traversal"] and "one" in said:
    print("sahl: the device was lost; try again", file=sys.stderr)
    sys.exit(6)
elif said[:2] == ["bench", "traversal"]:
    tracer = {"raysPerSecond": 1e6, "spread": 0}
    open(out, "w").write(json.dumps({"rows": [{"scene": "s", "kind": "primary", "rays": 9, "boxTestsPerRay": 10,
                                               "primitiveTestsPerRay": 5, "tracers": [tracer]}]}))
"""


class GpuReport(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def report(self, program, *arguments):
        done = subprocess.run([sys.executable, ROOT / "tools/gpu_report", "--sahl", program, "--out",
                               self.folder / "out", *arguments], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False)
        return done, json.loads((self.folder / "out/report.json").read_text(encoding="utf-8"))

    def test_software_device_is_verified_and_measured(self):
        done, report = self.report(SAHL, "--device", "software", "--size", "16", "--triangles", "500", "--repeat", "1",
                                   "--spp", "1", "--variant", VARIANT, "--seconds", "250")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual([entry["equalBits"] for entry in report["verify"]], [True, True, True])
        for name in ("read", "copy", "arithmetic", "fused"):
            self.assertGreater(report["ceilings"][name], 1e7, name)
        self.assertEqual([row["kind"] for row in report["traversal"]], 2 * ["primary", "shadow", "diffuse"])
        self.assertEqual([row["scene"] for row in report["render"]], ["torus", "courtyard"])
        for row in report["traversal"]:
            asked = row["raysPerSecond"] * (16 * row["boxTestsPerRay"] + 48 * row["primitiveTestsPerRay"])
            self.assertAlmostEqual(row["shareOfRead"] * report["ceilings"]["read"], asked, delta=1e-6 * asked)
        self.assertIn(f"{VARIANT}  torus, primary", done.stdout)
        self.assertIn("7 of 7 steps are fine", done.stdout)

    def test_steps_that_fail_are_told_and_the_next_ones_begin(self):
        program = self.folder / "sahl"
        program.write_text(FAKE, encoding="utf-8")
        program.chmod(0o755)
        done, report = self.report(program, "--step-seconds", "1")
        self.assertEqual(done.returncode, 1)
        failures = {step["name"]: step["failure"] for step in report["steps"] if not step["ok"]}
        self.assertEqual(set(failures), {"verify, native math", "verify, exact math", "rays, one", "pictures, one",
                                         "pictures, two"})
        self.assertIn("ended after 1 s", failures["verify, native math"])
        self.assertEqual(failures["rays, one"], "exit code 6: sahl: the device was lost; try again")
        self.assertIn("JSON cannot be read", failures["pictures, two"])
        self.assertEqual(failures["verify, exact math"], "3 pixels differ")
        self.assertEqual([entry["equalBits"] for entry in report["verify"]], [True, False, False])
        self.assertEqual(report["size"], 1024, "a real GPU has something to do")
        row, = report["traversal"]
        self.assertAlmostEqual(row["shareOfRead"], 1e6 * (160 + 240) / 2e9)
        self.assertIsNone(row["shareOfArithmetic"])
        self.assertIn("copy        not measured", done.stdout)
        self.assertIn("failed: rays, one: exit code 6", done.stdout)

    def test_native_math_may_differ_on_a_device_that_divides_otherwise(self):
        program = self.folder / "sahl"
        differs = "print('{\"equal\": false, \"differingPixels\": 7}'); sys.exit(1)"
        program.write_text(FAKE.replace("time.sleep(60)", differs), encoding="utf-8")
        program.chmod(0o755)
        done, report = self.report(program)
        step, = [step for step in report["steps"] if step["name"] == "verify, native math"]
        self.assertTrue(step["ok"])
        self.assertEqual(report["verify"][2]["failure"], "7 pixels differ")
        self.assertIn("verify, native math: 7 pixels differ", done.stdout)

    def test_verification_whose_answer_is_no_json_is_told(self):
        program = self.folder / "sahl"
        program.write_text(FAKE.replace("print(json.dumps({\"equal\"", "print(str({\"equal\""), encoding="utf-8")
        program.chmod(0o755)
        done, report = self.report(program, "--step-seconds", "1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("verify, auto math: its answer is not understood", done.stdout)
        step, = [step for step in report["steps"] if step["name"] == "verify, auto math"]
        self.assertIn("numbers are not understood", step["failure"])

    def test_no_step_begins_once_the_time_is_over(self):
        program = self.folder / "sahl"
        program.write_text(FAKE, encoding="utf-8")
        program.chmod(0o755)
        done, report = self.report(program, "--seconds", "0")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(all("no time was left" in step["failure"] for step in report["steps"]))


if __name__ == "__main__":
    unittest.main()
