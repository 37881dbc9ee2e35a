// SPDX-License-Identifier: BSD-3-Clause
// The squared radius of the smallest circumscribed sphere of a simplex without weights, in pairs of doubles.
#pragma once

#include "kernel/double_double.hpp"

#include <cstddef>
#include <optional>

namespace delone::internal {

struct SquareInPairs {
  kernel::DoubleDouble value;
  double error;  ///< at most 2⁻⁸⁰ of the value
};

/// Nothing where that is not certain, as of affinely dependent vertices.
std::optional<SquareInPairs> square_in_pairs(const double* const* points, std::size_t corners,
                                             std::size_t dimension);

}  // namespace delone::internal
