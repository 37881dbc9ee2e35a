// SPDX-License-Identifier: BSD-3-Clause
// The first look at all points: their number, box and affine hull, points that every tile begins with, and a
// sample to cut them by.
#pragma once

#include "tiles/point_stream.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::tiles {

/// What is known of the whole set before the first tile: every tile starts from it.
struct Survey {
  int dimension = 0;
  bool weighted = false;
  std::uint64_t num_points = 0;
  int affine_dimension = -1;
  std::vector<double> low, high;  ///< the box of all points
  double lowest_weight = 0, largest_weight = 0;
  /// k+1 affinely independent points and the extreme ones along each axis: rows of d coordinates and the
  /// weight, and their rows of the input.
  std::vector<double> landmarks;
  std::vector<std::int64_t> landmark_rows;
};

struct SurveyResult {
  Survey survey;
  /// Rows of d coordinates, uniformly at random and without replacement; all rows if there are not more.
  std::vector<double> sample;
};

inline constexpr std::size_t default_sample_size = std::size_t{1} << 17;

/// Reads the stream once, from its beginning. Of equal points the landmarks have the one of largest weight,
/// the first of these. The rest depends on the order of rows only in which points are chosen. O(n·d), and an
/// exact test per point as long as the points do not span R^d. Throws bad_dimension for weights without
/// coordinates.
SurveyResult make_survey(PointStream& points, bool weighted, std::size_t sample_size = default_sample_size,
                         std::uint64_t seed = 0);

}  // namespace delone::tiles
