#!/usr/bin/python3
"""A bag is replayed through the node and the vessel link to the real Signal K server; the superintendent's page in headless
Chromium must show what the topics said, to the last digit. Needs the build with ROS, sourced; ends with 77 where server or
browser are missing.

    page_replay.py BAG SCENE FORECAST [--set KEY=VALUE,...] [--pictures FOLDER --at S]
"""
import argparse
import math
import os
import socket
import subprocess
import sys
import tempfile
import threading
import time
from datetime import datetime, timezone

import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(HERE, "..", "vessel"))
from page_browser import PAGE, WEB, open_browser  # noqa: E402
from signalk_server import Server  # noqa: E402

SILENCE_S = 15.0  # then the log is over
STATES = ["none", "waiting", "releasing", "released", "hung_up"]
READ = """const shown = {}
for (const id of ['port', 'starboard', 'state', 'message', 'load-now', 'pull-now', 'load-expected', 'out-in', 'out-band',
                  'advice-words']) {
  const value = document.getElementById(id).dataset.value
  if (value !== undefined) shown[id] = JSON.parse(value)
}
return [shown, document.getElementById('clock').textContent, document.getElementById('replay').hidden]"""


def utc(stamp):
    """As the link writes it, to the millisecond."""
    return datetime.fromtimestamp(stamp.to_nsec() // 10**6 / 1e3, timezone.utc).isoformat(timespec="milliseconds") \
        .replace("+00:00", "Z")


class Topics:
    """All that the topics said, by where the page shows it."""

    def __init__(self):
        import rospy
        from geocontainer_mpm.msg import ReleaseEnsemble, ReleaseForecast, ReleaseStatus
        self.lock, self.said = threading.Lock(), {}
        self.begun = self.now = None  # of the log, s
        self.states = {getattr(ReleaseStatus, name.upper()): name for name in STATES}
        for topic, kind, take in (("release_status", ReleaseStatus, self.status), ("release_forecast", ReleaseForecast, self.forecast),
                                  ("release_ensemble", ReleaseEnsemble, self.ensemble)):
            rospy.Subscriber(topic, kind, take, queue_size=1000)

    def add(self, **values):
        with self.lock:
            for name, value in values.items():
                self.said.setdefault(name.replace("_", "-"), []).append(value)

    def status(self, m):
        if m.header.stamp.to_sec() > 1e9:  # before the log it has none
            self.now = m.header.stamp.to_sec()
            self.begun = self.now if self.begun is None else min(self.begun, self.now)
        self.add(port=m.port, starboard=m.starboard, state=self.states[m.outcome], message=m.message,
                 load_now=m.peak_utilisation, pull_now=m.current_tension)

    def forecast(self, m):
        self.add(load_expected=max(m.utilisation))
        if not m.release_time.is_zero():
            self.add(out_in=utc(m.release_time))

    def ensemble(self, m):
        self.add(out_band=[m.release_delay.p10, m.release_delay.p90], advice_words=m.advised_rate)

    def has_said(self, name, value):
        with self.lock:
            return value in self.said.get(name, [])


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bag")
    parser.add_argument("scene")
    parser.add_argument("forecast")
    parser.add_argument("--set", default="", metavar="KEY=VALUE,...", help="overrides of the scene")
    parser.add_argument("--params", default=os.path.join(ROOT, "config", "release_node.yaml"))
    parser.add_argument("--pictures", metavar="FOLDER")
    parser.add_argument("--at", type=float, default=15.0, metavar="S", help="second of the log that is pictured")
    return parser.parse_args()


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def launch(options, server):
    """The whole chain under a master of its own; and the file that says where the server is."""
    with open(os.path.join(ROOT, "config", "vessel_link.yaml"), encoding="utf-8") as file:
        link = yaml.safe_load(file)
    link["send_replays"] = True
    link["signalk"].update(enabled=True, port=server.port)
    link["signalk"]["section"]["bed_z_m"] = -9.3
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", delete=False, encoding="utf-8") as file:
        yaml.safe_dump(link, file)
    port = free_port()
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost")
    return file.name, subprocess.Popen(
        ["roslaunch", "-p", str(port), os.path.join(HERE, "page_replay.launch"), f"bag:={os.path.abspath(options.bag)}",
         f"scene:={os.path.abspath(options.scene)}", f"forecast:={os.path.abspath(options.forecast)}", f"set:={options.set}",
         f"params:={os.path.abspath(options.params)}", f"link:={file.name}"], stdout=subprocess.DEVNULL)


def follow(options, browser, topics, launched):
    """Compares until the container is out, or the log is over. Returns how often each figure was found right; ends the
    program where one is not: the link sends what it hears at once, so that the page shows nothing that was not said."""
    found, ports, pictured = {}, set(), options.pictures is None
    end, before = time.monotonic() + 300.0, None
    while launched.poll() is None and time.monotonic() < end:
        shown, clock, live = browser.execute_script(READ)
        for name, value in shown.items():
            if topics.has_said(name, value):
                found[name] = found.get(name, 0) + 1
            else:
                time.sleep(1.0)  # the page was faster than this program's own subscription
                if not topics.has_said(name, value):
                    sys.exit(f"{name}: the page shows {value!r} at {clock}, which no topic has said")
        ports.add(shown.get("port"))
        if shown and live:
            sys.exit("a replay is not marked as one")
        now = 0.0 if topics.now is None else topics.now - topics.begun
        if not pictured and now >= options.at:
            pictured = True
            # The window's frame is not the page's: 1280 x 800 of page.
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False})
            time.sleep(0.5)
            browser.save_screenshot(os.path.join(options.pictures, "superintendent.png"))
            browser.execute_script("document.getElementById('theme').click()")
            time.sleep(0.5)
            browser.save_screenshot(os.path.join(options.pictures, "superintendent_night.png"))
            browser.execute_script("document.getElementById('theme').click()")
        if topics.now != before:
            before, end = topics.now, time.monotonic() + SILENCE_S
        if shown.get("state") in ("released", "hung_up"):
            break
        time.sleep(0.3)
    if len(ports) < 5:
        sys.exit(f"the page stands still: all that it showed of the port half is {ports}")
    return found


def main():
    options = parse()
    server = Server(webapp=WEB)
    server.start()
    link, launched = launch(options, server)
    browser = open_browser()
    try:
        import rosgraph
        import rospy
        while not rosgraph.is_master_online() or not rosgraph.Master("/page_replay").hasParam("/use_sim_time"):
            time.sleep(0.1)
        rospy.init_node("page_replay", anonymous=True)
        topics = Topics()
        browser.get(PAGE.format(port=server.port))
        found = follow(options, browser, topics, launched)
    finally:
        browser.quit()
        launched.terminate()
        launched.wait(30)
        server.close()
        os.unlink(link)
    print("figures found as the topics said them:", ", ".join(f"{name} {count}" for name, count in sorted(found.items())))
    known = [band for band in topics.said.get("out-band", []) if all(map(math.isfinite, band))]
    missing = {"port", "starboard", "state", "message", "load-now", "pull-now", "load-expected"} - set(found)
    missing |= {"out-band"} - set(found) if known else set()
    if missing:
        sys.exit(f"never shown: {', '.join(sorted(missing))}")


if __name__ == "__main__":
    main()
