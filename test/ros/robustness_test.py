#!/usr/bin/python3
"""The node from outside: processor time while nothing moves, what signals leave behind, samples that nobody could
believe."""
import os
import sys
import tempfile
import time
import unittest

import h5py
import rospy
import rostest
from geocontainer_mpm.msg import HullOpening
from rosgraph_msgs.msg import Clock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import INTERRUPT, KILL, TERMINATE, NodeDiagnostics, play, start_node  # noqa: E402


def idle_share(node, seconds=3.0):
    before, begin = node.cpu_s(), time.monotonic()
    time.sleep(seconds)
    return (node.cpu_s() - before) / (time.monotonic() - begin)


class NodeTestCase(unittest.TestCase):
    def setUp(self):
        self.bag = rospy.get_param("~bag")
        self.parameters = {"scene": rospy.get_param("~scene"), "diagnostic_period": 0.1, "threads": 1,
                           "finish_when_source_leaves": True}


class IdleTest(NodeTestCase):
    def test_idle_before_and_after(self):
        diagnostics = NodeDiagnostics()
        with start_node("idle_node", self.parameters) as node:
            diagnostics.wait_for_state("waiting for clock")
            self.assertLess(idle_share(node), 0.05)
            with play(self.bag, "--rate", "3"):
                diagnostics.wait_for_state("finished")
            time.sleep(1.0)
            self.assertLess(idle_share(node), 0.05)
            node.signal(INTERRUPT)
            self.assertEqual(node.end()[0], 0)


class RecordTest(NodeTestCase):
    def record_after(self, number):
        """Frames that can be read after the node got this signal in the middle of a run, and its exit status."""
        diagnostics = NodeDiagnostics()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.h5")
            with start_node(f"node_{number}", dict(self.parameters, record=path)) as node, play(self.bag):
                diagnostics.wait(lambda d: d.value("simulation", "record") == path and
                                 int(d.value("simulation", "recorded frames")) > 10, 25.0, "10 frames")
                told = int(diagnostics.value("simulation", "recorded frames"))
                node.signal(number)
                status = node.end(5.0)[0]
            with h5py.File(path, "r") as file:
                frames = [group for group in file.get("frames", file).values() if "time" in group or
                          "time" in group.attrs]
            self.assertGreaterEqual(len(frames), told)
        return status

    def test_killed_node_leaves_its_record(self):
        self.assertEqual(self.record_after(KILL), -KILL)

    def test_terminated_node_leaves_its_record_and_ends_cleanly(self):
        self.assertEqual(self.record_after(TERMINATE), 0)


class SamplesTest(NodeTestCase):
    def test_unbelievable_samples_are_rejected_and_counted(self):
        diagnostics = NodeDiagnostics()
        clock = rospy.Publisher("/clock", Clock, queue_size=10)
        opening = rospy.Publisher("/hull_opening", HullOpening, queue_size=100)
        now = 1_700_000_000.0

        def send(stamp_s, port, starboard):
            message = HullOpening(port=port, starboard=starboard)
            message.header.stamp = rospy.Time.from_sec(stamp_s) if stamp_s else rospy.Time()
            opening.publish(message)

        def rejected(reason, count):
            diagnostics.wait(lambda d: d.value("hull opening", f"rejected: {reason}") == str(count), 10.0,
                             f"{count} {reason}")

        with start_node("choosy_node", self.parameters):
            diagnostics.wait_for_state("waiting for clock")
            diagnostics.wait(lambda _: opening.get_num_connections() > 0, 10.0, "a subscription")
            for i in range(40):
                clock.publish(Clock(clock=rospy.Time.from_sec(now + 0.05 * i)))
                send(now + 0.05 * i, 0.0, 0.0)
                time.sleep(0.01)
            diagnostics.wait(lambda d: d.value("hull opening", "accepted") == "40", 10.0, "40 accepted")
            nan = float("nan")
            send(now + 2.00, nan, 0.0)
            rejected("non finite", 1)
            send(now + 2.01, float("inf"), float("-inf"))
            rejected("non finite", 2)
            send(now + 2.02, 3.0, 0.0)
            rejected("out of range", 1)
            send(now + 2.03, 0.3, 0.3)
            rejected("too fast", 1)
            send(now + 1.02, 0.0, 0.0)
            rejected("out of order", 1)
            send(now + 1.95, 0.0, 0.0)
            rejected("duplicate", 1)
            send(0.0, 0.0, 0.0)
            rejected("unstamped", 1)
            send(now + 500.0, 0.0, 0.0)
            rejected("from the future", 1)
            for reason in ("non finite", "out of range", "too fast", "out of order", "duplicate", "unstamped",
                           "from the future"):
                self.assertTrue(diagnostics.warned("hull opening", reason), diagnostics.warnings)
            # Nothing of this has stopped the prediction: samples are accepted and the hull moves on.
            send(now + 2.05, 0.0, 0.0)
            diagnostics.wait(lambda d: d.value("hull opening", "accepted") == "41", 10.0, "41 accepted")
            # Silence: the angle is held, and the run goes on to its end.
            for i in range(60):
                clock.publish(Clock(clock=rospy.Time.from_sec(now + 2.0 + 0.1 * i)))
                time.sleep(0.03)
            diagnostics.wait(lambda d: d.value("hull opening", "holding") == "true", 10.0, "holding")
            diagnostics.wait_for_state("finished")


if __name__ == "__main__":
    rospy.init_node("robustness_test", disable_rostime=True)
    case = next(case for case in (IdleTest, RecordTest, SamplesTest) if case.__name__ == rospy.get_param("~case"))
    rostest.rosrun("geocontainer_mpm", case.__name__, case)
