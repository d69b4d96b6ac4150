#!/usr/bin/python3
"""Killed with SIGKILL in the middle of the release, the node goes on from its checkpoint and ends bit for bit where the
undisturbed run ends: with the log played again from its start, and with the rest of it."""
import json
import os
import shutil
import sys
import tempfile
import unittest

import h5py
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import KILL, NodeDiagnostics, play, start_node  # noqa: E402


def frame_times(path):
    with h5py.File(path, "r") as file:
        return [frame["time"][()] for frame in file["frames"].values()]


class CheckpointTest(unittest.TestCase):
    def setUp(self):
        self.bag = rospy.get_param("~bag")
        with open(rospy.get_param("~expected"), encoding="utf-8") as file:
            self.expected = json.load(file)
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.state = os.path.join(self.folder, "state.h5")
        self.parameters = {"scene": rospy.get_param("~scene"), "diagnostic_period": 0.1, "threads": 1,
                           "finish_when_source_leaves": True, "checkpoint": self.state, "checkpoint_period_s": 0.2,
                           "record": os.path.join(self.folder, "run.h5")}

    def kill_in_the_middle(self):
        """Simulated instant of the checkpoint that was heard of last."""
        diagnostics = NodeDiagnostics()

        def saved(heard):
            return float(heard.value("simulation", "checkpoint of time (s)") or -1.0)

        with start_node("mortal_node", self.parameters) as node, play(self.bag):
            diagnostics.wait(lambda d: saved(d) > 1.5, 40.0, "a checkpoint in the middle of the release")
            node.signal(KILL)
            self.assertEqual(node.end(5.0)[0], -KILL)
        diagnostics.end()
        self.assertEqual(diagnostics.finished, {}, "killed too late")
        self.assertLess(saved(diagnostics), 4.0)
        return saved(diagnostics)

    def go_on(self, *options):
        """Diagnostics at the end of the resumed run."""
        diagnostics = NodeDiagnostics()
        with start_node("risen_node", self.parameters) as node, play(self.bag, *options):
            diagnostics.wait_for_state("finished", limit_s=40.0)
            node.signal(KILL)
        diagnostics.end()
        self.assertIn("goes on at", diagnostics.value("simulation", "resume"))
        self.assertEqual(diagnostics.finished, {2: self.expected["digest"]})
        self.assertEqual(int(diagnostics.value("simulation", "steps")), self.expected["steps"])
        self.assertGreater(int(diagnostics.value("hull opening", "known from the checkpoint")), 0)
        return diagnostics

    def test_goes_on_with_the_whole_log(self):
        saved_s = self.kill_in_the_middle()
        self.go_on()
        first, second = frame_times(self.parameters["record"]), frame_times(os.path.join(self.folder, "run_run2.h5"))
        self.assertEqual(first[0], 0.0)
        self.assertGreaterEqual(second[0], saved_s)
        self.assertLessEqual(second[0], first[-1] + 0.11, "no frame is missing between the two")
        self.assertEqual(second[-1], self.expected["simulated_time_s"])

    def test_goes_on_with_the_rest_of_the_log(self):
        saved_s = self.kill_in_the_middle()
        self.go_on("--start", f"{saved_s - 0.5:.3f}")

    def test_begins_anew_with_another_scene_and_says_why(self):
        self.kill_in_the_middle()
        self.parameters["scene_overrides"] = ["hull.friction=0.3"]
        diagnostics = NodeDiagnostics()
        with start_node("other_node", self.parameters):
            diagnostics.wait(lambda d: d.value("simulation", "resume") is not None, 30.0, "what became of it")
        diagnostics.end()
        self.assertIn("is of another scene: 'friction: 0.2' there, 'friction: 0.3' now",
                      diagnostics.value("simulation", "resume"))
        self.assertEqual(diagnostics.value("simulation", "steps"), "0")
        self.assertTrue(os.path.exists(self.state + ".unused"))


if __name__ == "__main__":
    rospy.init_node("checkpoint_test", disable_rostime=True)
    rostest.rosrun("geocontainer_mpm", "checkpoint_test", CheckpointTest)
