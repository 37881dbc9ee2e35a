# SPDX-License-Identifier: BSD-3-Clause
"""Options, help and version; what is refused with status 64."""
import os
import re
import shlex
import subprocess
import unittest

from cli_support import DELONE, Case

# In an order in which each may read what others have written.
COMMANDS = ["delaunay", "hull", "halfspaces", "voronoi", "regular", "power", "alpha", "locate", "interpolate", "check", "generate", "forecast",
            "info", "view"]


class Usage(Case):
    def test_bad_options(self):
        points = self.uniform(2, 5)
        for arguments in (["triangulate"], ["delaunay", points, "--no-such-option"],
                          ["delaunay", points, "--threads", "-1"], ["delaunay", points, "--threads", "two"],
                          ["delaunay", points, "--seed", "-1"],
                          ["delaunay", points, "-s", "99999999999999999999"], ["delaunay", points, "-s", "18446744073709551616"],
                          ["delaunay", points, "--order", "sorted"],
                          ["delaunay", points, "--format", "bmp"], ["delaunay", points, "--output-format", "bmp"],
                          ["delaunay", points, "--stats", "-o", "-", "--output-format", "txt"], ["delaunay", points, points],
                          ["check", points, "--level", "7"], ["check", "-q"], ["locate", points],
                          ["generate", "uniform", "-n", "5"], ["generate", "unheard_of", "-d", "2", "-n", "5"],
                          ["generate", "uniform", "-d", "0", "-n", "5"], ["generate", "uniform", "-d", "2", "-n", "-5"],
                          ["generate", "uniform", "-d", "2", "-n", "1.5"], ["generate", "uniform", "-d", "2", "-n", "five"],
                          ["generate", "flat", "-d", "1", "-n", "5"], ["locate", "-", "--queries", "-"]):
            self.complaint(*arguments, status=64)

    def test_results_are_in_the_formats_of_results(self):
        text = self.complaint("check", self.uniform(2, 5))
        self.assertIn("'npy' cannot be used for reading anything but points; available: npz, json, off", text)

    def test_other_meshes_are_those_of_meshio(self):
        points = self.uniform(2, 5)
        for command in ("delaunay", "hull", "voronoi"):
            for extension in ("stl", "obj", "msh"):
                text = self.complaint(command, points, "-o", self.path(f"a.{extension}"))
                self.assertRegex(text, rf"'{extension}' cannot be used for writing .*; more by to_meshio\(\) in Python")

    def test_help_and_version(self):
        self.assertRegex(self.output("--version"), r"\Adelone \d+\.\d+\.\d+\n\Z")
        for command in COMMANDS:
            self.assertIn(command, self.output("--help"))
            self.assertIn(f"delone {command}", self.output(command, "--help"))
        for kind in ("uniform", "cospherical", "mixed_scales"):
            self.assertIn(kind, self.output("generate", "--help"))

    def test_help_of_commands(self):
        self.assertEqual(self.output("help"), self.output("--help"))
        self.assertEqual(self.output("help", "--help"), self.output("--help"))
        for command in COMMANDS:
            own = self.output(command, "--help")
            self.assertEqual(self.output("help", command), own)
            self.assertIn(f"Usage: delone {command} ", own)
            self.assertNotIn("Exit status: 0 success", own)
            done = self.run_delone(command, status=64)  # without arguments
            self.assertEqual(done.stdout, b"")
            self.assertRegex(done.stderr.decode(), r"\A" + re.escape(own) + (r"\Z" if command == "forecast" else r"delone: [A-Z]+ is missing\n\Z"))
        self.assertEqual(self.output("help", "help"), self.output("--help"))
        self.assertEqual(self.output("help", "hull", "info"), self.output("help", "hull") + "\n" + self.output("help", "info"))
        done = self.run_delone(status=64)
        self.assertEqual((done.stdout, done.stderr.decode()), (b"", self.output("--help")))

    def test_suggestions(self):
        for arguments, meant in ((["hul"], "hull"), (["vornoi"], "voronoi"), (["Delaunay"], "delaunay"), (["dealunay"], "delaunay"),
                                 (["gen"], "generate"), (["help", "locat"], "locate"), (["hlep"], "help"), (["--verison"], "--version"),
                                 (["hull", "-", "--toleranse", "1"], "--tolerance"), (["hull", "--ouput=x.npz"], "--output"),
                                 (["locate", "a", "--query", "b"], "--queries"), (["locate", "a", "--queryformat", "b"], "--query-format")):
            text = self.complaint(*arguments, status=64)
            self.assertIn(f"; did you mean '{meant}'?", text, arguments)
        for arguments, said in ((["triangulate"], "there is no command 'triangulate' (see"), (["hull", "-", "--frob"], "there is no option '--frob' (see"),
                                (["interpolate", "-", "--values", "z", "--where", "-"], "there is no option '--where' (see"),
                                (["x" * 5000], "x"), (["hull", "-", "--\x1b[2J"], "\\x1b")):
            text = self.complaint(*arguments, status=64)
            self.assertIn(said, text)
            self.assertNotIn("did you mean", text)
            self.assertLess(len(text), 300)

    def test_bad_values(self):
        points = self.uniform(2, 5)
        for arguments, said in ((["voronoi", points, "--box", "0,0,a,1"], "--box: 'a' is not a number (item 3 of 4)"),
                                (["generate", "uniform", "-d", "two", "-n", "5"], "'two' is no whole number from 1 to 1000000"),
                                (["generate", "unifrom", "-d", "2", "-n", "5"], "did you mean 'uniform'?"),
                                (["voronoi", points, "--box", "0,0,1,1"], "--box cuts pictures and volumes"),
                                (["delaunay", points, "--output-format", "npz"], "--output-format requires --output"),
                                (["view", points, "--box", "0,0,1,1"], "--box cuts Voronoi")):
            self.assertIn(said, self.complaint(*arguments, status=64))
        for arguments, said in ((["delaunay", points, "-o", self.path("none/a.npz")], ": the folder " + self.path("none") + ": "),
                                (["delaunay", points, "--columns", "0-5"], "the range '0-5' ends beyond column 1"),
                                (["view", points, "-o", self.path("a.png")], "available: html, htm"),
                                (["voronoi", points, "--volumes", self.path("a.npy")], "available: csv")):
            self.assertIn(said, self.complaint(*arguments))

    def test_numbers_beyond_all_numbers(self):
        for number in ("1e400", "1e999999", "inf", "nan", "0x10"):
            text = self.complaint("generate", "uniform", "-d", "2", "-n", number, status=64)
            self.assertIn(f"-n wants a whole number of points, not '{number}'", text)
        self.assertIn("--trim", self.complaint("delaunay", self.uniform(2, 5), "--trim", "1e400", status=64))
        self.assertIn("tolerance", self.complaint("hull", self.uniform(2, 5), "--tolerance", "1e400"))
        self.assertIn("1e400", self.complaint("halfspaces", self.uniform(3, 5), "--interior", "1e400,0"))

    def test_examples_of_the_help_run(self):
        self.file("points.csv", "x,y\n0,0\n4,0\n0,3\n4,4\n2,1\n")
        self.file("table.csv", "x,y,w\n0,0,1\n4,0,2\n0,3,0.5\n4,4,0\n2,1,0.25\n")
        self.file("places.csv", "x,y\n1,1\n3,2\n")
        with open(self.path("delone"), "w") as link:
            link.write(f'#!/bin/sh\nexec {shlex.quote(DELONE)} "$@"\n')
        os.chmod(self.path("delone"), 0o755)
        environment = {**os.environ, "PATH": self.folder.name + os.pathsep + os.environ["PATH"]}
        for command in ["", *COMMANDS]:
            lines = self.output(*command.split(), "--help").split("\nExamples:\n")[1]
            self.assertIn(f"delone {command}", lines)
            self.assertLessEqual(max(map(len, lines.splitlines())), 67)  # in a man page of 80 columns
            done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", lines], cwd=self.folder.name, env=environment, capture_output=True, text=True, timeout=120)
            self.assertEqual((done.returncode, done.stderr), (0, ""), lines)

    def test_exit_statuses_are_those_of_the_documentation(self):
        with open(os.path.join(os.path.dirname(__file__), "../../docs/guide.md"), encoding="utf-8") as file:
            table = file.read().split("| status | meaning |\n")[1].split("\n\n")[0]
        documented = re.findall(r"\d+", " ".join(row.split("|")[1] for row in table.splitlines()))
        self.assertEqual(documented, ["0", "1", "2", "3", "64", "130", "143", "141"])
        listed = self.output("--help").split("Exit status:")[1].split("\n\n")[0]
        self.assertEqual(re.findall(r"\b\d+\b", listed), documented)


if __name__ == "__main__":
    unittest.main()
