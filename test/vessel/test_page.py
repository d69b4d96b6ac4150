#!/usr/bin/python3
"""The superintendent's page in headless Chromium, fed by the client through the real Signal K server: what it shows is what
was sent, alarms show and clear, silence is seen within three seconds."""
import json
import os
import signal
import sys
import threading
import time
import unittest
from datetime import datetime, timezone

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from page_browser import PAGE, WEB, open_browser  # noqa: E402
from signalk_server import Probe, Server, eventually  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402

PROGRAM = sys.argv.pop(1)
PREFIX = "cargo.geocontainer"


def iso(instant):
    return datetime.fromtimestamp(instant, timezone.utc).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def release():
    """Half way through a release, and what is expected of the rest of it; far ahead, since a busy machine takes its time."""
    now = time.time()
    return {
        "hull.port.opening": 0.2071, "hull.starboard.opening": 0.1994, "release.state": "releasing",
        "release.message": "Half of the container is below the lips",
        "tension.current": 41234.5, "tension.peak": 52345.25, "utilisation.peak": 0.26172625, "lag": 0.05,
        "forecast.state": "fresh", "forecast.outcome": "released", "forecast.release.instant": iso(now + 1800.4),
        "forecast.tension.peak": 61500.0, "forecast.utilisation.peak": 0.3075,
        "forecast.curve": {"time": [round(now, 3), round(now + 30.0, 3)], "tension": [41000.0, 61500.0]},
        "ensemble.tension.curve": {"time": [round(now, 3), round(now + 30.0, 3)], "p10": [40000.0, 55000.0],
                                   "p50": [41000.0, 60000.0], "p90": [43000.0, 74000.0]},
        "ensemble.utilisation.p10": 0.275, "ensemble.utilisation.p90": 0.37,
        "ensemble.release.p10": 38.2, "ensemble.release.p90": 55.3,
        "ensemble.probability.hung_up": 0.0625, "ensemble.probability.ruptured": 0.0,
        "advice.state": "rate", "advice.rate": 0.0139626, "advice.slowest": 0.0, "advice.message": "At this rate nine of ten stay below 80 %",
        "shape": {"y": [-1.0, 1.0, 1.5, 0.0, -1.5], "z": [-1.0, -1.0, -3.0, -5.0, -3.0],
                  "utilisation": [0.1, 0.2, 0.3, 0.2, 0.1]},
        "hull.section": {"y": [1.5, 0, 0, 2.5, 2.5], "z": [-4.3, -4.3, -3.9, -1.3, 0], "hinge": [0, 0]},
    }


class Sender:
    """The link node in small: sends the present values five times a second."""

    def __init__(self, port, values):
        self.probe = Probe(PROGRAM, port)
        self.values = {f"{PREFIX}.{path}": value for path, value in values.items()}
        self.lock, self.ended = threading.Lock(), threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while not self.ended.wait(0.2):
            with self.lock:
                self.probe.send(self.values)

    def set(self, **values):
        with self.lock:
            self.values.update(values)

    def change(self, path, value):
        self.set(**{f"{PREFIX}.{path}": value})

    def alarm(self, name, state, message, acknowledged=False):
        self.set(**{f"notifications.{PREFIX}.{name}": {"state": state, "message": message, "acknowledged": acknowledged}})

    def close(self):
        self.ended.set()
        self.thread.join()
        self.probe.process.kill()
        self.probe.process.communicate()


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server(webapp=WEB)
        cls.addClassCleanup(cls.server.close)
        cls.server.start()
        cls.browser = open_browser()
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.values = release()
        self.sender = Sender(self.server.port, self.values)
        self.addCleanup(self.sender.close)
        for name in ("hung_up", "seam_utilisation", "lag"):
            self.sender.alarm(name, "normal", "")
        self.open_hosted()

    def open_hosted(self):
        self.browser.get(PAGE.format(port=self.server.port))

    def text(self, identifier):
        return self.browser.find_element(By.ID, identifier).get_attribute("textContent")

    def value(self, identifier):
        text = self.browser.find_element(By.ID, identifier).get_attribute("data-value")
        return None if text is None else json.loads(text)

    def alarms(self):
        """Name, class and words of each."""
        return self.browser.execute_script(
            "return [...document.querySelectorAll('#alarms p')].map(p => [p.dataset.name || '', p.className, p.textContent])")

    def shows(self, identifier, text):
        eventually(lambda: self.text(identifier) == text, f"{identifier} shows {text!r}, it is {self.text(identifier)!r}")

    def expect_the_values(self):
        self.shows("port", "11.9°")
        expected = {"port": "hull.port.opening", "starboard": "hull.starboard.opening", "state": "release.state",
                    "message": "release.message", "load-now": "utilisation.peak", "pull-now": "tension.current",
                    "load-expected": "forecast.utilisation.peak", "out-in": "forecast.release.instant",
                    "advice-words": "advice.rate"}
        for identifier, path in expected.items():
            eventually(lambda: self.value(identifier) == self.values[path],
                       f"{identifier} is {self.values[path]}, it is {self.value(identifier)}")
        self.assertEqual(self.text("starboard"), "11.4°")
        self.assertEqual(self.text("state"), "Releasing")
        self.assertEqual(self.text("load-now"), "26 %")
        self.assertEqual(self.text("load-expected"), "of its strength · will reach 31 % · likely 28 % to 37 %")
        self.assertEqual(self.text("advice-words"), "Open no faster than 0.80°/s")
        self.assertEqual(self.text("pull-now"), "now 41.2 kN/m · highest 52.3 kN/m")
        self.assertEqual(self.text("out-band"), "likely 38 s to 55 s · chance to get stuck 6 %")
        # It counts down by the clock that it shows, in whole seconds.
        shown, clock = self.browser.execute_script(
            "return ['out-in', 'clock'].map(id => document.getElementById(id).textContent)")
        instant = datetime.fromisoformat(self.values["forecast.release.instant"].replace("Z", "+00:00"))
        hour, minute, second = (int(part) for part in clock.removesuffix(" UTC").split(":"))
        left = (instant - instant.replace(hour=hour, minute=minute, second=second, microsecond=0)).total_seconds() % 86400
        self.assertIn(shown, {f"{whole // 60}:{whole % 60:02}" for whole in (round(left - 1), round(left - 0.5), round(left))})

    def test_hosted_by_the_server_it_shows_what_was_sent(self):
        self.browser.get_log("browser")  # what other tests did to the server
        self.open_hosted()
        self.expect_the_values()
        pieces = self.browser.find_elements(By.CSS_SELECTOR, "#section polyline")
        self.assertEqual(len(pieces), len(self.values["shape"]["utilisation"]))
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#section polygon")), 3)  # two halves, the fill
        self.assertGreaterEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#chart polyline")), 2)
        severe = [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(severe, [])

    def test_from_a_file_it_shows_the_same(self):
        self.browser.get(f"file://{os.path.join(WEB, 'public', 'index.html')}?server=127.0.0.1:{self.server.port}")
        self.expect_the_values()

    def test_nothing_comes_from_elsewhere(self):
        self.shows("port", "11.9°")
        fetched = self.browser.execute_script("return performance.getEntriesByType('resource').map(e => e.name)")
        self.assertGreaterEqual(len(fetched), 4)
        for address in fetched:
            self.assertTrue(address.startswith(f"http://127.0.0.1:{self.server.port}/"), address)

    def test_values_change_and_what_is_unknown_is_not_made_up(self):
        self.shows("port", "11.9°")
        self.sender.change("hull.port.opening", 0.3)
        self.shows("port", "17.2°")
        self.sender.change("utilisation.peak", None)
        self.shows("load-now", "–")
        self.sender.change("advice.slowest", 0.00698132)
        self.shows("advice-words", "Open at 0.40° to 0.80°/s")
        self.sender.change("advice.slowest", self.values["advice.rate"])
        self.shows("advice-words", "Open at 0.80°/s")
        self.sender.change("advice.state", "rate_so_far")
        self.shows("advice-words", "0.80°/s is safe")
        self.sender.change("advice.state", "no_rate")
        self.shows("advice-words", "No opening speed keeps it safe")
        self.sender.change("advice.state", "none")
        self.shows("advice-words", "No advice")
        self.sender.change("forecast.release.instant", None)
        self.sender.change("forecast.outcome", "hung_up")
        self.shows("out-in", "Gets stuck")
        self.sender.change("release.state", "released")
        self.shows("out-in", "Out")

    def test_alarms_show_are_acknowledged_and_clear(self):
        eventually(lambda: self.alarms() == [["", "none", "No alarms"]], f"no alarms; {self.alarms()}")
        self.sender.alarm("lag", "warn", "The prediction is behind")
        self.sender.alarm("hung_up", "alarm", "<b>The container stands still</b>")
        expected = [["hung_up", "alarm", "<b>The container stands still</b>not acknowledged"],
                    ["lag", "warn", "The prediction is behindnot acknowledged"]]
        eventually(lambda: self.alarms() == expected, f"two alarms, the worse first; {self.alarms()}")
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "#alarms b"), [])  # words are no markup
        self.sender.alarm("hung_up", "alarm", "The container stands still", acknowledged=True)
        eventually(lambda: self.alarms()[0] == ["hung_up", "alarm seen", "The container stands stillacknowledged"],
                   f"acknowledged; {self.alarms()}")
        self.sender.alarm("hung_up", "normal", "")
        self.sender.alarm("lag", "normal", "")
        eventually(lambda: self.alarms() == [["", "none", "No alarms"]], f"no alarms; {self.alarms()}")

    def what_is_heard(self):
        return f"the banner {self.banner()!r}; " + self.browser.execute_script(
            "return JSON.stringify([feed.connected, performance.now() - feed.heard, performance.now(), document.title])")

    def banner(self):
        element = self.browser.find_element(By.ID, "no-data")
        return element.text if element.is_displayed() else ""

    # The page's own clock tells when its banner appeared: this test may be kept waiting by a busy machine.
    WATCH = """window.shown = null; const banner = document.getElementById('no-data');
        new MutationObserver(() => { if (!banner.hidden && window.shown === null) window.shown = performance.now() - feed.heard })
          .observe(banner, { attributes: true })"""

    def test_a_lost_connection_is_seen_within_three_seconds(self):
        self.shows("port", "11.9°")
        eventually(lambda: self.banner() == "", "no banner")
        self.browser.execute_script(self.WATCH)
        self.server.signal(signal.SIGSTOP)
        try:
            eventually(lambda: "NO DATA for" in self.banner(), "the banner")
        finally:
            self.server.signal(signal.SIGCONT)
        self.assertLess(self.browser.execute_script("return window.shown"), 3000)
        eventually(lambda: self.banner() == "", "the banner goes")
        self.sender.change("hull.port.opening", 0.25)
        self.shows("port", "14.3°")

    def test_a_server_that_comes_back_is_found_again(self):
        self.shows("port", "11.9°")
        self.server.kill()
        eventually(lambda: "no connection" in self.banner(), "the banner says why")
        self.server.start()
        self.sender.change("hull.port.opening", 0.25)
        eventually(lambda: self.banner() == "", "the banner goes", 60.0)
        self.shows("port", "14.3°")

    def test_a_link_that_has_ended_is_seen(self):
        self.shows("port", "11.9°")
        self.sender.close()
        eventually(lambda: self.banner().startswith("NO DATA for"), self.what_is_heard)
        self.assertNotIn("no connection", self.banner())
        self.open_hosted()  # the server still has the last values: they must not pass for new ones
        eventually(lambda: self.banner().startswith("NO DATA for"), "the banner of a page opened later")
        # It connects anew after ten seconds of silence, and is told the old values once more.
        eventually(lambda: int(self.banner().split()[3]) >= 13, "it stays")

    def test_day_and_night(self):
        ground = "return getComputedStyle(document.body).backgroundColor"
        self.shows("port", "11.9°")
        first = self.browser.execute_script(ground)
        self.browser.find_element(By.ID, "theme").click()
        second = self.browser.execute_script(ground)
        self.assertEqual({first, second}, {"rgb(255, 255, 255)", "rgb(0, 0, 0)"})
        self.open_hosted()
        self.assertEqual(self.browser.execute_script(ground), second)  # kept

    def test_everything_fits_the_screen(self):
        self.shows("port", "11.9°")
        for name in ("hung_up", "seam_utilisation", "lag"):
            self.sender.alarm(name, "alarm", "Something that takes half a line to say in plain words")
        eventually(lambda: len(self.alarms()) == 3, "three alarms")
        for width, height in ((1280, 800), (1024, 768), (1920, 1080)):
            self.browser.set_window_size(width, height)
            outside = self.browser.execute_script(
                "return [...document.querySelectorAll('.number, .note, h1, h2, #advice-words, #clock, footer p')].filter(e => {"
                " const range = document.createRange(); range.selectNodeContents(e);"
                " const text = range.getBoundingClientRect(), room = (e.closest('section') || document.body).getBoundingClientRect();"
                " return text.width && (text.right > room.right || text.left < room.left || text.bottom > room.bottom)"
                "}).map(e => e.id || e.textContent)")
            self.assertEqual(outside, [], f"{width} x {height}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
