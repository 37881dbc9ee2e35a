// SPDX-License-Identifier: BSD-3-Clause
// Lengths of vectors, over the whole range of double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace delone::internal {

/// The length of the vector of R^d with the given components, without overflow or underflow on the way;
/// infinity if one is not finite. Relative error: at most (d/2 + 2)·u, if the length is not below the normal
/// numbers; there it is rounded to a multiple of the smallest double. Components are scaled by a power of
/// two, so that the largest is in [1, 2); what underflows then is far below the last bit of the sum of
/// squares. That sum has a relative error of d·u; the root halves it and adds u.
template <class Component>
double length_of(std::size_t d, Component component) {
  double largest = 0;
  for (std::size_t j = 0; j < d; ++j) {
    const double x = std::abs(component(j));
    if (!std::isfinite(x)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, x);
  }
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest);
  double square = 0;
  for (std::size_t j = 0; j < d; ++j) {
    const double x = std::ldexp(component(j), -exponent);
    square += x * x;
  }
  return std::ldexp(std::sqrt(square), exponent);
}

}  // namespace delone::internal
