#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times the construction of Delaunay triangulations by the command, on the standard inputs, one thread.

  construction.py build/release/delone                     a table
  construction.py NEW --against OLD                        both in turn, input by input, and the ratios NEW/OLD
  construction.py build/release/delone --record            also benchmarks/history/DATE-COMMIT.json

Figures are medians over the rounds: seconds for ordering and building (reading and writing apart), nanoseconds per created cell
(building only), bytes reserved per cell, and the peak memory of the process. Quote ratios of one run, not seconds of two.
"""
import argparse
import datetime
import json
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent

# name -> (kind, dimension, number of points)
STANDARD = {
    "uniform 2D 1e6": ("uniform", 2, 1_000_000),
    "uniform 3D 1e6": ("uniform", 3, 1_000_000),
    "uniform 4D 1e5": ("uniform", 4, 100_000),
    "uniform 5D 1e4": ("uniform", 5, 10_000),
    "uniform 6D 1e3": ("uniform", 6, 1_000),
    "uniform 7D 1e3": ("uniform", 7, 1_000),
    "grid 100^3": ("grid", 3, 1_000_000),
    "grid 18^4": ("grid", 4, 104_976),
    "grid 8^5": ("grid", 5, 32_768),
}


def construct(command, path):
    """The statistics of one construction."""
    done = subprocess.run([command, "delaunay", path, "--stats", "--quiet"], check=True, capture_output=True, text=True)
    stats = json.loads(done.stdout)
    stats["construction_seconds"] = stats["seconds"]["order"] + stats["seconds"]["build"]
    stats["ns_per_created_cell"] = 1e9 * stats["seconds"]["build"] / stats["created_cells"]
    return stats


def summary(runs):
    """The figures of several runs on one input."""
    last = runs[-1]
    median = {key: statistics.median(run[key] for run in runs)
              for key in ("construction_seconds", "ns_per_created_cell", "bytes_per_cell", "peak_rss_bytes")}
    return {**median, **{key: last[key] for key in ("hash", "points", "cells", "infinite_cells", "created_cells", "stages")}}


def machine():
    try:
        model = next(line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    except (OSError, StopIteration):
        model = platform.processor()
    return f"{model}, {platform.system()} {platform.machine()}"


def cache_entry(command, name):
    """A variable of the CMake cache of the build that the command is from."""
    cache = pathlib.Path(command).resolve().parent / "CMakeCache.txt"
    for line in cache.read_text().splitlines() if cache.exists() else []:
        if line.startswith(name + ":"):
            return line.split("=", 1)[1]
    return "unknown"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--against", metavar="OLD", help="another build of the command")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", action="append", metavar="TEXT", help="inputs whose name contains TEXT")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_args()
    commands = [options.command] + ([options.against] if options.against else [])
    names = [name for name in STANDARD if not options.only or any(text in name for text in options.only)]

    print(f"{'input':<16}{'cells':>10}{'created':>11}{'seconds':>9}{'ns/cell':>9}{'B/cell':>8}{'peak MB':>9}  stages direct/exact/perturbed"
          + ("  ratio" if options.against else ""))
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            kind, dimension, n = STANDARD[name]
            path = f"{folder}/points.npy"
            subprocess.run([options.command, "generate", kind, "-d", str(dimension), "-n", str(n), "--seed", "1", "-o", path], check=True)
            runs = [[] for _ in commands]
            for _ in range(options.rounds):
                for which, command in enumerate(commands):
                    runs[which].append(construct(command, path))
            figures = results[name] = summary(runs[0])
            stages = figures["stages"]
            line = (f"{name:<16}{figures['cells']:>10}{figures['created_cells']:>11}{figures['construction_seconds']:>9.3f}"
                    f"{figures['ns_per_created_cell']:>9.1f}{figures['bytes_per_cell']:>8.1f}{figures['peak_rss_bytes'] / 1e6:>9.1f}"
                    f"  {stages['direct']}/{stages['exact']}/{stages['perturbed']}")
            if options.against:
                ratios = [new["construction_seconds"] / old["construction_seconds"] for new, old in zip(*runs)]
                figures["ratio"] = statistics.median(ratios)
                line += f"  {figures['ratio']:.3f}"
                if runs[0][-1]["hash"] != runs[1][-1]["hash"]:
                    sys.exit(f"{line}\nthe two builds disagree on {name}")
            print(line, flush=True)

    if options.record:
        commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True).stdout.strip()
        date = datetime.date.today().isoformat()
        record = {"date": date, "commit": commit, "machine": machine(), "threads": 1, "rounds": options.rounds,
                  "compiler": subprocess.run([cache_entry(options.command, "CMAKE_CXX_COMPILER"), "--version"], capture_output=True,
                                             text=True).stdout.split("\n")[0],
                  "flags": cache_entry(options.command, "CMAKE_CXX_FLAGS_RELEASE"), "results": results}
        history = ROOT / "benchmarks" / "history"
        history.mkdir(exist_ok=True)
        (history / f"{date}-{commit}.json").write_text(json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    main()
