# SPDX-License-Identifier: BSD-3-Clause
"""Chromium without a screen, by Selenium, as the tests of this folder use it."""
import shutil
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

PHONE = {"width": 390, "height": 844, "pixelRatio": 3, "touch": True}
# As root Chromium has no sandbox; it also tries to reach other hosts if it is not told otherwise.
FLAGS = ["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-quic"]
# WebGL in software.
WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]


def start(flags, phone=False):
    """(browser, folder of its profile): end it by stop()."""
    profile = tempfile.mkdtemp()
    options = webdriver.ChromeOptions()
    for flag in [*FLAGS, *flags, f"--user-data-dir={profile}"]:
        options.add_argument(flag)
    if phone:
        options.add_experimental_option("mobileEmulation", {"deviceMetrics": PHONE})
    options.set_capability("goog:loggingPrefs", {"browser": "SEVERE"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options), profile


def stop(browser, profile):
    browser.quit()
    shutil.rmtree(profile, ignore_errors=True)
