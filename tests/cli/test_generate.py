# SPDX-License-Identifier: BSD-3-Clause
"""delone generate: the named point sets."""
import re
import unittest

from cli_support import Case, np


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
        for dimension, n in ((1000000, "1e15"), (2, "1e18"), (2, "1e30"), (2, "99999999999999999999999"), (2, "18446744073709551615"), (1, "1e17")):
            self.assertIn("not enough memory for", self.complaint("generate", "uniform", "-d", dimension, "-n", n, status=3))
        for n in ("-1", "inf", "nan", "1e-3", "", "0x10", " 5", "1e3 "):
            self.assertIn("-n wants a whole number of points", self.complaint("generate", "uniform", "-d", 2, "-n=" + n, status=64))


if __name__ == "__main__":
    unittest.main()
