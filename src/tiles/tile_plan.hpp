// SPDX-License-Identifier: BSD-3-Clause
// Into how many tiles a set is cut, and what they will cost: a model whose only unknown, the number of cells
// per point, is measured on a sample.
#pragma once

#include "tiles/survey.hpp"

#include <delone/tiles.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::tiles {

/// Cells per point, finite and infinite, of the triangulation of some of the sample.
double cells_per_point(std::span<const double> sample, const Survey& survey);

/// The points of other tiles that a tile has to insert, divided by its own: share · F · (n /
/// points)^(−exponent) for n points of its own and about F inner faces.
struct ForeignShare {
  double share = 0, points = 1, exponent = 0;
  int dimension = 0;  ///< k

  /// Of a tile of n points, one of `num_tiles`, in a set that is periodic in r directions.
  double of(double n, std::size_t num_tiles, int r = 0) const;
  /// Of uniform points: c_k · F · n^(−1/k).
  static ForeignShare of_uniform_points(int dimension);
  /// Measured on tiles of two parts of the sample, one eight times as large as the other: points on a
  /// hypersurface have more neighbors far away than uniform ones. Some tenths of a second.
  static ForeignShare of_sample(std::span<const double> sample, int dimension);
};

/// What a sample tells of the whole set.
struct SetModel {
  double cells_per_point = 1;
  ForeignShare foreign;
};

/// Memory of one tile at its peak, in bytes: the triangulation of n points, and the arrays of its part.
double expected_tile_bytes(int d, int k, double n, double cells_of_point);

/// As few tiles as fit into `memory` bytes, or as many as options ask for.
TilesForecast plan_tiles(const Survey& survey, const SetModel& model, const TilesOptions& options,
                         std::uint64_t memory);

}  // namespace delone::tiles
