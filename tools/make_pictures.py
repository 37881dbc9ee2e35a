#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the documentation, docs/pictures/*.png, with the Python module and Matplotlib:

    PYTHONPATH=build/release/python tools/make_pictures.py [FOLDER]
"""
import pathlib
import sys
import time

import matplotlib
import numpy as np
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

import delone  # noqa: E402
from delone import spatial  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
INK, ACCENT, SOFT, TINT = "#1f3a5f", "#c8553d", "#9fb4c7", "#f6d9d2"


def read(name):
    """The columns of data/NAME.csv, by their names."""
    table = np.genfromtxt(ROOT / "data" / f"{name}.csv", delimiter=",", names=True)
    return {column: table[column] for column in table.dtype.names}


def draw_triangulation(ax, points):
    """A Delaunay triangulation and the cell that contains one place."""
    tri = spatial.Delaunay(points)
    ax.triplot(*points.T, tri.simplices, color=SOFT, lw=1)
    ax.fill(*points[tri.simplices[tri.find_simplex([0.62, 0.55])]].T, facecolor=TINT, edgecolor=ACCENT, lw=1.5, zorder=3)
    dots(ax, points)


def draw_diagram(ax, points):
    """The Voronoi diagram, and one of its regions."""
    diagram = spatial.Voronoi(points)
    spatial.voronoi_plot_2d(diagram, ax=ax, show_points=False, show_vertices=False, line_colors=INK, line_width=1)
    site = np.argmin(np.linalg.norm(points - [0.62, 0.55], axis=1))
    corners = diagram.vertices[diagram.regions[diagram.point_region[site]]]
    around = corners[np.argsort(np.arctan2(*(corners - points[site]).T))]
    ax.fill(*around.T, facecolor=TINT, edgecolor=ACCENT, lw=1.5, zorder=3)
    dots(ax, points)


def dots(ax, points):
    ax.plot(*points.T, "o", color=INK, ms=3, zorder=4)
    ax.set(xlim=(-0.05, 1.05), ylim=(-0.05, 1.05), aspect="equal", xticks=[], yticks=[])


def sixty_points():
    return np.random.default_rng(7).random((60, 2))


def plane(path):
    """A Delaunay triangulation and its Voronoi diagram."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.4))
    for ax, draw, title in zip(axes, [draw_triangulation, draw_diagram], ["Delaunay triangulation, a cell located", "Voronoi diagram, a region"]):
        draw(ax, sixty_points())
        ax.set_title(title)
    save(figure, path)


def overview(path):
    """What the library is for, for the README."""
    figure = plt.figure(figsize=(10.5, 3.4))
    for i, draw in enumerate([draw_triangulation, draw_diagram]):
        ax = figure.add_subplot(1, 3, i + 1)
        draw(ax, sixty_points())
        ax.set_title(["Delaunay triangulation", "Voronoi diagram"][i], fontsize=10)
        ax.set_frame_on(False)
    ax = figure.add_subplot(1, 3, 3, projection="3d")
    tri = delone.Delaunay(atoms())
    draw_alpha_shape(ax, tri, tri.circumradii, 2.6)
    ax.set_title("alpha shape of a protein, in space", fontsize=10)
    save(figure, path)


def draw_alpha_shape(ax, tri, radii, largest):
    """The surface of the cells whose circumradii are below a bound, seen and lit from above."""
    kept = radii < largest
    beyond = ~np.append(kept, False)[tri.neighbors]  # neighbor −1 is the last entry: not kept
    cell, opposite = np.nonzero(kept[:, None] & beyond)
    corners = tri.points[tri.cells[cell][np.arange(4) != opposite[:, None]].reshape(-1, 3)]
    inside = tri.points[tri.cells[cell, opposite]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals *= -np.sign((normals * (inside - corners[:, 0])).sum(axis=1))[:, None]
    light = np.array([-0.28, 0.35, 0.9])
    brightness = 0.25 + 0.75 * np.clip(normals @ light / np.linalg.norm(normals, axis=1), 0, 1)[:, None]
    dark, bright = (np.array(matplotlib.colors.to_rgb(color)) for color in (INK, "#e3ebf2"))
    ax.add_collection3d(Poly3DCollection(corners, facecolors=dark + brightness * (bright - dark), edgecolors=INK, lw=0.1))
    low, high = tri.points.min(axis=0), tri.points.max(axis=0)
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    ax.view_init(90, -90)
    ax.set_box_aspect(high - low, zoom=1.35)
    ax.set_axis_off()


def atoms():
    """The atoms of the protein along their principal axes, so that the longest is horizontal."""
    columns = read("protein")
    points = np.stack([columns["x"], columns["y"], columns["z"]], axis=1)
    points -= points.mean(axis=0)
    return points @ np.linalg.svd(points, full_matrices=False)[2].T


def protein(path):
    """Alpha shapes of a protein at three radii."""
    tri = delone.Delaunay(atoms())
    radii = tri.circumradii
    figure = plt.figure(figsize=(9, 2.7))
    for i, largest in enumerate([2.6, 6, np.inf]):
        ax = figure.add_subplot(1, 3, i + 1, projection="3d")
        draw_alpha_shape(ax, tri, radii, largest)
        ax.set_title("all cells" if np.isinf(largest) else f"radius < {largest} Å", fontsize=10)
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


def look_values(path):
    """Values at points and of regions: earthquakes."""
    columns = read("earthquakes")
    west = (columns["longitude"] > -126) & (columns["longitude"] < -112) & (columns["latitude"] > 31) & (columns["latitude"] < 45)
    points = np.stack([columns["longitude"], columns["latitude"]], axis=1)[west]
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 3.9))
    delone.Delaunay(points).plot(axes[0], values=columns["depth_km"][west], vmax=20, cmap="viridis_r", colorbar="depth in km")
    diagram = delone.Voronoi(points)
    box = [-125, 32], [-113, 44]
    diagram.plot(axes[1], values=diagram.region_volumes(box), box=box, norm=matplotlib.colors.LogNorm(1e-4, 10), colorbar="square degrees")
    for ax in axes:
        ax.set(xlabel="longitude", ylabel="latitude", xlim=(-125, -113), ylim=(32, 44))
    save(figure, path)


def look_curvature(path):
    """The Gaussian curvature of a bump, on the map and on the surface."""
    grid = np.stack(np.meshgrid(*[np.linspace(-2, 2, 81)] * 2), axis=-1).reshape(-1, 2)
    places = grid + np.random.default_rng(5).uniform(-0.01, 0.01, grid.shape)
    scan = np.c_[places, np.exp(-(places**2).sum(axis=1))]
    tri = delone.Delaunay(places)
    corners = scan[tri.cells]
    sides = np.roll(corners, -1, axis=1) - corners
    directions = sides / np.linalg.norm(sides, axis=2, keepdims=True)
    angles = np.arccos(-(directions * np.roll(directions, 1, axis=1)).sum(axis=2))
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    curvature = (2 * np.pi - np.bincount(tri.cells.ravel(), angles.ravel())) / (np.bincount(tri.cells.ravel(), np.repeat(areas, 3)) / 3)
    curvature[np.abs(places).max(axis=1) > 1.9] = np.nan
    figure = plt.figure(figsize=(9, 3.6))
    colors = {"cmap": "RdBu_r", "vmin": -2, "vmax": 2}
    ax = figure.add_subplot(1, 2, 1, aspect="equal")
    tri.plot(ax, values=curvature, colorbar="curvature", **colors)
    ax = figure.add_subplot(1, 2, 2, projection="3d")
    surface = ax.plot_trisurf(*scan.T, triangles=tri.cells, linewidth=0, antialiased=False, **colors)
    surface.set_array(np.ma.masked_invalid(curvature[tri.cells].mean(axis=1)))
    ax.set_box_aspect((4, 4, 1.6), zoom=1.3)
    ax.set_axis_off()
    save(figure, path)


def look_protein(path):
    """The surface of a protein in colors, and its convex hull."""
    points = atoms()
    tri = delone.Delaunay(points)
    figure = plt.figure(figsize=(9, 3.4))
    for i in range(2):
        ax = figure.add_subplot(1, 2, i + 1, projection="3d")
        if i == 0:
            tri.plot(ax, cells=tri.circumradii < 2.6, values=np.linalg.norm(points, axis=1), cmap="cividis", colorbar="Å from the center", linewidth=0.1)
        else:
            delone.ConvexHull(points).plot(ax, points=False)
        ax.set_box_aspect(np.ptp(points, axis=0), zoom=1.5)
        ax.view_init(40, -80)
        ax.set_axis_off()
    save(figure, path)


def ask_neighbors(path):
    """Defects of a crystal: numbers of neighbors, and the triangulation."""
    row, column = np.mgrid[:20, :20].reshape(2, -1)
    crystal = np.stack([column + row % 2 / 2, row * 3**0.5 / 2], axis=1) + np.random.default_rng(3).normal(scale=0.2, size=(400, 2))
    tri = delone.Delaunay(crystal)
    degree = np.bincount(tri.faces(1).vertices.ravel(), minlength=400)
    box = [1, 1], [18, 15]
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 3.7))
    tri.plot(axes[0], points=False)
    axes[0].plot(*crystal.T, "o", color=INK, ms=2)
    delone.Voronoi(tri).plot(axes[1], values=degree, box=box, cmap="coolwarm", vmin=4, vmax=8, colorbar="neighbors")
    for ax in axes:
        ax.set(xlim=(1, 18), ylim=(1, 15), aspect="equal", xticks=[], yticks=[])
    save(figure, path)


def ask_phases(path):
    """The phase diagram of three elements."""
    names = ["A", "B", "C", "AB", "AC", "BC", "A2BC", "ABC2"]
    phases = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, 0, -1], [0, 0.5, -0.5], [0.5, 0.5, 0.5], [0.25, 0.25, -0.625], [0.25, 0.5, -0.25]])
    hull = delone.lower_hull(phases)
    places = phases[:, :2] @ [[1, 0], [0.5, 0.75**0.5]]
    figure, ax = plt.subplots(figsize=(5.2, 3.7))
    ax.triplot(*places.T, hull.cells, color=INK, lw=1)
    dots = ax.scatter(*places.T, c=hull.height_above(phases), cmap="viridis_r", edgecolors=INK, s=60, zorder=3)
    for name, place in zip(names, places):
        ax.annotate(name, place, xytext=(6, 6), textcoords="offset points")
    figure.colorbar(dots, label="energy above the hull")
    ax.set(aspect="equal", xlim=(-0.1, 1.2), ylim=(-0.1, 1))
    ax.set_axis_off()
    save(figure, path)


def edit_window(path):
    """A stream of earthquakes in a window of two days: the distance of each from the nearest one, and the time that it takes."""
    columns = read("earthquakes")
    columns = {name: column[np.argsort(columns["time_ms"])] for name, column in columns.items()}
    longitude, latitude = np.radians(columns["longitude"]), np.radians(columns["latitude"])
    radius, hours = 6371 - columns["depth_km"], columns["time_ms"] / 3_600_000
    events = np.stack([radius * np.cos(latitude) * np.cos(longitude), radius * np.cos(latitude) * np.sin(longitude),
                       radius * np.sin(latitude), hours], axis=1)
    window, first = delone.Delaunay(events[:1]), 0
    nearest, by_editing, anew = np.full((3, len(events)), np.nan)
    for i in range(1, len(events)):
        start = time.perf_counter()
        end = first + np.searchsorted(events[first:i, 3], hours[i] - 48)
        window.edit(insert=events[i:i + 1], remove=np.arange(first, end))
        by_editing[i] = time.perf_counter() - start
        first = end
        start = time.perf_counter()
        delone.Delaunay(events[first:i + 1])
        anew[i] = time.perf_counter() - start
        nearest[i] = np.linalg.norm(events[first:i] - events[i], axis=1).min()
    days = (hours - hours[0]) / 24
    figure, axes = plt.subplots(2, 1, figsize=(9, 5.6), sharex=True, height_ratios=[3, 2])
    axes[0].plot(days, nearest, ".", color=SOFT, ms=3)
    swarms = [("The Geysers", 38.8, -122.8, "#2a9d8f"), ("Mammoth Lakes", 37.6, -118.8, "#8a5fbf"), ("Hualien, Taiwan", 24.1, 121.7, ACCENT)]
    for name, north, east, color in swarms:
        here = np.hypot(columns["latitude"] - north, (columns["longitude"] - east) * np.cos(np.radians(north))) < 0.5
        axes[0].plot(days[here], nearest[here], "o", color=color, ms=4, label=name)
    axes[0].set(yscale="log", ylabel="distance from the\nnearest event, km")
    axes[0].legend(loc="upper right", ncol=3, fontsize=9)
    for times, label, color in [(anew, "triangulated again", SOFT), (by_editing, "edited", INK)]:
        axes[1].plot(days, 1000 * times, ".", color=color, ms=2, label=f"{label}: {1000 * np.nanmean(times):.2f} ms per event")
    axes[1].set(yscale="log", ylabel="milliseconds", xlabel="day", xlim=(0, days[-1]), ylim=(0.004, 20))
    axes[1].legend(loc="lower right", ncol=2, markerscale=4, fontsize=9)
    save(figure, path)


def save(figure, path, tight=True):
    if tight:
        figure.tight_layout()
    figure.savefig(path, dpi=80, metadata={"Software": None})
    plt.close(figure)
    # 256 colors look the same and take a third of the bytes.
    with Image.open(path) as picture:
        few = picture.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    few.save(path, optimize=True)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    for draw in (overview, plane, protein, earthquakes, look_values, look_curvature, look_protein, ask_neighbors, ask_phases, edit_window):
        draw(folder / f"{draw.__name__}.png")


if __name__ == "__main__":
    main()
