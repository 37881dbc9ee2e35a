# SPDX-License-Identifier: BSD-3-Clause
"""What an attribute that a class has not is called here: names of SciPy and of other programs."""
from __future__ import annotations

from typing import Dict

from . import _core

_INSERT = dict.fromkeys(("insert", "add", "add_point", "append"), "insert_range")
_SIZES = {"npoints": "num_points", "ndim": "dimension"}
_OF_CELLS = {"simplices": "cells", "nsimplex": "num_cells", "add_points": "insert_range"}

# Those of the class in delone.spatial that has the same name.
_OF_SCIPY = {
    _core.Triangulation: {**_SIZES, **_OF_CELLS, "vertices": "cells (the vertices of each cell)", "convex_hull": "hull_facets",
                          "coplanar": "duplicates", "vertex_to_simplex": "cell_of_point", "vertex_neighbor_vertices": "vertex_neighbors"},
    _core.ConvexHull: {**_SIZES, **_OF_CELLS, "coplanar": "point_kinds"},
    _core.Diagram: {**_SIZES, "regions": "region(i), or region_vertices and region_offsets", "ridge_dict": "ridge(i) and ridge_points"},
    _core.HalfspaceIntersection: {"ndim": "dimension", "nineq": "num_halfspaces", "intersections": "vertices", "dual_facets": "vertex_halfspaces",
                                  "dual_vertices": "facet_halfspaces", "add_halfspaces": "insert_range"},
}
_OF_OTHERS = {
    _core.Triangulation: {**_INSERT, "triangles": "cells", "tetrahedra": "cells", "delete": "remove", "remove_points": "remove"},
    _core.ConvexHull: {**_INSERT, "faces": "facets"},
    _core.Diagram: {},
    _core.HalfspaceIntersection: _INSERT,
}
_IN_SPATIAL = ("ConvexHull", "Delaunay", "HalfspaceIntersection", "Voronoi")


def _getattr_with(of_scipy: Dict[str, str], of_others: Dict[str, str]):
    def __getattr__(self, name):
        kind, here = type(self).__name__, of_scipy.get(name) or of_others.get(name)
        text = f"{kind!r} object has no attribute {name!r}"
        if here:
            text += f"; here it is {here}"
        if name in of_scipy and kind in _IN_SPATIAL:
            text += f". delone.spatial.{kind} has the names of SciPy"
        raise AttributeError(text)
    return __getattr__


def attach() -> None:
    """Once, when the module is imported."""
    for owner, of_scipy in _OF_SCIPY.items():
        owner.__getattr__ = _getattr_with(of_scipy, _OF_OTHERS[owner])
