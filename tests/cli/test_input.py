# SPDX-License-Identifier: BSD-3-Clause
"""Points in every format; what is refused gives one line that says where."""
import time
import unittest

from cli_support import Case, np


class Input(Case):
    def test_the_same_points_in_every_format(self):
        points = np.random.default_rng(1).integers(-1000, 1000, (60, 3)).astype(float)
        rows = [" ".join(map(repr, map(float, p))) for p in points]
        csv = "\n".join(r.replace(" ", ",") for r in rows) + "\n"
        big_endian = points.astype(">f8")
        files = [self.file("a.npy", points), self.file("f.npy", np.asfortranarray(points)), self.file("b.npy", big_endian),
                 self.file("s.npy", points.astype(np.float32)), self.file("i.npy", points.astype(np.int16)),
                 self.file("l.npy", points.astype(np.int64)), self.file("a.csv", csv), self.file("h.csv", "x,y,z\n" + csv),
                 self.file("crlf.csv", csv.replace("\n", "\r\n")), self.file("a.tsv", csv.replace(",", "\t")),
                 self.file("a.txt", "# points\n" + "\n".join(rows)), self.file("a.xyz", "\n".join(rows)),
                 self.file("a.off", f"OFF\n{len(rows)} 0 0\n" + "\n".join(rows) + "\n"),
                 self.file("a.ply", f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\nproperty double x\nproperty double y\n"
                           "property double z\nend_header\n" + "\n".join(rows) + "\n")]
        hashes = {self.stats(path)["hash"] for path in files}
        text = f"3 some comment\n{len(rows)}\n" + "\n".join(rows) + "\n"
        hashes.add(self.stats("-", stdin=text)["hash"])
        hashes.add(self.stats("-", "--format", "csv", stdin=csv)["hash"])
        self.assertEqual(len(hashes), 1)

    def test_columns(self):
        path = self.file("a.csv", "name,x,depth,y\na,0,5,0\nb,1,5,0\nc,0,5,1\nd,1,6,1.5\n")
        stats = self.stats(path, "--columns", "x,y")
        self.assertEqual((stats["dimension"], stats["cells"]), (2, 2))
        self.assertEqual(self.stats(path, "--columns", "x,y,depth")["affine_dimension"], 3)

    def test_unlucky_input_is_a_result(self):
        for content, affine, vertices, cells in (("1 2\n", 0, 1, 1), ("1 2\n1 2\n", 0, 1, 1), ("0 0\n1 1\n3 3\n", 1, 3, 2),
                                                 ("0 0\n1 0\n0 1\n0 0\n-0 1\n", 2, 3, 1)):
            stats = self.stats(self.file("a.txt", content))
            self.assertEqual((stats["affine_dimension"], stats["vertices"], stats["cells"]), (affine, vertices, cells), content)
            self.assertEqual(stats["duplicates"], stats["points"] - vertices)

    def test_no_points_at_all(self):
        stats = self.stats("-", stdin="3\n0\n")
        self.assertEqual((stats["points"], stats["affine_dimension"], stats["cells"]), (0, -1, 0))


class BadInput(Case):
    def refused(self, name, content, *patterns, arguments=(), status=2):
        path = self.file(name, content)
        text = self.complaint("delaunay", path, *arguments, status=status)
        self.assertIn(path, text)
        for pattern in patterns:
            self.assertRegex(text, pattern)

    def test_not_finite(self):
        for value in ("nan", "inf", "-inf", "NaN", "Infinity"):
            self.refused("a.csv", f"0,0\n1,0\n0,{value}\n", r":3: ")
        for value in (np.nan, np.inf):
            points = np.zeros((5, 2))
            points[3, 1] = value
            self.refused("a.npy", points, r"row 3")

    def test_overflow_is_not_silently_infinite(self):
        self.refused("a.csv", "0,0\n1,0\n0,1e999\n", r":3: ")

    def test_ragged_rows(self):
        self.refused("a.csv", "0,0\n1,0\n0,1,2\n", r":3: ")
        self.refused("a.txt", "0 0\n1\n", r":2: ")

    def test_text_in_numbers(self):
        self.refused("a.csv", "x,y\n0,0\n1,zero\n", r":3: ", "zero")
        self.refused("a.txt", "0 0\n1 0x\n", r":2: ")

    def test_columns(self):
        self.refused("a.csv", "x,y,z\n0,0,0\n1,1,1\n", "height", arguments=["--columns", "x,height"])
        self.refused("a.csv", "0,0,0\n1,1,1\n", "7", arguments=["--columns", "0,7"])

    def test_truncated_npy(self):
        whole = self.file("whole.npy", np.ones((10, 3)))
        with open(whole, "rb") as f:
            content = f.read()
        for length in (0, 5, 20, 127, len(content) - 1):
            self.refused("cut.npy", content[:length])

    def test_npy_of_other_things(self):
        self.refused("a.npy", np.array([["a", "b"]]))
        self.refused("a.npy", np.ones((2, 2), dtype=complex))
        self.refused("a.npy", np.ones((2, 2, 2)))
        self.refused("a.npy", np.array([[2**53 + 1, 0]], dtype=np.int64))
        self.refused("a.npy", b"not an array at all")

    def test_empty_file(self):
        self.refused("a.csv", "")
        self.refused("a.txt", "\n# nothing\n")
        self.refused("a.off", "")
        self.refused("a.ply", "")

    def test_huge_counts_are_refused_at_once(self):
        start = time.monotonic()
        self.refused("a.off", "OFF\n999999999999 0 0\n0 0 0\n")
        self.refused("b.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999999\nproperty float x\nproperty float y\n"
                     "property float z\nend_header\n0 0 0\n")
        self.complaint("delaunay", "-", stdin="3\n1000000000000000\n0 0 0\n")
        self.complaint("delaunay", "-", stdin="1000000000\n1000000000\n0 0 0\n")
        header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000000, 4000000), }"
        header += b" " * (117 - len(header)) + b"\n"
        self.refused("c.npy", b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + b"\0" * 64)
        self.assertLess(time.monotonic() - start, 10)

    def test_dimension_zero(self):
        self.complaint("delaunay", "-", stdin="0\n5\n\n\n\n\n\n")
        self.refused("a.npy", np.ones((5, 0)))
        self.complaint("delaunay", "-", stdin="-2\n1\n0 0\n")

    def test_missing_and_unreadable(self):
        text = self.complaint("delaunay", self.path("missing.csv"))
        self.assertIn("missing.csv", text)
        self.assertRegex(text, "No such file")
        self.complaint("delaunay", self.folder.name, "--format", "csv")
        self.refused("points.unknown", "0 0\n", "unknown")
        self.refused("points", "0 0\n")

    def test_file_names_cannot_break_the_line(self):
        self.complaint("delaunay", self.path("two\nlines.csv"))


if __name__ == "__main__":
    unittest.main()
