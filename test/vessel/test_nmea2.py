#!/usr/bin/python3
"""Our sentences against those of another hand, pynmea2 (Debian: python3-nmea2), both ways."""
import json
import math
import random
import subprocess
import sys
import unittest

try:
    import pynmea2
except ImportError:
    print("SKIPPED: python3-nmea2 is not installed", flush=True)
    sys.exit(77)

PROGRAM = sys.argv.pop(1)


def read(text):
    """Angles and counts that vessel_probe finds in these bytes."""
    out = subprocess.run([PROGRAM, "nmea"], input=text.encode(), capture_output=True, check=True).stdout
    lines = [json.loads(line) for line in out.splitlines()]
    return lines[:-1], lines[-1]


def written(port, starboard, peak_tension):
    request = json.dumps({"port": port, "starboard": starboard, "peak_tension": peak_tension})
    out = subprocess.run([PROGRAM, "write_nmea", request], capture_output=True, text=True, check=True).stdout
    return out.splitlines()


class Nmea2Test(unittest.TestCase):
    def test_their_sentences_are_read(self):
        chance = random.Random(20161)
        angles, text = [], ""
        for _ in range(200):
            port, starboard = (f"{chance.uniform(-30.0, 30.0):.{chance.randrange(6)}f}" for _ in range(2))
            angles += [("port", float(port)), ("starboard", float(starboard))]
            fields = ("A", port, "D", "HULL_PORT", "C", "19.5", "C", "TempAir", "A", starboard, "D", "HULL_STBD")
            text += str(pynmea2.XDR("II", "XDR", fields)) + "\r\n"
            text += str(pynmea2.HDT("GP", "HDT", ("123.4", "T"))) + "\r\n"
        found, counts = read(text)
        self.assertEqual(counts["sentences"], 400)
        self.assertEqual(sum(counts["faults"].values()), 0)
        self.assertEqual([(angle["half"], angle["rad"]) for angle in found],
                         [(half, degrees * math.pi / 180.0) for half, degrees in angles])

    def test_our_sentences_are_read(self):
        chance = random.Random(20161)
        for _ in range(50):
            port, starboard = chance.uniform(-6.0, 6.0), chance.uniform(-6.0, 6.0)
            xdr, release = (pynmea2.parse(line, check=True) for line in written(port, starboard, 45678.9))
            self.assertIsInstance(xdr, pynmea2.XDR)
            self.assertEqual(xdr.talker, "II")
            transducers = [xdr.get_transducer(i) for i in range(xdr.num_transducers)]
            self.assertEqual([(t.type, t.units, t.id) for t in transducers],
                             [("A", "D", "HULL_PORT"), ("A", "D", "HULL_STBD")])
            for transducer, angle in zip(transducers, (port, starboard)):
                self.assertAlmostEqual(float(transducer.value), math.degrees(angle), delta=0.5e-4 + 1e-9)  # last decimal
            self.assertIsInstance(release, pynmea2.ProprietarySentence)
            self.assertEqual(release.manufacturer, "GCM")
            self.assertEqual(release.data[1:5], ["1", "R", "", "45679"])

    def test_corrupted_sentences_are_counted_and_ignored(self):
        good = str(pynmea2.XDR("II", "XDR", ("A", "1.5", "D", "HULL_PORT")))
        wrong = good.replace("1.5", "7.5")
        found, counts = read(f"{wrong}\r\n{good}\r\nnonsense\r\n{good[:-3]}\r\n")
        self.assertEqual(len(found), 1)
        self.assertEqual(counts["faults"]["bad checksum"], 1)
        self.assertEqual(counts["faults"]["no checksum"], 1)
        self.assertEqual(counts["faults"]["noise"], 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
