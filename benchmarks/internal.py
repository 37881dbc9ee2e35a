#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the programs of benchmarks/internal and keeps their figures.

  internal.py build/bench                                  all of them
  internal.py build/bench --only kernel --record           one, and benchmarks/history/DATE-COMMIT-kernel.json
  internal.py build/bench --only order --filter 5D         what matches a regular expression

The build needs -DDELONE_BUILD_BENCHMARKS=ON. The head of each program's source explains its figures.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import record

PROGRAMS = ("cells", "kernel", "order", "phases", "touch", "workers")
# The fields that Google Benchmark adds to the counters of the program.
ITS_OWN = {"family_index", "per_family_instance_index", "repetitions", "repetition_index", "threads", "iterations", "real_time", "cpu_time",
           "items_per_second"}


def run(program, pattern):
    """name -> the counters of each benchmark, and nanoseconds of processor time per call if it does not count time itself."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.json"
        command = [str(program), f"--benchmark_out={out}", "--benchmark_out_format=json", f"--benchmark_filter={pattern}"]
        subprocess.run(command, check=True)
        report = json.loads(out.read_text() or "{}")
    results = {}
    for benchmark in report.get("benchmarks", []):
        figures = {key: value for key, value in benchmark.items() if isinstance(value, (int, float)) and key not in ITS_OWN}
        if "decided" in figures:
            figures["ns"] = benchmark["cpu_time"]
        results[benchmark["name"].split("/iterations:")[0].split("/min_time:")[0]] = figures
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="the folder of the build")
    parser.add_argument("--only", action="append", choices=PROGRAMS)
    parser.add_argument("--filter", default=".*", metavar="REGEX", help="names of benchmarks")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_args()
    for name in options.only or PROGRAMS:
        program = options.build / "benchmarks" / "internal" / f"delone_benchmark_{name}"
        results = run(program, options.filter)
        if options.record:
            print("recorded in", record.write(name, program, results).relative_to(record.ROOT))


if __name__ == "__main__":
    main()
