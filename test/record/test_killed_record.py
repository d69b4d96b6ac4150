"""A record survives whatever ends its writer: every kill leaves a file with all frames that had been reported."""

import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

from record_reader import read_everything, read_sidecar

WRITER = sys.argv.pop(1)


class KilledRecord(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "run.h5")
        self.sidecar = os.path.join(self.folder.name, "run.xdmf")

    def write(self, *arguments):
        """Runs the writer and returns (exit status, frames reported; -1 if not even the file was)."""
        run = subprocess.run([WRITER, self.path, *map(str, arguments)], stdout=subprocess.PIPE, text=True, timeout=60)
        self.reports = run.stdout.splitlines()
        return run.returncode, len(self.reports) - 1

    def expect_record(self, reported):
        """Everything that was reported is there; at most the frame in progress is there besides."""
        frames = len(read_everything(self.path))
        self.assertIn(frames, (reported, reported + 1))
        times = read_sidecar(self.sidecar)
        self.assertIn(len(times), (reported, frames))

    def test_complete_run(self):
        status, reported = self.write(5, 6)
        self.assertEqual((status, reported), (0, 5))
        self.assertEqual(len(read_everything(self.path)), 5)
        self.assertEqual(read_sidecar(self.sidecar), [0.0, 10.0, 20.0, 30.0, 40.0])
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["run.h5", "run.xdmf"])

    def kill_at(self, change, *torn):
        status, reported = self.write(10, 3, change, *torn)
        self.assertEqual(status, -signal.SIGKILL)
        if reported >= 0:
            with self.subTest(change=change, torn=torn):
                self.expect_record(reported)

    def test_killed_at_every_change_on_disk(self):
        """At every change of the first frames, and of those where the index outgrows its first node of eight links."""
        self.assertEqual(self.write(10, 3), (0, 10))
        changes = [int(line.split()[2]) for line in self.reports[1:]]  # done when each frame stood
        self.assertGreater(changes[9] - changes[6], 3 * 20)
        for change in [*range(1, changes[1] + 1), *range(changes[6], changes[9] + 1)]:
            self.kill_at(change, "torn")
            if change % 3 == 0:
                self.kill_at(change)

    def test_killed_at_random_instants(self):
        chance = random.Random(20240229)
        for _ in range(40):
            writer = subprocess.Popen([WRITER, self.path, "100000", "12"], stdout=subprocess.PIPE, text=True)
            self.assertEqual(writer.stdout.readline(), "created\n")
            time.sleep(chance.uniform(0.0, 0.15))
            writer.send_signal(signal.SIGKILL)
            reported = len(writer.stdout.read().splitlines())
            writer.stdout.close()
            self.assertEqual(writer.wait(), -signal.SIGKILL)
            self.expect_record(reported)

    def test_new_run_leaves_an_open_reader_alone(self):
        self.assertEqual(self.write(3, 4)[0], 0)
        with h5py.File(self.path, "r") as old:
            self.assertEqual(self.write(2, 4)[0], 0)
            self.assertEqual(len(old["frames"]), 3)
            self.assertEqual(old["frames/000002/soil/position"].shape, (61, 3))
        self.assertEqual(len(read_everything(self.path)), 2)


if __name__ == "__main__":
    unittest.main()
