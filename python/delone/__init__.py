# SPDX-License-Identifier: BSD-3-Clause
"""Exact Delaunay and regular triangulations, convex hulls, intersections of halfspaces, Voronoi and power diagrams.

Arrays go in and come out as NumPy arrays. Results are exact functions of the input: flat, duplicate and cospherical points are
ordinary input, and no tolerance decides anything. `delone.spatial` has the names and arguments of `scipy.spatial`.
"""
import importlib

from ._core import (CancelledError, ConvexHull, Delaunay, Error, FurthestSite, HalfspaceIntersection, InputError, LinearInterpolator,
                    OutOfMemoryError, PowerDiagram, Regular, Voronoi, __version__)
from ._convex_hulls import ConvexHulls, convex_hulls
from ._locations import Locations
from ._transform import transform as _transform

__all__ = ["CancelledError", "ConvexHull", "ConvexHulls", "Delaunay", "Error", "FurthestSite", "HalfspaceIntersection", "InputError",
           "LinearInterpolator", "Locations", "OutOfMemoryError", "PowerDiagram", "Regular", "Voronoi", "__version__", "convex_hulls"]

for _type in (ConvexHull, ConvexHulls, Delaunay, FurthestSite, HalfspaceIntersection, LinearInterpolator, PowerDiagram, Regular, Voronoi):
    _type.__module__ = "delone"
del _type
convex_hulls.__module__ = "delone"
Delaunay.__base__.transform = property(_transform)


def __getattr__(name):
    if name == "spatial":
        return importlib.import_module(".spatial", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
