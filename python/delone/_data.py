# SPDX-License-Identifier: BSD-3-Clause
"""Results as plain arrays: what files hold, `check` examines and `to_data` gives."""
from __future__ import annotations

import functools
import operator
import os
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple

import numpy as np

from . import _core

if TYPE_CHECKING:  # it takes longer to import than the module itself
    import numpy.typing as npt

__all__ = ["ComplexData", "Data", "HullData", "IntersectionData", "VoronoiData"]


class Data:
    """Result as plain arrays, with the names that files use.

    Each member is an attribute. docs/formats.md lists the members of each kind of result; `kind` names the kind, a str. Unknown members are None. Objects are
    immutable, and equal only to themselves. Index arrays are int32 (int64 in a build with 64-bit ids); all arrays are read-only.

    Parameters
    ----------
    members : dict
        The members by name. Programs call `read` or the method `to_data` of a result instead.
    """

    __slots__ = ("_members",)
    _kind = ""
    _members: Dict[str, Any]

    def __init__(self, members: Dict[str, Any]):
        object.__setattr__(self, "_members", {name: _read_only(value) if isinstance(value, np.ndarray) else value for name, value in members.items()})

    @property
    def members(self) -> Dict[str, Any]:
        """All members by name, a new dict."""
        return dict(self._members)

    @property
    def columns(self) -> Optional[Tuple[str, ...]]:
        """The names of the coordinates, a tuple; None if unknown."""
        names = self._members.get("column_names")
        return None if names is None else tuple(names)

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
        """Write the arrays to a file.

        Parameters
        ----------
        path : str or os.PathLike
            The file; "-" is standard output, for text formats.
        format : str, optional
            The format, see docs/formats.md. By default the extension of the path tells it.

        Raises
        ------
        Error
            If the file cannot be written, or the format cannot hold the result.
        ValueError
            If arrays disagree.

        Notes
        -----
        The file appears whole or not at all.
        """
        _core._write(self._kind, self._members, os.fsencode(path), format or "")


def _restored(kind, members):
    made = kind.__new__(kind)
    Data.__init__(made, members)
    return made


def _read_only(array: np.ndarray) -> np.ndarray:
    """The array, or a view of it that nobody writes to."""
    if array.flags.writeable:
        array = array.view()
        array.flags.writeable = False
    return array


def _owned(array: np.ndarray, given: Any) -> np.ndarray:
    """The array made of what was given; a copy if somebody can still write to it."""
    return array.copy() if array.flags.writeable and np.may_share_memory(array, np.asarray(given)) else array


@functools.lru_cache(maxsize=None)
def _index_type() -> np.dtype:
    return _core.Delaunay(np.empty((0, 1))).cells.dtype


def _indices(given: Any, name: str, shape: Tuple[Optional[int], ...]) -> np.ndarray:
    """Whole numbers as indices, of this shape, in which None stands for any length. ValueError for others."""
    array = np.asarray(given)
    _require_shape(array, name, shape)
    if np.ma.is_masked(given) or (array.dtype.kind not in "iu" and array.size):
        raise ValueError(f"{name}: whole numbers, not {'masked values' if np.ma.is_masked(given) else array.dtype}")
    limits = np.iinfo(_index_type())
    for extreme in (array.min(), array.max()) if array.size else ():
        if not limits.min <= extreme <= limits.max:
            raise ValueError(f"{name}: {extreme} is beyond the range of {_index_type()}")
    return _owned(np.ascontiguousarray(array, dtype=_index_type()), given)


def _reals(given: Any, name: str, shape: Tuple[Optional[int], ...]) -> np.ndarray:
    array = _core._doubles(given, name)
    _require_shape(array, name, shape)
    return _owned(array, given)


def _require_shape(array: np.ndarray, name: str, shape: Tuple[Optional[int], ...]) -> None:
    if array.ndim != len(shape) or any(wanted not in (None, length) for wanted, length in zip(shape, array.shape)):
        wanted = ", ".join("…" if length is None else str(length) for length in shape)
        raise ValueError(f"{name}: an array of shape ({wanted}{',' if len(shape) == 1 else ''}), not {array.shape}")


def whole(value: Any, name: str, least: int = 0, most: int = 2**31 - 1) -> int:
    """An argument that is a whole number. TypeError, ValueError."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: a whole number, not {type(value).__name__}") from None
    if not least <= number <= most:
        raise ValueError(f"{name}: at {f'least {least}' if number < least else f'most {most}'}, not {number}")
    return number


def text(value: Any, name: str) -> str:
    """An argument that is a str. TypeError."""
    if not isinstance(value, str):
        raise TypeError(f"{name}: a str, not {type(value).__name__}")
    return value


def names(product: Any) -> List[str]:
    """What the coordinates of a product are called, "" where that is unknown; empty if none has a name. The rows of halfspaces have one
    number more than there are coordinates."""
    found = ["" if name is None else str(name) for name in getattr(product, "columns", None) or ()]
    if isinstance(product, _core.HalfspaceIntersection):
        found = found[:product.dimension]
    return found if any(found) and len(found) == product.dimension else []


def values_of(given: Any, name: str) -> np.ndarray:
    """Numbers that belong to parts of a product, as an array of bool, integers, float32 or float64 in the byte order of the machine; None
    and masked entries are NaN. ValueError for anything else."""
    array = np.asarray(given)
    if array.dtype.kind == "O":
        flat = [np.nan if value is None else value for value in array.ravel()]
        array = np.asarray(_core._doubles(flat, name)).reshape(array.shape)
    if array.dtype.kind not in "fiub":
        raise ValueError(f"{name}: numbers, not {array.dtype}")
    if np.ma.is_masked(given):
        array = np.where(np.ma.getmaskarray(given), np.nan, array)
    dtype = array.dtype if array.dtype.kind != "f" or array.itemsize in (4, 8) else np.dtype(float)
    return array.astype(dtype.newbyteorder("="), copy=False)


_kinds_of_complexes = ("delaunay", "regular", "furthest_site", "alpha_complex", "alpha_boundary", "trimmed", "lower_hull", "upper_hull", "hull_boundary")


class ComplexData(Data):
    """Triangulation as plain arrays, from any program.

    Arrays that can still be changed are copied.

    Parameters
    ----------
    points : (n, d) array_like
        The points, float64.
    cells : (m, k+1) array_like of int
        The vertices of each cell, as rows of `points`.
    neighbors : (m, k+1) array_like of int, optional
        The neighbors of each cell: number j is opposite vertex j, -1 outside the hull. If None, they are derived when needed.
    vertex_of_point : (n,) array_like of int, optional
        The row that each row was merged into: itself, or an equal one; -1 for a hidden or removed point.
    weights : (n,) array_like, optional
        The weights of a regular triangulation.
    affine_dimension : int, optional
        The dimension k. By default that of the cells.
    column_names : list of str, optional
        The names of the d coordinates; "" for an unknown one.
    kind : str, optional
        What the cells are, which `check` proves: "delaunay", "regular", "furthest_site", "alpha_complex", "alpha_boundary", "trimmed",
        "lower_hull", "upper_hull" or "hull_boundary". By default unknown.
    tolerance : float, default 0.0
        For a lower or upper hull: points may be as far as this beyond it along the last axis.

    Raises
    ------
    ValueError
        If arrays have other shapes or types, or for an unknown kind.

    Examples
    --------
    >>> import delone
    >>> data = delone.ComplexData([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    >>> bool(delone.check(data))
    True
    """

    __slots__ = ()
    _kind = "complex"

    def __init__(self, points: npt.ArrayLike, cells: npt.ArrayLike, neighbors: Optional[npt.ArrayLike] = None,
                 vertex_of_point: Optional[npt.ArrayLike] = None, weights: Optional[npt.ArrayLike] = None,
                 affine_dimension: Optional[int] = None, column_names: Optional[List[str]] = None, *, kind: Optional[str] = None,
                 tolerance: float = 0.0):
        points, cells = _reals(points, "points", (None, None)), _indices(cells, "cells", (None, None))
        n, d = points.shape
        if d < 1:
            raise ValueError("points: of one coordinate at least")
        if cells.shape[1] > d + 1:
            raise ValueError(f"cells: {cells.shape[1]} vertices each, of points of dimension {d}")
        k = cells.shape[1] - 1 if affine_dimension is None else whole(affine_dimension, "affine_dimension", -1, d)
        members = {"dimension": d, "affine_dimension": k, "points": points, "cells": cells,
                   "neighbors": None if neighbors is None else _indices(neighbors, "neighbors", cells.shape),
                   "vertex_of_point": None if vertex_of_point is None else _indices(vertex_of_point, "vertex_of_point", (n,)),
                   "weights": None if weights is None else _reals(weights, "weights", (n,)),
                   "kind": kind if kind is None else text(kind, "kind"), "tolerance": float(tolerance)}
        if kind is not None and kind not in _kinds_of_complexes:
            raise ValueError(f"kind: {', '.join(_kinds_of_complexes)}; not {_core._represented(kind)}")
        if column_names is not None:
            members["column_names"] = [text(name, "column_names") for name in column_names]
            if len(members["column_names"]) != d:
                raise ValueError(f"column_names: {d}, not {len(members['column_names'])}")
        super().__init__(members)


class HullData(Data):
    """Convex hull as plain arrays.

    Returned by `ConvexHull.to_data` and `read`. docs/formats.md lists the members.

    Parameters
    ----------
    members : dict
        The members by name.

    Examples
    --------
    >>> import delone
    >>> data = delone.ConvexHull([[0, 0], [1, 0], [0, 1]]).to_data()
    >>> data.vertices
    array([0, 1, 2], dtype=int32)
    """

    __slots__ = ()
    _kind = "hull"


class IntersectionData(Data):
    """Intersection of halfspaces as plain arrays.

    Returned by `HalfspaceIntersection.to_data` and `read`. docs/formats.md lists the members.

    Parameters
    ----------
    members : dict
        The members by name.

    Examples
    --------
    >>> import delone
    >>> data = delone.HalfspaceIntersection([[-1, 0], [1, -1]]).to_data()
    >>> data.vertices
    array([[0.],
           [1.]])
    """

    __slots__ = ()
    _kind = "intersection"


class VoronoiData(Data):
    """Voronoi or power diagram as plain arrays.

    Returned by `Voronoi.to_data` and `read`. docs/formats.md lists the members. The member `kind` is "voronoi", "power_diagram" or
    "furthest_voronoi".

    Parameters
    ----------
    members : dict
        The members by name.

    Examples
    --------
    >>> import delone
    >>> data = delone.Voronoi([[0, 0], [2, 0], [0, 2]]).to_data()
    >>> data.vertices
    array([[1., 1.]])
    """

    __slots__ = ()
    _kind = "diagram"


_kinds = {kind._kind: kind for kind in (ComplexData, HullData, IntersectionData, VoronoiData)}


def from_core(kind: str, members: Dict[str, Any], columns: Optional[List[str]] = None) -> Data:
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
    if columns:
        members["column_names"] = columns
    return _restored(_kinds[kind], members)
