// SPDX-License-Identifier: BSD-3-Clause
// Whether a point is within a tolerance of the flat through some points, exactly.
#pragma once

#include "hull/hull_normal.hpp"
#include "kernel/double_double.hpp"
#include "kernel/minors.hpp"

#include <optional>
#include <span>
#include <vector>

namespace delone::hull {

/// Whether q is at most `tolerance` away from the flat through affinely independent points of R^dimension,
/// decided with integers. REQUIRES a finite tolerance ≥ 0. For dependent points the answer is false.
///
/// With edges e_i from the first point and t = q − that point, the squared distance is the quotient of the
/// Gram determinants of (e_1, …, e_j, t) and of (e_1, …, e_j).
bool is_near_flat(std::span<const double* const> points, const double* q, int dimension, double tolerance);

/// The normal of a hyperplane in arithmetic of twice the precision of binary64, for cells that are so thin
/// that binary64 knows nothing of it. Docs: docs/predicates.md, "Double-double".
class PreciseNormal {
 public:
  /// The hyperplane through d affinely independent points of R^d.
  void set(std::span<const double* const> points, int dimension);
  /// Whether q is within the tolerance of it, if that is certain.
  std::optional<bool> is_near(const double* q, double tolerance) const;

 private:
  std::vector<kernel::DoubleDouble> normal_, minors_;
  std::vector<kernel::Magnitude> parts_;
  std::vector<double> errors_;  // of the entries of the normal
  const double* base_ = nullptr;
  double scale_ = 0;  // of edges and differences: a power of two; 0: nothing is known
  double least_length_ = 0, most_length_ = 0;
};

/// The same for one flat of dimension k − 1 and many points; decided in binary64 where that is certain, or
/// with twice its precision.
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
  PreciseNormal precise_;
  bool is_known_ = false, has_precise_ = false;
};

}  // namespace delone::hull
