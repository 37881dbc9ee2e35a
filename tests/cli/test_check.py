# SPDX-License-Identifier: BSD-3-Clause
"""delone check: right triangulations pass, each kind of wrong one fails at its level."""
import re
import subprocess
import unittest

from cli_support import Case, DELONE, np


class Check(Case):
    def setUp(self):
        super().setUp()
        self.output("generate", "uniform", "-d", 3, "-n", 80, "-o", self.path("points.npy"))
        self.output("delaunay", self.path("points.npy"), "-o", self.path("good.npz"))
        with np.load(self.path("good.npz")) as data:
            self.good = {name: data[name] for name in data.files}

    def violation(self, arrays, level, *arguments):
        path = self.path("bad.npz")
        np.savez(path, **arrays)
        done = self.run_delone("check", path, *arguments, status=1)
        text = done.stdout.decode()
        self.assertEqual(done.stderr, b"")
        self.assertRegex(text, rf"level {level}  [a-z ]+ FAILED")
        self.assertRegex(text, r"\nviolation: .+\n")
        self.assertNotIn(f"level {level + 1}", text)

    def test_good(self):
        text = self.output("check", self.path("good.npz"))
        self.assertEqual(re.findall(r"^level (\d)  [a-z ]+ ok ", text, re.M), list("123456"))
        self.assertEqual(re.findall(r"^level (\d)", self.output("check", self.path("good.npz"), "--level", 3), re.M), list("123"))

    def test_without_neighbors_and_under_other_names(self):
        np.savez(self.path("other.npz"), points=self.good["points"], simplices=self.good["cells"].astype(np.int64))
        self.output("check", self.path("other.npz"))

    def test_vertex_out_of_range_or_repeated(self):
        cells = self.good["cells"].copy()
        cells[7, 1] = 5000
        self.violation({**self.good, "cells": cells}, 1)
        cells[7, 1] = cells[7, 0]
        self.violation({**self.good, "cells": cells}, 1)

    def test_wrong_neighbor(self):
        neighbors = self.good["neighbors"].copy()
        neighbors[3] = np.roll(neighbors[3], 1)
        self.violation({**self.good, "neighbors": neighbors}, 2)

    def test_missing_cell(self):
        done = self.path("bad.npz")
        np.savez(done, points=self.good["points"], cells=self.good["cells"][1:])
        self.run_delone("check", done, status=1)

    def test_wrong_diagonal(self):
        points = np.array([[-2.0, 0], [2, 0], [0, 1], [0, -1]])
        self.violation({"points": points, "cells": np.array([[0, 1, 2], [1, 0, 3]])}, 5)
        np.savez(self.path("right.npz"), points=points, cells=np.array([[0, 3, 2], [1, 2, 3]]))
        self.output("check", self.path("right.npz"))

    def test_moved_point(self):
        points = self.good["points"].copy()
        points[self.good["cells"][0, 0]] += 0.3
        path = self.path("bad.npz")
        np.savez(path, **{**self.good, "points": points})
        self.run_delone("check", path, status=1)
        np.save(self.path("moved.npy"), points)
        self.run_delone("check", self.path("good.npz"), "--points", self.path("moved.npy"), status=1)
        self.output("check", path, "--points", self.path("points.npy"))

    def test_cells_of_any_orientation(self):
        self.violation({"points": self.good["points"], "cells": np.sort(self.good["cells"], axis=1)}, 2)
        self.output("check", self.path("bad.npz"), "--any-orientation")

    def test_forgotten_point(self):
        points = np.vstack([self.good["points"], [[0.5, 0.5, 0.5]]])
        self.violation({"points": points, "cells": self.good["cells"]}, 6)

    def test_ties(self):
        points = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]])
        results = []
        for name, cells in (("a.npz", [[0, 1, 2], [3, 2, 1]]), ("b.npz", [[0, 1, 3], [0, 3, 2]])):
            np.savez(self.path(name), points=points, cells=np.array(cells))
            self.assertIn("ties: 1 ", self.output("check", self.path(name)))
            done = subprocess.run([DELONE, "check", self.path(name), "--canonical"], capture_output=True, timeout=60)
            results.append(done.returncode)
        self.assertEqual(sorted(results), [0, 1])

    def test_not_a_triangulation(self):
        self.complaint("check", self.path("missing.npz"))
        self.complaint("check", self.file("a.npz", "nonsense"))
        self.complaint("check", self.file("a.json", '{"points": 3}'))
        self.complaint("check", self.path("points.npy"))


if __name__ == "__main__":
    unittest.main()
