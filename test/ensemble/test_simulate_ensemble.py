"""`simulate --ensemble`: the same files for any number of threads and ranks; members that fail are named."""

import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SIMULATE = sys.argv.pop(1)
SOURCE = sys.argv.pop(1)
BLOCK = os.path.join(SOURCE, "config/scenes/block_on_incline.yaml")
DRAW = """
draw:
  surfaces.plane.friction: { uniform: { low: 0.1, high: 0.5 } }
  materials.block.young_modulus_pa: { lognormal: { median: 1.0e+6, factor: 1.3, low: 5.0e+5, high: 2.0e+6 } }
"""
MPIRUN = shutil.which("mpirun")


def has_mpi():
    """Whether simulate was built with MPI and there is an mpirun."""
    text = subprocess.run([SIMULATE, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return MPIRUN is not None and "mpirun" in text


class Ensemble(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.distributions = self.write("unsure.yaml", DRAW)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def run_ensemble(self, *options, before=(), members=7, until="0.15", status=0, distributions=None):
        run = subprocess.run(
            [*before, SIMULATE, BLOCK, "--until", until, "--ensemble", str(members), "--distributions",
             distributions or self.distributions, "--members", self.path("members.csv"), "--summary",
             self.path("summary.json"), *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        return run

    def files(self, *options, **more):
        out = self.run_ensemble(*options, **more).stdout
        return self.read("members.csv"), self.read("summary.json"), out

    def rows(self):
        return list(csv.DictReader(self.read("members.csv").splitlines()))

    def test_files_do_not_depend_on_threads(self):
        one = self.files("--threads", "1")
        for threads in ("2", "3"):
            self.assertEqual(self.files("--threads", threads), one)
        self.assertNotEqual(self.files("--seed", "2")[0], one[0])

    def test_files_do_not_depend_on_ranks(self):
        if not has_mpi():
            print("SKIPPED: no MPI")
            self.skipTest("no MPI")
        alone = self.files()
        for ranks in ("1", "2", "4"):
            mpirun = [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-n", ranks]
            self.assertEqual(self.files(before=mpirun), alone, f"{ranks} ranks")
        run = subprocess.run([*mpirun, SIMULATE, BLOCK, "--ensemble", "7", "--distributions", "/nowhere.yaml"],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stderr.count("/nowhere.yaml: distributions: cannot be read"), 1, run.stderr)

    def test_a_member_is_the_run_with_its_values(self):
        self.run_ensemble()
        rows = self.rows()
        self.assertEqual([row["member"] for row in rows], [str(i) for i in range(1, 8)])
        keys = ["surfaces.plane.friction", "materials.block.young_modulus_pa"]
        values = [arg for key in keys for arg in ("--set", f"{key}={rows[4][key]}")]
        subprocess.run([SIMULATE, BLOCK, "--until", "0.15", *values, "--summary", self.path("one.json")],
                       stdout=subprocess.DEVNULL, check=True)
        one = json.loads(self.read("one.json"))
        self.assertEqual(rows[4]["digest"], one["digest"])
        self.assertEqual(float(rows[4]["container_width_m"]), one["container_width_m"])

    def test_summary_says_what_was_drawn_and_what_came_of_it(self):
        self.run_ensemble(members=12)
        summary = json.loads(self.read("summary.json"))
        self.assertEqual((summary["members"], summary["completed"], summary["failed"]), (12, 12, []))
        self.assertEqual(summary["outcomes"], {"none": 12})
        self.assertEqual(summary["inputs"]["surfaces.plane.friction"],
                         {"distribution": "uniform", "low": 0.1, "high": 0.5})
        self.assertIsNone(summary["figures"]["release_time_s"]["p50"], "nothing is released")
        widths = sorted(float(row["container_width_m"]) for row in self.rows())
        self.assertAlmostEqual(summary["figures"]["container_width_m"]["p50"], 0.5 * (widths[5] + widths[6]), 12)
        for figure in summary["figures"].values():
            self.assertEqual(list(figure["rank_correlation"]), list(summary["inputs"]))

    def test_names_members_that_fail(self):
        """From rest the block has 0.6 m to go until it leaves a grid that ends at -0.8 m: 0.9 s at a friction of 0.395."""
        run = self.run_ensemble("--set", "grid.lower_m=[-1.5, -0.8]", until="0.9", status=3)
        summary, rows = json.loads(self.read("summary.json")), self.rows()
        smooth = [row for row in rows if float(row["surfaces.plane.friction"]) < 0.37]
        rough = [row for row in rows if float(row["surfaces.plane.friction"]) > 0.42]
        self.assertGreaterEqual(len(smooth), 4)
        self.assertGreaterEqual(len(rough), 1)
        for row in smooth:
            self.assertEqual((row["ending"], row["outcome"], row["digest"]), ("failed", "", ""))
            self.assertIn("left the grid", row["why"])
            self.assertIn(f"member {row['member']} failed: the solver stopped", run.stdout)
            self.assertIn(int(row["member"]), [one["member"] for one in summary["failed"]])
        for row in rough:
            self.assertEqual((row["ending"], row["why"]), ("completed", ""))
        self.assertEqual(summary["completed"] + len(summary["failed"]), 7)

    def test_refuses_what_cannot_be_drawn(self):
        for draw, words in (
                ("draw: { surfaces.plane.fricton: { uniform: { low: 0, high: 1 } } }", "did you mean friction"),
                ("draw: { surfaces.plane.friction: { uniform: { low: -2, high: -1 } } }", "surfaces.plane.friction = -"),
                ("draw: { surfaces.plane.friction: { uniform: { low: 1 } } }", "uniform.high: missing")):
            run = self.run_ensemble(distributions=self.write("bad.yaml", draw), status=2)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(words, run.stderr)
        run = self.run_ensemble("--set", "surfaces.plane.friction=0.3", status=2)
        self.assertIn("is drawn by", run.stderr)
        self.assertFalse(os.path.exists(self.path("members.csv")))


if __name__ == "__main__":
    unittest.main()
