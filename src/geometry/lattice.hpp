// SPDX-License-Identifier: BSD-3-Clause
// What a power-of-two grid of coordinates proves about functionals: a value is an integer multiple of the
// grid's unit over a determinant, which the box bounds. So a value that is certainly smaller is exactly zero,
// without an exact predicate. Proofs: docs/predicates.md, "Ties on a grid".
#pragma once

#include "geometry/frame.hpp"
#include "kernel/direct.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace delone::geometry {

/// Lower bounds for finite and infinite cells of points on a grid; 0 where the grid proves nothing.
struct LatticeBounds {
  double numerator = 0;                  ///< |h(q)| of a finite cell times its determinant, if not 0
  double value = 0, infinite_value = 0;  ///< |h(q)|, if not 0
  double determinant = 0, infinite_determinant = 0;  ///< of the edge vectors of a cell

  double least_value(bool infinite) const { return infinite ? infinite_value : value; }
  double least_determinant(bool infinite) const { return infinite ? infinite_determinant : determinant; }
};

/// The part of the bounds that depends on the frame only.
class Lattice {
 public:
  Lattice() = default;
  /// For lifted rows.
  Lattice(const Frame& frame, const std::vector<int>& axes) : lift_scale_(2 * frame.lift_scale_exponent()) {
    for (const int axis : axes) scales_.push_back(frame.scale_exponent(axis));
    const auto k = static_cast<double>(axes.size());
    share_ = 0.99 / std::pow(k + 1, (k + 1) / 2);
    infinite_share_ = 0.99 / std::pow(k, k / 2);
  }
  /// For rows that are not lifted, with these scales.
  explicit Lattice(const std::vector<double>& scales) {
    for (const double scale : scales) scales_.push_back(std::isfinite(scale) ? std::ilogb(scale) : 0);
    const auto n = static_cast<double>(scales.size());
    share_ = 0.99 / std::pow(n, n / 2);
  }

  LatticeBounds bounds(const kernel::Grid& grid, const std::vector<int>& axes) const {
    std::int64_t unit = 0, coarsest = -unlimited;
    for (std::size_t r = 0; r < axes.size(); ++r) {
      const std::int64_t exponent = std::int64_t{grid.exponent(axes[r])} + scales_[r];
      unit += exponent;
      coarsest = std::max(coarsest, exponent);
    }
    const std::int64_t lift = infinite_share_ > 0 ? grid.lift_exponent() + lift_scale_ : 0;
    const double numerator = power_of_two(unit + lift);
    return {numerator, share_ * numerator, infinite_share_ * power_of_two(unit), power_of_two(unit),
            power_of_two(unit - coarsest)};
  }

 private:
  static constexpr std::int64_t unlimited = std::int64_t{1} << 40;

  /// A unit is larger than the box only if all determinants are zero: then any bound holds.
  static double power_of_two(std::int64_t exponent) {
    return kernel::detail::power_of_two(static_cast<int>(std::clamp<std::int64_t>(exponent, -2000, 0)));
  }

  std::vector<int> scales_;  // exponents, per axis of the flat
  int lift_scale_ = 0;
  // One over the largest determinants of simplices in the box (Hadamard's inequality).
  double share_ = 0, infinite_share_ = 0;
};

}  // namespace delone::geometry
