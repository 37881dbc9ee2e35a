# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the command share. The command `delone` is run as a user runs it: exit statuses, messages, files, signals.

Each file is a test program:  DELONE=build/release/delone python3 tests/cli/test_hull.py [unittest arguments]
"""
import itertools
import json
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: this Python has no NumPy", file=sys.stderr)
    sys.exit(77)

DELONE = os.path.abspath(os.environ["DELONE"])
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
