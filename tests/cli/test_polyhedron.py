# SPDX-License-Identifier: BSD-3-Clause
"""delone polyhedron: both descriptions, statistics, standard streams, errors."""
import itertools
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
        for pair in ([triangle, larger], [larger, triangle]):
            self.assertRegex(self.output("check", pair[0], "--same-as", pair[1], status=1), r"larger.ext has points that inequality 3 of .*in.ine excludes")
        smaller = self.file("smaller.ext", VERTICES.replace("1/2", "1/4"))
        self.assertRegex(self.output("check", triangle, "--same-as", smaller, status=1), r"in.ine has the vertex \(1/2, 0\), which is not in .*smaller.ext")
        self.assertRegex(self.output("check", smaller, "--same-as", vertices, status=1), r"in.ext has the vertex \(1/2, 0\), which is not in .*smaller.ext")
        cone = self.file("cone.ext", "V-representation\nbegin\n4 3 rational\n1 0 0\n1 0 1/3\n1 1/2 0\n0 1 0\nend\n")
        self.assertIn("cone.ext has a ray or a line that", self.output("check", vertices, "--same-as", cone, status=1))
        self.assertIn("excludes", self.output("check", cone, "--same-as", triangle, status=1))
        flat = self.file("flat.ext", "V-representation\nbegin\n2 3 integer\n1 0 0\n1 1 1\nend\n")
        for rows in ("linearity 1 1\nbegin\n3 3 integer\n0 1 -1\n0 1 0\n2 -1 -1\nend\n",        # an equation
                     "begin\n4 3 integer\n0 1 -1\n0 -1 1\n0 1 0\n1 0 -1\nend\n"):               # two inequalities that are one
            self.assertIn("proved", self.output("check", flat, "--same-as", self.file("flat.ine", rows)))
        bent = self.file("bent.ine", "linearity 1 1\nbegin\n3 3 integer\n0 1 -2\n0 1 0\n2 -1 -1\nend\n")
        self.assertIn("flat.ext has points that equation 1 of", self.output("check", flat, "--same-as", bent, status=1))
        line = self.file("line.ine", "begin\n1 2 integer\n1 1\nend\n")
        self.assertIn("line.ine is in dimension 1", self.complaint("check", line, "--same-as", triangle, status=64))

    def test_one_direction_is_enough(self):
        """The facets of the cut polytope of six nodes would take days to become vertices."""
        nodes = range(6)
        cuts = sorted({tuple(int(side[i] != side[j]) for i in nodes for j in range(i)) for side in itertools.product((0, 1), repeat=6)})
        rows = "".join("1 " + " ".join(map(str, cut)) + "\n" for cut in cuts)
        vertices = self.file("cuts.ext", f"V-representation\nbegin\n{len(cuts)} 16 integer\n{rows}end\n")
        self.output("polyhedron", vertices, "-o", self.path("cuts.ine"))
        self.assertIn("proved", self.output("check", self.path("cuts.ine"), "--same-as", vertices))

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
