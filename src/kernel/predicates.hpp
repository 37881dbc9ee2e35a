// SPDX-License-Identifier: BSD-3-Clause
// The exact predicates for callers outside the engine: the dimension is chosen at run time, and nothing is
// cached.
#pragma once

#include "kernel/flat.hpp"

#include <delone/types.hpp>

#include <span>
#include <vector>

namespace delone::kernel {

/// The sign of det(p_1 − p_0, …, p_k − p_0) on the axes of the flat; k+1 points.
Sign orientation(const Flat& flat, std::span<const double* const> points);

/// − inside, 0 on, + outside the sphere through k+1 points of the given (non-zero) orientation; q in the
/// flat. Weighted points: the sphere orthogonal to them.
Sign in_sphere(const Flat& flat, std::span<const double* const> points, Sign orientation_of_points,
               const double* q);

/// The same with ties perturbed: 0 only if q equals one of the points, in coordinates and weight.
Sign in_sphere_perturbed(const Flat& flat, std::span<const double* const> points, Sign orientation_of_points,
                         const double* q);

/// The sign of the determinant of k+1 homogeneous rows on the axes of the flat.
Sign homogeneous_orientation(const Flat& flat, std::span<const double* const> rows);

/// + if q is on the side of the hyperplane of a facet (k rows) that `inner` is on, 0 on it, − beyond; `inner`
/// not on it.
Sign hull_side(const Flat& flat, std::span<const double* const> facet, const double* inner, const double* q);

/// The same with ties perturbed: 0 only if q equals a row of the facet.
Sign hull_side_perturbed(const Flat& flat, std::span<const double* const> facet, const double* inner,
                         const double* q);

/// The affine hull of a growing set of points, by exact rank computation: an affinely independent subset (the
/// basis, copied) and coordinate axes on which the hull projects one-to-one.
class AffineHull {
 public:
  explicit AffineHull(int ambient) : ambient_(ambient) {}

  /// Adds p to the basis and returns true if p is not in the hull.
  bool add(const double* p);
  bool contains(const double* p) const { return !basis_.empty() && separating_axis(p) < 0; }
  /// −1 for no point.
  int dimension() const { return static_cast<int>(basis_.size()) / ambient_ - 1; }
  const std::vector<int>& axes() const { return axes_; }  ///< increasing
  /// The basis; valid until the next add().
  std::vector<const double*> basis() const;
  Flat flat() const { return {ambient_, axes_}; }

 private:
  /// An axis that, with the present ones, tells p from the hull; −1 if there is none.
  int separating_axis(const double* p) const;

  int ambient_;
  std::vector<int> axes_;
  std::vector<double> basis_;  // coordinates, one point after the other
};

}  // namespace delone::kernel
