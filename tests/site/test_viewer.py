#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pages of `delone view` in Chromium, without a graphics card: pictures, what is under the pointer, filters, slices, keys, phones.

  DELONE=build/release/delone python3 tests/site/test_viewer.py [unittest arguments]

Pictures are compared with pictures.json, 24 by 16 colors each; RENEW=1 writes it anew (look at the pictures, in the folder that is
printed, before you commit it). LARGE=1: a million triangles, and figures of speed.
"""
import json
import os
import pathlib
import random
import re
import shutil
import statistics
import subprocess
import tempfile
import time
import unittest

from PIL import Image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from chromium import WEBGL, start, stop

DELONE = os.environ.get("DELONE", "build/release/delone")
ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURES = pathlib.Path(__file__).with_name("pictures.json")
RENEW = bool(os.environ.get("RENEW"))

# The colors of a small copy of the picture.
THUMBNAIL = """const done = arguments[0]; (async () => {
  const bitmap = await createImageBitmap(await delone.picture.image(), {resizeWidth: 24, resizeHeight: 16, resizeQuality: "high"});
  const context = new OffscreenCanvas(24, 16).getContext("2d");
  context.drawImage(bitmap, 0, 0);
  const {data} = context.getImageData(0, 0, 24, 16);
  done(Array.from(data).filter((_, i) => i % 4 < 3));
})();"""

# Which triangle of the plane has a place of the canvas in it, by looking at all.
FIND_TRIANGLE = """const [x, y] = arguments, v = delone, c = v.picture.camera, w = v.picture.canvas;
const px = c.position.x + (c.left + (c.right - c.left) * (x + 0.5) / w.clientWidth) / c.zoom;
const py = c.position.y + (c.top - (c.top - c.bottom) * (y + 0.5) / w.clientHeight) / c.zoom;
const p = v.space.positions, t = v.scene.cells;
for (let i = 0; i < t.length; i += 3) {
  const [a, b, d] = [0, 1, 2].map((j) => [p[4 * t[i + j]], p[4 * t[i + j] + 1]]);
  const side = (s, e) => (e[0] - s[0]) * (py - s[1]) - (e[1] - s[1]) * (px - s[0]);
  if (side(a, b) >= 0 && side(b, d) >= 0 && side(d, a) >= 0) return i / 3;
}
return null;"""


class Viewer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.browser, cls.profile = start([*WEBGL, "--window-size=1200,800"])
        cls.browser.set_script_timeout(120)
        cls.expected = {} if RENEW else json.loads(PICTURES.read_text())
        cls.pages = {
            "plane": cls.view("uniform", 300, 2), "space": cls.view("uniform", 400, 3), "four": cls.view("uniform", 40, 4),
            "hull": cls.view("ball", 400, 3, "--of", "hull"), "hull4": cls.view("cube01", 16, 4, "--of", "hull"),
            "diagram2": cls.view("uniform", 200, 2, "--of", "voronoi"), "diagram3": cls.view("uniform", 150, 3, "--of", "voronoi"),
            "flat": cls.view("flat", 100, 3), "alpha": cls.alpha(), "line": cls.view("collinear", 20, 2), "one": cls.view("equal", 3, 3),
            "dodecahedron": cls.intersection(),
        }

    @classmethod
    def tearDownClass(cls):
        stop(cls.browser, cls.profile)
        if RENEW:
            PICTURES.write_text("{\n" + ",\n".join(f' "{name}": "{bytes(colors).hex()}"' for name, colors in cls.expected.items()) + "\n}\n")
            print("pictures:", cls.folder)
        else:
            shutil.rmtree(cls.folder)

    @classmethod
    def view(cls, kind, n, d, *options):
        points, page = cls.folder / "points.npy", cls.folder / f"{kind}{n}-{d}{len(options)}.html"
        subprocess.run([DELONE, "generate", kind, "-n", str(n), "-d", str(d), "-o", points], check=True)
        subprocess.run([DELONE, "view", "-q", points, "-o", page, "--title", kind, *options], check=True)
        return page

    @classmethod
    def alpha(cls):
        points, page = cls.folder / "points.npy", cls.folder / "alpha.html"
        subprocess.run([DELONE, "generate", "ball", "-n", "400", "-d", "3", "-o", points], check=True)
        subprocess.run([DELONE, "alpha", "-q", points, "--radius", "0.3", "-o", page], check=True)
        return page

    @classmethod
    def intersection(cls):
        golden = (1 + 5 ** 0.5) / 2
        normals = [(0, a, b * golden) for a in (1, -1) for b in (1, -1)]
        rows = [(*row[shift:], *row[:shift], -1.0) for row in normals for shift in range(3)]
        halfspaces, page = cls.folder / "halfspaces.txt", cls.folder / "dodecahedron.html"
        halfspaces.write_text("\n".join(" ".join(map(str, row)) for row in rows))
        subprocess.run([DELONE, "halfspaces", "-q", halfspaces, "-o", page], check=True)
        return page

    def open(self, name, browser=None):
        browser = browser or self.browser
        browser.get(self.pages[name].as_uri())
        self.wait("return window.delone?.picture.stats.firstFrameMs > 0 || document.querySelector('#notice.failed') !== null", browser)

    def wait(self, script, browser=None):
        end = time.time() + 240
        while not (browser or self.browser).execute_script(script):
            self.assertLess(time.time(), end, script)
            time.sleep(0.02)

    def settle(self):
        self.wait("return !delone.picture.busy")

    def js(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def pick(self, x, y):
        return self.browser.execute_async_script("delone.nameAt(arguments[0], arguments[1]).then(arguments[2])", x, y)

    def choose(self, element, value, event="change"):
        self.js("const e = document.getElementById(arguments[0]); e.value = arguments[1]; e.dispatchEvent(new Event(arguments[2]));",
                element, value, event)
        self.settle()

    def slide(self, element, value):
        self.choose(element, value, "input")

    def check_box(self, element):
        self.browser.find_element(By.ID, element).click()
        self.settle()

    def check_picture(self, name):
        self.settle()
        colors = self.browser.execute_async_script(THUMBNAIL)
        if RENEW:
            self.expected[name] = colors
            self.browser.save_screenshot(str(self.folder / f"{name}.png"))
            return
        differences = [abs(a - b) for a, b in zip(colors, bytes.fromhex(self.expected[name]), strict=True)]
        self.assertLess(statistics.mean(differences), 4, name)
        self.assertLess(sorted(differences)[len(differences) * 97 // 100], 40, name)

    def test_every_page_is_shown(self):
        for name in self.pages:
            with self.subTest(name=name):
                self.open(name)
                self.check_picture(name)
                self.assertLessEqual(self.js("return delone.picture.stats.drawCalls"), 2)
                self.assertEqual(self.browser.get_log("browser"), [])

    def test_picks_in_the_plane(self):
        self.open("plane")
        width, height = self.js("const c = delone.picture.canvas; return [c.clientWidth, c.clientHeight]")
        numbers, found = random.Random(1), 0
        for _ in range(30):
            x, y = numbers.randrange(width), numbers.randrange(height)
            expected = self.js(FIND_TRIANGLE, x, y)
            self.assertEqual(self.pick(x, y), expected, (x, y))
            found += expected is not None
        self.assertGreater(found, 8)

    def test_pointer_names_cells(self):
        self.open("plane")
        canvas, tip = self.browser.find_element(By.ID, "picture"), self.browser.find_element(By.ID, "tip")
        ActionChains(self.browser).move_to_element(canvas).perform()
        self.wait("return !document.getElementById('tip').hidden")
        text = tip.text.splitlines()
        self.assertRegex(text[0], r"^cell \d+$")
        cell = int(text[0].split()[1])
        rows = self.js("const c = arguments[0]; return Array.from(delone.scene.cells.subarray(3 * c, 3 * c + 3)).map((v) => delone.scene.rows[v])", cell)
        self.assertEqual(text[1], "rows " + ", ".join(map(str, rows)))
        self.assertEqual([line.split()[0] for line in text[2:]], ["circumradius", "quality"])
        self.assertLessEqual(self.js("return delone.picture.stats.drawCalls"), 2)
        canvas.send_keys(Keys.ESCAPE)
        self.assertFalse(tip.is_displayed())

    def test_filters(self):
        self.open("plane")
        cells = self.js("return delone.scene.numCells")
        self.slide("filter-high", 500)
        half = self.js("return delone.numShown")
        self.assertAlmostEqual(half / cells, 0.5, delta=0.02)
        self.assertEqual(self.js("return delone.picture.mesh.geometry.drawRange.count"), 3 * half)
        shown = self.js("const q = delone.quantities.get('radius'); let largest = 0; delone.shownCells.forEach((s, i) => { if (s) largest = Math.max(largest, q.values[i]); });"
                        "return [largest, q.quantile(0.5)]")
        self.assertLessEqual(*shown)
        self.check_picture("plane, small cells")
        self.choose("filter", "quality")
        self.slide("filter-high", 1000)
        self.assertEqual(self.js("return delone.numShown"), cells)

    def test_slices(self):
        self.open("space")
        cells, first = self.js("return [delone.scene.numCells, delone.numShown]")
        self.check_box("slice-flip")
        self.assertEqual(self.js("return delone.numShown") + first, cells)
        self.check_box("slice")
        self.assertEqual(self.js("return delone.numShown"), cells)
        self.check_picture("space, all")
        faces = self.js("let n = 0; for (const c of delone.model.cells[1]) if (c === 0xffffffff) ++n; return n")
        self.assertEqual(self.js("return delone.picture.mesh.geometry.drawRange.count"), 3 * faces)
        self.check_box("slice-flip")
        self.choose("slice-axis", 0)
        self.slide("slice-at", 300)
        beyond = self.js("const p = delone.slicePlane(); let n = 0; for (let i = 0; i < delone.centroids.length; i += 3) if (delone.centroids[i] <= p.offset) ++n; return n")
        self.assertEqual(self.js("return delone.numShown"), beyond)
        self.check_picture("space, sliced")

    def test_hull_voronoi_and_faces(self):
        self.open("plane")
        hull = self.js("return delone.overlays.hull.count")
        self.assertGreater(hull, 8)
        self.check_box("dual")
        edges = self.js("return delone.overlays.dual.count")
        self.assertGreater(edges, 800)
        self.check_picture("plane, Voronoi")
        self.assertEqual(self.js("return delone.picture.stats.drawCalls"), 2)
        self.choose("faces", "none")
        self.assertEqual(self.js("return delone.picture.stats.drawCalls"), 1)
        self.open("space")
        self.check_box("hull")
        self.check_box("dual")
        self.choose("faces", "glass")
        self.check_picture("space, glass")
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_regions_know_their_rows(self):
        self.open("diagram2")
        x, y = self.js("const c = delone.picture.canvas; return [c.clientWidth / 2, c.clientHeight / 2]")
        region = self.pick(x, y)
        self.assertIn(f"of row {region}", self.browser.find_element(By.ID, "tip").text)
        volumes = self.js("return Array.from(delone.scene.volume)")
        self.assertAlmostEqual(sum(volumes), 1.44, delta=0.03)  # of the box

    def test_more_than_three_dimensions(self):
        self.open("four")
        before = self.js("return Array.from(delone.space.positions.slice(0, 3))")
        self.choose("axis0", 3)
        self.assertNotEqual(self.js("return Array.from(delone.space.positions.slice(0, 3))"), before)
        self.choose("projection", "slanted")
        self.assertTrue(all(row[0] != 0 for row in self.js("return delone.space.rows")))  # coordinate 3 is shown in the place of 0
        self.choose("projection", "principal")
        rows = self.js("return delone.space.rows")
        for a in range(3):
            for b in range(3):
                self.assertAlmostEqual(sum(x * y for x, y in zip(rows[a], rows[b])), a == b, places=9)
        self.settle()
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_keys(self):
        self.open("space")
        canvas = self.browser.find_element(By.ID, "picture")
        camera = "return delone.picture.camera.position.toArray()"
        before = self.js(camera)
        canvas.send_keys(Keys.ARROW_LEFT)
        turned = self.js(camera)
        self.assertNotEqual(turned, before)
        self.assertAlmostEqual(turned[2], before[2], places=9)
        canvas.send_keys("+")
        self.settle()
        canvas.send_keys("0")
        self.settle()
        for a, b in zip(self.js(camera), before):
            self.assertAlmostEqual(a, b, places=3)
        canvas.send_keys(Keys.ENTER)
        self.wait("return document.getElementById('named').textContent.startsWith('cell ')")

    def test_colors(self):
        self.open("space")
        for color in ("radius", "axis2", "none", "quality"):
            self.choose("color", color)
        self.choose("scale", "rank")
        ranks = self.js("return Array.from(delone.color.scalars())")
        self.assertAlmostEqual(statistics.mean(ranks), 0.5, delta=0.02)
        self.choose("scale", "linear")
        self.choose("map", "cividis")
        self.check_picture("space, cividis")
        self.assertEqual(self.browser.find_element(By.CSS_SELECTOR, "#legend .name").text, "quality")

    def test_dark(self):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        try:
            self.open("hull")
            self.check_picture("hull, dark")
        finally:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_on_a_phone(self):
        browser, profile = start(WEBGL, phone=True)
        try:
            for name in ("plane", "space"):
                self.open(name, browser)
                self.assertLessEqual(browser.execute_script("return document.documentElement.scrollWidth"), 390)
                self.assertGreater(browser.execute_script("return delone.picture.canvas.clientHeight"), 500)
                browser.find_element(By.ID, "fold").click()
                self.assertTrue(browser.find_element(By.ID, "color").is_displayed())
                self.assertEqual(browser.get_log("browser"), [])
        finally:
            stop(browser, profile)

    def test_without_webgl(self):
        browser, profile = start(["--disable-3d-apis"])
        try:
            self.open("plane", browser)
            self.assertIn("This page needs WebGL 2", browser.find_element(By.ID, "notice").text)
        finally:
            stop(browser, profile)

    def test_values_are_named_and_missing_ones_grey(self):
        points, page = self.folder / "named.csv", self.folder / "named.html"
        points.write_text("lon,lat,depth\n0,0,1\n1,0,2\n1,1,3\n0,1,4\n0.5,0.4,5\n")
        subprocess.run([DELONE, "view", "-q", points, "--values", "depth", "--title", "</script><b>", "-o", page], check=True)
        self.pages["named"] = page
        self.open("named")
        self.assertEqual(self.js("return document.title"), "</script><b>")
        self.assertEqual(self.js("return [delone.scene.columns, delone.scene.valueName]"), [["lon", "lat"], "depth"])
        self.assertEqual(self.ticks(), ["1", "2", "3", "4", "5"])
        self.assertEqual(self.browser.find_element(By.CSS_SELECTOR, "#legend .why").text, "")
        self.assertEqual(self.js("return document.getElementById('scale').value"), "linear")

    def ticks(self):
        return [span.text for span in self.browser.find_elements(By.CSS_SELECTOR, "#legend .ticks span")]

    def test_one_value_does_not_fill_the_scale(self):
        numbers, points, page = random.Random(2), self.folder / "skewed.csv", self.folder / "skewed.html"
        values = [*range(1, 101), 1_000_000]
        points.write_text("x,y,v\n" + "".join(f"{numbers.random()},{numbers.random()},{v}\n" for v in values))
        subprocess.run([DELONE, "view", "-q", points, "--values", "v", "-o", page], check=True)
        self.pages["skewed"] = page
        self.open("skewed")
        legend = self.browser.find_element(By.ID, "legend")
        self.assertEqual(self.js("return document.getElementById('scale').value"), "rank")
        self.assertEqual(legend.text.splitlines()[0], "v (by rank)")
        self.assertIn("Most values are close together, so each color is used equally often.", " ".join(legend.text.splitlines()))
        ticks = [float(text) for text in self.ticks()]
        self.assertEqual((ticks[0], ticks[-1]), (1, 1e6))
        self.assertTrue(all(abs(tick - number) < 3 for tick, number in zip(ticks[1:4], (26, 51, 76))))
        colors = self.js("return Array.from(delone.color.scalars())")
        self.assertLess(sum(color < 0.1 for color in colors), 15)
        for scale, most in (("linear", 0.02), ("log", 0.34)):
            self.choose("scale", scale)
            self.assertNotIn("equally often", legend.text)
            self.assertLess(sorted(self.js("return Array.from(delone.color.scalars())"))[-2], most)
        self.assertEqual([float(text) for text in self.ticks() if text], [1, 31.62, 1000, 31620, 1e6])
        self.choose("scale", "rank")
        self.assertIn("Each color is used equally often.", " ".join(legend.text.splitlines()))

    def test_equal_values_have_equal_ranks(self):
        self.open("plane")
        ranks = self.js("const q = Object.create(Object.getPrototypeOf(delone.quantities.get('axis0'))); q.sorted = Float32Array.of(0, 0, 0, 5);"
                        "return [q.rankOf(0), q.rankOf(5)]")
        self.assertAlmostEqual(ranks[0], 1 / 3)
        self.assertEqual(ranks[1], 1)

    def test_large_sets_show_an_outline(self):
        self.pages["dust"] = self.view("uniform", 60_000, 2)
        self.open("dust")
        self.settle()
        legend, cells = self.browser.find_element(By.ID, "legend"), self.js("return delone.scene.numCells")
        state = "return [delone.isOutline, delone.picture.uniforms.colored.value, delone.picture.uniforms.edgeWidth.value > 0]"
        self.assertEqual(self.js(state), [True, False, False])
        self.assertIn(f"The outline of {cells // 1000}\u202f{cells % 1000:03} cells, too small to be seen here, and a sample of points.",
                      " ".join(legend.text.splitlines()))
        self.assertFalse(legend.find_element(By.CLASS_NAME, "bar").is_displayed())
        self.assertLessEqual(self.js("return delone.overlays.sample.count"), 1500)
        self.js("delone.picture.zoom(12)")
        self.settle()
        self.assertEqual(self.js(state), [False, True, True])
        self.assertEqual(self.ticks()[0], "0")
        self.js("delone.picture.zoom(1 / 12)")
        self.settle()
        self.assertEqual(self.js(state), [True, False, False])
        self.choose("color", "radius")
        self.assertEqual(self.js(state), [False, True, True])
        self.choose("color", "axis0")
        self.js("document.getElementById('outline').click()")
        self.settle()
        self.assertEqual(self.js(state), [False, True, True])  # what varies slowly is no dust

    def test_large_sets_of_space_show_their_hull(self):
        self.pages["fog"] = self.view("uniform", 30_000, 3)
        self.browser.set_window_size(780, 200)
        try:
            self.open("fog")
            self.settle()
            cells = self.js("return delone.scene.numCells")
            self.assertFalse(self.js("return delone.plane.on"))
            self.assertEqual(self.js("return document.getElementById('color').value"), "axis2")
            legend = self.browser.find_element(By.ID, "legend")
            note = f"The outline of {cells // 1000}\u202f{cells % 1000:03} cells. Slice to see inside."
            self.assertIn(note, " ".join(legend.text.splitlines()))
            self.js("document.getElementById('slice').click()")
            self.settle()
            self.assertNotIn("outline", legend.text)
        finally:
            self.browser.set_window_size(1200, 800)
        self.open("fog")
        self.assertTrue(self.js("return delone.plane.on"))

    def test_alpha_complexes_are_shown_whole(self):
        self.open("alpha")
        self.assertEqual(self.js("return [delone.plane.on, delone.numShown === delone.scene.numCells, delone.scene.dual]"), [False, True, False])
        self.assertEqual(self.js("return document.getElementById('color').value"), "axis2")

    def test_loading_shows_how_much_is_done(self):
        self.pages["loaded"] = self.view("uniform", 30_000, 3)
        added = self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": """
            window.parts = []; window.texts = new Set();
            new MutationObserver(() => {
              const bar = document.querySelector("#notice progress");
              if (bar?.hasAttribute("value")) { parts.push(bar.value); texts.add(document.querySelector("#notice p").textContent); }
            }).observe(document, { attributes: true, subtree: true, attributeFilter: ["value"] });"""})
        try:
            self.open("loaded")
        finally:
            self.browser.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)
        parts, texts = self.js("return [parts, [...texts]]")
        self.assertGreater(len(parts), 3)
        self.assertEqual(parts, sorted(parts))
        self.assertTrue(0 < parts[0] < 0.5 < parts[-1] <= 1, parts)
        cells = self.js("return delone.scene.numCells")
        self.assertRegex(texts[0], rf"^Reading {cells // 1000}.{cells % 1000:03} cells, \d\.\d MB$")

    def test_the_picture_of_the_readme_is_what_the_page_opens_with(self):
        command, picture = re.search(r"(delone [^\n]*) -o protein\.html`[^!]*!\[[^]]*\]\((docs/pictures/view_\w+\.png)\)", (ROOT / "README.md").read_text()).groups()
        page = self.folder / "protein.html"
        subprocess.run([DELONE, *command.split()[1:], "-o", page], check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
        self.pages["readme"] = page
        browser, profile = start([*WEBGL, "--window-size=1200,760", "--force-device-scale-factor=1.25"])
        try:
            self.open("readme", browser)
            self.wait("return !delone.picture.busy", browser)
            time.sleep(0.3)
            shot = self.folder / "readme.png"
            browser.save_screenshot(str(shot))
        finally:
            stop(browser, profile)
        found, shown = (Image.open(file).convert("RGB").resize((48, 30)).tobytes() for file in (shot, ROOT / picture))
        differences = sorted(abs(a - b) for a, b in zip(found, shown, strict=True))
        self.assertLess(statistics.mean(differences), 3)
        self.assertLess(differences[len(differences) * 98 // 100], 30)

    def test_many_triangles(self):
        large = bool(os.environ.get("LARGE"))
        self.pages["many"] = self.view("uniform", 500_500 if large else 20_000, 2)
        size = self.pages["many"].stat().st_size
        self.open("many")
        self.js("const s = delone.picture.stats; s.scriptMs.length = s.frameMs.length = 0;"
                "window.turns = 0; (function step() { delone.picture.zoom(1.004); if (++turns < 60) requestAnimationFrame(step); })()")
        self.wait("return turns >= 60")
        self.slide("filter-high", 700)
        stats = self.js("return delone.picture.stats")
        scripts = sorted(stats["scriptMs"])
        print(f"\n{self.js('return delone.scene.numCells')} triangles: page {size / 1e6:.1f} MB, first frame {stats['firstFrameMs']:.0f} ms, "
              f"{1000 / statistics.median(stats['frameMs']):.1f} frames/s, script {statistics.median(scripts):.2f} ms per frame "
              f"({scripts[len(scripts) * 95 // 100]:.2f} at the 95th percentile), {stats['drawCalls']} draw calls")
        self.assertLessEqual(stats["drawCalls"], 2)
        self.assertLess(statistics.median(scripts), 4)
        if large:
            self.assertGreaterEqual(self.js("return delone.scene.numCells"), 1_000_000)
            self.assertLess(size, 25e6)


if __name__ == "__main__":
    unittest.main()
