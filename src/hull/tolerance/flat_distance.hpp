// SPDX-License-Identifier: BSD-3-Clause
// Whether a point is within a tolerance of the flat through some points, exactly.
#pragma once

#include "hull/hull_normal.hpp"

#include <span>
#include <vector>

namespace delone::internal {

/// Whether q is at most `tolerance` away from the flat through affinely independent points of R^dimension,
/// decided with integers. REQUIRES a finite tolerance ≥ 0. For dependent points the answer is false.
///
/// With edges e_i from the first point and t = q − that point, the squared distance is the quotient of the
/// Gram determinants of (e_1, …, e_j, t) and of (e_1, …, e_j).
bool is_near_flat(std::span<const double* const> points, const double* q, int dimension, double tolerance);

/// The same for one flat of dimension k − 1 and many points; decided in binary64 where that is certain.
class NearFlat {
 public:
  /// Of R^dimension. `k`: how many points span the flat.
  NearFlat(int dimension, int k, double tolerance);

  /// REQUIRES k affinely independent points, which outlive the answers.
  void set(std::span<const double* const> points);
  bool contains(const double* q);

 private:
  int dimension_;
  double tolerance_;
  HullNormal<0> normal_;
  std::vector<int> axes_;
  std::vector<const double*> points_;
  bool is_known_ = false;
};

}  // namespace delone::internal
