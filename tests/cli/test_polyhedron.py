# SPDX-License-Identifier: BSD-3-Clause
"""delone polyhedron: both descriptions, statistics, standard streams, errors."""
import json
import pathlib
import unittest

from cli_support import Case

TRIANGLE = "H-representation\nbegin\n4 3 integer\n0 1 0\n0 0 1\n1 -2 -3\n5 -1 -1\nend\n"
VERTICES = "V-representation\nbegin\n3 3 rational\n1 0 0\n1 0 1/3\n1 1/2 0\nend\n"
FACETS = "H-representation\nbegin\n3 3 integer\n0 1 0\n0 0 1\n1 -2 -3\nend\n"


class Polyhedra(Case):
    def stats(self, text):
        return json.loads(self.output("polyhedron", self.file("in.ine", text), "--stats"))

    def test_there_and_back(self):
        there, back = self.path("out.ext"), self.path("back.ine")
        self.output("polyhedron", self.file("in.ine", TRIANGLE), "-o", there)
        self.assertEqual(pathlib.Path(there).read_text(), VERTICES)
        self.output("polyhedron", there, "-o", back)
        self.assertEqual(pathlib.Path(back).read_text(), FACETS)

    def test_stats(self):
        stats = self.stats(TRIANGLE)
        expected = {"command": "polyhedron", "dimension": 2, "affine_dimension": 2, "vertices": 3, "rays": 0, "lines": 0,
                    "inequalities": 3, "equations": 0, "redundant_rows": 1}
        self.assertEqual({name: stats[name] for name in expected}, expected)
        self.assertEqual(stats["hash"], self.stats(VERTICES)["hash"])
        self.assertEqual(set(stats["seconds"]), {"read", "build", "write", "total"})
        empty = self.stats("begin\n2 2 integer\n-1 1\n0 -1\nend\n")
        self.assertEqual((empty["affine_dimension"], empty["vertices"], empty["equations"]), (-1, 0, 1))
        line = self.stats("linearity 1 1\nbegin\n1 3 integer\n1 -1 -1\nend\n")
        self.assertEqual((line["affine_dimension"], line["vertices"], line["lines"], line["equations"]), (1, 1, 1, 1))

    def test_summary(self):
        text = self.output("polyhedron", self.file("cone.ext", "V-representation\nbegin\n2 3 integer\n0 1 0\n0 1 1\nend\n"))
        self.assertIn("polyhedron in dimension 2", text)
        self.assertRegex(text, r"vertices +1\n")
        self.assertRegex(text, r"bounded +no: 2 rays, 0 lines\n")
        self.assertRegex(self.output("polyhedron", self.file("no.ine", "begin\n1 2 integer\n-1 0\nend\n")), r"empty +no point")

    def test_standard_streams(self):
        self.assertEqual(self.output("polyhedron", "-", "-o", "-", "--output-format", "ine", stdin=TRIANGLE), FACETS)
        self.assertEqual(self.output("polyhedron", "-", "-o", "-", "--output-format", "ext", stdin=TRIANGLE), VERTICES)

    def test_descriptions_of_one_polyhedron(self):
        triangle, vertices = self.file("in.ine", TRIANGLE), self.file("in.ext", VERTICES)
        said = self.output("check", triangle, "--same-as", vertices)
        self.assertIn("in.ine: 4 inequalities, 0 equations in dimension 2", said)
        self.assertIn("in.ext: 3 points, 0 rays, 0 lines in dimension 2", said)
        self.assertIn("proved: both are the polyhedron with the hash", said)
        larger = self.file("larger.ext", VERTICES.replace("1/2", "2/3"))
        self.assertRegex(self.output("check", triangle, "--same-as", larger, status=1), r"larger.ext has the vertex \(2/3, 0\), which is not in .*in.ine")
        self.assertRegex(self.output("check", larger, "--same-as", triangle, status=1), r"larger.ext has the vertex \(2/3, 0\), which is not in .*in.ine")
        cone = self.file("cone.ext", "V-representation\nbegin\n4 3 rational\n1 0 0\n1 0 1/3\n1 1/2 0\n0 1 0\nend\n")
        self.assertIn("cone.ext has a ray or a line that", self.output("check", vertices, "--same-as", cone, status=1))
        line = self.file("line.ine", "begin\n1 2 integer\n1 1\nend\n")
        self.assertIn("line.ine is in dimension 1", self.complaint("check", line, "--same-as", triangle, status=64))

    def test_threads(self):
        self.assertEqual(self.output("polyhedron", self.file("in.ine", TRIANGLE), "-o", "-", "--output-format", "ext", "--threads", "2"), VERTICES)

    def test_errors(self):
        broken = self.file("in.ine", "begin\n2 2 integer\n1 2\n1 x\nend\n")
        self.assertIn("in.ine:4: \"x\" is not a rational number", self.complaint("polyhedron", broken))
        triangle = self.file("triangle.ine", TRIANGLE)
        self.assertIn("off", self.complaint("polyhedron", triangle, "-o", self.path("out.off")))
        self.assertIn("in.ine", self.complaint("polyhedron", self.path("none/in.ine")))
        self.assertIn("--force", self.complaint("polyhedron", triangle, "-o", triangle, status=64))


if __name__ == "__main__":
    unittest.main()
