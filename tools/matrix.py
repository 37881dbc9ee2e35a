#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs `make` for builds of other kinds, one after the other, and prints a table of what passed.

Usage: matrix.py [KIND ...]      all kinds by default; each is a target of the Makefile
       matrix.py --list

What a kind prints goes to build/matrix/KIND.log, and the table to build/matrix/table.txt. A kind that fails does not stop the others.
Exit status 1 if any failed. To try again from nothing, remove the kind's build directory and set CCACHE_DISABLE=1.
"""
import argparse
import dataclasses
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

KINDS = {
    "asan": "AddressSanitizer and UndefinedBehaviorSanitizer",
    "portable": "standard C++ only, without threads",
    "libcxx": "clang with libc++",
    "aarch64": "64-bit ARM, under QEMU",
    "mingw": "Windows by MinGW-w64, under Wine",
    "tsan": "ThreadSanitizer, tests with threads",
    "mpi": "tests of delone::mpi at full size",
    "r": "the R package, with the tests of package geometry",
    "wheels": "source distribution, wheel, clean environment",
    "trixie": "Debian 13: Python 3.13, NumPy 2, g++ 14",
    "packages": "Debian packages in a clean system",
    "octave": "the Octave package, and Octave's own tests",
    "js": "WebAssembly, in Node and in Chromium",
    "browser": "the site in Chromium",
}


@dataclasses.dataclass
class Outcome:
    kind: str
    passed: bool
    seconds: float
    tests: str

    def row(self):
        return [self.kind, "passed" if self.passed else "FAILED", f"{self.seconds / 60:.1f}", self.tests, KINDS[self.kind]]


def count_tests(text):
    """How many tests passed, as ctest, pytest, unittest and testthat say it."""
    passed = total = 0
    for failed, of in re.findall(r"^\d+% tests passed, (\d+) tests failed out of (\d+)", text, re.M):
        passed, total = passed + int(of) - int(failed), total + int(of)
    for line in re.findall(r"^=*(?: |)(\d+ (?:passed|failed).*) in [\d.]+s", text, re.M):
        counts = {word: int(number) for number, word in re.findall(r"(\d+) (passed|failed)", line)}
        passed, total = passed + counts.get("passed", 0), total + sum(counts.values())
    for number, failures in re.findall(r"^Ran (\d+) tests? in .*\n\n(?:OK|FAILED \(failures=(\d+)\))", text, re.M):
        passed, total = passed + int(number) - min(int(failures or 0), int(number)), total + int(number)
    for failures, successes in re.findall(r"^\[ FAIL (\d+) \| .* PASS (\d+) \]", text, re.M):
        passed, total = passed + int(successes), total + int(failures) + int(successes)
    for successes, failures in re.findall(r"^(\d+) passed, (\d+) failed$", text, re.M):
        passed, total = passed + int(successes), total + int(failures) + int(successes)
    return f"{passed}/{total}" if total else "–"


def run(kind, make="make"):
    log = ROOT / "build" / "matrix" / f"{kind}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    print(f"{kind}: {KINDS[kind]} …", flush=True)
    start = time.monotonic()
    with log.open("w", encoding="utf-8") as file:
        status = subprocess.run([make, kind], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT).returncode
    text = log.read_text(encoding="utf-8", errors="replace")
    if status:
        print("\n".join(text.splitlines()[-20:]) + f"\n{kind}: failed; all of it is in {log}", flush=True)
    return Outcome(kind, status == 0, time.monotonic() - start, count_tests(text))


def table(outcomes):
    total = sum(outcome.seconds for outcome in outcomes)
    rows = [["build", "result", "minutes", "tests", "what it is"], *(outcome.row() for outcome in outcomes),
            ["all", f"{sum(outcome.passed for outcome in outcomes)}/{len(outcomes)}", f"{total / 60:.1f}", "", ""]]
    widths = [max(map(len, column)) for column in zip(*rows)]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows)


def main():
    parser = argparse.ArgumentParser(description="Builds of other kinds, and a table of what passed.")
    parser.add_argument("kinds", nargs="*", metavar="KIND")
    parser.add_argument("--list", action="store_true", help="list the kinds and stop")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(f"{kind:12} {text}" for kind, text in KINDS.items()))
        return
    for kind in arguments.kinds:
        if kind not in KINDS:
            parser.error(f"there is no kind {kind}; there are: {', '.join(KINDS)}")
    outcomes = [run(kind) for kind in arguments.kinds or KINDS]
    text = table(outcomes)
    print("\n" + text)
    (ROOT / "build" / "matrix" / "table.txt").write_text(text + "\n", encoding="utf-8")
    sys.exit(any(not outcome.passed for outcome in outcomes))


if __name__ == "__main__":
    main()
