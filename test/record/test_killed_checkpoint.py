"""`simulate --checkpoint` killed at any instant leaves a whole file, and `--resume` ends where nothing had happened."""

import glob
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SIMULATE = sys.argv.pop(1)
SOURCE = sys.argv.pop(1)
SCENE = [
    os.path.join(SOURCE, "config/scenes/release.yaml"), "--angles", os.path.join(SOURCE, "config/logs/release.csv"),
    "--set", "grid.cell_size_m=0.4", "--set", "grid.upper_m=[6, 0.8]",
    "--set", "geotextiles.container.segment_length_m=0.4", "--threads", "1"]
CLOCKS = ("wall_time_s", "real_time_factor", "setup_time_s", "stages", "resumed_at_s")


class KilledCheckpoint(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_to_end(self, *options, status=0):
        run = subprocess.run([SIMULATE, *SCENE, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                             timeout=120)
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def summary(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return json.load(file)

    def test_resumes_after_every_kill(self):
        self.run_to_end("--until", "25", "--summary", self.path("undisturbed.json"))
        undisturbed = self.summary("undisturbed.json")
        chance = random.Random(20241126)
        saved, resumed_at, kills = self.path("state.h5"), [], 0
        while True:
            resume = ["--resume", saved] if os.path.exists(saved) else []
            run = subprocess.Popen([SIMULATE, *SCENE, "--until", "25", *resume, "--checkpoint", saved, "--checkpoint-period", "0",
                                    "--record", self.path(f"{kills}.h5"), "--summary", self.path("end.json")],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            try:  # the first one as soon as there is anything to resume from
                run.wait(chance.uniform(0.2, 0.6) if kills < 8 else 120)
            except subprocess.TimeoutExpired:
                run.send_signal(signal.SIGKILL)
            error = run.communicate()[1]
            if run.returncode == 0:
                break
            self.assertEqual(run.returncode, -signal.SIGKILL, error)
            kills += 1
        ended = self.summary("end.json")
        self.assertGreater(kills, 0)
        if resume:
            self.assertIsNotNone(ended["resumed_at_s"])
        for summary in (undisturbed, ended):
            for clock in CLOCKS:
                summary.pop(clock)
        self.assertEqual(ended, undisturbed)
        self.assertLessEqual(len(glob.glob(saved + ".*.part")), kills, "a kill leaves one file in the making at most")

    def test_a_request_to_stop_saves_the_state(self):
        saved = self.path("state.h5")
        run = subprocess.Popen([SIMULATE, *SCENE, "--until", "60", "--checkpoint", saved, "--checkpoint-period", "1e6"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not os.path.exists(saved):
            time.sleep(0.01)
        first = os.stat(saved).st_ino
        time.sleep(0.1)
        run.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(60), 128 + signal.SIGTERM)
        self.assertNotEqual(os.stat(saved).st_ino, first, "saved anew")

    def test_keeps_the_record_of_the_first_part(self):
        saved, record = self.path("state.h5"), self.path("out.h5")
        self.run_to_end("--until", "1", "--checkpoint", saved, "--record", record)
        run = self.run_to_end("--until", "2", "--resume", saved, "--record", record, status=2)
        self.assertIn("--record = " + record + ": exists", run.stderr)
        self.run_to_end("--until", "2", "--resume", saved, "--record", self.path("out_2.h5"))

    def test_refuses_another_scene(self):
        saved = self.path("state.h5")
        self.run_to_end("--until", "1", "--checkpoint", saved)
        run = self.run_to_end("--resume", saved, "--set", "hull.friction=0.3", status=2)
        self.assertEqual(run.stderr.count("\n"), 1)
        self.assertIn("'friction: 0.2' there, 'friction: 0.3' now", run.stderr)


if __name__ == "__main__":
    unittest.main()
