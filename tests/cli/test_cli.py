#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The command `delone`, run as a user runs it: exit statuses, messages, files, signals.

Usage: test_cli.py /path/to/delone [unittest arguments]
"""
import glob
import itertools
import json
import os
import pty
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree
import zipfile

try:
    import numpy as np
except ImportError:
    print("skipped: this Python has no NumPy", file=sys.stderr)
    sys.exit(77)

DELONE = "delone"
STATS = {"command": str, "dimension": int, "affine_dimension": int, "points": int, "vertices": int, "duplicates": int,
         "hidden": int, "cells": int, "infinite_cells": int, "hash": str, "seconds": dict, "peak_rss_bytes": int,
         "bytes_per_cell": float, "created_cells": int, "stages": dict, "threads": int, "seed": int, "version": str}
CUBE = np.array(list(itertools.product([0.0, 1.0], repeat=3)))


class Case(unittest.TestCase):
    """A test in a fresh folder."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def file(self, name, content):
        path = self.path(name)
        if isinstance(content, np.ndarray):
            np.save(path, content)
        else:
            with open(path, "wb") as f:
                f.write(content if isinstance(content, bytes) else content.encode())
        return path

    def run_delone(self, *arguments, status=0, stdin=b"", **options):
        if isinstance(stdin, str):
            stdin = stdin.encode()
        done = subprocess.run([DELONE, *map(str, arguments)], input=stdin, capture_output=True, timeout=120, **options)
        self.assertEqual(done.returncode, status, (arguments, done.stdout[-500:], done.stderr[-500:]))
        return done

    def output(self, *arguments, **options):
        done = self.run_delone(*arguments, **options)
        self.assertEqual(done.stderr, b"")
        return done.stdout.decode()

    def complaint(self, *arguments, status=2, **options):
        """The one line on standard error; nothing may be on standard output."""
        done = self.run_delone(*arguments, status=status, **options)
        self.assertEqual(done.stdout, b"")
        text = done.stderr.decode()
        self.assertRegex(text, r"\Adelone: [^\n]+\n\Z")
        return text

    def stats(self, *arguments, **options):
        return json.loads(self.output("delaunay", *arguments, "--stats", **options))

    def uniform(self, d, n, seed=1):
        path = self.path(f"uniform{d}_{n}_{seed}.npy")
        self.output("generate", "uniform", "-d", d, "-n", n, "--seed", seed, "-o", path)
        return path


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


class BadOutput(Case):
    def test_unwritable(self):
        points = self.uniform(2, 10)
        for path in (self.path("no/such/folder.npz"), "/proc/delone.npz"):
            self.assertIn(path, self.complaint("delaunay", points, "-o", path))
        os.mkdir(self.path("folder.npz"))
        self.complaint("delaunay", points, "-o", self.path("folder.npz"))
        self.complaint("generate", "uniform", "-d", 2, "-n", 5, "-o", self.path("no/such.npy"))
        self.complaint("locate", points, "--queries", points, "-o", self.path("no/such.csv"))

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_disk_full(self):
        points = self.uniform(2, 1000)
        for output_format in ("npz", "off", "json", "svg", "vtu", "txt", "npy"):
            text = self.complaint("delaunay", points, "-o", "/dev/full", "--output-format", output_format)
            self.assertRegex(text, "/dev/full: No space left")
        self.complaint("generate", "uniform", "-d", 2, "-n", 5000, "-o", "/dev/full", "--output-format", "csv")
        self.complaint("locate", points, "--queries", points, "-o", "/dev/full")
        with open("/dev/full", "wb") as full:
            for arguments in (["delaunay", points], ["delaunay", points, "--stats"], ["--version"], ["info", points],
                              ["generate", "uniform", "-d", "2", "-n", "5"]):
                done = subprocess.run([DELONE, *arguments], stdout=full, stderr=subprocess.PIPE, timeout=60)
                self.assertEqual(done.returncode, 2, arguments)
                self.assertRegex(done.stderr.decode(), r"\Adelone: standard output: No space left[^\n]*\n\Z")

    def test_a_failed_write_keeps_the_old_file_and_leaves_nothing_else(self):
        points = self.uniform(3, 3000)
        out = self.file("out.npz", "old")
        command = f'ulimit -f 8; exec "{DELONE}" delaunay "{points}" -o "{out}"'
        done = subprocess.run(["sh", "-c", command], capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 2, done.stderr)
        with open(out) as f:
            self.assertEqual(f.read(), "old")
        self.assertEqual(sorted(os.listdir(self.folder.name)), sorted([os.path.basename(points), "out.npz"]))

    def test_format_and_dimension_are_checked_before_the_work(self):
        points = self.uniform(6, 20000)
        start = time.monotonic()
        self.complaint("delaunay", points, "-o", self.path("a.svg"))
        self.complaint("delaunay", points, "-o", self.path("a.vtu"))
        self.complaint("delaunay", points, "-o", self.path("a.unknown"))
        self.complaint("delaunay", points, "-o", self.path("a"))
        self.assertLess(time.monotonic() - start, 5)


class Usage(Case):
    def test_bad_options(self):
        points = self.uniform(2, 5)
        for arguments in ([], ["triangulate"], ["delaunay"], ["delaunay", points, "--no-such-option"],
                          ["delaunay", points, "--threads", "0"], ["delaunay", points, "--threads", "two"],
                          ["delaunay", points, "--seed", "-1"], ["delaunay", points, "--order", "sorted"],
                          ["delaunay", points, "--format", "bmp"], ["delaunay", points, "--output-format", "bmp"],
                          ["delaunay", points, "--stats", "-o", "-", "--output-format", "txt"], ["delaunay", points, points],
                          ["check", points, "--level", "7"], ["check"], ["locate", points],
                          ["generate", "uniform", "-n", "5"], ["generate", "unheard_of", "-d", "2", "-n", "5"],
                          ["generate", "uniform", "-d", "0", "-n", "5"], ["generate", "uniform", "-d", "2", "-n", "-5"],
                          ["generate", "uniform", "-d", "2", "-n", "1.5"], ["generate", "uniform", "-d", "2", "-n", "five"],
                          ["generate", "flat", "-d", "1", "-n", "5"], ["locate", "-", "--queries", "-"]):
            self.complaint(*arguments, status=64)

    def test_help_and_version(self):
        self.assertRegex(self.output("--version"), r"\Adelone \d+\.\d+\.\d+\n\Z")
        for command in ("delaunay", "locate", "check", "generate", "info"):
            self.assertIn(command, self.output("--help"))
            self.assertIn(f"delone {command}", self.output(command, "--help"))
        for kind in ("uniform", "cospherical", "mixed_scales"):
            self.assertIn(kind, self.output("generate", "--help"))


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


class Voronoi(Case):
    def test_npz_and_json_have_the_same_lists(self):
        for kind, d, n in (("uniform", 2, 40), ("grid", 3, 27), ("uniform", 4, 30), ("flat", 3, 20), ("collinear", 2, 5),
                           ("equal", 2, 3)):
            points = self.path("points.npy")
            self.output("generate", kind, "-d", d, "-n", n, "-o", points)
            self.output("voronoi", points, "-o", self.path("out.npz"))
            self.output("voronoi", points, "-o", self.path("out.json"))
            with open(self.path("out.json")) as f:
                data = json.load(f)
            with np.load(self.path("out.npz")) as arrays:
                for name in ("vertices", "ridge_points", "point_region", "ray_vertices", "ray_directions", "points"):
                    np.testing.assert_array_equal(np.array(data[name]).ravel(), arrays[name].ravel(), name)
                for json_name, name in (("ridge_vertices", "ridge"), ("regions", "region")):
                    offsets = arrays[name + "_offsets"]
                    self.assertEqual(data[json_name], [arrays[name + "_vertices"][a:b].tolist()
                                                       for a, b in zip(offsets, offsets[1:])])
                sites = arrays["points"]
                for vertices, (a, b) in zip(data["ridge_vertices"], data["ridge_points"]):
                    for v in vertices:
                        if v >= 0:
                            self.assertAlmostEqual(np.linalg.norm(arrays["vertices"][v] - sites[a]),
                                                   np.linalg.norm(arrays["vertices"][v] - sites[b]))

    def test_pictures_volumes_and_stats(self):
        points = self.path("points.npy")
        np.save(points, CUBE)
        self.output("voronoi", points, "-o", self.path("out.vtu"), "--box", "-1,-1,-1,2,2,2")
        with open(self.path("out.vtu"), "rb") as f:
            head = f.read().split(b"<AppendedData")[0] + b"</VTKFile>"
        piece = xml.etree.ElementTree.fromstring(head).find(".//Piece")
        self.assertEqual((piece.get("NumberOfPoints"), piece.get("NumberOfCells")), ("64", "8"))
        self.assertIn("8 of them unbounded", self.output("voronoi", points))
        rows = self.output("voronoi", points, "--volumes", "-", "--box", "-1,-1,-1,2,2,2").split()
        self.assertEqual((rows[0], len(rows)), ("point,volume", 9))
        for row in rows[1:]:
            self.assertAlmostEqual(float(row.split(",")[1]), 27 / 8)
        stats = json.loads(self.output("voronoi", points, "--stats"))
        self.assertEqual((stats["command"], stats["voronoi_vertices"], stats["regions"], stats["unbounded_regions"],
                          stats["ridges"], stats["rays"]), ("voronoi", 1, 8, 8, 12, 6))
        self.assertEqual(set(STATS) - set(stats), set())
        np.save(points, CUBE[:, :2])
        self.output("voronoi", points, "-o", self.path("out.svg"))
        self.assertTrue(xml.etree.ElementTree.parse(self.path("out.svg")).getroot().tag.endswith("svg"))

    def test_refusals(self):
        points = self.uniform(3, 20)
        self.complaint("voronoi", points, "--box", "0,0,1,1", status=64)
        self.complaint("voronoi", points, "--box", "0,0,0,1,1,0", status=64)
        self.complaint("voronoi", points, "--stats", "-o", "-", "--output-format", "json", status=64)
        text = self.complaint("voronoi", points, "-o", self.path("out.svg"))
        self.assertIn(self.path("out.svg"), text)
        self.assertNotIn("/dev/null", text)
        self.complaint("voronoi", points, "-o", self.path("no/such.npz"))


class Delaunay(Case):
    def test_stats(self):
        points = self.uniform(4, 500)
        stats = self.stats(points, "--seed", 5)
        self.assertEqual(list(stats), list(STATS))
        for name, kind in STATS.items():
            self.assertIs(type(stats[name]), kind, name)
        self.assertEqual(list(stats["seconds"]), ["read", "order", "build", "write", "total"])
        self.assertTrue(all(type(v) is float and v >= 0 for v in stats["seconds"].values()))
        self.assertEqual(list(stats["stages"]), ["filter", "direct", "exact", "perturbed"])
        self.assertEqual((stats["command"], stats["dimension"], stats["affine_dimension"], stats["points"], stats["vertices"]),
                         ("delaunay", 4, 4, 500, 500))
        self.assertEqual((stats["duplicates"], stats["hidden"], stats["threads"], stats["seed"]), (0, 0, 1, 5))
        self.assertRegex(stats["hash"], r"\A[0-9a-f]{32}\Z")
        self.assertGreater(stats["created_cells"], stats["cells"])
        self.assertGreater(stats["peak_rss_bytes"], 500 * 4 * 8)
        self.assertGreaterEqual(stats["bytes_per_cell"], 2 * 5 * 4)

    def test_stats_with_output(self):
        points, out = self.uniform(3, 200), self.path("out.npz")
        stats = self.stats(points, "-o", out)
        with np.load(out) as data:
            self.assertEqual(len(data["cells"]), stats["cells"])
        self.assertEqual(stats["hash"], self.stats(points)["hash"])

    def test_the_path_does_not_change_the_end(self):
        for kind, d in (("uniform", 3), ("grid", 3), ("duplicates", 2), ("flat", 4), ("uniform", 5)):
            points = self.path("points.npy")
            self.output("generate", kind, "-d", d, "-n", 150, "-o", points)
            hashes = {self.stats(points, *options)["hash"]
                      for options in ([], ["--seed", 9], ["--order", "given"], ["--order", "shuffled"], ["--runtime-dimension"])}
            self.assertEqual(len(hashes), 1, kind)

    def test_summary_is_for_reading(self):
        points = self.uniform(2, 100)
        text = self.output("delaunay", points)
        self.assertIn("100 points in dimension 2", text)
        self.assertEqual(self.output("delaunay", points, "-o", self.path("out.npz")), "")

    def test_threads_note(self):
        points = self.uniform(2, 10)
        self.assertRegex(self.run_delone("delaunay", points, "--threads", 2).stderr.decode(), r"\Adelone: note: [^\n]*\n\Z")
        self.assertEqual(self.run_delone("delaunay", points, "--threads", 2, "--quiet").stderr, b"")

    def test_npz(self):
        for kind, d, n in (("uniform", 2, 100), ("uniform", 3, 200), ("uniform", 5, 60), ("grid", 3, 64), ("duplicates", 2, 100),
                           ("flat", 3, 50), ("collinear", 3, 20), ("equal", 2, 5)):
            points, out = self.path("points.npy"), self.path("out.npz")
            self.output("generate", kind, "-d", d, "-n", n, "-o", points)
            self.output("delaunay", points, "-o", out)
            with np.load(out) as data:
                arrays = {name: data[name] for name in data.files}
            self.assertEqual(sorted(arrays), ["affine_dimension", "cells", "neighbors", "points", "vertex_of_point"])
            k = int(arrays["affine_dimension"])
            self.assertEqual(arrays["affine_dimension"].shape, ())
            self.assertEqual(arrays["points"].dtype, np.float64)
            np.testing.assert_array_equal(arrays["points"], np.load(points))
            cells, neighbors, vertex_of_point = arrays["cells"], arrays["neighbors"], arrays["vertex_of_point"]
            for array in (cells, neighbors, vertex_of_point, arrays["affine_dimension"]):
                self.assertEqual(array.dtype.kind, "i")
                self.assertIn(array.dtype.itemsize, (4, 8))
            self.assertEqual(cells.shape, neighbors.shape)
            self.assertEqual(cells.shape[1], k + 1)
            self.assertEqual(vertex_of_point.shape, (n,))
            np.testing.assert_array_equal(arrays["points"][vertex_of_point], arrays["points"])
            self.assertEqual(set(np.unique(cells)), set(np.unique(vertex_of_point)))
            for c, (vertices, row) in enumerate(zip(cells, neighbors)):
                for i, neighbor in enumerate(row):
                    if neighbor < 0:
                        self.assertEqual(neighbor, -1)
                        continue
                    facet = set(vertices) - {vertices[i]}
                    self.assertTrue(facet < set(cells[neighbor]) and vertices[i] not in cells[neighbor])
                    mirror = [j for j in range(k + 1) if cells[neighbor][j] not in facet]
                    self.assertEqual(neighbors[neighbor][mirror[0]], c)
            if k == d == 2:
                a, b, c = (arrays["points"][cells[:, i]] for i in range(3))
                self.assertTrue((np.linalg.det(np.stack([b - a, c - a], axis=1)) > 0).all())

    def test_every_format(self):
        points = self.path("points.npy")
        np.save(points, CUBE[:, :2][::2] + np.array([[0, 0], [0.5, 0], [0, 0.25], [0, 0]]))
        cells = 2

        self.output("delaunay", points, "-o", self.path("out.json"))
        with open(self.path("out.json")) as f:
            data = json.load(f)
        self.assertEqual((len(data["points"]), len(data["cells"]), len(data["neighbors"]), data["affine_dimension"]), (4, cells, cells, 2))
        self.assertEqual(data["vertex_of_point"], [0, 1, 2, 3])

        self.output("delaunay", points, "-o", self.path("out.txt"))
        with open(self.path("out.txt")) as f:
            lines = f.read().split("\n")
        self.assertEqual(int(lines[0]), cells)
        self.assertEqual([len(line.split()) for line in lines[1:]], [3] * cells + [0])

        self.output("delaunay", points, "-o", self.path("out.npy"))
        self.assertEqual(np.load(self.path("out.npy")).shape, (cells, 3))

        self.output("delaunay", points, "-o", self.path("out.off"))
        with open(self.path("out.off")) as f:
            self.assertIn("OFF", f.readline())

        self.output("delaunay", points, "-o", self.path("out.svg"))
        self.assertTrue(xml.etree.ElementTree.parse(self.path("out.svg")).getroot().tag.endswith("svg"))

        self.output("delaunay", points, "-o", self.path("out.vtu"))
        with open(self.path("out.vtu"), "rb") as f:  # the arrays follow in binary, which is VTK's way and not XML's
            head = f.read().split(b"<AppendedData")[0] + b"</VTKFile>"
        piece = xml.etree.ElementTree.fromstring(head).find(".//Piece")
        self.assertEqual((piece.get("NumberOfPoints"), piece.get("NumberOfCells")), ("4", str(cells)))

        self.output("delaunay", points, "-o", self.path("other"), "--output-format", "npz")
        self.assertTrue(zipfile.is_zipfile(self.path("other")))
        text = self.output("delaunay", points, "-o", "-", "--output-format", "txt")
        self.assertEqual(text.split("\n"), lines)

    def test_what_is_written_can_be_checked(self):
        for kind, d in (("uniform", 3), ("grid", 3), ("cospherical", 4), ("flat", 3), ("duplicates", 2)):
            points = self.path("points.npy")
            self.output("generate", kind, "-d", d, "-n", 60, "-o", points)
            for name in ("out.npz", "out.json", "out.off"):
                self.output("delaunay", points, "-o", self.path(name))
                self.assertIn("level 6", self.output("check", self.path(name), "--canonical"))


    def on_terminal(self, *arguments):
        """What goes to standard error when that is a terminal."""
        main, terminal = pty.openpty()
        process = subprocess.Popen([DELONE, *arguments], stdout=subprocess.PIPE, stderr=terminal)
        os.close(terminal)
        text = b""
        try:
            while chunk := os.read(main, 4096):
                text += chunk
        except OSError:  # the other end was closed
            pass
        os.close(main)
        out = process.communicate(timeout=60)[0]
        self.assertEqual(process.returncode, 0)
        return text.decode(), out.decode()

    def test_progress_bar(self):
        points = self.uniform(5, 4000)
        drawn, out = self.on_terminal("delaunay", points, "--stats")
        self.assertRegex(drawn, r"\r\[=* *\] +\d+ %")
        self.assertRegex(drawn, r"\r\x1b\[K\Z")
        json.loads(out)
        self.assertEqual(self.on_terminal("delaunay", points, "--stats", "--quiet")[0], "")


class Hull(Case):
    def hull_stats(self, *arguments):
        return json.loads(self.output("hull", *arguments, "--stats"))

    def test_stats(self):
        grid = np.array(list(itertools.product([0.0, 1.0, 2.0], repeat=3)))
        stats = self.hull_stats(self.file("grid.npy", np.vstack([grid, grid[:2]])))
        for name, kind in STATS.items():
            self.assertIsInstance(stats[name], kind, name)
        self.assertEqual([stats[name] for name in ("command", "points", "vertices", "duplicates", "hidden", "boundary_points",
                                                   "interior_points", "facets", "ridges")],
                         ["hull", 29, 8, 2, 19, 18, 1, 6, 12])
        self.assertLessEqual(abs(stats["volume"] - 8), stats["volume_error"])
        self.assertLessEqual(abs(stats["area"] - 24), stats["area_error"])

    def test_unlucky_input_is_a_result(self):
        for rows, k, vertices in ((np.zeros((0, 2)), -1, 0), (np.ones((3, 2)), 0, 1), (np.arange(8.0).reshape(4, 2), 1, 2)):
            path = self.file("few.npy", rows)
            if len(rows):
                stats = self.hull_stats(path)
                self.assertEqual((stats["affine_dimension"], stats["vertices"]), (k, vertices))
                out = self.path("few.json")
                self.output("hull", path, "-o", out)
                with open(out, encoding="utf-8") as file:
                    self.assertEqual(json.load(file)["affine_dimension"], k)

    def test_npz(self):
        points, out = self.file("cube.npy", np.vstack([CUBE, [[0.5, 0.5, 0.5], [0.5, 0.5, 0]]])), self.path("cube.npz")
        self.output("hull", points, "-o", out)
        hull = np.load(out)
        self.assertEqual(int(hull["affine_dimension"]), 3)
        self.assertEqual(list(hull["vertices"]), list(range(8)))
        self.assertEqual(list(hull["point_kinds"]), [0] * 8 + [2, 1])
        self.assertEqual(hull["equations"].shape, (6, 4))
        self.assertTrue((np.diff(hull["facet_offsets"]) == 4).all())
        self.assertEqual(hull["ridge_facets"].shape, (12, 2))
        distances = hull["points"] @ hull["equations"][:, :3].T + hull["equations"][:, 3]
        self.assertLess(distances.max(), 1e-15)
        for facet in range(6):
            members = hull["facet_vertices"][hull["facet_offsets"][facet]:hull["facet_offsets"][facet + 1]]
            self.assertLess(abs(distances[members, facet]).max(), 1e-15)
        cells, neighbors = hull["cells"], hull["neighbors"]
        corners = hull["points"][cells]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.assertTrue((np.einsum("ij,ij->i", normals, corners[:, 0] - 0.5) > 0).all())  # outwards
        for cell, row in enumerate(neighbors):
            for i, other in enumerate(row):
                self.assertEqual(set(cells[cell]) - {cells[cell][i]}, set(cells[cell]) & set(cells[other]))

    def test_every_format(self):
        square = self.file("square.csv", "0,0\n1,0\n0,1\n1,1\n")
        cube = self.file("cube.npy", CUBE)
        for points, extensions in ((square, ("npz", "json", "off", "vtu", "svg", "txt", "npy")),
                                   (cube, ("npz", "json", "off", "vtu", "txt", "npy"))):
            for extension in extensions:
                out = self.path("out." + extension)
                self.output("hull", points, "-o", out)
                self.assertGreater(os.path.getsize(out), 0)
        with open(self.path("out.off"), encoding="utf-8") as file:
            self.assertEqual(file.readline() + file.readline(), "OFF\n8 12 0\n")
        xml.etree.ElementTree.parse(self.path("out.svg"))
        self.assertIn(".svg", self.complaint("hull", cube, "-o", self.path("cube.svg")))

    def test_lower_and_upper(self):
        phases = self.file("phases.csv", "0,0\n1,0\n0.5,-1\n0.25,-0.4375\n0.75,2\n")
        distances, out = self.path("above.csv"), self.path("lower.npz")
        self.output("hull", phases, "--lower", "--distances", distances, "-o", out)
        with open(distances, encoding="utf-8") as file:
            self.assertEqual(file.read(), "height_above_hull\n0\n0\n0\n0.0625\n2.5\n")
        lower = np.load(out)
        self.assertEqual(sorted(map(tuple, np.sort(lower["cells"]))), [(0, 2), (1, 2)])
        stats = self.hull_stats(phases, "--upper")
        self.assertEqual((stats["side"], stats["cells"], stats["vertices"]), ("upper", 2, 3))
        self.complaint("hull", phases, "--lower", "--upper", status=64)
        self.complaint("hull", phases, "--distances", distances, status=64)
        self.complaint("hull", self.file("one.csv", "1\n2\n"), "--lower")

    def test_the_order_does_not_change_the_end(self):
        points = self.path("grid.npy")
        self.output("generate", "grid", "-d", 4, "-n", 81, "-o", points)
        expected = self.hull_stats(points)["hash"]
        self.assertEqual(self.hull_stats(points, "--order", "shuffled", "--seed", 3)["hash"], expected)
        self.assertEqual(self.hull_stats(points, "--order", "given")["hash"], expected)

    def test_bad_input(self):
        self.assertIn("bad.csv:2", self.complaint("hull", self.file("bad.csv", "0,0\n1,nan\n")))


class Regular(Case):
    def test_equal_weights_give_the_delaunay_triangulation(self):
        for kind, d, n in (("uniform", 3, 60), ("grid", 3, 27), ("flat", 3, 20)):
            points, weights = self.path("points.npy"), self.path("weights.npy")
            self.output("generate", kind, "-d", d, "-n", n, "-o", points)
            np.save(weights, np.full((n, 1), 2.5))
            plain = json.loads(self.output("delaunay", points, "--stats"))
            regular = json.loads(self.output("regular", points, "--weights", weights, "--stats"))
            self.assertEqual(set(STATS) - set(regular), set())
            self.assertEqual((regular["command"], regular["hash"], regular["hidden"]), ("regular", plain["hash"], 0))

    def test_hidden_points_and_duplicates(self):
        balls = self.path("balls.csv")
        with open(balls, "w") as f:
            f.write("x,y,w\n0,0,0\n4,0,0\n0,4,0\n4,4,1\n1,1,-9\n0,0,0\n0,0,-1\n")
        stats = json.loads(self.output("regular", balls, "--weights", "w", "--stats"))
        self.assertEqual((stats["points"], stats["vertices"], stats["duplicates"], stats["hidden"], stats["cells"]), (7, 4, 1, 2, 2))
        self.output("regular", balls, "--weights", "2", "-o", self.path("balls.npz"))
        with np.load(self.path("balls.npz")) as arrays:
            np.testing.assert_array_equal(arrays["weights"].ravel(), [0, 0, 0, 1, -9, 0, -1])
        self.assertIn("regular triangulation", self.output("check", self.path("balls.npz")))

    def test_power_diagram(self):
        balls = self.path("balls.csv")
        with open(balls, "w") as f:
            f.write("x,y,w\n0,0,0\n2,0,1\n")
        rows = self.output("power", balls, "--weights", "w", "--volumes", "-", "--box", "-1,-1,3,1").split()[1:]
        # The border is where x² = (x − 2)² − 1: at x = 3/4.
        self.assertEqual([round(float(row.split(",")[1]), 12) for row in rows], [3.5, 4.5])

    def test_refusals(self):
        points = self.path("points.csv")
        with open(points, "w") as f:
            f.write("x,y,w\n0,0,1\n1,0,nan\n0,1,1\n")
        self.run_delone("regular", points, "--weights", "w", status=2)
        self.run_delone("regular", points, "--weights", "volume", status=2)
        self.run_delone("regular", points, status=64)


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


class Check(Case):
    def setUp(self):
        super().setUp()
        self.output("generate", "uniform", "-d", 3, "-n", 80, "-o", self.path("points.npy"))
        self.output("delaunay", self.path("points.npy"), "-o", self.path("good.npz"))
        with np.load(self.path("good.npz")) as data:
            self.good = {name: data[name] for name in data.files}

    def violation(self, arrays, level, *arguments):
        path = self.path("bad.npz")
        np.savez(path, **arrays)
        done = self.run_delone("check", path, *arguments, status=1)
        text = done.stdout.decode()
        self.assertEqual(done.stderr, b"")
        self.assertRegex(text, rf"level {level}  [a-z ]+ FAILED")
        self.assertRegex(text, r"\nviolation: .+\n")
        self.assertNotIn(f"level {level + 1}", text)

    def test_good(self):
        text = self.output("check", self.path("good.npz"))
        self.assertEqual(re.findall(r"^level (\d)  [a-z ]+ ok ", text, re.M), list("123456"))
        self.assertEqual(re.findall(r"^level (\d)", self.output("check", self.path("good.npz"), "--level", 3), re.M), list("123"))

    def test_without_neighbors_and_under_other_names(self):
        np.savez(self.path("other.npz"), points=self.good["points"], simplices=self.good["cells"].astype(np.int64))
        self.output("check", self.path("other.npz"))

    def test_vertex_out_of_range_or_repeated(self):
        cells = self.good["cells"].copy()
        cells[7, 1] = 5000
        self.violation({**self.good, "cells": cells}, 1)
        cells[7, 1] = cells[7, 0]
        self.violation({**self.good, "cells": cells}, 1)

    def test_wrong_neighbor(self):
        neighbors = self.good["neighbors"].copy()
        neighbors[3] = np.roll(neighbors[3], 1)
        self.violation({**self.good, "neighbors": neighbors}, 2)

    def test_missing_cell(self):
        done = self.path("bad.npz")
        np.savez(done, points=self.good["points"], cells=self.good["cells"][1:])
        self.run_delone("check", done, status=1)

    def test_wrong_diagonal(self):
        points = np.array([[-2.0, 0], [2, 0], [0, 1], [0, -1]])
        self.violation({"points": points, "cells": np.array([[0, 1, 2], [1, 0, 3]])}, 5)
        np.savez(self.path("right.npz"), points=points, cells=np.array([[0, 3, 2], [1, 2, 3]]))
        self.output("check", self.path("right.npz"))

    def test_moved_point(self):
        points = self.good["points"].copy()
        points[self.good["cells"][0, 0]] += 0.3
        path = self.path("bad.npz")
        np.savez(path, **{**self.good, "points": points})
        self.run_delone("check", path, status=1)
        np.save(self.path("moved.npy"), points)
        self.run_delone("check", self.path("good.npz"), "--points", self.path("moved.npy"), status=1)
        self.output("check", path, "--points", self.path("points.npy"))

    def test_cells_of_any_orientation(self):
        self.violation({"points": self.good["points"], "cells": np.sort(self.good["cells"], axis=1)}, 2)
        self.output("check", self.path("bad.npz"), "--any-orientation")

    def test_forgotten_point(self):
        points = np.vstack([self.good["points"], [[0.5, 0.5, 0.5]]])
        self.violation({"points": points, "cells": self.good["cells"]}, 6)

    def test_ties(self):
        points = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]])
        results = []
        for name, cells in (("a.npz", [[0, 1, 2], [3, 2, 1]]), ("b.npz", [[0, 1, 3], [0, 3, 2]])):
            np.savez(self.path(name), points=points, cells=np.array(cells))
            self.assertIn("ties: 1 ", self.output("check", self.path(name)))
            done = subprocess.run([DELONE, "check", self.path(name), "--canonical"], capture_output=True, timeout=60)
            results.append(done.returncode)
        self.assertEqual(sorted(results), [0, 1])

    def test_not_a_triangulation(self):
        self.complaint("check", self.path("missing.npz"))
        self.complaint("check", self.file("a.npz", "nonsense"))
        self.complaint("check", self.file("a.json", '{"points": 3}'))
        self.complaint("check", self.path("points.npy"))


class Generate(Case):
    def test_reproducible_by_seed(self):
        first, again, other = (self.output("generate", "gaussian", "-d", 3, "-n", 50, "--seed", seed) for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)
        self.assertEqual(first.split("\n")[1], "50")

    def test_every_kind_is_triangulated_exactly_as_in_every_format(self):
        kinds = re.findall(r"^  ([a-z0-9_]+)  +\w", self.output("generate", "--help").split("Kinds:")[1], re.M)
        self.assertGreaterEqual(len(kinds), 20)
        for kind in kinds:
            arrays = []
            for name in ("a.npy", "a.csv", "a.txt", "a.off"):
                self.output("generate", kind, "-d", 3, "-n", 40, "-o", self.path(name))
                arrays.append(self.stats(self.path(name))["hash"])
            arrays.append(self.stats("-", stdin=self.output("generate", kind, "-d", 3, "-n", 40))["hash"])
            self.assertEqual(len(set(arrays)), 1, kind)

    def test_counts(self):
        self.output("generate", "uniform", "-d", 2, "-n", "1e3", "-o", self.path("a.npy"))
        self.assertEqual(np.load(self.path("a.npy")).shape, (1000, 2))

    def test_too_many_points_is_out_of_memory(self):
        self.complaint("generate", "uniform", "-d", 1000000, "-n", "1e15", status=3)


class Memory(Case):
    def test_out_of_memory_is_an_error_like_any_other(self):
        points = self.uniform(6, 30000)
        limit = 150 * 2**20

        def limited():
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        text = self.complaint("delaunay", points, "-o", self.path("out.npz"), status=3, preexec_fn=limited)
        self.assertIn(points, text)
        self.assertIn("memory", text)
        self.assertFalse(os.path.exists(self.path("out.npz")))


class Info(Case):
    def test_points_and_triangulations(self):
        points = self.uniform(3, 50)
        text = self.output("info", points)
        self.assertIn("points\n", text)
        self.assertRegex(text, r"affine dimension +3\n")
        for name in ("t.npz", "t.json", "t.off"):
            self.output("delaunay", points, "-o", self.path(name))
            text = self.output("info", self.path(name))
            self.assertIn("a triangulation", text)
            self.assertIn(self.stats(points)["hash"], text)
        self.assertIn("points\n", self.output("info", "-", stdin="2\n3\n0 0\n1 0\n2 0\n"))
        self.assertIn("points\n", self.output("info", self.file("p.off", "OFF\n1 0 0\n0 0 0\n")))
        self.complaint("info", self.path("missing.npz"))


class Interrupts(Case):
    def interrupted(self, arguments, wait, signal_number=signal.SIGINT, stdin=subprocess.DEVNULL, status=None):
        before = sorted(os.listdir(self.folder.name))
        process = subprocess.Popen([DELONE, *arguments], stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        wait(process)
        start = time.monotonic()
        process.send_signal(signal_number)
        out, _ = process.communicate(timeout=30)
        self.assertLess(time.monotonic() - start, 1.5)  # a second, and what a busy machine adds to it
        self.assertEqual(process.returncode, status or 128 + signal_number)
        self.assertEqual(out, b"")
        self.assertEqual(sorted(os.listdir(self.folder.name)), before)

    def test_while_building(self):
        points = self.uniform(6, 30000)

        def wait(process):
            time.sleep(1)
            self.assertIsNone(process.poll(), "the build was over before the signal")

        for number in (signal.SIGINT, signal.SIGTERM):
            self.interrupted(["delaunay", points, "-o", self.path("out.npz")], wait, number)
            self.interrupted(["delaunay", points, "--stats"], wait, number)

    def test_while_reading(self):
        self.interrupted(["delaunay", "-", "-o", self.path("out.npz")], lambda process: time.sleep(0.3), stdin=subprocess.PIPE)

    def test_while_writing(self):
        # The signal is sent as soon as the temporary file is seen; the text form takes the longest to write.
        points = self.uniform(2, 200000)

        def wait(process):
            while not glob.glob(self.path(".delone-partial-*")):
                self.assertIsNone(process.poll(), "the file was written before it was seen")

        self.interrupted(["delaunay", points, "-o", self.path("out.json")], wait)

    def test_ignored_signals_stay_ignored(self):
        points = self.uniform(2, 20000)
        process = subprocess.Popen(["sh", "-c", f'trap "" INT; exec "{DELONE}" delaunay "{points}" -o "{self.path("out.npz")}"'])
        time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertTrue(os.path.exists(self.path("out.npz")))


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    DELONE = os.path.abspath(sys.argv.pop(1))
    unittest.main()
