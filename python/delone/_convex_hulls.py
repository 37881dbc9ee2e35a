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
    """Hulls of h sets of points in d dimensions; a sequence of hulls.

    The arrays are read-only and hold one hull after the other. Entry i is a named tuple (affine_dimension, vertices, cells,
    neighbors, equations, volume, area) whose rows are those of set i. Made by `convex_hulls`.

    Parameters
    ----------
    offsets : (h+1,) ndarray of int64
        Set i consists of the rows ``offsets[i]:offsets[i+1]`` of all points together.
    points : (n, d) ndarray of float64
        A copy of all points together.
    affine_dimensions : (h,) ndarray of int32
        The dimension k <= d of the smallest flat that contains each set; 0 for one distinct point, -1 for none.
    vertex_offsets : (h+1,) ndarray of int64
        The extreme points of hull i are ``vertices[vertex_offsets[i]:vertex_offsets[i+1]]``.
    vertices : ndarray of int
        The rows of the extreme points, increasing; of equal rows the first.
    cell_offsets : (h+1,) ndarray of int64
        Hull i has the cells ``cell_offsets[i]:cell_offsets[i+1]``; a flat one, k < d, has none.
    cells : (m, d) ndarray of int
        The simplices of the boundary, as rows; all of them are extreme. With a point of the interior put first each cell is
        positively oriented (for d > 1).
    neighbors : (m, d) ndarray of int
        The cell opposite each vertex.
    equations : (m, d+1) ndarray of float64
        Unit outward normal and offset of each cell, equal for all cells of one facet.
    volumes : (h,) ndarray of float64
        The d-dimensional volumes; 0 for flat sets.
    areas : (h,) ndarray of float64
        The (d-1)-dimensional volumes of the boundaries. For flat sets their limits: twice the volume within the flat if
        k = d-1, else 0.

    Examples
    --------
    >>> import delone
    >>> hulls = delone.convex_hulls([[[0, 0], [1, 0], [0, 1]], [[0, 0], [2, 0], [0, 2], [0.5, 0.5]]])
    >>> hulls.volumes
    array([0.5, 2. ])
    >>> hulls[1].vertices
    array([0, 1, 2], dtype=int32)
    """

    __slots__ = ("affine_dimensions", "areas", "cell_offsets", "cells", "equations", "neighbors", "offsets", "points", "vertex_offsets",
                 "vertices", "volumes")

    def __init__(self, offsets, points, affine_dimensions, vertex_offsets, vertices, cell_offsets, cells, neighbors, equations, volumes, areas):
        self.offsets, self.points, self.affine_dimensions = offsets, points, affine_dimensions
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

    def intersection_volumes(self, pairs=None, *, threads=0, progress=None) -> np.ndarray:
        """Compute the volumes that pairs of hulls have in common.

        Parameters
        ----------
        pairs : (p, 2) array_like of int, optional
            Numbers of hulls, from 0. By default all pairs.
        threads : int, default 0
            The most threads to use; 0: one per core of this process if the work is large enough to gain by it.
        progress : bool or callable, optional
            As for `convex_hulls`.

        Returns
        -------
        (p,) or (h, h) ndarray of float64
            The volume of the intersection for each of the pairs, or for all of them a symmetric matrix with the volumes of the
            hulls on its diagonal. 0 with a flat hull. Each is off by some roundings of the sizes of the hulls.

        Raises
        ------
        IndexError
            If there is no hull of such a number.
        ValueError
            If `pairs` is no array (p, 2).
        CancelledError
            If the progress function cancels the call.

        See Also
        --------
        intersections : Exact intersections of two and more polyhedra.
        union_volume : The exact volume of the union.

        Examples
        --------
        >>> import delone
        >>> hulls = delone.convex_hulls([[[0, 0], [2, 0], [0, 2], [2, 2]], [[1, 1], [3, 1], [1, 4]]])
        >>> hulls.intersection_volumes()
        array([[4., 1.],
               [1., 3.]])
        >>> hulls.intersection_volumes([[0, 1]])
        array([1.])
        """
        h = len(self)
        if pairs is None:
            wanted = np.argwhere(np.triu(np.ones((h, h), dtype=bool), 1))
        else:
            wanted = np.asarray(pairs)
            if wanted.ndim != 2 or wanted.shape[1] != 2 or (wanted.dtype.kind not in "iu" and wanted.size):
                raise ValueError("pairs: an array (p, 2) of whole numbers")
            for row in np.flatnonzero(((wanted < 0) | (wanted >= h)).any(axis=1)):
                raise IndexError(f"pairs: row {row} is {tuple(wanted[row].tolist())}, and there are {h} hulls")
        volumes = _core._intersection_volumes(self, wanted.astype(np.int64), threads, progress)
        if pairs is not None:
            return volumes
        matrix = np.diag(self.volumes)
        matrix[wanted[:, 0], wanted[:, 1]] = matrix[wanted[:, 1], wanted[:, 0]] = volumes
        return matrix


def convex_hulls(points, offsets=None, *, seed=0, order="automatic", threads=0, progress=None, memory_limit=None,
                 time_limit=None) -> ConvexHulls:
    """Compute the convex hulls of many sets of points.

    Parameters
    ----------
    points : sequence of (n_i, d) array_like, (h, n, d) ndarray, or (n, d) array_like
        The sets of points; with `offsets` the points of all sets in one array.
    offsets : (h+1,) array_like of int, optional
        Set i has the rows ``offsets[i]:offsets[i+1]``; from 0 to n, never decreasing.
    seed : int, default 0
        Seed of the random choices in the insertion order. Does not change the result.
    order : {'automatic', 'as_given', 'shuffled'}
        The insertion order. Does not change the result.
    threads : int, default 0
        The most threads to use; 0: one per core of this process if the work is large enough to gain by it.
    progress : bool or callable, optional
        True shows a progress bar. A function is called about ten times a second with the fraction done, 0 to 1; returning a
        false value other than None cancels the call.
    memory_limit : float, optional
        The most bytes that the process may use during the call.
    time_limit : float, optional
        The most seconds that the call may take.

    Returns
    -------
    ConvexHulls
        The hulls.

    Raises
    ------
    ValueError
        If sets differ in d, or offsets decrease or do not run from 0 to n.
    InputError
        If a number is NaN or infinite.
    CancelledError, OutOfMemoryError, TimeLimitError
        If the progress function cancels the call, or a limit is reached.

    See Also
    --------
    ConvexHull : One hull, with more answers.

    Notes
    -----
    As exact as `ConvexHull`, and several times faster than a loop over small sets.

    Examples
    --------
    >>> import delone
    >>> delone.convex_hulls([[0], [3], [5], [6], [10]], offsets=[0, 2, 5]).volumes
    array([3., 5.])
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
