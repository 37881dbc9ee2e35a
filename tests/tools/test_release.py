# SPDX-License-Identifier: BSD-3-Clause
"""tools/release.py on copies of the tree's files: one that could be released, and each with one fault.

  python3 tests/tools/test_release.py [unittest arguments]
"""
import datetime
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import yaml  # noqa: F401  (release.py reads CITATION.cff with it)
except ImportError as missing:
    print(f"skipped: {missing}", file=sys.stderr)
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import release  # noqa: E402

FILES = ("CMakeLists.txt", "CITATION.cff", "CHANGELOG.md", "pyproject.toml", "setup.py", "README.md", "docs/guide.md", "LICENSE", "SECURITY.md", "CONTRIBUTING.md")
TODAY = datetime.date(2030, 6, 15)
STEPS_OF_FILES = ("versions", "changelog", "citation", "papers", "clean", "tag")


class Release(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="delone_release_test_")
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        for name in FILES:
            (self.root / name).parent.mkdir(exist_ok=True)
            shutil.copy2(ROOT / name, self.root / name)
        self.tree = release.Tree(self.root, today=TODAY)
        self.version = self.tree.version
        # As on the day of a release.
        self.edit("CHANGELOG.md", r"^## \[[^\]]+\].*$", f"## [{self.version}] – 2030-06-14")
        citation = re.sub(r"^date-released:.*\n", "", (self.root / "CITATION.cff").read_text(), flags=re.M)
        (self.root / "CITATION.cff").write_text(citation + "date-released: 2030-06-14\n")
        self.git("init", "-q")
        self.git("config", "user.name", "A")
        self.git("config", "user.email", "a@example.org")
        self.commit()

    def git(self, *arguments):
        subprocess.run(["git", *arguments], cwd=self.root, check=True, stdout=subprocess.DEVNULL)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", "all")

    def edit(self, name, pattern, replacement):
        path = self.root / name
        text, count = re.subn(pattern, replacement, path.read_text(encoding="utf-8"), count=1, flags=re.M)
        self.assertEqual(count, 1, f"{name} has no {pattern}")
        path.write_text(text, encoding="utf-8")

    def found(self, steps=STEPS_OF_FILES):
        return [fault for step in steps for fault in release.STEPS[step][1](self.tree)]

    def test_a_tree_that_can_be_released(self):
        self.assertEqual(self.found(), [])

    def test_files_with_one_fault(self):
        major, minor, patch = self.version.split(".")
        cases = [
            ("CITATION.cff", r"^version: .*", "version: 9.9.9", "CITATION.cff: 9.9.9, and not"),
            ("CITATION.cff", r"^version: .*\n", "", "CITATION.cff: no version"),
            ("CITATION.cff", r"^date-released: .*", "date-released: 2030-06-13", "but CHANGELOG.md says 2030-06-14"),
            ("CITATION.cff", r"^date-released: .*", "", "date-released is missing"),
            ("CITATION.cff", r"^title: .*\n", "", "title is missing"),
            ("CITATION.cff", r"^license: .*", "license: MIT", "the license is not"),
            ("CITATION.cff", r"^keywords:", "key-words:", "there is no key key-words"),
            ("CITATION.cff", r"^cff-version: .*", "cff-version: 1.1.0", "cff-version is not"),
            ("CITATION.cff", r"- name: The delone authors", "- nick: The delone authors", "an author is"),
            ("CITATION.cff", r"^    doi: .*", "    doi: https://doi.org/10.1016/x", ": doi https"),
            ("CITATION.cff", r"type: report", "type: memo", "type memo"),
            ("CITATION.cff", r"^title: .*", "title: [", "CITATION.cff: "),
            ("CHANGELOG.md", r"^(## \[.*\]) – .*", r"\1 – unreleased", "the date of"),
            ("CHANGELOG.md", r"^(## \[.*\]) – .*", r"\1", "the date of"),
            ("CHANGELOG.md", r"^(## \[.*\]) – .*", r"\1 – 2030-06-31", "the date of"),
            ("CHANGELOG.md", r"^(## \[.*\]) – .*", r"\1 – 2030-06-16", "yet to come"),
            ("CHANGELOG.md", r"^## \[.*\]", "## [9.9.9]", "the newest section is [9.9.9]"),
            ("CHANGELOG.md", r"^## \[", "## [Unreleased]\n\n- More\n\n## [", "the section [Unreleased] is not empty"),
            ("CHANGELOG.md", r"^## .*(?:.*\n)*", f"## [{self.version}] – 2030-06-14\n", "lists no changes"),
            ("CHANGELOG.md", r"^## .*(?:.*\n)*", "", "no section"),
            ("CHANGELOG.md", r"^- ", "- More\n" * 90 + "- ", "one page, are the most"),
            ("CMakeLists.txt", r"delone VERSION [\d.]+", "delone VERSION 0.1", "CMakeLists.txt has no line"),
            ("CMakeLists.txt", r"delone VERSION [\d.]+", f"delone VERSION {major}.{minor}.{int(patch) + 1}", "CITATION.cff: "),
            ("README.md", r"find_package\(delone [\d.]+", "find_package(delone 0.0", "README.md: 0.0, and not"),
            ("docs/guide.md", r"find_package\(delone [\d.]+", "find_package(delone 0.0", "docs/guide.md: 0.0, and not"),
            ("pyproject.toml", r"^dynamic = .*", 'version = "0.1.0"', "'version' is not dynamic"),
            ("SECURITY.md", r"^## How to report", "## Reports", "no section 'How to report'"),
        ]
        for name, pattern, replacement, expected in cases:
            with self.subTest(f"{name}: {replacement}"):
                whole = (self.root / name).read_text(encoding="utf-8")
                self.edit(name, pattern, replacement)
                self.assertTrue(any(expected in fault for fault in self.found(("versions", "changelog", "citation", "papers"))), self.found())
                (self.root / name).write_text(whole, encoding="utf-8")
        self.assertEqual(self.found(), [])

    def test_an_empty_unreleased_section_is_none(self):
        self.edit("CHANGELOG.md", r"^## \[", "## [Unreleased]\n\n## [")
        self.assertEqual(self.found(("changelog", "citation")), [])

    def test_recipes_that_come_later(self):
        (self.root / "packaging" / "conda").mkdir(parents=True)
        recipe = self.root / "packaging" / "conda" / "meta.yaml"
        recipe.write_text(f'{{% set version = "{self.version}" %}}\n')
        self.assertEqual(self.found(("versions",)), [])
        recipe.write_text('{% set version = "9.9.9" %}\n')
        self.assertEqual(self.found(("versions",)), [f"packaging/conda/meta.yaml: 9.9.9, and not {self.version}"])

    def test_changes_and_tags(self):
        (self.root / "new").write_text("")
        self.assertEqual(self.found(("clean",)), ["not committed: ?? new"])
        self.commit()
        self.assertEqual(self.found(("clean", "tag")), [])
        self.git("tag", "v0.0.9")
        self.assertEqual(self.found(("tag",)), [])
        self.git("tag", "v10.0.0")
        self.git("tag", f"v{self.version}")
        self.assertEqual(self.found(("tag",)), [f"the tag v{self.version} exists", f"v10.0.0 is newer than v{self.version}"])

    def test_a_missing_paper(self):
        (self.root / "LICENSE").unlink()
        self.assertEqual(self.found(("papers",)), ["there is no LICENSE"])

    def test_the_command_of_the_build(self):
        self.tree.build = self.root / "build"
        self.assertIn("there is no", self.found(("versions",))[0])
        self.tree.build.mkdir()
        command = self.tree.build / "delone"
        for said, faults in ((self.version, 0), ("9.9.9", 1)):
            command.write_text(f"#!/bin/sh\necho delone {said}\n")
            command.chmod(0o755)
            self.assertEqual(len(self.found(("versions",))), faults)

    # A package of the same name whose build takes no compiler: setup.py of a few lines.
    SETUP = "from setuptools import setup\nsetup(name='delone', version='{}', py_modules=['delone'])\n"

    @unittest.skipUnless(importlib.util.find_spec("setuptools"), "this Python has no setuptools")
    def test_a_source_distribution_without_sources(self):
        (self.root / "pyproject.toml").unlink()
        (self.root / "setup.py").write_text(self.SETUP.format(self.version))
        (self.root / "delone.py").write_text("")
        (self.root / "src").mkdir()
        (self.root / "src" / "a.cpp").write_text("")
        self.commit()
        self.assertRegex(" ".join(self.found(("sdist",))), r"delone-\S+\.tar\.gz: \d+ of \d+ files are missing, .*")
        (self.root / "MANIFEST.in").write_text("graft src\ngraft docs\ninclude CMakeLists.txt LICENSE README.md\n")
        self.commit()
        self.assertEqual(self.found(("sdist",)), [])
        (self.root / "setup.py").write_text(self.SETUP.format("9.9.9"))
        self.commit()
        self.assertEqual(self.found(("sdist",)), [f"delone-9.9.9.tar.gz is not of version {self.version}"])

    @unittest.skipUnless(importlib.util.find_spec("pip") and importlib.util.find_spec("wheel"), "this Python has no pip or no wheel")
    def test_a_wheel_without_a_module(self):
        (self.root / "pyproject.toml").unlink()
        (self.root / "setup.py").write_text(self.SETUP.format(self.version))
        (self.root / "delone.py").write_text("")
        self.commit()
        name = f"delone-{self.version}-py3-none-any.whl"
        self.assertEqual(self.found(("wheel",)), [f"{name} has no compiled module", f"{name} has no py.typed"])
        (self.root / "setup.py").write_text("raise SystemExit('no compiler')\n")
        self.commit()
        self.assertIn("pip wheel failed", self.found(("wheel",))[0])

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, "-B", ROOT / "tools" / "release.py", "--tree", self.root, *arguments], capture_output=True, text=True)

    def test_dry_run_changes_nothing(self):
        self.edit("CHANGELOG.md", r"2030-06-14", "2020-06-14")
        self.edit("CITATION.cff", r"2030-06-14", "2020-06-14")
        self.commit()
        done = self.run_script("--dry-run", "--skip", "docs,sdist,wheel")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"1.  git tag --annotate v{self.version}", done.stdout)
        self.assertEqual(self.found(("clean", "tag")), [])
        (self.root / "new").write_text("")
        done = self.run_script("--dry-run", "--skip", "docs,sdist,wheel")
        self.assertEqual((done.returncode, done.stderr), (1, "release.py: 1 fault(s); nothing was done\n"))
        self.assertIn("not committed: ?? new", done.stdout)

    def test_the_tag_has_to_be_asked_for(self):
        done = self.run_script("--skip", "docs,sdist,wheel")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--tag", done.stderr)

    def test_steps_are_left_out_in_a_dry_run_only(self):
        self.assertIn("only with --dry-run", self.run_script("--tag", "--skip", "docs").stderr)
        self.assertIn("there is no step dosc", self.run_script("--dry-run", "--skip", "dosc").stderr)


class Here(unittest.TestCase):
    def test_citation(self):
        self.assertEqual(release.citation_faults((ROOT / "CITATION.cff").read_text(encoding="utf-8")), [])

    def test_versions_and_papers(self):
        tree = release.Tree(ROOT)
        self.assertEqual(release.check_versions(tree) + release.check_papers(tree), [])


if __name__ == "__main__":
    unittest.main()
