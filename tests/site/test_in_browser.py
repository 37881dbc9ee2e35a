#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The documentation site in Chromium: on a phone no page is wider than the screen, searches find, nothing fails.

  SITE=build/site python3 tests/site/test_in_browser.py [unittest arguments]
"""
import functools
import http.server
import os
import pathlib
import threading
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from chromium import PHONE, start, stop

SITE = pathlib.Path(os.environ.get("SITE", "build/site")).resolve()


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *arguments):
        pass


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(QuietHandler, directory=str(SITE)))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.address = f"http://127.0.0.1:{cls.server.server_port}/"
        cls.browser, cls.profile = start(["--disable-gpu"], phone=True)

    @classmethod
    def tearDownClass(cls):
        stop(cls.browser, cls.profile)
        cls.server.shutdown()

    def open(self, page):
        self.browser.get(self.address + page)

    def test_no_page_is_wider_than_a_phone(self):
        pages = [page for page in sorted(SITE.rglob("*.html")) if "cpp" not in page.relative_to(SITE).parts]
        self.assertGreater(len(pages), 40)
        for page in pages:
            with self.subTest(page=page.relative_to(SITE).as_posix()):
                self.open(page.relative_to(SITE).as_posix())
                self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), PHONE["width"])
                self.assertEqual(self.browser.get_log("browser"), [])

    def test_text_is_large_enough(self):
        self.open("guide.html")
        size = self.browser.execute_script("return parseFloat(getComputedStyle(document.querySelector('article p')).fontSize)")
        self.assertGreaterEqual(size, 14)

    def test_the_menu_opens(self):
        self.open("index.html")
        entry = self.browser.find_element(By.CSS_SELECTOR, ".sidebar-tree a[href='guide.html']")
        self.assertLess(entry.rect["x"] + entry.rect["width"], 1)  # beside the screen
        self.browser.find_element(By.CSS_SELECTOR, "label.nav-overlay-icon").click()
        WebDriverWait(self.browser, 10).until(lambda _: entry.rect["x"] >= 0)
        entry.click()
        WebDriverWait(self.browser, 10).until(lambda browser: browser.current_url.endswith("/guide.html"))

    def test_searches_find(self):
        for words, page in [("power diagram", "guide.html"), ("natural_neighbors", "python-delone.html"), ("delone_get_array", "c.html"),
                            ("--max-stream", "commands/delone-delaunay.html"), ("qhull", "from-qhull.html"), ("wheel", "python.html")]:
            with self.subTest(words=words):
                self.open("search.html?q=" + words.replace(" ", "+"))
                WebDriverWait(self.browser, 20).until(lambda browser: "finished" in browser.find_element(By.ID, "search-results").text.lower()
                                                      or "did not match" in browser.find_element(By.ID, "search-results").text)
                links = self.browser.find_elements(By.CSS_SELECTOR, "#search-results li a")
                found = [link.get_attribute("href").removeprefix(self.address).partition("#")[0].partition("?")[0] for link in links]
                self.assertIn(page, found)


if __name__ == "__main__":
    unittest.main()
