#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of docs/performance.md and benchmarks/figures.md from the newest records in benchmarks/history/.

  tables.py            replaces what is between <!-- figures: NAME --> and <!-- end of figures -->
  tables.py --check    only says whether the pages have the newest figures; status 1 if not
"""
import argparse
import re
import sys

import record

PAGES = (record.ROOT / "docs" / "performance.md", record.ROOT / "benchmarks" / "figures.md")
BLOCK = re.compile(r"(<!-- figures: ([a-z ]+) -->\n).*?(<!-- end of figures -->)", re.S)


def number(x, digits=3):
    """About `digits` significant digits, never in exponential form."""
    if x == 0:
        return "0"
    magnitude = len(str(int(abs(x)))) if abs(x) >= 1 else 0
    return f"{x:.{max(digits - magnitude, 0)}f}" if magnitude < 5 else f"{x:,.0f}".replace(",", " ")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def origin(kind):
    """The line below a table: date, commit, machine and build of its record."""
    r = record.newest(kind)
    return (f"{r['date']}, commit {r['commit']}, {r['machine']}, load {r['load']}, {r['compiler'].replace('c++ (', 'g++ (')}, `{r['flags']}`, "
            f"{r['threads']} thread.")


def construction():
    rows = []
    for name, f in record.newest("construction")["results"].items():
        if name.startswith("uniform") and f["created_cells"] > 1e6:
            rows.append((name, number(f["cells"]), number(f["created_cells"] / f["points"]), number(f["cpu_seconds"]),
                         number(f["ns_per_created_cell"]), number(f["least_ns_per_created_cell"]), number(f["bytes_per_cell"]),
                         number(f["peak_rss_bytes"] / 1e6)))
    head = ("points", "cells", "created per point", "processor s", "ns per created cell", "least", "bytes per cell", "peak MB")
    return table(head, rows)


def degenerate():
    rows = []
    for name, f in record.newest("construction")["results"].items():
        if "vs_reference" in f:
            s = f["stages"]
            asked = sum(s[stage] for stage in ("filter", "direct", "exact"))
            rows.append((name, number(f["cells"]), number(f["cpu_seconds"]), number(f["ns_per_created_cell"]),
                         number(f["vs_reference"]), *(f"{100 * s[stage] / asked:.3g} %" for stage in ("direct", "exact", "perturbed"))))
    head = ("points", "cells", "processor s", "ns per created cell", "× uniform", "direct", "exact", "perturbed")
    return table(head, rows)


PHASES = {"walk": "walk", "search": "conflict zone", "slots": "creation: slots, vertices, mirrors, hashes", "functionals": "creation: functionals",
          "gluing": "gluing, releasing", "order": "order", "pages": "kernel: fresh pages", "rest": "rest", "whole": "**whole**"}


def phases():
    results = record.newest("phases")["results"]
    columns = [name.split("/")[1] for name in results]
    rows = [(title, *(number(f[phase], 2 if f[phase] < 100 else 3) for f in results.values())) for phase, title in PHASES.items()]
    return table(("ns per created cell", *columns), rows)


def touch():
    touched, whole = record.newest("touch")["results"], record.newest("phases")["results"]
    rows = []
    for name, f in touched.items():
        dimension = name.split("/")[1]
        total = whole.get(name.replace("touch", "phases"), {}).get("whole")
        rows.append((dimension, number(f["bytes_per_cell"]), number(f["megabytes"]), number(f["warm"], 2), number(f["fresh"], 2),
                     *((number(total), number(total / f["fresh"], 2)) if total else ("", ""))))
    head = ("uniform", "bytes per cell", "memory, MB", "touching it, ns", "fresh pages included, ns", "construction, ns", "ratio")
    return table(head, rows)


def order():
    rows = []
    results = record.newest("order")["results"]
    for name, f in results.items():
        if not name.startswith("sort/"):
            continue
        _, _, dimension, n = name.split("/")
        built = {which: results.get(f"build/{which}/{dimension}/{n}") for which in ("automatic", "shuffled", "online")}
        show = lambda which, key, digits=3: number(built[which][key], digits) if built[which] else "–"
        rows.append((dimension, n, number(f["ns_per_point"]), show("automatic", "created_per_insertion"), show("shuffled", "created_per_insertion"),
                     show("automatic", "visited_per_insertion"), show("shuffled", "visited_per_insertion"),
                     *(number(built[which]["seconds"] / built["automatic"]["seconds"], 2) if built[which] else "–" for which in ("shuffled", "online"))))
    head = ("", "points", "sorting, ns per point", "created: sorted", "random", "visited: sorted", "random", "time: random batch ÷ sorted", "one by one ÷ sorted")
    return table(head, rows)


def kernel():
    results = record.newest("kernel")["results"]
    dimensions = [f"{d}D" for d in range(2, 9)]
    rows = {}
    for name, f in results.items():
        stage, form, *input_of, dimension = name.split("/")
        cells = rows.setdefault((stage, form, *input_of), {})
        cells[dimension] = number(f["ns_per_item"] if "ns_per_item" in f else f["ns"])
        if stage == "direct" and f["decided"] < 0.995:
            cells[dimension] += f" ({100 * f['decided']:.0f} %)"
    shown = [key for key in rows if key[1] != "furthest"]
    shown.sort(key=lambda key: (("filter", "direct", "exact", "perturbed").index(key[0]), key[1]))
    return table(("ns per call", *dimensions), [(", ".join(key), *(rows[key].get(d, "") for d in dimensions)) for key in shown])


def hulls():
    rivals = ("Qhull", "CGAL 3D", "CGAL dD", "cddlib", "lrs")
    rows = []
    for name, programs in record.newest("hulls")["results"].items():
        figures = {f["program"]: f for f in programs.values()}
        own = figures.pop("delone")
        ratios = (number(figures[rival]["cpu_seconds"] / own["cpu_seconds"], 2) if rival in figures else "" for rival in rivals)
        rows.append((name, f"{own['facets']:,}".replace(",", " "), f"{own['cpu_seconds']:.2g}", *ratios))
    return table(("points", "facets", "delone, processor s", *(f"{rival} ÷ delone" for rival in rivals)), rows)


TABLES = {"construction": construction, "degenerate": degenerate, "phases": phases, "touch": touch, "order": order, "kernel": kernel, "hulls": hulls}


def block(match):
    start, name, end = match.groups()
    try:
        return f"{start}\n{TABLES[name]()}\n\n{origin('construction' if name == 'degenerate' else name)}\n\n{end}"
    except record.NoRecord as error:
        print(f"{name}: {error}; left as it is", file=sys.stderr)
        return match.group()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    stale = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        new = BLOCK.sub(block, text)
        if new != text:
            stale.append(page.relative_to(record.ROOT).as_posix())
        if not options.check:
            page.write_text(new, encoding="utf-8")
    if options.check and stale:
        sys.exit(f"{' and '.join(stale)} lack the newest figures: run benchmarks/tables.py")


if __name__ == "__main__":
    main()
