#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs Octave's own tests of delaunayn, convhulln and others with the functions of the package in their places.

Usage: own_tests.py FOLDER ...     the folders of the installed package: one has +delone and shadow, one the compiled function

The tests are the %! blocks of Octave's files, which are read where Octave is installed. REASONS has those that cannot pass, each by
words of its own, and why. Exit status 1 if another fails, or if one of these passes.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import time

FUNCTIONS = ["delaunay", "delaunayn", "convhull", "convhulln", "voronoin", "tsearchn", "griddata", "griddatan"]

# (function, words of the test) -> why it cannot pass.
REASONS = {
    ("convhulln", 'convhulln (cube, "Qt")'): "which diagonal of a square face is taken depends on rounding in Qhull",
    ("griddata", '"natural" .* not yet implemented'): "natural neighbors are there",
    ("griddatan", '"natural" .* not yet implemented'): "natural neighbors are there",
}

BLOCK = re.compile(r"^%!(?:test|assert|error|warning|fail|shared|testif|function)\b.*(?:\n%!(?:[ \t].*|$))*", re.M)


def octave(*arguments, **how):
    return subprocess.run(["octave-cli", "--norc", "--no-history", *arguments], text=True, capture_output=True, check=True, **how).stdout


def source_of(function):
    """The file with the tests of a function: its own, or for a compiled one that of its tests."""
    code = f"printf ('%s\\n', which ('{function}'), fullfile (matlabroot (), 'share', 'octave', OCTAVE_VERSION, 'etc', 'tests'))"
    file, tests = map(pathlib.Path, octave("--eval", code).split())
    return file if file.suffix == ".m" else next(tests.rglob(f"{function}.cc-tst"))


def blocks_of(text):
    """The tests of a file, each with the shared variables that come before it."""
    shared = ""
    for found in BLOCK.finditer(text):
        if found.group().startswith("%!shared"):
            shared = found.group() + "\n"
        else:
            yield shared + found.group() + "\n"


def reason_of(function, block):
    reasons = [why for (of, words), why in REASONS.items() if of == function and words in block]
    return reasons[0] if reasons else None


def run(folders, tests):
    """Whether each test passes, and what it prints if not."""
    with tempfile.TemporaryDirectory(prefix="delone_octave_") as scratch:
        for number, (_, block) in enumerate(tests):
            pathlib.Path(scratch, f"test_{number}.tst").write_text(block, encoding="utf-8")
        script = pathlib.Path(scratch, "run.m")
        script.write_text(f"""
            warning ("off", "Octave:shadowed-function");
            {" ".join(f'addpath ("{folder}");' for folder in folders)}
            delone.shadow ("on");
            for i = 0:{len(tests) - 1}
              file = sprintf ("{scratch}/test_%d", i);
              log = fopen ([file, ".log"], "w");
              [passed, total] = test ([file, ".tst"], "quiet", log);
              fprintf (log, "%d", passed == total && total > 0);
              fclose (log);
            endfor
        """, encoding="utf-8")
        octave(str(script))
        logs = [pathlib.Path(scratch, f"test_{i}.log").read_text(encoding="utf-8", errors="replace") for i in range(len(tests))]
        return [(log.endswith("1"), log[:-1]) for log in logs]


def main():
    tests = [(function, block) for function in FUNCTIONS for block in blocks_of(source_of(function).read_text(encoding="utf-8"))]
    start = time.monotonic()
    outcomes = run(sys.argv[1:], tests)
    bad, explained = 0, 0
    for (function, block), (ok, log) in zip(tests, outcomes):
        why = reason_of(function, block)
        explained += why is not None and not ok
        if ok == (why is not None):
            bad += 1
            print(f"{function}: " + (f"passes, but is listed with the reason that {why}\n{block}" if ok else f"fails\n{log}"))
    unknown = [key for key in REASONS if not any(key[0] == function and key[1] in block for function, block in tests)]
    for function, words in unknown:
        print(f"{function}: no test has the words {words!r}")
    passed = sum(ok for ok, _ in outcomes)
    print(f"{passed} passed, {bad} failed in {time.monotonic() - start:.1f}s; {explained} of Octave's tests cannot pass: see REASONS")
    sys.exit(1 if bad or unknown or len(outcomes) != len(tests) else 0)


if __name__ == "__main__":
    main()
