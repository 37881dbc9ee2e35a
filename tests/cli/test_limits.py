# SPDX-License-Identifier: BSD-3-Clause
"""Too little memory, and signals: an error like any other, and nothing left behind."""
import glob
import os
import resource
import signal
import subprocess
import time
import unittest

from cli_support import Case, DELONE


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


    def test_a_line_of_a_million_numbers_takes_the_memory_of_a_few(self):
        line = self.file("line.txt", " ".join(["1.5"] * 1000000))
        limit = 400 * 2**20

        def limited():
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        self.assertIn("1 point in dimension 1000000", self.output("delaunay", line, preexec_fn=limited))


class Interrupts(Case):
    def interrupted(self, arguments, wait, signal_number=signal.SIGINT, stdin=subprocess.DEVNULL, status=None):
        before = sorted(os.listdir(self.folder.name))
        process = subprocess.Popen([DELONE, *arguments], stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        wait(process)
        start = time.monotonic()
        process.send_signal(signal_number)
        out, _ = process.communicate(timeout=30)
        self.assertLess(time.monotonic() - start, 3)  # a second, and what a busy machine adds to it
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
        points = self.uniform(2, 500000)

        def wait(process):
            while not glob.glob(self.path(".delone-partial-*")):
                self.assertIsNone(process.poll(), "the file was written before it was seen")

        self.interrupted(["delaunay", points, "-o", self.path("out.json")], wait)

    def test_while_making_what_is_written(self):
        # The diagram is extracted when it is written, which takes longer than the triangulation.
        points = self.uniform(5, 12000)
        self.interrupted(["voronoi", points, "-o", self.path("out.npz")], lambda process: time.sleep(1.5))

    def test_ignored_signals_stay_ignored(self):
        points = self.uniform(2, 20000)
        process = subprocess.Popen(["sh", "-c", f'trap "" INT; exec "{DELONE}" delaunay "{points}" -o "{self.path("out.npz")}"'])
        time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertTrue(os.path.exists(self.path("out.npz")))


if __name__ == "__main__":
    unittest.main()
