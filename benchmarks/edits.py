#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times removals, insertions and moves of single vertices, and time steps, by delone and by CGAL, one thread each, in turn.

  edits.py build/bench                        a table; needs a build with DELONE_BUILD_BENCHMARKS=ON
  edits.py build/bench --only "uniform 3D"    inputs whose name contains a text, also repeated
  edits.py build/bench -d 4 -n 50000 -m 500   another input, of one --kind or both, instead of the standard ones
  edits.py build/bench --record               also benchmarks/history/DATE-COMMIT-edits.json

What the programs do is in rivals/edit.hpp: m random vertices are removed and inserted again with hints, then as many others move by
each of --moves times the mean distance to the nearest neighbor, and in 2D and 3D all vertices move in a time step. Figures are
processor times (user and system): medians over the rounds, microseconds per operation, seconds of construction and time steps. Ratios
are medians of those of each round. The record has times by the clock, too. All programs must find the same triangulations of uniform
points; on lattices another program may break ties in another way. A program has no figures if it fails, takes longer than --patience
seconds, or was not built.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

import hulls
import record

OWN = "edit_delone"
TIME_STEP = 0.001

# name -> (kind, dimension, number of points, number of edits)
STANDARD = {
    "uniform 2D 1e5": ("uniform", 2, 100_000, 10_000),
    "lattice 316^2": ("lattice", 2, 99_856, 10_000),
    "uniform 2D 1e6": ("uniform", 2, 1_000_000, 100_000),
    "lattice 1000^2": ("lattice", 2, 1_000_000, 100_000),
    "uniform 3D 1e5": ("uniform", 3, 100_000, 10_000),
    "lattice 46^3": ("lattice", 3, 97_336, 10_000),
    "uniform 3D 1e6": ("uniform", 3, 1_000_000, 50_000),
    "lattice 100^3": ("lattice", 3, 1_000_000, 50_000),
    "uniform 4D 2e4": ("uniform", 4, 20_000, 1_000),
    "lattice 12^4": ("lattice", 4, 20_736, 1_000),
    "uniform 5D 5e3": ("uniform", 5, 5_000, 200),
    "lattice 6^5": ("lattice", 5, 7_776, 200),
    "uniform 6D 2e3": ("uniform", 6, 2_000, 50),
    "lattice 4^6": ("lattice", 6, 4_096, 50),
    "uniform 7D 500": ("uniform", 7, 500, 10),
    "lattice 3^7": ("lattice", 7, 2_187, 2),
}
MOST_PER_INSERTION = {2: 2, 3: 2, 4: 2, 5: 2, 6: 3}  # removals, by dimension; of others the ratio is only shown
MOST_OF_A_LATTICE = 3  # times as much as of uniform points
MOST_OF_A_REBUILD = 0.5


def programs_of(dimension):
    return OWN, f"edit_cgal_{dimension}" if dimension <= 3 else f"edit_cgal_d{dimension}"


def inputs_of(options):
    """name -> input, of the standard ones or as the options say."""
    if options.points is None:
        return {name: given for name, given in STANDARD.items()
                if (not options.only or any(text in name for text in options.only))
                and (not options.dimension or given[1] in options.dimension) and given[0] in options.kind}
    return {f"{kind} {d}D {options.points}": (kind, d, options.points, options.edits or max(1, options.points // 100))
            for d in options.dimension or (2, 3) for kind in options.kind}


def make_points(delone, kind, dimension, n, path):
    """A file, unless it is there from an earlier round."""
    if not pathlib.Path(path).exists():
        name = "grid" if kind == "lattice" else kind
        subprocess.run([delone, "generate", name, "-d", str(dimension), "-n", str(n), "--seed", "1", "-o", path], check=True)


def operations(report):
    """All processor times of a report, one name -> nanoseconds, or seconds."""
    return {"build": report["cpu_seconds"][0],
            **{what: times[0] for what, times in report["cpu_ns"].items()},
            **{f"time step, {how}": times[0] for how, times in report.get("cpu_time_step", {}).items()}}


def ratio(above, what_above, below, what_below):
    """The median ratio of the rounds of two programs, or of one; None if one has no such figure."""
    pairs = [(operations(a).get(what_above), operations(b).get(what_below)) for a, b in zip(above, below)]
    return statistics.median(a / b for a, b in pairs) if pairs and all(a and b for a, b in pairs) else None


def ratio_of_steps(rival, own):
    """The median ratio of time steps, if the other program moves all vertices or rebuilds, whichever is faster."""
    pairs = [(operations(a), operations(b)) for a, b in zip(rival, own)]
    pairs = [(min(time for what, time in a.items() if what.startswith("time step")), b["time step, moves"])
             for a, b in pairs if "time step, moves" in a and "time step, moves" in b]
    return statistics.median(a / b for a, b in pairs) if pairs else None


def summary(runs):
    """The figures of several runs of one program on one input."""
    last = runs[-1]

    def medians(where):
        return {what: statistics.median(s for run in runs for s in run[where][what]) for what in last.get(where, {})}

    return {"seconds": statistics.median(s for run in runs for s in run["seconds"]),
            "cpu_seconds": statistics.median(s for run in runs for s in run["cpu_seconds"]),
            **{where: medians(where) for where in ("ns", "cpu_ns", "time_step", "cpu_time_step")},
            "removal_per_insertion": ratio(runs, "removal", runs, "insertion"), "rounds": len(runs),
            **{key: last[key] for key in ("program", "version", "flags", "edits", "spacing", "cells", "peak_bytes")}}


def require_equal(name, kind, reports):
    """Ends the run if the programs disagree where the triangulation is unique, or delone with itself."""
    own = reports.get(OWN)
    if own is None:
        return
    if not own["same_after_insertions"]:
        sys.exit(f"{name}: removals and insertions of the same points led delone to another triangulation")
    for program, report in reports.items():
        for key in ("checksum_after_removals", "checksum"):
            if kind == "uniform" and report[key] != own[key]:
                sys.exit(f"{name}: {program} and delone disagree ({key})")


def columns(moves):
    return ["build", "removal", "insertion", *(f"move {step}" for step in moves.split(",")), "time step, moves", "time step, rebuild"]


def heading(moves):
    titles = ["build s", "removal", "insertion", *(f"mv {step}" for step in moves.split(",")), "step s", "rebuild s"]
    return f"{'input':<17}{'program':<9}{'cells':>10}" + "".join(f"{title:>11}" for title in titles)


def line(name, runs, moves):
    """Seconds, and microseconds of what is done to single vertices."""
    found = {what: statistics.median(operations(run)[what] for run in runs) for what in operations(runs[-1])}
    cells = []
    for what in columns(moves):
        if what not in found:
            cells.append("–")
        elif what in runs[-1]["cpu_ns"]:
            cells.append(f"{found[what] / 1000:.2f}")
        else:
            cells.append(f"{found[what]:.3f}")
    return f"{name:<17}{runs[-1]['program']:<9}{runs[-1]['cells']:>10}" + "".join(f"{cell:>11}" for cell in cells)


def line_of_ratios(name, runs, own, moves):
    """How many times as long as delone."""
    cells = []
    for what in columns(moves):
        times = ratio(runs, what, own, what)
        cells.append("–" if times is None else f"{times:.2f}")
    return f"{name:<17}{'  ÷ delone':<19}" + "".join(f"{cell:>11}" for cell in cells)


def goals(inputs, runs, moves):
    """(input, what, ratio, the most it should be or None) of delone's own ratios."""
    for name, (kind, dimension, *_) in inputs.items():
        own = runs[name].get(OWN, [])
        yield name, "removal / insertion", ratio(own, "removal", own, "insertion"), MOST_PER_INSERTION.get(dimension)
        yield name, "time step / rebuild", ratio(own, "time step, moves", own, "time step, rebuild"), MOST_OF_A_REBUILD
        for program, rival in runs[name].items():
            if program != OWN:
                yield name, f"the faster step of {program} / delone", ratio_of_steps(rival, own), None
        if kind == "lattice":
            # The uniform points of the same dimension that are nearest in number.
            n = inputs[name][2]
            peers = [other for other, given in inputs.items() if given[:2] == ("uniform", dimension)]
            if peers:
                peer = min(peers, key=lambda other: abs(inputs[other][2] - n))
                for what in columns(moves)[1:-2]:
                    yield name, f"{what} / {peer}", ratio(own, what, runs[peer].get(OWN, []), what), MOST_OF_A_LATTICE


def whole(text):
    """A count, also as 1e6."""
    return int(float(text))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", action="append", metavar="TEXT", help="inputs whose name contains TEXT")
    parser.add_argument("-d", "--dimension", type=int, nargs="+")
    parser.add_argument("--kind", nargs="+", default=["uniform", "lattice"], choices=["uniform", "lattice"])
    parser.add_argument("-n", "--points", type=whole, help="another number of points than the standard ones")
    parser.add_argument("-m", "--edits", type=whole, help="how many vertices are removed, and moved by each step")
    parser.add_argument("--moves", default="0.001,0.1,1", help="steps of single moves, in mean distances to the nearest neighbor")
    parser.add_argument("--patience", type=float, default=600, help="seconds for one run of a program")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/, after each input")
    options = parser.parse_args()
    inputs = inputs_of(options)
    runs = {name: {program: [] for program in programs_of(d)} for name, (_, d, *_) in inputs.items()}
    failed = set()
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for number, (name, (kind, dimension, n, edits)) in enumerate(inputs.items()):
                path = f"{folder}/points-{number}.npy"
                make_points(options.build / "delone", kind, dimension, n, path)
                arguments = ["--edits", str(options.edits or edits), "--moves", options.moves,
                             "--time-step", str(TIME_STEP if dimension <= 3 else 0)]
                reports = {}
                for program in programs_of(dimension):
                    command = hulls.command_line(options.build, program, dimension, path)
                    if command is None or (name, program) in failed:
                        continue
                    report = hulls.measure([*command, *arguments], options.patience)
                    if report is None:
                        failed.add((name, program))
                        print(f"\n{name}: {program} has failed, or takes too long", file=sys.stderr)
                    else:
                        reports[program] = report
                        runs[name][program].append(report)
                require_equal(name, kind, reports)
                print(".", end="", file=sys.stderr, flush=True)
                if options.record:  # at once: nothing is lost when a long run is stopped
                    record.write("edits", options.build / "rivals" / OWN, {name: {
                        program: summary(of_program) for program, of_program in runs[name].items() if of_program}})
    print(file=sys.stderr)

    print(heading(options.moves))
    for name, of_input in runs.items():
        for program, reports in of_input.items():
            if reports:
                print(line(name, reports, options.moves))
            if reports and program != OWN and of_input[OWN]:
                print(line_of_ratios(name, reports, of_input[OWN], options.moves))
    print()
    for name, what, found, most in goals(inputs, runs, options.moves):
        if found is not None:
            verdict = "" if most is None else f"   {'met' if found <= most else 'MISSED'}: at most {most}"
            print(f"{name:<17}{what:<44}{found:>6.2f}{verdict}")


if __name__ == "__main__":
    main()
