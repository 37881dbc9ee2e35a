# SPDX-License-Identifier: BSD-3-Clause
"""Measures the experiments of the report and writes them up, in build/paper.

  make paper                       everything: about an hour
  make paper QUICK=1               the same at small sizes: minutes
  make paper DOCS=1                the write-up replaces docs/experiments.md and its pictures
  make paper HULL=/path/to/hull    with an executable of Clarkson's Hull
  make paper PAPER="--minutes 40"  what fits in that time, the most important and the shortest first

  PYTHONPATH=benchmarks python3 -m paper --build build/bench [--quick] [--minutes 60] [--resume] [--only uniform] [--dry-run]
  PYTHONPATH=benchmarks python3 -m paper --render results.json       the write-up alone
"""
import argparse
import dataclasses
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
import time

from . import estimates, plan, programs, render, runner, scoreboard
from .inputs import ROOT

OUTPUT = ROOT / "build" / "paper"


def arguments(words=None):
    parser = argparse.ArgumentParser(prog="paper", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "bench", help="a build with DELONE_BUILD_BENCHMARKS")
    parser.add_argument("--delone", help="the command, if it is not in BUILD")
    parser.add_argument("--quick", action="store_true", help="small sizes, short limits")
    parser.add_argument("--results", type=pathlib.Path, help="the file of records; OUTPUT/records.json or OUTPUT/records-quick.json")
    parser.add_argument("--resume", action="store_true", help="keep the cases that this file holds already")
    parser.add_argument("--only", action="append", metavar="EXPERIMENT", help="one of uniform order manifold small hulls degenerate tiny")
    parser.add_argument("--minutes", type=float, help="leave out, and list as left out, what does not fit in so much time")
    parser.add_argument("--dry-run", action="store_true", help="measure nothing, print the cases in their order and what they will take, roughly")
    parser.add_argument("--largest", type=float, metavar="SECONDS", help="limit of processor time of one process of a peer")
    parser.add_argument("--memory", type=float, metavar="GB", help="limit of memory of one process; 85 %% of the machine's otherwise, 16 GiB at most")
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--hull", default=os.environ.get("DELONE_HULL", ""), metavar="PATH", help="an executable of Clarkson's Hull")
    parser.add_argument("--output", type=pathlib.Path, default=OUTPUT, metavar="FOLDER", help="where experiments.md is written; build/paper")
    parser.add_argument("--docs", action="store_true", help="write experiments.md and its pictures in docs/, over those there")
    parser.add_argument("--record", action="store_true", help="keep the records in benchmarks/history, too")
    parser.add_argument("--render", type=pathlib.Path, metavar="FILE", help="measure nothing, write up these records")
    return parser.parse_args(words)


def machine_memory():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def processor():
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def system():
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):
        return platform.platform()


def commit():
    return subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True).stdout.strip() or "unknown"


def about(options, limits, missing):
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.split("\n")[0]
    return {"date": datetime.date.today().isoformat(), "commit": commit(), "quick": options.quick, "machine": processor(),
            "cores": os.cpu_count(), "memory_bytes": machine_memory(), "system": system(), "compiler": compiler,
            "limits": dataclasses.asdict(limits), "minutes": options.minutes, "load": [os.getloadavg()[0], 0.0], "elapsed_seconds": 0.0, "sittings": 1,
            "missing": missing, "left_out": []}


def limits_of(options):
    memory = options.memory * 1e9 if options.memory else min(0.85 * machine_memory(), 16 * 2**30)
    if options.quick:
        return runner.Limits(options.largest or 6.0, options.largest or 6.0, options.largest or 4.0, memory, options.rounds or 3, 2.0)
    return runner.Limits(options.largest or 40.0, max(options.largest or 0.0, 600.0), min(options.largest or 10.0, 10.0), memory, options.rounds or 3, 6.0)


def not_there(catalogue, planned, build):
    """The names of the programs that are in some case but not installed or built."""
    there = {key for case in planned for key in case.programs if key in catalogue and catalogue[key].command_line(build, "points.npy", case.dimension)}
    return list(dict.fromkeys(program.name for key, program in catalogue.items() if key not in there and any(key in case.programs for case in planned)))


def begin(options, limits, path, missing):
    """A new document, or with --resume that of an earlier sitting."""
    document = {"about": about(options, limits, missing), "records": []}
    if options.resume and path.exists():
        kept = json.loads(path.read_text(encoding="utf-8"))
        before, now = kept["about"], document["about"]
        now.update(elapsed_seconds=before["elapsed_seconds"], load=[before["load"][0], 0.0], sittings=before["sittings"] + 1)
        if before["minutes"] and now["minutes"]:
            now["minutes"] += before["minutes"]
        if now["commit"] not in before["commit"].split(" and "):
            now["commit"] = f"{before['commit']} and {now['commit']}"
        document["records"] = kept["records"]
    return document


def measure(options, path):
    """Runs all cases; the file of records is complete after each."""
    delone = str(options.delone or options.build / "delone")
    limits = limits_of(options)
    catalogue = programs.catalogue(options.hull)
    planned = [case for case in plan.cases(options.quick) if not options.only or case.experiment in options.only]
    place = {case.key(): i for i, case in enumerate(planned)}
    document = begin(options, limits, path, not_there(catalogue, planned, options.build))
    description, records = document["about"], document["records"]
    began = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="paper-") as folder:
        run = runner.Runner(catalogue, options.build, delone, limits, folder, lambda text: print(text, flush=True))
        full_series = set()
        for case in plan.by_importance(planned, limits):
            done = [r for r in records if r["case"] == case.key()]
            if done:
                for record in done:
                    run.remember(case, record["program"], record)
                continue
            start = time.monotonic()
            if options.minutes and (case.series() in full_series or start - began + run.expected_seconds(case) > 60 * options.minutes):
                full_series.add(case.series())
                description["left_out"].append(case.key())
                continue
            measured = run.measure(case)
            if case.experiment in ("degenerate", "tiny"):
                scoreboard.verdicts(case, measured, catalogue, options.build, delone, limits, run.folder)
            records += [{"case": case.key(), **record} for record in measured]
            records.sort(key=lambda record: place.get(record["case"], -1))
            description["elapsed_seconds"] += time.monotonic() - start
            description["load"][1] = os.getloadavg()[0]
            write_json(path, document)
    write_json(path, document)
    return document


def write_up(document, options):
    print(render.write(document, ROOT / "docs" if options.docs else options.output))


def dry_run(options):
    """The cases in the order of measurement, with a rough estimate of each and the sum so far."""
    limits = limits_of(options)
    planned = [case for case in plan.cases(options.quick) if not options.only or case.experiment in options.only]
    total = 0.0
    for case in plan.by_importance(planned, limits):
        seconds = estimates.case_seconds(case, limits)
        total += seconds
        print(f"{case.experiment:<12}{case.kind:<18}{case.dimension}D {case.points:>8}{seconds:>9.1f} s{total / 60:>8.1f} min")


def write_json(path, document):
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_suffix(".part")
    beside.write_text(json.dumps(document, ensure_ascii=False, separators=(",", ":")) + "\n", encoding="utf-8")
    beside.replace(path)


def main():
    options = arguments()
    if options.render:
        write_up(json.loads(options.render.read_text(encoding="utf-8")), options)
        return
    if options.dry_run:
        dry_run(options)
        return
    path = options.results or options.output / ("records-quick.json" if options.quick else "records.json")
    document = measure(options, path)
    if not document["records"]:
        sys.exit("nothing was measured: no case fits in that time" if document["about"]["left_out"] else
                 f"nothing was measured: {options.build} has no adapters; configure with -DDELONE_BUILD_BENCHMARKS=ON and build")
    if options.record:
        name = f"{document['about']['date']}-{document['about']['commit'].replace(' and ', '+')}-paper{'-quick' if options.quick else ''}.json"
        history = ROOT / "benchmarks" / "history" / name
        write_json(history, document)
    write_up(document, options)


if __name__ == "__main__":
    main()
