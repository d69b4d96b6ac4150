#!/usr/bin/python3
"""The replayed log ends in the state in which the offline program ends, bit for bit, in every loop."""
import json
import os
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import NodeDiagnostics  # noqa: E402


class ReplayTest(unittest.TestCase):
    def test_ends_as_offline(self):
        diagnostics = NodeDiagnostics()
        with open(rospy.get_param("~expected"), encoding="utf-8") as file:
            expected = json.load(file)
        runs = rospy.get_param("~runs")
        diagnostics.wait(lambda d: len(d.finished) >= runs, 45.0, f"{runs} runs to their ends")
        for run, digest in diagnostics.finished.items():
            self.assertEqual(digest, expected["digest"], f"run {run}")
        self.assertEqual(sorted(diagnostics.finished), list(range(1, len(diagnostics.finished) + 1)))
        self.assertEqual(int(diagnostics.value("simulation", "steps")), expected["steps"])
        if rospy.get_param("~faults"):
            self.faults(diagnostics)

    def faults(self, diagnostics):
        """Every fault of the log is counted under its name and was warned of; the prediction went on."""
        for reason, count in (("duplicate", 1), ("non finite", 1), ("out of range", 1), ("out of order", 1)):
            self.assertEqual(diagnostics.value("hull opening", f"rejected: {reason}"), str(count), reason)
            self.assertTrue(diagnostics.warned("hull opening", f"1 {reason}"), diagnostics.warnings)
        self.assertGreaterEqual(int(diagnostics.value("hull opening", "rejected: too fast")), 1)
        self.assertTrue(diagnostics.warned("hull opening", "too fast"), diagnostics.warnings)
        self.assertEqual(diagnostics.value("hull opening", "gaps"), "1")
        self.assertTrue(diagnostics.warned("hull opening", "gap"), diagnostics.warnings)


if __name__ == "__main__":
    rospy.init_node("replay_test")
    rostest.rosrun("geocontainer_mpm", "replay_test", ReplayTest)
