// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/tile_plan.hpp"

#include <delone/delaunay.hpp>
#include <delone/regular.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace delone::tiles {

double cells_per_point(std::span<const double> sample, const Survey& survey) {
  // So many points take some tenths of a second.
  constexpr std::array<std::size_t, 9> sizes{1, 20000, 50000, 30000, 10000, 2000, 500, 120, 60};
  const auto k = static_cast<std::size_t>(std::max(survey.affine_dimension, 0));
  const auto d = static_cast<std::size_t>(survey.dimension);
  const std::size_t some = k < sizes.size() ? sizes[k] : 40;
  const Delaunay<> t(sample.first(std::min(sample.size() / d, some) * d), survey.dimension);
  if (t.num_vertices() == 0) return 1;
  return static_cast<double>(t.num_all_cells()) / static_cast<double>(t.num_vertices());
}

double expected_foreign_share(int k, double n, std::size_t num_tiles) {
  if (num_tiles <= 1 || k < 1) return 0;
  constexpr std::array<double, 7> factors{0, 1, 1.1, 1.3, 1.6, 2.5, 3.5};
  // A tile of a cut by halves along k axes has two inner faces per axis at most, one per halving.
  const double faces = std::min(2.0 * k, std::log2(static_cast<double>(num_tiles)));
  return factors[std::min(static_cast<std::size_t>(k), factors.size() - 1)] * faces * std::pow(n, -1.0 / k);
}

double expected_tile_bytes(int d, int k, double n, double cells_of_point) {
  // A cell: ids of vertices and neighbors, a functional, marks; in the part its vertices and neighbors again,
  // its number and its slot. A tenth more, as arrays grow ahead of need.
  const double cell = 1.1 * (8 * (k + 1) + 8 * (k + 2) + 4) + 8 * (k + 1) + 8;
  // A point: coordinates here and in the part, rows, vertices of rows, tags, order of insertion.
  const double point = 16 * (d + 1) + 96;
  return n * (cells_of_point * cell + point);
}

TilesForecast plan_tiles(const Survey& survey, double cells_of_point, const TilesOptions& options,
                         std::uint64_t memory) {
  TilesForecast forecast;
  forecast.num_points = static_cast<std::int64_t>(survey.num_points);
  forecast.cells_per_point = cells_of_point;
  const int k = survey.affine_dimension, d = survey.dimension;
  const auto n = static_cast<double>(std::max<std::uint64_t>(survey.num_points, 1));
  const auto evaluate = [&](std::size_t tiles) {
    forecast.num_tiles = tiles;
    const double own = n / static_cast<double>(tiles);
    forecast.foreign_share = expected_foreign_share(k, own, tiles);
    forecast.bytes_per_tile = static_cast<std::uint64_t>(
        expected_tile_bytes(d, k, own * (1 + forecast.foreign_share), cells_of_point));
  };
  if (options.tiles > 0) {
    evaluate(options.tiles);
    return forecast;
  }
  // More tiles have more foreign points between them: from some number on it does not help.
  for (std::size_t tiles = 1;; tiles += std::max<std::size_t>(tiles / 16, 1)) {
    evaluate(tiles);
    if (forecast.bytes_per_tile <= memory || n / static_cast<double>(tiles) < 100) return forecast;
  }
}

}  // namespace delone::tiles
