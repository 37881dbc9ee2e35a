# SPDX-License-Identifier: BSD-3-Clause
"""Input that means harm, or does harm unasked: without an end, with bytes for the terminal, or the file that is written to."""
import os
import subprocess
import unittest

from cli_support import Case, DELONE


class Endless(Case):
    def refused(self, source, arguments, status, pattern):
        process = subprocess.Popen(source, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        done = subprocess.run([DELONE, *arguments], stdin=process.stdout, capture_output=True, timeout=60)
        process.stdout.close()
        process.wait(timeout=60)
        self.assertEqual(done.returncode, status, (arguments, done.stderr))
        self.assertRegex(done.stderr.decode(), pattern)

    def test_a_device_without_an_end_is_of_no_format(self):
        for output_format in ("npy", "csv", "txt", "off", "ply", "qhull"):
            text = self.complaint("delaunay", "/dev/zero", "--format", output_format)
            self.assertIn("/dev/zero", text)
        for output_format in ("npz", "json", "off"):
            self.complaint("check", "/dev/zero", "--format", output_format)
            self.complaint("info", "/dev/zero", "--format", output_format)

    def test_a_stream_without_an_end(self):
        self.refused(["yes"], ["delaunay", "-"], 2, "'y', which is not a count")
        for arguments in (["delaunay", "-"], ["hull", "-"], ["info", "-"], ["locate", "-", "--queries", self.uniform(2, 5)],
                          ["regular", "-", "--weights", "0"], ["voronoi", "-"], ["halfspaces", "-"]):
            self.refused(["yes", "1"], [*arguments, "--max-stream", "1MB"], 3, "more than 1000000 bytes.*--max-stream")
        self.refused(["yes", '{"'], ["check", "/dev/stdin", "--format", "json", "--max-stream", "1MB"], 3, "--max-stream")

    def test_the_limit_is_for_streams_only(self):
        points = self.uniform(2, 1000)
        self.output("info", points, "--max-stream", "1KB")
        text = "2\n1000\n" + "0 1\n" * 1000
        self.complaint("info", "-", "--max-stream", "1KB", stdin=text, status=3)
        self.output("info", "-", "--max-stream", "8KB", stdin=text)

    def test_sizes(self):
        text = "2\n1000\n" + "0 1\n" * 1000
        for size, size_in_bytes in (("0", 0), ("1000", 1000), ("1e3", 1000), ("1KB", 1000), ("1kb", 1000), ("1 KB", 1000), ("1.5KB", 1500),
                                    ("1KiB", 1024), ("1K", 1024), ("0.5KiB", 512), ("4000B", 4000)):
            self.assertIn(f"more than {size_in_bytes} bytes", self.complaint("info", "-", "--max-stream", size, stdin=text, status=3))
        for size in ("9223372036854775807", "9e18", "4GB", "4GiB", "1000TiB", "1T"):
            self.output("info", "-", "--max-stream", size, stdin=text)
        for size in ("-1", "-1KB", "9223372036854775808", "18446744073709551616", "1e19", "1e30", "99999999TiB", "0.5", "0.0001KB", "much",
                     "GB", "4XB", "4GiBs", "4KK", "inf", "nan", "0x10", "+5", "1e3e3"):
            text = self.complaint("info", "-", "--max-stream=" + size, stdin="", status=64)
            self.assertIn("--max-stream: ", text)
            self.assertIn("KiB", text)


class Messages(Case):
    def safe(self, text):
        self.assertTrue(text.rstrip("\n").isprintable(), text[:300])
        self.assertLess(len(text), 2100)
        return text

    def test_foreign_text_cannot_reach_the_terminal(self):
        hostile = "\x1b]0;title\x07\x1b[31m" + "y" * 100000
        table = self.file("a.csv", f"{hostile},b\n1,x\n")
        self.safe(self.complaint("delaunay", table))
        self.safe(self.complaint("delaunay", table, "--columns", "none"))
        self.safe(self.complaint("delaunay", self.file("b.csv", f"{hostile},b\nx,1\n")))
        self.safe(self.complaint("check", self.file("a.json", f'{{"points": "{hostile}"}}')))
        self.safe(self.complaint("check", self.file("a.json", f'{{"{"y" * 1000}": [1e999], "points": {hostile}}}')))
        for line in self.output("info", self.file("c.csv", f"{hostile},b\n1,2\n")).splitlines():
            self.safe(line)
        name = self.file("x\x1b[31m\n.txt", "a")
        self.safe(self.complaint("delaunay", name))
        self.safe(self.complaint("check", self.file("\x1b.npz", "PK")))
        for line in self.output("info", self.file("\x1b[1m.txt", "1 2\n")).splitlines():
            self.safe(line)

    def test_arguments_are_foreign_text(self):
        points = self.uniform(2, 5)
        for arguments in (["\x1b[31m"], ["delaunay", points, "--\x1b[31m"], ["delaunay", points, "--format", "\x1b" + "x" * 50000],
                          ["delaunay", points, "--order=" + "x" * 50000], ["generate", "uniform", "-d", 2, "-n", "\x1b[31m"],
                          ["delaunay", points, *["x\x9b"] * 2000]):
            self.safe(self.complaint(*arguments, status=64))
        self.safe(self.complaint("regular", points, "--weights", "\x1b[31m"))
        self.safe(self.complaint("delaunay", points, "--columns", "\x1b[31m"))


class Overwriting(Case):
    def setUp(self):
        super().setUp()
        self.points = self.file("points.txt", "0 0\n1 0\n0 1\n")
        os.mkdir(self.path("folder"))
        os.symlink("../points.txt", self.path("folder/link.txt"))

    def test_inputs_are_not_overwritten_unasked(self):
        same = [self.points, os.path.join(self.folder.name, "folder/../points.txt"), self.path("folder/link.txt"), "points.txt"]
        weights = self.file("weights.txt", "0\n0\n0\n")
        for command in (["delaunay"], ["hull"], ["hull", "--lower"], ["voronoi"], ["halfspaces"],
                        ["locate", "--queries", self.uniform(2, 3)], ["regular", "--weights", weights]):
            for path in same:
                text = self.complaint(*command, self.points, "-o", path, "--output-format",
                                      "csv" if command[0] == "locate" else "json", status=64, cwd=self.folder.name)
                self.assertIn("--force", text)
        self.complaint("regular", self.points, "--weights", weights, "-o", weights, "--output-format", "json", status=64)
        self.complaint("hull", self.points, "--lower", "--distances", self.points, status=64)
        self.complaint("voronoi", self.points, "--volumes", self.points, status=64)
        self.complaint("locate", self.uniform(2, 3), "--queries", self.points, "-o", self.points, status=64)
        with open(self.points, "rb") as source:
            done = subprocess.run([DELONE, "delaunay", "-", "-o", self.points, "--output-format", "json"], stdin=source,
                                  capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 64, done.stderr)
        with open(self.points) as f:
            self.assertEqual(f.read(), "0 0\n1 0\n0 1\n")

    def test_with_force_they_are(self):
        self.output("delaunay", self.points, "-o", self.path("folder/link.txt"), "--force")
        with open(self.points) as f:
            self.assertEqual(f.read(), "1\n0 1 2\n")
        self.assertTrue(os.path.islink(self.path("folder/link.txt")))

    def test_two_outputs_are_not_one_file(self):
        os.symlink("new.csv", self.path("link.csv"))
        self.complaint("voronoi", self.points, "-o", self.path("new.csv"), "--output-format", "json", "--volumes",
                       self.path("link.csv"), status=64)
        self.assertFalse(os.path.exists(self.path("new.csv")))

    def test_two_outputs_are_not_one_new_file(self):
        os.mkdir(self.path("other"))
        os.symlink("other", self.path("way"))
        new = self.path("new.json")
        names = ["new.json", "./new.json", "folder/../new.json", "way/../new.json", new]
        for one in names:
            for other in names:
                for command in (["voronoi", "--volumes"], ["hull", "--lower", "--distances"]):
                    text = self.complaint(*command, one, self.points, "-o", other, status=64, cwd=self.folder.name)
                    self.assertIn("are one file", text)
        self.complaint("voronoi", self.points, "-o", "other/a.json", "--volumes", "way/a.json", status=64, cwd=self.folder.name)
        weights = self.file("weights.txt", "0\n0\n0\n")
        self.complaint("power", self.points, "--weights", weights, "-o", "b.json", "--volumes", "./b.json", status=64, cwd=self.folder.name)
        self.assertFalse(os.path.exists(new))
        self.output("voronoi", self.points, "-o", "new", "--output-format", "json", "--volumes", "other/new", cwd=self.folder.name)

    def test_two_outputs_do_not_share_standard_output(self):
        for arguments in (["voronoi", "-o", "-", "--output-format", "json", "--volumes", "-"], ["voronoi", "--volumes", "-", "--stats"],
                          ["hull", "--lower", "-o", "-", "--output-format", "json", "--distances", "-"],
                          ["hull", "--lower", "--distances", "-", "--stats"], ["delaunay", "-o", "-", "--output-format", "json", "--stats"]):
            self.assertIn("standard output", self.complaint(*arguments, self.points, status=64))
        # The distances and nothing else.
        self.assertRegex(self.output("hull", "--lower", "--distances", "-", self.points), r"\A1\n3\n[0-9.]+\n[0-9.]+\n[0-9.]+\n\Z")
        # A file written whole would take the place of the one that the report goes to.
        out = self.path("out.json")
        for arguments, status in ((["-o", out, "--stats"], 64), (["-o", "/dev/stdout", "--output-format", "json"], 0)):
            with open(out, "wb") as stdout:
                done = subprocess.run([DELONE, "delaunay", self.points, *arguments], stdout=stdout, stderr=subprocess.PIPE, timeout=60)
            self.assertEqual(done.returncode, status, done.stderr)

    def test_standard_output_is_no_input(self):
        """As after `>>` and `1<>` of a shell, which leave the file as it is."""
        triangulation = self.file("t.json", '{"dimension":1,"points":[[0],[1]],"cells":[[0,1]]}')
        with open(triangulation, "rb") as file:
            content = file.read()
        pair = self.uniform(2, 3)
        for arguments in (["delaunay", "A"], ["delaunay", "A", "--stats"], ["hull", "A"], ["voronoi", "A", "--volumes", "-"], ["halfspaces", "A"],
                          ["locate", "A", "--queries", pair], ["locate", pair, "--queries", "A"], ["regular", pair, "--weights", "A"],
                          ["power", pair, "--weights", "A"], ["info", "A"], ["check", "A"], ["check", pair, "--points", "A"], ["info", "-"],
                          ["halfspaces", pair, "--interior", "A"], ["delaunay", "-", "-o", "-", "--output-format", "json"]):
            for mode in ("ab", "r+b"):
                with open(triangulation, mode) as stdout, open(triangulation, "rb") as stdin:
                    done = subprocess.run([DELONE, *[triangulation if each == "A" else each for each in arguments]], stdin=stdin, stdout=stdout,
                                          stderr=subprocess.PIPE, timeout=60)
                self.assertEqual(done.returncode, 64, (arguments, done.stderr))
                self.assertRegex(done.stderr.decode(), r"\Adelone: standard output is also an input[^\n]*\n\Z")
                with open(triangulation, "rb") as file:
                    self.assertEqual(file.read(), content)
        points = self.file("points.csv", "0,0\n1,0\n0,1\n")
        with open(points, "ab") as stdout:
            self.assertEqual(subprocess.run([DELONE, "locate", points, "--queries", points, "--force"], stdout=stdout, timeout=60).returncode, 0)
        with open(points, encoding="utf-8") as file:
            self.assertIn("query,kind,cell,face", file.read())

    def test_links_are_written_through(self):
        os.symlink("new.json", self.path("link.json"))
        self.output("delaunay", self.points, "-o", self.path("link.json"))
        self.assertTrue(os.path.islink(self.path("link.json")))
        self.assertTrue(os.path.isfile(self.path("new.json")))
        os.symlink("answers.csv", self.path("link.csv"))
        self.output("locate", self.points, "--queries", self.points, "-o", self.path("link.csv"))
        self.assertTrue(os.path.islink(self.path("link.csv")))
        self.assertTrue(os.path.isfile(self.path("answers.csv")))
        os.symlink("none/file.json", self.path("astray.json"))
        self.complaint("delaunay", self.points, "-o", self.path("astray.json"))
        self.assertTrue(os.path.islink(self.path("astray.json")))


if __name__ == "__main__":
    unittest.main()
