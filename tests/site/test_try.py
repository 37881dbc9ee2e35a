#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The page to try delone, in Chromium: every product, files, errors, stopping; nothing is sent.

  SITE=build/site python3 tests/site/test_try.py [unittest arguments]
"""
import functools
import http.server
import os
import pathlib
import re
import tempfile
import threading
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select, WebDriverWait

from chromium import WEBGL, start, stop

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = pathlib.Path(os.environ.get("SITE", "build/site")).resolve()
REQUESTS = []


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm"}

    def log_message(self, *arguments):
        REQUESTS.append(self.requestline)


@unittest.skipUnless((SITE / "_static/delone/module.wasm").is_file(), "the site was built without emscripten")
class TryIt(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=str(SITE)))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.browser, cls.profile = start([*WEBGL, "--window-size=1200,900"])

    @classmethod
    def tearDownClass(cls):
        stop(cls.browser, cls.profile)
        cls.server.shutdown()

    def setUp(self):
        self.browser.get(f"http://127.0.0.1:{self.server.server_port}/try.html")
        self.wait(lambda: self.find("start").is_enabled())

    def wait(self, condition):
        WebDriverWait(self.browser, 60).until(lambda _: condition())

    def find(self, name):
        return self.browser.find_element(By.ID, "try-" + name)

    def message(self):
        return self.find("message").text

    def paste(self, text):
        self.browser.execute_script("arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input'))", self.find("points"), text)

    def compute(self, product):
        Select(self.find("product")).select_by_value(product)
        self.find("start").click()
        self.wait(lambda: self.find("start").is_enabled())
        return self.message()

    def downloads(self):
        """The sizes of the files, by their names."""
        return self.browser.execute_async_script("""const done = arguments[0];
          Promise.all(Array.from(document.querySelectorAll("#try-downloads a"), async (a) => [a.download, (await (await fetch(a.href)).arrayBuffer()).byteLength]))
            .then((all) => done(Object.fromEntries(all)));""")

    def shown(self):
        """How many cells the viewer has."""
        self.browser.switch_to.frame(self.find("view"))
        try:
            self.wait(lambda: self.browser.execute_script("return window.delone?.scene !== undefined"))
            return self.browser.execute_script("return delone.scene.cells.length")
        finally:
            self.browser.switch_to.default_content()

    def test_products_of_pasted_points(self):
        for product, expected in {"delaunay": "cells: 6, vertices: 6", "hull": "facets: 4, extreme points: 4, volume: 14.5",
                                  "voronoi": "regions: 6", "alpha": "cells: 4, facets of the boundary: 4"}.items():
            with self.subTest(product=product):
                self.assertIn(expected, self.compute(product))
                self.assertTrue(self.find("view").is_displayed())
                self.shown()
                sizes = self.downloads()
                self.assertEqual(set(sizes), {f"{product}.npz", f"{product}.json"})
                self.assertGreater(min(sizes.values()), 200)
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_files(self):
        self.find("file").send_keys(str(ROOT / "data" / "protein.csv"))
        message = self.compute("delaunay")
        self.assertRegex(message, r"1,516 points in dimension 3\. cells: 9,751")
        self.assertGreater(self.shown(), 0)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "lattice.xyz")
            path.write_text("8\nalpha\n" + "".join(f"H {i >> 2} {i >> 1 & 1} {i & 1}\n" for i in range(8)))
            self.find("file").send_keys(str(path))
            self.assertIn("volume: 1.", self.compute("hull"))

    def test_dropped_files(self):
        self.browser.execute_script("""const data = new DataTransfer();
          data.items.add(new File(["0 0\\n1 0\\n0 1\\n"], "dropped.txt"));
          document.getElementById("try").dispatchEvent(new DragEvent("drop", {dataTransfer: data, bubbles: true, cancelable: true}));""")
        self.assertIn("dropped.txt", self.find("name").text)
        self.assertIn("cells: 1", self.compute("delaunay"))

    def test_errors_name_the_line(self):
        self.paste("0,0\n1,x\n")
        self.assertRegex(self.compute("delaunay"), r"pasted\.csv.*2")
        self.paste("")
        self.assertNotEqual(self.compute("delaunay"), "")
        self.assertIn("error", self.find("message").get_attribute("class"))

    def test_long_computations_can_be_stopped(self):
        self.browser.execute_script("""const lines = [];
          for (let i = 0; i < 300000; ++i) lines.push(`${Math.random()} ${Math.random()} ${Math.random()} ${Math.random()}`);
          arguments[0].value = lines.join("\\n"); arguments[0].dispatchEvent(new Event("input"));""", self.find("points"))
        self.find("start").click()
        self.wait(lambda: self.find("progress").get_attribute("value") is not None)
        self.find("stop").click()
        self.wait(lambda: self.find("start").is_enabled())
        self.paste("0 0\n1 0\n0 1\n")
        self.assertIn("cells: 1", self.compute("delaunay"))

    def test_nothing_is_sent(self):
        del REQUESTS[:]
        self.compute("delaunay")
        sent = self.browser.execute_script("return performance.getEntriesByType('resource').map((entry) => entry.name)")
        self.assertTrue(all(re.match(r"(http://127\.0\.0\.1:|blob:)", name) for name in sent), sent)
        self.assertEqual(REQUESTS, [])


if __name__ == "__main__":
    unittest.main()
