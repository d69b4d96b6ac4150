#!/usr/bin/python3
"""Does following the advice help? The default release with a weak seam on either side, logged on a barge that opens within
50 s and is known from its earlier releases: the node holds the closed hull until it advises an opening rate; then the release
is computed with the logged opening and with the advised one, both filtered as measured angles are. docs/advice.png, and what
became of both on standard output. Needs the build with ROS, sourced.

    advice.py --simulate build/devel/lib/geocontainer_mpm/simulate [--out docs]
"""
import argparse
import json
import os
import socket
import subprocess
import sys
import tempfile
import time

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import yaml  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "script"))
from record_file import Record  # noqa: E402
from record_section import BLACK, RED, STYLE, draw_geotextile, draw_hull, draw_sand, draw_surfaces, view  # noqa: E402

SEAM_EFFICIENCY = 0.265  # of 200 kN/m: 53
ALONG = 0.13  # of the sheet's length from the middle of its bottom: 2.4 m, where the lips squeeze it
CELLS_M, MEMBERS_CELLS_M = 0.2, 0.3
FASTEST_RAD_PER_S = 0.06
CLOSED_S = 5.0  # as in the default log
STRETCH = 2.0  # of the opening of the default scene, in time
RATE_HZ = 10
END_S = {"logged": 42.0, "advised": 16.0}  # a few seconds after the landing


def read(*path):
    with open(os.path.join(ROOT, "config", *path), encoding="utf-8") as file:
        return yaml.safe_load(file)


def write(folder, name, content):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        yaml.safe_dump(content, file)
    return path


def inputs(folder):
    """Scene, forecast and distributions: the package's own, but for the seams, coarser members and what is known."""
    scene = read("scenes", "release.yaml")
    scene["grid"]["cell_size_m"] = scene["geotextiles"]["container"]["segment_length_m"] = CELLS_M
    scene["geotextiles"]["container"]["seams"] = {
        "port": {"along": ALONG, "efficiency": SEAM_EFFICIENCY, "tears": True},
        "starboard": {"along": 1.0 - ALONG, "efficiency": SEAM_EFFICIENCY, "tears": True}}
    scene["time"]["output_interval_s"] = 0.02
    # The sand of a torn container spreads.
    scene["grid"]["lower_m"], scene["grid"]["upper_m"] = [-14, -10], [14, 0.6]
    scene["surfaces"]["bed"]["line_m"] = [[-14, -9.3], [14, -9.3]]
    forecast = read("forecast.yaml")
    cells = MEMBERS_CELLS_M
    forecast["forecast"]["ensemble"]["scene_overrides"] = [
        f"grid.cell_size_m={cells}", "grid.lower_m=[-14.1, -10.2]", "grid.upper_m=[14.1, 0.6]",
        f"geotextiles.container.segment_length_m={cells}"]
    forecast["forecast"]["advice"]["fastest_rad_per_s"] = FASTEST_RAD_PER_S
    distributions = read("ensembles", "release.yaml")
    # Of this barge, by its earlier releases; of this container, measured as sewn.
    distributions["draw"]["hull.friction"] = {"triangular": {"low": 0.17, "mode": 0.2, "high": 0.23}}
    distributions["draw"]["geotextiles.container.circumference_m"] = {"uniform": {"low": 18.2, "high": 18.4}}
    return (write(folder, "weak_seam.yaml", scene), write(folder, "forecast.yaml", forecast),
            write(folder, "distributions.yaml", distributions))


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def ask_for_advice(scene, forecast, distributions):
    """What the node says of the hull that it holds closed: the message with the advice, and the s that it took."""
    port = free_port()
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost")
    launched = subprocess.Popen(["roslaunch", "-p", str(port), os.path.join(ROOT, "launch", "live.launch"), f"scene:={scene}",
                                 f"forecast:={forecast}", f"distributions:={distributions}"], stdout=subprocess.DEVNULL)
    import rosgraph
    import rospy
    from geocontainer_mpm.msg import HullOpening, ReleaseEnsemble
    while not rosgraph.is_master_online():
        time.sleep(0.1)
    rospy.init_node("advice_bench", anonymous=True)
    advised = []
    rospy.Subscriber("release_ensemble", ReleaseEnsemble,
                     lambda m: advised.append(m) if m.advice != ReleaseEnsemble.NONE_ASKED else None, queue_size=100)
    opening = rospy.Publisher("hull_opening", HullOpening, queue_size=10)
    while opening.get_num_connections() == 0 and launched.poll() is None:
        time.sleep(0.1)
    began = time.monotonic()
    while not advised and time.monotonic() - began < 600.0 and launched.poll() is None:
        message = HullOpening()
        message.header.stamp = rospy.Time.now()
        opening.publish(message)
        time.sleep(0.1)
    launched.terminate()
    launched.wait(30)
    if not advised:
        sys.exit("no advice came")
    return advised[0], time.monotonic() - began


def logged_opening():
    """Times and angles of the default scene, stretched."""
    table = np.array(read("scenes", "release.yaml")["hull"]["opening_table"])
    return np.where(table[:, 0] > CLOSED_S, CLOSED_S + STRETCH * (table[:, 0] - CLOSED_S), table[:, 0]), table[:, 1]


def advised_opening(rate):
    full_rad = logged_opening()[1][-1]
    return [0.0, CLOSED_S, CLOSED_S + full_rad / rate], [0.0, 0.0, full_rad]


def release(program, scene, folder, name, opening):
    """Summary and record of a run to its rest."""
    summary, record, angles = (os.path.join(folder, name + end) for end in (".json", ".h5", ".csv"))
    time_s = np.arange(0.0, END_S[name] + 2.0, 1.0 / RATE_HZ)
    angle = np.interp(time_s, *opening)
    np.savetxt(angles, np.column_stack([time_s, angle, angle]), "%.6f", ",", header="time_s,port_rad,starboard_rad", comments="")
    command = [program, scene, "--angles", angles, "--summary", summary, "--record", record, "--set", f"time.end_s={END_S[name]}"]
    if subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode not in (0, 3):
        sys.exit(f"{name}: could not be run")
    with open(summary, encoding="utf-8") as file:
        return json.load(file), Record(record)


def seam_tension(record):
    """Of both seams the larger, kN/m, at each frame."""
    pieces = len(record.frames[0]["geotextile/gauge_tension"])
    seams = [min(pieces - 1, int(along * pieces)) for along in (ALONG, 1.0 - ALONG)]
    return np.array([frame["geotextile/gauge_tension"][()][seams].max() for frame in record.frames]) / 1e3


def picture(path, runs, strength):
    """Tension at the seams against the opening, and four sections of each run."""
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(12, 10), constrained_layout=True)
        grid = figure.add_gridspec(3, 4, height_ratios=[1.0, 1.3, 1.3])
        axes = figure.add_subplot(grid[0, :])
        for (name, _, record), colour in zip(runs, (RED, BLACK)):
            axes.plot(record.time, seam_tension(record), color=colour, label=name)
        axes.axhline(strength, color=RED, linestyle="--", label=f"strength of the seam, {strength:.0f} kN/m")
        axes.set_xlabel("time [s]")
        axes.set_ylabel("tension at the seams [kN/m]")
        axes.legend()
        everything = [record.frames[i] for _, _, record in runs for i in (0, len(record.frames) - 1)]
        limits = view(everything)
        for row, (name, _, record) in enumerate(runs):
            out = record.time[-1] if record.release is None else record.release
            instants = [out - 3.0, out - 1.0, out + 0.2, record.time[-1]]
            for column, instant in enumerate(instants):
                index = int(np.abs(record.time - instant).argmin())
                ax, frame = figure.add_subplot(grid[1 + row, column]), record.frames[index]
                draw_surfaces(ax, frame, 2.0)
                draw_hull(ax, frame)
                draw_sand(ax, frame, "speed", Normalize(0.0, 8.0))
                draw_geotextile(ax, frame, Normalize(0.0, 60.0))
                ax.set_xlim(limits[0], limits[1])
                ax.set_ylim(limits[2], limits[3])
                ax.set_aspect("equal")
                ax.set_title(f"{name}, {record.time[index]:.1f} s", fontsize=9)
        figure.savefig(path, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--simulate", required=True, metavar="PROGRAM")
    parser.add_argument("--out", default=os.path.join(ROOT, "docs"), metavar="DIR")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene, forecast, distributions = inputs(folder)
        advice, took = ask_for_advice(scene, forecast, distributions)
        print(f"advice after {took:.0f} s: {advice.message}; {advice.advised_rate:.4f} rad/s, not below {advice.slowest_rate:.4f}, "
              f"P90 of the utilisation {advice.advised_utilisation:.2f}, limit {advice.utilisation_limit:.2f}")
        if advice.advised_rate == 0.0:
            sys.exit("no rate is advised")
        runs = [(name, *release(options.simulate, scene, folder, name, opening))
                for name, opening in (("logged", logged_opening()), ("advised", advised_opening(advice.advised_rate)))]
        for name, summary, record in runs:
            print(f"{name}: {summary['outcome']} at {summary['release_time_s']} s, seams up to {seam_tension(record).max():.1f} kN/m, "
                  f"utilisation {summary['peak_utilisation_seam']:.2f}, torn: {json.dumps(summary.get('ruptured'))}")
        strength = runs[0][2].frames[0]["geotextile"].attrs["seam_strength_n_per_m"][0] / 1e3
        picture(os.path.join(options.out, "advice.png"), runs, strength)


if __name__ == "__main__":
    main()
