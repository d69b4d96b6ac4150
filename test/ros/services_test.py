#!/usr/bin/python3
"""The services answer while steps are taken, and after ~reset the run can be repeated, bit for bit."""
import json
import os
import sys
import tempfile
import time
import unittest

import rospy
import rostest
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import NodeDiagnostics, play, start_node  # noqa: E402


class ServicesTest(unittest.TestCase):
    def call(self, service):
        begin = time.monotonic()
        reply = rospy.ServiceProxy(f"/release_node/{service}", Trigger)()
        self.assertLess(time.monotonic() - begin, 4.0, service)
        self.assertTrue(reply.success, f"{service}: {reply.message}")
        return reply.message

    def test_services(self):
        logs = rospy.get_param("~logs")
        bag = f"{logs}/hull_opening.bag"
        with open(f"{logs}/hull_opening.json", encoding="utf-8") as file:
            expected = json.load(file)["digest"]
        diagnostics = NodeDiagnostics()
        with tempfile.TemporaryDirectory() as folder, \
                start_node("release_node", {"scene": rospy.get_param("~scene"), "diagnostic_period": 0.1,
                                            "save_directory": folder, "finish_when_source_leaves": True}):
            rospy.wait_for_service("/release_node/reset", 30.0)
            with play(bag, "--rate", "2"):
                diagnostics.wait(lambda d: int(d.value("simulation", "steps") or 0) > 100, 20.0, "100 steps")
                self.assertIn("run 2", self.call("reset"))
                # The same log goes on: a run from its rest.
                diagnostics.wait(lambda d: d.value("simulation", "run") == "2" and
                                 int(d.value("simulation", "steps")) > 100, 20.0, "100 steps of run 2")
                self.call("stop")
                diagnostics.wait_for_state("paused", run=2)
                held = diagnostics.value("simulation", "steps")
                time.sleep(0.5)
                self.assertEqual(diagnostics.value("simulation", "steps"), held)
                self.call("start")
                self.call("reset")
            with play(bag, "--rate", "2"):  # the clock goes back: the whole log, from a fresh state
                diagnostics.wait(lambda d: expected in d.finished.values(), 30.0, "a run that ends as offline")
            path = self.call("save").split("summary in ")[1]
            with open(path, encoding="utf-8") as file:
                saved = json.load(file)
            self.assertEqual(saved["digest"], expected)
            self.assertEqual(saved["outcome"], "releasing")
            self.assertTrue(os.path.exists(path.replace(".json", ".h5")))


if __name__ == "__main__":
    rospy.init_node("services_test")
    rostest.rosrun("geocontainer_mpm", "services_test", ServicesTest)
