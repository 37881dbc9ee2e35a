// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/tile_plan.hpp"

#include "forecast/model/tiles_share.hpp"
#include "pages/page_tree.hpp"
#include "tiles/memory_pages.hpp"
#include "tiles/tile_triangulation.hpp"

#include <delone/delaunay.hpp>
#include <delone/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace delone::tiles {

namespace {

/// A part of the sample that is triangulated in some tenths of a second.
std::span<const double> some_of(std::span<const double> sample, int dimension, int k) {
  constexpr std::array<std::size_t, 9> sizes{1, 20000, 50000, 30000, 10000, 2000, 500, 120, 60};
  const auto place = static_cast<std::size_t>(std::max(k, 0)), d = static_cast<std::size_t>(dimension);
  const std::size_t some = place < sizes.size() ? sizes[place] : 40;
  return sample.first(std::min(sample.size() / d, some) * d);
}

constexpr std::size_t tiles_of_sample = 8;

/// Foreign points divided by own ones, of two of eight tiles.
double measure_share(std::span<const double> points, int dimension) {
  const MemoryPages pages(points, dimension, tiles_of_sample);
  const PageTree tree(pages.table());
  std::size_t foreign = 0, own = 0;
  for (const std::size_t t : {std::size_t{0}, pages.table().tiles.size() / 2}) {
    TilePoints some = pages.points(t);
    own += some.rows.size();
    TileTriangulation tile(pages.survey(), tree, pages.source(), t, std::move(some), {});
    while (tile.advance()) {
    }
    foreign += tile.num_foreign();
  }
  return static_cast<double>(foreign) / static_cast<double>(std::max<std::size_t>(own, 1));
}

}  // namespace

double cells_per_point(std::span<const double> sample, const Survey& survey) {
  const Delaunay<> t(some_of(sample, survey.dimension, survey.affine_dimension), survey.dimension);
  if (t.num_vertices() == 0) return 1;
  return static_cast<double>(t.num_all_cells()) / static_cast<double>(t.num_vertices());
}

double ForeignShare::of(double n, std::size_t num_tiles, int r) const {
  if ((num_tiles <= 1 && r == 0) || dimension < 1) return 0;
  const auto tiles = static_cast<double>(num_tiles);
  // In a periodic set translates are beyond the sides of the box, which are those of some of the tiles.
  const double faces = (num_tiles > 1 ? cost_model::inner_faces(dimension, tiles) : 0.0) +
                       2 * r * std::pow(tiles, -1.0 / dimension);
  // A tile has no more foreign points than there are, counting translates in the boxes next to that of the
  // lattice.
  return std::min(share * faces * std::pow(n / points, -exponent), tiles * std::pow(3.0, r) - 1);
}

ForeignShare ForeignShare::of_uniform_points(int dimension) {
  return {cost_model::foreign_per_face(dimension), 1, dimension > 0 ? 1.0 / dimension : 0, dimension};
}

ForeignShare ForeignShare::of_sample(std::span<const double> sample, int dimension) {
  const int k = affine_dimension(some_of(sample, dimension, dimension), dimension);
  const std::span<const double> large = some_of(sample, dimension, k);
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t n = large.size() / d;
  if (k < 1 || n < 2 * tiles_of_sample * tiles_of_sample) return of_uniform_points(k);
  const double of_large = measure_share(large, dimension),
               of_small = measure_share(large.first(n / 8 * d), dimension),
               faces = cost_model::inner_faces(k, tiles_of_sample);
  const double exponent =
      of_large > 0 ? std::clamp(std::log2(of_small / of_large) / 3, 0.0, 1.5 / k) : 1.0 / k;
  return {of_large / faces, static_cast<double>(n) / tiles_of_sample, exponent, k};
}

double expected_tile_bytes(int d, int k, double n, double cells_of_point) {
  // A cell: ids of vertices and neighbors, a functional, marks; in the part its vertices and neighbors again,
  // its number and its slot. A tenth more, as arrays grow ahead of need.
  const double cell = 1.1 * (8 * (k + 1) + 8 * (k + 2) + 4) + 8 * (k + 1) + 8;
  // A point: coordinates here and in the part, rows, vertices of rows, tags, order of insertion.
  const double point = 16 * (d + 1) + 96;
  return n * (cells_of_point * cell + point);
}

TilesForecast plan_tiles(const Survey& survey, const SetModel& model, const TilesOptions& options,
                         std::uint64_t memory) {
  TilesForecast forecast;
  forecast.num_points = static_cast<std::int64_t>(survey.num_points);
  forecast.cells_per_point = model.cells_per_point;
  const int k = survey.affine_dimension, d = survey.dimension;
  const auto n = static_cast<double>(std::max<std::uint64_t>(survey.num_points, 1));
  const auto evaluate = [&](std::size_t tiles) {
    forecast.num_tiles = tiles;
    const double own = n / static_cast<double>(tiles);
    forecast.foreign_share = model.foreign.of(own, tiles, options.lattice.rank());
    forecast.bytes_per_tile = static_cast<std::uint64_t>(
        expected_tile_bytes(d, k, own * (1 + forecast.foreign_share), model.cells_per_point));
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
