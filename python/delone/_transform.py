# SPDX-License-Identifier: BSD-3-Clause
"""Affine maps to barycentric coordinates."""
from __future__ import annotations

import numpy as np

from ._core import _transforms


def transform(self) -> np.ndarray:
    """Affine maps to barycentric coordinates, (m, k+1, k) float64.

    All but the last barycentric coordinate of x in cell i are ``transform[i, :k] @ (x[axes] - transform[i, k])``; `axes` are all
    axes when k = d. Rounded: `barycentric` is more accurate. NaN if rounding makes a cell flat. Computed at every call, O(m k^3).
    """
    if self.affine_dimension < 1:
        return np.empty((len(self), self.affine_dimension + 1, max(self.affine_dimension, 0)))
    points = self.points if self.affine_dimension == self.dimension else self.points[:, list(self.axes)]
    return _transforms(points, self.cells)[0]
