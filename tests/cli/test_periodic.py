# SPDX-License-Identifier: BSD-3-Clause
"""--lattice and --periodic of delone delaunay and delone regular."""
import json
import unittest

from cli_support import Case, STATS, np

POINTS = np.random.default_rng(5).random((60, 3)).astype(np.float32).astype(float)


class Periodic(Case):
    def stats(self, *arguments):
        return json.loads(self.output("delaunay", self.file("points.npy", POINTS), *arguments, "--stats"))

    def test_lattices_as_lengths_and_files(self):
        plain = self.stats("--lattice", "1")
        self.assertEqual(set(STATS) - set(plain), set())
        self.assertEqual((plain["periodic_directions"], plain["displacement"], plain["vertices"]), (3, 0, 60))
        self.assertEqual(self.stats("--lattice", "1,1,1")["hash"], plain["hash"])
        self.assertEqual(self.stats("--lattice", self.file("box.csv", "1,0,0\n0,1,0\n3,0,1\n"))["hash"], plain["hash"])

    def test_directions(self):
        slab = self.stats("--lattice", "1,1,9", "--periodic", "xy")
        self.assertEqual(slab["periodic_directions"], 2)
        self.assertEqual(self.stats("--lattice", "1,1,9", "--periodic", "0,1")["hash"], slab["hash"])
        for wrong in ("xx", "w", "3", "xw"):
            self.run_delone("delaunay", self.file("points.npy", POINTS), "--lattice", "1", "--periodic", wrong, status=64)

    def test_files_are_checked(self):
        points, weights = self.file("points.npy", POINTS), self.file("weights.npy", POINTS[:, :1] / 50)
        for name in ("t.npz", "t.json"):
            self.output("regular", points, "--weights", weights, "--lattice", "1", "-o", self.path(name))
            self.assertIn("a periodic regular triangulation of all its points", self.output("check", self.path(name)))
            self.assertIn("lattice vectors", self.output("info", self.path(name)))
        with np.load(self.path("t.npz")) as arrays:
            damaged = dict(arrays)
        damaged["cell_offsets"] = damaged["cell_offsets"] + (np.arange(12) == 4)
        np.savez(self.path("damaged.npz"), **damaged)
        self.run_delone("check", self.path("damaged.npz"), status=1)

    def test_units_and_exact_input(self):
        steps = np.arange(7) * 0.1
        lattice = self.file("lattice.npy", np.stack(np.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 3))
        stats = json.loads(self.output("delaunay", lattice, "--lattice", "0.7", "--unit", "0.1", "--exact", "--stats"))
        self.assertEqual((stats["cells"], stats["displacement"]), (6 * 343, 0))
        self.complaint("delaunay", lattice, "--lattice", "0.7", "--exact")

    def test_refusals(self):
        points = self.file("points.npy", POINTS)
        for arguments, status in ((["--lattice", "1,1"], 64), (["--lattice", "0,1,1"], 64), (["--lattice", "1,-1,1"], 64), (["--lattice", "1", "-o", self.path("t.vtu")], 2),
                                  (["--lattice", "1", "--trim", "0.1"], 64), (["--periodic", "x"], 64), (["--lattice", "none.csv"], 2),
                                  (["--lattice", "none"], 2), (["--lattice", "1", "--periodic", ""], 64), (["--lattice", "1", "--unit", "inf"], 64),
                                  (["--lattice", "1", "--unit", "-1"], 64), (["--lattice", "1", "--unit", "1e30"], 2)):
            self.complaint("delaunay", points, *arguments, status=status)
        for arguments, words, status in ((["--lattice", "none"], "--lattice none", 2),
                                         (["--lattice", "1", "--unit", "inf"], "--unit inf: a finite length above 0", 64),
                                         (["--lattice", "1", "--unit", "1e30"], "the unit, which is too large", 2),
                                         (["--lattice", "1", "--unit", "0.3", "--exact"], "the grid of the unit", 2)):
            self.assertIn(words, self.complaint("delaunay", points, *arguments, status=status))
        self.complaint("cells", points, "--lattice", "1", "--neighbors", "-o", self.path("cells.csv"), status=64)

    def test_neighbor_offsets_outside_are_zero(self):
        path = self.path("slab.npz")
        self.output("delaunay", self.file("points.npy", POINTS), "--lattice", "1", "--periodic", "xy", "-o", path)
        with np.load(path) as arrays:
            damaged = dict(arrays)
        damaged["neighbor_offsets"].reshape(-1, 4, 2)[damaged["neighbors"] < 0] = 7
        np.savez(path, **damaged)
        self.run_delone("check", path, status=1)

    def test_tiles(self):
        points, box = self.file("points.npy", POINTS), self.file("box.csv", "1,0,0\n0,1,0\n3,0,1\n")
        for name, lattice in (("cube/", ["1,1,1"]), ("skewed/", [box]), ("slab/", ["1,1,9", "--periodic", "xy"]),
                              ("units/", ["1,1,9", "--periodic", "xy", "--unit", "0.01"])):
            made = self.stats("--lattice", *lattice, "-o", self.path(name), "--tiles", "3", "--quiet")
            whole = self.stats("--lattice", *lattice)
            self.assertEqual((made["hash"], made["cells"], made["parts"]), (whole["hash"], whole["cells"], 3))
            self.assertIn("a periodic Delaunay triangulation of its vertices", self.output("check", "--canonical", self.path(name)))
            self.assertIn("lattice vectors", self.output("info", self.path(name)))
        self.assertRegex(self.output("info", self.path("units/")), r"unit +0\.01\n")
        for other in (["1,1,9", "--periodic", "xy"], ["1,1,9", "--periodic", "xy", "--unit", "0.02"]):
            self.assertIn("another unit", self.complaint("delaunay", points, "--lattice", *other, "--quiet", "-o", self.path("units/"), status=2))
        weighted = self.file("weighted.npy", np.column_stack([POINTS, POINTS[:, 0] / 50]))
        made = json.loads(self.output("regular", weighted, "--weights", "3", "--lattice", "1,1,1", "--stats", "--quiet", "-o", self.path("weighted/")))
        whole = json.loads(self.output("regular", weighted, "--weights", "3", "--lattice", "1,1,1", "--stats"))
        self.assertEqual((made["hash"], made["hidden"]), (whole["hash"], whole["hidden"]))
        self.assertIn("which are not compared with points", self.complaint("check", self.path("cube/"), "--points", points, status=64))

    def test_what_tiles_do_not_take(self):
        points = self.file("points.npy", POINTS)
        for arguments, words, status in ((["1"], "a length per axis", 64), (["1,1"], "the lattice has 2 dimensions, not 3", 2),
                                         (["none"], "neither lengths nor a file", 2), (["1,1,1", "--unit", "inf"], "--unit inf", 64),
                                         (["1,1,1", "--exact"], "--exact", 64), (["1,1,1", "--vtu"], "--vtu", 64)):
            self.assertIn(words, self.complaint("delaunay", points, "--lattice", *arguments, "-o", self.path("no/"), status=status))
        self.assertIn("--tiles", self.complaint("delaunay", points, "--lattice", "1", "--tiles", "2", status=64))

    def test_time_limits_end_questions(self):
        one = self.file("one.npy", POINTS[:1].repeat(3, axis=0).reshape(1, -1)[:, :7])
        self.complaint("delaunay", one, "--lattice", "1", "--time", "0.2", status=3)


if __name__ == "__main__":
    unittest.main()
