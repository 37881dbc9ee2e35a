// SPDX-License-Identifier: BSD-3-Clause
// Where all points of a periodic set are: their ranges in orthonormal directions, of which the first ones
// span the lattice, and the points that a frame is made of.
#pragma once

#include "periodic/periodic_set.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace delone::periodic {

class Extent {
 public:
  /// A point of the frame.
  struct Extreme {
    std::int64_t row = -1;
    std::vector<double> point;  ///< its weight included
  };

  /// Of no points. REQUIRES that the set outlives the object; it needs no rows.
  explicit Extent(const PeriodicSet& set);
  /// A point in the box, and its row.
  void add(const double* point, std::int64_t row);

  /// Some of the points, one after the other with their weights: an extent of these has the same ranges, and
  /// the same points in its frame but for rows and weights of equal positions, which depend on what was added
  /// first. So an extent of the witnesses of several extents is that of all their points.
  std::vector<double> witnesses() const;
  /// The points of the frame, and others without a row, to settle rows and weights of equal positions.
  std::span<Extreme> frame_points() { return extremes_; }

  double largest_weight() const { return largest_weight_; }
  /// A bound of |w| of all points.
  double weight_range() const { return weight_range_; }
  /// What fractions of points of the set are off by at most.
  double fraction_slack(std::size_t i) const { return fraction_slack_[i]; }
  /// Fraction i of an image in a ball, as it is computed, lies between these.
  struct Range {
    double low, high;
  };
  Range fractions_in_ball(std::size_t i, const double* center, double radius) const {
    const double middle = set_.period.fraction(i, center),
                 width = radius * set_.period.gradient_length(i) * (1 + 0x1p-40) +
                         set_.period.fraction_slack(i, center) + 2 * fraction_slack(i);
    return {middle - width, middle + width};
  }

  /// Orthonormal directions that span the lattice, nearly: direction i that of a_0 … a_i, and zero where they
  /// are too flat for it. And the range of the points of the set along each.
  const double* lattice_direction(std::size_t i) const { return basis_.data() + i * set_.dimension; }
  double lattice_low(std::size_t i) const { return low_[i]; }
  double lattice_high(std::size_t i) const { return high_[i]; }

  /// Orthonormal directions that are orthogonal to the lattice, nearly, and the range of the points of the
  /// set along each, or a little more.
  std::size_t num_free_directions() const { return set_.dimension - set_.rank; }
  const double* free_direction(std::size_t i) const { return lattice_direction(set_.rank + i); }
  double low(std::size_t i) const { return low_[set_.rank + i] - margin_; }
  double high(std::size_t i) const { return high_[set_.rank + i] + margin_; }

  /// A point in the middle of the box, with weights a heaviest one, and the extreme ones in free directions:
  /// each row once, increasing. The frame of the one in the middle also surrounds the images that are found
  /// later. An image outside of the box of all earlier ones would be expensive, as all functionals are
  /// computed anew for it. And the hull does not change in a time step.
  std::vector<Extreme> extremes() const;
  /// Σ ±a_i, or in high dimensions ±a_i: images of the extreme points by these have every point of the set in
  /// the interior of the convex hull of all that is along the lattice.
  std::vector<std::vector<std::int32_t>> frame_shifts() const;

 private:
  void take(Extreme& extreme, bool is_beyond, const double* point, std::int64_t row) const;

  const PeriodicSet& set_;
  double largest_weight_ = 0, weight_range_ = 0, margin_ = 0;
  double least_off_ = std::numeric_limits<double>::infinity();  // from the middle, in fractions
  std::vector<double> fraction_slack_;
  std::vector<double> basis_, low_, high_;  // d directions
  std::vector<Extreme> extremes_;           // middle, heaviest, and two for each free direction
  std::vector<Extreme> others_;             // lightest, and two for each direction of the lattice
};

}  // namespace delone::periodic
