# SPDX-License-Identifier: BSD-3-Clause
"""The names and arguments of `scipy.interpolate` for scattered data, on exact triangulations, and natural neighbors.

Where results differ from scipy's is the subject of docs/from-scipy.md. `delone.LinearInterpolator` has more: other policies outside
of the hull, gradients, weighted points.
"""
from ._base import GradientEstimationWarning
from ._clough_tocher import CloughTocher2DInterpolator
from ._griddata import griddata
from ._linear import LinearNDInterpolator
from ._natural_neighbors import NaturalNeighborInterpolator
from ._nearest import NearestNDInterpolator

__all__ = ["CloughTocher2DInterpolator", "GradientEstimationWarning", "LinearNDInterpolator", "NaturalNeighborInterpolator",
           "NearestNDInterpolator", "griddata"]
