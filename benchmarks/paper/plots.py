# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the report, redrawn from the records, as PNG. Files are the same for the same records."""
import math

import matplotlib
import numpy
from PIL import Image

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)
from matplotlib import ticker  # noqa: E402

from . import report_2008  # noqa: E402
from .results import cells_at_a_vertex, cpu  # noqa: E402

COLORS = {1: "#7f7f7f", 2: "#1f77b4", 3: "#2ca02c", 4: "#d62728", 5: "#9467bd", 6: "#ff7f0e", 7: "#8c564b", 8: "#17becf"}
STYLE = {"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False,
         "axes.spines.right": False, "figure.dpi": 130}


def points(record):
    return record["points"]


def megabytes(record):
    return record["peak_bytes"] / 1e6


def series(axis, records, x, y, style="-o", label=None, color=None, width=1.4):
    records = [r for r in records if y(r) > 0]  # the memory of a process that ended before it was looked at is not known
    if records:
        axis.plot([x(r) for r in records], [y(r) for r in records], style, label=label, color=color, markersize=3, linewidth=width)


def figure(panels):
    """A figure with panels side by side, all axes logarithmic."""
    made, axes = plt.subplots(1, panels, figsize=(4.2 * panels, 3.6), squeeze=False)
    for axis in axes[0]:
        axis.set_xscale("log")
        axis.set_yscale("log")
    return made, list(axes[0])


def plain(value, _):
    """1 000 000, 20 or 0.05; powers of ten beyond."""
    if 1e-3 <= value < 1e7:
        return f"{value:,.0f}".replace(",", " ") if value >= 1000 else f"{value:.3g}"
    return f"$10^{{{math.log10(value):g}}}$"


def ticks(axis):
    """Labels of a logarithmic axis, also between the powers of ten if it has few of these."""
    if axis.get_scale() != "log":
        return
    low, high = axis.get_view_interval()
    decades = math.log10(high / low)
    axis.set_major_locator(ticker.LogLocator(subs=(1.0,) if decades > 2.5 else (1.0, 3.0) if decades > 1.5 else (1.0, 2.0, 5.0)))
    axis.set_major_formatter(ticker.FuncFormatter(plain))
    axis.set_minor_formatter(ticker.NullFormatter())


def label(axis, title, x="points", y=""):
    axis.set_title(title, fontsize=9)
    axis.set_xlabel(x)
    axis.set_ylabel(y)
    ticks(axis.xaxis)
    ticks(axis.yaxis)
    if axis.get_legend_handles_labels()[0]:
        axis.legend(fontsize=7, frameon=False)


def save(made, folder, name):
    made.tight_layout()
    write_png(made, folder / f"{name}.png")
    plt.close(made)


def write_png(made, path):
    """A picture of few colors, which takes a third of the bytes and looks the same."""
    made.canvas.draw()
    picture = Image.fromarray(numpy.asarray(made.canvas.buffer_rgba())[:, :, :3])
    picture.quantize(64, dither=Image.Dither.NONE).save(path, optimize=True)


def figure_1(results, folder):
    made, (time, space) = figure(2)
    for d in results.dimensions("uniform"):
        records = results.ok("uniform", "delone", d)
        series(time, records, points, cpu, label=f"{d}D", color=COLORS[d])
        series(space, records, points, megabytes, label=f"{d}D", color=COLORS[d])
        if d in report_2008.FIT and records:
            sizes = [r["points"] for r in records]
            time.plot(sizes, [report_2008.seconds(d, n) for n in sizes], "--", color=COLORS[d], linewidth=0.9)
    label(time, "processor seconds (dashed: the fit of 2008)")
    label(space, "peak memory of the process, MB")
    save(made, folder, "figure-1")


def figure_2(results, folder):
    made, (flow, valence) = figure(2)
    for d in results.dimensions("uniform"):
        records = results.ok("uniform", "delone", d)
        series(flow, records, lambda r: r["cells"], lambda r: r["cells"] / cpu(r), label=f"{d}D", color=COLORS[d])
        series(valence, records, points, cells_at_a_vertex, label=f"{d}D", color=COLORS[d])
        valence.axhline(report_2008.cells_at_a_vertex(d), linestyle=":", color=COLORS[d], linewidth=0.9)
    label(flow, "final cells per second", x="cells")
    label(valence, "cells at a vertex (dotted: without a boundary)")
    save(made, folder, "figure-2")


def figure_3(results, folder):
    made, (visited, ratio, time) = figure(3)
    visited.set_yscale("linear")
    for d in results.dimensions("order"):
        by_key = {key: {r["points"]: r for r in results.ok("order", key, d)} for key in ("delone", "delone:report", "delone:shuffled")}
        sizes = sorted(set.intersection(*(set(found) for found in by_key.values())))
        walk = {key: [found[n]["visited_cells"] / found[n]["insertions"] for n in sizes] for key, found in by_key.items()}
        seconds = {key: [cpu(found[n]) for n in sizes] for key, found in by_key.items()}
        visited.plot(sizes, walk["delone"], "-o", color=COLORS[d], markersize=3, label=f"{d}D")
        visited.plot(sizes, walk["delone:report"], "--", color=COLORS[d], linewidth=0.9)
        ratio.plot(sizes, [a / b for a, b in zip(walk["delone:shuffled"], walk["delone"])], "-o", color=COLORS[d], markersize=3, label=f"{d}D")
        ratio.plot(sizes, [a / b for a, b in zip(walk["delone:shuffled"], walk["delone:report"])], "--", color=COLORS[d], linewidth=0.9)
        time.plot(sizes, [a / b for a, b in zip(seconds["delone"], seconds["delone:shuffled"])], "-o", color=COLORS[d], markersize=3, label=f"{d}D")
        time.plot(sizes, [a / b for a, b in zip(seconds["delone:report"], seconds["delone:shuffled"])], "--", color=COLORS[d], linewidth=0.9)
    label(visited, "visited cells per insertion\n(dashed: rounds as in 2008)")
    label(ratio, "walk: shuffled / sorted")
    time.axhline(1.0, linestyle=":", color="black", linewidth=0.9)
    label(time, "time: sorted / shuffled")
    save(made, folder, "figure-3")


def compare(results, folder, name, experiment, drawn, dimensions):
    """Time and memory: delone dashed, others drawn; `drawn` is program key -> style."""
    made, (time, space) = figure(2)
    for d in dimensions:
        ours = results.ok(experiment, "delone", d)
        series(time, ours, points, cpu, "--", color=COLORS[d], label=f"{d}D")
        series(space, ours, points, megabytes, "--", color=COLORS[d])
        for key, style in drawn.items():
            theirs = results.ok(experiment, key, d)
            series(time, theirs, points, cpu, style, color=COLORS[d])
            series(space, theirs, points, megabytes, style, color=COLORS[d])
    for key, style in {"delone": "--", **drawn}.items():
        space.plot([], [], style, color="black", markersize=3, linewidth=1.4, label=results.name(key))
    label(time, "processor seconds (dashed: delone)")
    label(space, "peak memory of the process, MB")
    save(made, folder, name)


def figure_4(results, folder):
    made, (time, space) = figure(2)
    for d in results.dimensions("manifold"):
        surface = results.ok("manifold", "delone", d)
        last = max((r["points"] for r in surface), default=0)
        uniform = [r for r in results.ok("uniform", "delone", d) if r["points"] <= last]
        for axis, y in ((time, cpu), (space, megabytes)):
            series(axis, uniform, points, y, "--", color=COLORS[d])
            series(axis, surface, points, y, label=f"{d}D", color=COLORS[d])
    label(time, "processor seconds (dashed: uniform)")
    label(space, "peak memory of the process, MB")
    save(made, folder, "figure-4")


def all_figures(results, folder):
    folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        figure_1(results, folder)
        figure_2(results, folder)
        figure_3(results, folder)
        figure_4(results, folder)
        uniform = results.dimensions("uniform")
        compare(results, folder, "figure-5", "uniform", {"qhull": "-o"}, uniform)
        if results.ok("uniform", "clarkson"):
            compare(results, folder, "figure-6", "uniform", {"clarkson": "-o"}, uniform)
        compare(results, folder, "figure-7-cgal", "uniform", {"cgal_d": "-s"}, uniform)
        compare(results, folder, "figure-7-cddlib", "small", {"cddlib": "-o", "cddlib_gmp": "-s", "lrs": "-^"}, results.dimensions("small"))
