// SPDX-License-Identifier: BSD-3-Clause
// Points that span a flat well: each is the farthest from the flat of those before.
#pragma once

#include <cstddef>
#include <vector>

namespace delone::hull {

/// Begins with the first point, and grows by the farthest one, of several the first; found in binary64.
class GrowingFlat {
 public:
  /// REQUIRES at least one point.
  GrowingFlat(std::vector<const double*> points, int dimension);

  const std::vector<const double*>& basis() const { return basis_; }
  const double* farthest() const { return points_[farthest_]; }
  /// The farthest point joins the basis.
  void grow();
  /// Axes on which the flat projects well: the pivots of its edges.
  std::vector<int> axes() const;

 private:
  void find_farthest();

  std::vector<const double*> points_;
  std::size_t d_;
  std::vector<const double*> basis_;
  std::vector<double> rests_;  // of each point, what is orthogonal to the flat
  std::size_t farthest_ = 0;
};

}  // namespace delone::hull
