// SPDX-License-Identifier: BSD-3-Clause
// Certified upper bounds of distances. A tolerance that is an operation on an exact result compares these
// with it, so what it claims to be within the tolerance is.
//
// Let the coordinates of all points be off by at most a relative `slack`: 0 for input, the unit roundoff u
// for correctly rounded results. For any doubles a_1 … a_m, the point y = p_0 + Σ a_i·(p_i − p_0) is in the
// flat of the p_i, so |x − y| is an upper bound of the distance of x from it, however the a_i were found. One
// coordinate of x − y, computed from rounded differences, has m + 1 terms, each with two roundings, and m
// sums: it is off by at most (m + 3)·u·S·1.01 with S = |x − p_0| + Σ|a_i|·|p_i − p_0|, by
// slack·(|x| + |p_0| + Σ|a_i|·(|p_i| + |p_0|)), and by 2·(m + 1 + Σ|a_i|) times the smallest double where
// products underflow or coordinates were rounded to multiples of it. The length of d such numbers, computed
// with a relative error of at most (d/2 + 2)·u (base/length.hpp), is below the computed one times 1 + 4·d·u,
// plus the smallest double below the normal numbers. Overflow gives infinity, which is not within any
// tolerance: callers ask `bound <= tolerance`.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace delone::kernel {

/// At least |x − y|, for points of d coordinates off by a relative `slack`.
double distance_bound(const double* x, const double* y, std::size_t d, double slack);

/// The flat through some points.
class FlatDistance {
 public:
  /// The flat through `points`, at least one, of d coordinates off by a relative `slack`. They need not be
  /// affinely independent. The points must stay valid.
  void set_flat(std::span<const double* const> points, std::size_t d, double slack);
  /// At least the distance of x from the flat: larger by rounding errors only.
  double bound(const double* x) { return bound_with(x, false); }
  /// The same of the segment between two points. REQUIRES a flat through two points.
  double segment_bound(const double* x) { return bound_with(x, true); }

 private:
  double bound_with(const double* x, bool is_segment);

  std::vector<const double*> points_;
  std::size_t d_ = 0;
  double slack_ = 0, scale_ = 1;
  std::vector<double> basis_;         // orthonormal, m×d
  std::vector<double> combinations_;  // m×m: basis vectors as sums of the edges p_i − p_0
  std::vector<double> factors_, rest_;
};

}  // namespace delone::kernel
