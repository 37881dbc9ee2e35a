# SPDX-License-Identifier: BSD-3-Clause
"""Options, help and version; what is refused with status 64."""
import os
import re
import unittest

from cli_support import Case


class Usage(Case):
    def test_bad_options(self):
        points = self.uniform(2, 5)
        for arguments in ([], ["triangulate"], ["delaunay"], ["delaunay", points, "--no-such-option"],
                          ["delaunay", points, "--threads", "-1"], ["delaunay", points, "--threads", "two"],
                          ["delaunay", points, "--seed", "-1"],
                          ["delaunay", points, "-s", "99999999999999999999"], ["delaunay", points, "-s", "18446744073709551616"],
                          ["delaunay", points, "--order", "sorted"],
                          ["delaunay", points, "--format", "bmp"], ["delaunay", points, "--output-format", "bmp"],
                          ["delaunay", points, "--stats", "-o", "-", "--output-format", "txt"], ["delaunay", points, points],
                          ["check", points, "--level", "7"], ["check"], ["locate", points],
                          ["generate", "uniform", "-n", "5"], ["generate", "unheard_of", "-d", "2", "-n", "5"],
                          ["generate", "uniform", "-d", "0", "-n", "5"], ["generate", "uniform", "-d", "2", "-n", "-5"],
                          ["generate", "uniform", "-d", "2", "-n", "1.5"], ["generate", "uniform", "-d", "2", "-n", "five"],
                          ["generate", "flat", "-d", "1", "-n", "5"], ["locate", "-", "--queries", "-"]):
            self.complaint(*arguments, status=64)

    def test_results_are_in_the_formats_of_results(self):
        text = self.complaint("check", self.uniform(2, 5))
        self.assertIn("'npy' cannot be used for reading anything but points; available: npz, json, off", text)

    def test_help_and_version(self):
        self.assertRegex(self.output("--version"), r"\Adelone \d+\.\d+\.\d+\n\Z")
        for command in ("delaunay", "locate", "check", "generate", "info"):
            self.assertIn(command, self.output("--help"))
            self.assertIn(f"delone {command}", self.output(command, "--help"))
        for kind in ("uniform", "cospherical", "mixed_scales"):
            self.assertIn(kind, self.output("generate", "--help"))

    def test_exit_statuses_are_those_of_the_documentation(self):
        with open(os.path.join(os.path.dirname(__file__), "../../docs/guide.md"), encoding="utf-8") as file:
            table = file.read().split("| status | meaning |\n")[1].split("\n\n")[0]
        documented = re.findall(r"\d+", " ".join(row.split("|")[1] for row in table.splitlines()))
        self.assertEqual(documented, ["0", "1", "2", "3", "64", "130", "143"])
        self.assertEqual(re.findall(r"\b\d+\b", self.output("--help").split("Exit status:")[1]), documented)


if __name__ == "__main__":
    unittest.main()
