# SPDX-License-Identifier: BSD-3-Clause
"""What files say that they hold: written by every command, and told by info, check and view without an option."""
import json
import unittest

from cli_support import Case, np


class Kinds(Case):
    def setUp(self):
        super().setUp()
        random = np.random.default_rng(5)
        np.savetxt(self.path("points.csv"), random.random((40, 3)), delimiter=",")
        np.savetxt(self.path("weighted.csv"), np.hstack([random.random((40, 3)), 0.01 * random.random((40, 1))]), delimiter=",")
        np.savetxt(self.path("halfspaces.csv"), [[1, 0, -1], [-1, 0, -1], [0, 1, -1], [0, -1, -1]], delimiter=",")

    PRODUCTS = [
        (["delaunay", "points.csv"], "delaunay", "a Delaunay triangulation", "a Delaunay triangulation of all its points, exactly"),
        (["regular", "weighted.csv", "--weights", "3"], "regular", "a regular triangulation", "a regular triangulation of all its points, exactly"),
        (["delaunay", "points.csv", "--furthest-site"], "furthest_site", "a furthest-site Delaunay triangulation",
         "a furthest-site Delaunay triangulation of all its points, exactly"),
        (["delaunay", "points.csv", "--trim", "0.2"], "trimmed", "a trimmed triangulation", "not examined: which cells are left: the data do not hold the tolerance"),
        (["alpha", "points.csv", "--radius", "0.3"], "alpha_complex", "an alpha complex",
         "not examined: which cells belong to it: the data do not hold the radius"),
        (["alpha", "points.csv", "--radius", "0.3", "--boundary"], "alpha_boundary", "the boundary of an alpha complex",
         "not examined: which facets belong to it: the data do not hold the cells and the radius"),
        (["hull", "points.csv", "--lower"], "lower_hull", "a lower hull", "the lower hull of all its points, exactly"),
        (["hull", "points.csv", "--upper", "--tolerance", "0.1"], "upper_hull", "an upper hull",
         "the upper hull of its vertices, all points within the tolerance, exactly"),
        (["hull", "points.csv"], "convex_hull", "a convex hull", "the convex hull of all its points, exactly"),
        (["halfspaces", "halfspaces.csv"], "halfspace_intersection", "an intersection of halfspaces", "the intersection of all its halfspaces, exactly"),
        (["voronoi", "points.csv"], "voronoi", "a Voronoi diagram", "the Voronoi diagram of all its points, exactly"),
        (["power", "weighted.csv", "--weights", "3"], "power_diagram", "a power diagram", "the power diagram of all its points, exactly"),
        (["voronoi", "points.csv", "--furthest-site"], "furthest_voronoi", "a furthest-site Voronoi diagram",
         "the furthest-site Voronoi diagram of all its points, exactly"),
    ]

    def test_every_command(self):
        for (command, source, *options), kind, description, proved in self.PRODUCTS:
            for extension in ("npz", "json"):
                written = self.path(f"{kind}.{extension}")
                self.output(command, self.path(source), *options, "-o", written)
                self.assertTrue(self.output("info", written).startswith(f"{written}: {description}\n"), kind)
                self.assertIn(proved + "\n", self.output("check", written), kind)
                self.assertIn("<html", self.output("view", written))
            with np.load(self.path(f"{kind}.npz")) as data:
                self.assertEqual(str(data["kind"]), kind)
            with open(self.path(f"{kind}.json")) as file:
                self.assertEqual(json.load(file)["kind"], kind)

    def test_off(self):
        self.output("delaunay", self.path("points.csv"), "--furthest-site", "-o", self.path("t.off"))
        self.assertIn("a furthest-site Delaunay triangulation of all its points, exactly", self.output("check", self.path("t.off")))
        self.output("hull", self.path("points.csv"), "-o", self.path("hull.off"))
        self.assertIn("the boundary of a convex hull\n", self.output("info", self.path("hull.off")))
        self.assertIn("the convex hull of all its points, exactly", self.output("check", self.path("hull.off")))
        self.output("hull", self.path("points.csv"), "--lower", "-o", self.path("lower.off"))
        self.assertIn("the lower hull of all its points, exactly", self.output("check", self.path("lower.off")))

    def test_options_that_contradict(self):
        self.output("delaunay", self.path("points.csv"), "-o", self.path("t.npz"))
        self.assertIn("says that it holds a Delaunay triangulation; --furthest-site is for files that do not say what they hold",
                      self.complaint("check", self.path("t.npz"), "--furthest-site", status=64))
        self.output("hull", self.path("points.csv"), "--lower", "-o", self.path("lower.npz"))
        self.assertIn("--canonical is for triangulations", self.complaint("check", self.path("lower.npz"), "--canonical", status=64))

    def test_damage(self):
        self.output("delaunay", self.path("points.csv"), "-o", self.path("t.json"))
        with open(self.path("t.json")) as file:
            data = json.load(file)
        for command in ("check", "info", "view"):
            for kind in ("delauny", "", 3, None, ["delaunay"]):
                self.assertIn("kind: ", self.complaint(command, self.file("bad.json", json.dumps({**data, "kind": kind}))))
            self.assertIn("there is no member 'vertices'", self.complaint(command, self.file("bad.json", json.dumps({**data, "kind": "voronoi"}))))
        self.run_delone("check", self.file("bad.json", json.dumps({**data, "kind": "furthest_site"})), status=1)
        del data["kind"]
        self.assertIn("a Delaunay triangulation of all its points", self.output("check", self.file("old.json", json.dumps(data))))
        self.assertIn(": a triangulation\n", self.output("info", self.path("old.json")))

    def test_pictures_and_volumes_of_furthest_sites(self):
        np.savetxt(self.path("plane.csv"), np.random.default_rng(2).random((30, 2)), delimiter=",")
        for extension in ("svg", "vtu", "html"):
            self.output("voronoi", self.path("plane.csv"), "--furthest-site", "--box", "0,0,2,2", "-o", self.path(f"v.{extension}"))
        self.output("voronoi", self.path("plane.csv"), "--furthest-site", "--box", "0,0,2,2", "--volumes", self.path("volumes.csv"))
        volumes = np.loadtxt(self.path("volumes.csv"), delimiter=",", skiprows=1)
        self.assertAlmostEqual(volumes[:, 1].sum(), 4, places=10)


if __name__ == "__main__":
    unittest.main()
