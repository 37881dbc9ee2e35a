# SPDX-License-Identifier: BSD-3-Clause
"""What the classes of delone.spatial share: the points and their bounds, errors, and adding points later."""
from __future__ import annotations

import copy

import numpy as np


class QhullError(RuntimeError):
    """An attribute that does not exist for these points: they span a flat of less than the space's dimension.

    Named as in scipy, where input of this kind is refused as a whole.
    """


def as_points(points, what: str = "points") -> np.ndarray:
    """A contiguous (n, d) array of float64; the argument itself if it is one. ValueError for anything else, for masked arrays,
    for no rows, and for rows that are not finite."""
    if np.ma.isMaskedArray(points):
        raise ValueError(f"Input {what} cannot be a masked array")
    points = np.ascontiguousarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] < 1:
        raise ValueError(f"{what} must be an array of shape (n, d), not {points.shape}")
    if len(points) == 0:
        raise ValueError(f"No {what} given")
    if not np.isfinite(points).all():
        bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
        kind = "NaN" if np.isnan(points[bad[0]]).any() else "infinities"
        raise ValueError(f"{what.capitalize()} cannot contain {kind} (row {bad[0]})")
    return points


class Incremental:
    """Rows of numbers, their bounds, and adding rows.

    A subclass keeps the object of the library that does the work in ``_core``, builds it from ``points`` in ``_rebuild()``, adds
    rows to it in ``_extend(rows)`` and takes its arrays over in ``_update()``.
    """

    _incremental = False
    # Attributes that _update() sets, or that are computed from those on first use.
    _derived: tuple[str, ...] = ()

    def _start(self, points: np.ndarray, incremental: bool):
        self._incremental = bool(incremental)
        self._set_points(points.copy() if incremental else points)
        self._rebuild()
        self._update()

    def _set_points(self, points: np.ndarray):
        self._points = points
        self.npoints, self.ndim = points.shape
        self.min_bound, self.max_bound = points.min(axis=0), points.max(axis=0)

    def _add_rows(self, points, restart: bool) -> None:
        if not self._incremental:
            raise RuntimeError("incremental mode not enabled or already closed")
        points = np.asarray(points)
        if points.ndim != 2 or points.shape[1] != self._points.shape[1]:
            raise ValueError("invalid size for new points array")
        if len(points) == 0:
            return
        points = as_points(points)
        old = self._points
        self._set_points(np.concatenate([old, points]))
        try:
            self._rebuild() if restart else self._extend(points)
        except BaseException:
            self._set_points(old)
            raise
        self._update()

    def close(self) -> None:
        """Ends adding points. All results stay."""
        self._incremental = False

    def _forget(self) -> None:
        """Drops what is computed on first use, so that it is computed anew."""
        for name in self._derived:
            self.__dict__.pop(name, None)

    def __copy__(self):
        """A copy of its own: points added to one are not added to the other."""
        return copy.deepcopy(self)

    def __getstate__(self):
        """What is pickled; the arrays of the library's object are in that object already."""
        return {name: value for name, value in self.__dict__.items() if name not in self._derived or "_core" not in self.__dict__}

    def __setstate__(self, state):
        self.__dict__.update(state)
        if "_core" in state:
            self._update()


class OfPoints(Incremental):
    """The rows are points."""

    @property
    def points(self) -> np.ndarray:
        """The points, (npoints, ndim)."""
        return self._points

    def add_points(self, points, restart: bool = False) -> None:
        """Adds points, (n, ndim), as the next rows. Needs ``incremental=True`` in the constructor.

        All arrays are new afterwards, and simplices are numbered anew. ``restart`` builds from scratch instead; the result is the
        same up to numbering. Raises RuntimeError if adding was not enabled, or after close(); ValueError for rows of another
        size or not finite, which leave everything as it was.
        """
        self._add_rows(points, restart)
