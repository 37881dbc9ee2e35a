// SPDX-License-Identifier: BSD-3-Clause
// The point of the convex hull of a few points that is nearest to a point q, in fractions. Wolfe's algorithm
// (1976, doi:10.1007/BF01580381).
#pragma once

#include "kernel/fractions.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::kernel {

/// The nearest point, exactly.
struct ExactNearest {
  /// The points that it is a combination of with positive weights, increasing. Affinely independent; so they
  /// are the vertices of the smallest face if the m points are affinely independent, too.
  std::vector<int> face;
  std::vector<Integer> numerators;  ///< of the weights of `face`: numerators[i]/denominator, sum 1
  Integer denominator;              ///< positive
  Integer squared;                  ///< the squared distance is squared/denominator·2^(2·grid)
  int grid = 0;

  /// The weight of face[i], rounded to the nearest double.
  double weight(std::size_t i) const { return nearest_double(numerators[i], denominator, 0); }
  /// The sign of (distance − τ). REQUIRES a finite τ ≥ 0.
  Sign compare(double tolerance) const;
  /// The sign of (distance − distance of the other).
  Sign compare(const ExactNearest& other) const;
};

/// As NearestInHull::find(), with integers. `face` is a guess, such as NearestInHull::face(), that saves time
/// if it is right; the nearest point does not depend on it.
ExactNearest nearest_in_hull_exactly(std::span<const double* const> points, const double* q, int dimension,
                                     std::span<const int> face = {});

}  // namespace delone::kernel
