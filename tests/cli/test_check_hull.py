# SPDX-License-Identifier: BSD-3-Clause
"""delone check: right hulls pass, each kind of wrong one fails at its level."""
import itertools
import unittest

from cli_support import Case, np


class Hulls(Case):
    """What `delone hull` wrote, and the same with one thing wrong."""

    def setUp(self):
        super().setUp()
        grid = np.array(list(itertools.product([0.0, 1.0, 2.0], repeat=3)))
        self.output("hull", self.file("grid.npy", np.vstack([grid, grid[:2]])), "-o", self.path("good.npz"))
        with np.load(self.path("good.npz")) as file:
            self.good = dict(file)

    def violation(self, level, *options, **changed):
        np.savez(self.path("bad.npz"), **{**self.good, **changed})
        done = self.run_delone("check", self.path("bad.npz"), *options, status=1)
        self.assertEqual(done.stderr, b"")
        lines = done.stdout.decode().splitlines()
        self.assertRegex(lines[level], rf"level {level} .* FAILED ")
        self.assertTrue(lines[-1].startswith("violation: "), lines[-1])
        return lines[-1]

    def changed(self, name, at, value):
        array = self.good[name].copy()
        array[at] = value
        return {name: array}

    def without_facet(self, facet, facet_of_cell):
        """The arrays without a facet; its cells are given to another one."""
        g = self.good
        ends = g["facet_offsets"]
        return {"facet_of_cell": facet_of_cell, "facet_vertices": np.delete(g["facet_vertices"], range(ends[facet], ends[facet + 1])),
                "facet_offsets": np.concatenate([ends[:facet], ends[facet + 1:] - (ends[facet + 1] - ends[facet])]),
                "equations": np.delete(g["equations"], facet, axis=0), "equation_errors": np.delete(g["equation_errors"], facet)}

    def without_ridge(self, ridge):
        g = self.good
        return {"ridge_facets": np.delete(g["ridge_facets"], ridge, axis=0),
                "ridge_vertices": np.delete(g["ridge_vertices"], range(2 * ridge, 2 * ridge + 2)),
                "ridge_offsets": g["ridge_offsets"][:-1]}

    def test_right_ones(self):
        text = self.output("check", self.path("good.npz"))
        self.assertIn("the hull of 29 points in dimension 3, affine dimension 3, 6 facets, ", text)
        self.assertIn("the convex hull of all its points, exactly\n", text)
        sphere = np.random.default_rng(1).normal(size=(60, 4))
        flat = np.random.default_rng(2).integers(0, 4, size=(40, 2)) @ np.array([[1.0, 2, 0, 1], [0, 1, 1, 3]])
        sets = (sphere / np.linalg.norm(sphere, axis=1)[:, None], flat, np.array([[3.0, 1], [1, 1], [2, 1]]), np.ones((2, 3)),
                np.random.default_rng(3).random((9, 9)), np.random.default_rng(4).random((20, 2)))
        for points in sets:
            for name in ("hull.npz", "hull.json"):
                self.output("hull", self.file("points.npy", points), "-o", self.path(name))
                text = self.output("check", self.path(name))
                self.assertIn("level 5  completeness     ok", text)
        self.assertIn("no violation up to this level", self.output("check", self.path("hull.json"), "--level", 3))

    def test_wrong_cells(self):
        cells, neighbors = self.good["cells"], self.good["neighbors"]
        self.violation(1, **self.changed("cells", (3, 1), 29))
        self.violation(1, **self.changed("cells", (3, 1), cells[3, 0]))
        swap = [1, 0, 2]
        one, its_neighbors = cells.copy(), neighbors.copy()
        one[2], its_neighbors[2] = one[2, swap], its_neighbors[2, swap]
        self.violation(2, cells=one, neighbors=its_neighbors)
        self.violation(3, cells=cells[:, swap], neighbors=neighbors[:, swap])
        rolled = neighbors.copy()
        rolled[5] = np.roll(rolled[5], 1)
        self.violation(2, neighbors=rolled)
        smaller = {"cells": cells[1:], "facet_of_cell": self.good["facet_of_cell"][1:]}
        self.violation(1, neighbors=neighbors[1:], **smaller)
        self.violation(2, neighbors=np.where(neighbors[1:] > 0, neighbors[1:] - 1, -1), **smaller)

    def test_wrong_points(self):
        points = self.good["points"].copy()
        points[26] = 0.5  # a corner, now inside the others' hull
        self.assertIn("beyond", self.violation(3, points=points))
        points = self.good["points"].copy()
        points[13] = [1, 1, np.nextafter(2, 3)]  # from the centre
        self.assertIn("point 13 is beyond", self.violation(4, points=points))
        self.run_delone("check", self.path("good.npz"), "--points", self.file("moved.npy", points), status=1)
        self.output("check", self.path("bad.npz"), "--points", self.path("grid.npy"))
        self.assertIn("affine dimension", self.violation(3, points=points * [1, 1, 0]))

    def test_wrong_facets(self):
        of = self.good["facet_of_cell"]
        self.violation(1, **self.without_facet(5, of))
        self.assertIn("5 facets are given", self.violation(5, **self.without_facet(5, np.minimum(of, 4)),
                                                          ridge_facets=np.minimum(self.good["ridge_facets"], 4)))
        self.assertIn("hyperplane", self.violation(5, **self.changed("facet_of_cell", 0, 1 - of[0] if of[0] < 2 else 0)))
        self.assertIn("facet 0 has", self.violation(5, **self.changed("facet_vertices", 0, 13)))
        self.violation(1, **self.changed("facet_offsets", 1, 1000))

    def test_wrong_numbers_of_faces(self):
        g = self.good
        self.assertIn("11 ridges are given", self.violation(5, **self.without_ridge(3)))
        self.assertIn("ridge 0 has", self.violation(5, **self.changed("ridge_vertices", 0, 13)))
        self.violation(5, **self.changed("ridge_facets", 1, g["ridge_facets"][0]))
        self.violation(1, **self.changed("ridge_facets", 0, [0, 6]))
        self.assertIn("not in the list", self.violation(5, vertices=g["vertices"][1:]))
        self.assertIn("is in the list", self.violation(5, **self.changed("vertices", 7, 13)))
        self.assertIn("on the boundary", self.violation(5, **self.changed("point_kinds", 4, 2)))
        self.assertIn("first in row 0", self.violation(5, **self.changed("vertex_of_point", 27, 27)))

    def test_wrong_equations(self):
        equations, errors = self.good["equations"], self.good["equation_errors"]
        for factor in (2, -1, 1 + 1e-9):
            self.assertIn("equation of facet 0", self.violation(5, equations=equations * factor))
        self.violation(5, **self.changed("equations", (2, 3), equations[2, 3] + 1e-9))
        self.output("check", self.path("good.npz"))
        np.savez(self.path("wide.npz"), **{**self.good, "equations": equations * (1 + 1e-9), "equation_errors": errors + 1e-8})
        self.output("check", self.path("wide.npz"))

    def test_a_level_does_not_look_further(self):
        np.savez(self.path("bad.npz"), **{**self.good, "vertices": self.good["vertices"][1:]})
        self.assertIn("no violation up to this level", self.output("check", self.path("bad.npz"), "--level", 4))

    def test_what_is_no_hull(self):
        for option in ("--canonical", "--any-orientation", "--furthest-site"):
            self.complaint("check", self.path("good.npz"), option, status=64)
        for name in self.good:
            np.savez(self.path("bad.npz"), **{key: value for key, value in self.good.items() if key != name})
            if name not in ("kind", "points", "axes"):  # without the first, arrays tell; without the last, all axes are meant
                self.assertIn(name, self.complaint("check", self.path("bad.npz")))
        for name in ("equations", "point_kinds", "cells"):
            np.savez(self.path("bad.npz"), **{**self.good, name: self.good[name][1:]})
            self.assertIn("expected shape", self.complaint("check", self.path("bad.npz")))
        np.savez(self.path("bad.npz"), **self.changed("point_kinds", 0, 7), **{k: v for k, v in self.good.items() if k != "point_kinds"})
        self.assertIn("point_kinds: row 0", self.complaint("check", self.path("bad.npz")))
        self.output("hull", self.path("grid.npy"), "-o", self.path("hull.json"))
        with open(self.path("hull.json"), encoding="utf-8") as file:
            text = file.read()
        self.complaint("check", self.file("cut.json", text[:len(text) // 2]))
        self.assertIn("cells", self.complaint("check", self.file("odd.json", text.replace('"cells": [\n[', '"cells": [\n[3, '))))


if __name__ == "__main__":
    unittest.main()
