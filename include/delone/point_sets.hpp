// SPDX-License-Identifier: BSD-3-Clause
// Named point sets for tests, benchmarks and the command's `generate`. Reproducible: the same arguments give
// the same bits.
#pragma once

#include <delone/export.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace delone {

struct PointSetKind {
  std::string_view name;         ///< as used on the command line
  std::string_view description;  ///< one line
};

/// All kinds, in alphabetical order.
DELONE_EXPORT const std::vector<PointSetKind>& point_set_kinds();

/// n points of the named kind in R^d, row-major. Throws Errc::invalid_argument for an unknown kind, d < 1, or
/// a combination that does not exist (flat and spheres of exact points need d ≥ 2; cospherical and ulp_sphere
/// have at most 118098 points for d = 2); too_many or out_of_memory if the points do not fit into memory;
/// cancelled, for random kinds. Only cube01 returns fewer than n points, for n > 2^d. grid and its variants
/// have ⌈n^(1/d)⌉ points per axis, cut to the first n. Exact by construction: flat and collinear lie in a
/// hyperplane and on a line, cospherical on a sphere around the origin, without rounding. sphere and
/// ulp_sphere are rounded and lie only near the unit sphere. Same arguments, same bits on every platform with
/// IEEE arithmetic: random variables are made by rejection with + − × ÷ √, without the distributions of
/// `<random>` and without functions of the mathematics library.
DELONE_EXPORT std::vector<double> make_point_set(std::string_view kind, int dimension, std::size_t n,
                                                 std::uint64_t seed = 0);

}  // namespace delone
