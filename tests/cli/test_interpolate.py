# SPDX-License-Identifier: BSD-3-Clause
"""delone interpolate: values at other places."""
import io
import json
import unittest

from cli_support import Case, np


def plane(points):
    return 1.0 + points @ np.array([2.0, -3.0])


class Interpolate(Case):
    def setUp(self):
        super().setUp()
        random = np.random.default_rng(5)
        self.points, self.places = random.random((60, 2)), 0.25 + random.random((20, 2)) / 2
        self.points = np.vstack([self.points, [[0, 0], [1, 0], [0, 1], [1, 1]]])
        self.values = np.column_stack([plane(self.points), np.sin(3 * self.points[:, 0])])
        self.field = self.save("field.csv", ["x", "y", "t", "s"], np.column_stack([self.points, self.values]))
        self.queries = self.save("places.csv", ["x", "y"], self.places)

    def save(self, name, names, rows):
        return self.file(name, ",".join(names) + "\n" + "".join(",".join(map(repr, map(float, row))) + "\n" for row in rows))

    def rows(self, *arguments, **options):
        text = self.output("interpolate", *arguments, **options)
        return text.split("\n", 1)[0], np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1, ndmin=2)

    def test_methods(self):
        for method in (["linear"], ["natural"], ["natural", "--smooth"]):
            names, rows = self.rows(self.field, "--values", "t,s", "--queries", self.queries, "--method", *method)
            self.assertEqual(names, "t,s")
            np.testing.assert_allclose(rows[:, 0], plane(self.places), atol=1e-9)
            np.testing.assert_allclose(rows[:, 1], np.sin(3 * self.places[:, 0]), atol=0.1)
        _, rows = self.rows(self.field, "--values", "t,s", "--queries", self.queries, "--method", "nearest")
        nearest = ((self.places[:, None] - self.points) ** 2).sum(axis=2).argmin(axis=1)
        np.testing.assert_array_equal(rows, self.values[nearest])
        _, rows = self.rows(self.field, "--values", "t,s", "--queries", self.save("same.csv", ["x", "y"], self.points))
        np.testing.assert_array_equal(rows, self.values)  # exactly the values at the points

    def test_where_values_come_from(self):
        _, expected = self.rows(self.field, "--values", "t,s", "--queries", self.queries)
        bare = self.file("bare.txt", "\n".join(" ".join(map(repr, map(float, row))) for row in np.column_stack([self.values, self.points])))
        rows = np.column_stack([self.points, self.values])
        alone, values = self.save("alone.csv", ["x", "y"], self.points), self.file("values.npy", self.values)
        for arguments in ([self.field, "--values", "2-3"], [self.field, "--values", "t,3", "--columns", "x,y"],
                          [bare, "--values", "0-1"], [bare, "--values", "0,1", "--columns", "2-3"], [alone, "--values", values],
                          [self.file("rows.npy", rows), "--values", "2-3"], [alone, "--values", "-"]):
            stdin = "\n".join(map(str, [2, 64, *self.values.ravel()])) if arguments[-1] == "-" else ""
            _, found = self.rows(*arguments, "--queries", self.queries, stdin=stdin)
            np.testing.assert_array_equal(found, expected, str(arguments))
        with open(self.field, "rb") as f:
            content = f.read()
        text = self.output("interpolate", "-", "--format", "csv", "--columns", "x,y", "--values", "s", "--queries", self.queries, stdin=content)
        self.assertEqual(text.split("\n")[0], "s")

    def test_outside(self):
        queries = self.file("q.txt", "0.5 0.5\n2 0.5\n1.001 0\n")
        arguments = [self.field, "--columns", "x,y", "--values", "t", "--queries", queries]
        _, rows = self.rows(*arguments)
        np.testing.assert_array_equal(np.isnan(rows[:, 0]), [False, True, True])
        for more, expected in ((["--fill", "-7"], [-7, -7]), (["--outside", "fill", "--fill", "1e3"], [1000, 1000]),
                               (["--outside", "project"], [plane(np.array([1, 0.5])), 3]), (["--tolerance", "0.01"], [np.nan, 3]),
                               (["--outside", "nearest"], [self.values[((self.points - [2, 0.5]) ** 2).sum(axis=1).argmin(), 0], 3])):
            for method in ("linear", "natural"):
                _, rows = self.rows(*arguments, *more, "--method", method)
                np.testing.assert_allclose(rows[1:, 0], expected, atol=1e-6, err_msg=str((method, more)))
        self.assertIn(queries, self.complaint("interpolate", *arguments, "--outside", "error"))
        for more in (["--outside", "nowhere"], ["--fill", "0", "--outside", "nearest"], ["--smooth"], ["--tolerance", "-1"], ["--tolerance", "nan"],
                     ["--tolerance", "1e400"], ["--method", "nearest", "--outside", "fill"], ["--method", "nearest", "--tolerance", "1"],
                     ["--output-format", "npy", "-o", "-"], ["--stats", "-o", "-"], ["--method", "cubic"]):
            self.complaint("interpolate", *arguments, *more, status=64)

    def test_outputs(self):
        arguments = [self.field, "--values", "t,s", "--queries", self.queries, "--coordinates"]
        names, expected = self.rows(*arguments)
        self.assertEqual(names, "x,y,t,s")
        np.testing.assert_array_equal(expected[:, :2], self.places)
        for name in ("o.npy", "o.json", "o.txt", "o.tsv", "o.csv"):
            self.output("interpolate", *arguments, "-o", self.path(name))
        np.testing.assert_array_equal(np.load(self.path("o.npy")), expected)
        np.testing.assert_array_equal(np.loadtxt(self.path("o.txt")), expected)
        np.testing.assert_array_equal(np.loadtxt(self.path("o.tsv"), skiprows=1), expected)
        with open(self.path("o.json")) as f:
            held = json.load(f)
        self.assertEqual(held["columns"], ["x", "y", "t", "s"])
        np.testing.assert_array_equal(held["data"], expected)
        far = self.file("far.txt", "5 5\n")
        text = self.output("interpolate", self.field, "--columns", "0-1", "--values", "t", "--queries", far, "--output-format", "json")
        self.assertEqual(json.loads(text), {"columns": ["t"], "data": [[None]]})
        empty = self.file("none.csv", "x,y\n")
        self.assertEqual(self.output("interpolate", self.field, "--columns", "0-1", "--values", "t", "--queries", empty), "t\n")
        self.assertEqual(json.loads(self.output("interpolate", self.field, "--columns", "0-1", "--values", "t", "--queries", empty, "--output-format", "json"))["data"], [])
        for output in ("o.vtu", "missing/o.csv", "o.csv.gz"):
            self.complaint("interpolate", *arguments, "-o", self.path(output))
        self.assertIn("also an input", self.complaint("interpolate", *arguments, "-o", self.field, status=64))

    def test_stats_and_threads(self):
        queries = self.file("q.txt", "0.5 0.5\n2 0.5\n1.001 0\n")
        out = self.path("o.csv")
        stats = json.loads(self.output("interpolate", self.field, "--values", "t,s", "--queries", queries, "--stats", "--tolerance", "0.01", "-o", out))
        self.assertEqual((stats["command"], stats["method"], stats["values"], stats["queries"], stats["outside"], stats["points"]),
                         ("interpolate", "linear", ["t", "s"], 3, 1, 64))
        self.assertIn("interpolate", stats["seconds"])
        self.assertEqual(np.loadtxt(out, delimiter=",", skiprows=1).shape, (3, 2))
        many = self.uniform(2, 20000, seed=9)
        answers = {self.output("interpolate", self.field, "--columns", "x,y", "--values", "s", "--queries", many, "--method", method, "--threads", threads)
                   for method in ("linear",) for threads in (1, 2)}
        self.assertEqual(len(answers), 1)

    def test_bad_input(self):
        for arguments, said in (([self.field, "--values", "u", "--queries", self.queries], "field.csv: --values: there is no column 'u'"),
                                ([self.field, "--values", "0-3", "--queries", self.queries], "beside the values there is no column"),
                                ([self.field, "--values", "t", "--queries", self.queries], "queries of dimension 2 for points of dimension 3"),
                                ([self.field, "--values", self.queries, "--queries", self.queries], "expected 64 rows of values, one per point, found 20")):
            self.assertIn(said, self.complaint("interpolate", *arguments))
        self.complaint("interpolate", "-", "--values", "t", "--queries", "-", status=64)
        self.assertIn("--memory", self.complaint("interpolate", self.field, "--values", "t,s", "--queries", self.queries, "--memory", "1M", status=3))

    def test_flat_points_and_none(self):
        line = self.file("line.csv", "x,y,v\n0,0,0\n1,1,10\n2,2,40\n")
        _, rows = self.rows(line, "--values", "v", "--queries", self.file("q.txt", "0.5 0.5\n1.5 1.5\n1 0\n"))
        np.testing.assert_array_equal(rows[:, 0], [5, 25, np.nan])
        none = self.file("none.csv", "x,y,v\n")
        for method in ("linear", "natural", "nearest"):
            _, rows = self.rows(none, "--values", "v", "--queries", self.queries, "--method", method)
            self.assertTrue(np.isnan(rows).all())


if __name__ == "__main__":
    unittest.main()
