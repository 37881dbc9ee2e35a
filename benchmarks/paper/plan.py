# SPDX-License-Identifier: BSD-3-Clause
"""What is measured. A case is one input and the programs that run on it in turn; cases of one series have growing sizes, so that a
program that has become too slow or too large for the next one is not tried."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Case:
    experiment: str
    kind: str
    dimension: int
    points: int
    programs: tuple


GENERAL = ("delone", "cgal_d", "qhull", "scipy")
SPECIALISED = {2: ("cgal_2",), 3: ("cgal_3", "cgal_3_parallel")}
ORDERS = ("delone", "delone:report", "delone:curve", "delone:shuffled")
SMALL = ("delone", "cgal_d", "qhull", "cddlib", "cddlib_gmp", "lrs", "clarkson")
HULLS = ("hull_delone", "hull_qhull", "hull_cgal", "hull_cddlib", "hull_cddlib_gmp", "hull_lrs")
DEGENERATE = ("delone", "cgal_2", "cgal_3", "cgal_d", "qhull", "qhull_qt", "scipy", "clarkson")


def doublings(first, last):
    return [first << k for k in range(40) if first << k <= last]


def full():
    thousand = 1000
    # The last sizes that fit in 16 GiB: delone needs about 75, 100, 140, 190, 200 and 260 bytes per cell and 6.7, 31, 170 … cells per point.
    uniform = {2: doublings(thousand, 1_024_000), 3: doublings(thousand, 1_024_000), 4: doublings(thousand, 1_024_000),
               5: doublings(thousand, 512_000), 6: doublings(thousand, 64_000), 7: [500, *doublings(thousand, 8_000)],
               8: [250, 500, 1_000, 2_000]}
    manifold = {2: doublings(thousand, 1_024_000), 3: doublings(thousand, 1_024_000), 4: doublings(thousand, 256_000),
                5: doublings(thousand, 64_000), 6: doublings(thousand, 8_000)}
    order = {2: doublings(thousand, 512_000), 3: doublings(thousand, 256_000), 4: doublings(thousand, 64_000),
             5: doublings(thousand, 16_000), 6: doublings(thousand, 4_000)}
    small = {2: doublings(125, 16_000), 3: doublings(125, 8_000), 4: doublings(125, 2_000), 5: doublings(125, 1_000), 6: doublings(125, 500)}
    hulls = {3: doublings(16, 1_048_576)[::4], 4: doublings(25, 102_400)[::4], 5: [25, 100, 1_000, 20_000], 6: [25, 100, 1_000, 5_000],
             7: [25, 100, 1_000], 8: [20, 40, 100, 500]}
    degenerate = [("grid", 2, 250_000), ("grid", 3, 125_000), ("grid", 4, 20_736), ("grid", 5, 7_776), ("grid", 6, 729),
                  ("tilted_grid", 3, 27_000), ("nudged_grid", 3, 27_000), ("nudged_grid", 4, 4_096),
                  ("cospherical", 2, 500), ("cospherical", 3, 2_000), ("cospherical", 4, 500),
                  ("ulp_sphere", 3, 4_000), ("moment", 4, 400), ("cube01", 6, 64), ("duplicates", 3, 20_000), ("flat", 4, 4_000), ("collinear", 3, 1_000),
                  ("clusters", 4, 20_000), ("offset", 3, 20_000), ("mixed_scales", 3, 1_000)]
    return uniform, manifold, order, small, hulls, degenerate


def quick():
    uniform = {2: [1_000, 8_000, 64_000], 3: [1_000, 8_000, 32_000], 4: [1_000, 2_000, 4_000], 5: [250, 500, 1_000], 6: [125, 250, 500], 7: [125, 250], 8: [60, 120]}
    manifold = {2: [1_000, 8_000], 3: [1_000, 8_000], 4: [1_000, 4_000], 5: [500, 1_000], 6: [250, 500]}
    order = {2: [1_000, 16_000], 3: [1_000, 16_000], 4: [1_000, 4_000], 5: [500, 1_000], 6: [250, 500]}
    small = {2: [60, 120, 240], 3: [60, 120], 4: [30, 60], 5: [30]}
    hulls = {3: [100, 10_000], 4: [50, 2_000], 5: [25, 500], 6: [25, 200], 8: [20, 50]}
    degenerate = [("grid", 2, 10_000), ("grid", 3, 8_000), ("grid", 4, 1_296), ("grid", 5, 1_024), ("tilted_grid", 3, 1_000), ("nudged_grid", 3, 8_000),
                  ("cospherical", 2, 100), ("cospherical", 3, 200), ("ulp_sphere", 3, 400), ("moment", 4, 60), ("cube01", 5, 32),
                  ("duplicates", 3, 2_000), ("flat", 4, 400), ("collinear", 3, 100), ("offset", 3, 2_000), ("mixed_scales", 3, 100)]
    return uniform, manifold, order, small, hulls, degenerate


def cases(is_quick):
    """All cases, small and short ones first in every series."""
    uniform, manifold, order, small, hulls, degenerate = quick() if is_quick else full()
    planned = [Case("uniform", "uniform", d, n, GENERAL + SPECIALISED.get(d, ())) for d, sizes in uniform.items() for n in sizes]
    planned += [Case("order", "uniform", d, n, ORDERS) for d, sizes in order.items() for n in sizes]
    planned += [Case("manifold", "manifold", d, n, GENERAL[:3] + SPECIALISED.get(d, ())[:1]) for d, sizes in manifold.items() for n in sizes]
    planned += [Case("small", "uniform", d, n, SMALL) for d, sizes in small.items() for n in sizes]
    planned += [Case("hulls", "sphere", d, n, HULLS) for d, sizes in hulls.items() for n in sizes]
    planned += [Case("degenerate", kind, d, n, DEGENERATE) for kind, d, n in degenerate]
    planned += [Case("degenerate", f"real:{name}", d, 0, DEGENERATE) for name, d in (("earthquakes", 3), ("bunny", 3), ("cars", 5))]
    return planned
