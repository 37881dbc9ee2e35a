# SPDX-License-Identifier: BSD-3-Clause
"""Points in every format; what is refused gives one line that says where."""
import gzip
import json
import os
import shutil
import struct
import subprocess
import tempfile
import time
import unittest

from cli_support import DELONE, Case, np


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

    def test_ranges_of_columns(self):
        text = "id,a,b,c,2-3\n" + "".join(f"{i},{i * i % 7},{i % 3},{i * i * i % 11},{-i}\n" for i in range(20))
        files = {"h.csv": text, "n.csv": text.split("\n", 1)[1], "t.txt": text.split("\n", 1)[1].replace(",", " ")}
        expected = self.stats(self.file("e.csv", text), "--columns", "a,b,c")["hash"]
        for name, content in files.items():
            path = self.file(name, content)
            for columns in ("1-3", "1,2-3", "1-1,2,3-3") if name != "h.csv" else ("1-3", "a,2,3", "a-b,c", "a,2-2,c"):
                if columns == "a-b,c":
                    self.assertIn(f"{path}: --columns: there is no column 'a-b'; the columns are id, a, b, c, 2-3",
                                  self.complaint("delaunay", path, "--columns", columns))
                else:
                    self.assertEqual(self.stats(path, "--columns", columns)["hash"], expected, (name, columns))
        named = self.path("h.csv")  # a name comes before a range
        self.assertEqual(self.stats(named, "--columns", "2-3")["dimension"], 1)
        self.assertEqual(self.stats(self.path("n.csv"), "--columns", "2-3")["dimension"], 2)
        for columns, said in (("3-1", "the range '3-1' runs backwards"), ("2-9", "the range '2-9' ends beyond column 4"),
                              ("1-", "there is no column '1-'"), ("0-18446744073709551615", "the range '0-18446744073709551615' ends beyond column 4")):
            self.assertIn("n.csv: --columns: " + said, self.complaint("delaunay", self.path("n.csv"), "--columns", columns))
        self.assertIn("n.csv: --query-columns: there is no column '9'",
                      self.complaint("locate", self.path("n.csv"), "--columns", "0,1", "--queries", self.path("n.csv"), "--query-columns", "9,0"))

    def test_atoms_and_scans(self):
        numbers = np.random.default_rng(5).integers(-100_000, 100_000, (40, 3)).astype("<i4")
        points = numbers * 0.001 + [100.0, -200.0, 0.5]
        expected = self.stats(self.file("a.npy", points))["hash"]
        atoms = "".join("C%d %r %r %r 0.5\n" % (i, *map(float, p)) for i, p in enumerate(points))
        self.assertEqual(self.stats(self.file("a.xyz", f"40\nfrom a program\n{atoms}"))["hash"], expected)
        header = bytearray(227)
        header[:4], header[24:26], header[94:100] = b"LASF", b"\1\2", struct.pack("<HI", 227, 227)
        header[105:111], header[131:179] = struct.pack("<HI", 20, 40), struct.pack("<6d", 0.001, 0.001, 0.001, 100, -200, 0.5)
        scan = self.file("a.las", bytes(header) + b"".join(row.tobytes() + bytes(8) for row in numbers))
        self.assertEqual(self.stats(scan)["hash"], expected)
        lines = "".join("%-6s%5d  CA  ALA A%4d    %8.3f%8.3f%8.3f  1.00  0.00\n" % ("HETATM" if i % 3 else "ATOM", i, i, *p) for i, p in enumerate(points))
        self.assertEqual(self.stats(self.file("a.pdb", "HEADER\n" + lines + "END\n"))["hash"],
                         self.stats(self.file("rounded.npy", np.round(points, 3)))["hash"])
        for path in (self.path("a.xyz"), scan):  # read in pieces, and at once
            self.run_delone("delaunay", path, "-q", "-o", self.path("tiles/"), "--tiles", "2")
            self.assertIn(expected, self.output("info", self.path("tiles")))
            shutil.rmtree(self.path("tiles"))

    def test_saved_output_of_rbox(self):
        rows = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        for name, text in (("a.txt", "3 rbox 4 D3\n4\n" + rows), ("b.txt", "3\n4\n" + rows), ("c.xyz", "# saved\n3 rbox 4 D3\n4\n" + rows),
                           ("d.txt", "3 rbox 4 D3\r\n4\r\n" + rows)):
            stats = self.stats(self.file(name, text))
            self.assertEqual((stats["dimension"], stats["points"]), (3, 4), name)
        for text, dimension, points in (("1\n3\n0.5\n0.7\n", 1, 4), ("2 3\n4 5\n6 7\n", 2, 3), ("2 1\n3 2\n", 2, 2), ("3\n4\n", 1, 2)):
            stats = self.stats(self.file("t.txt", text))  # rows that may look like it
            self.assertEqual((stats["dimension"], stats["points"]), (dimension, points), text)
        self.assertIn("expected 5 points", self.complaint("delaunay", self.file("e.txt", "3 rbox 5 D3\n5\n" + rows)))
        self.assertIn("rbox's output: --format qhull", self.complaint("delaunay", self.file("f.csv", "3 rbox 4 D3\n4\n" + rows)))

    def test_unlucky_input_is_a_result(self):
        for content, affine, vertices, cells in (("1 2\n", 0, 1, 1), ("1 2\n1 2\n", 0, 1, 1), ("0 0\n1 1\n3 3\n", 1, 3, 2),
                                                 ("0 0\n1 0\n0 1\n0 0\n-0 1\n", 2, 3, 1)):
            stats = self.stats(self.file("a.txt", content))
            self.assertEqual((stats["affine_dimension"], stats["vertices"], stats["cells"]), (affine, vertices, cells), content)
            self.assertEqual(stats["duplicates"], stats["points"] - vertices)

    def test_no_points_at_all(self):
        stats = self.stats("-", stdin="3\n0\n")
        self.assertEqual((stats["points"], stats["affine_dimension"], stats["cells"]), (0, -1, 0))


def has_zlib():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.txt.gz")
        with gzip.open(path, "wb") as f:
            f.write(b"0 0\n")
        return b"no zlib" not in subprocess.run([DELONE, "info", path], capture_output=True, timeout=60).stderr


@unittest.skipUnless(has_zlib(), "built without zlib")
class Compressed(Case):
    def test_the_same_in_every_format(self):
        points = np.random.default_rng(3).random((3000, 3))
        plain = self.file("p.npy", points)
        hashes = {self.stats(plain)["hash"]}
        for name in ("c.csv", "t.txt", "o.off", "q.qhull"):
            np.savetxt(self.path("rows"), points, fmt="%.17g", delimiter="," if name == "c.csv" else " ")
            with open(self.path("rows"), "rb") as f:
                rows = f.read()
            head = {"o.off": b"OFF\n3000 0 0\n", "q.qhull": b"3\n3000\n"}.get(name, b"")
            hashes.add(self.stats(self.file(name + ".gz", gzip.compress(head + rows)))["hash"])
        hashes.add(self.stats("-", stdin=gzip.compress(b"3\n3000\n" + rows))["hash"])
        with open(plain, "rb") as f:
            content = f.read()
        hashes.add(self.stats(self.file("p.npy.gz", gzip.compress(content)))["hash"])
        hashes.add(self.stats(self.file("p.NPY.GZ", gzip.compress(content)))["hash"])
        hashes.add(self.stats(self.file("hidden.npy", gzip.compress(content)))["hash"])  # without the name
        members = b"".join(gzip.compress(content[i:i + 7001]) for i in range(0, len(content), 7001)) + gzip.compress(b"") + b"\0" * 512
        hashes.add(self.stats(self.file("members.npy.gz", members))["hash"])
        self.assertEqual(len(hashes), 1)

    def test_results_and_tiles(self):
        points = self.uniform(2, 500)
        for name in ("t.npz", "t.json", "h.off"):
            self.output("delaunay", points, "-o", self.path(name))
            with open(self.path(name), "rb") as f:
                self.file(name + ".gz", gzip.compress(f.read()))
            self.assertIn("exactly", self.output("check", self.path(name + ".gz")))
            self.assertIn("a Delaunay triangulation", self.output("info", self.path(name + ".gz")))
        with open(points, "rb") as f:
            self.file("p.npy.gz", gzip.compress(f.read()))
        self.run_delone("delaunay", self.path("p.npy.gz"), "-q", "-o", self.path("tiles/"), "--tiles", "2")
        self.assertIn(self.stats(points)["hash"], self.output("info", self.path("tiles")))

    def test_damage(self):
        content = gzip.compress(b"3\n4000\n" + b"".join(b"%d %d %d\n" % (i, i * i % 97, i * i * i % 89) for i in range(4000)))
        for name, damaged in (("cut", content[:-1]), ("header", content[:5]), ("half", content[:len(content) // 2]), ("nothing", content[:2]),
                              ("crc", content[:-8] + bytes([content[-8] ^ 1]) + content[-7:]), ("length", content[:-1] + b"\1"),
                              ("middle", content[:500] + bytes([content[500] ^ 0xff]) + content[501:]), ("after", content + b"text"),
                              ("between", content + b"\0" + content), ("method", content[:2] + b"\7" + content[3:])):
            path = self.file(name + ".qhull.gz", damaged)
            text = self.complaint("delaunay", path)
            self.assertIn(f"{path}: the compressed file ", text)
        self.assertIn("not compressed by gzip, which its name says", self.complaint("delaunay", self.file("plain.csv.gz", "0,0\n1,1\n")))
        self.assertIn("the file is empty", self.complaint("delaunay", self.file("empty.csv.gz", b"")))
        self.assertIn("the file is empty", self.complaint("delaunay", self.file("nothing.csv.gz", gzip.compress(b""))))
        self.assertIn(":2: ", self.complaint("delaunay", self.file("bad.csv.gz", gzip.compress(b"0,0\n0,x\n"))))
        text = self.complaint("generate", "uniform", "-d", "2", "-n", "5", "-o", self.path("out.csv.gz"))
        self.assertIn("files are not written compressed; write ", text)

    def test_limits_are_of_what_is_decompressed(self):
        path = self.file("bomb.txt.gz", gzip.compress(b"0 0\n" * 2_000_000))  # 8 MB of 8 kB
        text = self.complaint("info", path, "--max-stream", "1MB", status=3)
        self.assertIn("more than 1000000 bytes when decompressed; raise --max-stream", text)
        self.complaint("info", path, "--max-stream", "7999999", status=3)
        self.output("info", path, "--max-stream", "8000000")
        self.assertIn("zero", self.complaint("info", self.file("zeros.txt.gz", gzip.compress(b"\0" * 100_000_000)), "--max-stream", "200MB"))


class MissingValues(Case):
    def skipping(self, command, path, *arguments):
        done = self.run_delone(command, path, "--skip-missing", *arguments)
        return done.stdout.decode(), done.stderr.decode()

    def test_rows_are_left_out_and_told(self):
        rows = ["0,0", "4,NA", "4,0", ",3", "5,-", "6,null", "1,3", "7,n/a", "2,1"]
        gaps = self.file("gaps.csv", "x,y\n" + "\n".join(rows) + "\n")
        whole = self.file("whole.csv", "x,y\n0,0\n4,0\n1,3\n2,1\n")
        text, said = self.skipping("delaunay", gaps, "--stats", "-q")
        self.assertEqual(said, f"delone: {gaps}: 5 rows with missing values left out: 1, 3 to 5, 7\n")
        found = json.loads(text)
        self.assertEqual((found["points"], found["hash"]), (4, self.stats(whole)["hash"]))
        self.assertEqual(self.skipping("delaunay", whole, "--stats")[1], f"delone: {whole}: 0 rows with missing values left out\n")
        self.assertRegex(self.skipping("info", gaps)[0], r"points +4\n")
        for command, *more in (["hull"], ["voronoi"], ["forecast"], ["alpha", "--radius", "9"], ["view", "-o", self.path("a.html")],
                               ["locate", "--queries", gaps], ["interpolate", "--values", "y", "--queries", self.file("q.csv", "x\n1\nNA\n2\n")]):
            self.assertIn("5 rows with missing values left out", self.skipping(command, gaps, *more)[1], command)
            self.complaint(command, gaps, *more)

    def test_weights_and_values_of_their_own(self):
        points = self.file("p.csv", "0,0\n4,NA\n4,0\n0,4\n4,4\n2,1\n")
        weights = self.file("w.txt", "0\n1\n0\nNA\n0.5\n1\n")
        expected = self.file("e.csv", "0,0,0\n4,0,0\n4,4,0.5\n2,1,1\n")
        text, said = self.skipping("regular", points, "--weights", weights, "--stats")
        self.assertEqual(json.loads(text)["hash"], json.loads(self.output("regular", expected, "--weights", "2", "--stats"))["hash"])
        self.assertEqual(said.splitlines(), [f"delone: {points}: 1 row with missing values left out: 1",
                                             f"delone: {weights}: 1 row with missing values left out: 3"])
        complete = self.file("complete.txt", "0\n" * 6)
        self.assertEqual(self.skipping("regular", points, "--weights", complete, "--stats")[1],
                         f"delone: {points}: 1 row with missing values left out: 1\n")
        queries = self.file("q.csv", "3,1\n2.5,2\n")
        text, _ = self.skipping("interpolate", points, "--values", weights, "--queries", queries)
        self.assertEqual(text, self.output("interpolate", expected, "--columns", "0,1", "--values", "2", "--queries", queries).replace("2\n", "value\n", 1))
        self.assertIn("expected 6 weights, one per point, found 5",
                      self.run_delone("regular", points, "--skip-missing", "--weights", self.file("s.txt", "1\n1\nNA\n1\n1\n"), status=2).stderr.decode())

    def test_refusals_name_the_option(self):
        for text in ("0,0\n1,\n2,1\n", "0,0\n1,NA\n", "0,0\n1,nan\n"):
            self.assertIn("; --skip-missing leaves out rows with missing values", self.complaint("delaunay", self.file("a.csv", text)))
        text = self.complaint("delaunay", self.path("a.csv"), "--skip-missing", "-o", self.path("tiles/"), status=64)
        self.assertIn("--skip-missing does not go together with tiles", text)
        result = self.path("r.npz")
        self.output("delaunay", self.file("b.csv", "0,0\n1,0\n0,1\n"), "-q", "-o", result)
        self.assertIn("--skip-missing is for points", self.complaint("view", result, "--skip-missing", "-o", self.path("a.html"), status=64))


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

    def test_hints(self):
        for name, text, *said in (
                ("a.csv", "x;y\n0;0\n1;2\n", "separated by ';', which no format is: put ',' in its place"),
                ("a.csv", "x;y\n0,5;0,25\n1,5;2,5\n", "separated by ';', and has decimal commas"),
                ("a.csv", "x y\n0 0\n1 2\n", "white space: --format txt"), ("a.csv", "0\t1\n1\t2\n", "tabs: --format tsv"),
                ("a.tsv", "x,y\n0,0\n1,2\n", "separated by ',': --format csv"), ("a.txt", "0,0\n1,2\n", "separated by ',': --format csv"),
                ("a.txt", "x y\n0 0\n1 2\n", "the first line looks like a header: put '#' before it"),
                ("a.txt", "2\nwater\nO 0 0 0\nH 1 0 0\n", "the chemists' xyz format: --format xyz"),
                ("a.laz", "LASF", "a.laz: LAZ is not read: decompress it with laszip"),
                ("a.txt", b"\x93NUMPY\x01\x00" + b"\0" * 100, "looks like an .npy file: --format npy"),
                ("a.csv", b"\x89PNG\r\n\x1a\n" + b"\0" * 10, "looks like a picture"), ("a.txt", b"\1\2\0\3", "a binary file"),
                ("a.csv", b"PK\x03\x04" + b"\0" * 200000, "looks like a zip archive"), ("a.npy", "OFF\n3 0 0\n", "an .off file: --format off"),
                ("a.asc", "0 0\n", "'asc' cannot be used for reading points; available: npy, csv, .*; name it with --format"),
                ("points", "0 0\n", "no extension tells the format")):
            self.refused(name, text, *said)
        for name, text in (("a.csv", "0,0\n1,zero\n"), ("a.csv", "x,y\n1,2\n3,four\n"), ("a.txt", "0 0\n0 1\n1 x\n"), ("a.csv", "a\nb\n")):
            self.assertNotIn("looks like", self.complaint("delaunay", self.file(name, text)), text)  # right, but for one field
        self.assertIn("--query-format csv", self.complaint("locate", self.file("p.csv", "0,0\n1,0\n0,1\n"), "--queries", self.file("q.txt", "0,0\n")))
        self.assertIn("separated by ',': --format csv", self.complaint("delaunay", "-", stdin="0,0\n1,0\n"))
        self.assertIn("this is a folder", self.complaint("delaunay", self.folder.name))

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
