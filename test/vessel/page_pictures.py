#!/usr/bin/python3
"""Pictures of the superintendent's page for docs/: a record is played to it through the real Signal K server. The record's own
future stands in for a forecast, with a spread that is made up.
  page_pictures.py VESSEL_PROBE RECORD.h5 FOLDER [SECONDS]     simulate --record RECORD.h5; the page at this instant"""
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "script")]
PROGRAM, RECORD, FOLDER = sys.argv[1:4]
UNTIL = float(sys.argv[4]) if len(sys.argv) > 4 else 14.5
sys.argv[1:] = [PROGRAM, os.path.join(HERE, "..", "..", "web")]
import numpy as np  # noqa: E402
from record_file import Record  # noqa: E402
from signalk_server import Server  # noqa: E402
from test_page import WEB, Sender, iso, open_browser  # noqa: E402

STATES = {"waiting": "waiting", "releasing": "releasing", "released": "released", "hung_up": "hung_up"}
HULL = {"y": [1.5, 0, 0, 2.5, 2.5], "z": [-4.3, -4.3, -3.9, -1.3, 0], "hinge": [0, 0], "bed": [-9.3]}


def thin_curve(time, tension, most=60):
    """Of each stretch the instant of largest tension, as the link does it."""
    keep = [int(stretch[tension[stretch].argmax()]) for stretch in np.array_split(np.arange(len(time)), most) if len(stretch)]
    return {"time": [float(time[i]) for i in keep], "tension": [float(tension[i]) for i in keep]}


def values_at(record, index, instant):
    """What the link sends of a frame; `instant` is the record's beginning."""
    frame = record.frames[index]
    status, sheet = frame["status"].attrs, frame["geotextile"]
    seam = float(sheet.attrs["seam_strength_n_per_m"][0])
    nodes, tension = sheet["node"][()], sheet["gauge_tension"][()]
    tensions = record.tension[:, 0] * 1e3
    stride = -(-len(nodes) // 64)
    last = min(len(record.frames) - 1, index + 600)
    peak, whole = float(status["peak_tension_n_per_m"]), record.peak * 1e3
    now, out = float(record.time[index]), record.release
    released = out is not None and now >= out
    return {
        "hull.port.opening": float(frame.attrs["port_rad"]), "hull.starboard.opening": float(frame.attrs["starboard_rad"]),
        "hull.section": HULL, "release.state": STATES.get(record_text(status["outcome"]), "none"), "lag": 0.04,
        "release.message": f"{max(0.0, status['height_m']):.1f} m high, its middle {-status['centroid_m'][2]:.1f} m below the hinge",
        "tension.current": float(tensions[index]), "tension.peak": peak, "utilisation.peak": peak / seam,
        "shape": {"y": [round(float(y), 3) for y in nodes[::stride, 1]], "z": [round(float(z), 3) for z in nodes[::stride, 2]],
                  "utilisation": [float(tension[i:i + stride].max() / seam) for i in range(0, len(nodes), stride)]},
        "forecast.state": "fresh", "forecast.outcome": "released",
        "forecast.release.instant": iso(instant + out), "forecast.utilisation.peak": whole / seam,
        "forecast.curve": thin_curve(record.time[index:last] + instant, tensions[index:last]),
        "ensemble.tension.p10": max(peak, 0.88 * whole), "ensemble.tension.p90": 1.15 * whole,
        "ensemble.utilisation.p10": max(peak, 0.88 * whole) / seam, "ensemble.utilisation.p90": 1.15 * whole / seam,
        "ensemble.release.p10": out - now - 0.9, "ensemble.release.p90": out - now + 2.1,
        "ensemble.probability.hung_up": 0.0 if released else 0.06, "ensemble.probability.ruptured": 0.0,
        "advice.state": "rate", "advice.rate": 0.0244, "advice.message": "Then nine runs of ten stay below 80 % of the strength",
    }


def record_text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def main():
    record = Record(RECORD)
    server = Server(webapp=WEB)
    server.start()
    browser = open_browser()
    # The window's frame is not the page's: 1280 x 800 of page.
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False})
    instant = time.time()
    sender = Sender(server.port, values_at(record, 0, instant))
    for name in ("hung_up", "lopsided_opening", "seam_utilisation"):
        sender.alarm(name, "normal", "")
    try:
        browser.get(f"http://127.0.0.1:{server.port}/geocontainer-superintendent/")
        instant = time.time()
        while (now := time.time() - instant) < UNTIL:
            index = int(abs(record.time - now).argmin())
            for path, value in values_at(record, index, instant).items():
                sender.change(path, value)
            time.sleep(0.1)
        browser.save_screenshot(os.path.join(FOLDER, "superintendent.png"))
        browser.execute_script("document.getElementById('theme').click()")
        sender.alarm("lopsided_opening", "warn", "Port is 1.2 degrees ahead of starboard", acknowledged=True)
        sender.alarm("seam_utilisation", "alarm", "The seam will be pulled beyond 80 % of its strength in 6 s: slow down")
        time.sleep(1.5)
        browser.save_screenshot(os.path.join(FOLDER, "superintendent_night.png"))
        server.kill()
        time.sleep(4.0)
        browser.save_screenshot(os.path.join(FOLDER, "superintendent_no_data.png"))
    finally:
        sender.close()
        browser.quit()
        server.close()


if __name__ == "__main__":
    main()
