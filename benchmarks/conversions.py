#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times `delone polyhedron` beside PPL, lrs and cddlib in rational numbers, on the sets of polyhedra_families.py.

  benchmarks/conversions.py build/bench                          all sets
  benchmarks/conversions.py build/bench --set held-out cross     members of one set whose names contain a word
  benchmarks/conversions.py build/bench --files FOLDER           files of integers instead, as those of cddlib
  benchmarks/conversions.py build/bench --record                 also benchmarks/history/DATE-COMMIT-conversions.json

Figures are seconds of user time of whole processes, reading included; the least of the rounds. Programs that take more than --patience times as
long as delone, and at least a fifth of a second, are stopped: ">" and that time. All that end must find the same number of rows. "ratio" is delone's time by
the best other one's."""
import argparse
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile

import polyhedra_families as families
import record

MEMORY = 6 << 30


class Stopped(Exception):
    """The program was stopped, or gave up."""


def run(command, seconds, stdin=None):
    """(user seconds, output) of a command. Raises Stopped after so many seconds of processor time."""
    def limit():
        signal.setitimer(signal.ITIMER_VIRTUAL, seconds)  # of user time; PPL has a use for the others
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 3, int(seconds) + 3))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    with tempfile.TemporaryFile() as out, open(stdin or os.devnull, "rb") as source:
        process = subprocess.Popen(command, stdin=source, stdout=out, stderr=subprocess.DEVNULL, preexec_fn=limit)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read().decode()
    if process.returncode in (-signal.SIGVTALRM, -signal.SIGXCPU, -signal.SIGKILL):
        raise Stopped(f">{seconds:.1f}")
    if process.returncode != 0:
        raise Stopped("fails")
    return usage.ru_utime, text


def by_delone(program, path, seconds):
    time, text = run([program, "polyhedron", path, "--stats"], seconds)
    found = json.loads(text)
    count = found["vertices"] + found["rays"] if path.suffix == ".ine" else found["inequalities"]
    return time, count


def by_ppl(program, path, seconds):
    time, text = run([program, path], seconds)
    counts = [int(n) for n in re.findall(r"(\d+) (?:vertices|rays|inequalities)", text)]
    return time, sum(counts)


def by_lrs(program, path, seconds):
    """Counts what it lists, without equations and lines. It may list a ray several times, and begin again with larger numbers."""
    time, text = run([program, path], seconds)
    linear = re.search(r"^linearity (\d+)", text, re.MULTILINE)
    rows = text.rsplit("begin", 1)[1].split("\nend", 1)[0].splitlines()[2:] if "begin" in text else []
    if "unbounded" in text and not rows:
        raise Stopped("fails")
    return time, len({row.strip() for row in rows}) - (int(linear[1]) if linear else 0)


def by_cddlib(program, path, seconds):
    time, text = run([program, "--rep"], seconds, stdin=path)
    begin = re.search(r"begin\s+(\d+)", text)
    linear = re.search(r"^linearity (\d+)", text, re.MULTILINE)
    if not begin:
        raise Stopped("fails")
    return time, int(begin[1]) - (int(linear[1]) if linear else 0)


def measure(path, programs, rounds, patience):
    """{program: seconds or the text of Stopped}. Exits if counts differ."""
    figures, counts = {}, {}
    for name, (adapter, program) in programs.items():
        limit = 60 if name == "delone" else max(0.2, patience * figures["delone"]) if isinstance(figures["delone"], float) else 10
        try:
            times = []
            for _ in range(rounds):
                time, counts[name] = adapter(program, path, limit)
                times.append(time)
                if time > 2:
                    break
            figures[name] = min(times)
        except Stopped as stopped:
            figures[name] = str(stopped)
    # cddlib counts the inequality at infinity, and an origin that is a cone's only vertex as none
    if "delone" in counts and any(abs(count - counts["delone"]) > 1 for count in counts.values()):
        sys.exit(f"{path.name}: different numbers of rows: {counts}")
    return figures, counts.get("delone", 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--set", choices=families.SETS)
    parser.add_argument("--files", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--patience", type=float, default=5)
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_intermixed_args()
    delone = next(path for path in (options.build / "cli" / "delone", options.build / "delone") if path.exists())
    programs = {"delone": (by_delone, delone), "ppl": (by_ppl, options.build / "rivals" / "polyhedra_ppl"), "lrs": (by_lrs, "lrs"), "cddlib": (by_cddlib, "cddexec_gmp")}
    results = {}
    print(f"{'polyhedron':<20}{'rows':>8}" + "".join(f"{name:>10}" for name in programs) + f"{'ratio':>8}")
    with tempfile.TemporaryDirectory() as folder:
        inputs = []
        if options.files:
            inputs = [("files", path) for path in sorted(options.files.glob("*.*")) if path.suffix in (".ine", ".ext")]
        else:
            for which, members in families.SETS.items():
                for name, make in members.items():
                    if options.set in (None, which) and all(word in name for word in options.words):
                        description = make()
                        path = pathlib.Path(folder) / f"{name}.{'ine' if isinstance(description, families.H) else 'ext'}"
                        families.write(description, path)
                        inputs.append((which, path))
        for which, path in inputs:
            figures, count = measure(path, programs, options.rounds, options.patience)
            others = [time for name, time in figures.items() if name != "delone" and isinstance(time, float)]
            ours = figures["delone"]
            ratio = ours / max(min(others), 1e-3) if others and isinstance(ours, float) else None
            results.setdefault(which, {})[path.stem] = {"rows": count, **figures}
            cells = "".join(f"{time:>10.3f}" if isinstance(time, float) else f"{time:>10}" for time in figures.values())
            print(f"{path.stem:<20}{count:>8}{cells}" + (f"{ratio:>8.2f}" if ratio is not None else f"{'':>8}"), flush=True)
    if options.record:
        print("recorded in", record.write("conversions", delone, results).relative_to(record.ROOT))


if __name__ == "__main__":
    main()
