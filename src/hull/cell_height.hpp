// SPDX-License-Identifier: BSD-3-Clause
// Heights over and above the cells of a lower hull: in binary64 with a proven bound on the error, and exactly
// where that does not decide. Points are rows of `width` numbers, a composition and a height; those of a cell
// are `width` ones with affinely independent compositions.
#pragma once

#include "kernel/fractions.hpp"

#include <delone/types.hpp>

#include <span>

namespace delone::hull {

/// The height over the composition of q of the plane through the points of a cell, less that of q; exactly.
class HeightOfPlane {
 public:
  HeightOfPlane(std::span<const double* const> points, const double* q, int width);

  bool exceeds(double x) const { return compare(height_, x) > 0; }  ///< REQUIRES a finite x ≥ 0
  /// The same of its magnitude.
  bool magnitude_exceeds(double x) const;
  double nearest() const;  ///< the nearest double
  double above() const;    ///< the least double that is not below; at least 0

 private:
  int compare(const kernel::Integer& height, double x) const;

  kernel::Integer height_, denominator_;  // the height is height_/denominator_·2^grid_, the latter > 0
  int grid_ = 0;
};

/// Heights of a cell are off by no more than this times the range of those of its vertices.
inline constexpr double largest_height_error = 0x1p-36;

/// The height of a cell over the composition of q, which is in the cell; `on_face` marks the vertices of the
/// smallest face that contains it. Off by no more than largest_height_error times the range of the heights of
/// these, and a rounding; never outside that range.
double height_over_cell(std::span<const double* const> points, std::span<const unsigned char> on_face,
                        const double* q, int width);

/// The height of q above the cell, whose sign is given. 0 if the magnitude is at most the tolerance, which is
/// decided exactly; otherwise off by no more than a relative largest_height_error, or the smallest double,
/// and of that sign. ±infinity beyond the largest double.
double height_above_cell(std::span<const double* const> points, std::span<const unsigned char> on_face,
                         const double* q, int width, Sign sign, double tolerance);

}  // namespace delone::hull
