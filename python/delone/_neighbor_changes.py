# SPDX-License-Identifier: BSD-3-Clause
"""Which points have become neighbors, and which are neighbors no more."""
from __future__ import annotations

import numpy as np

from . import _core


class NeighborChanges:
    """Pairs of points that an edge joins in one of two triangulations only, each pair once, as read-only arrays.

    Made by `changed_neighbors`.

    Parameters
    ----------
    began : (n, 2) ndarray of int
        The rows of points that have become neighbors, increasing; the first of a pair is not larger than the second.
    ended : (m, 2) ndarray of int
        Those that are neighbors no more.
    began_offsets : (n, r) ndarray of int32
        The second point of pair i is translated by ``began_offsets[i] @ lattice`` from where it is given after the step. r = 0 without a lattice.
    ended_offsets : (m, r) ndarray of int32
        The same from where it was given before.

    Examples
    --------
    >>> import delone
    >>> t = delone.Delaunay([[0, 0], [2, 0], [2, 1.5], [0, 1]])
    >>> before = t.clone()
    >>> t.move([2], [[2, 0.5]])
    >>> delone.changed_neighbors(before, t)
    <delone.NeighborChanges: began=1, ended=1>
    """

    __slots__ = ("began", "began_offsets", "ended", "ended_offsets")

    def __init__(self, began: np.ndarray, ended: np.ndarray, began_offsets: np.ndarray, ended_offsets: np.ndarray):
        self.began, self.ended, self.began_offsets, self.ended_offsets = began, ended, began_offsets, ended_offsets

    def __repr__(self) -> str:
        return f"<delone.NeighborChanges: began={len(self.began)}, ended={len(self.ended)}>"


def changed_neighbors(before, after) -> NeighborChanges:
    """Find the pairs of points that have become neighbors and that have ceased to be.

    Parameters
    ----------
    before : Delaunay, Regular, FurthestSite, PeriodicDelaunay or PeriodicRegular
        The earlier state: a `clone` from before an edit, or a periodic triangulation that `moved`.
    after : Delaunay, Regular, FurthestSite, PeriodicDelaunay or PeriodicRegular
        The later state, of the same points by their rows; periodic if `before` is.

    Returns
    -------
    NeighborChanges
        The pairs. Of points in one place the first row stands for all.

    Raises
    ------
    TypeError
        If one is no triangulation, or only one is periodic.
    InputError
        If periodic triangulations have other numbers of points or lattice vectors.

    Notes
    -----
    A point of a periodic set goes on as the translate of its new point whose difference from the old one has coefficients of at most
    1/2 in short lattice vectors. After small steps that is the nearest translate. Giving a point in another period changes no
    neighbors. If most cells have stayed, as after small steps, the cost is a glance at each cell, and more only for those
    that differ. Otherwise all cells are compared.

    Examples
    --------
    >>> import delone
    >>> import numpy as np
    >>> points = np.random.default_rng(1).random((1000, 3))
    >>> t = delone.PeriodicDelaunay(points, 1.0)
    >>> later = t.moved(points + np.random.default_rng(2).normal(scale=1e-4, size=(1000, 3)))
    >>> changes = delone.changed_neighbors(t, later)
    >>> len(later.faces(1)) - len(t.faces(1)) == len(changes.began) - len(changes.ended)
    True
    """
    periodic = isinstance(before, _core.PeriodicTriangulation)
    kind = _core.PeriodicTriangulation if periodic else _core.Triangulation
    if not (isinstance(before, kind) and isinstance(after, kind)):
        raise TypeError(f"changed_neighbors: two triangulations, both periodic or none, not {type(before).__name__} and {type(after).__name__}")
    find = _core._changed_periodic_neighbors if periodic else _core._changed_neighbors
    return NeighborChanges(*find(before, after))
