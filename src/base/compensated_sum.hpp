// SPDX-License-Identifier: BSD-3-Clause
// A sum that is corrected at the end by the rounding errors of all additions (Neumaier 1974,
// doi:10.1002/zamm.19740540106).
#pragma once

#include <cmath>

namespace delone::internal {

class CompensatedSum {
 public:
  void add(double x) {
    const double next = sum_ + x;
    // Beyond the range of doubles there is nothing to compensate, and inf − inf would give NaN.
    if (std::isfinite(next))
      compensation_ += std::abs(sum_) >= std::abs(x) ? (sum_ - next) + x : (x - next) + sum_;
    sum_ = next;
  }
  /// Adds all that was added to another sum.
  void add(const CompensatedSum& other) {
    add(other.sum_);
    add(other.compensation_);
  }
  double value() const { return sum_ + compensation_; }

 private:
  double sum_ = 0, compensation_ = 0;
};

}  // namespace delone::internal
