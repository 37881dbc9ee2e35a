#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mutation testing of the kernel: breaks one sign, tie order or bound at a time (mutants.py) and shows that a test fails.

Each mutant is one file of src/ in an overlay. Only the tests named for it are compiled again, without optimisation, and linked
with the library of a build directory; if none fails, so are the sources of src/kernel and src/geometry that include the file.
Tests are tried one after the other, the likeliest first, until one fails. Prints a table, and exits with status 1 if a mutant survives
that is not listed as equivalent.

Usage: mutate.py [--build build/test] [--work build/mutation] [--only WORD] [--table FILE] [--skip FILE] [--list]
  --only WORD        mutants whose file or name contains it
  --table FILE       appends a line for each mutant: name, kind, test that fails (or survives)
  --skip FILE        leaves out the mutants of that table: to go on after an interruption
  --list             only says whether each mutant has one place in the sources; exits with status 1 if not
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import time

from mutants import EQUIVALENT, MUTANTS, TESTS

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CAMPAIGN = "tests/campaign/predicate_campaign.cpp"
FLAGS = ["-std=gnu++20", "-O0", "-w", "-DNDEBUG", "-DDELONE_LARGEST_COMPILED_DIMENSION=8", "-DDELONE_LEAST_WRAPPED_DIMENSION=2",
         "-DHWY_COMPILE_ONLY_STATIC", "-ffp-contract=off", "-fno-fast-math", f'-DDELONE_DATA_DIR="{ROOT}/data"']
RECOMPILED_ROOMS = ("src/kernel", "src/geometry")


def included(path, seen):
    """The files of src/ that a file includes, itself too."""
    if path in seen:
        return seen
    seen.add(path)
    for name in re.findall(r'#\s*include\s*"([^"]+)"', (ROOT / path).read_text()):
        for folder in ("src", "tests/support", str(pathlib.Path(path).parent)):
            if (ROOT / folder / name).exists():
                included(str(pathlib.Path(folder) / name), seen)
                break
    return seen


class Workshop:
    def __init__(self, build, work):
        self.build, self.work = build, work
        work.mkdir(parents=True, exist_ok=True)
        self.overlay = work / "overlay"
        self.includes = [f"-I{self.overlay}"] + [f"-I{ROOT / folder}" for folder in ("tests/support", "src", "include")]
        self.includes.append(f"-I{build / 'include'}")
        self.sources = [str(path.relative_to(ROOT)) for room in RECOMPILED_ROOMS for path in (ROOT / room).glob("**/*.cpp")]
        self.depends = {path: included(path, set()) for path in self.sources}
        self.fresh = set()  # the objects that have been made for the present mutant
        self.header = work / "precompiled.hpp"
        text = "#include <gmock/gmock.h>\n#include <gtest/gtest.h>\n#include <boost/multiprecision/cpp_int.hpp>\n"
        if not self.header.exists() or self.header.read_text() != text:
            self.header.write_text(text)
            self.compile(self.header, work / "precompiled.hpp.gch", ["-x", "c++-header"])

    def compile(self, source, output, options=()):
        command = ["g++", *FLAGS, *options, *self.includes, "-c", str(source), "-o", str(output)]
        return subprocess.run(command, capture_output=True, text=True)

    def object_of(self, path, mutated, is_test):
        """The object of a source; kept between mutants if it does not see the mutated file."""
        seen = mutated in included(path, set())
        name = path.replace("/", "+") + (".mutant.o" if seen else ".o")
        output = self.work / name
        source = self.overlay / path.removeprefix("src/") if path == mutated else ROOT / path
        if output in self.fresh:
            return output
        if seen:
            self.fresh.add(output)
        if seen or not output.exists() or output.stat().st_mtime < (ROOT / path).stat().st_mtime:
            done = self.compile(source, output, ["-include", str(self.header)] if is_test else [])
            if done.returncode != 0:
                raise RuntimeError(done.stderr[-2000:])
        return output

    def apply(self, file, old, new):
        shutil.rmtree(self.overlay, ignore_errors=True)
        self.fresh.clear()
        text = (ROOT / file).read_text()
        if text.count(old) != 1:
            raise RuntimeError(f"{file}: {text.count(old)} places for {old!r}")
        target = self.overlay / file.removeprefix("src/")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text.replace(old, new))

    def fails(self, file, test, all_sources):
        """Whether the test fails with the mutated file: in the test and, of the library, in the file itself or in all sources."""
        is_campaign = test == CAMPAIGN
        objects = [self.object_of(test, file, not is_campaign)]
        objects += [self.object_of(path, file, False) for path in self.sources
                    if path == file or (all_sources and file in self.depends[path])]
        program = self.work / "mutant"
        # A library whose sources were joined has the rest of a file in the object of its neighbors: the first definition, the mutant's, is taken.
        command = ["g++", "-Wl,--allow-multiple-definition", *map(str, objects), str(self.build / "src/libdelone.a"), "-lhwy", "-lfmt", "-ltbb", "-lz", "-o", str(program)]
        if not is_campaign:
            command += ["-lgmock", "-lgtest", "-lgtest_main", "-lpthread"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(done.stderr[-2000:])
        arguments = ["--calls", "1000000"] if is_campaign else ["--gtest_brief=1", "--gtest_fail_fast"]
        try:
            return subprocess.run([str(program), *arguments], capture_output=True, timeout=900).returncode != 0
        except subprocess.TimeoutExpired:
            return True  # a walk without end


def list_places():
    """Whether each mutant has one place in the sources, and its file has tests."""
    misplaced = 0
    for file, name, kind, old, _ in MUTANTS:
        places = (ROOT / file).read_text().count(old)
        misplaced += places != 1 or file not in TESTS
        print(f"{file}\t{name}\t{kind}" + ("" if places == 1 else f"\t{places} places") + ("" if file in TESTS else "\tno tests"))
    return 1 if misplaced else 0


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--build", default="build/test")
    parser.add_argument("--work", default="build/mutation")
    parser.add_argument("--only", default="")
    parser.add_argument("--table")
    parser.add_argument("--skip")
    parser.add_argument("--list", action="store_true")
    given = parser.parse_args()
    if given.list:
        return list_places()
    known = {line.split("\t")[0] for line in open(given.skip)} if given.skip and pathlib.Path(given.skip).exists() else set()
    workshop = Workshop((ROOT / given.build).resolve(), (ROOT / given.work).resolve())
    survivors = 0
    for file, name, kind, old, new in sorted(MUTANTS, key=lambda mutant: mutant[2] == "bound"):  # these take longest
        label = f"{file.removeprefix('src/')}: {name}"
        if given.only not in label or label in known:
            continue
        start = time.monotonic()
        workshop.apply(file, old, new)
        verdict = None
        # Most mutants of headers fail in what a test compiles of them; the library is compiled for the others.
        for test, all_sources in [(test, False) for test in TESTS[file]] + [(test, True) for test in TESTS[file]]:
            try:
                if workshop.fails(file, test, all_sources):
                    verdict = pathlib.Path(test).name
                    break
            except RuntimeError as error:
                verdict = "does not compile: " + str(error).strip().splitlines()[0]
                print(error, file=sys.stderr)
                break
        if verdict is None and label in EQUIVALENT:
            verdict = "equivalent: " + EQUIVALENT[label]
        if verdict is None or verdict.startswith("does not"):
            survivors += 1
        line = f"{label}\t{kind}\t{verdict or 'SURVIVES'}\t{time.monotonic() - start:.0f} s"
        print(line, flush=True)
        if given.table:
            with open(given.table, "a") as table:
                table.write(line + "\n")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
