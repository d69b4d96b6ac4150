"""The superintendent's page and a headless Chromium to look at it; ends the test as skipped when there is none."""
import os
import shutil

from signalk_server import skip

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:
    skip("there is no python3-selenium")
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
if CHROMIUM is None or DRIVER is None:
    skip("there is no Chromium (packages chromium, chromium-driver)")

WEB = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "web")
PAGE = "http://127.0.0.1:{port}/geocontainer-superintendent/"


def open_browser(width=1280, height=800):
    options = Options()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                     f"--window-size={width},{height}", "--hide-scrollbars"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(service=Service(DRIVER), options=options)
    browser.set_page_load_timeout(120)
    return browser
