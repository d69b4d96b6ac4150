#!/usr/bin/python3
"""Angles that come in as sentences are published as they were measured; the release goes out as a sentence; what is wrong is
counted, or refused at the start."""
import math
import os
import socket
import sys
import threading
import time
import unittest

import rospy
import rostest
from geocontainer_mpm.msg import HullOpening, ReleaseStatus

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
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

    def wait_for_publisher(self):
        end = time.monotonic() + 30.0
        while self.subscriber.get_num_connections() == 0:
            self.assertLess(time.monotonic(), end, "the node does not publish")
            time.sleep(0.05)

    def test_udp_angles_arrive_exactly(self):
        diagnostics = NodeDiagnostics()
        port = free_port(socket.SOCK_DGRAM)
        node = self.start("udp_link", {"hull_angles": "nmea", "nmea": {"ports": [
            {"transport": "udp", "port": port, "receive": True}]}})
        self.wait_for_publisher()
        diagnostics.wait(lambda d: d.level("nmea 1") is not None, 20.0, "the port is open")
        degrees = [(0.0, 0.0), (1.25, -0.5), (12.3456, 12.3457), (0.1, 0.3)]
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sensor:
            for both in degrees:
                sensor.sendto(xdr(*both).encode(), ("127.0.0.1", port))
            sensor.sendto(xdr(7, 7).replace("7", "9", 1).encode(), ("127.0.0.1", port))
            sensor.sendto(os.urandom(500), ("127.0.0.1", port))
        self.expect_openings(degrees)
        diagnostics.wait(lambda d: d.value("nmea 1", "ignored: bad checksum") == "1", 10.0, "a bad checksum counted")
        self.assertEqual(diagnostics.value("nmea 1", "hull angles in"), "8")
        self.assertTrue(diagnostics.warned("nmea 1", "bad checksum"), diagnostics.warnings)
        node.signal(TERMINATE)
        self.assertEqual(node.end()[0], 0)

    def test_tcp_angles_arrive_exactly_in_any_pieces(self):
        port = free_port(socket.SOCK_STREAM)
        self.start("tcp_link", {"hull_angles": "nmea", "nmea": {"ports": [
            {"transport": "tcp_server", "port": port, "receive": True}]}})
        self.wait_for_publisher()
        degrees = [(0.5 * i, 0.25 * i) for i in range(40)]
        stream = ("noise\r\n" + "".join(xdr(*both) for both in degrees)).encode()
        with connected(port) as sensor:
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
