# SPDX-License-Identifier: BSD-3-Clause
"""delone density: the densities of particles on a grid."""
import json
import unittest

from cli_support import Case, np


class Density(Case):
    def test_formats(self):
        triangle = self.file("points.csv", "x,y\n0,0\n1,0\n0,1\n")
        expected = np.array([[6, 6], [6, 0], [0, 0], [0, 0]], float)
        arguments = ["density", triangle, "--grid", "4,2", "--box", "0,0,2,1"]
        self.output(*arguments, "-o", self.path("field.npy"))
        np.testing.assert_array_equal(np.load(self.path("field.npy")), expected)
        self.output(*arguments, "-o", self.path("field.npz"))
        with np.load(self.path("field.npz")) as arrays:
            np.testing.assert_array_equal(arrays["density"], expected)
            self.assertEqual((arrays["origin"].tolist(), arrays["sides"].tolist()), ([0, 0], [[2, 0], [0, 1]]))
        rows = self.output(*arguments).splitlines()
        self.assertEqual(rows[:3], ["x0,x1,density", "0.25,0.25,6", "0.25,0.75,6"])
        self.assertEqual(len(rows), 9)

    def test_masses_lattice_and_samples(self):
        grid = self.path("grid.npy")
        self.output("generate", "grid", "-d", 3, "-n", 27, "-o", grid)
        table = self.file("table.csv", "x,y,m\n0,0,3\n0.5,0,3\n0,0.5,3\n0.5,0.5,3\n")
        self.output("density", table, "--masses", "m", "--lattice", "1", "--grid", "3", "--samples", "2", "-o", self.path("field.npy"))
        np.testing.assert_allclose(np.load(self.path("field.npy")), np.full((3, 3), 12), rtol=1e-14)
        masses = self.file("masses.csv", "3\n3\n3\n3\n")
        stats = json.loads(self.output("density", table, "--columns", "x,y", "--masses", masses, "--grid", "3", "--stats", "-o", self.path("field.npy")))
        self.assertEqual((stats["mass"], stats["grid"], stats["samples"]), (12, [3, 3], 1))

    def test_complaints(self):
        points = self.file("points.csv", "x,y\n0,0\n1,0\n0,1\n")
        for grid, message in (("0", "at least 1"), ("4,4,4", "3 numbers for points of dimension 2"), ("a", "numbers of parts")):
            self.assertIn(message, self.complaint("density", points, "--grid", grid, status=64))
        self.assertIn("--box", self.complaint("density", points, "--grid", "4", "--lattice", "1", "--periodic", "x", status=64))
        self.assertIn("--masses w is neither a column nor a file".replace("w", "'w'"),
                      self.complaint("density", points, "--grid", "4", "--masses", "w"))
        self.assertIn("expected 3 masses, one per point, found 2",
                      self.complaint("density", points, "--grid", "4", "--masses", self.file("masses.csv", "1\n2\n")))
        self.assertIn("--grid", self.complaint("density", points, status=64))


if __name__ == "__main__":
    unittest.main()
