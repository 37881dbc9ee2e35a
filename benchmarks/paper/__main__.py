# SPDX-License-Identifier: BSD-3-Clause
"""Measures the experiments of the report and writes them up.

  make paper                       everything: hours
  make paper QUICK=1               the same at small sizes: minutes
  make paper HULL=/path/to/hull    with an executable of Clarkson's Hull

  PYTHONPATH=benchmarks python3 -m paper --build build/bench [--quick] [--resume] [--only uniform]
  PYTHONPATH=benchmarks python3 -m paper --render results.json       the write-up alone
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
import time

from . import plan, programs, render, runner, scoreboard
from .inputs import ROOT


def arguments():
    parser = argparse.ArgumentParser(prog="paper", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "bench", help="a build with DELONE_BUILD_BENCHMARKS")
    parser.add_argument("--delone", help="the command, if it is not in BUILD")
    parser.add_argument("--quick", action="store_true", help="small sizes, short limits")
    parser.add_argument("--results", type=pathlib.Path, help="the file of records; BUILD/paper.json or BUILD/paper-quick.json")
    parser.add_argument("--resume", action="store_true", help="keep the cases that this file holds already")
    parser.add_argument("--only", action="append", metavar="EXPERIMENT", help="one of uniform order manifold small hulls degenerate")
    parser.add_argument("--largest", type=float, metavar="SECONDS", help="limit of time of one process")
    parser.add_argument("--memory", type=float, metavar="GB", help="limit of memory of one process; 85 %% of the machine's otherwise, 16 GiB at most")
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--hull", default=os.environ.get("DELONE_HULL", ""), metavar="PATH", help="an executable of Clarkson's Hull")
    parser.add_argument("--docs", type=pathlib.Path, default=ROOT / "docs", help="where experiments.md is written")
    parser.add_argument("--record", action="store_true", help="keep the records in benchmarks/history, too")
    parser.add_argument("--render", type=pathlib.Path, metavar="FILE", help="measure nothing, write up these records")
    return parser.parse_args()


def machine_memory():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def processor():
    try:
        return next(line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8") if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def system():
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):
        return platform.platform()


def about(options, limits):
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.split("\n")[0]
    return {"date": datetime.date.today().isoformat(), "commit": commit or "unknown", "quick": options.quick, "machine": processor(),
            "cores": os.cpu_count(), "memory_bytes": machine_memory(), "system": system(), "compiler": compiler, "rounds": limits.rounds,
            "limit_seconds": limits.seconds, "limit_memory": limits.memory_bytes, "load": [os.getloadavg()[0], 0.0], "elapsed_seconds": 0.0}


def limits_of(options):
    memory = options.memory * 1e9 if options.memory else min(0.85 * machine_memory(), 16 * 2**30)
    if options.quick:
        return runner.Limits(options.largest or 6.0, memory, options.rounds or 3, 3.0)
    return runner.Limits(options.largest or 3600.0, memory, options.rounds or 5, 120.0)


def measure(options, path):
    """Runs all cases; the file of records is complete after each."""
    delone = str(options.delone or options.build / "delone")
    limits = limits_of(options)
    catalogue = programs.catalogue(options.hull)
    document = {"about": about(options, limits), "records": []}
    if options.resume and path.exists():
        kept = json.loads(path.read_text(encoding="utf-8"))
        document["records"] = kept["records"]
        document["about"]["elapsed_seconds"] = kept["about"]["elapsed_seconds"]
        document["about"]["load"][0] = kept["about"]["load"][0]
        document["about"]["commit"] = kept["about"]["commit"]
        document["about"]["notes"] = ["It was measured in several sittings."]
    cases = [case for case in plan.cases(options.quick) if not options.only or case.experiment in options.only]
    with tempfile.TemporaryDirectory(prefix="paper-") as folder:
        run = runner.Runner(catalogue, options.build, delone, limits, folder, lambda text: print(text, flush=True))
        for case in cases:
            done = [r for r in document["records"] if r.get("case") == case_key(case)]
            if done:
                for record in done:
                    run.remember(case, record["program"], record)
                continue
            start = time.monotonic()
            records = run.measure(case)
            if case.experiment == "degenerate":
                scoreboard.verdicts(case, records, catalogue, options.build, delone, limits, run.folder)
            for record in records:
                record["case"] = case_key(case)
            document["records"] += records
            document["about"]["elapsed_seconds"] += time.monotonic() - start
            document["about"]["load"][1] = os.getloadavg()[0]
            write_json(path, document)
    return document


def case_key(case):
    return f"{case.experiment} {case.kind} {case.dimension} {case.points}"


def write_json(path, document):
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_suffix(".part")
    records = ",\n".join(json.dumps(record, ensure_ascii=False) for record in document["records"])
    beside.write_text(f'{{"about": {json.dumps(document["about"], ensure_ascii=False)},\n"records": [\n{records}\n]}}\n', encoding="utf-8")
    beside.replace(path)


def main():
    options = arguments()
    if options.render:
        print(render.write(json.loads(options.render.read_text(encoding="utf-8")), options.docs))
        return
    path = options.results or options.build / ("paper-quick.json" if options.quick else "paper.json")
    document = measure(options, path)
    if not document["records"]:
        sys.exit(f"nothing was measured: {options.build} has no adapters; configure with -DDELONE_BUILD_BENCHMARKS=ON and build")
    if options.record:
        history = ROOT / "benchmarks" / "history" / f"{document['about']['date']}-{document['about']['commit']}-paper.json"
        write_json(history, document)
    print(render.write(document, options.docs))


if __name__ == "__main__":
    main()
