# SPDX-License-Identifier: BSD-3-Clause
"""--qhull against Qhull's own programs: the same after facets have been matched by their vertices, lists sorted and cycles turned.
Numbers that Qhull computes agree up to its rounding, all else exactly."""
import re
import shutil
import subprocess
import sys
import unittest

from cli_support import Case, np

if any(shutil.which(program) is None for program in ("rbox", "qconvex", "qdelaunay", "qvoronoi", "qhalf")):
    print("skipped: Qhull's programs are missing", file=sys.stderr)
    sys.exit(77)


def run(program, *arguments, stdin=""):
    return subprocess.run([program, *arguments], input=stdin, capture_output=True, text=True, check=True, timeout=60).stdout


def rbox(arguments):
    return run("rbox", *arguments.split())


class Reader:
    """The numbers of a text, line by line."""

    def __init__(self, text):
        self.lines = [line.split() for line in text.strip("\n").split("\n")]

    def row(self, kind=int):
        return tuple(kind(x) for x in self.lines.pop(0))

    def rows_left(self):
        return self.rows(len(self.lines))

    def rows(self, count, kind=int):
        return [self.row(kind) for _ in range(count)]


def turned(cycle, reflect=False):
    """A cycle that begins with its least entry; the lesser direction if it may be reflected."""
    def from_least(c):
        start = c.index(min(c, key=str))
        return tuple(c[start:] + c[:start])
    cycle = list(cycle)
    return min(from_least(cycle), from_least(cycle[::-1]), key=str) if reflect else from_least(cycle)


def simplex(rows):
    """The sorted vertices of a simplex and the parity of their order."""
    rows = list(rows)
    inversions = sum(a > b for i, a in enumerate(rows) for b in rows[i + 1:])
    return tuple(sorted(rows)), inversions % 2


def oriented(rows, k):
    """A facet of a polytope of dimension k."""
    if len(rows) == k:
        return simplex(rows)
    return turned(rows) if k == 3 else tuple(sorted(rows))


class Facets:
    """Outputs of anything with facets, by the names of Qhull's options; facets are named by their vertices."""

    def __init__(self, text, outputs, k):
        reader = Reader(text)
        read = {}
        for output in outputs.split():
            if output == "o":
                (d,), (n, count, ridges) = reader.row(), reader.row()
                read[output] = (d, n, count, ridges), reader.rows(n, float), [row[1:] for row in reader.rows(count)]
            elif output in ("n", "p", "Fp"):
                (width,), (count,) = reader.row(), reader.row()
                read[output] = width, reader.rows(count, float)
            elif output == "FS":
                read[output] = reader.row(), reader.row(float)
            else:
                (count,) = reader.row()
                rows = reader.rows(count)
                if output in ("Fv", "Fn"):
                    assert all(row[0] == len(row) - 1 for row in rows)
                    rows = [row[1:] for row in rows]
                read[output] = rows
        assert not reader.lines, reader.lines
        self.read = read
        self.names = [frozenset(row) for row in read["Fv"]]
        assert len(set(self.names)) == len(self.names)
        self.k = k

    def by_name(self, items):
        assert len(items) == len(self.names)
        return dict(zip(self.names, items))

    def neighbors(self):
        """Of a simplex with the vertex opposite to each."""
        result = {}
        for name, vertices, row in zip(self.names, self.read["Fv"], self.read["Fn"]):
            found = [None if i < 0 else self.names[i] for i in row]
            result[name] = (frozenset(zip(vertices, found)) if len(vertices) == self.k and len(found) == self.k
                            else (frozenset(found), len(found)))
        return result

    def oriented(self, output):
        rows = self.read["o"][2] if output == "o" else self.read[output]
        assert [frozenset(row) for row in rows] == self.names
        return self.by_name([oriented(row, self.k) for row in rows])


class QhullOutputs(Case):
    def compare_rows(self, ours, theirs, what):
        self.assertEqual(len(ours), len(theirs), what)
        if len(ours):
            scale = np.abs(np.array(theirs)).max()
            np.testing.assert_allclose(np.array(ours), np.array(theirs), rtol=1e-9, atol=1e-9 * scale, err_msg=str(what))

    def compare_facets(self, program, command, text, outputs, k, d, plane=False):
        theirs = Facets(run(program[0], *program[1:], *outputs.split(), stdin=text), outputs, k)
        ours = Facets(self.output(command, "-", "--qhull", outputs.replace(" ", ","), stdin=text), outputs, k)
        self.assertEqual(set(ours.names), set(theirs.names))
        self.assertEqual(ours.neighbors(), theirs.neighbors())
        if "o" in outputs.split():
            self.assertEqual(ours.read["o"][0], theirs.read["o"][0])
            self.compare_rows(ours.read["o"][1], theirs.read["o"][1], "o")
            self.assertEqual(ours.oriented("o"), theirs.oriented("o"))
        if "i" in outputs.split():
            self.assertEqual(ours.oriented("i"), theirs.oriented("i"))
        for output in {"n", "Fp"} & set(outputs.split()):
            self.assertEqual(ours.read[output][0], theirs.read[output][0])
            a, b = ours.by_name(ours.read[output][1]), theirs.by_name(theirs.read[output][1])
            self.compare_rows([a[name] for name in theirs.names], [b[name] for name in theirs.names], output)
        if "p" in outputs.split():
            self.assertEqual(ours.read["p"][0], theirs.read["p"][0])
            self.compare_rows(sorted(ours.read["p"][1]), sorted(theirs.read["p"][1]), "p")
        if "FS" in outputs.split():
            self.assertEqual(ours.read["FS"][0], theirs.read["FS"][0])
            np.testing.assert_allclose(ours.read["FS"][1], theirs.read["FS"][1], rtol=1e-9)
        if "Fx" in outputs.split():
            a, b = ours.read["Fx"], theirs.read["Fx"]
            self.assertEqual(*((turned(a), turned(b)) if plane else (sorted(a), sorted(b))))

    def test_hulls(self):
        for arguments, d in (("30 D2 t1", 2), ("30 D3 t2", 3), ("20 D4 t3", 4), ("14 D5 t4", 5), ("c D2", 2), ("c D3", 3), ("d D3", 3),
                             ("c D4", 4), ("c G0.9 d D3", 3), ("27 D3 M1,0", 3), ("200 D3 s t5", 3), ("c P1,0.25,0.25 P-1,0,0 D3", 3)):
            with self.subTest(arguments):
                outputs = "o n p Fv Fx Fn FS" + (" i" if d <= 3 else "")
                self.compare_facets(["qconvex"], "hull", rbox(arguments), outputs, d, d, plane=d == 2)

    def test_triangulations(self):
        for arguments, d in (("40 D2 t1", 2), ("40 D3 t2", 3), ("20 D4 t3", 4), ("12 D5 t4", 5)):
            with self.subTest(arguments):
                self.compare_facets(["qdelaunay", "Qt"], "delaunay", rbox(arguments), "o p i Fv Fx Fn FS", d + 1, d)
        # Coordinates of one sign, and a duplicate.
        text = "2 comment\n6\n5 6\n7 6.5\n6 9\n5.5 7\n6.2 7.1\n5 6\n"
        self.compare_facets(["qdelaunay", "Qt"], "delaunay", text, "o p Fv Fn", 3, 2)
        theirs = run("qdelaunay", "Qt", "Qu", "o", "Fv", "Fn", stdin=rbox("20 D2 t1"))
        ours = self.output("delaunay", "-", "--furthest-site", "--qhull", "o Fv,Fn", stdin=rbox("20 D2 t1"))
        a, b = Facets(ours, "o Fv Fn", 3), Facets(theirs, "o Fv Fn", 3)
        self.assertEqual(a.neighbors(), b.neighbors())
        self.assertEqual(a.read["o"][0], b.read["o"][0])

    def test_lattices_have_a_border(self):
        """Qhull triangulates what is cospherical in an order of its own; the points on the border are the same."""
        for arguments in ("25 D2 M1,0", "27 D3 M1,0"):
            theirs = Reader(run("qdelaunay", "Qt", "Fx", stdin=rbox(arguments))).lines
            ours = Reader(self.output("delaunay", "-", "--qhull", "Fx", stdin=rbox(arguments))).lines
            self.assertEqual(sorted(ours), sorted(theirs))

    def test_intersections(self):
        """The halfspaces that touch a sphere in random points, and those of polytopes with vertices of many facets."""
        cases = [(rbox(arguments), True) for arguments in ("20 D2 s t1", "30 D3 s t2", "16 D4 s t3")]
        cases += [(run("qconvex", "n", stdin=rbox(arguments)), False) for arguments in ("c D2", "c D3", "d D3", "c D4", "c G0.9 d D3")]
        for text, are_points in cases:
            lines = text.strip().split("\n")
            d = int(lines[0].split()[0]) - (not are_points)
            with self.subTest(lines[0], d=d):
                if are_points:
                    lines = [str(d + 1), lines[1]] + [f"{line} -1" for line in lines[2:]]
                point, text = ["0.0625"] * d, "\n".join(lines)
                outputs = "o p Fp Fv Fx Fn" + (" i" if d <= 3 else "")
                theirs = Facets(run("qhalf", "H" + ",".join(point), *outputs.split(), stdin=text), outputs, d)
                halfspaces = self.file("halfspaces.txt", text)
                ours = Facets(self.output("halfspaces", halfspaces, "--format", "qhull", "--interior=" + ",".join(point), "--qhull",
                                          outputs), outputs, d)
                self.assertEqual(set(ours.names), set(theirs.names))
                self.assertEqual(ours.neighbors(), theirs.neighbors())
                self.assertEqual(ours.read["o"][0], theirs.read["o"][0])
                self.compare_rows(ours.read["o"][1], theirs.read["o"][1], "o")
                self.assertEqual(ours.oriented("o"), theirs.oriented("o"))
                a, b = ours.by_name(ours.read["Fp"][1]), theirs.by_name(theirs.read["Fp"][1])
                self.compare_rows([a[name] for name in a], [b[name] for name in a], "Fp")
                self.compare_rows(sorted(ours.read["p"][1]), sorted(theirs.read["p"][1]), "p")
                if d <= 3:
                    self.assertEqual(ours.oriented("i"), theirs.oriented("i"))
                a, b = ours.read["Fx"], theirs.read["Fx"]
                self.assertEqual(*((turned(a), turned(b)) if d == 2 else (sorted(a), sorted(b))))

    def diagram(self, text, d):
        """o, p, Fv, Fx and Fn, with vertices named by the sites around them."""
        reader = Reader(text)
        width, (vertices, sites, one) = reader.row(), reader.row()
        self.assertEqual((width, one), ((d,), 1))
        coordinates = reader.rows(vertices, float)
        regions = [row[1:] for row in reader.rows(sites)]
        names = [frozenset(site for site, row in enumerate(regions) if v in row) for v in range(vertices)]
        names[0] = "infinity"
        self.assertEqual(coordinates[0], (-10.101,) * d)
        self.assertEqual(reader.row(), (d,))
        self.assertEqual(reader.row(), (vertices - 1,))
        self.assertEqual(reader.rows(vertices - 1, float), coordinates[1:])
        ridges = {}
        for row in reader.rows(*reader.row()):
            self.assertEqual(row[0], len(row) - 1)
            around = [names[v] for v in row[3:]]
            ridges[row[1:3]] = turned(around, reflect=True) if d == 3 else frozenset(around)
        border = sorted(reader.rows(*reader.row()))
        neighbors = {}
        for name, row in zip(names[1:], reader.rows(*reader.row())):
            self.assertEqual(row[0], len(row) - 1)
            neighbors[name] = sorted(("outside" if v < 0 else sorted(names[v + 1]) for v in row[1:]), key=str)
        self.assertEqual(reader.lines, [])
        regions = [turned([names[v] for v in row], reflect=True) if d == 2 and row else frozenset(names[v] for v in row) for row in regions]
        return dict(zip(names, coordinates)), regions, ridges, border, neighbors

    def test_diagrams(self):
        lattice = "2\n9\n" + "".join(f"{x} {y}\n" for x in range(3) for y in range(3))
        for text, d in ((rbox("40 D2 t1"), 2), (rbox("30 D3 t2"), 3), (rbox("12 D4 t3"), 4), (rbox("9 D5 t4"), 5), (lattice, 2),
                        (rbox("c G1 d D2"), 2), ("2\n6\n0 0\n1 0\n0.1 1\n0 0\n.2 .3\n1 0\n", 2)):
            with self.subTest(text[:30]):
                theirs = self.diagram(run("qvoronoi", "o", "p", "Fv", "Fx", "Fn", stdin=text), d)
                ours = self.diagram(self.output("voronoi", "-", "--qhull", "o p Fv Fx Fn", stdin=text), d)
                self.assertEqual(set(ours[0]), set(theirs[0]))
                self.compare_rows([ours[0][name] for name in theirs[0]], list(theirs[0].values()), "vertices")
                for a, b in zip(ours[1:], theirs[1:]):
                    self.assertEqual(a, b)

    def test_ridges_of_a_lattice(self):
        """Those that are unbounded in several directions are left out, as in Qhull."""
        read = lambda text: {row[1:3]: len(row) for row in Reader(text).rows_left()[1:]}
        text = rbox("27 D3 M1,0")
        self.assertEqual(read(self.output("voronoi", "-", "--qhull", "Fv", stdin=text)), read(run("qvoronoi", "Fv", stdin=text)))

    def test_summary(self):
        def figures(text):
            lines = [line.strip().split(":") for line in text.split("\n")]
            return {line[0]: float(line[1]) for line in lines if re.match("Number of .*(vert|facets$|sites|regions)|.* (area|volume)", line[0])}

        for arguments in ("30 D2 t1", "c D3", "20 D4 t3"):
            text = rbox(arguments)
            theirs, ours = figures(run("qconvex", "FA", stdin=text)), figures(self.output("hull", "-", "--qhull", "FA", stdin=text))
            self.assertEqual(ours, {key: theirs[key] for key in ours})
            self.assertGreaterEqual(len(ours), 4)
        text = rbox("30 D3 t1")
        theirs, ours = figures(run("qdelaunay", "FA", stdin=text)), figures(self.output("delaunay", "-", "--qhull", "FA", stdin=text))
        self.assertEqual(ours, {key: theirs[key] for key in ours})
        self.assertEqual(len(ours), 3)

    def test_refusals(self):
        text = rbox("c D4")
        self.assertIn("'q' is none of the outputs of a convex hull in the form of Qhull: o n p", self.complaint("hull", "-", "--qhull", "o q", stdin=text))
        self.assertIn("'n' is none", self.complaint("delaunay", "-", "--qhull", "n", stdin=text))
        self.assertIn("no output", self.complaint("delaunay", "-", "--qhull", ",", stdin=text))
        self.assertIn("adds a point", self.complaint("hull", "-", "--qhull", "i", stdin=text))
        self.assertIn("bounded", self.complaint("halfspaces", "-", "--qhull", "Fp", stdin="3\n2\n-1 0 -1\n0 -1 -1\n"))
        for option in ("--lower", "--output-format=json"):
            self.complaint("hull", "-", "--qhull", "o", option, status=64, stdin=text)

    def test_flat_and_empty_input(self):
        for text in ("3\n4\n0 0 0\n1 1 1\n2 2 2\n5 5 5\n", "2\n1\n3 4\n", "3\n4\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n", "2\n2\n1 1\n1 1\n"):
            for command, outputs in (("hull", "o n p i Fv Fx Fn FA FS"), ("delaunay", "o p i Fv Fx Fn FA FS"), ("voronoi", "o p Fv Fx Fn")):
                with self.subTest(text=text, command=command):
                    self.output(command, "-", "--qhull", outputs, stdin=text)

    def test_file(self):
        out = self.path("out.txt")
        self.output("hull", "-", "--qhull", "Fx", "-o", out, stdin=rbox("c D2"))
        with open(out, encoding="ascii") as file:
            self.assertEqual(file.read().split()[0], "4")


if __name__ == "__main__":
    unittest.main()
