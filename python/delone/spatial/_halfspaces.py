# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.HalfspaceIntersection, exact."""
from __future__ import annotations

from functools import cached_property

import numpy as np

import delone
from delone import _core

from . import _geometry, _options
from ._base import Incremental, as_points, qhull_error


class HalfspaceIntersection(Incremental):
    """Intersection of halfspaces in any dimension, with the interface of `scipy.spatial.HalfspaceIntersection`.

    Parameters
    ----------
    halfspaces : (nineq, ndim+1) array_like
        Rows [A; b] of the inequalities A x + b <= 0, finite numbers.
    interior_point : (ndim,) array_like
        A point strictly inside all halfspaces; `delone.HalfspaceIntersection` finds one.
    incremental : bool, default False
        Allow `add_halfspaces`.
    qhull_options : str, optional
        Qhull's options, see docs/from-qhull.md.
    flat : {'error', 'result'}, optional
        For halfspaces with flat dual points, which are too few, contain a common line, or all touch at one point: raise
        QhullError as in scipy, or return a result. Default 'error', with option QJ 'result'. Not in scipy.

    Attributes
    ----------
    interior_point : (ndim,) ndarray of float64
        The interior point.
    ndim : int
        The number of coordinates.
    nineq : int
        The number of halfspaces.
    intersections : (ninter, ndim) ndarray of float64
        The finite vertices of the intersection, each coordinate the double nearest to the exact one. A vertex of more than ndim
        hyperplanes is listed once.
    is_bounded : bool
        Whether the intersection is a polytope. Not in scipy 1.10.

    Raises
    ------
    QhullError
        If the interior point is not strictly inside, exactly, or the dual points are flat and `flat` is 'error'.
    ValueError
        If arrays have wrong shapes or contain NaN, or an option has no meaning here.

    See Also
    --------
    delone.HalfspaceIntersection : The interface of delone, with more answers.

    Notes
    -----
    Results cannot be assigned; arrays are the caller's to change, and changes affect nothing else.

    Examples
    --------
    >>> from delone.spatial import HalfspaceIntersection
    >>> square = [[-1, 0, 0], [0, -1, 0], [1, 0, -1], [0, 1, -1]]
    >>> hs = HalfspaceIntersection(square, [0.5, 0.5])
    >>> sorted(hs.intersections.tolist())
    [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]
    """

    _read_only = Incremental._read_only | {"halfspaces", "interior_point", "nineq", "is_bounded"}
    _derived = ("intersections", "dual_points", "dual_facets", "dual_vertices", "dual_equations", "dual_area", "dual_volume", "is_bounded")

    def __init__(self, halfspaces, interior_point, incremental=False, qhull_options=None, *, flat=None):
        halfspaces = as_points(halfspaces, "halfspaces")
        if np.ma.isMaskedArray(interior_point):
            raise ValueError("Input interior point cannot be a masked array")
        self._set(interior_point=np.ascontiguousarray(interior_point, dtype=np.float64))
        if self.interior_point.shape != (halfspaces.shape[1] - 1,):
            is_pair = self.interior_point.shape == halfspaces.shape[:1]
            more = "; A x <= b is one array of halfspaces, numpy.c_[A, -b], and needs a point inside" if is_pair else ""
            raise ValueError(f"Feasible point must be a (ndim-1,) array{more}")
        self._options = _options.parse(qhull_options, kind="halfspaces", incremental=incremental)
        self._start(halfspaces, incremental, flat)

    @property
    def halfspaces(self) -> np.ndarray:
        """The halfspaces, (nineq, ndim+1) float64."""
        return self._points

    def add_halfspaces(self, halfspaces, restart: bool = False) -> None:
        """Add halfspaces as the next rows.

        Needs ``incremental=True`` in the constructor. Afterwards all arrays are new.

        Parameters
        ----------
        halfspaces : (n, ndim+1) or (ndim+1,) array_like
            The halfspaces.
        restart : bool, default False
            Build from scratch instead. The result is the same up to numbering.

        Raises
        ------
        RuntimeError
            If adding was not enabled, or after `close`.
        ValueError
            If rows have another size or contain NaN; nothing is changed.
        QhullError
            If the interior point is not strictly inside them; nothing is changed.
        """
        halfspaces = np.asarray(halfspaces)
        if halfspaces.ndim > 2:
            raise ValueError("`halfspaces` should be provided as a 2D array")
        self._add_rows(np.atleast_2d(halfspaces), restart)

    def _refuse_flat(self):
        core, d = self._core, self._points.shape[1] - 1
        touching = len(core.vertices) == 1 and not np.isin(core.kinds, (2, 4)).any()  # every hyperplane contains the one vertex
        if core.rank < d or touching:
            raise qhull_error(f"QH6154 initial simplex is flat: the dual points of {self.nineq} halfspaces in {d} dimensions span a "
                              "flat. flat='result' gives the intersection")

    def _rebuild(self, halfspaces):
        with _not_inside(halfspaces):
            self._core = delone.HalfspaceIntersection(halfspaces, self.interior_point)

    def _extend(self, rows):
        with _not_inside(rows):
            self._core.insert_range(rows)

    def _num_rows(self):
        return self._core.num_halfspaces

    def _update(self):
        core = self._core
        self._take_over(intersections=np.array(core.vertices), is_bounded=bool(core.is_bounded))

    def _set_points(self, points):
        low, high = _geometry.bounds(points)
        self._set(_points=points, npoints=len(points), nineq=len(points), ndim=points.shape[1] - 1, min_bound=low, max_bound=high)

    @cached_property
    def dual_points(self) -> np.ndarray:
        """The dual point of each halfspace, -A / (A . interior_point + b), (nineq, ndim) float64."""
        return np.array(self._core.dual_points)

    @cached_property
    def dual_equations(self) -> np.ndarray:
        """The unit normal and offset of the dual facet of each intersection, (ninter, ndim+1) float64."""
        return np.array(self._core.dual_equations)

    @cached_property
    def dual_facets(self) -> list[list[int]]:
        """The halfspaces whose facets meet in each intersection, increasing, a list of lists of int."""
        return _core._lists(self._core.vertex_halfspaces, self._core.vertex_offsets)

    @cached_property
    def dual_vertices(self) -> np.ndarray:
        """The halfspaces that are not redundant, increasing, (nvertices,) int64."""
        return np.array(self._core.facet_halfspaces, np.int64)

    @cached_property
    def dual_area(self) -> float:
        """The surface area of the hull of the dual points."""
        return float(self._core.dual_area)

    @cached_property
    def dual_volume(self) -> float:
        """The volume of the hull of the dual points."""
        return float(self._core.dual_volume)


class _not_inside:
    """What the library says of an interior point that is not strictly inside these halfspaces is a QhullError, as in scipy."""

    def __init__(self, halfspaces):
        self._halfspaces = halfspaces

    def __enter__(self):
        return self

    def __exit__(self, kind, error, traceback):
        if kind is not None and issubclass(kind, delone.InputError):
            first = f": {self._halfspaces[error.rows[0]].tolist()}" if error.rows else ""
            raise qhull_error(f"QH6023 not feasible: {error}{first}") from error
