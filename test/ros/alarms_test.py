#!/usr/bin/python3
"""A lopsided log raises an alarm that falls, stays latched and is acknowledged; a weak seam raises another. In a replay
the diagnostics stay well; the same log as if it were measured now raises them, and its end is a silent sensor."""
import math
import os
import shutil
import sys
import tempfile
import threading
import time
import unittest

import rosbag
import rospy
import rostest
from geocontainer_mpm.msg import HullOpening, ReleaseAlarm, ReleaseStatus
from std_msgs.msg import Header
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import LEVEL_ERROR, NodeDiagnostics, play, start_node  # noqa: E402

NODE = "watched_node"
NAMES = ["sheet_utilisation", "seam_utilisation", "forecast_utilisation", "hung_up", "lopsided_opening", "sensor", "lag",
         "solver"]


def bump(time_s):
    """How much further port is open, rad: after the log's dropout up to 0.0675 and back, 0.075 rad/s."""
    return min(max(0.075 * (time_s - 2.6), 0.0), max(0.075 * (4.8 - time_s), 0.0), 0.0675)


def make_lopsided(source, target):
    """The log with port further open for a while."""
    with rosbag.Bag(source) as log, rosbag.Bag(target, "w") as lopsided:
        begin = log.get_start_time()
        for topic, message, stamp in log:
            if topic == "hull_opening":
                message.port += bump(message.header.stamp.to_sec() - begin)
            lopsided.write(topic, message, stamp)


class Statuses:
    """Every release_status that came."""

    def __init__(self):
        self._changed = threading.Condition()
        self.levels = {name: [0] for name in NAMES}     # every change
        self._latest = None
        self.bad = []
        self._subscriber = rospy.Subscriber("/release_status", ReleaseStatus, self._receive, queue_size=100)

    def _receive(self, status):
        with self._changed:
            self._latest = status
            if [alarm.name for alarm in status.alarms] != NAMES:
                self.bad.append("names")
            for alarm in status.alarms:
                if not math.isfinite(alarm.value) or not math.isfinite(alarm.lead_time) or alarm.latched < alarm.level:
                    self.bad.append(alarm)
                if self.levels[alarm.name][-1] != alarm.level:
                    self.levels[alarm.name].append(alarm.level)
            self._changed.notify_all()

    def alarm(self, name):
        return self._latest.alarms[NAMES.index(name)]

    def wait(self, name, condition, limit_s, what):
        end = time.monotonic() + limit_s
        with self._changed:
            while self._latest is None or not condition(self.alarm(name)):
                left = end - time.monotonic()
                assert left > 0.0, f"not within {limit_s} s: {what}; last heard: {self._latest}"
                self._changed.wait(min(left, 0.5))
            return self.alarm(name)

    def replay(self):
        return self._latest.replay


class AlarmTestCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.bag = os.path.join(self.folder, "lopsided.bag")
        make_lopsided(rospy.get_param("~bag"), self.bag)
        self.parameters = {"scene": rospy.get_param("~scene"), "diagnostic_period": 0.1, "threads": 2,
                           "fixed_frame": "base_link",
                           "scene_overrides": ["geotextiles.container.seam_efficiency=0.005", "time.end_s=30"],
                           "alarms": {"lopsided_warn_rad": 0.025, "lopsided_alarm_rad": 0.05, "fall_after_s": 0.3,
                                      "silence_alarm_s": 2.0}}

    def watch(self, statuses, diagnostics):
        """From the first rise to the acknowledgement."""
        raised = statuses.wait("lopsided_opening", lambda a: a.level == ReleaseAlarm.ALARM, 40.0, "lopsided")
        self.assertIn("Port is", raised.message)
        self.assertGreater(raised.value, 0.05)
        self.assertEqual(raised.unit, "rad")
        self.assertGreater(raised.since.to_sec(), 0.0)
        self.assertFalse(raised.acknowledged)
        over = statuses.wait("lopsided_opening", lambda a: a.level == ReleaseAlarm.NORMAL, 40.0, "level again")
        self.assertEqual(over.latched, ReleaseAlarm.ALARM)
        self.assertFalse(over.acknowledged)
        seam = statuses.wait("seam_utilisation", lambda a: a.latched == ReleaseAlarm.ALARM, 40.0, "the seam fails")
        self.assertIn("The seam is pulled to", seam.message)
        diagnostics.wait(lambda d: "latched alarm, not acknowledged" in (d.value("alarms", "lopsided_opening") or ""),
                         5.0, "diagnostics of it")
        reply = rospy.ServiceProxy(f"/{NODE}/acknowledge", Trigger)()
        self.assertTrue(reply.success)
        self.assertIn("lopsided_opening", reply.message)
        self.assertIn("seam_utilisation", reply.message)
        seen = statuses.wait("lopsided_opening", lambda a: a.latched == ReleaseAlarm.NORMAL, 5.0, "let go")
        self.assertFalse(seen.acknowledged)
        self.assertEqual(statuses.levels["lopsided_opening"], [0, 1, 2, 1, 0], "it chatters")
        self.assertEqual(statuses.bad, [])


class ReplayTest(AlarmTestCase):
    def test_a_replay_shows_alarms_and_raises_none(self):
        statuses, diagnostics = Statuses(), NodeDiagnostics()
        with start_node(NODE, self.parameters), play(self.bag):
            self.watch(statuses, diagnostics)
            self.assertTrue(statuses.replay())
            diagnostics.wait(lambda d: d.message("alarms").startswith("[replay]"), 5.0, "the mark")
        self.assertFalse([message for task, message in diagnostics.warnings if task == "alarms"])


class LiveTest(AlarmTestCase):
    def send(self):
        """The log with stamps of now."""
        publisher = rospy.Publisher("/hull_opening", HullOpening, queue_size=100)
        while publisher.get_num_connections() == 0:
            time.sleep(0.05)
        with rosbag.Bag(self.bag) as log:
            first, begin = log.get_start_time(), time.time()
            for _, message, _ in log.read_messages(topics="hull_opening"):
                due = begin + message.header.stamp.to_sec() - first
                time.sleep(max(0.0, due - time.time()))
                publisher.publish(HullOpening(port=message.port, starboard=message.starboard,
                                              header=Header(stamp=rospy.Time.from_sec(due))))

    def test_live_alarms_reach_the_diagnostics(self):
        statuses, diagnostics = Statuses(), NodeDiagnostics()
        with start_node(NODE, self.parameters):
            sender = threading.Thread(target=self.send, daemon=True)
            sender.start()
            self.watch(statuses, diagnostics)
            self.assertFalse(statuses.replay())
            self.assertEqual(diagnostics.worst("alarms"), LEVEL_ERROR)
            silent = statuses.wait("sensor", lambda a: a.level == ReleaseAlarm.ALARM, 20.0, "a silent sensor")
            self.assertIn("No believable opening for", silent.message)
            sender.join()


if __name__ == "__main__":
    rospy.init_node("alarms_test", disable_rostime=True)
    case = next(case for case in (ReplayTest, LiveTest) if case.__name__ == rospy.get_param("~case"))
    rostest.rosrun("geocontainer_mpm", case.__name__, case)
