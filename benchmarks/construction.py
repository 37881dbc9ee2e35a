#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times the construction of Delaunay triangulations by the command, on the standard inputs, one thread.

  construction.py build/release/delone                     a table
  construction.py NEW --against OLD                        both in turn, input by input, and the ratios NEW/OLD
  construction.py build/release/delone --record            also benchmarks/history/DATE-COMMIT-construction.json

Each round goes through all inputs. Figures are medians over the rounds, or least values where the column says so: seconds and
processor seconds (user and system) of ordering and building, nanoseconds of processor time per created cell of building, bytes
reserved per cell, and peak memory of the process. The command reports the wall time of reading, ordering, building and the rest;
the processor time of a run, less that of starting and ending the command, is split in the same proportions. `vs` divides the
nanoseconds per created cell by those of the reference input, which is uniform. Small inputs have a reference with as many points,
if so many are inserted and not wrapped. Quote ratios of one run, not seconds of two runs.
"""
import argparse
import functools
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import record

DATA = record.ROOT / "data"

# name -> (kind or file, dimension, points, reference); for a file, its columns instead of the dimension.
STANDARD = {
    "uniform 2D 1e6": ("uniform", 2, 1_000_000, None),
    "uniform 3D 1e6": ("uniform", 3, 1_000_000, None),
    "uniform 4D 1e5": ("uniform", 4, 100_000, None),
    "uniform 5D 1e4": ("uniform", 5, 10_000, None),
    "uniform 6D 1e3": ("uniform", 6, 1_000, None),
    "uniform 6D 4e3": ("uniform", 6, 4_000, None),
    "uniform 7D 1e3": ("uniform", 7, 1_000, None),
    "uniform 8D 256": ("uniform", 8, 256, None),
    "lattice 100^3": ("grid", 3, 1_000_000, "uniform 3D 1e6"),
    "lattice 18^4": ("grid", 4, 104_976, "uniform 4D 1e5"),
    "lattice 8^5": ("grid", 5, 32_768, "uniform 5D 1e4"),
    "lattice 5^6": ("grid", 6, 15_625, "uniform 6D 4e3"),
    "uniform 6D 64": ("uniform", 6, 64, None),
    "uniform 7D 128": ("uniform", 7, 128, None),
    "uniform 8D 90": ("uniform", 8, 90, None),
    "cube {0,1}^6": ("cube01", 6, 64, "uniform 6D 64"),
    "cube {0,1}^7": ("cube01", 7, 128, "uniform 7D 128"),
    "cube {0,1}^8": ("cube01", 8, 256, "uniform 8D 90"),
    "hypersurface 3D 1e5": ("manifold", 3, 100_000, "uniform 3D 1e6"),
    "hypersurface 3D 1e6": ("manifold", 3, 1_000_000, "uniform 3D 1e6"),
    "hypersurface 4D 1e5": ("manifold", 4, 100_000, "uniform 4D 1e5"),
    "hypersurface 5D 1e4": ("manifold", 5, 10_000, "uniform 5D 1e4"),
    "hypersurface 6D 2e3": ("manifold", 6, 2_000, "uniform 6D 4e3"),
    "clusters 3D 1e6": ("clusters", 3, 1_000_000, "uniform 3D 1e6"),
    "clusters 5D 1e4": ("clusters", 5, 10_000, "uniform 5D 1e4"),
    "uniform 3D 1800": ("uniform", 3, 1_800, None),
    "uniform 5D 400": ("uniform", 5, 400, None),
    "uniform 5D 1700": ("uniform", 5, 1_700, None),
    "uniform 6D 400": ("uniform", 6, 400, None),
    "protein 3D": ("protein.csv", "x,y,z", 1_516, "uniform 3D 1800"),
    "earthquakes 3D": ("earthquakes.csv", "longitude,latitude,depth_km", 1_707, "uniform 3D 1800"),
    "earthquakes 5D": ("earthquakes.csv", "longitude,latitude,depth_km,magnitude,time_ms", 1_707, "uniform 5D 1700"),
    "cars 5D": ("cars.csv", "Miles_per_Gallon,Displacement,Horsepower,Weight_in_lbs,Acceleration", 392, "uniform 5D 400"),
    "cars 6D": ("cars.csv", "Miles_per_Gallon,Cylinders,Displacement,Horsepower,Weight_in_lbs,Acceleration", 392, "uniform 6D 400"),
}


def arguments_of(command, name, folder):
    """The input of the command: generated points in a file, or columns of a real data set."""
    kind, dimension, n, _ = STANDARD[name]
    if kind.endswith(".csv"):
        return [str(DATA / kind), "--columns", dimension]
    path = f"{folder}/points-{list(STANDARD).index(name)}.npy"
    if not os.path.exists(path):
        subprocess.run([command, "generate", kind, "-d", str(dimension), "-n", str(n), "--seed", "1", "-o", path], check=True)
    return [path]


def run_command(command, *arguments):
    """The output of a process, and the resources it used."""
    process = subprocess.Popen([command, *arguments], stdout=subprocess.PIPE, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{command} ended with status {process.returncode}")
    return output, usage


@functools.cache
def processor_seconds_to_start(command):
    usages = [run_command(command, "--version")[1] for _ in range(9)]
    return statistics.median(usage.ru_utime + usage.ru_stime for usage in usages)


def construct(command, arguments, threads=1):
    """The statistics of one construction."""
    output, usage = run_command(command, "delaunay", *arguments, "--threads", str(threads), "--stats", "--quiet")
    run = json.loads(output)
    seconds = run["seconds"]
    run["seconds"] = seconds["order"] + seconds["build"]
    processor = (usage.ru_utime + usage.ru_stime - processor_seconds_to_start(command)) / seconds["total"]
    run["cpu_seconds"] = processor * run["seconds"]
    run["ns_per_created_cell"] = 1e9 * processor * seconds["build"] / run["created_cells"]
    run["system_share"] = usage.ru_stime / (usage.ru_utime + usage.ru_stime)
    return run


def summary(runs):
    """The figures of several runs on one input."""
    last = runs[-1]
    timed = ("seconds", "cpu_seconds", "ns_per_created_cell")
    return {**{key: statistics.median(run[key] for run in runs) for key in (*timed, "system_share", "bytes_per_cell", "peak_rss_bytes")},
            **{f"least_{key}": min(run[key] for run in runs) for key in timed}, "rounds": len(runs),
            **{key: last[key] for key in ("hash", "points", "cells", "infinite_cells", "created_cells", "stages")}}


HEADING = (f"{'input':<20}{'cells':>10}{'created':>11}{'seconds':>9}{'cpu s':>9}{'ns/cell':>9}{'least':>8}{'B/cell':>8}{'peak MB':>9}{'vs':>6}"
           "  stages direct/exact/perturbed")


def line(name, figures):
    stages = figures["stages"]
    return (f"{name:<20}{figures['cells']:>10}{figures['created_cells']:>11}{figures['seconds']:>9.3f}{figures['cpu_seconds']:>9.3f}"
            f"{figures['ns_per_created_cell']:>9.1f}{figures['least_ns_per_created_cell']:>8.1f}{figures['bytes_per_cell']:>8.1f}"
            f"{figures['peak_rss_bytes'] / 1e6:>9.1f}{figures.get('vs_reference', 0):>6.2f}"
            f"  {stages['direct']}/{stages['exact']}/{stages['perturbed']}"
            + (f"  {figures['ratio']:.3f}" if "ratio" in figures else ""))


def evaluate(runs):
    """The figures of all inputs, from name -> the runs of each command."""
    results = {}
    for name, of_command in runs.items():
        if not of_command[-1]:
            continue
        figures = results[name] = summary(of_command[0])
        reference = STANDARD[name][3]
        if runs.get(reference, [[]])[0]:
            # Round by round, so that both are measured at about the same time.
            figures["vs_reference"] = statistics.median(a["ns_per_created_cell"] / b["ns_per_created_cell"]
                                                        for a, b in zip(of_command[0], runs[reference][0]))
        if len(of_command) == 2:
            figures["ratio"] = statistics.median(new["cpu_seconds"] / old["cpu_seconds"] for new, old in zip(*of_command))
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--against", metavar="OLD", help="another build of the command")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", action="append", metavar="TEXT", help="inputs whose name contains TEXT")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/, after each input")
    options = parser.parse_args()
    commands = [options.command] + ([options.against] if options.against else [])
    names = [name for name in STANDARD if not options.only or any(text in name for text in options.only)]
    runs = {name: [[] for _ in commands] for name in names}

    with tempfile.TemporaryDirectory() as folder:
        for number in range(options.rounds):
            for name in names:
                arguments = arguments_of(options.command, name, folder)
                for which, command in enumerate(commands):
                    runs[name][which].append(construct(command, arguments))
                if len(commands) == 2 and runs[name][0][-1]["hash"] != runs[name][1][-1]["hash"]:
                    sys.exit(f"the two builds disagree on {name}")
                print(".", end="", file=sys.stderr, flush=True)
                results = evaluate(runs)
                if options.record:  # at once: nothing is lost when a long run is stopped
                    record.write("construction", options.command, results)

    print(HEADING + ("  ratio" if options.against else ""))
    for name, figures in results.items():
        print(line(name, figures))


if __name__ == "__main__":
    main()
