#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What triangulations in tiles cost, by the command: points of other tiles, rounds, memory, and time against one file in memory.

  tiles.py build/release/delone                                2, 8 and 64 tiles of the standard sets
  tiles.py build/release/delone --only 3D --record             also benchmarks/history/DATE-COMMIT-tiles.json
  tiles.py build/release/delone --mpi build/mpi/bin/delone-mpi  also by as many processes as there are cores, with bytes and messages
  tiles.py build/release/delone --set uniform 3 20000000 --memory 2G --threads 2

Both write the triangulation, the one as a folder, the other as one .npz. Times are processor seconds, unless there is --wall; hashes
must be equal. With --set, tiles follow from --memory.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import record

SETS = (("uniform", 2, 1000000), ("uniform", 3, 1000000), ("uniform", 4, 100000), ("uniform", 5, 20000), ("plummer", 3, 200000),
        ("grid", 3, 200000), ("manifold", 3, 10000), ("sphere", 3, 20000))


def run(*arguments, wall=False):
    """The report of a command, and its seconds."""
    start, before = time.monotonic(), os.times()
    output = subprocess.run([str(a) for a in arguments], check=True, capture_output=True, text=True).stdout
    after = os.times()
    seconds = time.monotonic() - start if wall else after.children_user + after.children_system - before.children_user - before.children_system
    return json.loads(output), seconds


def measure(options, name, points, folder, how):
    """The figures of one set and one number of tiles (or a bound of memory)."""
    common = ("--threads", options.threads, "--stats", "--quiet")
    out = folder / "tiles"
    whole, of_whole = run(options.command, "delaunay", points, "-o", folder / "whole.npz", *common, wall=options.wall)
    (folder / "whole.npz").unlink()
    tiles, of_tiles = run(options.command, "delaunay", points, "-o", f"{out}/", *how, *common, wall=options.wall)
    index = json.loads((out / "index.json").read_text())
    shutil.rmtree(out)
    if tiles["hash"] != whole["hash"]:
        sys.exit(f"tiles have another result on {name}")
    figures = {"tiles": tiles["parts"], "foreign_share": tiles["foreign"] / tiles["points"], "rounds": tiles["rounds"],
               "seconds": of_tiles, "seconds_in_memory": of_whole, "ratio": of_tiles / of_whole,
               "peak_rss_bytes": tiles["peak_rss_bytes"], "peak_rss_bytes_in_memory": whole["peak_rss_bytes"], "cells": tiles["cells"],
               "most_foreign_share": max(p["num_foreign"] / max(p["num_points"], 1) for p in index["parts"])}
    print(f"{name:<24}{figures['tiles']:>6}{figures['foreign_share']:>9.3f}{figures['rounds']:>8}{of_whole:>10.2f}{of_tiles:>9.2f}"
          f"{figures['ratio']:>7.2f}{figures['peak_rss_bytes'] / 1e6:>10.0f}{figures['peak_rss_bytes_in_memory'] / 1e6:>10.0f}", flush=True)
    return figures


def measure_ranks(options, name, points, folder, tiles):
    """Wall seconds by one process and by several, and what these send."""
    ranks = options.ranks or len(os.sched_getaffinity(0))
    figures = {}
    for count in (1, ranks):
        out = folder / "ranks"
        mpirun = ("mpirun", "--oversubscribe", "--allow-run-as-root", "-n", count, options.mpi, "delaunay", points, "-o", f"{out}/")
        report, seconds = run(*mpirun, "--tiles", tiles, "--threads", 1, "--stats", wall=True)
        shutil.rmtree(out)
        of_ranks = report["ranks"]
        figures[count] = {"seconds": seconds, "report": of_ranks}
        print(f"{name:<24}{tiles:>6} tiles, {count} processes: {seconds:.2f} s, {figures[1]['seconds'] / seconds:.2f}×; "
              f"bytes sent by one {max(r['bytes_sent'] for r in of_ranks) / 1e6:.1f} MB in {max(r['messages'] for r in of_ranks)} messages", flush=True)
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--tiles", type=int, nargs="+", default=[2, 8, 64])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--only", action="append", metavar="TEXT", help="sets whose name contains TEXT")
    parser.add_argument("--set", nargs=3, metavar=("KIND", "D", "N"))
    parser.add_argument("--memory", default="2G")
    parser.add_argument("--wall", action="store_true", help="wall-clock time: the machine has to be idle otherwise")
    parser.add_argument("--mpi", metavar="COMMAND", help="delone-mpi")
    parser.add_argument("--ranks", type=int)
    parser.add_argument("--folder", help="for inputs and results; by default a temporary one")
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    sets = SETS if not options.set else [(options.set[0], int(options.set[1]), int(options.set[2]))]
    print(f"{'set':<24}{'tiles':>6}{'foreign':>9}{'rounds':>8}{'memory s':>10}{'tiles s':>9}{'ratio':>7}{'peak MB':>10}{'in memory':>10}")
    results = {}
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        folder = pathlib.Path(folder)
        for kind, d, n in sets:
            name = f"{kind} {d}D {n}"
            if options.only and not any(text in name for text in options.only):
                continue
            points = folder / "points.npy"
            subprocess.run([options.command, "generate", kind, "-d", str(d), "-n", str(n), "--seed", "1", "-o", points], check=True, stdout=subprocess.DEVNULL)
            ways = [("--memory", options.memory)] if options.set else [("--tiles", tiles) for tiles in options.tiles]
            for way in ways:
                results[f"{name}, {way[1]}"] = measure(options, name, points, folder, way)
                if options.mpi:
                    results[f"{name}, {way[1]}, processes"] = measure_ranks(options, name, points, folder, results[f"{name}, {way[1]}"]["tiles"])
                if options.record:
                    record.write("tiles", options.command, results)
            points.unlink()


if __name__ == "__main__":
    main()
