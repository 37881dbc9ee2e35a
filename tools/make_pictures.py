#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the documentation, docs/pictures/*.png, with the Python module and Matplotlib:

    PYTHONPATH=build/release/python tools/make_pictures.py [FOLDER]
"""
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import delone  # noqa: E402
from delone import spatial  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
INK, ACCENT, SOFT = "#1f3a5f", "#c8553d", "#9fb4c7"


def read(name):
    """The columns of data/NAME.csv, by their names."""
    table = np.genfromtxt(ROOT / "data" / f"{name}.csv", delimiter=",", names=True)
    return {column: table[column] for column in table.dtype.names}


def plane(path):
    """A Delaunay triangulation and its Voronoi diagram."""
    points = np.random.default_rng(7).random((60, 2))
    tri, diagram = spatial.Delaunay(points), spatial.Voronoi(points)
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.4), sharex=True, sharey=True)
    axes[0].triplot(*points.T, tri.simplices, color=SOFT, lw=1)
    axes[0].triplot(*points.T, tri.simplices[tri.find_simplex([[0.62, 0.55]])], color=ACCENT, lw=2)
    spatial.voronoi_plot_2d(diagram, ax=axes[1], show_points=False, show_vertices=False, line_colors=INK, line_width=1)
    for ax, title in zip(axes, ["Delaunay triangulation, a cell located", "Voronoi diagram"]):
        ax.plot(*points.T, "o", color=INK, ms=3)
        ax.set(title=title, xlim=(-0.08, 1.08), ylim=(-0.08, 1.08), aspect="equal", xticks=[], yticks=[])
    save(figure, path)


def circumradii(tri):
    """The radius of the sphere of each cell."""
    inverse = tri.transform[:, :-1]
    edges = tri.points[tri.cells[:, :-1]] - tri.points[tri.cells[:, -1:]]
    return np.linalg.norm(np.einsum("mij,mi->mj", inverse, (edges**2).sum(axis=2) / 2), axis=1)


def bunny(path):
    """The tetrahedra of a scanned surface that have small spheres, and the triangles around them."""
    columns = read("bunny")
    tri = delone.Delaunay(np.stack([columns["x"], columns["z"], columns["y"]], axis=1))
    radii = circumradii(tri)
    size = np.ptp(tri.points, axis=0).max()
    figure = plt.figure(figsize=(9, 4.2))
    for i, share in enumerate([0.07, 0.13, np.inf]):
        kept = radii < share * size
        beyond = ~np.append(kept, False)[tri.neighbors]  # neighbor −1 is the last entry: not kept
        cell, opposite = np.nonzero(kept[:, None] & beyond)
        surface = tri.cells[cell][np.arange(4) != opposite[:, None]].reshape(-1, 3)
        ax = figure.add_subplot(1, 3, i + 1, projection="3d")
        ax.plot_trisurf(*tri.points.T, triangles=surface, color=SOFT, edgecolor=INK, lw=0.1)
        ax.set_title("all cells" if np.isinf(share) else f"radius < {share:.0%} of the size", fontsize=10)
        ax.view_init(12, -70)
        ax.set_box_aspect(np.ptp(tri.points, axis=0), zoom=1.4)
        ax.set_axis_off()
    save(figure, path)


def earthquakes(path):
    """The magnitude, interpolated in longitude, latitude, depth and time: maps at two times."""
    columns = read("earthquakes")
    west = (columns["longitude"] > -126) & (columns["longitude"] < -112) & (columns["latitude"] > 31) & (columns["latitude"] < 45)
    days = (columns["time_ms"] - columns["time_ms"].min()) / 86_400_000
    where = np.stack([columns["longitude"], columns["latitude"], columns["depth_km"] / 20, days], axis=1)[west]
    magnitude = delone.LinearInterpolator(where, columns["magnitude"][west])
    longitude, latitude = np.meshgrid(np.linspace(-125, -113, 240), np.linspace(32, 44, 240))
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.9), sharey=True)
    for ax, day in zip(axes, [2, 5]):
        queries = np.stack([longitude, latitude, np.full_like(longitude, 6 / 20), np.full_like(longitude, day)], axis=-1)
        values = magnitude(queries.reshape(-1, 4)).reshape(longitude.shape)
        image = ax.pcolormesh(longitude, latitude, values, cmap="YlOrRd", vmin=0, vmax=3.5, shading="auto", rasterized=True)
        ax.plot(*where[np.abs(where[:, 3] - day) < 0.5, :2].T, ".", color=INK, ms=3)
        ax.set(title=f"day {day}, depth 6 km", xlabel="longitude", xlim=(-125, -113), ylim=(32, 44))
    axes[0].set_ylabel("latitude")
    figure.colorbar(image, ax=axes, label="magnitude")
    save(figure, path, tight=False)


def save(figure, path, tight=True):
    if tight:
        figure.tight_layout()
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    for draw in (plane, bunny, earthquakes):
        draw(folder / f"{draw.__name__}.png")


if __name__ == "__main__":
    main()
