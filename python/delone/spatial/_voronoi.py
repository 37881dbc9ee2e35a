# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.Voronoi, exact."""
from __future__ import annotations

from functools import cached_property

import numpy as np

import delone
from delone import _core

from . import _options, _tolerance
from ._base import OfPoints, as_points


class Voronoi(OfPoints):
    """Voronoi diagram in any dimension, with the interface of `scipy.spatial.Voronoi`.

    Parameters
    ----------
    points : (npoints, ndim) array_like
        The points, finite numbers. Duplicates share a region.
    furthest_site : bool, default False
        Compute the diagram of the furthest instead of the nearest points.
    incremental : bool, default False
        Allow `add_points`.
    qhull_options : str, optional
        Qhull's options, see docs/from-qhull.md. Default "Qbb Qc Qz".
    tolerance : float or (ndim,) array_like, optional
        Vertices within this distance of a representative are merged with it, and ridges of less width are left out, see
        `delone.Voronoi`. 0 is exact; there may be one number for each axis. By default Qhull's round-off, about 1e-14 of the
        coordinates, see docs/from-scipy.md. Not in scipy.
    flat : {'error', 'result'}, optional
        For flat input, points that span less than the space: raise QhullError as in scipy, or compute the diagram within the flat. With 'result' points in one
        dimension are allowed, too. Default 'error', with option QJ 'result'. Not in scipy.

    Attributes
    ----------
    ndim : int
        The number of coordinates.
    npoints : int
        The number of points.
    min_bound : (ndim,) ndarray of float64
        The lower corner of the bounding box.
    max_bound : (ndim,) ndarray of float64
        The upper corner of the bounding box.
    affine_dimension : int
        The dimension k of the smallest flat that contains all points. Not in scipy.
    vertices : (nvertices, ndim) ndarray of float64
        The distinct Voronoi vertices, each coordinate the double nearest to the exact one.
    ridge_points : (nridges, 2) ndarray of int32
        The points on both sides of each ridge. As in scipy, ridges with fewer than k vertices, infinity counted as one, are left
        out; `delone.Voronoi` has them all.
    point_region : (npoints,) ndarray of int64
        The region of each point. -1 for duplicates if the options leave out Qc.
    furthest_site : bool
        Whether it is a furthest-site diagram.
    tolerance : float
        The tolerance, given or computed; the largest of those of the axes. Not in scipy.
    axis_tolerances : (ndim,) ndarray of float64
        How far vertices may have moved along each axis. Not in scipy.

    Raises
    ------
    QhullError
        If the input is flat and `flat` is 'error', or a coordinate is infinite.
    ValueError
        If a coordinate is NaN, an option has no meaning here, or an argument is out of range.

    See Also
    --------
    delone.Voronoi : The interface of delone, with more answers.

    Notes
    -----
    Results cannot be assigned; arrays are the caller's to change, and changes affect nothing else.

    Examples
    --------
    >>> from delone.spatial import Voronoi
    >>> vor = Voronoi([[0, 0], [2, 0], [0, 2], [2, 2]])
    >>> vor.vertices
    array([[1., 1.]])
    >>> vor.regions[vor.point_region[0]]
    [-1, 0]
    """

    _derived = ("vertices", "ridge_points", "ridge_vertices", "regions", "point_region", "ridge_dict", "affine_dimension", "tolerance", "axis_tolerances",
                "_num_hidden", "_listed_ridges", "_ridges", "_regions", "_ray_points", "_ray_directions")

    def __init__(self, points, furthest_site=False, incremental=False, qhull_options=None, *, tolerance=None, flat=None):
        points = as_points(points)
        self._options = _options.parse(qhull_options, kind="voronoi", furthest_site=furthest_site, incremental=incremental)
        self._set(furthest_site=self._options.furthest)
        self._wanted_tolerance = tolerance
        self._start(points, incremental, flat)

    def _rebuild(self, points):
        self._core = (delone.FurthestSite if self._options.furthest else delone.Delaunay)(points)

    def _extend(self, rows):
        self._core.insert_range(rows)

    def _update(self):
        tolerance = self._wanted_tolerance
        if tolerance is None:
            rounding = _tolerance.Rounding(self._points, self._options, (self.min_bound, self.max_bound))
            tolerance = np.array(rounding.of_diagram())
        diagram = (delone.FurthestVoronoi if self._options.furthest else delone.Voronoi)(self._core, tolerance)
        point_region = diagram.point_region.astype(np.intp)
        hidden = np.flatnonzero(point_region == -1)
        point_region[hidden] = diagram.num_regions + np.arange(len(hidden))
        if self._options.at_infinity:
            point_region += 1
        if not self._options.keep_coplanar:
            point_region[self._core.duplicates[:, 0]] = -1
        # As in scipy, where infinity counts as one vertex, ridges with fewer than k vertices are left out: the cones at one vertex,
        # and the like, that are dual to edges of the convex hull with few cells about them.
        counts = np.diff(diagram.ridge_offsets)
        listed = np.flatnonzero(counts >= self._core.affine_dimension)
        self._take_over(affine_dimension=self._core.affine_dimension, vertices=np.array(diagram.vertices), point_region=point_region,
                        ridge_points=diagram.ridge_points[listed], tolerance=diagram.tolerance,
                        axis_tolerances=np.array(diagram.axis_tolerances), _num_hidden=len(hidden), _listed_ridges=listed,
                        _ridges=(diagram.ridge_vertices, diagram.ridge_offsets), _regions=(diagram.region_vertices, diagram.region_offsets),
                        _ray_points=diagram.ray_points, _ray_directions=diagram.ray_directions)
        if not self._incremental:
            del self._core

    @cached_property
    def ridge_vertices(self) -> list[list[int]]:
        """The vertices of each ridge, a list of lists of int.

        -1 comes first if the ridge is unbounded. In cyclic order in 3 dimensions.
        """
        ridges = _core._lists(*self._ridges)
        return [ridges[i] for i in self._listed_ridges.tolist()]

    @cached_property
    def regions(self) -> list[list[int]]:
        """The vertices of each region, a list of lists of int.

        -1 comes first if the region is unbounded. In cyclic order in the plane. With option Qz, a default, the first one is empty, that
        of the point at infinity: often the first in scipy, too. So are those of points that are not the furthest anywhere.
        """
        regions = _core._lists(*self._regions)
        regions = [[] if region == [-1] else region for region in regions] + [[] for _ in range(self._num_hidden)]
        return [[], *regions] if self._options.at_infinity else regions

    @cached_property
    def ridge_dict(self) -> dict[tuple[int, int], list[int]]:
        """The vertices of the ridge between two points, a dict."""
        return dict(zip(map(tuple, self.ridge_points.tolist()), self.ridge_vertices))
