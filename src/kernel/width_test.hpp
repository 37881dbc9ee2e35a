// SPDX-License-Identifier: BSD-3-Clause
// A quick test whether a convex body is certainly wider than a tolerance, which most are.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace delone::kernel {

/// The same as WidthTest::is_wide for a triangle in space, in fewer operations.
bool is_wide_triangle(const double* p, const double* q, const double* r, double tolerance);

class WidthTest {
 public:
  /// Whether the hull of the points, d coordinates each that are correctly rounded or exact, contains m + 1
  /// of them whose simplex is wider than the tolerance: no two parallel hyperplanes of its m-flat at that
  /// distance have it between them. False for what is not so clear. REQUIRES m ≥ 1.
  bool is_wide(std::span<const double* const> points, std::size_t m, std::size_t d, double tolerance);

 private:
  /// Compiled for D = d, or for any d if D = 0.
  template <std::size_t D>
  bool is_wide_in(std::span<const double* const> points, std::size_t m, std::size_t d, double tolerance);

  std::vector<double> rests_, direction_;
};

}  // namespace delone::kernel
