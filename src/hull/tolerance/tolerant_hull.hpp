// SPDX-License-Identifier: BSD-3-Clause
// A hull with a tolerance, made from an exact one.
#pragma once

#include "base/axis_scale.hpp"
#include "hull/hull_state.hpp"

#include <memory>

namespace delone::hull {

/// The exact hull of some vertices of a hull, or the hull of their projections if all points are near a flat.
class TolerantHull {
 public:
  /// `exact` must outlive this object and must not change. `scale`: with the tolerance, which is not 0; all
  /// distances are those where axes are scaled. With `shows_progress` the callback of the options is called
  /// with 1, and may cancel.
  TolerantHull(const HullState& exact, const internal::AxisScale& scale, const Options& options,
               bool shows_progress);

  /// For an exact hull that was made of the chosen vertices; no point is farther from it than max_distance.
  TolerantHull(const HullState& of_vertices, double max_distance)
      : exact_(of_vertices), max_distance_(max_distance) {}

  /// The exact one itself if all its vertices are kept, and its cells have no other corners.
  const HullState& state() const { return own_ ? *own_ : exact_; }
  double max_distance() const { return max_distance_; }

 private:
  const HullState& exact_;
  std::unique_ptr<const HullState> own_;
  double max_distance_ = 0;
};

}  // namespace delone::hull
