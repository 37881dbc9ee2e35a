// SPDX-License-Identifier: BSD-3-Clause
// A quick test whether a convex body is certainly wider than a tolerance, which most are.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace delone::kernel {

class WidthTest {
 public:
  /// Whether the hull of the points, d coordinates each that are correctly rounded or exact, contains m + 1
  /// of them whose simplex is wider than the tolerance: no two parallel hyperplanes of its m-flat at that
  /// distance have it between them. False for what is not so clear. REQUIRES m ≥ 1.
  bool is_wide(std::span<const double* const> points, std::size_t m, std::size_t d, double tolerance);

 private:
  std::vector<double> rests_, direction_;
};

}  // namespace delone::kernel
