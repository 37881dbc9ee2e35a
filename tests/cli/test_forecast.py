# SPDX-License-Identifier: BSD-3-Clause
"""delone forecast, and --memory and --time, which end a build before the machine does."""
import json
import os
import re
import resource
import subprocess
import tempfile
import unittest

import numpy as np

from cli_support import Case, DELONE

STATS = {"command": str, "dimension": int, "affine_dimension": int, "points": int, "sampled": int, "vertices": dict, "cells": dict,
         "bytes": dict, "seconds": dict, "threads": int, "version": str}
QUANTITIES = ("vertices", "cells", "bytes", "seconds")


class Forecasts(Case):
    def stats_of(self, *arguments):
        stats = json.loads(self.output("forecast", *arguments, "--stats"))
        self.assertEqual({key: type(value) for key, value in stats.items()}, STATS)
        for name in QUANTITIES:
            self.assertLessEqual(stats[name]["low"], stats[name]["expected"])
            self.assertLessEqual(stats[name]["expected"], stats[name]["high"])
        return stats

    def test_of_a_kind(self):
        stats = self.stats_of("-d", "3", "-n", "2000", "--kind", "ball")
        self.assertEqual((stats["points"], stats["affine_dimension"]), (2000, 3))
        self.assertGreater(stats["sampled"], 100)
        self.assertEqual(self.stats_of("-d", "3", "-n", "2000")["sampled"], 0)
        points = self.path("points.npy")
        self.run_delone("generate", "ball", "-d", "3", "-n", "2000", "-o", points)
        actual = json.loads(self.output("delaunay", points, "--stats"))["cells"]
        self.assertLess(abs(np.log(stats["cells"]["expected"] / actual)), np.log(1.5))

    def test_of_a_file(self):
        points = self.uniform(4, 600)
        stats = self.stats_of(points)
        actual = json.loads(self.output("delaunay", points, "--stats"))["cells"]
        self.assertGreater(stats["sampled"], 10)
        self.assertLess(abs(np.log(stats["cells"]["expected"] / actual)), np.log(1.5))

    def test_text(self):
        text = self.output("forecast", "-d", "6", "-n", "2e4", "--threads", "1")
        self.assertIn("a Delaunay triangulation of 20000 points in dimension 6 will take about", text)
        self.assertRegex(text, r"cells +\S+ \(\S+ to \S+\)")
        self.assertRegex(text, r"memory +[\d.]+ GB \([\d.]+ GB to [\d.]+ GB\)")
        self.assertRegex(text, r"time .*, 1 thread\n")

    def test_numbers_beyond_all_numbers(self):
        stats = self.stats_of("-d", "1000", "-n", "1000000")
        self.assertTrue(all(np.isfinite(list(stats[name].values())).all() for name in QUANTITIES))
        self.assertRegex(self.output("forecast", "-d", "1000", "-n", "1e6"), "memory +more than 1000 EB")

    def test_bad_arguments(self):
        points = self.uniform(2, 10)
        self.assertIn("-d and -n", self.complaint("forecast", "--stats", status=64))
        self.assertIn("-d, -n and --kind", self.complaint("forecast", points, "-n", "5", status=64))
        self.assertIn("-n wants", self.complaint("forecast", "-d", "2", "-n", "x", status=64))
        self.assertIn("--kind", self.complaint("forecast", "-d", "2", "-n", "5", "--kind", "x", status=64))


class Limits(Case):
    REACHED = r"stopped at the limit of {} (with (less than )?\d+ % of the points inserted|while cells were made)"
    BYTES, TIME = r"[\d.]+ [kMGTPE]?B", r"[\d.]+ (seconds?|minutes?|hours?|days?|years?)"
    WHOLE = rf"; the whole would have taken about {BYTES} \({BYTES} to {BYTES}\) and about {TIME} \({TIME} to {TIME}\)"

    @classmethod
    def setUpClass(cls):
        """Points that no machine is done with soon."""
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        random = np.random.default_rng(0)
        on_sphere = random.standard_normal((20000, 7))
        cls.points, cls.sphere = os.path.join(folder.name, "points.npy"), os.path.join(folder.name, "sphere.npy")
        np.save(cls.points, random.random((100000, 6)))
        np.save(cls.sphere, on_sphere / np.linalg.norm(on_sphere, axis=1, keepdims=True))

    def test_time(self):
        out = self.path("out.npz")
        for command, points in (("delaunay", self.points), ("voronoi", self.points), ("hull", self.sphere)):
            text = self.complaint(command, points, "--time", "0.05", "-o", out, status=3)
            self.assertRegex(text, self.REACHED.format("0.05 seconds"))
            self.assertFalse(os.path.exists(out))
        points = self.uniform(3, 20000)
        self.assertRegex(self.complaint("hull", points, "--lower", "--time", "1e-6", status=3), self.REACHED.format("1e-06 seconds"))

    def test_the_whole_is_told(self):
        text = self.complaint("delaunay", self.points, "--threads", "1", "--time", "0.1", status=3)
        self.assertRegex(text, self.WHOLE)

    def test_memory(self):
        out = self.path("out.npz")
        text = self.complaint("delaunay", self.points, "--memory", "100MB", "-o", out, status=3)
        self.assertRegex(text, self.REACHED.format("100 MB"))
        self.assertNotIn("folder", text)  # tiles do not pay in 6D
        self.assertFalse(os.path.exists(out))
        text = self.complaint("delaunay", self.uniform(3, 300000), "--memory", "60MB", status=3)
        self.assertIn("with a folder as output", text)
        text = self.complaint("hull", self.sphere, "--memory", "100MB", status=3)
        self.assertRegex(text, self.REACHED.format("100 MB"))
        self.assertNotIn("folder", text)

    def test_a_limit_of_time_is_asked_in_many_dimensions(self):
        """Ordering the points, or a sieve of them, takes seconds of processor time there."""
        points = self.uniform(1000, 3000)
        for command in ("delaunay", "hull"):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            self.assertRegex(self.complaint(command, points, "--threads", "1", "--time", "0.1", status=3), self.REACHED.format("0.1 seconds"))
            self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 1.5, command)

    def test_all_forecasts_agree(self):
        points = self.uniform(10, 1000)
        ranges = []
        for arguments in (["-d", "10", "-n", "1000"], [points]):
            found = json.loads(self.output("forecast", *arguments, "--stats"))["bytes"]
            ranges.append((found["low"], found["expected"], found["high"]))
        for limit in (("--time", "1"), ("--memory", "300MB")):
            text = self.complaint("delaunay", points, "--threads", "1", *limit, status=3)
            sizes = re.search(r"taken about ([\d.]+) (\w+) \(([\d.]+) (\w+) to ([\d.]+) (\w+)\)", text).groups()
            middle, low, high = (float(number) * {"MB": 1e6, "GB": 1e9, "TB": 1e12}[unit] for number, unit in zip(sizes[::2], sizes[1::2]))
            ranges.append((low, middle, high))
        # A message knows some tens of points only, which have some megabytes of cells: its middle may be off by a few times.
        for low, _, high in ranges:
            for _, middle, _ in ranges[:2]:
                self.assertLess(low, middle, ranges)
                self.assertLess(middle, high, ranges)
        for low, middle, high in ranges[2:]:
            self.assertLess(abs(np.log(middle / ranges[0][1])), np.log(6), ranges)
            self.assertLess(high / low, 400, ranges)

    def test_a_warning_comes_before_the_work(self):
        points = self.path("points.npy")
        np.save(points, np.random.default_rng(0).random((3000, 12)))  # petabytes
        warning = r"delone: warning: the triangulation is expected to take about \S+ [TPE]B of memory \(.*\), but only \S+ \wB is available\n"
        for command in (["delaunay"], ["voronoi"]):
            process = subprocess.Popen([DELONE, *command, points], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            self.addCleanup(process.wait)
            self.addCleanup(process.stderr.close)
            self.addCleanup(process.kill)
            self.assertRegex(process.stderr.readline(), warning)
        self.assertIn("is available", self.output("forecast", points))
        text = self.complaint("delaunay", points, "--time", "0.2", status=3)  # one line: the error says it
        self.assertRegex(text, self.REACHED.format("0.2 seconds"))

    def test_enough(self):
        points = self.uniform(3, 1000)
        self.output("delaunay", points, "--memory", "4GB", "--time", "2h")

    def test_bad_arguments(self):
        points = self.uniform(2, 10)
        for bad in ("0", "-1", "nan", "1y", "x", ""):
            self.assertIn("--time", self.complaint("delaunay", points, f"--time={bad}", status=64))


if __name__ == "__main__":
    unittest.main()
