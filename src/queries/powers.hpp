// SPDX-License-Identifier: BSD-3-Clause
// The powers of a query with respect to sites, and which of two is less: rounded with a bound, or exactly.
#pragma once

#include "kernel/determinant.hpp"
#include "kernel/exact.hpp"

#include <delone/types.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace delone::queries {

/// Σ (q_j − p_j)² − weight, and the sum of the magnitudes of its terms.
struct Power {
  double value, parts;
};

inline Power power(const double* q, const double* p, std::size_t d, double weight) {
  double sum = 0;
  for (std::size_t j = 0; j < d; ++j) {
    const double difference = q[j] - p[j];
    sum += difference * difference;
  }
  return {sum - weight, sum + std::fabs(weight)};
}

/// Whether the rounded powers prove a < b. A rounded difference is off by a factor within 1 ± u, so its
/// square is off by 1 ± γ(3). The d − 1 sums and the subtraction of the weight add d: γ(d + 3) of the parts
/// each, and one rounding for the difference of the two. Each square may underflow by 2^−1075. Infinities and
/// NaN prove nothing.
inline bool certainly_less(const Power& a, const Power& b, std::size_t d) {
  const double error = 1.01 * static_cast<double>(d + 6) * kernel::unit_roundoff * (a.parts + b.parts) +
                       2 * static_cast<double>(d) * std::numeric_limits<double>::denorm_min();
  return b.value - a.value > error;
}

/// The sign of Σ a_j² − b_j² − 2·a_j·q_j + 2·b_j·q_j − weight_a + weight_b, as one exact sum of products.
inline Sign compare_exactly(const double* q, const double* a, const double* b, std::size_t d, double weight_a,
                            double weight_b) {
  std::vector<double> row, point;
  const auto add = [&](double x, double y) {
    row.push_back(x);
    point.push_back(y);
  };
  for (std::size_t j = 0; j < d; ++j) {
    if (a[j] == b[j]) continue;
    add(a[j], a[j]);
    add(-b[j], b[j]);
    for (int twice = 0; twice < 2; ++twice) {
      add(-a[j], q[j]);
      add(b[j], q[j]);
    }
  }
  add(weight_b, 1);
  const int terms = static_cast<int>(row.size());
  row.push_back(-weight_a);
  return kernel::exact_affine_form(row.data(), point.data(), terms);
}

}  // namespace delone::queries
