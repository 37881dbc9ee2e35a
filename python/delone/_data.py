# SPDX-License-Identifier: BSD-3-Clause
"""Results as plain arrays: what files hold, `check` examines and `to_data` gives."""
from __future__ import annotations

import os
from typing import Any, Dict, List, Optional

import numpy as np
import numpy.typing as npt

from . import _core

__all__ = ["ComplexData", "Data", "HullData", "IntersectionData", "VoronoiData"]


class Data:
    """A result as plain arrays, with the names that files have: each member is an attribute, and `members` is a dict of all.

    What the members are is said by the tables of docs/formats.md. Members that are not known are None. Immutable; equal to nothing but
    itself. Index arrays are int32, and read-only as all arrays.
    """

    __slots__ = ("_members",)
    _kind = ""
    _members: Dict[str, Any]

    def __init__(self, members: Dict[str, Any]):
        object.__setattr__(self, "_members", dict(members))

    @property
    def members(self) -> Dict[str, Any]:
        """A new dict of all members by name."""
        return dict(self._members)

    @property
    def columns(self) -> Optional[List[str]]:
        """What the coordinates are called; None if that is not known."""
        return self._members.get("column_names")

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in self._members:
            return self._members[name]
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} objects do not change")

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._members]

    def __repr__(self) -> str:
        shapes = ", ".join(f"{name} {value.shape}" for name, value in self._members.items() if isinstance(value, np.ndarray) and value.size)
        return f"<delone.{type(self).__name__}: {shapes or 'empty'}>"

    def __reduce__(self):
        return _restored, (type(self), {name: np.array(value) if isinstance(value, np.ndarray) else value
                                        for name, value in self._members.items()})

    def save(self, path, format: Optional[str] = None) -> None:
        """Writes a file that `read` reads, or that other programs do: see docs/formats.md. The format is that of the extension unless it
        is named. The file appears whole or not at all. Errors: Error, ValueError for arrays that do not fit each other."""
        _core._write(self._kind, self._members, os.fsencode(path), format or "")


def _restored(kind, members):
    made = kind.__new__(kind)
    Data.__init__(made, members)
    return made


def _rows(array: Any, name: str) -> np.ndarray:
    array = np.asarray(array)
    if array.ndim != 2:
        raise ValueError(f"{name}: an array of two dimensions, not of shape {array.shape}")
    return array


class ComplexData(Data):
    """A triangulation as plain arrays, whoever made it.

    points : (n, d) float64
    cells : (m, k+1)
        Rows of `points`, the vertices of each cell.
    neighbors : (m, k+1), or None
        Cells: neighbor i is across the facet opposite vertex i; -1 if there is none. Derived from the cells where it is needed.
    vertex_of_point : (n,), or None
        The row each row was merged into: itself, or an equal one; -1 for a hidden point.
    weights : (n,), or None
        Of a regular triangulation.
    affine_dimension : int
        k; that of the cells unless it is given.

    Raises ValueError for arrays of other shapes.
    """

    __slots__ = ()
    _kind = "complex"

    def __init__(self, points: npt.ArrayLike, cells: npt.ArrayLike, neighbors: Optional[npt.ArrayLike] = None,
                 vertex_of_point: Optional[npt.ArrayLike] = None, weights: Optional[npt.ArrayLike] = None,
                 affine_dimension: Optional[int] = None, column_names: Optional[List[str]] = None):
        points, cells = _rows(_core._doubles(points, "points"), "points"), _rows(cells, "cells")
        if points.shape[1] < 1:
            raise ValueError("points: of one coordinate at least")
        members = {"dimension": points.shape[1], "affine_dimension": cells.shape[1] - 1 if affine_dimension is None else affine_dimension,
                   "points": points, "cells": cells,
                   "neighbors": None if neighbors is None else _rows(neighbors, "neighbors"),
                   "vertex_of_point": vertex_of_point, "weights": weights}
        if not -1 <= members["affine_dimension"] <= points.shape[1]:
            raise ValueError(f"cells: {cells.shape[1]} vertices each, of points of dimension {points.shape[1]}")
        if column_names is not None:
            members["column_names"] = list(column_names)
        super().__init__(members)


class HullData(Data):
    """A convex hull as plain arrays: `ConvexHull.to_data`, or what `read` has found in a file."""

    __slots__ = ()
    _kind = "hull"


class IntersectionData(Data):
    """An intersection of halfspaces as plain arrays: `HalfspaceIntersection.to_data`, or what `read` has found in a file."""

    __slots__ = ()
    _kind = "intersection"


class VoronoiData(Data):
    """A Voronoi or power diagram as plain arrays: `Voronoi.to_data`, or what `read` has found in a file."""

    __slots__ = ()
    _kind = "diagram"


_kinds = {kind._kind: kind for kind in (ComplexData, HullData, IntersectionData, VoronoiData)}


def from_core(kind: str, members: Dict[str, Any], columns: Optional[List[Any]] = None) -> Data:
    """Members of the compiled module; what is empty because it is unknown becomes None."""
    if kind == "complex":
        for name, count in (("neighbors", len(members["cells"])), ("vertex_of_point", len(members["points"])),
                            ("weights", len(members["points"]))):
            if count and not members[name].size:
                members[name] = None
        if members["weights"] is not None and not members["weights"].size:
            members["weights"] = None
    if kind == "diagram" and not members["weights"].size:
        members["weights"] = None
    if columns is not None:
        members["column_names"] = ["" if name is None else str(name) for name in columns]
    return _restored(_kinds[kind], members)
