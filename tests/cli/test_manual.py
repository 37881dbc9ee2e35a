# SPDX-License-Identifier: BSD-3-Clause
"""Man pages and completions that tools/command_manual.py makes: complete, well formed, and completing. Shells that are missing are left out."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import command_manual as manual  # noqa: E402

DELONE = os.path.abspath(os.environ["DELONE"])
has = shutil.which


def run(*arguments, **more):
    return subprocess.run(arguments, capture_output=True, text=True, timeout=60, **more)


class Reading(unittest.TestCase):
    def test_forms_of_options(self):
        for left, expected in {
            "-q,--quiet": manual.Option(["-q", "--quiet"]),
            "--weights COLUMN|FILE REQUIRED": manual.Option(["--weights"], "COLUMN|FILE", required=True),
            "--format TEXT:{npy,csv}": manual.Option(["--format"], "WORD", ["npy", "csv"]),
            "-d,--dimension INT:INT in [1 - 9] REQUIRED": manual.Option(["-d", "--dimension"], "N", limits="From 1 to 9", required=True),
            "--unit LENGTH:POSITIVE Needs: --lattice": manual.Option(["--unit"], "LENGTH", limits="Above 0"),
            "--lower Excludes: --upper": manual.Option(["--lower"], excludes=["--upper"]),
            "--box LOW,...,HIGH,... ...": manual.Option(["--box"], "LOW,...,HIGH,...", repeated=True),
            "IN REQUIRED": manual.Option(["IN"], "IN", required=True),
            "IN": manual.Option(["IN"], "IN"),
        }.items():
            self.assertEqual(manual.parse_option(left, ""), expected, left)
        self.assertRaises(manual.HelpError, manual.parse_option, "--a one two three", "")

    def test_other_help_is_refused(self):
        for text in ("", "usage: cp FILE FILE\n\n  -h, --help  print this\n", "Usage: a\nOptions:\n  --help  print this\n"):
            self.assertRaises(manual.HelpError, manual.parse_help, "a", text)
        done = run(sys.executable, ROOT / "tools" / "command_manual.py", "/bin/true")
        self.assertEqual(done.returncode, 1)
        self.assertIn("command_manual.py: the help of 'true' has no line", done.stderr)

    def test_text_is_not_interpreted(self):
        self.assertEqual(manual.roff(".a-b\\c 'd' d≤3"), "\\&.a\\-b\\ec \\(aqd\\(aq d\\[u2264]3")
        self.assertEqual(manual.markdown("a*b_<c>"), "a\\*b\\_\\<c\\>")


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="delone_manual_")
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.version, cls.top, cls.others = manual.describe([DELONE])
        done = run(sys.executable, ROOT / "tools" / "command_manual.py", DELONE, *(w for what in ("man", "completions", "markdown")
                                                                                   for w in (f"--{what}", cls.folder / what)))
        assert done.returncode == 0, done.stderr
        cls.bash, cls.zsh, cls.fish = (cls.folder / "completions" / name for name in ("bash/delone", "zsh/_delone", "fish/delone.fish"))

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_everything_that_the_help_lists_is_there(self):
        self.assertGreaterEqual(len(self.others), 10)
        bash, zsh, fish = (path.read_text() for path in (self.bash, self.zsh, self.fish))
        for command in [self.top, *self.others]:
            help_text = run(DELONE, *command.name.split()[1:], "--help").stdout
            listed = re.findall(r"--?[a-z][\w-]*", " ".join(re.findall(r"^  (-\S+)", help_text, re.M)).replace(",", " "))
            self.assertEqual(sorted(listed), sorted(name for option in command.options for name in option.names), command.name)
            page = command.name.replace(" ", "-")
            man, markdown = (self.folder / "man" / f"{page}.1").read_text(), (self.folder / "markdown" / f"{page}.md").read_text()
            for option in command.options:
                for name in option.names:
                    self.assertIn(f"\\fB{manual.roff(name)}\\fR", man)
                    self.assertIn(f"`{name}`", markdown)
                    self.assertIn(name, bash)
                    self.assertIn(name, zsh)
                    self.assertIn(f" -l {name[2:]} " if name.startswith("--") else f" -s {name[1:]} ", fish)
        kinds = next(c for c in self.others if c.name == "delone generate").positionals[0].choices
        self.assertTrue({"ball", "tilted_grid", "uniform"} <= set(kinds), kinds)

    def test_values_in_the_help_are_those_of_the_parser(self):
        for command in self.others:
            for option in command.options:
                if option.choices or option.limits:
                    limit = int(option.limits.split()[-1]) if option.limits else 0
                    bad = "no_such_word" if option.choices else str(limit if option.limits.startswith("Above") else limit + 1)
                    done = run(DELONE, *command.name.split()[1:], option.names[-1], bad)
                    self.assertEqual(done.returncode, 64, (command.name, option.names))
                    self.assertIn(option.names[-1], done.stderr)

    @unittest.skipUnless(has("groff"), "groff is not installed")
    def test_man_pages_are_clean(self):
        for path in sorted((self.folder / "man").iterdir()):
            done = run("groff", "-man", "-ww", "-z", "-Tutf8", path)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""), path.name)
            if has("lexgrog"):  # what makes the index that `man -k` searches
                self.assertIn(f'"{path.stem} - ', run("lexgrog", path).stdout)
            if has("man"):
                done = run("man", "--warnings", "-l", path, env={**os.environ, "LC_ALL": "C.UTF-8", "MANPAGER": "cat", "MANWIDTH": "80"})
                self.assertEqual(done.stderr, "", path.name)
                self.assertLessEqual(max(map(len, re.sub(".\b", "", done.stdout).splitlines())), 80)

    def complete_in_bash(self, *words):
        script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _delone; printf "%s\\n" "${COMPREPLY[@]}"'
        done = run("bash", "-c", script, "bash", self.bash, *words, cwd=ROOT / "data")
        self.assertEqual(done.stderr, "", words)
        return done.stdout.split()

    def test_bash(self):
        self.assertEqual(run("bash", "-n", self.bash).stderr, "")
        for words, expected in {
            ("delone", "h"): ["hull", "halfspaces"],
            ("delone", "--v"): ["--version"],
            ("delone", "hull", "--lo"): ["--lower"],
            ("delone", "hull", "--format", "x"): ["xyz"],
            ("delone", "hull", "--format", "=", "x"): ["xyz"],
            ("delone", "voronoi", "--output-format", "="): ["npz", "json", "svg", "vtu", "html"],
            ("delone", "generate", "g"): ["gaussian", "grid"],
            ("delone", "hull", "prot"): ["protein.csv"],
            ("delone", "hull", "-o", "prot"): ["protein.csv"],
            ("delone", "hull", "--seed", ""): [],
            ("delone", "unheard_of", "prot"): [],
        }.items():
            self.assertEqual(self.complete_in_bash(*words), expected, words)

    @unittest.skipUnless(has("zsh"), "zsh is not installed")
    def test_zsh(self):
        done = run("zsh", "-f", "-n", self.zsh)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        # _arguments refuses ill-formed specifications only when it runs; this stand-in sees what it would get.
        script = ('_describe() { : }; _files() { : }; _arguments() { print -rl -- "$@"; state=arguments; line=($word) }; '
                  'word=hull; source "$1"; exit 0')
        done = run("zsh", "-f", "-c", script, "zsh", self.zsh)
        self.assertEqual(done.stderr, "")
        self.assertIn("(--lower --qhull --upper)--lower[Only the facets that face down along the last coordinate, which may be the energy of a composition; "
                      "if fractions sum to 1, leave one out.]", done.stdout.split("\n"))
        self.assertIn("--order=[Insertion order; the result does not depend on it.]:WORD:(automatic as_given shuffled)", done.stdout.split("\n"))
        self.assertIn("1:IN:_files", done.stdout.split("\n"))

    @unittest.skipUnless(has("fish"), "fish is not installed")
    def test_fish(self):
        self.assertEqual(run("fish", "--no-config", "-n", self.fish).stderr, "")
        asked = {"delone h": ["halfspaces", "hull"], "delone hull --lo": ["--lower"], "delone hull --format x": ["xyz"],
                 "delone generate g": ["gaussian", "grid"], "delone hull prot": ["protein.csv"], "delone hull --seed ": []}
        script = f"source {self.fish}; " + "".join(f"echo '=={line}'; complete -C '{line}'; " for line in asked)
        done = run("fish", "--no-config", "-c", script, cwd=ROOT / "data", env={**os.environ, "HOME": self.scratch.name})
        self.assertEqual(done.stderr, "")
        answers = {part.split("\n")[0]: [line.split("\t")[0] for line in part.split("\n")[1:] if line] for part in done.stdout.split("==")[1:]}
        self.assertEqual({line: sorted(words) for line, words in answers.items()}, asked)


if __name__ == "__main__":
    unittest.main()
