# SPDX-License-Identifier: BSD-3-Clause
"""delone regular and delone power: points with weights."""
import json
import unittest

from cli_support import Case, STATS, np


class Regular(Case):
    def test_equal_weights_give_the_delaunay_triangulation(self):
        for kind, d, n in (("uniform", 3, 60), ("grid", 3, 27), ("flat", 3, 20)):
            points, weights = self.path("points.npy"), self.path("weights.npy")
            self.output("generate", kind, "-d", d, "-n", n, "-o", points)
            np.save(weights, np.full((n, 1), 2.5))
            plain = json.loads(self.output("delaunay", points, "--stats"))
            regular = json.loads(self.output("regular", points, "--weights", weights, "--stats"))
            self.assertEqual(set(STATS) - set(regular), set())
            self.assertEqual((regular["command"], regular["hash"], regular["hidden"]), ("regular", plain["hash"], 0))

    def test_hidden_points_and_duplicates(self):
        balls = self.path("balls.csv")
        with open(balls, "w") as f:
            f.write("x,y,w\n0,0,0\n4,0,0\n0,4,0\n4,4,1\n1,1,-9\n0,0,0\n0,0,-1\n")
        stats = json.loads(self.output("regular", balls, "--weights", "w", "--stats"))
        self.assertEqual((stats["points"], stats["vertices"], stats["duplicates"], stats["hidden"], stats["cells"]), (7, 4, 1, 2, 2))
        self.output("regular", balls, "--weights", "2", "-o", self.path("balls.npz"))
        with np.load(self.path("balls.npz")) as arrays:
            np.testing.assert_array_equal(arrays["weights"].ravel(), [0, 0, 0, 1, -9, 0, -1])
        self.assertIn("regular triangulation", self.output("check", self.path("balls.npz")))

    def test_info_tells_weights_and_hidden_points(self):
        balls = self.file("balls.csv", "x,y,w\n0,0,0\n4,0,0\n0,4,0\n4,4,1\n1,1,-9\n0,0,0\n")
        for name in ("balls.npz", "balls.json"):
            self.output("regular", balls, "--weights", "w", "-o", self.path(name))
            lines = [line.split() for line in self.output("info", self.path(name)).splitlines()]
            for line in ("vertices 4", "hidden points 1", "weights -9 ... 1"):
                self.assertIn(line.split(), lines)

    def test_power_diagram(self):
        balls = self.path("balls.csv")
        with open(balls, "w") as f:
            f.write("x,y,w\n0,0,0\n2,0,1\n")
        rows = self.output("power", balls, "--weights", "w", "--volumes", "-", "--box", "-1,-1,3,1").split()[1:]
        # The border is where x² = (x − 2)² − 1: at x = 3/4.
        self.assertEqual([round(float(row.split(",")[1]), 12) for row in rows], [3.5, 4.5])

    def test_weights_reach_the_files_to_the_bit(self):
        points = np.array([[0, 0], [4, 0], [0, 4], [4, 4], [1, 1], [0, 0]]) * 0.1
        weights = np.array([0.1, -0.0, 5e-324, 1 / 3, -1.7976931348623157e308, -1e-310])
        table = self.file("balls.csv", "x,y,w\n" + "".join(f"{x!r},{y!r},{w!r}\n" for (x, y), w in
                                                           zip(points.tolist(), weights.tolist())))
        arguments = [(table, "--weights", "w"), (self.file("points.npy", points), "--weights", self.file("weights.npy", weights)),
                     (self.path("points.npy"), "--weights", self.file("weights.txt", "\n".join(map(repr, weights.tolist()))))]
        for given in arguments:
            self.output("regular", *given, "-o", self.path("out.npz"))
            self.output("regular", *given, "-o", self.path("out.json"))
            with np.load(self.path("out.npz")) as arrays:
                self.assertEqual(arrays["weights"].tobytes(), weights.tobytes(), given)
                self.assertEqual(arrays["points"].tobytes(), points.tobytes(), given)
            with open(self.path("out.json")) as f:
                self.assertEqual(np.array(json.load(f)["weights"], float).tobytes(), weights.tobytes(), given)
            for name in ("out.npz", "out.json"):
                self.assertIn("regular triangulation", self.output("check", self.path(name)))

    def test_weights_that_do_not_fit(self):
        points = self.file("points.npy", np.arange(10.0).reshape(5, 2) ** 2)
        for command in ("regular", "power"):
            def refused(weights, pattern):
                path = self.file("weights.npy", np.array(weights, float))
                self.assertRegex(self.complaint(command, points, "--weights", path), "weights.npy: " + pattern)
            refused(range(4), "expected 5 weights, one per point, found 4")
            refused(range(6), "expected 5 weights, one per point, found 6")
            refused([], "expected 5 weights, one per point, found 0")
            refused(np.ones((5, 2)), "expected one weight per row, found 2 columns")
            refused([0, 1, 2, np.nan, 4], "row 3: .*nan")
            refused([0, -np.inf, 2, np.nan, 4], "row 1: .*inf.*1 more row")
            lines = self.file("weights.txt", "0\n1\nnan\n3\n4\n")
            self.assertRegex(self.complaint(command, points, "--weights", lines), "weights.txt:3: .*nan")
            table = self.file("balls.csv", "x,y,w\n0,0,1\n1,0,nan\n0,1,1\n")
            self.assertRegex(self.complaint(command, table, "--weights", "w"), "balls.csv:3: .*nan")
            self.assertIn("no column 3; the columns are 0 to 2", self.complaint(command, self.file("balls.csv", "0,0,1\n1,0,1\n"), "--weights", 3))

    def test_refusals(self):
        points = self.path("points.csv")
        with open(points, "w") as f:
            f.write("x,y,w\n0,0,1\n1,0,nan\n0,1,1\n")
        self.run_delone("regular", points, "--weights", "w", status=2)
        self.run_delone("regular", points, "--weights", "volume", status=2)
        self.run_delone("regular", points, status=64)


if __name__ == "__main__":
    unittest.main()
