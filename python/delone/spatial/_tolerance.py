# SPDX-License-Identifier: BSD-3-Clause
"""The tolerance of hulls and diagrams that are made like those of Qhull: the width of its facets."""
from __future__ import annotations

import math
import sys

import numpy as np

from ._geometry import bounds
from ._options import Options

EPSILON = sys.float_info.epsilon


def of_qhull(points: np.ndarray, options: Options = Options(), box=None) -> float:
    """The distance within which Qhull merges facets, for points (n, d), their bounds if these are known, and its options.

    Its ``_one-merge``: (2d + 1) R + d C, with the round-off of a distance R = ε (1.01 d min(√d m, s) + m), where ε = 2⁻⁵²,
    m = max |x_ij| and s = Σ_j max_i |x_ij|; C is 0, or given by option Cn or C-n. Option En gives R, and Wn a lower bound of the
    result. For the unit cube in 3 dimensions 1e-14. At most the longest side of the bounding box. 0 with option Q0 or QJ, which
    merge nothing.

    See qh_distround and qh_detroundoff in Qhull, C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The quickhull algorithm for convex
    hulls, doi:10.1145/235815.235821.
    """
    if options.unmerged:
        return 0.0
    d = points.shape[1]
    low, high = bounds(points) if box is None else box
    low, high = low.tolist(), high.tolist()
    units = [EPSILON * max(-a, b) for a, b in zip(low, high)]
    m, s = max(units), sum(units)
    roundoff = 1.01 * d * min(math.sqrt(d) * m, s) + m if options.roundoff is None else options.roundoff
    tolerance = max((2 * d + 1) * roundoff + d * options.centrum, options.width)
    return min(tolerance, max(b - a for a, b in zip(low, high)), sys.float_info.max)
