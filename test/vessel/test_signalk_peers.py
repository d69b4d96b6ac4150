#!/usr/bin/python3
"""The client against peers that are no Signal K server: dead, silent, talking garbage, endless. It lives, its memory stays
flat, it connects when a peer that behaves comes back, and it ends at once when asked to."""
import os
import socket
import struct
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from signalk_peer import HELLO, Peer, echo, frame, upgrade  # noqa: E402
from signalk_server import Probe, eventually  # noqa: E402

PROGRAM = sys.argv.pop(1)


def at_once(_):
    """Closes."""


def silent(connection):
    connection.recv(4096)
    time.sleep(15.0)


def not_http(connection):
    connection.sendall(os.urandom(100_000))
    connection.recv(4096)


def endless_header(connection):
    connection.sendall(b"HTTP/1.1 101 Switching Protocols\r\n")
    for _ in range(100_000):
        connection.sendall(b"X-More: " + b"a" * 1000 + b"\r\n")


def no_hello(connection):
    upgrade(connection)
    time.sleep(15.0)


def garbage_after_hello(connection):
    upgrade(connection)
    connection.sendall(frame(HELLO))
    while True:
        connection.sendall(frame('{"updates":[' + "[" * 50 + '"}'))


def noise_after_hello(connection):
    upgrade(connection)
    connection.sendall(frame(HELLO))
    connection.sendall(os.urandom(10_000))
    connection.recv(4096)


def huge_message(connection):
    upgrade(connection)
    connection.sendall(frame(HELLO))
    connection.sendall(bytes([0x81, 127]) + struct.pack(">Q", 1 << 40))
    for _ in range(2000):
        connection.sendall(b"[" * 65536)


def deaf(connection):
    """Says hello and answers nothing more, not even a ping."""
    upgrade(connection)
    connection.sendall(frame(HELLO))
    time.sleep(15.0)


class PeersTest(unittest.TestCase):
    def peer(self, behaviour):
        peer = Peer(behaviour)
        self.addCleanup(peer.close)
        return peer

    def survives(self, behaviour, attempts=3):
        """Some attempts with this peer, then one with a peer that behaves."""
        peer = self.peer(behaviour)
        probe = Probe(PROGRAM, peer.port)
        self.addCleanup(probe.process.kill)
        eventually(lambda: peer.connections >= 1, "a first attempt")
        memory = probe.memory_kib()
        number = 0
        while peer.connections < attempts:
            probe.send({"cargo.geocontainer.tension.peak": float(number)})
            number += 1
            time.sleep(0.02)
            self.assertLess(number, 5000, f"{peer.connections} attempts; {probe.health()}")
        health = probe.health()
        self.assertNotEqual(health["confirmation"], "confirmed")
        self.assertLess(probe.memory_kib() - memory, 6144, "memory is not flat")
        peer.behaviour = echo
        eventually(lambda: probe.health()["confirmation"] == "confirmed", f"connected again: {probe.health()}")
        probe.close()
        return health

    def test_closes_at_once(self):
        self.assertIn("upgrade", self.survives(at_once)["last_error"])

    def test_silent(self):
        self.survives(silent, attempts=2)

    def test_not_http(self):
        self.survives(not_http)

    def test_endless_header(self):
        self.survives(endless_header)

    def test_no_hello(self):
        self.assertIn("hello", self.survives(no_hello, attempts=2)["last_error"])

    def test_garbage_after_hello(self):
        health = self.survives(garbage_after_hello)
        self.assertGreaterEqual(health["bad_messages"], 100)
        self.assertIn("not Signal K", health["last_error"])

    def test_noise_after_hello(self):
        self.survives(noise_after_hello)

    def test_huge_message(self):
        self.survives(huge_message)

    def test_deaf(self):
        self.survives(deaf, attempts=2)

    def test_nobody_there(self):
        gone = socket.create_server(("127.0.0.1", 0))
        port = gone.getsockname()[1]
        gone.close()
        probe = Probe(PROGRAM, port)
        self.addCleanup(probe.process.kill)
        health = eventually(lambda: (lambda h: h if h["failures"] > 2 else None)(probe.health()), "three attempts")
        self.assertIn("connect", health["last_error"])
        # Doubling with jitter: at most 1 s apart here, and not in a busy loop.
        self.assertLess(health["failures"], 40)
        probe.close()

    def test_ends_at_once_in_the_middle_of_everything(self):
        for behaviour in (silent, no_hello, deaf, echo):
            peer = self.peer(behaviour)
            probe = Probe(PROGRAM, peer.port)
            self.addCleanup(probe.process.kill)
            eventually(lambda: peer.connections >= 1, "a connection")
            time.sleep(0.2)
            probe.close()


if __name__ == "__main__":
    unittest.main(verbosity=2)
