#!/usr/bin/python3
"""Replays the default log at the speed of the clock through the node with its forecasts on, and compares what they said with
what the live run found: docs/forecast.csv and .png, and a summary on standard output. Needs the build with ROS, sourced.

    forecast.py [--set hull.friction=0.3] [--out docs]
"""
import argparse
import csv
import math
import os
import subprocess
import sys
import threading
import time

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import rosgraph  # noqa: E402
import rosnode  # noqa: E402
import rospy  # noqa: E402
from geocontainer_mpm.msg import ReleaseEnsemble, ReleaseForecast, ReleaseStatus  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
COARSE = "grid.cell_size_m=0.2,geotextiles.container.segment_length_m=0.2"
TICKS = os.sysconf("SC_CLK_TCK")


class Listener:
    """All that was said, each with the time of the log at which it arrived."""

    def __init__(self):
        self.lock = threading.Lock()
        self.said = {"forecast": [], "ensemble": [], "status": []}
        for topic, kind in (("release_forecast", ReleaseForecast), ("release_ensemble", ReleaseEnsemble),
                            ("release_status", ReleaseStatus)):
            name = topic.split("_")[1]
            rospy.Subscriber(topic, kind, self.take, callback_args=name, queue_size=1000)

    def take(self, message, name):
        with self.lock:
            self.said[name].append((rospy.Time.now().to_sec(), message))

    def of(self, name):
        with self.lock:
            return list(self.said[name])


def percentile(values, part):
    values = sorted(values)
    return values[min(len(values) - 1, int(part * len(values)))] if values else math.nan


def cpu_times(pid):
    """User and system time of a process, s, live run and runs ahead together."""
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return int(fields[11]) / TICKS, int(fields[12]) / TICKS


def pid_of(node):
    return rosnode.get_api_uri(rosgraph.Master("/forecast_bench"), node) and int(
        subprocess.run(["pgrep", "-n", "-x", "release_node"], capture_output=True, text=True, check=True).stdout)


def replay(overrides, rate, player_end_s):
    launch = subprocess.Popen(["roslaunch", os.path.join(ROOT, "launch", "replay.launch"), "rviz:=false", "view:=false",
                               f"rate:={rate}", f"set:={','.join(overrides)}",
                               f"forecast:={ROOT}/config/forecast.yaml"], stdout=subprocess.DEVNULL)
    while not rosgraph.is_master_online():
        time.sleep(0.1)
    while not rosgraph.Master("/forecast_bench").hasParam("/use_sim_time"):
        time.sleep(0.1)
    rospy.init_node("forecast_bench", anonymous=True)
    listener = Listener()
    began = time.monotonic()
    usage = None
    while launch.poll() is None and time.monotonic() - began < player_end_s / rate + 120.0:
        time.sleep(0.2)
        status = listener.of("status")
        if status and usage is None:
            usage = pid_of("/release_node")
        if status and status[-1][1].outcome == ReleaseStatus.RELEASED and status[-1][1].resting and \
                status[-1][0] - status[0][0] > player_end_s:
            break
    cpu = cpu_times(usage)
    launch.terminate()
    launch.wait(20)
    return listener, cpu


def first_motion(status):
    for arrived, message in status:
        if max(message.port, message.starboard) > 0.0:
            return message.header.stamp.to_sec()
    return math.nan


def stamp_when(status, condition):
    for _, message in status:
        if condition(message):
            return message.header.stamp.to_sec()
    return math.nan


def picture(path, rows, ensembles, begun, release_s, peak_kn_per_m):
    """What was said over the time at which it was said: release time and peak tension, forecast and ensemble."""
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 6), sharex=True, constrained_layout=True)
    said = [row for row in rows if not row["stale"] and not math.isnan(row["release_s"])]
    upper.plot([row["arrived_s"] for row in said], [row["release_s"] for row in said], "o", label="forecast")
    lower.plot([row["arrived_s"] for row in said], [row["peak_kn_per_m"] for row in said], "o", label="forecast")
    for arrived, message in ensembles:
        if not math.isfinite(message.release_delay.p90):
            continue
        when = message.header.stamp.to_sec() - begun
        delay, tension = message.release_delay, message.peak_tension
        upper.plot(2 * [arrived - begun], [when + delay.p10, when + delay.p90], "-", color="tab:orange", linewidth=5, alpha=0.6)
        lower.plot(2 * [arrived - begun], [tension.p10 / 1e3, tension.p90 / 1e3], "-", color="tab:orange", linewidth=5, alpha=0.6)
    upper.plot([], [], "-", color="tab:orange", linewidth=5, alpha=0.6, label="ensemble, P10 to P90")
    upper.axhline(release_s, color="black", linewidth=1, label="live run, in the end")
    lower.axhline(peak_kn_per_m, color="black", linewidth=1)
    for axes in (upper, lower):
        axes.axvline(release_s, color="grey", linestyle=":", linewidth=1)
        axes.grid(alpha=0.3)
    upper.set_ylabel("release at (s)")
    upper.legend()
    lower.set_ylabel("peak tension (kN/m)")
    lower.set_ylim(bottom=0)
    lower.set_xlabel("said at (s of the log); dotted: the release")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override of the scene")
    parser.add_argument("--rate", type=float, default=1.0, help="speed of the replay")
    parser.add_argument("--log-s", type=float, default=32.0, help="so much of the log is looked at")
    parser.add_argument("--out", default=os.path.join(ROOT, "docs"), metavar="DIR")
    options = parser.parse_args()
    listener, cpu = replay(COARSE.split(",") + options.set, options.rate, options.log_s)
    status, forecasts, ensembles = (listener.of(name) for name in ("status", "forecast", "ensemble"))
    final = status[-1][1]
    begun = min(m.header.stamp.to_sec() for _, m in status if m.header.stamp.to_sec() > 1e9)
    release = begun + final.release_time.to_sec()
    moved, half = first_motion(status), stamp_when(status, lambda m: min(m.port, m.starboard) >= 0.5 * 0.365)
    rows = []
    for arrived, m in forecasts:
        rows.append({"arrived_s": arrived - begun, "from_s": m.header.stamp.to_sec() - begun, "stale": int(m.stale),
                     "release_s": m.release_time.to_sec() - begun if m.release_time.to_sec() > 0 else math.nan,
                     "peak_kn_per_m": max(m.peak_tension) / 1e3, "age_s": m.age, "cost_s": m.cost})
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, "forecast.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: f"{value:.6g}" for key, value in row.items()})
    picture(os.path.join(options.out, "forecast.png"), rows, ensembles, begun, release - begun, final.peak_tension / 1e3)
    fresh = [row for row in rows if not row["stale"]]
    moving = [row for row in fresh if row["from_s"] > moved - begun and not math.isnan(row["release_s"])]
    at_half = [row for row in fresh if row["arrived_s"] <= half - begun]
    lags = [m.lag for _, m in status if moved < m.header.stamp.to_sec() < release + 3.0]
    refreshed = []  # a message that brings new advice alone has the stamp of the ensemble before
    for arrived, message in ensembles:
        if not refreshed or message.header.stamp != refreshed[-1][1].header.stamp:
            refreshed.append((arrived, message))
    gaps = [b[0] - a[0] for a, b in zip(refreshed, refreshed[1:])]
    print(f"release {final.release_time.to_sec():.2f} s, peak {final.peak_tension / 1e3:.1f} kN/m; hull moves at "
          f"{moved - begun:.2f} s, half open at {half - begun:.2f} s")
    print(f"first forecast of a release {moving[0]['arrived_s'] - (moved - begun):.2f} s after the hull's first movement")
    print(f"in hand at half opening: {at_half[-1]}")
    print(f"lag while it releases: median {percentile(lags, 0.5):.2f}, 95 % {percentile(lags, 0.95):.2f}, most {max(lags):.2f} s")
    print(f"{len(fresh)} forecasts, cost {percentile([r['cost_s'] for r in fresh], 0.5):.2f} s median; "
          f"ensembles at {[round(t - begun, 1) for t, _ in refreshed]}, intervals at most {max(gaps, default=math.nan):.1f} s")
    for t, m in ensembles:
        release_at = [m.header.stamp.to_sec() - begun + delay
                      for delay in (m.release_delay.p10, m.release_delay.p50, m.release_delay.p90)]
        print(f"  {t - begun:5.1f} s: {m.completed}/{m.members} release at {release_at[0]:.1f} {release_at[1]:.1f} "
              f"{release_at[2]:.1f} s, peak {m.peak_tension.p10/1e3:.0f} {m.peak_tension.p50/1e3:.0f} "
              f"{m.peak_tension.p90/1e3:.0f} cost {m.cost:.1f} s; {m.message}")
    print(f"node: {cpu[0]:.1f} s user, {cpu[1]:.1f} s system")


if __name__ == "__main__":
    sys.exit(main())
