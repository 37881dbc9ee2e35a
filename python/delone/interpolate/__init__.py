# SPDX-License-Identifier: BSD-3-Clause
"""Exact counterparts of `scipy.interpolate` for scattered data, and natural neighbor interpolation.

Names and arguments are those of scipy. docs/from-scipy.md says where results differ. `delone.LinearInterpolator` has more:
other policies outside the hull, gradients, weighted points.
"""
from ._base import GradientEstimationWarning
from ._clough_tocher import CloughTocher2DInterpolator
from ._griddata import griddata
from ._linear import LinearNDInterpolator
from ._natural_neighbors import NaturalNeighborInterpolator
from ._nearest import NearestNDInterpolator

__all__ = ["CloughTocher2DInterpolator", "GradientEstimationWarning", "LinearNDInterpolator", "NaturalNeighborInterpolator",
           "NearestNDInterpolator", "griddata"]
