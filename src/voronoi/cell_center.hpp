// SPDX-License-Identifier: BSD-3-Clause
// Centres of circumspheres and power spheres, correctly rounded: first in pairs of doubles with a certified
// error bound, and where that does not settle the rounding, in integers. Correct rounding makes the result a
// function of the sphere: cells of one sphere have bitwise equal centres, so only cells with equal centres
// need an exact comparison.
#pragma once

#include "voronoi/cell_center_kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::internal {

class CenterFinder {
 public:
  /// For cells of dimension axes.size() in R^dimension. `aligned`: all points agree in the coordinates that
  /// are not in `axes` (always so in full dimension); other flats are left to integer arithmetic.
  CenterFinder(int dimension, std::vector<int> axes, bool aligned);

  /// The point of the flat with equal power |x − p|² − w to all k+1 points, each coordinate the nearest
  /// double (see nearest_double). `weights`: k+1, or null for 0. REQUIRES affinely independent points.
  void find(const double* const* points, const double* weights, double* center);

  /// find() for `count` ≤ `block` cells, k+1 points and weights each; centres one after the other. Cells of
  /// full dimension are treated several at a time in 2 to 5 dimensions.
  static constexpr std::size_t block = center_block;
  void find_block(std::size_t count, const double* const* points, const double* weights, double* centers);

  /// Whether q (in the flat) has the same power as the points with respect to their common power sphere,
  /// exactly.
  bool on_sphere(const double* const* points, const double* weights, const double* q,
                 double weight_of_q) const;

  /// How many centres took integer arithmetic so far.
  std::uint64_t num_exact() const { return num_exact_; }

 private:
  using Certified = bool (CenterFinder::*)(const double* const*, const double*, double*) const;

  template <int N>
  bool find_certified(const double* const* points, const double* weights, double* center) const;
  void find_exactly(const double* const* points, const double* weights, double* center) const;

  int dimension_;
  std::vector<int> axes_;
  Certified certified_ = nullptr;  // none for tilted flats
  std::uint64_t num_exact_ = 0;
};

/// The unit vector orthogonal to the flat through `facet` (k points), in the flat that `behind` spans with
/// it, and pointing away from `behind`. Gram–Schmidt; in integers where that cancels more than a few bits.
/// Rounded, relative error below 10⁻¹².
std::vector<double> outward_direction(const std::vector<const double*>& facet, const double* behind,
                                      std::size_t dimension);

}  // namespace delone::internal
