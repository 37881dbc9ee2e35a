# SPDX-License-Identifier: BSD-3-Clause
"""delone check of Voronoi and power diagrams: right ones pass in any numbering, each kind of wrong one fails at its level."""
import json
import re
import unittest

from cli_support import Case, np


class CheckVoronoi(Case):
    def diagram(self, *points, command="voronoi"):
        self.output(command, *points, "-o", self.path("good.npz"))
        with np.load(self.path("good.npz")) as data:
            return {name: data[name] for name in data.files}

    def uniform_diagram(self, d=2, n=60):
        return self.diagram(self.uniform(d, n))

    def passes(self, arrays):
        path = self.path("other.npz")
        np.savez(path, **arrays)
        text = self.output("check", path)
        self.assertEqual(re.findall(r"^level (\d)  [a-z ]+ ok ", text, re.M), list("12345"))

    def violation(self, arrays, level, pattern=".+"):
        path = self.path("bad.npz")
        np.savez(path, **arrays)
        done = self.run_delone("check", path, status=1)
        text = done.stdout.decode()
        self.assertEqual(done.stderr, b"")
        self.assertRegex(text, rf"level {level}  [a-z ]+ FAILED")
        self.assertRegex(text, rf"\nviolation: {pattern}")
        self.assertNotIn(f"level {level + 1}", text)

    def test_own_files_pass(self):
        for kind, d, n in (("uniform", 1, 9), ("uniform", 2, 200), ("uniform", 3, 60), ("uniform", 4, 30), ("uniform", 5, 20),
                           ("grid", 2, 25), ("grid", 3, 27), ("grid", 4, 16), ("flat", 3, 30), ("collinear", 3, 6),
                           ("equal", 2, 3), ("cospherical", 3, 40)):
            with self.subTest(kind=kind, d=d):
                points = self.path("points.npy")
                self.output("generate", kind, "-d", d, "-n", n, "-o", points)
                for name in ("own.npz", "own.json"):
                    self.output("voronoi", points, "-o", self.path(name))
                    text = self.output("check", self.path(name))
                    self.assertIn("the Voronoi diagram of all its points, exactly", text)
        self.assertIn("no violation up to this level", self.output("check", self.path("own.npz"), "--level", 2))

    def test_power_diagrams_with_hidden_points(self):
        random = np.random.default_rng(1)
        for d in (2, 3, 4):
            table = np.hstack([random.integers(0, 4, (60, d)), random.integers(-4, 5, (60, 1))]).astype(float)
            self.file("weights.npy", table[:, d])
            good = self.diagram(self.file("points.npy", table[:, :d]), "--weights", self.path("weights.npy"), command="power")
            self.assertTrue((good["point_region"] < 0).any())
            self.assertTrue(np.array_equal(good["points"], table[:, :d]))  # hidden points, too
            self.assertIn("the power diagram of all its points", self.output("check", self.path("good.npz")))
            self.output("power", self.path("points.npy"), "--weights", self.path("weights.npy"), "-o", self.path("good.json"))
            self.output("check", self.path("good.json"))
            hidden = int(np.flatnonzero(good["point_region"] < 0)[0])
            weights = good["weights"].copy()
            weights[hidden] += 50
            self.violation({**good, "weights": weights}, 2)
            region = good["point_region"].copy()
            region[hidden] = 0
            self.violation({**good, "point_region": region}, 2, f"point {hidden} is hidden, but has a region")

    def test_other_numbers_and_starts_pass(self):
        for d in (2, 3, 4):
            good = self.uniform_diagram(d, 40)
            order = np.random.default_rng(d).permutation(len(good["vertices"]))
            number = np.append(np.argsort(order), -1)  # by old number; -1 stays
            other = {**good, "vertices": good["vertices"][order]}
            for name in ("ridge_vertices", "region_vertices", "ray_vertices"):
                other[name] = number[good[name]].astype(np.int32)
            other["ridge_points"] = good["ridge_points"].copy()
            for lists in ("ridge", "region"):
                items, offsets = other[lists + "_vertices"], good[lists + "_offsets"]
                for i, (a, b) in enumerate(zip(offsets, offsets[1:])):
                    if items[a] >= 0:
                        items[a:b] = np.roll(items[a:b], 1)
                    if lists == "ridge" and i % 3 == 0:  # the same edge seen from its other end
                        other["ridge_points"][i] = good["ridge_points"][i, ::-1]
                        first = a + (items[a] < 0)
                        items[first:b] = items[first:b][::-1]
            self.passes(other)

    def test_wrong_storage(self):
        good = self.uniform_diagram()
        for name, position, value in (("ridge_points", (3, 1), 60), ("ridge_vertices", 0, 10**6), ("region_vertices", 2, -2),
                                      ("point_region", 5, 60), ("ray_vertices", 0, -1), ("ridge_offsets", 4, 1000)):
            with self.subTest(name=name):
                changed = good[name].copy()
                changed[position] = value
                self.violation({**good, name: changed}, 1)
        items = good["region_vertices"].copy()
        items[1] = items[2]
        self.violation({**good, "region_vertices": items}, 1, r"region 0: a vertex appears twice")

    def test_wrong_regions(self):
        good = self.uniform_diagram()
        offsets, items = good["region_offsets"], good["region_vertices"]
        bounded = next(i for i in range(60) if items[offsets[i]] >= 0 and offsets[i + 1] - offsets[i] > 3)
        a = offsets[bounded]
        swapped = items.copy()
        swapped[[a, a + 1]] = items[[a + 1, a]]
        self.violation({**good, "region_vertices": swapped}, 2, rf"region {bounded}: its vertices are not in cyclic order")
        other = items.copy()
        inside = set(items[a:offsets[bounded + 1]])
        other[a] = next(v for v in range(len(good["vertices"])) if v not in inside)
        self.violation({**good, "region_vertices": other}, 2, "vertex [0-9]+: the sites of its regions")
        regions = good["point_region"].copy()
        regions[[4, 9]] = regions[[9, 4]]
        self.violation({**good, "point_region": regions}, 2)
        regions[4] = -1
        self.violation({**good, "point_region": regions}, 2, "point 4 has no region, but is not hidden")
        points = good["points"].copy()
        points[7] += 0.2
        self.violation({**good, "points": points}, 2)

    def test_vertex_off_by_one_unit(self):
        for d in (2, 3, 6):
            good = self.uniform_diagram(d, 20)
            vertices = good["vertices"].copy()
            vertices[5, 1] = np.nextafter(vertices[5, 1], 9)
            self.violation({**good, "vertices": vertices}, 3, "vertex 5: coordinate 1 is not the double nearest")

    def test_wrong_ridges(self):
        for d in (2, 3, 4):
            good = self.uniform_diagram(d, 25)
            pairs, offsets = good["ridge_points"].copy(), good["ridge_offsets"]
            pairs[2] = pairs[1]
            self.violation({**good, "ridge_points": pairs}, 4, "ridge 2: ")
            cut = offsets[-2]
            self.violation({**good, "ridge_points": good["ridge_points"][:-1], "ridge_offsets": offsets[:-1],
                            "ridge_vertices": good["ridge_vertices"][:cut]}, 4, "there is no ridge of points")
        good = self.uniform_diagram(3, 25)
        offsets, items = good["ridge_offsets"], good["ridge_vertices"].copy()
        i = next(i for i in range(len(offsets) - 1) if offsets[i + 1] - offsets[i] > 3)
        a = offsets[i + 1] - 2
        items[[a, a + 1]] = items[[a + 1, a]]
        self.violation({**good, "ridge_vertices": items}, 4, rf"ridge {i}: these are not its vertices in cyclic order")

    def test_wrong_rays(self):
        for d in (2, 3):
            good = self.uniform_diagram(d, 25)
            directions = good["ray_directions"].copy()
            directions[3] *= -1
            self.violation({**good, "ray_directions": directions}, 5, "ray 3: not the outward direction")
            points = good["ray_points"].copy()
            points[0] = points[1]
            self.violation({**good, "ray_points": points}, 5, "ray 0: ")
            fewer = {name: good[name][1:] for name in ("ray_points", "ray_vertices", "ray_directions")}
            self.violation({**good, **fewer}, 5, "there is no ray")

    def test_broken_files(self):
        good = self.uniform_diagram()
        for name in good:
            if name in ("kind", "weights"):
                continue  # without the first, arrays tell; points have no weights
            np.savez(self.path("bad.npz"), **{key: value for key, value in good.items() if key != name})
            self.assertIn(f"there is no member '{name}'", self.complaint("check", self.path("bad.npz")))
        for name, value in (("vertices", good["vertices"][:, :1]), ("ridge_points", good["ridge_points"][1:]),
                            ("ray_points", good["ray_points"].ravel()), ("points", good["points"][1:]),
                            ("points", good["points"] * np.nan), ("weights", np.zeros(3)), ("affine_dimension", np.array(7))):
            with self.subTest(name=name):
                np.savez(self.path("bad.npz"), **{**good, name: value})
                self.assertIn("bad.npz", self.complaint("check", self.path("bad.npz")))
        with open(self.path("good.npz"), "rb") as f:
            content = f.read()
        self.complaint("check", self.file("bad.npz", content[:-100]))

        self.output("voronoi", self.uniform(2, 60), "-o", self.path("good.json"))
        with open(self.path("good.json")) as f:
            text = f.read()
        data = json.loads(text)
        for name, value in (("regions", 3), ("regions", [1, 2]), ("regions", [[1], 2]), ("vertices", [[1, 2], [3]]),
                            ("vertices", [["a", 2]]), ("ridge_points", [[0.5, 1]]), ("point_region", None),
                            ("dimension", 3), ("dimension", "2"), ("affine_dimension", -5), ("ray_points", [[2**40, 1]])):
            with self.subTest(name=name, value=value):
                self.complaint("check", self.file("bad.json", json.dumps({**data, name: value})))
        self.complaint("check", self.file("bad.json", text[:-50]))
        self.assertIn("1e999", self.complaint("check", self.file("bad.json", text.replace("0.", "1e999, 0.", 1))))

    def test_options(self):
        self.uniform_diagram()
        for option in (["--canonical"], ["--furthest-site"], ["--points", self.uniform(2, 60)]):
            self.complaint("check", self.path("good.npz"), *option, status=64)


if __name__ == "__main__":
    unittest.main()
