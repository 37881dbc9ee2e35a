// SPDX-License-Identifier: BSD-3-Clause
// One tolerance for all axes, or one per axis.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace delone::internal {

/// Powers of two, one per axis, and a tolerance ε of what is multiplied by them. Points whose distance is at
/// most ε after that differ along axis j by at most tolerances()[j], which is at most what was wanted there.
///
/// Factors are powers of two so that products are exact, and at least 1 so that none underflows. They make
/// the wanted tolerances equal but for a factor below 2; ε is the least of them.
class AxisScale {
 public:
  /// No tolerance.
  AxisScale() = default;
  explicit AxisScale(double tolerance) : tolerance_(tolerance) {}
  /// The tolerance, or, unless that is empty, one for each axis in its place. Throws Errc::invalid_argument
  /// unless they are finite and at least 0, as many as there are axes, all of them 0 or none, and differ by
  /// factors of at most 2^1000.
  AxisScale(double tolerance, std::span<const double> wanted, int dimension);

  double tolerance() const { return tolerance_; }
  /// Whether all factors are 1.
  bool is_one() const { return factors_.empty(); }
  /// Empty if all are 1.
  std::span<const double> factors() const { return factors_; }
  /// ε divided by the factors: a scale that is made of these is the same. Empty if all factors are 1.
  std::vector<double> tolerances() const;
  /// Rows of numbers, multiplied. REQUIRES factors other than 1.
  std::vector<double> scaled(std::span<const double> rows) const;

 private:
  double tolerance_ = 0;
  std::vector<double> factors_;
};

}  // namespace delone::internal
