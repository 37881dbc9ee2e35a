#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fits the constants of the forecast, src/forecast/model/curves.cpp, to a table of constructions that forecast_runs.py has made.

  fit_forecast.py benchmarks/history/DATE-COMMIT-forecast.csv            prints how well the curves fit and extrapolate
  fit_forecast.py benchmarks/history/DATE-COMMIT-forecast.csv --write    also writes the constants

For each kind and dimension, with v vertices, affine dimension k and s = v^(-1/k):
  spread    log(cells / v) = log(cells per point of a Poisson process) + a polynomial in s without constant term
  free      log(cells / v) = a polynomial in log(v); beyond the last measurement its slope falls like s
  lattice   cells / (k! * volume of the box) = a constant
  moment    the closed form for the moment curve, as far as rounding lets it hold
Ratios of created to finite cells are polynomials in s, those of infinite to finite cells lines in log(v), all as logarithms.
"""
import argparse
import collections
import csv
import math
import pathlib
import statistics

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUTPUT = ROOT / "src" / "forecast" / "model" / "curves.cpp"
SPREAD = {"uniform", "ball", "gaussian", "clusters", "plummer", "offset", "duplicates", "flat"}
LATTICES = {"grid", "tilted_grid"}  # nudged ones have no ties, and grow freely


def poisson_cells(k):
    """Expected cells per point of the Delaunay triangulation of a Poisson process in k dimensions."""
    g = math.lgamma
    return math.exp((k + 1) * math.log(2) + (k - 1) / 2 * math.log(math.pi) - math.log(k * k * (k + 1)) + g((k * k + 1) / 2)
                    - g(k * k / 2) + k * (g(1 + k / 2) - g((k + 1) / 2)))


def lattice_box(d, n):
    """(affine dimension, volume of the hull) of the first n points of the grid of ceil(n^(1/d)) points per axis."""
    side = 1
    while side ** d < n:
        side += 1
    return lattice_slab(d, n, side)


def extents(d, n, side):
    """The largest value of each coordinate among the first n points in lexicographic order."""
    result = []
    for j in range(d):
        layer = side ** (d - 1 - j)
        top = (n + layer - 1) // layer - 1
        result.append(float(min(top, side - 1)))
        if top > 0:
            return result + [side - 1.0] * (d - 1 - j)
    return result


def lattice_slab(d, n, side):
    if d == 0 or n <= 1:
        return 0, 1.0
    layer = side ** (d - 1)
    full, rest = divmod(n, layer)
    if full == 0 or n == layer:
        return lattice_slab(d - 1, n, side)
    whole = float(side - 1) ** (d - 1)
    volume = (full - 1) * whole
    if rest > 0:
        top = extents(d - 1, rest, side)
        steps = 64
        volume += sum(math.prod((1 - t) * (side - 1) + t * e for e in top) for t in ((i + 0.5) / steps for i in range(steps))) / steps
    return d, volume


def moment_cells(k, v):
    return math.comb(v - (k + 1) // 2, (k + 1) // 2) if k % 2 else math.comb(v - 1 - k // 2, k // 2)


def fit(x, y, weights, powers):
    columns = numpy.array([[xi ** p for p in powers] for xi in x])
    w = numpy.sqrt(numpy.array(weights))
    return numpy.linalg.lstsq(columns * w[:, None], numpy.array(y) * w, rcond=None)[0]


def evaluate(c, x, powers):
    return sum(ci * x ** p for ci, p in zip(c, powers))


class Row:
    def __init__(self, row):
        self.n, self.k, self.v, self.cells, self.infinite, self.created = (int(row[x]) for x in (
            "points", "affine_dimension", "vertices", "cells", "infinite_cells", "created_cells"))
        self.seconds, self.bytes = float(row["seconds"]), float(row["bytes"])


def family_of(kind, rows):
    k = rows[-1].k
    if k <= 1:
        return "line"
    if kind in LATTICES:
        return "lattice"
    if kind == "moment" and all(0.98 < r.cells / moment_cells(k, r.v) < 1.02 for r in rows if r.v > 2 * k):
        return "moment"
    return "spread" if kind in SPREAD else "free"


NANOSECONDS_PER_POINT = 60  # to order points, and to meet duplicates (points_seconds in cost.cpp)


def nanoseconds_per_cell(r):
    return max(1e9 * r.seconds - NANOSECONDS_PER_POINT * r.n, 0.2e9 * r.seconds) / max(r.created, 1)


def bytes_per_cell(dimension, rows):
    """Of the largest set: what is left without the points, whose share the forecast adds again (bytes_of_points in cost.cpp)."""
    rows = [r for r in rows if r.bytes > 4e6] or rows
    r = rows[-1]
    rest = r.bytes - r.n * (8 * dimension + 8) - 12 * r.v
    return max(rest - min(rest / 2, 2.5e6), 0.0) / (r.cells + r.infinite)


class Curve:
    """What is fitted for one kind and dimension."""

    def __init__(self, kind, dimension, rows):
        self.kind, self.dimension = kind, dimension
        self.k = max(r.k for r in rows)
        self.family = family_of(kind, rows)
        everything = rows
        rows = [r for r in rows if r.k == self.k and r.v > self.k + 2]
        wrapped = [r for r in rows if self.k >= 7 and r.created < 1.2 * (r.cells + r.infinite)]
        if self.family == "lattice":
            rows = [r for r in rows if lattice_box(dimension, r.n)[0] == self.k] or rows
        self.first, self.last = rows[0].v, rows[-1].v
        fine = [r for r in rows if r.v >= 2 * self.k + 2]
        if len(fine) < 4:
            fine = rows
        s = [r.v ** (-1 / self.k) for r in fine]
        log_v = [math.log(r.v) for r in fine]
        weights = [2.0 ** i for i in range(len(fine))] if len(fine) < 6 else [1.3 ** i for i in range(len(fine))]
        few = len(fine) < 3
        self.cells = [0.0] * 5
        if self.family == "spread":
            powers = [1, 2, 3, 4][:max(1, min(4, len(fine) - 1))]
            y = [math.log(r.cells / r.v / poisson_cells(self.k)) for r in fine]
            self.cells = [*fit(s, y, weights, powers), 0, 0, 0, 0][:5]
        elif self.family == "free":
            powers = [0, 1, 2, 3][:max(1, min(4, len(fine) - 1 if len(fine) > 3 else len(fine)))]
            c = fit(log_v, [math.log(r.cells / r.v) for r in fine], weights, powers)
            tail = fine[-3:] if len(fine) > 5 else fine[-2:]
            excess = 0.0
            if len(tail) > 1:
                excess = fit([math.log(r.v) for r in tail], [math.log(r.cells / r.v) for r in tail], [1] * len(tail), [0, 1])[1]
                excess *= math.sqrt(tail[-1].v / tail[0].v) ** (-1 / self.k)  # at the last measurement
            self.cells = [*c, 0, 0, 0][:4] + [excess]
        elif self.family == "lattice":
            ratio = [math.log(r.cells / math.factorial(self.k) / lattice_box(dimension, r.n)[1]) for r in fine]
            powers = [0, 1] if len(fine) > 2 else [0]
            self.cells = [*fit(s, ratio, weights, powers), 0, 0, 0, 0][:5]
        inserted = [(si, w, r) for si, w, r in zip(s, weights, fine) if r not in wrapped]
        inserted = inserted or [(r.v ** (-1 / self.k), 1, r) for r in rows if r not in wrapped][-2:]
        powers = [0, 1, 2][:max(1, min(3, len(inserted) - 2))]
        self.created = [*fit([i[0] for i in inserted], [math.log(max(i[2].created, 1) / i[2].cells) for i in inserted],
                             [i[1] for i in inserted], powers), 0, 0, 0][:3]
        powers = [0, 1][:max(1, min(2, len(fine) - 1))]
        self.infinite = [*fit(log_v, [math.log(r.infinite / r.cells) for r in fine], weights, powers), 0][:2]
        timed = [i[2] for i in inserted if i[2].seconds > 0.02][-3:] or [inserted[-1][2]]
        self.nanoseconds, self.slowdown = min(nanoseconds_per_cell(r) for r in timed), 0.0
        self.bytes = bytes_per_cell(dimension, [r for r in everything if r not in wrapped])
        self.wrapping = [0.0, 0.0]
        if wrapped:
            self.wrapping = [min(nanoseconds_per_cell(r) for r in wrapped[-3:]), bytes_per_cell(dimension, wrapped)]

    def take_times(self, rows):
        """Nanoseconds from measurements on a quiet machine, as far as there are some."""
        inserted = [r for r in rows if not (self.wrapping[0] and r.created < 1.2 * (r.cells + r.infinite))]
        wrapped = [r for r in rows if r not in inserted]
        # Of a size measured twice, the quicker; of the largest sizes, what they tell of the slowdown.
        best = {}
        for r in inserted:
            best[r.v] = min(best.get(r.v, math.inf), nanoseconds_per_cell(r))
        if len(best) > 1:
            largest = sorted(best)[-4:]
            line = fit([math.log(v / self.last) for v in largest], [math.log(best[v]) for v in largest], [1] * len(largest), [0, 1])
            self.slowdown = min(max(line[1], 0.0), 0.35)
            middle = statistics.fmean(math.log(best[v]) - self.slowdown * math.log(v / self.last) for v in largest)
            self.nanoseconds = math.exp(middle)
        elif best:
            self.nanoseconds = min(best.values())
        if wrapped:
            self.wrapping[0] = statistics.median(nanoseconds_per_cell(r) for r in wrapped)

    def cells_of(self, n, v):
        s, log_v = v ** (-1 / self.k), math.log(v)
        if self.family == "line":
            return v - 1
        if self.family == "moment":
            return moment_cells(self.k, v)
        if self.family == "spread":
            return v * poisson_cells(self.k) * math.exp(evaluate(self.cells, s, [1, 2, 3, 4]))
        if self.family == "lattice":
            k, volume = lattice_box(self.dimension, n)
            return math.factorial(k) * volume * math.exp(evaluate(self.cells, s, [0, 1]))
        ratio = evaluate(self.cells, min(log_v, math.log(self.last)), [0, 1, 2, 3])
        if v > self.last:
            ratio += self.cells[4] * self.k * (1 - (v / self.last) ** (-1 / self.k))
        return v * math.exp(ratio)

    def created_of(self, cells, v):
        return cells * math.exp(evaluate(self.created, v ** (-1 / self.k), [0, 1, 2]))


def as_cpp(curves, reference):
    def numbers(values):
        return "{" + ", ".join(f"{x:.5g}" for x in values) + "}"

    lines = []
    for c in curves:
        lines.append(f'    {{"{c.kind}", {c.dimension}, {c.k}, Growth::{c.family}, {c.first}, {c.last},\n     {numbers(c.cells)}, {numbers(c.created)}, '
                     f'{numbers(c.infinite)},\n     {c.nanoseconds:.4g}, {c.slowdown:.3g}, {c.bytes:.4g}, {c.wrapping[0]:.4g}, {c.wrapping[1]:.4g}}},')
    body = "\n".join(lines)
    return f"""// SPDX-License-Identifier: BSD-3-Clause
// Written by benchmarks/fit_forecast.py.
// clang-format off
#include "forecast/model/curves.hpp"

namespace delone::cost_model {{
namespace {{

constexpr Curve measured[] = {{
{body}
}};

}}  // namespace

std::span<const Curve> curves() {{ return measured; }}
double reference_nanoseconds() {{ return {reference:.4g}; }}

}}  // namespace delone::cost_model
"""


def read(path):
    groups = collections.OrderedDict()
    with open(path, newline="", encoding="ascii") as file:
        for row in csv.DictReader(file):
            groups.setdefault((int(row["dimension"]), row["kind"]), []).append(Row(row))
    return {key: sorted(rows, key=lambda r: r.n) for key, rows in groups.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--reference", type=float, help="nanoseconds per created cell of the set that tells the speed of a machine")
    parser.add_argument("--times", help="measurements on a quiet machine: kind, dimension, points, cells, infinite_cells, created_cells, seconds")
    arguments = parser.parse_args()
    times = collections.defaultdict(list)
    if arguments.times:
        with open(arguments.times, newline="", encoding="ascii") as file:
            for row in csv.DictReader(file):
                times[int(row["dimension"]), row["kind"]].append(
                    Row({**row, "affine_dimension": 0, "vertices": row["points"], "bytes": 0}))
    curves = []
    for (dimension, kind), rows in sorted(read(arguments.table).items()):
        rows = [r for r in rows if r.cells > 0 and r.k > 0]
        if kind in ("equal", "cube01") or not any(r.v > r.k + 2 for r in rows):
            continue
        curve = Curve(kind, dimension, rows)
        curve.take_times(times[dimension, kind])
        curves.append(curve)
        inside = [curve.cells_of(r.n, r.v) / r.cells for r in rows if r.v > 3 * curve.k and r.k == curve.k]
        ahead = ""
        shorter = [r for r in rows if r.n <= rows[-1].n / 8]
        if shorter and len([r for r in shorter if r.k == curve.k and r.v > curve.k + 2]) > 2:
            early = Curve(kind, dimension, shorter)
            cells = early.cells_of(rows[-1].n, rows[-1].v)
            ahead = f"  8 times as many: {cells / rows[-1].cells:.2f} created {early.created_of(cells, rows[-1].v) / rows[-1].created:.2f}"
        print(f"{kind:<13}{dimension}D k={curve.k} {curve.family:<8} {curve.first:>5}..{curve.last:<8} {curve.nanoseconds:8.0f} ns * v^{curve.slowdown:.2f}  "
              f"fit {min(inside, default=1):.2f}..{max(inside, default=1):.2f}{ahead}")
    # Single measurements of times vary more than kinds that are spread evenly do.
    for dimension in range(4, 9):
        alike = [c for c in curves if c.dimension == dimension and c.family == "spread" and c.kind != "flat"]
        if len(alike) < 3:
            continue
        middle = statistics.median(c.nanoseconds for c in alike)
        wrapping = [c.wrapping[0] for c in alike if c.wrapping[0] > 0]
        for c in alike:
            c.nanoseconds = math.sqrt(c.nanoseconds * middle)
            if c.wrapping[0] > 0:
                c.wrapping[0] = math.sqrt(c.wrapping[0] * statistics.median(wrapping))
    if arguments.write:
        reference = next((c.nanoseconds for c in curves if c.kind == "uniform" and c.dimension == 3), 60)
        OUTPUT.write_text(as_cpp(curves, arguments.reference or reference), encoding="ascii")


if __name__ == "__main__":
    main()
