#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Forecasts beside what constructions took: ratios forecast / found of cells, bytes and seconds.

  forecast.py build/release/delone RUNS.csv                  the largest set of each kind and dimension of a table
  forecast.py build/release/delone RUNS.csv --markdown       the same as tables for a record

RUNS.csv is a table of forecast_runs.py; for sizes that the constants were not fitted to, make one with --sizes. For each line there
are two forecasts: of the kind and the number of points alone, and from a sample of the points.
"""
import argparse
import csv
import json
import math
import subprocess
import tempfile

PROMISED = 1.5


def stats(command, *arguments):
    return json.loads(subprocess.run([command, "forecast", *arguments, "--threads", "1", "--stats"], capture_output=True, text=True, check=True).stdout)


def ratios(command, row):
    """name -> (ratio of the forecast, ratio of the estimate)"""
    size = ["-d", row["dimension"], "-n", row["points"]]
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/points.npy"
        subprocess.run([command, "generate", row["kind"], *size, "--seed", "1", "-o", path], check=True)
        made = stats(command, *size, "--kind", row["kind"]), stats(command, path)
    return {name: tuple(forecast[name]["expected"] / float(row[name]) for forecast in made) for name in ("cells", "bytes", "seconds")}


def shown(ratio):
    return f"{ratio:.2f}" + ("*" if abs(math.log(ratio)) > math.log(PROMISED) else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("table")
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--all", action="store_true", help="every line, not only the largest of each kind and dimension")
    parser.add_argument("--least", type=float, default=0.1, help="seconds; smaller constructions are left out")
    arguments = parser.parse_args()
    with open(arguments.table, newline="", encoding="ascii") as file:
        rows = [row for row in csv.DictReader(file) if float(row["seconds"]) >= arguments.least]
    if not arguments.all:
        rows = list({(row["kind"], row["dimension"]): row for row in rows}.values())
    if arguments.markdown:
        print("| kind | d | points | cells | seconds | cells | bytes | seconds |\n|---|---|---|---|---|---|---|---|")
    outside, total = 0, 0
    for row in rows:
        found = ratios(arguments.command, row)
        columns = [f"{shown(found[name][0])} {shown(found[name][1])}" for name in ("cells", "bytes", "seconds")]
        outside += sum("*" in column for column in columns)
        total += 3
        line = [row["kind"], row["dimension"], row["points"], f"{int(row['cells']):.3g}", f"{float(row['seconds']):.2f}", *columns]
        print("| " + " | ".join(line) + " |" if arguments.markdown else "  ".join(f"{x:>12}" for x in line), flush=True)
    print(f"\n{outside} of {total} pairs have a ratio beyond {PROMISED} (*)")


if __name__ == "__main__":
    main()
