"""The study runner on a tiny scene: CSV and page, a failed run as a row, going on after an interruption."""

import csv
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT, SIMULATE = sys.argv.pop(1), sys.argv.pop(1)
SCENE = os.path.join(ROOT, "config", "scenes", "block_on_incline.yaml")
SWEEP = f"""
title: A tiny study
scene: {SCENE}
set: {{time.end_s: 0.1, bodies.block.initial_stress: none}}
rows:
  - {{label: smooth, surfaces.plane.friction: 0.1}}
  - {{label: thrown, bodies.block.initial_velocity_m_per_s: [0, 50]}}
  - {{label: rough, surfaces.plane.friction: 0.5}}
expect:
  - {{figure: container_centroid_y_m, against: surfaces.plane.friction, trend: falling}}
pictures: {{sections: [smooth]}}
learned: Rough planes hold.
"""
# Counts its runs; waits before the one that is marked by the environment.
COUNTER = f"""#!/bin/sh
echo "$*" >>"$(dirname "$0")/calls"
case "$*" in *"${{HOLD:-nothing to hold}}"*) exec sleep 60;; esac
exec {SIMULATE} "$@"
"""


class Runner(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("tiny.yaml", SWEEP)
        self.write("simulate.sh", COUNTER)
        os.chmod(self.path("simulate.sh"), 0o755)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, *names):
        with open(self.path(*names), encoding="utf-8") as file:
            return file.read()

    def calls(self):
        return len(self.read("calls").splitlines()) if os.path.exists(self.path("calls")) else 0

    def start(self, *arguments, **environment):
        return subprocess.Popen([sys.executable, "-B", os.path.join(ROOT, "bench", "study"), "--simulate", self.path("simulate.sh"),
                                 "--directory", self.folder, "--cache", "cache", "--jobs", "1", *arguments],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={**os.environ, **environment})

    def study(self, *arguments):
        process = self.start(*arguments)
        out, err = process.communicate(timeout=120)
        return process.returncode, out, err

    def rows(self, *names):
        return {row["label"]: row for row in csv.DictReader(self.read(*names).splitlines())}

    def test_rows_page_and_second_time(self):
        status, out, err = self.study("tiny.yaml", "--out", "out")
        self.assertEqual(status, 3, err)
        self.assertIn("as expected: container_centroid_y_m", out)
        rows = self.rows("out", "tiny.csv")
        self.assertEqual(list(rows), ["smooth", "thrown", "rough"])
        self.assertEqual(list(rows["smooth"])[:5], ["label", "surfaces.plane.friction", "bodies.block.initial_velocity_m_per_s",
                                                    "status", "why"])
        for column in ("outcome", "release_time_s", "peak_tension_n_per_m", "residual_tension_n_per_m", "energy_balance_error",
                       "soil_volume_change", "container_width_m", "steps", "digest", "flags", "user_cpu_s"):
            self.assertIn(column, rows["smooth"])
        self.assertEqual((rows["smooth"]["status"], rows["smooth"]["why"]), ("completed", ""))
        self.assertEqual(rows["thrown"]["status"], "stopped")
        self.assertIn("left the grid", rows["thrown"]["why"])
        self.assertGreater(float(rows["smooth"]["container_centroid_y_m"]), float(rows["rough"]["container_centroid_y_m"]))
        page = self.read("out", "tiny.md")
        self.assertIn("**thrown: stopped.**", page)
        self.assertIn("Rough planes hold.", page)
        self.assertTrue(os.path.exists(self.path("out", "tiny_sections.png")))

        digest, before = rows["smooth"]["digest"], self.calls()
        self.assertEqual(before, 3)
        status, out, _ = self.study("tiny.yaml", "--out", "out")
        self.assertEqual((status, self.calls()), (3, before), "nothing is computed twice")
        self.assertIn("3 of 3 runs were there already", out)
        self.assertEqual(self.rows("out", "tiny.csv")["smooth"]["digest"], digest)

        # Another value in every row is another run; the row that changes the key itself, too.
        status, _, _ = self.study("tiny.yaml", "--out", "more", "--set", "materials.block.density_kg_per_m3=1900", "--no-pictures")
        self.assertEqual((status, self.calls()), (3, before + 3))

    def test_interrupted_and_gone_on(self):
        process = self.start("tiny.yaml", "--out", "out", "--no-pictures", HOLD="friction=0.5")
        deadline = time.monotonic() + 60
        while self.calls() < 3 and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130, err)
        self.assertNotIn("Traceback", err)
        self.assertEqual([name for name in os.listdir(self.path("cache")) if name.endswith(".part")], [])
        self.assertEqual(len(os.listdir(self.path("cache"))), 2)
        self.assertFalse(os.path.exists(self.path("out", "tiny.csv")))

        status, out, err = self.study("tiny.yaml", "--out", "out", "--no-pictures")
        self.assertEqual((status, self.calls()), (3, 4), "only the interrupted run is made anew")
        self.assertIn("2 of 3 runs were there already", out)
        self.assertEqual(self.rows("out", "tiny.csv")["rough"]["status"], "completed")

    def test_refused_key_is_a_row(self):
        self.write("wrong.yaml", f"scene: {SCENE}\nset: {{time.end_s: 0.02}}\nrows: [{{label: good, surfaces.plane.friction: 0.1}}, "
                                 "{label: bad, surfaces.plane.fraction: 0.1}]\n")
        status, _, _ = self.study("wrong.yaml", "--no-pictures")
        self.assertEqual(status, 3)
        rows = self.rows("study_wrong", "wrong.csv")
        self.assertEqual((rows["good"]["status"], rows["bad"]["status"]), ("completed", "refused"))
        self.assertIn("unknown key", rows["bad"]["why"])

    def test_missed_expectation_and_bad_file(self):
        self.write("missed.yaml", f"scene: {SCENE}\nset: {{time.end_s: 0.02}}\nsweep: {{surfaces.plane.friction: [0.1, 0.2]}}\n"
                                  "expect: [{figure: particles, against: surfaces.plane.friction, trend: proportional}]\n")
        status, out, _ = self.study("missed.yaml", "--no-pictures")
        self.assertEqual(status, 1, out)
        self.assertIn("NOT as expected", out)
        status, _, err = self.study("none.yaml")
        self.assertEqual((status, err.count("\n")), (2, 1), err)


if __name__ == "__main__":
    unittest.main()
