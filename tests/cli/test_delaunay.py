# SPDX-License-Identifier: BSD-3-Clause
"""delone delaunay: its files, statistics and progress."""
import pathlib
import json
import os
import pty
import subprocess
import unittest
import xml.etree.ElementTree
import zipfile

from cli_support import CUBE, Case, DELONE, STATS, np


class Delaunay(Case):
    def test_stats(self):
        points = self.uniform(4, 500)
        stats = self.stats(points, "--seed", 5)
        self.assertEqual(list(stats), list(STATS))
        for name, kind in STATS.items():
            self.assertIs(type(stats[name]), kind, name)
        self.assertEqual(list(stats["seconds"]), ["read", "order", "build", "write", "total"])
        self.assertTrue(all(type(v) is float and v >= 0 for v in stats["seconds"].values()))
        self.assertEqual(list(stats["stages"]), ["filter", "direct", "exact", "perturbed"])
        self.assertEqual((stats["command"], stats["dimension"], stats["affine_dimension"], stats["points"], stats["vertices"]),
                         ("delaunay", 4, 4, 500, 500))
        self.assertEqual((stats["duplicates"], stats["hidden"], stats["threads"], stats["seed"]), (0, 0, 1, 5))
        self.assertRegex(stats["hash"], r"\A[0-9a-f]{32}\Z")
        self.assertGreater(stats["created_cells"], stats["cells"])
        self.assertGreater(stats["peak_rss_bytes"], 500 * 4 * 8)
        self.assertGreaterEqual(stats["bytes_per_cell"], 2 * 5 * 4)

    def test_trim(self):
        points, out = self.path("points.npy"), self.path("out.npz")
        np.save(points, np.vstack([CUBE[::2, :2] * 4, [[2, 0.01]]]))
        stats = json.loads(self.output("delaunay", points, "--trim", 0.1, "--stats", "-o", out))
        self.assertEqual((stats["removed_cells"], stats["orphans"]), (1, 0))
        self.assertAlmostEqual(stats["depth"], 0.01, 12)
        self.assertAlmostEqual(stats["lost_volume"], 0.02, 12)
        with np.load(out) as data:
            self.assertEqual(len(data["cells"]), stats["cells"] - 1)
        self.assertIn("1 cells", self.output("delaunay", points, "--trim", 0.1))
        self.complaint("delaunay", points, "--trim=-1", status=64)
        self.assertIn("larger than the set", self.complaint("delaunay", points, "--trim", 100))

    def test_stats_with_output(self):
        points, out = self.uniform(3, 200), self.path("out.npz")
        stats = self.stats(points, "-o", out)
        with np.load(out) as data:
            self.assertEqual(len(data["cells"]), stats["cells"])
        self.assertEqual(stats["hash"], self.stats(points)["hash"])

    def test_the_path_does_not_change_the_end(self):
        for kind, d in (("uniform", 3), ("grid", 3), ("duplicates", 2), ("flat", 4), ("uniform", 5)):
            points = self.path("points.npy")
            self.output("generate", kind, "-d", d, "-n", 150, "-o", points)
            hashes = {self.stats(points, *options)["hash"]
                      for options in ([], ["--seed", 9], ["--order", "as_given"], ["--order", "shuffled"], ["--runtime-dimension"])}
            self.assertEqual(len(hashes), 1, kind)

    def test_summary_is_for_reading(self):
        points = self.uniform(2, 100)
        text = self.output("delaunay", points)
        self.assertIn("100 points in dimension 2", text)
        self.assertEqual(self.output("delaunay", points, "-o", self.path("out.npz")), "")

    def test_threads_change_nothing(self):
        for d, n in ((2, 2000), (3, 1000), (4, 200)):
            points = self.uniform(d, n)
            out = [self.path(f"{threads}.npz") for threads in (0, 1, 2, 3)]
            for threads, path in zip((0, 1, 2, 3), out):
                self.output("delaunay", points, "--threads", threads, "-o", path)
            for other in out[1:]:
                self.assertEqual(pathlib.Path(out[0]).read_bytes(), pathlib.Path(other).read_bytes())

    def test_npz(self):
        for kind, d, n in (("uniform", 2, 100), ("uniform", 3, 200), ("uniform", 5, 60), ("grid", 3, 64), ("duplicates", 2, 100),
                           ("flat", 3, 50), ("collinear", 3, 20), ("equal", 2, 5)):
            points, out = self.path("points.npy"), self.path("out.npz")
            self.output("generate", kind, "-d", d, "-n", n, "-o", points)
            self.output("delaunay", points, "-o", out)
            with np.load(out) as data:
                arrays = {name: data[name] for name in data.files}
            self.assertEqual(sorted(arrays), ["affine_dimension", "cells", "kind", "neighbors", "points", "vertex_of_point"])
            k = int(arrays["affine_dimension"])
            self.assertEqual(arrays["affine_dimension"].shape, ())
            self.assertEqual(arrays["points"].dtype, np.float64)
            np.testing.assert_array_equal(arrays["points"], np.load(points))
            cells, neighbors, vertex_of_point = arrays["cells"], arrays["neighbors"], arrays["vertex_of_point"]
            for array in (cells, neighbors, vertex_of_point, arrays["affine_dimension"]):
                self.assertEqual(array.dtype.kind, "i")
                self.assertIn(array.dtype.itemsize, (4, 8))
            self.assertEqual(cells.shape, neighbors.shape)
            self.assertEqual(cells.shape[1], k + 1)
            self.assertEqual(vertex_of_point.shape, (n,))
            np.testing.assert_array_equal(arrays["points"][vertex_of_point], arrays["points"])
            self.assertEqual(set(np.unique(cells)), set(np.unique(vertex_of_point)))
            for c, (vertices, row) in enumerate(zip(cells, neighbors)):
                for i, neighbor in enumerate(row):
                    if neighbor < 0:
                        self.assertEqual(neighbor, -1)
                        continue
                    facet = set(vertices) - {vertices[i]}
                    self.assertTrue(facet < set(cells[neighbor]) and vertices[i] not in cells[neighbor])
                    mirror = [j for j in range(k + 1) if cells[neighbor][j] not in facet]
                    self.assertEqual(neighbors[neighbor][mirror[0]], c)
            if k == d == 2:
                a, b, c = (arrays["points"][cells[:, i]] for i in range(3))
                self.assertTrue((np.linalg.det(np.stack([b - a, c - a], axis=1)) > 0).all())

    def test_every_format(self):
        points = self.path("points.npy")
        np.save(points, CUBE[:, :2][::2] + np.array([[0, 0], [0.5, 0], [0, 0.25], [0, 0]]))
        cells = 2

        self.output("delaunay", points, "-o", self.path("out.json"))
        with open(self.path("out.json")) as f:
            data = json.load(f)
        self.assertEqual((len(data["points"]), len(data["cells"]), len(data["neighbors"]), data["affine_dimension"]), (4, cells, cells, 2))
        self.assertEqual(data["vertex_of_point"], [0, 1, 2, 3])

        self.output("delaunay", points, "-o", self.path("out.txt"))
        with open(self.path("out.txt")) as f:
            lines = f.read().split("\n")
        self.assertEqual(int(lines[0]), cells)
        self.assertEqual([len(line.split()) for line in lines[1:]], [3] * cells + [0])

        self.output("delaunay", points, "-o", self.path("out.npy"))
        self.assertEqual(np.load(self.path("out.npy")).shape, (cells, 3))

        self.output("delaunay", points, "-o", self.path("out.off"))
        with open(self.path("out.off")) as f:
            self.assertIn("OFF", f.readline())

        self.output("delaunay", points, "-o", self.path("out.svg"))
        self.assertTrue(xml.etree.ElementTree.parse(self.path("out.svg")).getroot().tag.endswith("svg"))

        self.output("delaunay", points, "-o", self.path("out.vtu"))
        with open(self.path("out.vtu"), "rb") as f:  # the arrays follow in binary, which is VTK's way and not XML's
            head = f.read().split(b"<AppendedData")[0] + b"</VTKFile>"
        piece = xml.etree.ElementTree.fromstring(head).find(".//Piece")
        self.assertEqual((piece.get("NumberOfPoints"), piece.get("NumberOfCells")), ("4", str(cells)))

        self.output("delaunay", points, "-o", self.path("other"), "--output-format", "npz")
        self.assertTrue(zipfile.is_zipfile(self.path("other")))
        text = self.output("delaunay", points, "-o", "-", "--output-format", "txt")
        self.assertEqual(text.split("\n"), lines)

    def test_what_is_written_can_be_checked(self):
        for kind, d in (("uniform", 3), ("grid", 3), ("cospherical", 4), ("flat", 3), ("duplicates", 2)):
            points = self.path("points.npy")
            self.output("generate", kind, "-d", d, "-n", 60, "-o", points)
            for name in ("out.npz", "out.json", "out.off"):
                self.output("delaunay", points, "-o", self.path(name))
                self.assertIn("level 6", self.output("check", self.path(name), "--canonical"))


    def on_terminal(self, *arguments):
        """What goes to standard error when that is a terminal."""
        main, terminal = pty.openpty()
        process = subprocess.Popen([DELONE, *arguments], stdout=subprocess.PIPE, stderr=terminal)
        os.close(terminal)
        text = b""
        try:
            while chunk := os.read(main, 4096):
                text += chunk
        except OSError:  # the other end was closed
            pass
        os.close(main)
        out = process.communicate(timeout=60)[0]
        self.assertEqual(process.returncode, 0)
        return text.decode(), out.decode()

    def test_progress_bar(self):
        for n in (8000, 32000, 128000):  # the bar appears after half a second, which is long for some machines
            points = self.uniform(5, n)
            drawn, out = self.on_terminal("delaunay", points, "--stats")
            if json.loads(out)["seconds"]["build"] > 0.8:
                break
        self.assertRegex(drawn, r"\r\[=* *\] +\d+ %")
        self.assertRegex(drawn, r"\r\x1b\[K\Z")
        self.assertEqual(self.on_terminal("delaunay", points, "--stats", "--quiet")[0], "")


if __name__ == "__main__":
    unittest.main()
