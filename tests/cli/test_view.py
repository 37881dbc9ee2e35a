# SPDX-License-Identifier: BSD-3-Clause
"""delone view, and the format html."""
import json
import os
import re
import unittest

from cli_support import Case


class View(Case):
    def scene(self, *arguments, **options):
        page = self.output("view", "-q", *arguments, **options)
        return json.loads(re.search(r'id="delone-scene">(.*?)</script>', page).group(1))

    def test_points_and_results(self):
        points = self.file("p.csv", "lon,lat,depth\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n0.5,0.25,5\n")
        scene = self.scene(points, "--values", "depth")
        self.assertEqual([scene[name] for name in ("kind", "title", "columns", "numCells", "valueName")], ["triangulation", "p", ["lon", "lat"], 4, "depth"])
        self.assertEqual(self.scene(points, "--columns", "lon,lat", "--of", "hull")["kind"], "hull")
        self.assertEqual(self.scene(points, "--columns", "lon,lat", "--of", "voronoi", "--box", "0,0,2,2")["high"], [2, 2])
        for command in ("delaunay", "hull", "voronoi"):
            result = self.path(command + ".npz")
            self.run_delone(command, points, "--columns", "lon,lat", "-o", result)
            self.assertEqual(self.scene(result, "--title", "T")["title"], "T")
            self.run_delone(command, points, "--columns", "lon,lat", "-o", self.path("page.html"))
        values = self.file("v.txt", "1\n2\n3\n4\n")
        self.assertEqual(self.scene(points, "--columns", "lon,lat", "--values", "-", stdin="1\n5\n1\n2\n3\n4\n5\n")["valueName"], "-")
        self.file("2", "7\n" * 5)  # the number is that of a column
        self.assertEqual(self.scene(points, "--values", "2", cwd=self.folder.name)["valueName"], "depth")
        self.assertFalse(self.scene(self.path("delaunay.npz"), "--values", values)["valueOfVertices"])

    def test_many_cells_tell_their_size(self):
        points = self.uniform(2, 101_000)
        page, path = self.run_delone("view", points, "-o", self.path("page.html")), self.path("page.html")
        before, after = page.stderr.decode().splitlines()
        cells, expected = re.fullmatch(re.escape(path) + r": a page of (\d+) cells, about (\d+) MB", before).groups()
        size = re.fullmatch(re.escape(path) + rf": {cells} cells, ([\d.]+) MB", after).group(1)
        self.assertGreater(int(cells), 200_000)
        self.assertAlmostEqual(float(size), os.path.getsize(path) / 1e6, delta=0.06)
        self.assertLess(abs(int(expected) - float(size)), 0.6 * float(size))  # without zlib pages are larger
        self.assertEqual(self.run_delone("view", "-q", points, "-o", path, "--force").stderr, b"")
        self.assertEqual(self.run_delone("view", self.uniform(2, 100), "-o", path, "--force").stderr, b"")

    def test_what_is_refused(self):
        points = self.uniform(2, 10)
        self.assertIn("3 numbers for 10 rows", self.complaint("view", points, "--values", self.file("v.txt", "1\n2\n3\n")))
        self.run_delone("delaunay", points, "-o", self.path("t.npz"))
        self.assertIn("there is no such file", self.complaint("view", self.path("t.npz"), "--values", "depth", status=64))
        self.assertIn("both standard input", self.complaint("view", "-", "--values", "-", status=64, stdin="1 2\n"))
        text = self.complaint("view", points, "--values", "-", "--max-stream", "5", status=3, stdin="1\n5\n1\n2\n3\n4\n5\n")
        self.assertIn("standard input: a stream of more than 5 bytes; raise --max-stream", text)
        self.assertIn("limit of 1e-06 seconds", self.complaint("view", points, "--time", "1e-6", status=3))
        self.assertIn("--memory", self.complaint("view", points, "--memory", "1M", status=3))
        self.assertIn("--box takes 4 numbers", self.complaint("view", points, "--of", "voronoi", "--box", "0,1", status=64))


if __name__ == "__main__":
    unittest.main()
