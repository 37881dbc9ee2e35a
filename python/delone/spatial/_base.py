# SPDX-License-Identifier: BSD-3-Clause
"""What the classes of delone.spatial share: the points and their bounds, errors, and adding points later."""
from __future__ import annotations

import copy
import functools
import sys

import numpy as np

from delone import _core

from ._geometry import bounds


class QhullError(RuntimeError):
    """The input has no result in scipy: it is flat or infinite, or an interior point is not inside.

    If scipy.spatial is loaded, the error is also an instance of its QhullError: either name catches it.

    Parameters
    ----------
    *args : object
        The message.
    """

    def __init__(self, *args):  # for inspect.signature()
        super().__init__(*args)


@functools.lru_cache(maxsize=None)
def _also(theirs: type) -> type:
    return type("QhullError", (QhullError, theirs),
                {"__module__": __name__, "__doc__": QhullError.__doc__, "__reduce__": lambda self: (qhull_error, self.args)})


def qhull_error(text: str) -> QhullError:
    """The error to raise: a QhullError, of scipy's class too if there is one."""
    theirs = getattr(sys.modules.get("scipy.spatial"), "QhullError", QhullError)
    return QhullError(text) if issubclass(QhullError, theirs) else _also(theirs)(text)


def as_points(points, what: str = "points") -> np.ndarray:
    """A contiguous (n, d) array of float64; the argument itself if it is one. ValueError for anything else, for masked arrays,
    for no rows, and for NaN; QhullError for infinities."""
    if np.ma.isMaskedArray(points):
        raise ValueError(f"Input {what} cannot be a masked array")
    points = np.ascontiguousarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] < 1:
        raise ValueError(f"{what} must be an array with 2 dimensions, of shape (n, d), not {points.shape}")
    if len(points) == 0:
        raise ValueError(f"No {what} given")
    if not np.isfinite(points).all():
        bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
        if np.isnan(points).any():
            raise ValueError(f"{what.capitalize()} cannot contain NaN (row {np.flatnonzero(np.isnan(points).any(axis=1))[0]})")
        raise qhull_error(f"{what.capitalize()} cannot contain infinities (row {bad[0]})")
    return points


def refuse_state_of_scipy(made, state: dict, own: str) -> None:
    """TypeError for what scipy's class of that name has pickled, without the attribute `own`; while scipy is patched its pickles name ours."""
    if own not in state:
        raise TypeError(f"{type(made).__name__}: a pickle of scipy's class: load it before patch_scipy(), or after unpatch_scipy()")


class Incremental:
    """Rows of numbers, their bounds, and adding rows.

    A subclass keeps the object of the library that does the work in ``_core``, sets it in ``_rebuild(points)``, in one step and
    without a change of anything else if that fails, adds rows to it in ``_extend(rows)`` and takes its arrays over in ``_update()``. It
    sets results with ``_set``: they cannot be assigned from outside, since all others would still be those of the object.

    Ctrl-C can come between any two steps. While rows are added, ``_adding`` holds the points before and after. Where that was
    stopped, what depends on them is not there, and who asks for it gets what belongs to the points that ``_core`` has then.
    """

    _incremental = False
    # Attributes that _update() sets, or that are computed from those on first use.
    _derived: tuple[str, ...] = ()
    # Those that _set_points() sets and that depend on the rows.
    _of_rows = ("_points", "npoints", "nineq", "min_bound", "max_bound")
    _read_only = frozenset({"points", "ndim", "npoints", "min_bound", "max_bound", "affine_dimension", "furthest_site",
                            # Names in scipy that programs reach for: assigning them would do nothing here.
                            "_points", "_qhull", "_transform", "_vertex_to_simplex", "_vertex_neighbor_vertices", "_vertices", "_ridge_dict"})

    def __init_subclass__(cls, **arguments):
        super().__init_subclass__(**arguments)
        cls._read_only = cls._read_only | {name for name in cls._derived if not name.startswith("_")}

    def __setattr__(self, name, value):
        if name in self._read_only:
            raise AttributeError(f"{name} of {type(self).__name__} cannot be assigned: all else would still belong to the old "
                                 "one. Make another object, or change a copy of the array")
        super().__setattr__(name, value)

    def _set(self, **results) -> None:
        self.__dict__.update(results)

    def _start(self, points: np.ndarray, incremental: bool, flat):
        if flat is None:
            flat = "result" if self._options.joggled else "error"
        if flat not in ("error", "result"):
            raise ValueError(f"flat: 'error' or 'result', not {_core._represented(flat)}")
        self._set(_flat=flat, _incremental=bool(incremental))
        self._set_points(points.copy() if incremental else points)
        self._rebuild(self._points)
        if flat == "error":
            self._refuse_flat()
        self._update()

    def _refuse_flat(self) -> None:
        """Raises QhullError if the points span less than the space."""
        k = self._core.affine_dimension
        if k < self.ndim:
            span = self._dimension_of_span()
            if span == k:
                raise qhull_error(f"QH6154 initial simplex is flat: {self.npoints} points span a flat of dimension {k} in {self.ndim} "
                                  "dimensions. flat='result' gives the result within it")
            raise qhull_error(f"QH6154 initial simplex is flat: {self.npoints} points span {span} dimensions, but are within "
                              f"{self._what_flattens()} of a flat of dimension {k}. tolerance=0 gives the exact hull, flat='result' "
                              "the one within the flat")

    def _dimension_of_span(self) -> int:
        """That of the smallest flat that contains all points exactly."""
        return self._core.affine_dimension

    def _set_points(self, points: np.ndarray):
        npoints, ndim = points.shape
        low, high = bounds(points)
        self._set(_points=points, npoints=npoints, ndim=ndim, min_bound=low, max_bound=high)

    def _add_rows(self, points, restart: bool) -> None:
        if "_core" not in self.__dict__ and not hasattr(self, "_points"):
            raise TypeError("the object is not initialized: its __init__ or __setstate__ did not run, or failed")
        if not self._incremental:
            raise RuntimeError("incremental mode not enabled or already closed")
        points = np.asarray(points)
        if points.ndim != 2 or points.shape[1] != self._points.shape[1]:
            raise ValueError("invalid size for new points array")
        if len(points) == 0:
            return
        points = as_points(points)
        old = self._points
        new = np.concatenate([old, points])
        try:
            self._set(_adding=(old, new))
            self._rebuild(new) if restart else self._extend(points)
            self._settle()
        except BaseException:
            self._set(_adding=(old, new))
            for name in self._derived + self._of_rows:
                self.__dict__.pop(name, None)
            raise

    def _settle(self) -> None:
        """Takes over what belongs to the rows that the object of the library has."""
        adding = self.__dict__.get("_adding")
        if adding is None:  # another thread was first
            return
        old, new = adding
        self._set_points(new if self._num_rows() == len(new) else old)
        self._update()
        self.__dict__.pop("_adding", None)

    def _num_rows(self) -> int:
        """The number of rows that the object of the library has."""
        return self._core.num_points

    def __getattr__(self, name):
        """For what is not there: after an addition that was stopped."""
        if "_adding" in self.__dict__ and (name in self._derived or name in self._of_rows):
            self._settle()
            return getattr(self, name)
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def close(self) -> None:
        """End adding rows; all results stay."""
        self._incremental = False

    def _take_over(self, **results) -> None:
        """Sets these, and drops what is computed on first use, so that it is recomputed."""
        self._set(**results)
        for name in self._derived:
            if name not in results:
                self.__dict__.pop(name, None)

    def __copy__(self):
        """A copy of its own: points added to one are not added to the other."""
        return copy.deepcopy(self)

    def __getstate__(self):
        """What is pickled; the arrays of the library's object are in that object already."""
        if "_adding" in self.__dict__ and "_points" not in self.__dict__:
            self._settle()
        return {name: value for name, value in self.__dict__.copy().items() if name not in self._derived or "_core" not in self.__dict__}

    def __setstate__(self, state):
        refuse_state_of_scipy(self, state, "_options")
        self.__dict__.update(state)
        if "_core" in state:
            self._update()


class OfPoints(Incremental):
    """The rows are points."""

    def _start(self, points: np.ndarray, incremental: bool, flat):
        if points.shape[1] < 2 and flat != "result":
            raise ValueError("Need at least 2-D data. flat='result' gives results in one dimension")
        super()._start(points, incremental, flat)

    @property
    def points(self) -> np.ndarray:
        """The points, (npoints, ndim) float64."""
        return self._points

    def add_points(self, points, restart: bool = False) -> None:
        """Add points as the next rows.

        Needs ``incremental=True`` in the constructor. Afterwards all arrays are new, and simplices have other numbers.

        Parameters
        ----------
        points : (n, ndim) array_like
            The points.
        restart : bool, default False
            Build from scratch instead. The result is the same up to numbering.

        Raises
        ------
        RuntimeError
            If adding was not enabled, or after `close`.
        ValueError
            If rows have another size or contain NaN; nothing is changed.
        QhullError
            If a coordinate is infinite; nothing is changed.
        """
        self._add_rows(points, restart)
