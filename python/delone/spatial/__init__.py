# SPDX-License-Identifier: BSD-3-Clause
"""Exact counterparts of `scipy.spatial`: triangulations, hulls, Voronoi diagrams and intersections of halfspaces.

Names, arguments and attributes are those of scipy: change the import of a program, and it runs. docs/from-scipy.md says
where results differ (flat, duplicate, cospherical points; tolerances).

All other names of `scipy.spatial`, such as KDTree, distance and SphericalVoronoi, are scipy's own, imported on first use;
ImportError if scipy is not installed. `delone.patch_scipy` makes programs use delone without changing them.
"""
import importlib
import importlib.util

from ._base import QhullError
from ._convex_hull import ConvexHull
from ._delaunay import Delaunay, tsearch
from ._halfspaces import HalfspaceIntersection
from ._plot import convex_hull_plot_2d, delaunay_plot_2d, voronoi_plot_2d
from ._voronoi import Voronoi

__all__ = ["ConvexHull", "Delaunay", "HalfspaceIntersection", "QhullError", "Voronoi", "convex_hull_plot_2d", "delaunay_plot_2d",
           "tsearch", "voronoi_plot_2d"]

_OF_SCIPY = ("KDTree", "Rectangle", "SphericalVoronoi", "cKDTree", "distance", "distance_matrix", "geometric_slerp",
             "minkowski_distance", "minkowski_distance_p", "procrustes", "transform")


def __getattr__(name):
    if not name.startswith("_"):
        try:
            theirs = importlib.import_module("scipy.spatial")
        except ImportError as error:
            if name in _OF_SCIPY:
                raise ImportError(f"delone.spatial.{name} is that of scipy.spatial, which cannot be imported: {error}") from error
        else:
            if name in _OF_SCIPY or name in theirs.__all__ and name != "qhull":
                return getattr(theirs, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    own = [name for name in globals() if not name.startswith("_")]
    return sorted({*own, *__all__, *(_OF_SCIPY if importlib.util.find_spec("scipy") else ())})
