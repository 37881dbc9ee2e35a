#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What tools/matrix.py makes of the output of builds, with a stand-in for make.

  python3 tests/tools/test_matrix.py [unittest arguments]
"""
import contextlib
import io
import pathlib
import re
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import matrix  # noqa: E402


class Matrix(unittest.TestCase):
    def test_kinds_are_targets_of_make(self):
        targets = re.findall(r"^([a-z0-9-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)
        self.assertLessEqual(set(matrix.KINDS), set(targets))

    def test_counts_tests(self):
        self.assertEqual(matrix.count_tests("100% tests passed, 0 tests failed out of 12\n97% tests passed, 1 tests failed out of 34\n"), "45/46")
        self.assertEqual(matrix.count_tests("===== 3 passed, 1 failed, 2 skipped in 1.50s =====\n"), "3/4")
        self.assertEqual(matrix.count_tests("30 passed in 2.1s\n"), "30/30")
        self.assertEqual(matrix.count_tests("Ran 4 tests in 2.1s\n\nFAILED (failures=1)\nRan 1 test in 0s\n\nOK\n"), "4/5")
        self.assertEqual(matrix.count_tests("[ FAIL 1 | WARN 0 | SKIP 2 | PASS 30 ]\n245 passed, 2 failed\n"), "275/278")
        self.assertEqual(matrix.count_tests("nothing"), "–")

    def test_failures_are_seen_and_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            make = pathlib.Path(folder) / "make"
            make.write_text('#!/bin/sh\necho "50% tests passed, 1 tests failed out of 2"\n[ $1 = tsan ]\n')
            make.chmod(0o755)
            with unittest.mock.patch.object(matrix, "ROOT", pathlib.Path(folder)), contextlib.redirect_stdout(io.StringIO()) as printed:
                outcomes = [matrix.run(kind, str(make)) for kind in ("tsan", "mpi")]
        self.assertEqual([outcome.passed for outcome in outcomes], [True, False])
        self.assertIn("mpi: failed", printed.getvalue())
        lines = matrix.table(outcomes).splitlines()
        self.assertRegex(lines[1], r"^tsan +passed +0\.0 +1/2 ")
        self.assertRegex(lines[2], r"^mpi +FAILED ")
        self.assertRegex(lines[3], r"^all +1/2 ")


if __name__ == "__main__":
    unittest.main()
