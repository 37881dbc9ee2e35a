# SPDX-License-Identifier: BSD-3-Clause
"""The names, arguments and attributes of `scipy.spatial` for triangulations, hulls, Voronoi diagrams and intersections of halfspaces,
computed exactly: change the import of a program, and it runs. Where results differ (flat, duplicate, cospherical points;
tolerances) is the subject of docs/from-scipy.md.
"""
from ._base import QhullError
from ._convex_hull import ConvexHull
from ._delaunay import Delaunay, tsearch
from ._halfspaces import HalfspaceIntersection
from ._plot import convex_hull_plot_2d, delaunay_plot_2d, voronoi_plot_2d
from ._voronoi import Voronoi

__all__ = ["ConvexHull", "Delaunay", "HalfspaceIntersection", "QhullError", "Voronoi", "convex_hull_plot_2d", "delaunay_plot_2d",
           "tsearch", "voronoi_plot_2d"]
