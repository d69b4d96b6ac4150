#!/usr/bin/python3
"""What release_forecast and release_ensemble carry during a replay, and that the live run ends as it does without them."""
import json
import math
import os
import sys
import threading
import time
import unittest

import rospy
import rostest
from geocontainer_mpm.msg import ReleaseEnsemble, ReleaseForecast, ReleaseStatus
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import NodeDiagnostics  # noqa: E402


class Received:
    def __init__(self, topic, kind):
        self.messages = []
        self._changed = threading.Condition()
        self._subscriber = rospy.Subscriber(topic, kind, self._take, queue_size=1000)

    def _take(self, message):
        with self._changed:
            self.messages.append(message)
            self._changed.notify_all()

    def wait(self, condition, what, limit_s=100.0):
        """The first message that meets the condition."""
        end = time.monotonic() + limit_s
        with self._changed:
            while True:
                for message in self.messages:
                    if condition(message):
                        return message
                left = end - time.monotonic()
                assert left > 0.0, f"not within {limit_s} s: {what}; {len(self.messages)} came"
                self._changed.wait(left)


def plan_of(port):
    trajectory = JointTrajectory(joint_names=["hull_starboard_joint", "hull_port_joint"])
    trajectory.header.stamp = rospy.Time.now()
    for after_s, angle in ((0.0, 0.02), (60.0, 0.02), (68.0, 0.3)):
        point = JointTrajectoryPoint(positions=[angle, angle if port else math.nan])
        point.time_from_start = rospy.Duration(after_s)
        trajectory.points.append(point)
    return trajectory


class ForecastTest(unittest.TestCase):
    def test_forecast(self):
        with open(rospy.get_param("~expected"), encoding="utf-8") as file:
            expected = json.load(file)["digest"]
        diagnostics = NodeDiagnostics()
        forecasts = Received("release_forecast", ReleaseForecast)
        ensembles = Received("release_ensemble", ReleaseEnsemble)
        plans = rospy.Publisher("opening_plan", JointTrajectory, queue_size=1, latch=True)

        measured = forecasts.wait(lambda m: m.assumption == ReleaseForecast.MEASURED, "a forecast")
        self.forecast(measured)
        plans.publish(plan_of(port=False))  # not a number: the one before stays, and that is the measured rate
        plans.publish(plan_of(port=True))
        planned = forecasts.wait(lambda m: m.assumption == ReleaseForecast.PLAN and m.outcome == ReleaseStatus.RELEASED,
                                 "a forecast under the plan")
        self.forecast(planned)
        self.assertGreater(planned.port[-1], 0.15)  # the log itself stays below 0.04
        self.assertTrue(any(m.stale for m in forecasts.messages), "nothing was withdrawn")

        self.ensemble(ensembles.wait(lambda m: m.advice == ReleaseEnsemble.ANY_RATE, "advice"))
        diagnostics.wait_for_state("finished", limit_s=60.0)
        self.assertEqual(diagnostics.finished[1], expected)

    def forecast(self, message):
        self.assertEqual(message.header.frame_id, "base_link")
        count = len(message.stamps)
        self.assertGreater(count, 1)
        for values in (message.port, message.starboard, message.tension, message.peak_tension, message.utilisation,
                       message.width):
            self.assertEqual(len(values), count)
            self.assertTrue(all(math.isfinite(value) for value in values))
        stamps = [stamp.to_sec() for stamp in message.stamps]
        self.assertEqual(stamps, sorted(stamps))
        self.assertAlmostEqual(stamps[0], message.header.stamp.to_sec(), places=6)
        if message.outcome == ReleaseStatus.RELEASED:
            self.assertGreater(message.release_time.to_sec(), stamps[0])
            self.assertIn("will leave the hull", message.message)
        self.assertGreater(message.peak_tension[-1], 0.0)
        self.assertGreaterEqual(message.cost, 0.0)
        self.assertGreaterEqual(message.age, 0.0)

    def ensemble(self, message):
        self.assertEqual((message.members, message.completed, message.seed), (3, 3, 1))
        self.assertEqual(message.inputs[0], "hull.friction")
        self.assertEqual(len(message.tension_correlation), len(message.inputs))
        self.assertLessEqual(message.peak_tension.p10, message.peak_tension.p90)
        self.assertGreater(len(message.stamps), 5)
        self.assertGreaterEqual(message.stamps[0], message.header.stamp)
        bands = list(zip(message.tension_p10, message.tension_p50, message.tension_p90))
        self.assertEqual(len(bands), len(message.stamps))
        self.assertTrue(all(0.0 <= low <= middle <= high for low, middle, high in bands), bands)
        self.assertEqual(message.advice, ReleaseEnsemble.ANY_RATE)
        self.assertAlmostEqual(message.advised_rate, 0.06)
        self.assertIn("deg/s", message.message)


if __name__ == "__main__":
    rospy.init_node("forecast_test")
    rostest.rosrun("geocontainer_mpm", "forecast", ForecastTest)
