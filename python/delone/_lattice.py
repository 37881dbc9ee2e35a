# SPDX-License-Identifier: BSD-3-Clause
"""What may be given as the lattice of a periodic set."""
from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from ._data import whole


def vectors(lattice: Any, axes: Any, dimension: int) -> np.ndarray:
    """The periodic lattice vectors as rows. `lattice`: a length, lengths, a matrix, or an object of ASE: a Cell, or Atoms with its pbc."""
    if hasattr(lattice, "cell") and hasattr(lattice, "pbc"):
        if axes is None:
            axes = np.asarray(lattice.pbc, dtype=bool)
        lattice = lattice.cell
    given = np.asarray(_core._doubles(np.asarray(lattice), "lattice"))
    if given.ndim < 2 and (given < 0).any():
        raise ValueError("lattice: lengths above 0, not " + ", ".join(map(str, given.ravel().tolist())))
    if given.ndim == 0:
        given = np.full(dimension, float(given))
    if given.ndim == 1:
        if len(given) != dimension:
            raise ValueError(f"lattice: one length, {dimension} lengths, or vectors of {dimension} numbers, not {len(given)} numbers")
        given = np.diag(given)
    if given.ndim != 2 or given.shape[1] != dimension or len(given) > dimension:
        raise ValueError(f"lattice: up to {dimension} vectors of {dimension} numbers, not an array of shape {given.shape}")
    if axes is None:
        # A cell of ASE has zero vectors where it is not periodic.
        return given[given.any(axis=1)] if hasattr(lattice, "cellpar") else given
    return given[_rows(axes, len(given))]


def _rows(axes: Any, count: int) -> np.ndarray:
    """Numbers of lattice vectors, or one flag for each."""
    chosen = np.asarray(axes)
    if chosen.dtype.kind == "b":
        if chosen.shape != (count,):
            raise ValueError(f"axes: {count} flags, not an array of shape {chosen.shape}")
        return np.flatnonzero(chosen)
    if chosen.ndim != 1:
        raise ValueError("axes: a sequence of numbers of lattice vectors, or of flags")
    rows = [whole(axis, "axes", 0, count - 1) for axis in chosen.tolist()]
    if len(set(rows)) < len(rows):
        raise ValueError("axes: every number once")
    return np.array(rows, dtype=int)
