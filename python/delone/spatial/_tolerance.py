# SPDX-License-Identifier: BSD-3-Clause
"""The default tolerances of what is made like Qhull's hulls and diagrams: how far rounding may have moved points along each axis.

A number is rounded in the scale of its own column. The *size* of a column is that of its largest numbers, see
`_core._column_sizes`; but numbers far larger than all others do not count, since their rounding says nothing of the others.
"""
from __future__ import annotations

import math
import sys

import numpy as np

from delone import _core

from ._geometry import bounds
from ._options import Options

EPSILON = sys.float_info.epsilon
LARGEST = sys.float_info.max
# In a diagram the rounding of the largest column counts for another one as well, but at most as this many times its own.
LARGEST_SHARE = 4096


def roundoff(dimension: int) -> float:
    """Qhull's round-off of the distance of a point from a hyperplane, for coordinates up to 1: ε (1.01 d √d + 1), ε = 2⁻⁵².

    See qh_distround in Qhull, C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The quickhull algorithm for convex hulls,
    doi:10.1145/235815.235821.
    """
    return EPSILON * (1.01 * dimension * math.sqrt(dimension) + 1)


class Rounding:
    """What the tolerances of points (n, d) depend on: their columns, and Qhull's options. Tolerances are lists of d numbers.

    As Qhull's ``_one-merge`` the tolerance of an axis is (2d + 1) R + d C, where R is `roundoff` times the size of the column and
    C = 0. Options Cn and C-n give C, En gives R, and Wn a lower bound of the result. With QbB these are lengths in the cube that
    columns are scaled to, [-0.5, 0.5]; with Qbb the last column is scaled to [0, m], where m is the largest size of the others.
    """

    def __init__(self, points: np.ndarray, options: Options = Options(), box=None):
        d = points.shape[1]
        low, high = (each.tolist() for each in (bounds(points) if box is None else box))
        self._options = options
        self._largest = [max(-a, b) for a, b in zip(low, high)]
        self._extents = [min(b - a, LARGEST) for a, b in zip(low, high)]
        self._sizes = _core._column_sizes(points, self._largest)
        self._units = [1.0] * d  # how long 1 is where columns are scaled
        self._num_own = d  # columns that are not scaled; they come first
        if options.in_cube:
            self._num_own = 0
            self._units, self._sizes = self._extents, [extent / 2 for extent in self._extents]
        elif options.last_in_box and d > 1:
            self._num_own = d - 1
            self._sizes[-1] = self._extents[-1]
            self._units[-1] = self._extents[-1] / max(*self._sizes[:-1], sys.float_info.min)

    def of_hull(self) -> list[float]:
        """Of a hull: at most the extent of each column."""
        return self._tolerances(self._sizes, [extent or LARGEST for extent in self._extents])

    def of_flats(self) -> list[float]:
        """The rounding of the largest column for all axes: a set within this distance of a flat counts as flat."""
        return self._tolerances(self._shared(math.inf), self._longest_side())

    def of_diagram(self) -> list[float]:
        """Of a diagram, whose distances are Euclidean."""
        return self._tolerances(self._shared(LARGEST_SHARE), self._longest_side())

    def _shared(self, most: float) -> list[float]:
        """The sizes, the largest one for all, but at most so many times their own."""
        own, scaled = self._sizes[:self._num_own], self._sizes[self._num_own:]
        return [min(max(own), most * size) if size else 0.0 for size in own] + scaled

    def _longest_side(self) -> list[float]:
        return [max(self._extents) or LARGEST] * len(self._extents)

    def _tolerances(self, sizes: list[float], most: list[float]) -> list[float]:
        options, d = self._options, len(sizes)
        if options.unmerged:
            return [0.0] * d
        unit = roundoff(d)
        if options.sets_tolerance:
            result = []
            for size, scale, limit in zip(sizes, self._units, most):
                of_distance = unit * size if options.roundoff is None else options.roundoff * scale
                result.append(min(max((2 * d + 1) * of_distance + d * options.centrum * scale, options.width * scale), limit))
        else:
            result = [min((2 * d + 1) * (unit * size), limit) for size, limit in zip(sizes, most)]
        largest = max(result)
        if min(result) > largest * 2.0**-1000 and max(self._largest) < 2.0**20:
            return result  # what follows would not change it
        # Columns of zeros need none of their own. The library scales columns until tolerances are equal: then numbers must be in the
        # range of float64.
        return [max(each or largest, largest * min(max(number * 2.0**-1020, 2.0**-1000), 1)) for each, number in zip(result, self._largest)]


def of_qhull(points: np.ndarray, options: Options = Options()) -> float:
    """The rounding of the largest column, a distance."""
    return max(Rounding(points, options).of_flats())


def of_queries(points: np.ndarray) -> float:
    """A distance within which rounding may have moved points along any axis."""
    return min(Rounding(points).of_diagram())
