# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the report, quoted as printed, and those of its theory."""
import math

MACHINE = "2.6 GHz Intel Core 2 Duo, 6 MB of cache, 4 GB of memory, Mac OS X 10.5.4, GCC 4.3.2"

# Table 1: dimension -> (k, alpha) of seconds(n) = k n^alpha, n from 1 000 to 1 024 000
FIT = {2: (78e-7, 1.0011), 3: (53e-6, 1.011), 4: (37e-5, 1.0443), 5: (24e-4, 1.1059), 6: (99e-4, 1.2360)}

# Section 5.1: simplices adjacent to a vertex, on average
CELLS_AT_A_VERTEX = {2: "6", 3: "27", 4: "≈ 157", 5: "> 1050", 6: "> 7200"}

# Section 5.3: how many times slower than the specialised triangulations of CGAL
SLOWER_THAN_SPECIALISED = {2: 1.86, 3: 1.4}


def seconds(dimension, points):
    """The time that the fit of the report gives."""
    k, alpha = FIT[dimension]
    return k * points ** alpha


def cells_at_a_vertex(dimension):
    """The expected number of Delaunay cells at a vertex for uniform points of an unbounded space: 6, 27.07, 158.9, …

    It is the number of vertices of a typical cell of the Poisson-Voronoi diagram (R. E. Miles, "Poisson flats in Euclidean spaces",
    1969; J. Møller, "Random tessellations in R^d", doi:10.2307/1427197). For d = 4 it is the constant 158.9 which the report
    quotes from R. A. Dwyer, doi:10.1007/BF02574694.
    """
    d = dimension
    logarithm = ((d + 1) * math.log(2) + (d - 1) / 2 * math.log(math.pi) - 2 * math.log(d)
                 + math.lgamma((d * d + 1) / 2) - math.lgamma(d * d / 2) + d * (math.lgamma(1 + d / 2) - math.lgamma((d + 1) / 2)))
    return math.exp(logarithm)
