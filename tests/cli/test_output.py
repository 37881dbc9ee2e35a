# SPDX-License-Identifier: BSD-3-Clause
"""Output that cannot be written: errors, and no half-written file."""
import os
import subprocess
import time
import unittest

import numpy as np

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

    def test_a_folder_of_somebody_else(self):
        """As an ordinary user: nothing is refused to root."""
        nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        os.chmod(self.folder.name, 0o755)
        try:
            subprocess.run([DELONE, "--version"], check=True, capture_output=True, timeout=60, **nobody)
        except (OSError, subprocess.SubprocessError) as error:
            self.skipTest(f"another user cannot run the command: {error}")
        points, weighted = self.uniform(2, 30), self.file("weighted.csv", "x,y,w\n0,0,0\n1,0,0\n0,1,0\n1,1,0.1\n")
        weights, slabs = self.file("weights.npy", np.zeros(30)), self.file("slabs.txt", "1 0 -1\n-1 0 -1\n0 1 -1\n0 -1 -1\n")
        simplex = self.file("simplex.ine", "H-representation\nbegin\n3 3 rational\n0 1 0\n0 0 1\n1 -1 -1\nend\n")
        triangulation = self.path("triangulation.npz")
        self.output("delaunay", points, "-o", triangulation)
        locked = self.path("locked")
        os.mkdir(locked)
        os.chmod(locked, 0o555)
        out = os.path.join(locked, "out")
        writers = [["delaunay", points, "-o", f"{out}.{extension}"] for extension in ("npz", "json", "off", "ply", "vtu", "svg", "html")]
        writers += [["delaunay", points, "--qhull", "o", "-o", out], ["delaunay", points, "-o", out + "/"], ["delaunay", points, "-o", locked + "/"],
                    ["regular", weighted, "--weights", "w", "-o", out + "/"], ["regular", points, "--weights", weights, "-o", out + ".npz"],
                    ["hull", points, "-o", out + ".npz"], ["voronoi", points, "-o", out + ".npz"],
                    ["voronoi", points, "--box", "0", "0", "1", "1", "--volumes", out + ".csv"],
                    ["alpha", points, "--radius", "1", "-o", out + ".npz"], ["halfspaces", slabs, "-o", out + ".npz"],
                    ["polyhedron", simplex, "-o", out + ".ext"], ["generate", "uniform", "-d", "2", "-n", "5", "-o", out + ".npy"],
                    ["view", triangulation, "-o", out + ".html"], ["locate", triangulation, "--queries", points, "-o", out + ".csv"]]
        for arguments in writers:
            text = self.complaint(*arguments, **nobody)
            self.assertIn(f"{arguments[-1]}: Permission denied", text)
            self.assertEqual(os.listdir(locked), [], arguments)
        # A file that may not be changed, in a folder that may.
        open_folder = self.path("open")
        os.mkdir(open_folder)
        os.chmod(open_folder, 0o777)
        kept = os.path.join(open_folder, "kept.npz")
        with open(kept, "wb") as file:
            file.write(b"kept")
        os.chmod(kept, 0o444)
        self.assertIn(f"{kept}: Permission denied", self.complaint("delaunay", points, "-o", kept, **nobody))
        self.assertEqual(os.listdir(open_folder), ["kept.npz"])
        with open(kept, "rb") as file:
            self.assertEqual(file.read(), b"kept")

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
