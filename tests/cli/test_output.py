# SPDX-License-Identifier: BSD-3-Clause
"""Output that cannot be written: errors, and no half-written file."""
import os
import subprocess
import time
import unittest

from cli_support import Case, DELONE


class BadOutput(Case):
    def test_unwritable(self):
        points = self.uniform(2, 10)
        for path in (self.path("no/such/folder.npz"), "/proc/delone.npz"):
            self.assertIn(path, self.complaint("delaunay", points, "-o", path))
        os.mkdir(self.path("folder.npz"))
        self.complaint("hull", points, "-o", self.path("folder.npz"))
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

    def test_closed_streams(self):
        """Statuses are as always, whether or not anybody can be told."""
        points, out = self.uniform(2, 100), self.path("out.json")
        for arguments, status in ((["info", "nofile"], 2), (["delaunay", "--no-such-option"], 64), (["delaunay", points], 2),
                                  (["delaunay", points, "-o", out], 0), (["delaunay", points, "-o", out, "--threads", "9"], 0),
                                  (["locate", points, "--queries", points], 2), (["delaunay", "-"], 2), (["delaunay", points, "-o", out, "--stats"], 2)):
            command = " ".join(f"'{each}'" for each in [DELONE, *arguments])
            for closed in ("<&- >&- 2>&-", "<&- >&- 2>/dev/full"):
                done = subprocess.run(["sh", "-c", f"exec {command} {closed}"], timeout=60)
                self.assertEqual(done.returncode, status, (arguments, closed))
            if out in arguments:
                self.output("check", out)

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


if __name__ == "__main__":
    unittest.main()
