#!/usr/bin/python3
"""Every bad parameter or scene ends in one line that names it, and exit status 2."""
import os
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import start_node  # noqa: E402


class BadInputTest(unittest.TestCase):
    def refused(self, parameters, *parts):
        with start_node("bad_node", parameters) as node:
            status, _, error = node.end()
        self.assertEqual(status, 2, error)
        lines = error.strip().splitlines()
        self.assertEqual(len(lines), 1, error)
        for part in parts:
            self.assertIn(part, lines[0])

    def test_refusals(self):
        scene = rospy.get_param("~scene")
        self.refused({}, "~scene")
        self.refused({"scene": "/no/such/scene.yaml"}, "/no/such/scene.yaml")
        self.refused({"scene": scene, "thread": 2}, "~thread", "threads")
        self.refused({"scene": scene, "threads": 0}, "~threads", "1 to 256")
        self.refused({"scene": scene, "threads": "two"}, "~threads", "two")
        self.refused({"scene": scene, "publish_rate_hz": float("nan")}, "~publish_rate_hz", "nan")
        self.refused({"scene": scene, "record": "/no/such/folder/r.h5"}, "~record", "/no/such/folder")
        self.refused({"scene": scene, "scene_overrides": ["hull.friktion=0.3"]}, "hull.friktion")
        self.refused({"scene": scene, "scene_overrides": ["hull.friction=-1"]}, "hull.friction", "-1")
        self.refused({"scene": rospy.get_param("~no_hull")}, "hull", "missing")


if __name__ == "__main__":
    rospy.init_node("bad_input_test")
    rostest.rosrun("geocontainer_mpm", "bad_input_test", BadInputTest)
