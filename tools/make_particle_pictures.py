#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the pages about particles and atoms, docs/pictures/{cosmology,crystals,molecules}.png:

    PYTHONPATH=build/release/python tools/make_particle_pictures.py [FOLDER]
"""
import pathlib
import sys

import numpy as np
from make_pictures import ACCENT, INK, ROOT, TINT, atoms, plt, save
from matplotlib.colors import LogNorm, to_rgb
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import delone


def zeldovich(n, growth, seed):
    """The points of a grid of n^2 points in the unit square, displaced along the gradient of a random potential."""
    k = np.stack(np.meshgrid(*2 * [np.fft.fftfreq(n) * n], indexing="ij"), axis=-1)
    squared = np.maximum((k**2).sum(axis=-1), 1)
    potential = np.fft.fftn(np.random.default_rng(seed).standard_normal((n, n))) * squared**-1.5 * np.exp(-squared / (n / 4) ** 2)
    moved = np.stack([np.fft.ifftn(1j * k[..., j] * potential).real for j in range(2)], axis=-1)
    grid = np.stack(np.meshgrid(*2 * [(np.arange(n) + 0.5) / n], indexing="ij"), axis=-1)
    return (grid + growth / n * moved / moved.std()).reshape(-1, 2) % 1


def cosmology(path):
    """The density of a plane of particles, the zones of its watershed, and cells of particles."""
    particles = zeldovich(96, 2.6, seed=3)
    t = delone.PeriodicDelaunay(particles, 1.0)
    cells = t.site_cells(neighbors=True, vertices=True)
    density = 1 / cells.volumes
    owner = np.repeat(np.arange(len(particles)), np.diff(cells.neighbor_offsets))
    lowest = cells.neighbors[np.lexsort((density[cells.neighbors], owner))[cells.neighbor_offsets[:-1]]]
    flow = np.where(density[lowest] < density, lowest, np.arange(len(particles)))
    while not np.array_equal(flow, flow[flow]):
        flow = flow[flow]
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.7), layout="constrained")
    field = delone.dtfe_density(t, 300, samples=2) / len(particles)
    axes[0].imshow(field.T, origin="lower", extent=(0, 1, 0, 1), norm=LogNorm(0.15, 30), cmap="magma")
    zones = np.random.default_rng(1).permutation(len(particles))[flow] % 20
    axes[1].scatter(*particles.T, c=zones, cmap="tab20", s=4, lw=0)
    for row in np.flatnonzero((abs(particles - 0.5) < 0.16).all(axis=1)):
        corners = cells.polygons_of(row)[0]
        corners = corners[np.argsort(np.arctan2(*(corners - particles[row]).T))]
        axes[2].fill(*corners.T, facecolor=plt.cm.magma(LogNorm(0.15, 30)(density[row] / len(particles))), edgecolor="white", lw=0.3)
    for ax, title in zip(axes, ["density (DTFE) on a grid", "zones of the watershed", "Voronoi cells, enlarged"]):
        ax.set(title=title, aspect="equal", xticks=[], yticks=[], xlim=(0, 1), ylim=(0, 1))
    axes[2].set(xlim=(0.36, 0.64), ylim=(0.36, 0.64))
    save(figure, path, tight=False)


def lit(normals):
    """Colors of faces with these outward normals."""
    light = np.array([0.35, -0.5, 0.8]) / np.linalg.norm([0.35, -0.5, 0.8])
    brightness = 0.35 + 0.65 * np.clip(normals @ light, 0, 1)[:, None]
    return np.array(to_rgb(INK)) + brightness * (np.array(to_rgb(TINT)) - np.array(to_rgb(INK)))


def crystals(path):
    """The cells of the atoms of crystals, and their coordination numbers."""
    fcc = np.array([[0, 0, 0], [0, 2, 2], [2, 0, 2], [2, 2, 0]]) / 4
    figure = plt.figure(figsize=(9.5, 3.3), layout="constrained")
    for i, (name, basis) in enumerate([("iron, bcc", np.array([[0, 0, 0], [0.5, 0.5, 0.5]])), ("copper, fcc", fcc), ("diamond", np.r_[fcc, fcc + 0.25])]):
        t = delone.PeriodicDelaunay(basis, 1.0)
        cells = t.site_cells(vertices=True, faces="proper")
        corners, faces = cells.polygons_of(0)
        corners = corners - basis[0]
        polygons = [corners[face] for face in faces]
        normals = np.array([np.cross(p[1] - p[0], p[2] - p[0]) for p in polygons])
        ax = figure.add_subplot(1, 3, i + 1, projection="3d")
        ax.add_collection3d(Poly3DCollection(polygons, facecolors=lit(normals / np.linalg.norm(normals, axis=1)[:, None]), edgecolors=INK, lw=0.8))
        size = abs(corners).max()
        ax.set(xlim=(-size, size), ylim=(-size, size), zlim=(-size, size))
        ax.set_title(f"{name}: {delone.coordination(t, tolerance=0.4)[0][0]} of {len(faces)} faces count", fontsize=10)
        ax.set_box_aspect((1, 1, 1), zoom=1.45)
        ax.view_init(22, -62)
        ax.set_axis_off()
    save(figure, path, tight=False)


def molecules(path):
    """Volumes of the cells of atoms in a slice of a protein, and how they are distributed inside and at the surface."""
    points = atoms()
    box = points.min(axis=0) - 3, points.max(axis=0) + 3
    t = delone.Delaunay(points)
    cells = t.site_cells(box=box, neighbors=True)
    owner = np.repeat(np.arange(len(points)), np.diff(cells.neighbor_offsets))
    at_surface = np.bincount(owner, (cells.neighbors < 0) | (cells.face_areas > 25), len(points)) > 0
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 3.6), width_ratios=[3, 2], layout="constrained")
    x, y = (np.linspace(box[0][j], box[1][j], 500) for j in range(2))
    places = np.stack(np.meshgrid(x, y, [0.0], indexing="ij"), axis=-1)[:, :, 0]
    nearest, distance = t.nearest(places)
    image = np.where(distance < 4, cells.volumes[nearest], np.nan)
    drawn = axes[0].pcolormesh(x, y, image.T, norm=LogNorm(8, 80), cmap="viridis", rasterized=True)
    figure.colorbar(drawn, ax=axes[0], label="volume of the atom, Å³")
    axes[0].set(aspect="equal", title="a plane through a protein", xlabel="Å")
    bins = np.geomspace(5, 300, 50)
    axes[1].hist(cells.volumes[~at_surface], bins, color=INK, label="inside")
    axes[1].hist(cells.volumes[at_surface], bins, color=ACCENT, alpha=0.7, label="at the surface")
    axes[1].set(xscale="log", xlabel="volume, Å³", ylabel="atoms")
    axes[1].legend()
    save(figure, path, tight=False)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    for draw in (cosmology, crystals, molecules):
        draw(folder / f"{draw.__name__}.png")


if __name__ == "__main__":
    main()
