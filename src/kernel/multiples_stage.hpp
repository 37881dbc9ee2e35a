// SPDX-License-Identifier: BSD-3-Clause
// Determinants of lattices whose unit is not a power of two: 0.1, say.
#pragma once

#include <delone/types.hpp>

#include <optional>
#include <span>

namespace delone::kernel {

/// The sign of det(p_i − base) over n axes, if the entries of each column are small multiples of the smallest
/// of them: divided by it, which does not change the sign, they are integers, and so are all minors. nullopt
/// if that is not so for a column, if its differences are not doubles, or if there are more than ten columns.
std::optional<Sign> orientation_of_multiples(std::span<const int> axes, const double* const* points,
                                             const double* base);

}  // namespace delone::kernel
