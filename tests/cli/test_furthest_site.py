# SPDX-License-Identifier: BSD-3-Clause
"""delone delaunay --furthest-site, and delone check of what it writes."""
import json
import unittest

from cli_support import Case, np


class FurthestSite(Case):
    def test_triangulation_and_check(self):
        points = self.file("points.csv", "x,y\n0,0\n4,0\n5,3\n0,4\n2,2\n0,0\n")
        stats = json.loads(self.output("delaunay", points, "--furthest-site", "--stats"))
        self.assertEqual((stats["vertices"], stats["duplicates"], stats["hidden"], stats["cells"]), (4, 1, 1, 2))
        for name in ("t.npz", "t.json"):
            written = self.path(name)
            self.output("delaunay", points, "--furthest-site", "-o", written)
            self.assertIn("a furthest-site Delaunay triangulation",
                          self.output("check", written, "--canonical"))
            self.assertIn(stats["hash"], self.output("info", written))
        nearest = self.path("nearest.npz")
        self.output("delaunay", points, "-o", nearest)
        with np.load(nearest) as data:
            np.savez(nearest, **{name: data[name] for name in data.files if name != "kind"})
        self.assertIn(b"outside the sphere", self.run_delone("check", nearest, "--furthest-site", status=1).stdout)

    def test_scipy_agrees_and_passes(self):
        try:
            from scipy.spatial import Delaunay
        except ImportError:
            self.skipTest("no SciPy")
        for dimension, n in ((2, 300), (3, 200), (4, 80), (5, 40)):
            points = np.random.default_rng(dimension).normal(size=(n, dimension))
            np.save(self.path("points.npy"), points)
            self.output("delaunay", self.path("points.npy"), "--furthest-site", "-o", self.path("t.npz"))
            with np.load(self.path("t.npz")) as data:
                ours = {tuple(sorted(cell)) for cell in data["cells"].tolist()}
            cells = Delaunay(points, furthest_site=True).simplices
            self.assertEqual(ours, {tuple(sorted(cell)) for cell in cells.tolist()})
            np.savez(self.path("scipy.npz"), points=points, cells=cells.astype(np.int32), affine_dimension=dimension)
            self.output("check", self.path("scipy.npz"), "--furthest-site", "--any-orientation")


if __name__ == "__main__":
    unittest.main()
