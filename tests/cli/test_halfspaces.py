# SPDX-License-Identifier: BSD-3-Clause
"""delone halfspaces: bounded, unbounded, flat and empty intersections, files, their check, errors."""
import itertools
import json
import pathlib
import re
import unittest

from cli_support import Case, np

ARRAYS = {"dimension", "rank", "state", "bounded", "halfspaces", "first_of_halfspace", "kinds", "witness", "interior_point",
          "interior_point_is_exact", "axes", "vertices", "vertex_offsets", "vertex_halfspaces", "directions",
          "direction_offsets", "direction_halfspaces", "edges", "rays", "facet_halfspaces", "facet_offsets", "facet_vertices",
          "facet_direction_offsets", "facet_directions", "lineality", "dual_points", "dual_equations", "kind"}


def box(d, size=1.0):
    return np.array([[*(sign * np.eye(d)[j]), -size] for j in range(d) for sign in (1, -1)])


class Halfspaces(Case):
    def intersection_stats(self, *arguments, **options):
        return json.loads(self.output("halfspaces", *arguments, "--stats", **options))

    def test_stats(self):
        rows = np.vstack([box(3), [[1, 1, 1, -3], [1, 0, 0, -2], [3, 0, 0, -3], [0, 0, 0, -1]]])
        stats = self.intersection_stats(self.file("box.npy", rows))
        expected = {"command": "halfspaces", "dimension": 3, "halfspaces": 10, "state": "full", "witness": [], "rank": 3,
                    "bounded": True, "vertices": 8, "directions": 0, "edges": 12, "rays": 0, "facets": 6, "touching": 1,
                    "redundant": 1, "duplicates": 1, "trivial": 1, "volume": 8.0}
        self.assertEqual({name: stats[name] for name in expected}, expected)
        self.assertLess(abs(np.array(stats["interior_point"])).max(), 1)
        for name, kind in {"seconds": dict, "peak_rss_bytes": int, "created_cells": int, "stages": dict, "seed": int,
                           "version": str}.items():
            self.assertIsInstance(stats[name], kind, name)

    def test_threads_change_nothing(self):
        normals = np.random.default_rng(1).normal(size=(800, 3))
        rows = self.file("rows.npy", np.column_stack([normals, -np.linalg.norm(normals, axis=1)]))
        out = [self.path(f"{threads}.npz") for threads in (0, 1, 2, 3)]
        for threads, path in zip((0, 1, 2, 3), out):
            self.output("halfspaces", rows, "--threads", threads, "-o", path)
        for other in out[1:]:
            self.assertEqual(pathlib.Path(out[0]).read_bytes(), pathlib.Path(other).read_bytes())

    def test_summary(self):
        path = self.file("wedge.csv", "-1,0,0\n0,-1,0\n-1,-1,-1\n")
        text = self.output("halfspaces", path)
        self.assertIn("intersection of 3 halfspaces in dimension 2", text)
        self.assertRegex(text, r"vertices +1, 0 edges")
        self.assertRegex(text, r"bounded +no: 2 directions, 2 rays")
        self.assertRegex(text, r"other halfspaces +1 redundant, 0 of them touching; 0 duplicates, 0 trivial")
        text = self.output("halfspaces", self.file("slab.csv", "1,0,0,-1\n-1,0,0,-1\n"))
        self.assertRegex(text, r"rank +1 \(the intersection contains 2-dimensional flats\)")
        for offset, state in ((1, "flat"), (2, "empty")):
            text = self.output("halfspaces", self.file("no.csv", f"0,1,-5\n1,0,-1\n-1,0,{offset}\n"))
            self.assertRegex(text, rf"no interior point +{state}: halfspaces 1, 2 have none in common")

    def test_standard_input(self):
        text = "3 a square\n4\n1 0 -1\n-1 0 -1\n0 1 -1\n0 -1 -1\n"
        self.assertEqual(self.intersection_stats("-", stdin=text)["vertices"], 4)

    def test_files_hold_the_same(self):
        rows = self.file("rows.npy", np.vstack([box(3)[:-1], [[1, 1, 1, -2.5], [1, 1, 2, -7]]]))
        self.output("halfspaces", rows, "-o", self.path("o.npz"))
        self.output("halfspaces", rows, "-o", self.path("o.json"))
        with open(self.path("o.json"), encoding="utf-8") as file:
            other = json.load(file)
        data = np.load(self.path("o.npz"))
        self.assertEqual(set(data.files), ARRAYS)
        self.assertEqual(set(other), ARRAYS)
        for name in ARRAYS - {"state", "bounded", "interior_point_is_exact"}:
            self.assertEqual(np.array(other[name]).ravel().tolist(), data[name].ravel().tolist(), name)
        self.assertEqual((other["state"], other["bounded"], other["interior_point_is_exact"]), ("full", False, True))
        self.assertEqual((int(data["state"]), int(data["bounded"]), int(data["interior_point_is_exact"])), (0, 0, 1))
        slack = data["vertices"] @ data["halfspaces"][:, :3].T + data["halfspaces"][:, 3]
        self.assertLessEqual(slack.max(), 1e-15)
        for v, row in enumerate(np.split(data["vertex_halfspaces"], data["vertex_offsets"][1:-1])):
            self.assertEqual(set(row), {r for r in data["facet_halfspaces"] if abs(slack[v, r]) < 1e-15})

    def test_mesh(self):
        self.output("halfspaces", self.file("box.npy", box(3)), "-o", self.path("box.off"))
        with open(self.path("box.off"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        self.assertEqual(lines[:2], ["OFF", "8 6 12"])
        vertices = np.array([line.split() for line in lines[2:10]], dtype=float)
        self.assertEqual({tuple(x) for x in vertices}, set(itertools.product([-1.0, 1.0], repeat=3)))
        for line in lines[10:]:
            count, *facet = map(int, line.split())
            self.assertEqual((count, len(facet)), (4, 4))
            a, b, c = vertices[facet[:3]]
            self.assertGreater(np.dot(np.cross(b - a, c - a), a), 0)  # seen from outside
        self.complaint("halfspaces", self.file("square.npy", box(2)), "-o", self.path("square.off"))
        self.complaint("halfspaces", self.file("open.npy", box(3)[1:]), "-o", self.path("open.off"))

    def test_interior(self):
        rows = self.file("box.npy", box(2))
        for given in ("0.5,-0.25", self.file("point.csv", "0.5,-0.25\n")):
            self.assertEqual(self.intersection_stats(rows, "--interior", given)["interior_point"], [0.5, -0.25])
        self.assertIn("halfspace 0", self.complaint("halfspaces", rows, "--interior", "1,0"))
        self.complaint("halfspaces", rows, "--interior", "0,0,0", status=64)
        self.complaint("halfspaces", rows, "--interior", self.file("two.csv", "0,0\n0,0.5\n"))
        self.complaint("halfspaces", rows, "--interior", self.path("missing.csv"))

    def test_the_order_does_not_change_the_end(self):
        self.output("generate", "sphere", "-d", 4, "-n", 60, "-o", self.path("points.npy"))
        rows = self.file("rows.npy", np.column_stack([np.load(self.path("points.npy")), np.full(60, -1.0)]))
        expected = self.intersection_stats(rows)
        for order in ("as_given", "shuffled"):
            stats = self.intersection_stats(rows, "--order", order, "--seed", 5)
            for name in ("vertices", "edges", "rays", "facets", "redundant", "cells"):
                self.assertEqual(stats[name], expected[name], name)

    def test_check(self):
        sets = {"box": box(3), "wedge": np.array([[-1.0, 0, 0], [0, -1, 0]]), "slab": box(2)[:2], "all": np.zeros((1, 3)),
                "flat": np.array([[1.0, 0, -1], [-1, 0, 1]]), "empty": np.array([[1.0, 0, 1], [-1, 0, 1]]),
                "thin": np.array([[1.0, -np.nextafter(0.1, 1)], [-1, 0.1]])}
        for name, rows in sets.items():
            path = self.file(name + ".npy", rows)
            for extension in ("npz", "json"):
                out = self.path(name + "." + extension)
                self.output("halfspaces", path, "-o", out)
                text = self.output("check", out)
                self.assertEqual(re.findall(r"^level (\d)  [a-z]+ +ok ", text, re.M), list("123"), out)
                self.assertTrue(text.endswith("the intersection of all its halfspaces, exactly\n"))
        self.assertEqual(re.findall(r"^level (\d)", self.output("check", self.path("box.npz"), "--level", 2), re.M), list("12"))
        with open(self.path("box.json"), "rb") as file:
            self.output("check", "-", stdin=file.read())
        for option in ("--canonical", "--any-orientation", "--furthest-site"):
            self.complaint("check", self.path("box.npz"), option, status=64)

    def violation(self, arrays, level):
        np.savez(self.path("bad.npz"), **arrays)
        done = self.run_delone("check", self.path("bad.npz"), status=1)
        self.assertRegex(done.stdout.decode(), rf"level {level}  [a-z]+ +FAILED")
        self.assertRegex(done.stdout.decode(), r"\nviolation: .+\n")

    def test_check_finds_what_is_wrong(self):
        self.output("halfspaces", self.file("box.npy", np.vstack([box(3), [[1, 1, 1, -3]]])), "-o", self.path("o.npz"))
        good = dict(np.load(self.path("o.npz")))
        vertices = good["vertices"].copy()
        vertices[3, 1] = np.nextafter(vertices[3, 1], 0)
        self.violation({**good, "vertices": vertices}, 2)
        rows = good["halfspaces"].copy()
        rows[6, 3] = -2.5  # cuts a corner off
        self.violation({**good, "halfspaces": rows}, 2)
        self.violation({**good, "edges": good["edges"][1:]}, 3)
        self.violation({**good, "kinds": np.roll(good["kinds"], 1)}, 3)
        self.violation({**good, "interior_point": np.array([1.0, 0, 0])}, 2)
        edges = good["edges"].copy()
        edges[0, 0] = 99
        self.violation({**good, "edges": edges}, 1)

    def test_files_that_are_no_intersection(self):
        self.output("halfspaces", self.file("box.npy", box(2)), "-o", self.path("o.npz"))
        self.output("halfspaces", self.path("box.npy"), "-o", self.path("o.json"))
        good = dict(np.load(self.path("o.npz")))
        for member, value, complaint in (("vertices", good["vertices"][1:], "vertices: expected shape"),
                                         ("kinds", good["kinds"] + 5, "kinds: row 0: expected a number from 0 to 4, found 5"),
                                         ("rank", np.int64(3), "rank 3 is impossible"),
                                         ("dimension", np.int64(0), "the dimension is 0"),
                                         ("state", np.int64(7), "state: expected"),
                                         ("halfspaces", good["halfspaces"] * np.nan, "halfspaces")):
            np.savez(self.path("bad.npz"), **{**good, member: value})
            self.assertRegex(self.complaint("check", self.path("bad.npz")), complaint)
        del good["edges"]
        np.savez(self.path("bad.npz"), **good)
        self.assertIn("there is no member 'edges'", self.complaint("check", self.path("bad.npz")))
        with open(self.path("o.json"), encoding="utf-8") as file:
            text = file.read()
        for old, new, complaint in (('"full"', '"round"', "state: expected"), ('"bounded": true', '"bounded": 3', "true or false"),
                                    ('"edges": [', '"edges": [3, ', "edges: row 0: expected an array"),
                                    ('"rank": 2', '"rank": "two"', "rank"), ("}", "", "not valid JSON")):
            self.assertIn(old, text)
            self.assertIn(complaint, self.complaint("check", self.file("bad.json", text.replace(old, new))))

    def test_errors(self):
        self.assertIn("bad.csv:2", self.complaint("halfspaces", self.file("bad.csv", "1,0,-1\n1,nan,-1\n")))
        self.assertIn("two numbers", self.complaint("halfspaces", self.file("one.csv", "1\n2\n")))
        rows = self.file("box.npy", box(2))
        self.complaint("halfspaces", rows, "-o", self.path("o.vtu"))
        self.complaint("halfspaces", rows, "-o", self.path("missing/o.npz"))
        self.complaint("halfspaces", rows, "--stats", "-o", "-", "--output-format", "json", status=64)
        self.complaint("halfspaces", self.path("missing.csv"))


if __name__ == "__main__":
    unittest.main()
