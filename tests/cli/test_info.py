# SPDX-License-Identifier: BSD-3-Clause
"""delone info: what a file holds."""
import unittest

from cli_support import Case


class Info(Case):
    def test_points_and_triangulations(self):
        points = self.uniform(3, 50)
        text = self.output("info", points)
        self.assertIn("points\n", text)
        self.assertRegex(text, r"affine dimension +3\n")
        for name in ("t.npz", "t.json", "t.off"):
            self.output("delaunay", points, "-o", self.path(name))
            text = self.output("info", self.path(name))
            self.assertIn("a Delaunay triangulation", text)
            self.assertIn(self.stats(points)["hash"], text)
        self.assertIn("points\n", self.output("info", "-", stdin="2\n3\n0 0\n1 0\n2 0\n"))
        self.assertIn("points\n", self.output("info", self.file("p.off", "OFF\n1 0 0\n0 0 0\n")))
        self.complaint("info", self.path("missing.npz"))

    def test_other_results(self):
        points = self.uniform(2, 30)
        self.file("halfspaces.csv", "1,0,-1\n-1,0,0\n0,1,-1\n0,-1,0\n")
        for command, source, name, expected in (("hull", points, "h.npz", "a convex hull"), ("voronoi", points, "v.json", "a Voronoi diagram"),
                                                ("halfspaces", self.path("halfspaces.csv"), "i.json", "an intersection of halfspaces")):
            self.output(command, source, "-o", self.path(name))
            text = self.output("info", self.path(name))
            self.assertIn(f": {expected}\n", text)
            self.assertRegex(text, r"\n  dimension +2\n")
            self.assertRegex(text, r"\n  vertices +[1-9]")


if __name__ == "__main__":
    unittest.main()
