# SPDX-License-Identifier: BSD-3-Clause
"""Affine maps to barycentric coordinates."""
from __future__ import annotations

import numpy as np

from ._core import _transforms


def transform(self) -> np.ndarray:
    """(m, k+1, k) float64: barycentric coordinates of x in cell i but the last are ``T[i, :k] @ (x[axes] - T[i, k])``, with
    `axes` all d of them when k = d. Rounded: `barycentric` is more accurate. NaN where rounding makes a cell flat. Computed at
    every call, O(m k³)."""
    if self.affine_dimension < 1:
        return np.empty((len(self), self.affine_dimension + 1, max(self.affine_dimension, 0)))
    points = self.points if self.affine_dimension == self.dimension else self.points[:, list(self.axes)]
    return _transforms(points, self.cells)[0]
