#!/usr/bin/python3
"""Angles that come in as sentences are published as they were measured; release, forecast, ensemble and alarms go out as they
were published, a replay only as one; what is wrong is counted, or refused at the start."""
import json
import math
import os
import socket
import sys
import threading
import time
import unittest

import rospy
import rostest
from geocontainer_mpm.msg import (GeotextileForces, HullOpening, Quantiles, ReleaseAlarm, ReleaseEnsemble, ReleaseForecast,
                                  ReleaseStatus)
from geometry_msgs.msg import Point

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "vessel")]
from signalk_peer import HELLO, Peer, frame, frames_of, upgrade  # noqa: E402
from node_test import TERMINATE, NodeDiagnostics, start_node  # noqa: E402


def sentence(body):
    checksum = 0
    for character in body:
        checksum ^= ord(character)
    return f"${body}*{checksum:02X}\r\n"


def xdr(port, starboard):
    return sentence(f"IIXDR,C,19.5,C,AIR,A,{port},D,HULL_PORT,A,{starboard},D,HULL_STBD")


def free_port(kind):
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def connected(port):
    """A connection to a server that may still be starting."""
    for _ in range(200):
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=10.0)
        except OSError:
            time.sleep(0.1)
    raise AssertionError("the node does not listen")


class Recorder:
    """A Signal K server in small: keeps the newest value of each path, and sends back what it is told."""

    def __init__(self):
        self.changed = threading.Condition()
        self.values, self.stamps, self.sources = {}, {}, set()

    def __call__(self, connection):
        upgrade(connection)
        connection.sendall(frame(HELLO))
        for text in frames_of(connection):
            delta = json.loads(text)
            with self.changed:
                for update in delta.get("updates", []):
                    for entry in update.get("values", []):
                        self.values[entry["path"]] = entry["value"]
                        self.stamps[entry["path"]] = update["timestamp"]
                        self.sources.add(update["$source"])
                self.changed.notify_all()
            if "values" in text:
                connection.sendall(frame(text))

    def wait(self, test, path, value, limit_s=30.0):
        with self.changed:
            test.assertTrue(self.changed.wait_for(lambda: self.values.get(path) == value, limit_s),
                            f"{path}: {self.values.get(path)}, not {value}")


PREFIX = "cargo.geocontainer."
NOW = rospy.Time(1_795_694_400, 250_000_000)  # 2026-11-26T12:00:00.250Z


def status_with(*alarms, **fields):
    status = ReleaseStatus(outcome=ReleaseStatus.RELEASING, peak_tension=1000.0, **fields)
    status.header.stamp = NOW
    status.alarms = list(alarms)
    return status


def hung_up(level, acknowledged=False):
    return ReleaseAlarm(name="hung_up", level=level, latched=ReleaseAlarm.ALARM, acknowledged=acknowledged, since=NOW,
                        message="The container stands still")


def forecast():
    message = ReleaseForecast(outcome=ReleaseStatus.RELEASED, message="Out in 42 s", age=0.5,
                              release_time=NOW + rospy.Duration(42.5))
    message.header.stamp = NOW
    message.stamps = [NOW + rospy.Duration(i) for i in range(3)]
    message.tension, message.peak_tension, message.utilisation = [1e3, 5e4, 2e4], [3e3, 5e4, 5e4], [0.02, 0.25, 0.25]
    return message


def ensemble():
    message = ReleaseEnsemble(members=16, completed=15, hung_up=0.125, ruptured=0.0, advice=ReleaseEnsemble.RATE,
                              advised_rate=0.0125, slowest_rate=0.005, advice_complete=True, advised_utilisation=0.75, message="Slow down")
    message.header.stamp = NOW
    message.stamps = [NOW + rospy.Duration(i) for i in range(2)]
    message.tension_p10, message.tension_p50, message.tension_p90 = [1e3, 2e4], [2e3, 3e4], [3e3, 5e4]
    message.peak_tension, message.release_delay = Quantiles(4e4, 5e4, 7e4), Quantiles(38.0, 42.0, math.inf)
    return message


def forces():
    message = GeotextileForces(name="container", nodes=[Point(0, y, z) for y, z in ((-1, -1), (1, -1), (0, -3))],
                               tension=[1e4, 2e4, 3e4], utilisation=[0.05, 0.1, 0.15])
    message.header.stamp, message.header.frame_id = NOW, "base_link"
    return message


class VesselLinkTest(unittest.TestCase):
    def setUp(self):
        self.openings = []
        self.changed = threading.Condition()
        self.subscriber = rospy.Subscriber("/hull_opening", HullOpening, self.receive, queue_size=100)

    def receive(self, message):
        with self.changed:
            self.openings.append(message)
            self.changed.notify_all()

    def expect_openings(self, degrees):
        with self.changed:
            self.assertTrue(self.changed.wait_for(lambda: len(self.openings) >= len(degrees), 30.0), self.openings)
        expected = [(port * math.pi / 180.0, starboard * math.pi / 180.0) for port, starboard in degrees]
        self.assertEqual([(message.port, message.starboard) for message in self.openings], expected)
        for message in self.openings:
            self.assertLess(abs((rospy.Time.now() - message.header.stamp).to_sec()), 20.0)
            self.assertEqual(message.header.frame_id, "base_link")

    def start(self, name, parameters):
        node = start_node(name, dict(parameters, diagnostic_period=0.2), "vessel_link_node")
        self.addCleanup(node.__exit__)
        return node

    def wait_for_angles(self, send):
        """Until a first pair of angles has come all the way: a connection at this end alone does not mean that it is one at
        the other. What was sent for it is forgotten."""
        end = time.monotonic() + 60.0
        while not self.openings:
            self.assertLess(time.monotonic(), end, "no angles arrive")
            send(xdr(0.5, 0.5).encode())
            time.sleep(0.5)
        time.sleep(1.0)
        self.openings.clear()

    def test_udp_angles_arrive_exactly(self):
        diagnostics = NodeDiagnostics()
        port = free_port(socket.SOCK_DGRAM)
        node = self.start("udp_link", {"hull_angles": "nmea", "nmea": {"ports": [
            {"transport": "udp", "port": port, "receive": True}]}})
        diagnostics.wait(lambda d: d.level("nmea 1") is not None, 60.0, "the port is open")
        degrees = [(0.0, 0.0), (1.25, -0.5), (12.3456, 12.3457), (0.1, 0.3)]
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sensor:
            self.wait_for_angles(lambda sentence: sensor.sendto(sentence, ("127.0.0.1", port)))
            for both in degrees:
                sensor.sendto(xdr(*both).encode(), ("127.0.0.1", port))
            sensor.sendto(xdr(7, 7).replace("7", "9", 1).encode(), ("127.0.0.1", port))
            sensor.sendto(os.urandom(500), ("127.0.0.1", port))
        self.expect_openings(degrees)
        diagnostics.wait(lambda d: d.value("nmea 1", "ignored: bad checksum") == "1", 10.0, "a bad checksum counted")
        self.assertGreaterEqual(int(diagnostics.value("nmea 1", "hull angles in")), 10)
        self.assertTrue(diagnostics.warned("nmea 1", "bad checksum"), diagnostics.warnings)
        node.signal(TERMINATE)
        self.assertEqual(node.end()[0], 0)

    def test_tcp_angles_arrive_exactly_in_any_pieces(self):
        port = free_port(socket.SOCK_STREAM)
        self.start("tcp_link", {"hull_angles": "nmea", "nmea": {"ports": [
            {"transport": "tcp_server", "port": port, "receive": True}]}})
        degrees = [(0.5 * i, 0.25 * i) for i in range(40)]
        stream = ("noise\r\n" + "".join(xdr(*both) for both in degrees)).encode()
        with connected(port) as sensor:
            self.wait_for_angles(sensor.sendall)
            for i in range(0, len(stream), 7):
                sensor.sendall(stream[i:i + 7])
            self.expect_openings(degrees)

    def test_the_release_goes_out(self):
        port = free_port(socket.SOCK_STREAM)
        self.start("sending_link", {"nmea": {"ports": [
            {"transport": "tcp_server", "port": port, "send": True, "send_angles": True}]}})
        publisher = rospy.Publisher("/release_status", ReleaseStatus, queue_size=10)
        status = ReleaseStatus(outcome=ReleaseStatus.RELEASING, port=math.radians(10.0), starboard=math.radians(-0.5),
                               peak_tension=45670.0, current_tension=1200.0, peak_utilisation=0.457, width=4.5, lag=0.25)
        status.centroid.z = -2.5
        status.release_time = rospy.Duration(-1.0)
        status.header.stamp = rospy.Time.now()
        with connected(port) as display:
            while publisher.get_num_connections() == 0:
                time.sleep(0.05)
            publisher.publish(status)
            text = b""
            while text.count(b"\n") < 2:
                text += display.recv(4096)
        self.assertEqual(text.decode(), sentence("IIXDR,A,10.0000,D,HULL_PORT,A,-0.5000,D,HULL_STBD") +
                         sentence("PGCM,1,R,45.7,45670,1200,-2.50,4.50,,0.25"))

    def publisher(self, topic, kind):
        """Connected to the node under test."""
        publisher = rospy.Publisher(topic, kind, queue_size=10)
        self.addCleanup(publisher.unregister)
        end = time.monotonic() + 30.0
        while publisher.get_num_connections() == 0:
            self.assertLess(time.monotonic(), end, f"nobody listens to {topic}")
            time.sleep(0.05)
        return publisher

    def server(self):
        recorder = Recorder()
        peer = Peer(recorder)
        self.addCleanup(peer.close)
        return recorder, {"signalk": {"enabled": True, "port": peer.port}}

    def test_forecast_ensemble_and_section_arrive_as_they_were_published(self):
        diagnostics = NodeDiagnostics()
        recorder, parameters = self.server()
        self.start("forecast_link", parameters)
        self.publisher("/release_forecast", ReleaseForecast).publish(forecast())
        self.publisher("/release_ensemble", ReleaseEnsemble).publish(ensemble())
        self.publisher("/geotextile_forces", GeotextileForces).publish(forces())
        begin = NOW.to_sec()
        for path, value in {
                "forecast.state": "fresh", "forecast.outcome": "released", "forecast.message": "Out in 42 s",
                "forecast.release.instant": "2026-11-26T12:00:42.750Z", "forecast.release.delay": 42.0,
                "forecast.tension.peak": 5e4, "forecast.utilisation.peak": 0.25,
                "forecast.curve": {"time": [begin, begin + 1, begin + 2], "tension": [1e3, 5e4, 2e4]},
                "ensemble.members": 15, "ensemble.tension.p10": 4e4, "ensemble.tension.p50": 5e4, "ensemble.tension.p90": 7e4,
                "ensemble.tension.curve": {"time": [begin, begin + 1], "p10": [1e3, 2e4], "p50": [2e3, 3e4], "p90": [3e3, 5e4]},
                "ensemble.release.p10": 38.0, "ensemble.release.p50": 42.0, "ensemble.release.p90": None,
                "ensemble.probability.hung_up": 0.125, "ensemble.probability.ruptured": 0.0, "advice.state": "rate",
                "advice.rate": 0.0125, "advice.slowest": 0.005, "advice.utilisation": 0.75, "advice.message": "Slow down",
                "shape": {"y": [-1, 1, 0], "z": [-1, -1, -3], "utilisation": [0.05, 0.1, 0.15]},
                "hull.section": {"hinge": [0, 0], "y": [1.5, 0, 0, 2.5, 2.5], "z": [-4.3, -4.3, -3.9, -1.3, 0]}}.items():
            recorder.wait(self, PREFIX + path, value)
        self.assertEqual(recorder.stamps[PREFIX + "ensemble.members"], "2026-11-26T12:00:00.250Z")
        diagnostics.wait(lambda d: d.value("signal k", "confirmation") == "confirmed", 30.0, "all of it read back")

    def test_alarms_go_out_and_stay_until_they_are_acknowledged(self):
        recorder, parameters = self.server()
        port = free_port(socket.SOCK_STREAM)
        self.start("alarm_link", dict(parameters, nmea={"ports": [{"transport": "tcp_server", "port": port, "send": True}]}))
        publisher = self.publisher("/release_status", ReleaseStatus)
        path = "notifications." + PREFIX + "hung_up"
        shown = {"state": "alarm", "method": ["visual", "sound"], "message": "The container stands still"}
        with connected(port) as display:
            publisher.publish(status_with(hung_up(ReleaseAlarm.ALARM)))
            recorder.wait(self, path, shown)
            publisher.publish(status_with(hung_up(ReleaseAlarm.NORMAL)))  # has gone, and nobody has seen it
            recorder.wait(self, path, shown)
            publisher.publish(status_with(hung_up(ReleaseAlarm.ALARM, True)))
            recorder.wait(self, path, dict(shown, method=["visual"], acknowledged=True))
            publisher.publish(status_with(hung_up(ReleaseAlarm.NORMAL, True)))
            recorder.wait(self, path, dict(shown, state="normal", method=["visual"], acknowledged=True))
            expected = sentence("IIALR,120000.25,004,V,A,The container stands still")
            text = ""
            while expected not in text:
                text += display.recv(4096).decode()
        self.assertIn(sentence("IIALR,120000.25,004,A,V,The container stands still"), text)
        self.assertNotIn("notifications." + PREFIX + "release", recorder.values)

    def test_a_replay_is_marked_and_raises_nothing(self):
        diagnostics = NodeDiagnostics()
        recorder, parameters = self.server()
        live = self.start("live_link", parameters)
        publisher = self.publisher("/release_status", ReleaseStatus)
        publisher.publish(status_with(hung_up(ReleaseAlarm.ALARM), replay=True, current_tension=1.0))
        diagnostics.wait(lambda d: d.value("vessel link", "statuses of a replay, not sent") == "1", 30.0, "withheld")
        publisher.publish(status_with(current_tension=2.0))
        recorder.wait(self, PREFIX + "tension.current", 2.0)  # the replay's was before it
        self.assertNotIn("notifications." + PREFIX + "hung_up", recorder.values)
        live.signal(TERMINATE)
        self.assertEqual(live.end()[0], 0)
        publisher.unregister()

        recorder, parameters = self.server()
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        self.start("replay_link", dict(parameters, send_replays=True))
        publisher = self.publisher("/release_status", ReleaseStatus)
        publisher.publish(status_with(hung_up(ReleaseAlarm.ALARM), replay=True, current_tension=3.0))
        recorder.wait(self, PREFIX + "tension.current", 3.0)
        self.assertEqual(recorder.sources, {"geocontainer_mpm.replay"})
        self.assertEqual([path for path in recorder.values if path.startswith("notifications.")], [])

    def refused(self, parameters, *parts):
        with start_node("bad_link", parameters, "vessel_link_node") as node:
            status, _, error = node.end()
        self.assertEqual(status, 2, error)
        self.assertEqual(len(error.strip().splitlines()), 1, error)
        for part in parts:
            self.assertIn(part, error)

    def test_refusals(self):
        self.refused({"hull_angle": "nmea"}, "~hull_angle", "hull_angles")
        self.refused({"hull_angles": "gps"}, "~hull_angles", "gps")
        self.refused({"hull_angles": "nmea"}, "~nmea/ports", "receives")
        self.refused({"signalk": {"enabled": True, "token_file": "/no/such/token"}}, "token_file", "/no/such/token")
        self.refused({"signalk": {"enabled": True, "port": 70000}}, "~signalk/port", "65535")
        self.refused({"nmea": {"ports": [{"transport": "serial", "receive": True}]}}, "~nmea/ports[0]/transport", "serial")
        self.refused({"hull_angles": "nmea", "nmea": {"ports": [
            {"transport": "tcp_server", "port": 0, "receive": True, "send_angles": True}]}}, "send_angles", "come back")


if __name__ == "__main__":
    rospy.init_node("vessel_link_test")
    rostest.rosrun("geocontainer_mpm", "vessel_link_test", VesselLinkTest)
