# SPDX-License-Identifier: BSD-3-Clause
"""pandas DataFrames as arguments. The compiled module calls this where it is given one, so that pandas is imported already."""
from __future__ import annotations

import sys
from typing import Optional, Tuple

import numpy as np

from . import _core


def columns(frame) -> Optional[tuple]:
    """The labels of the columns; None if they are the numbers that pandas gives to columns without names."""
    labels = tuple(frame.columns)
    return None if labels == tuple(range(len(labels))) else labels


def columns_of(points) -> Optional[tuple]:
    """columns(points) if points is a DataFrame, else None. Does not import pandas."""
    pandas = sys.modules.get("pandas")
    return columns(points) if pandas is not None and isinstance(points, pandas.DataFrame) else None


def index(frame):
    """The index of a DataFrame."""
    return frame.index


def _counts(labels) -> bool:
    """Whether this is the index that pandas gives to rows without labels: 0, 1, 2, …"""
    return type(labels).__name__ == "RangeIndex" and labels.start == 0 and labels.step == 1


def require_index(given, wanted, name: str) -> None:
    """Raises ValueError if this is a Series or DataFrame whose rows have other labels than `wanted`, an index or None, or have them in
    another order. An index that counts the rows says nothing, unless the other one has the same numbers. One of another length is left to
    who counts entries."""
    pandas = sys.modules.get("pandas")
    if wanted is None or pandas is None or not isinstance(given, (pandas.Series, pandas.DataFrame)):
        return
    found = given.index
    if len(found) != len(wanted) or found.equals(wanted):
        return
    is_reordered = wanted.is_unique and len(wanted.difference(found)) == 0
    if is_reordered or not (_counts(found) or _counts(wanted)):
        which = "the labels are in another order" if is_reordered else "other labels"
        raise ValueError(f"{name}: the index is not that of the points: {which}; take {name}.loc[points.index], or to_numpy() to go by position")


def require_columns(frame, wanted: tuple, name: str) -> None:
    """Raises ValueError if the columns have names, and not the names `wanted`, in this order. A Series is one row."""
    if frame.ndim == 1:
        found = None if _counts(frame.index) else tuple(frame.index)
    else:
        found = columns(frame)
    if found is not None and found != wanted:
        raise ValueError(f"{name}: the columns {_listed(found)}, not {_listed(wanted)}, in this order")


def numbers(frame, name: str, is_finite: bool) -> np.ndarray:
    """The DataFrame as C-contiguous float64, (rows, columns): its own memory if it is that, otherwise copied once, column by column.

    InputError names the column with anything but real numbers that are exact in float64, and the row by its position and its label; with
    `is_finite` also for a number that is missing, NaN or infinite.
    """
    count, width = frame.shape
    given = [_numbers_of(frame.iloc[:, j], f"{name}: column {_core._represented(frame.columns[j])}") for j in range(width)]
    if _are_rows_of_one_array(given):
        array = frame.to_numpy()
    else:
        array = np.empty((count, width))
        for j, column in enumerate(given):
            array[:, j] = column
    if is_finite and not np.isfinite(array).all():
        _refuse_not_finite(frame, array, name)
    return array


def _numbers_of(series, what: str) -> np.ndarray:
    """A column as an array that float64 can take as it is, where possible without a copy."""
    missing = None
    if isinstance(series.dtype, np.dtype):
        column = series.to_numpy()
    elif getattr(getattr(series.dtype, "numpy_dtype", None), "kind", "O") in "fiub":  # numbers, some of which may be missing
        missing = series.isna().to_numpy()
        dtype = series.dtype.numpy_dtype
        column = (series.dropna() if missing.any() else series).to_numpy(dtype=dtype)
    else:
        column = np.asarray(series)
    kind = column.dtype.kind
    if kind not in "fiubO":
        raise _core.InputError(f"{what}: not real numbers, but {_core._represented(str(series.dtype))}")
    is_large = kind in "iu" and column.itemsize == 8 and len(column) > 0 and not -2**53 <= int(column.min()) <= int(column.max()) <= 2**53
    if kind == "O" or is_large or (kind == "f" and column.itemsize > 8):
        column = _core._doubles(column, what)  # raises what there is to raise
    if missing is None or not missing.any():
        return column
    with_gaps = np.full(len(missing), np.nan)
    with_gaps[~missing] = column
    return with_gaps


def _are_rows_of_one_array(given) -> bool:
    """Whether the columns are those of one C-contiguous array of float64, in their order."""
    if not given or len(given[0]) < 2:
        return False
    step = 8 * len(given)
    first = given[0].__array_interface__["data"][0]
    return all(column.dtype == np.float64 and column.strides == (step,) and column.__array_interface__["data"][0] == first + 8 * j
               for j, column in enumerate(given))


def _refuse_not_finite(frame, array: np.ndarray, name: str) -> None:
    row, column = np.argwhere(~np.isfinite(array))[0].tolist()
    rows = np.flatnonzero(~np.isfinite(array).all(axis=1)).tolist()
    label = frame.index[row]
    which = f"row {row}" if label is row or label == row else f"row {row} (label {_core._represented(label)})"
    more = f" (and {len(rows) - 1} more rows)" if len(rows) > 1 else ""
    error = _core.InputError(f"{name}: {which}, column {_core._represented(frame.columns[column])}: {array[row, column]} is not finite{more}")
    error.rows = rows
    raise error


def _listed(labels: Tuple) -> str:
    return ", ".join(_core._represented(label) for label in labels)


def _pandas(what):
    try:
        import pandas
    except ImportError as error:
        raise ImportError(f"{what} needs pandas: install it, for example by `pip install pandas`, or as the package python3-pandas of Debian "
                          "and Ubuntu") from error
    return pandas


def framed(points, names) -> object:
    """Points as a DataFrame, whose columns have these names, if there are any."""
    pandas = _pandas("frame=True")
    return pandas.DataFrame(points, columns=pandas.Index(names, tupleize_cols=False) if names else None)


def _frame(product, points, data, labels=None) -> object:
    """Points beside data: arrays, or (codes, names of kinds). `labels`: of the columns of points if these have no names."""
    pandas = _pandas("to_frame()")
    labels = product.columns or labels or [f"x{j}" for j in range(points.shape[1])]
    data = {name: pandas.Categorical.from_codes(*values) if isinstance(values, tuple) else values for name, values in data.items()}
    frame = pandas.concat([pandas.DataFrame(points), pandas.DataFrame(data)], axis=1)
    frame.columns = pandas.Index([*labels, *data], tupleize_cols=False)
    return frame


def triangulation(self):
    """Return the points as a pandas DataFrame, one row per point.

    Returns
    -------
    pandas.DataFrame
        The columns are the coordinates, with the labels of `columns` or x0, x1, ...;
        `weight` (`Regular` only); `vertex`, the row that the row was merged into (itself for a vertex, -1 if it is hidden);
        and `cell`, a cell with that vertex, or -1.

    Raises
    ------
    ImportError
        If pandas is missing.
    """
    weights = {"weight": self.weights} if isinstance(self, _core.Regular) else {}
    return _frame(self, self.points, {**weights, "vertex": self.vertex_of_point, "cell": self.cell_of_point})


def convex_hull(self):
    """Return the points as a pandas DataFrame, one row per point.

    Returns
    -------
    pandas.DataFrame
        The columns are the coordinates, with the labels of `columns` or x0, x1, ...;
        and `kind`: extreme, boundary, interior or duplicate, see `point_kinds`.

    Raises
    ------
    ImportError
        If pandas is missing.
    """
    return _frame(self, self.points, {"kind": (self.point_kinds, ["extreme", "boundary", "interior", "duplicate"])})


def diagram(self):
    """Return the points as a pandas DataFrame, one row per point.

    Returns
    -------
    pandas.DataFrame
        The columns are the coordinates, with the labels of `columns` or x0, x1, ...;
        `region`, the number of the region, or -1; and `bounded`, whether the region is bounded.

    Raises
    ------
    ImportError
        If pandas is missing.
    """
    region = self.point_region
    return _frame(self, self.points, {"region": region, "bounded": np.append(self.is_bounded, False)[region]})


def lower_hull(self):
    """Return the points as a pandas DataFrame, one row per point.

    Returns
    -------
    pandas.DataFrame
        The columns are the coordinates, with the labels of `columns` or x0, x1, ...;
        `height_above`, the height above the hull, 0 exactly on it; and `is_vertex`, whether the row is an extreme point of
        this side (of equal rows the first).

    Raises
    ------
    ImportError
        If pandas is missing.
    """
    is_vertex = np.zeros(self.num_points, dtype=bool)
    is_vertex[self.vertices] = True
    return _frame(self, self.points, {"height_above": self.height_above(self.points), "is_vertex": is_vertex})


def intersection(self):
    """Return the halfspaces as a pandas DataFrame, one row per halfspace.

    Returns
    -------
    pandas.DataFrame
        The columns are the numbers of the row, with the labels of `columns` or a0, a1, ... and b; and `kind`: facet,
        touching, redundant, duplicate or trivial, see `kinds`.

    Raises
    ------
    ImportError
        If pandas is missing.
    """
    labels = [*(f"a{j}" for j in range(self.dimension)), "b"]
    return _frame(self, self.halfspaces, {"kind": (self.kinds, ["facet", "touching", "redundant", "duplicate", "trivial"])}, labels)
