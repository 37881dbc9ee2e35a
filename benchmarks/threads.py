#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times the construction of Delaunay triangulations by several threads against one, by the command, on the standard inputs.

  threads.py build/release/delone                          1 and 2, 4, … threads, up to the number of cores
  threads.py build/release/delone --threads 2 3 --record   also benchmarks/history/DATE-COMMIT-threads.json
  threads.py build/release/delone --quick                  two threads, 2D to 5D, beside two processes, in about two minutes
  threads.py --plot out.png RECORD.json                    a picture of a record (needs Matplotlib)

All numbers of threads take turns on an input, round by round. Speed-ups are medians over the rounds of the ratio of the wall time
of ordering and building; hashes must be equal. The machine has to be idle otherwise. Two processes that build the same input at
once, each in one thread, share nothing but caches and memory: what they reach is a bound for two threads on the machine.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import statistics
import sys
import tempfile

import record
from construction import arguments_of, construct

INPUTS = ("uniform 2D 1e6", "uniform 3D 1e6", "uniform 4D 1e5", "uniform 5D 1e4", "uniform 6D 4e3", "uniform 7D 1e3", "lattice 100^3",
          "lattice 18^4", "lattice 8^5", "hypersurface 3D 1e5", "hypersurface 4D 1e5", "hypersurface 5D 1e4", "hypersurface 6D 2e3")
QUICK = [f"uniform {text}" for text in ("2D 1e6", "3D 1e6", "4D 1e5", "5D 1e4")]
LEAST_OF_TWO_THREADS = 1.6  # on the inputs of --quick


def construct_twice(command, arguments):
    """Seconds of two processes that run at once, the mean of both."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        both = [pool.submit(construct, command, arguments) for _ in range(2)]
        return statistics.mean(run.result()["seconds"] for run in both)


def evaluate(runs):
    """The figures of all inputs, from name -> number of threads -> runs."""
    results = {}
    for name, of_threads in runs.items():
        ones = of_threads[1]
        if not ones:
            continue
        figures = results[name] = {"seconds": statistics.median(run["seconds"] for run in ones), "rounds": len(ones)}
        for threads, others in of_threads.items():
            if threads > 1 and others:
                pairs = list(zip(ones, others))
                figures[f"speedup_{threads}"] = statistics.median(a["seconds"] / b["seconds"] for a, b in pairs)
                figures[f"cpu_{threads}"] = statistics.median(b["cpu_seconds"] / a["cpu_seconds"] for a, b in pairs)
                figures[f"memory_{threads}"] = statistics.median(b["peak_rss_bytes"] / a["peak_rss_bytes"] for a, b in pairs)
    return results


def plot(path, record_path):
    from matplotlib import pyplot

    from paper.plots import write_png
    results = json.loads(pathlib.Path(record_path).read_text())["results"]
    names = list(results)
    figure, axes = pyplot.subplots(figsize=(7, 0.35 * len(names) + 1), dpi=120)
    threads = sorted(int(key.removeprefix("speedup_")) for key in results[names[0]] if key.startswith("speedup_"))
    for number, count in enumerate(threads):
        places = [i + 0.8 * (number + 0.5) / len(threads) - 0.4 for i in range(len(names))]
        axes.barh(places, [results[name][f"speedup_{count}"] for name in names], 0.8 / len(threads), label=f"{count} threads")
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.axvline(1, color="black", linewidth=0.8)
    axes.set_xlabel("times as fast as one thread")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=len(threads), frameon=False)
    figure.tight_layout()
    write_png(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", help="the command, or a record to be drawn")
    parser.add_argument("--threads", type=int, nargs="+", help="numbers of threads to compare with one")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--quick", action="store_true", help="two threads, uniform points in 2D to 5D, beside two processes")
    parser.add_argument("--only", action="append", metavar="TEXT", help="inputs whose name contains TEXT")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/, after each input")
    parser.add_argument("--plot", metavar="FILE", help="draw a record")
    options = parser.parse_args()
    if options.plot:
        return plot(options.plot, options.command)
    cores = len(os.sched_getaffinity(0))
    counts = [2] if options.quick else options.threads or [count for count in (2 ** i for i in range(1, 10)) if count <= cores] or [2]
    inputs = QUICK if options.quick else INPUTS
    names = [name for name in inputs if not options.only or any(text in name for text in options.only)]
    runs = {name: {count: [] for count in (1, *counts)} for name in names}
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            arguments = arguments_of(options.command, name, folder)
            of_processes = []
            for _ in range(options.rounds):
                for count, of_count in runs[name].items():
                    of_count.append(construct(options.command, arguments, count))
                    if of_count[-1]["hash"] != runs[name][1][-1]["hash"]:
                        sys.exit(f"{count} threads have another result than one on {name}")
                if options.quick:
                    of_processes.append(2 * runs[name][1][-1]["seconds"] / construct_twice(options.command, arguments))
            figures = evaluate(runs)[name]
            print(f"{name:<20}{figures['seconds']:>9.3f} s" + "".join(
                f"   {count} threads: {figures[f'speedup_{count}']:.2f}× (processor time {figures[f'cpu_{count}']:.2f}×, "
                f"memory {figures[f'memory_{count}']:.2f}×)" for count in counts), flush=True)
            if options.quick:
                verdict = "met" if figures["speedup_2"] >= LEAST_OF_TWO_THREADS else "MISSED"
                print(f"{'':<20}two processes: {statistics.median(of_processes):.2f}×   {verdict}: at least {LEAST_OF_TWO_THREADS}")
            if options.record:
                record.write("threads", options.command, evaluate(runs))


if __name__ == "__main__":
    main()
