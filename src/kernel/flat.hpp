// SPDX-License-Identifier: BSD-3-Clause
// Which numbers a predicate reads: what the rows of the input mean, and which of their entries enter a
// determinant.
#pragma once

#include <span>

namespace delone::kernel {

/// What a row of doubles stands for.
enum class RowForm {
  point,           ///< x: `ambient` coordinates; its homogeneous row is (x, 1)
  weighted_point,  ///< x, w: a weight follows the coordinates; lifted to |x|² − w
  furthest_point,  ///< x, lifted to −|x|²: the spheres of lower hulls have all other points inside
  homogeneous,     ///< `ambient` entries; positive multiples are the same ray, the zero row is none
};

/// Points of R^ambient whose affine hull projects one-to-one on the coordinate axes `axes` (k of them,
/// increasing). Orientations are taken after that projection; squared lengths |x|² use all `ambient`
/// coordinates, so that spheres are those of the flat. In full dimension `axes` is 0 … ambient−1. Homogeneous
/// rows: their linear hull, of dimension k+1, projects one-to-one on k+1 entries `axes`.
struct Flat {
  int ambient = 0;
  std::span<const int> axes;
  RowForm form = RowForm::point;

  /// k
  int dimension() const { return static_cast<int>(axes.size()) - (form == RowForm::homogeneous ? 1 : 0); }
  bool weighted() const { return form == RowForm::weighted_point; }
  bool furthest() const { return form == RowForm::furthest_point; }
  /// How many doubles a row has.
  int row_size() const { return ambient + (weighted() ? 1 : 0); }
};

}  // namespace delone::kernel
