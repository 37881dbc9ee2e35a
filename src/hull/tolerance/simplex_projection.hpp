// SPDX-License-Identifier: BSD-3-Clause
// The projection of a point into a simplex of a few dimensions.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace delone::hull {

/// The largest dimension of the space for which there is a projection.
inline constexpr std::size_t most_projected = 4;

/// An upper bound on the distance of q from a point z in the interior of the simplex of d points of R^d, and
/// q − z in `normal`. z is the nearest point up to rounding. Nothing if that is on the border, if the simplex
/// is thin, if numbers are near the ends of the range of binary64, or if d is 1 or larger than
/// most_projected.
std::optional<double> project_into_simplex(std::span<const double* const> points, const double* q,
                                           double* normal);

}  // namespace delone::hull
