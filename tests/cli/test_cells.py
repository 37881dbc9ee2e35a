# SPDX-License-Identifier: BSD-3-Clause
"""delone cells: volumes, centroids, surfaces and neighbors as csv and npz."""
import json
import unittest

from cli_support import Case, np


class Cells(Case):
    def test_table_and_arrays(self):
        points = self.file("points.csv", "x,y\n0,0\n2,0\n0,2\n2,2\n1,1\n1,1\n")
        rows = self.output("cells", points, "-o", "-", "--output-format", "csv").splitlines()
        self.assertEqual(rows[0], "volume,area,num_faces,centroid_0,centroid_1")
        self.assertEqual(rows[1].split(","), ["inf", "inf", "3", "nan", "nan"])
        np.testing.assert_allclose([float(x) for x in rows[5].split(",")], [2, 4 * 2**0.5, 4, 1, 1], rtol=1e-15)
        self.assertEqual(rows[6].split(",")[:3], ["0", "0", "0"])
        self.output("cells", points, "--neighbors", "-o", self.path("cells.npz"))
        with np.load(self.path("cells.npz")) as arrays:
            self.assertEqual(set(arrays), {"volumes", "centroids", "areas", "num_faces", "neighbor_offsets", "neighbors", "face_areas", "distances"})
            first, last = arrays["neighbor_offsets"][4:6]
            np.testing.assert_array_equal(arrays["neighbors"][first:last], [0, 1, 2, 3])
            self.assertEqual(arrays["centroids"].shape, (6, 2))

    def test_vertices(self):
        points = self.file("points.csv", "x,y\n0,0\n2,0\n0,2\n2,2\n1,1\n")
        self.output("cells", points, "--vertices", "-o", self.path("cells.npz"))
        with np.load(self.path("cells.npz")) as arrays:
            self.assertEqual(set(arrays), {"volumes", "centroids", "areas", "num_faces", "neighbor_offsets", "neighbors", "face_areas", "distances",
                                           "vertex_offsets", "vertices", "face_vertex_offsets", "face_vertices"})
            first, last = arrays["vertex_offsets"][4:6]
            np.testing.assert_array_equal(arrays["vertices"][first:last], [[0, 1], [1, 0], [1, 2], [2, 1]])
            first, last = arrays["face_vertex_offsets"][arrays["neighbor_offsets"][4:6]]
            np.testing.assert_array_equal(arrays["face_vertices"][first:last], [0, 1, 1, 3, 2, 0, 3, 2])
        self.assertIn("--vertices: csv", self.complaint("cells", points, "--vertices", "-o", self.path("cells.csv"), status=64))
        self.output("cells", points, "--vertices", "--proper-faces", "--box", "0,0,2,2", "-o", self.path("in_box.npz"))
        with np.load(self.path("in_box.npz")) as arrays:
            first, last = arrays["vertex_offsets"][:2]
            np.testing.assert_array_equal(arrays["vertices"][first:last], [[0, 0], [0, 1], [1, 0]])

    def test_box_weights_and_proper_faces(self):
        balls = self.file("balls.csv", "x,y,w\n0,0,0\n2,0,1\n")
        self.output("cells", balls, "--weights", "w", "--box", "-1,-1,3,1", "-o", self.path("cells.npz"))
        with np.load(self.path("cells.npz")) as arrays:  # the border is where x² = (x − 2)² − 1: at x = 3/4
            np.testing.assert_allclose(arrays["volumes"], [3.5, 4.5], rtol=1e-15)
        grid = self.path("grid.npy")
        self.output("generate", "grid", "-d", 3, "-n", 27, "-o", grid)
        self.output("cells", grid, "--proper-faces", "--neighbors", "-o", self.path("cells.npz"))
        with np.load(self.path("cells.npz")) as arrays:
            self.assertEqual(arrays["num_faces"][13], 6)
            first, last = arrays["neighbor_offsets"][13:15]
            np.testing.assert_array_equal(arrays["num_edges"][first:last], 6 * [4])

    def test_halfspaces(self):
        points = self.file("points.csv", "x,y\n0.25,0.25\n0.75,0.25\n")
        corner = self.file("corner.csv", "a,b,c\n1,1,-1\n")
        self.output("cells", points, "--box", "0,0,1,1", "--halfspaces", corner, "-o", self.path("cells.npz"))
        with np.load(self.path("cells.npz")) as arrays:
            np.testing.assert_allclose(arrays["volumes"], [0.375, 0.125], rtol=1e-14)
        wide = self.file("wide.csv", "1,2,3,4\n")
        self.assertIn("expected 3 columns for the halfspaces of 2 dimensions, found 4", self.complaint("cells", points, "--box", "0,0,1,1", "--halfspaces", wide))
        self.assertIn("--box", self.complaint("cells", points, "--halfspaces", corner, status=64))

    def test_report(self):
        points = self.uniform(3, 100)
        stats = json.loads(self.output("cells", points, "--box", "0,0,0,1,1,1", "--stats"))
        self.assertEqual((stats["command"], stats["unbounded_cells"]), ("cells", 0))
        self.assertAlmostEqual(stats["volume"], 1, places=12)
        self.assertIn("volume", self.output("cells", points))

    def test_periodic_sets(self):
        points = self.file("points.csv", "x,y,w\n0.25,0.5,0\n2.75,0.5,0\n0.25,-0.5,-9\n")
        self.output("cells", points, "--weights", "w", "--lattice", "1,2", "--neighbors", "--proper-faces", "-o", self.path("cells.npz"))
        with np.load(self.path("cells.npz")) as arrays:  # the third is hidden
            np.testing.assert_array_equal(arrays["volumes"], [1, 1, 0])
            np.testing.assert_array_equal(arrays["centroids"][:2], [[0.25, 0.5], [2.75, 0.5]])
            first, last = arrays["neighbor_offsets"][:2]
            np.testing.assert_array_equal(arrays["neighbors"][first:last], [0, 0, 1, 1])
            np.testing.assert_array_equal(arrays["neighbor_lattice"][first:last], [[0, -1], [0, 1], [-3, 0], [-2, 0]])
            self.assertEqual(arrays["neighbor_lattice"].dtype, np.int32)
        points = self.uniform(3, 100)
        stats = json.loads(self.output("cells", points, "--lattice", "1", "--stats"))
        self.assertEqual((stats["command"], stats["unbounded_cells"], stats["periodic_directions"]), ("cells", 0, 3))
        self.assertAlmostEqual(stats["volume"], 1, places=12)
        slab = self.output("cells", points, "--lattice", "1", "--periodic", "xy")
        self.assertIn("Periodic cells of 100 points", slab)
        self.assertIn("2 directions", slab)

    def test_what_is_refused(self):
        points = self.uniform(2, 10)
        self.assertIn("--box", self.complaint("cells", points, "--box", "0,1", status=64))
        self.assertIn("--box", self.complaint("cells", points, "--lattice", "1", "--box", "0,0,1,1", status=64))
        self.assertIn("json", self.complaint("cells", points, "-o", self.path("cells.json")))
        self.assertIn("binary", self.complaint("cells", points, "-o", "-", "--output-format", "npz"))


if __name__ == "__main__":
    unittest.main()
