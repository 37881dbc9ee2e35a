# SPDX-License-Identifier: BSD-3-Clause
"""delone locate: where queries lie."""
import json
import unittest

from cli_support import Case, np


class Locate(Case):
    def test_answers(self):
        square = self.file("square.txt", "0 0\n4 0\n0 4\n4 4.5\n")
        queries = self.file("queries.csv", "1,1\n0,0\n2,0\n-1,2\n2,2\n1e300,0\n")
        rows = [line.split(",") for line in self.output("locate", square, "--queries", queries).strip().split("\n")]
        self.assertEqual(rows[0], ["query", "kind", "cell", "face"])
        self.assertEqual([row[1] for row in rows[1:]], ["in_cell", "on_vertex", "on_face", "outside_hull", "on_face", "outside_hull"])
        self.assertEqual([row[3] for row in rows[1:]], ["0 1 2", "0", "0 1", "", "1 2", ""])
        self.assertEqual([row[2] for row in rows[1:]][3], "-1")
        self.output("delaunay", square, "-o", self.path("t.npz"))
        with np.load(self.path("t.npz")) as data:
            cells = data["cells"]
        for row in rows[1:]:
            if row[2] != "-1":
                self.assertTrue(set(map(int, row[3].split())) <= set(cells[int(row[2])]), row)

    def test_json_and_columns(self):
        points = self.file("p.csv", "x,y\n0,0\n1,0\n0,1\n")
        queries = self.file("q.csv", "id,y,x\n7,0.25,0.25\n8,0,2\n")
        out = self.path("answers.json")
        self.output("locate", points, "--queries", queries, "--query-columns", "x,y", "-o", out)
        with open(out) as f:
            answers = json.load(f)
        self.assertEqual(answers[0], {"query": 0, "kind": "in_cell", "cell": 0, "face": [0, 1, 2]})
        self.assertEqual((answers[1]["kind"], answers[1]["cell"]), ("outside_hull", -1))

    def test_what_does_not_fit(self):
        points = self.file("p.csv", "x,y\n0,0\n1,0\n0,1\n")
        turned = self.file("q.csv", "y,x\n0.25,0.5\n")
        for arguments in (["locate", points], ["interpolate", points, "--values", self.file("v.txt", "1\n2\n3\n")]):
            self.assertIn("q.csv: the columns y, x, not x, y, in this order; --query-columns", self.complaint(*arguments, "--queries", turned))
            self.output(*arguments, "--queries", turned, "--query-columns", "1,0")
            self.assertIn("--query-columns", self.complaint(*arguments, "--queries", self.file("r.txt", "1 2 3\n")))
        for name in ("a.npz", "a.vtu"):
            self.assertIn("available: csv, json", self.complaint("locate", points, "--queries", points, "-o", self.path(name)))
        self.assertIn("--output-format", self.complaint("locate", points, "--queries", points, "-o", self.path("a")))

    def test_outside_the_affine_hull(self):
        points = self.file("p.txt", "0 0 0\n1 0 0\n0 1 0\n")
        queries = self.file("q.txt", "0.1 0.1 0\n0.1 0.1 1e-300\n")
        rows = self.output("locate", points, "--queries", queries).strip().split("\n")
        self.assertEqual([row.split(",")[1] for row in rows[1:]], ["in_cell", "outside_affine_hull"])

    def test_every_point_is_at_itself(self):
        points = self.uniform(4, 300)
        rows = self.output("locate", points, "--queries", points).strip().split("\n")[1:]
        self.assertEqual([(row.split(",")[1], row.split(",")[3]) for row in rows], [("on_vertex", str(i)) for i in range(300)])

    def test_dimensions_must_agree(self):
        self.assertIn("dimension", self.complaint("locate", self.uniform(2, 9), "--queries", self.uniform(3, 9)))


if __name__ == "__main__":
    unittest.main()
