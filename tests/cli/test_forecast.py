# SPDX-License-Identifier: BSD-3-Clause
"""delone forecast, and --memory and --time, which end a build before the machine does."""
import json
import os
import re
import unittest

import numpy as np

from cli_support import Case

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
        self.assertEqual((stats["points"], stats["sampled"], stats["affine_dimension"]), (2000, 0, 3))
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

    def test_bad_arguments(self):
        points = self.uniform(2, 10)
        self.assertIn("-d and -n", self.complaint("forecast", status=64))
        self.assertIn("-d, -n and --kind", self.complaint("forecast", points, "-n", "5", status=64))
        self.assertIn("-n wants", self.complaint("forecast", "-d", "2", "-n", "x", status=64))
        self.assertIn("--kind", self.complaint("forecast", "-d", "2", "-n", "5", "--kind", "x", status=64))


class Limits(Case):
    WHOLE = r"; the whole would have taken about [\d.]+ [kMGTPE]?B and [\d.]+ (seconds?|minutes?|hours?|days?|years?)"

    def test_time(self):
        points = self.uniform(5, 60000)
        for command in (["delaunay"], ["voronoi"], ["hull"]):
            if command == ["hull"]:
                points = self.file("sphere.npy", on_sphere(20000, 7))
            out = self.path("out.npz")
            text = self.complaint(*command, points, "--time", "0.3", "-o", out, status=3)
            self.assertRegex(text, "stopped at the limit of 0.3 seconds with (less than )?[0-9]+ % of the points inserted")
            self.assertFalse(os.path.exists(out))
        self.assertIn("0.3", text)

    def test_the_whole_is_told(self):
        text = self.complaint("delaunay", self.uniform(5, 20000), "--threads", "1", "--time", "0.4", status=3)
        self.assertRegex(text, self.WHOLE)

    def test_memory(self):
        points = self.uniform(6, 30000)
        out = self.path("out.npz")
        text = self.complaint("delaunay", points, "--memory", "150MB", "-o", out, status=3)
        self.assertRegex(text, "stopped at the limit of 150 MB with ")
        self.assertIn("with a folder as output", text)
        self.assertFalse(os.path.exists(out))
        text = self.complaint("hull", self.file("sphere.npy", on_sphere(30000, 7)), "--memory", "150MB", status=3)
        self.assertRegex(text, "stopped at the limit of 150 MB with ")
        self.assertNotIn("folder", text)

    def test_enough(self):
        points = self.uniform(3, 1000)
        self.output("delaunay", points, "--memory", "4GB", "--time", "2h")

    def test_bad_arguments(self):
        points = self.uniform(2, 10)
        for bad in ("0", "-1", "nan", "1y", "x", ""):
            self.assertIn("--time", self.complaint("delaunay", points, f"--time={bad}", status=64))


def on_sphere(n, dimension):
    points = np.random.default_rng(0).standard_normal((n, dimension))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


if __name__ == "__main__":
    unittest.main()
