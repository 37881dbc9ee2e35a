# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.ConvexHull, exact."""
from __future__ import annotations

from functools import cached_property

import numpy as np

import delone

from . import _options
from ._base import OfPoints, QhullError, as_points


class ConvexHull(OfPoints):
    """Convex hull in any dimension, with the arguments and attributes of `scipy.spatial.ConvexHull`.

    Parameters
    ----------
    points : (npoints, ndim) finite floats
        The points. Duplicates are merged; the hull of flat input is made within its flat.
    incremental : bool
        Allow `add_points`.
    qhull_options : str, optional
        Qhull's options, see docs/from-qhull.md; ValueError for one that has no meaning here.

    Attributes
    ----------
    points, ndim, npoints, min_bound, max_bound
        The points, d, their number, and their bounding box.
    vertices : (nvertices,) int32
        The extreme points, exactly: counterclockwise in the plane, increasing otherwise.
    simplices : (nsimplex, ndim) int32
        Rows of points, the simplices of the boundary. Their vertices are extreme points, whatever else lies on the boundary.
        For flat input of affine dimension k, k columns.
    neighbors : (nsimplex, ndim) int32
        The simplex opposite each vertex.
    affine_dimension : int
        k, of the smallest flat that contains all points (not in scipy).
    volume, area : float
        The ndim-dimensional volume and the (ndim−1)-dimensional volume of the boundary; in the plane, area and perimeter. Of
        flat input the volume is 0, and the area twice that of the flat hull if k = ndim−1, else 0: the limits.
    coplanar : (ncoplanar, 3) int32
        With option Qc: the points of the boundary that are not extreme and the duplicates of such on the boundary, each with a
        simplex and the nearest of its vertices.
    good : (nsimplex,) bool or None
        With option QGn: whether each simplex is strictly visible from point n, which is left out of the hull.
    """

    _derived = ("simplices", "neighbors", "_shown", "vertices", "equations", "coplanar", "good")

    def __init__(self, points, incremental=False, qhull_options=None):
        points = as_points(points)
        self._options = _options.parse(qhull_options, kind="hull", incremental=incremental)
        if self._options.good_row is not None and self._options.good_row >= len(points):
            raise ValueError(f"Qhull option 'QG{self._options.good_row}': there are {len(points)} points")
        self._start(points, incremental)

    def _without_good_row(self, rows):
        good = self._options.good_row
        return rows if good is None else np.delete(rows, good, axis=0)

    def _rebuild(self):
        points = self._without_good_row(self._points)
        # A hull to which points can be added has all of them; otherwise extreme ones suffice.
        if self._incremental:
            self._core, self._core_rows = delone.ConvexHull(points), None
        else:
            self._core, self._core_rows = delone.ConvexHull.of_extreme_points(points)

    def _extend(self, rows):
        self._core.insert_range(rows)

    def __getstate__(self):
        state = super().__getstate__()
        if self._core_rows is not None:  # made again from the points, with the same numbers of simplices
            del state["_core"], state["_core_rows"]
        return state

    def __setstate__(self, state):
        self.__dict__.update(state)
        if "_core" not in state:
            self._rebuild()
        self._update()

    def _update(self):
        self._forget()
        rows = self._without_good_row(np.arange(self.npoints, dtype=np.intc))
        core = self._core
        if self._core_rows is not None:
            rows = rows[self._core_rows]
        extreme = core.vertices
        self._extreme = np.sort(rows[extreme])
        self.affine_dimension = core.affine_dimension
        self._shown = core
        if self._core_rows is None and len(np.unique(core.cells)) > len(extreme):
            # Other points of the boundary are vertices of its simplices, too: the hull of the extreme points has the same boundary.
            self._shown, of_extreme = delone.ConvexHull.of_extreme_points(core.points[extreme])
            rows = rows[extreme][of_extreme]
        self.simplices, self.neighbors = rows[self._shown.cells], np.array(self._shown.neighbors)
        self.nsimplex = len(self.simplices)

        flat = self.ndim - self.affine_dimension
        self.volume = float(core.volume) if flat == 0 else 0.0
        self.area = float(core.area) if flat == 0 else 2.0 * float(core.volume) if flat == 1 else 0.0

    @cached_property
    def vertices(self) -> np.ndarray:
        if self.ndim == 2 and self.affine_dimension == 2:
            following = dict(self.simplices.tolist())
            around = [min(following)]
            while len(around) < len(following):
                around.append(following[around[-1]])
            return np.array(around, dtype=np.intc)
        return self._extreme.copy()

    @cached_property
    def equations(self) -> np.ndarray:
        """(nsimplex, ndim+1): unit outward normal n and offset b of the hyperplane of each simplex, n·x + b ≤ 0 inside up to rounding;
        the same row for all simplices of one facet. Raises QhullError for flat input."""
        if self.affine_dimension < self.ndim:
            raise QhullError(f"equations: the points span a flat of dimension {self.affine_dimension} in {self.ndim} dimensions")
        return self._shown.equations[self._shown.facet_of_cell]

    @cached_property
    def coplanar(self) -> np.ndarray:
        if not self._options.keep_coplanar or self.affine_dimension < 1:
            return np.empty((0, 3), np.intc)
        rest = self._without_good_row(np.arange(self.npoints))
        rest = rest[~np.isin(rest, self.simplices)]
        where = self._shown.locate(self._points[rest])
        rest, cell = rest[where.kind == 1], where.cell[where.kind == 1]
        corners = self.simplices[cell]
        distances = np.linalg.norm(self._points[corners] - self._points[rest][:, None, :], axis=2)
        nearest = np.take_along_axis(corners, distances.argmin(axis=1)[:, None], axis=1)[:, 0]
        return np.stack([rest, cell, nearest], axis=1).astype(np.intc)

    @cached_property
    def good(self):
        if self._options.good_row is None:
            return None
        seen = self._shown.visible_facets(self._points[self._options.good_row])
        return np.isin(self._shown.facet_of_cell, seen) == self._options.good_visible
