# SPDX-License-Identifier: BSD-3-Clause
"""delone alpha: alpha complexes and their boundaries."""
import json
import unittest

from cli_support import Case, STATS, np


class Alpha(Case):
    def test_a_rectangle_at_exactly_its_radius(self):
        points = self.file("rectangle.txt", "0 0\n3 0\n3 4\n0 4\n")
        stats = json.loads(self.output("alpha", points, "--radius", "2.5", "--stats"))
        self.assertEqual(set(STATS) - set(stats), set())
        self.assertEqual([stats[key] for key in ("command", "radius", "alpha_cells", "boundary_facets", "singular_facets")], ["alpha", 2.5, 2, 4, 0])
        stats = json.loads(self.output("alpha", points, "--radius", "2.4999999999999996", "--stats"))
        self.assertEqual([stats[key] for key in ("alpha_cells", "boundary_facets", "singular_facets")], [0, 0, 4])
        self.assertEqual(json.loads(self.output("alpha", points, "--squared-radius", "6.25", "--stats"))["alpha_cells"], 2)

    def test_cells_and_boundary_are_written(self):
        points = self.uniform(3, 300)
        self.output("alpha", points, "--radius", "0.15", "-o", self.path("cells.npz"))
        self.output("alpha", points, "--radius", "0.15", "--boundary", "-o", self.path("boundary.npz"))
        self.output("alpha", points, "--radius", "0.15", "--boundary", "-o", self.path("boundary.off"))
        with np.load(self.path("cells.npz")) as cells, np.load(self.path("boundary.npz")) as boundary:
            self.assertEqual((cells["cells"].shape[1], boundary["cells"].shape[1]), (4, 3))
            self.assertEqual((cells["neighbors"] < 0).sum(), len(boundary["cells"]))
            counts = len(cells["points"]), len(boundary["cells"])
        with open(self.path("boundary.off")) as f:
            self.assertEqual(f.read().split()[1:3], list(map(str, counts)))
        text = self.output("alpha", points, "--radius", "0.15")
        self.assertIn("boundary facets", text)

    def test_names_of_coordinates_are_kept(self):
        points = self.file("stations.csv", "lon,lat\n0,0\n3,0\n3,4\n0,4\n")
        for boundary in ((), ("--boundary",)):
            self.output("alpha", points, "--radius", "3", *boundary, "-o", self.path("part.json"), "--force")
            with open(self.path("part.json")) as f:
                self.assertEqual(json.load(f)["column_names"], ["lon", "lat"])

    def test_weights(self):
        balls = self.file("balls.csv", "x,y,w\n0,0,1\n2,0,1\n1,1.5,1\n")
        stats = json.loads(self.output("alpha", balls, "--weights", "w", "--radius", "0", "--stats"))
        self.assertEqual((stats["alpha_cells"], stats["singular_facets"]), (0, 3))
        stats = json.loads(self.output("alpha", balls, "--weights", "w", "--squared-radius=-0.5", "--stats"))
        self.assertEqual((stats["alpha_cells"], stats["singular_facets"]), (0, 0))

    def test_wrong_arguments(self):
        points = self.uniform(2, 9)
        for arguments in ((), ("--radius", "1", "--squared-radius", "1"), ("--radius", "-1"), ("--radius", "nan"), ("--squared-radius", "nan")):
            self.complaint("alpha", points, *arguments, status=64)


if __name__ == "__main__":
    unittest.main()
