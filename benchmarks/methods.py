#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times the two methods of conversions of polyhedra, each alone, and the choice between them, on the sets of polyhedra_families.py.

  benchmarks/methods.py build/bench                        all sets
  benchmarks/methods.py build/bench --set unseen torus     members of one set whose names contain a word
  benchmarks/methods.py build/bench --record               also benchmarks/history/DATE-COMMIT-methods.json

Figures are seconds of processor time of the conversion of the cone, with one thread, the least of the rounds; the three take turns. "steps" is the double
description, "insertion" that of points or halfspaces; "-" where it does not suit the input. A method that takes more than --patience times as long as
the choice, and at least a second, is stopped: ">" and that time. "ratio" is the time of the choice over that of the better method, and "lost" the seconds between
them. All that end must find the same number of rays."""
import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile

import polyhedra_families as families
import record

METHODS = ("chosen", "steps", "insertion")


def run(program, method, path, seconds):
    """(rays, seconds), or what is printed instead of seconds."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 1))
    done = subprocess.run([program, method, path], capture_output=True, text=True, preexec_fn=limit, check=False)
    if done.returncode < 0:
        return f">{int(seconds) + 1}"
    if done.returncode != 0:
        sys.exit(f"{path.name}, {method}: {done.stderr}")
    if done.stdout.strip() == "none":
        return "-"
    rays, time = done.stdout.split()
    return int(rays), float(time)


def measure(program, path, rounds, patience):
    """{method: seconds or a text}, and the number of rays."""
    times, counts = {method: [] for method in METHODS}, set()
    figures = {}
    for _ in range(rounds):
        for method in METHODS:
            if method in figures:
                continue
            limit = 60 if method == "chosen" else max(1, patience * times["chosen"][-1]) if times["chosen"] else 1
            answer = run(program, method, path, limit)
            if isinstance(answer, str):
                figures[method] = answer
            else:
                counts.add(answer[0])
                times[method].append(answer[1])
        if sum(map(sum, times.values())) > 5:
            break
    if len(counts) > 1:
        sys.exit(f"{path.name}: different numbers of rays: {sorted(counts)}")
    return {method: figures.get(method) or min(times[method]) for method in METHODS}, max(counts, default=0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--set", choices=families.SETS)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--patience", type=float, default=4)
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_intermixed_args()
    program = options.build / "benchmarks" / "internal" / "delone_benchmark_conversion"
    results = {}
    print(f"{'polyhedron':<20}{'rays':>8}" + "".join(f"{method:>11}" for method in METHODS) + f"{'ratio':>8}{'lost':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for which, members in families.SETS.items():
            for name, make in members.items():
                if options.set not in (None, which) or not all(word in name for word in options.words):
                    continue
                description = make()
                path = pathlib.Path(folder) / f"{name}.{'ine' if isinstance(description, families.H) else 'ext'}"
                families.write(description, path)
                figures, rays = measure(program, path, options.rounds, options.patience)
                results.setdefault(which, {})[name] = {"rays": rays, **figures}
                cells = "".join(f"{time:>11.4f}" if isinstance(time, float) else f"{time:>11}" for time in figures.values())
                alone = [figures[method] for method in METHODS[1:] if isinstance(figures[method], float)]
                if alone and isinstance(figures["chosen"], float):
                    cells += f"{figures['chosen'] / max(min(alone), 1e-4):>8.2f}{figures['chosen'] - min(alone):>9.4f}"
                print(f"{name:<20}{rays:>8}{cells}", flush=True)
    if options.record:
        print("recorded in", record.write("methods", program, results).relative_to(record.ROOT))


if __name__ == "__main__":
    main()
