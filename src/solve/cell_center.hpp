// SPDX-License-Identifier: BSD-3-Clause
// Centers of circumspheres and power spheres, correctly rounded: first in pairs of doubles with a certified
// error bound, and in integers where that does not settle the rounding. Correct rounding makes the center a
// function of the sphere. Cells with a common sphere have bitwise equal centers, so only cells with equal
// centers need an exact comparison.
#pragma once

#include "kernel/fractions.hpp"
#include "solve/center_kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::solve {

class CenterFinder {
 public:
  /// For cells of dimension axes.size() in R^dimension. `aligned`: all points agree in the coordinates that
  /// are not in `axes`, as is always so in full dimension. Other flats use integers only.
  CenterFinder(int dimension, std::vector<int> axes, bool aligned);

  /// The point of the flat with equal power |x − p|² − w to all k+1 points. Each coordinate is the nearest
  /// double (see nearest_double). `weights`: k+1 of them, or null for zero weights. REQUIRES affinely
  /// independent points.
  void find(const double* const* points, const double* weights, double* center);

  /// find() for `count` ≤ `block` cells, with k+1 points and weights per cell; writes one center after the
  /// other. In 2 to 5 dimensions, cells of full dimension share SIMD instructions.
  static constexpr std::size_t block = center_block;
  void find_block(std::size_t count, const double* const* points, const double* weights, double* centers);

  /// The center of the points less the first of them. Coordinate j is off by at most 5/4 of a unit roundoff
  /// of its own magnitude, and 1/4 of one of the extent of the cell along axis j from its first point.
  /// Infinite beyond the range of doubles. REQUIRES as find().
  void find_offset(const double* const* points, double* offset) const;

  /// Twice the same, without error, in units of 2^grid.
  struct ExactOffset {
    kernel::Fractions twice;
    int grid;
  };
  ExactOffset find_offset_exactly(const double* const* points) const;

  /// Whether q, a point of the flat, has the same power as the points with respect to their power sphere.
  /// Exact.
  bool on_sphere(const double* const* points, const double* weights, const double* q,
                 double weight_of_q) const;

  /// The number of centers that needed integers so far.
  std::uint64_t num_exact() const { return num_exact_; }

 private:
  bool is_center_of_box(const double* const* points, const double* weights, double* center) const;
  void find_exactly(const double* const* points, const double* weights, double* center) const;

  std::size_t dimension_;
  std::vector<int> axes_;
  bool aligned_;
  std::uint64_t num_exact_ = 0;
};

}  // namespace delone::solve
