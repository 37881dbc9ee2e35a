#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Takes the pictures of docs/tasks/view.md, docs/pictures/view_*.png, from pages in Chromium:

    DELONE=build/release/delone /usr/bin/python3 tools/make_view_pictures.py [FOLDER]
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "site"))
from PIL import Image  # noqa: E402

from chromium import WEBGL, start, stop  # noqa: E402

DELONE = os.environ.get("DELONE", "build/release/delone")
SET = "const e = document.getElementById(arguments[0]); e.value = arguments[1]; e.dispatchEvent(new Event('change'));"

# name: (arguments of delone, settings). README shows "protein", what a page opens with.
PICTURES = {
    "slice": (["view", "ball", "--title", "Points in a ball"], []),
    "protein": (["alpha", "data/protein.csv", "--radius", "2.7"], []),
    "values": (["view", "data/earthquakes.csv", "--columns", "longitude,latitude", "--values", "depth_km", "--title", "Earthquakes of a week"], []),
    "cars": (["view", "data/cars.csv", "--columns", "Horsepower,Weight_in_lbs,Acceleration,Miles_per_Gallon", "--of", "hull", "--title", "Cars"], [("projection", "slanted")]),
}


def main():
    target = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "pictures"
    browser, profile = start([*WEBGL, "--window-size=1200,760", "--force-device-scale-factor=1.25"])
    with tempfile.TemporaryDirectory() as folder:
        page, points = pathlib.Path(folder) / "page.html", pathlib.Path(folder) / "points.npy"
        for name, (arguments, settings) in PICTURES.items():
            if arguments[1] == "ball":
                subprocess.run([DELONE, "generate", "ball", "-n", "3000", "-d", "3", "-o", points], check=True)
            command, *rest = [points if argument == "ball" else argument for argument in arguments]
            subprocess.run([DELONE, command, "-q", *rest, "-o", page, "--force"], check=True, cwd=ROOT)
            browser.get(page.as_uri())
            wait(browser, "return window.delone?.picture.stats.firstFrameMs > 0")
            for element, value in settings:
                browser.execute_script(SET, element, value)
            wait(browser, "return !delone.picture.busy")
            time.sleep(0.3)
            picture = target / f"view_{name}.png"
            browser.save_screenshot(str(picture))
            Image.open(picture).convert("RGB").quantize(256, dither=Image.Dither.NONE).save(picture, optimize=True)
    stop(browser, profile)


def wait(browser, script):
    while not browser.execute_script(script):
        time.sleep(0.02)


if __name__ == "__main__":
    main()
