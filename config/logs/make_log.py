#!/usr/bin/python3
"""Makes the recorded barge log of a release: PREFIX.bag and PREFIX.csv with the same samples.

The log is synthetic but looks like one from a vessel: 20 Hz with jittering stamps, sensor noise and quantisation, a
dropout, a message sent twice, one spike, recorded with a transport delay. The barge rolls, pitches and heaves on /tf.
Seed and epoch are fixed, so the same arguments give the same samples.

    make_log.py                                    release.bag and release.csv beside this file
    make_log.py --output /tmp/j --joint-states     the angles as sensor_msgs/JointState on joint_states instead
    make_log.py --output /tmp/f --faults           in addition: a NaN, an angle out of range, a sample out of order
    make_log.py --output /tmp/s --short 6          a 6 s log with the same rates and anomalies, opening less far
"""
import argparse
import collections
import csv
import math
import os
import sys

import genpy
import genpy.dynamic
import numpy as np
import rosbag
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

RATE_HZ = 20
EPOCH_NS = 1_750_150_800 * 10**9    # 2025-06-17 09:00:00 UTC
FULL_LENGTH_S = 60.0
CLOSED_S = 5.0                      # before the opening starts
OPENING_S = 25.0
RAMP_S = 5.0                        # the hydraulics take this long to reach and to leave the constant rate
FULL_OPENING_RAD = 0.365            # about 21 degrees
STARBOARD_DELAY_S = 0.28            # starboard follows port, 0.3 degrees behind at the constant rate
NOISE_RAD = math.radians(0.1)       # standard deviation
QUANTUM_RAD = math.radians(0.05)
STAMP_JITTER_S = 0.5e-3             # standard deviation
SPIKE_RAD = math.radians(15.0)
DROPOUT_S = 1.0
JOINTS = ["hull_port_joint", "hull_starboard_joint"]

Sample = collections.namedtuple("Sample", "stamp_ns received_ns port starboard")


def opening(time_s, scale):
    """Opening angle, rad: a rate that ramps up, stays and ramps down, with continuous acceleration.

    `scale` shortens the whole profile in time and angle, so that the rate is the same.
    """
    length, ramp = OPENING_S * scale, RAMP_S * scale
    rate = FULL_OPENING_RAD * scale / (length - ramp)

    def ramped(t):  # integral of the smoothstep 3 s^2 - 2 s^3 over a ramp, then constant
        s = np.clip(t / ramp, 0.0, 1.0)
        return ramp * (s**3 - 0.5 * s**4) + np.maximum(t - ramp, 0.0)

    t = np.asarray(time_s) - CLOSED_S * scale
    return rate * (ramped(t) - ramped(t - (length - ramp)))


def make_samples(duration_s, faults):
    """The samples in the order in which they were received."""
    scale = duration_s / FULL_LENGTH_S
    random = np.random.default_rng(20250617)
    count = int(round(duration_s * RATE_HZ)) + 1
    time = np.arange(count) / RATE_HZ
    time[1:] += np.clip(random.normal(0.0, STAMP_JITTER_S, count - 1), -5e-3, 5e-3)
    true = np.stack([opening(time, scale), opening(time - STARBOARD_DELAY_S, scale)], axis=1)
    angle = np.round((true + random.normal(0.0, NOISE_RAD, true.shape)) / QUANTUM_RAD) * QUANTUM_RAD
    delay = random.uniform(5e-3, 20e-3, count)

    start, length = CLOSED_S * scale, OPENING_S * scale
    dropout = start + 0.4 * length
    spike = int(round(max(start + 0.62 * length, dropout + DROPOUT_S + 0.3) * RATE_HZ))
    twice = int(round((start + 0.2 * length) * RATE_HZ))
    angle[spike, 0] += SPIKE_RAD
    if faults:
        angle[spike + 7, 1] = math.nan
        angle[spike + 12, 0] = 2.0
        late = twice + 6            # received after the sample that follows it
        delay[late] += 1.5 / RATE_HZ

    samples = []
    for i in range(count):
        if dropout < time[i] < dropout + DROPOUT_S:
            continue
        stamp = EPOCH_NS + int(round(time[i] * 1e9))
        received = stamp + int(round(delay[i] * 1e9))
        samples.append(Sample(stamp, received, float(angle[i, 0]), float(angle[i, 1])))
        if i == twice:
            samples.append(samples[-1]._replace(received_ns=received + 1_000_000))
    return sorted(samples, key=lambda sample: sample.received_ns)


def hull_opening_class():
    """The message class from the text of msg/HullOpening.msg: the package need not be built to make its log."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "msg", "HullOpening.msg")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    text += "\n" + "=" * 80 + "\nMSG: std_msgs/Header\n" + Header._full_text
    return genpy.dynamic.generate_dynamic("geocontainer_mpm/HullOpening", text)["geocontainer_mpm/HullOpening"]


def stamp_of(ns):
    return genpy.Time(ns // 10**9, ns % 10**9)


def header_of(sequence, stamp_ns, frame):
    return Header(seq=sequence, stamp=stamp_of(stamp_ns), frame_id=frame)


def barge_pose(sequence, stamp_ns):
    t = (stamp_ns - EPOCH_NS) / 1e9
    roll = math.radians(1.5) * math.sin(2 * math.pi * t / 8.0)
    pitch = math.radians(0.3) * math.sin(2 * math.pi * t / 9.0 + 1.0)
    pose = TransformStamped(header=header_of(sequence, stamp_ns, "map"), child_frame_id="base_link")
    pose.transform.translation.z = 0.15 * math.sin(2 * math.pi * t / 7.0)
    cr, sr, cp, sp = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    rotation = pose.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = sr * cp, cr * sp, -sr * sp, cr * cp
    return TFMessage(transforms=[pose])


def write_bag(path, samples, duration_s, joint_states):
    hull_opening = hull_opening_class()
    entries = []
    for sequence, sample in enumerate(samples):
        if joint_states:
            topic = "joint_states"
            message = JointState(header=header_of(sequence, sample.stamp_ns, ""), name=JOINTS,
                                 position=[sample.port, sample.starboard])
        else:
            topic = "hull_opening"
            message = hull_opening(header=header_of(sequence, sample.stamp_ns, "base_link"), port=sample.port,
                                   starboard=sample.starboard)
        entries.append((sample.received_ns, topic, message))
    for i in range(int(round(duration_s * RATE_HZ)) + 1):
        stamp_ns = EPOCH_NS + i * 10**9 // RATE_HZ
        entries.append((stamp_ns + 2_000_000, "/tf", barge_pose(i, stamp_ns)))
    with rosbag.Bag(path, "w", compression=rosbag.Compression.BZ2) as bag:
        for received_ns, topic, message in sorted(entries, key=lambda entry: entry[0]):
            bag.write(topic, message, stamp_of(received_ns))


def write_csv(path, samples):
    """Times since the first sample to the nanosecond and angles to the last bit: the file stands for the bag exactly."""
    first_ns = samples[0].stamp_ns
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time_s", "port_rad", "starboard_rad"])
        for sample in samples:
            ns = sample.stamp_ns - first_ns
            sign = "-" if ns < 0 else ""
            writer.writerow([f"{sign}{abs(ns) // 10**9}.{abs(ns) % 10**9:09d}", repr(sample.port),
                             repr(sample.starboard)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    here = os.path.dirname(os.path.abspath(__file__))
    parser.add_argument("--output", metavar="PREFIX", default=os.path.join(here, "release"),
                        help="path without extension (default: %(default)s)")
    parser.add_argument("--joint-states", action="store_true", help="write JointState on joint_states instead")
    parser.add_argument("--faults", action="store_true", help="plant a NaN, an angle out of range and a late sample too")
    parser.add_argument("--short", metavar="SECONDS", type=float, default=FULL_LENGTH_S,
                        help="length of the log, at least 6 s (default: %(default)s)")
    arguments = parser.parse_args()
    if not 6.0 <= arguments.short <= 3600.0:
        sys.exit(f"make_log.py: --short {arguments.short}: must be in [6, 3600] s")
    samples = make_samples(arguments.short, arguments.faults)
    write_csv(arguments.output + ".csv", samples)
    write_bag(arguments.output + ".bag", samples, arguments.short, arguments.joint_states)
    print(f"{arguments.output}.bag and .csv: {len(samples)} samples over {arguments.short:g} s")


if __name__ == "__main__":
    main()
