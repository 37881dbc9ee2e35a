# SPDX-License-Identifier: BSD-3-Clause
"""The convex hulls of many sets of points at once."""
from __future__ import annotations

from typing import Iterator, NamedTuple, Union

import numpy as np

from . import _core


class HullOfSet(NamedTuple):
    """One hull of ConvexHulls; rows are those of its own set, cells are counted from 0."""

    affine_dimension: int
    vertices: np.ndarray
    cells: np.ndarray
    neighbors: np.ndarray
    equations: np.ndarray
    volume: float
    area: float


class ConvexHulls:
    """The hulls of h sets of points in d dimensions; read-only arrays, one hull after the other.

    offsets : (h+1,) int64
        Set i consists of the rows ``offsets[i]:offsets[i+1]`` of all points together.
    affine_dimensions : (h,) int32
        k <= d, of the smallest flat that contains the set; 0 for one distinct point, -1 for none.
    vertices : int32, vertex_offsets : (h+1,) int64
        The rows of the extreme points, increasing, of equal rows the first: hull i has
        ``vertices[vertex_offsets[i]:vertex_offsets[i+1]]``.
    cells, neighbors : (m, d) int32, cell_offsets : (h+1,) int64
        The simplices of the boundary, as rows, and the cell opposite each vertex. Hull i has the cells
        ``cell_offsets[i]:cell_offsets[i+1]``; a flat one, k < d, has none. All vertices of cells are extreme. With a
        point inside put first each cell is positively oriented (for d > 1).
    equations : (m, d+1) float64
        Unit outward normal and offset of each cell; the same for all cells of one facet.
    volumes, areas : (h,) float64
        The d-dimensional volume and the (d-1)-dimensional volume of the boundary. Of flat sets the limits: 0, and twice the
        volume within the flat if k = d-1, else 0.

    A sequence: entry i is a tuple (affine_dimension, vertices, cells, neighbors, equations, volume, area) with names, in the
    rows of set i.
    """

    __slots__ = ("affine_dimensions", "areas", "cell_offsets", "cells", "equations", "neighbors", "offsets", "vertex_offsets",
                 "vertices", "volumes")

    def __init__(self, offsets, affine_dimensions, vertex_offsets, vertices, cell_offsets, cells, neighbors, equations, volumes, areas):
        self.offsets, self.affine_dimensions = offsets, affine_dimensions
        self.vertex_offsets, self.vertices = vertex_offsets, vertices
        self.cell_offsets, self.cells, self.neighbors, self.equations = cell_offsets, cells, neighbors, equations
        self.volumes, self.areas = volumes, areas

    def __len__(self) -> int:
        return len(self.affine_dimensions)

    def __getitem__(self, i: Union[int, slice]) -> Union[HullOfSet, list[HullOfSet]]:
        if isinstance(i, slice):
            return [self[j] for j in range(*i.indices(len(self)))]
        if not -len(self) <= i < len(self):
            raise IndexError(f"hull {i} of {len(self)}")
        i %= len(self)
        row = self.offsets[i].astype(self.vertices.dtype)
        first, last = self.cell_offsets[i:i + 2]
        return HullOfSet(int(self.affine_dimensions[i]), self.vertices[self.vertex_offsets[i]:self.vertex_offsets[i + 1]] - row,
                         self.cells[first:last] - row, self.neighbors[first:last] - first.astype(self.cells.dtype),
                         self.equations[first:last], float(self.volumes[i]), float(self.areas[i]))

    def __iter__(self) -> Iterator[HullOfSet]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<delone.ConvexHulls: {len(self)} hulls, {len(self.vertices)} vertices, {len(self.cells)} cells>"


def convex_hulls(points, offsets=None, *, seed=0, order="automatic", threads=0, progress=None, memory_limit=None,
                 time_limit=None) -> ConvexHulls:
    """The convex hulls of many sets of points: a ConvexHulls.

    `points` is a sequence of arrays (n_i, d), or an array (h, n, d); or, with `offsets`, one array (n, d) of which set i has the
    rows ``offsets[i]:offsets[i+1]``. Exact as ConvexHull, of which small ones in a loop take several times as long. The
    other arguments and errors are those of ConvexHull, without a tolerance; ValueError if arrays differ in d, or offsets do not increase from 0 to n.
    """
    if offsets is None and isinstance(points, np.ndarray) and points.ndim == 3 and points.shape[0] > 0 < points.shape[2]:
        offsets = np.arange(points.shape[0] + 1) * points.shape[1]
        points = points.reshape(-1, points.shape[2])
    elif offsets is None:
        sets = [_core._doubles(each, f"points: set {i}") for i, each in enumerate(points)]
        for i, each in enumerate(sets):
            if each.ndim != 2 or each.shape[1] != sets[0].shape[-1]:
                raise ValueError(f"points: set {i} is an array of shape {each.shape}; all have the shape (n, d), with one d")
        if not sets:
            raise ValueError("points: no sets, and so no dimension; pass an array (0, d) and offsets [0]")
        offsets = np.concatenate([[0], np.cumsum([len(each) for each in sets])])
        points = np.concatenate(sets)
    else:
        if np.ma.is_masked(offsets):
            raise ValueError("offsets: masked values are not numbers")
        offsets = np.asarray(offsets)
        if offsets.ndim != 1 or (offsets.dtype.kind not in "iu" and len(offsets)):
            raise ValueError("offsets: a list of whole numbers")
    offsets = np.array(offsets, dtype=np.int64)
    offsets.flags.writeable = False
    return ConvexHulls(offsets, *_core._convex_hulls(points, offsets, seed=seed, order=order, threads=threads, progress=progress,
                                                     memory_limit=memory_limit, time_limit=time_limit))
