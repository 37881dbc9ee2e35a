# SPDX-License-Identifier: BSD-3-Clause
"""The cases. A case is one input and the programs that run on it in turn. The cases of a series have growing sizes, so that a program
that has become too slow or too large is not tried on the next one."""
import dataclasses

from . import estimates


@dataclasses.dataclass(frozen=True)
class Case:
    experiment: str
    kind: str
    dimension: int
    points: int
    programs: tuple

    def key(self):
        return f"{self.experiment} {self.kind} {self.dimension} {self.points}"

    def series(self):
        return self.experiment, self.kind, self.dimension


GENERAL = ("delone", "cgal_d", "qhull", "clarkson")
SPECIALISED = {2: ("cgal_2", "triangle", "delaunator", "geogram"), 3: ("cgal_3", "cgal_3_parallel", "hxt", "geogram", "tetgen")}
ORDERS = ("delone", "delone:report", "delone:curve", "delone:shuffled")
SMALL = ("delone", "cgal_d", "qhull", "cddlib", "cddlib_gmp", "lrs", "clarkson")
HULLS = ("hull_delone", "hull_qhull", "hull_cgal", "hull_cddlib", "hull_cddlib_gmp", "hull_lrs")
DEGENERATE = ("delone", "cgal_2", "cgal_3", "cgal_3_parallel", "cgal_d", "triangle", "delaunator", "geogram", "hxt", "tetgen", "qhull", "qhull_qt", "scipy",
              "clarkson")
TINY = ("delone", "cddlib", "cddlib_gmp", "lrs")
REAL = (("earthquakes", 3), ("protein", 3), ("cars", 5))

# Weights of the experiments: if time is short, the estimated cost of a case is divided by its weight, and the cheapest come first.
WEIGHT = {"uniform": 6, "degenerate": 4, "tiny": 4, "small": 2, "hulls": 2, "order": 1, "manifold": 1}


def doublings(first, last):
    return [first << k for k in range(40) if first << k <= last]


def full():
    thousand = 1000
    # Up to the first size that does not fit in 16 GiB (BYTES_PER_POINT of estimates.py), whose record says so.
    uniform = {2: doublings(thousand, 1_024_000), 3: doublings(thousand, 1_024_000), 4: doublings(thousand, 1_024_000),
               5: doublings(thousand, 1_024_000), 6: doublings(250, 128_000), 7: doublings(125, 4_000), 8: [60, 120, 250, 500, 1_000]}
    manifold = {2: doublings(thousand, 1_024_000)[::2], 3: doublings(thousand, 1_024_000)[::2], 4: doublings(thousand, 256_000)[::2],
                5: doublings(thousand, 16_000)[::2], 6: doublings(250, 4_000)[::2]}
    order = {2: doublings(thousand, 256_000), 3: doublings(thousand, 256_000), 4: doublings(thousand, 64_000),
             5: doublings(thousand, 16_000), 6: doublings(500, 4_000)}
    small = {2: doublings(125, 4_000), 3: doublings(125, 2_000), 4: doublings(60, 500), 5: doublings(30, 250), 6: doublings(30, 125)}
    hulls = {3: doublings(64, 1_048_576)[::2], 4: doublings(25, 102_400)[::2], 5: [25, 100, 1_000, 20_000], 6: [25, 100, 1_000, 5_000],
             7: [25, 100, 300, 1_000], 8: [20, 40, 100, 200, 500]}
    degenerate = [("grid", 2, 90_000), ("grid", 3, 27_000), ("grid", 4, 10_000), ("grid", 5, 3_125), ("grid", 6, 729),
                  ("tilted_grid", 3, 8_000), ("nudged_grid", 3, 8_000), ("nudged_grid", 4, 4_096),
                  ("cospherical", 2, 500), ("cospherical", 3, 2_000), ("cospherical", 4, 500),
                  ("ulp_sphere", 3, 2_000), ("moment", 4, 400), ("cube01", 6, 64), ("duplicates", 3, 20_000), ("flat", 4, 4_000),
                  ("collinear", 3, 1_000), ("clusters", 4, 10_000), ("offset", 3, 20_000), ("mixed_scales", 3, 1_000)]
    return uniform, manifold, order, small, hulls, degenerate


def quick():
    uniform = {2: [1_000, 8_000, 64_000], 3: [1_000, 8_000, 32_000], 4: [1_000, 2_000, 4_000], 5: [250, 500, 1_000], 6: [125, 250, 500], 7: [125, 250],
               8: [60, 120]}
    manifold = {2: [1_000, 8_000], 3: [1_000, 8_000], 4: [1_000, 4_000], 5: [500, 1_000], 6: [250, 500]}
    order = {2: [1_000, 16_000], 3: [1_000, 16_000], 4: [1_000, 4_000], 5: [500, 1_000], 6: [250, 500]}
    small = {2: [60, 120, 240], 3: [60, 120], 4: [30, 60], 5: [30]}
    hulls = {3: [100, 10_000], 4: [50, 2_000], 5: [25, 500], 6: [25, 200], 7: [25], 8: [20, 50]}
    degenerate = [("grid", 2, 10_000), ("grid", 3, 8_000), ("grid", 4, 1_296), ("grid", 5, 1_024), ("tilted_grid", 3, 1_000), ("nudged_grid", 3, 8_000),
                  ("cospherical", 2, 100), ("cospherical", 3, 200), ("ulp_sphere", 3, 400), ("moment", 4, 60), ("cube01", 5, 32),
                  ("duplicates", 3, 2_000), ("flat", 4, 400), ("collinear", 3, 100), ("offset", 3, 2_000), ("mixed_scales", 3, 100)]
    return uniform, manifold, order, small, hulls, degenerate


# Degenerate inputs for the programs that enumerate facets, for which few points are many.
TINY_INPUTS = [("grid", 2, 25), ("grid", 3, 27), ("grid", 4, 16), ("tilted_grid", 3, 27), ("nudged_grid", 3, 27), ("cospherical", 2, 24),
               ("cospherical", 3, 24), ("ulp_sphere", 3, 24), ("moment", 4, 16), ("duplicates", 3, 30), ("flat", 4, 24), ("collinear", 3, 12),
               ("offset", 3, 30), ("mixed_scales", 3, 24)]


def cases(is_quick):
    """All cases, in the order of the write-up: small ones first in every series."""
    uniform, manifold, order, small, hulls, degenerate = quick() if is_quick else full()
    planned = []
    for d, sizes in uniform.items():
        for k, n in enumerate(sizes):
            scipy = ("scipy",) if is_quick or k % 2 == 0 else ()
            planned.append(Case("uniform", "uniform", d, n, GENERAL + scipy + SPECIALISED.get(d, ())))
    planned += [Case("order", "uniform", d, n, ORDERS) for d, sizes in order.items() for n in sizes]
    planned += [Case("manifold", "manifold", d, n, GENERAL[:3] + SPECIALISED.get(d, ())[:1]) for d, sizes in manifold.items() for n in sizes]
    planned += [Case("small", "uniform", d, n, SMALL) for d, sizes in small.items() for n in sizes]
    planned += [Case("hulls", "sphere", d, n, HULLS) for d, sizes in hulls.items() for n in sizes]
    planned += [Case("degenerate", kind, d, n, DEGENERATE) for kind, d, n in degenerate]
    planned += [Case("degenerate", f"real:{name}", d, 0, DEGENERATE) for name, d in REAL]
    planned += [Case("tiny", kind, d, n, TINY) for kind, d, n in TINY_INPUTS]
    return planned


def by_importance(planned, limits):
    """The cases in the order of measurement, so that a run without enough time leaves out few: the cheapest first, relative to
    the weights of their experiments. Sizes of a series stay in order."""
    largest, keys = {}, {}
    for case in planned:
        cost = estimates.case_seconds(case, limits) / WEIGHT[case.experiment]
        keys[case] = largest[case.series()] = max(cost, largest.get(case.series(), 0.0))
    return sorted(planned, key=keys.__getitem__)
