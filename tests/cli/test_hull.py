# SPDX-License-Identifier: BSD-3-Clause
"""delone hull: facets, distances, lower and upper hulls."""
import itertools
import json
import os
import pathlib
import unittest
import xml.etree.ElementTree

from cli_support import CUBE, Case, STATS, np


class Hull(Case):
    def hull_stats(self, *arguments):
        return json.loads(self.output("hull", *arguments, "--stats"))

    def test_stats(self):
        grid = np.array(list(itertools.product([0.0, 1.0, 2.0], repeat=3)))
        stats = self.hull_stats(self.file("grid.npy", np.vstack([grid, grid[:2]])))
        for name, kind in STATS.items():
            self.assertIsInstance(stats[name], kind, name)
        self.assertEqual([stats[name] for name in ("command", "points", "vertices", "duplicates", "hidden", "boundary_points",
                                                   "interior_points", "facets", "ridges")],
                         ["hull", 29, 8, 2, 19, 18, 1, 6, 12])
        self.assertLessEqual(abs(stats["volume"] - 8), stats["volume_error"])
        self.assertLessEqual(abs(stats["area"] - 24), stats["area_error"])

    def test_unlucky_input_is_a_result(self):
        for rows, k, vertices in ((np.zeros((0, 2)), -1, 0), (np.ones((3, 2)), 0, 1), (np.arange(8.0).reshape(4, 2), 1, 2)):
            path = self.file("few.npy", rows)
            if len(rows):
                stats = self.hull_stats(path)
                self.assertEqual((stats["affine_dimension"], stats["vertices"]), (k, vertices))
                out = self.path("few.json")
                self.output("hull", path, "-o", out)
                with open(out, encoding="utf-8") as file:
                    self.assertEqual(json.load(file)["affine_dimension"], k)

    def test_tolerance(self):
        grid = np.array(list(itertools.product([0.0, 1.0, 2.0], repeat=3)))
        turned = grid @ np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
        points, out = self.file("turned.npy", turned), self.path("turned.npz")
        stats = self.hull_stats(points, "--tolerance", "1e-14")
        self.assertEqual([stats[name] for name in ("vertices", "facets", "ridges", "tolerance")], [8, 6, 12, 1e-14])
        self.assertTrue(0 < stats["max_distance"] <= 1e-14)
        self.output("hull", points, "--tolerance", "1e-14", "-o", out)
        self.assertEqual(list(np.load(out)["tolerance"]), [1e-14, stats["max_distance"]])
        self.assertIn("within the tolerance", self.output("check", out))

    def test_npz(self):
        points, out = self.file("cube.npy", np.vstack([CUBE, [[0.5, 0.5, 0.5], [0.5, 0.5, 0]]])), self.path("cube.npz")
        self.output("hull", points, "-o", out)
        hull = np.load(out)
        self.assertEqual(int(hull["affine_dimension"]), 3)
        self.assertEqual(list(hull["vertices"]), list(range(8)))
        self.assertEqual(list(hull["point_kinds"]), [0] * 8 + [2, 1])
        self.assertEqual(hull["equations"].shape, (6, 4))
        self.assertTrue((np.diff(hull["facet_offsets"]) == 4).all())
        self.assertEqual(hull["ridge_facets"].shape, (12, 2))
        distances = hull["points"] @ hull["equations"][:, :3].T + hull["equations"][:, 3]
        self.assertLess(distances.max(), 1e-15)
        for facet in range(6):
            members = hull["facet_vertices"][hull["facet_offsets"][facet]:hull["facet_offsets"][facet + 1]]
            self.assertLess(abs(distances[members, facet]).max(), 1e-15)
        cells, neighbors = hull["cells"], hull["neighbors"]
        corners = hull["points"][cells]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.assertTrue((np.einsum("ij,ij->i", normals, corners[:, 0] - 0.5) > 0).all())  # outwards
        for cell, row in enumerate(neighbors):
            for i, other in enumerate(row):
                self.assertEqual(set(cells[cell]) - {cells[cell][i]}, set(cells[cell]) & set(cells[other]))

    def test_every_format(self):
        square = self.file("square.csv", "0,0\n1,0\n0,1\n1,1\n")
        cube = self.file("cube.npy", CUBE)
        for points, extensions in ((square, ("npz", "json", "off", "vtu", "svg", "txt", "npy")),
                                   (cube, ("npz", "json", "off", "vtu", "txt", "npy"))):
            for extension in extensions:
                out = self.path("out." + extension)
                self.output("hull", points, "-o", out)
                self.assertGreater(os.path.getsize(out), 0)
        with open(self.path("out.off"), encoding="utf-8") as file:
            self.assertEqual(file.readline() + file.readline(), "OFF\n8 12 0\n")
        xml.etree.ElementTree.parse(self.path("out.svg"))
        self.assertIn(".svg", self.complaint("hull", cube, "-o", self.path("cube.svg")))

    def test_lower_and_upper(self):
        phases = self.file("phases.csv", "0,0\n1,0\n0.5,-1\n0.25,-0.4375\n0.75,2\n")
        distances, out = self.path("above.csv"), self.path("lower.npz")
        self.output("hull", phases, "--lower", "--distances", distances, "-o", out)
        with open(distances, encoding="utf-8") as file:
            self.assertEqual(file.read(), "height_above_hull\n0\n0\n0\n0.0625\n2.5\n")
        lower = np.load(out)
        self.assertEqual(sorted(map(tuple, np.sort(lower["cells"]))), [(0, 2), (1, 2)])
        stats = self.hull_stats(phases, "--upper")
        self.assertEqual((stats["side"], stats["cells"], stats["vertices"]), ("upper", 2, 3))
        self.complaint("hull", phases, "--lower", "--upper", status=64)
        self.complaint("hull", phases, "--distances", distances, status=64)
        self.complaint("hull", self.file("one.csv", "1\n2\n"), "--lower")

    def test_fractions_that_sum_to_1(self):
        shares = np.random.default_rng(1).dirichlet([1, 1, 1], 40).round(4)
        rows = "\n".join(",".join(map(str, [*row, i * i % 7])) for i, row in enumerate(shares))
        path = self.file("f.csv", "xA,xB,xC,e\n" + rows + "\n")
        done = self.run_delone("hull", "--lower", path)
        self.assertIn("the columns xA, xB, xC sum to 1 but for rounding", done.stderr.decode())
        self.output("hull", "--lower", path, "--quiet")
        self.output("hull", "--lower", path, "--columns", "xA,xB,e")

    def test_threads_change_nothing(self):
        points = self.path("points.npy")
        self.output("generate", "sphere", "-d", 3, "-n", 1000, "-o", points)
        for side in ((), ("--lower",)):
            out = [self.path(f"{threads}.npz") for threads in (0, 1, 2, 3)]
            for threads, path in zip((0, 1, 2, 3), out):
                self.output("hull", points, *side, "--threads", threads, "--force", "-o", path)
            for other in out[1:]:
                self.assertEqual(pathlib.Path(out[0]).read_bytes(), pathlib.Path(other).read_bytes())

    def test_the_order_does_not_change_the_end(self):
        points = self.path("grid.npy")
        self.output("generate", "grid", "-d", 4, "-n", 81, "-o", points)
        expected = self.hull_stats(points)["hash"]
        self.assertEqual(self.hull_stats(points, "--order", "shuffled", "--seed", 3)["hash"], expected)
        self.assertEqual(self.hull_stats(points, "--order", "as_given")["hash"], expected)

    def test_bad_input(self):
        self.assertIn("bad.csv:2", self.complaint("hull", self.file("bad.csv", "0,0\n1,nan\n")))


if __name__ == "__main__":
    unittest.main()
