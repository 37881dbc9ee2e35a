// SPDX-License-Identifier: BSD-3-Clause
// Tiles against the whole: the same cells, the same hash, whatever the cuts.
#include "degenerate.hpp"
#include "scale.hpp"
#include "test_pages.hpp"

#include <delone/delaunay.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace delone_test;

/// The cells of all tiles as sorted rows; also that none is there twice.
std::set<std::vector<std::int64_t>> cells_of(const std::vector<FinishedTile>& tiles) {
  std::set<std::vector<std::int64_t>> cells;
  for (const FinishedTile& tile : tiles) {
    const auto corners = static_cast<std::size_t>(tile.data.affine_dimension + 1);
    for (std::size_t c = 0; c < tile.data.num_cells(); ++c) {
      std::vector<std::int64_t> rows;
      for (std::size_t i = 0; i < corners; ++i)
        rows.push_back(tile.data.rows[static_cast<std::size_t>(tile.data.cells[c * corners + i])]);
      std::sort(rows.begin(), rows.end());
      EXPECT_TRUE(cells.insert(rows).second);
    }
  }
  return cells;
}

std::set<std::vector<std::int64_t>> cells_of(const ComplexData& data) {
  std::set<std::vector<std::int64_t>> cells;
  const auto corners = static_cast<std::size_t>(data.affine_dimension + 1);
  for (std::size_t c = 0; c < data.num_cells(); ++c) {
    std::vector<std::int64_t> rows(data.cells.begin() + static_cast<std::ptrdiff_t>(c * corners),
                                   data.cells.begin() + static_cast<std::ptrdiff_t>((c + 1) * corners));
    std::sort(rows.begin(), rows.end());
    cells.insert(rows);
  }
  return cells;
}

template <class Whole>
void expect_same(const std::vector<FinishedTile>& tiles, const Whole& whole, bool weights_differ) {
  complex::HashAccumulator hash;
  std::int64_t vertices = 0, duplicates = 0, hidden = 0;
  for (const FinishedTile& tile : tiles) {
    hash.add(weights_differ ? tile.weighted_hash : tile.hash);
    vertices += tile.num_vertices;
    duplicates += tile.num_duplicates;
    hidden += tile.num_hidden;
  }
  EXPECT_EQ(cells_of(tiles), cells_of(whole.to_data()));
  EXPECT_EQ(hash.finish(whole.dimension(), whole.affine_dimension()).hex(), whole.hash().hex());
  EXPECT_EQ(vertices, static_cast<std::int64_t>(whole.num_vertices()));
  EXPECT_EQ(duplicates, static_cast<std::int64_t>(whole.num_duplicates()));
  EXPECT_EQ(hidden, static_cast<std::int64_t>(whole.num_hidden()));
}

void compare(const test::PointSet& set, std::size_t num_tiles, const TileOptions& options = {}) {
  SCOPED_TRACE(set.name + " in " + std::to_string(set.dimension) + "D, " + std::to_string(num_tiles) +
               " tiles");
  TestPages pages(set.points, set.dimension, num_tiles);
  expect_same(all_tiles(pages, options), Delaunay<>(set.points, set.dimension), false);
}

/// In a small run, that of the largest engine which is compiled for one dimension.
int largest_dimension(int usual) {
  return static_cast<int>(test::scaled_size(static_cast<std::size_t>(usual), 3));
}

TEST(TileTriangulation, Uniform) {
  const std::size_t n = test::scaled_size(300, 80);
  for (int d = 1; d <= largest_dimension(5); ++d)
    for (const std::size_t tiles : {1, 2, 3, 8, 20})
      compare(test::PointSet{"uniform", d, make_point_set("uniform", d, d < 5 ? n : 120, 7)}, tiles);
}

TEST(TileTriangulation, Degenerate) {
  for (int d = 1; d <= largest_dimension(4); ++d)
    for (const test::PointSet& set : test::degenerate_sets(d, d < 4 ? test::scaled_size(50, 20) : 30, 5))
      for (const std::size_t tiles : {d < 4 ? 2 : 3, 13}) compare(set, tiles);
}

TEST(TileTriangulation, AllPointsTried) {
  TileOptions options;
  options.try_all_points = true;
  for (int d = 1; d <= largest_dimension(4); ++d)
    for (const test::PointSet& set : test::degenerate_sets(d, test::scaled_size(40, 16), 6))
      compare(set, 5, options);
}

/// Not only the same cells, but the same arrays.
TEST(TileTriangulation, Threads) {
  TileOptions options;
  options.threads = 3;
  for (const std::size_t n : {std::size_t{5000}, test::scaled_size(30000, 9000)}) {
    SCOPED_TRACE(n);
    TestPages pages(make_point_set("uniform", 3, n, 1), 3, 3);
    const std::vector<FinishedTile> by_one = all_tiles(pages), by_three = all_tiles(pages, options);
    for (std::size_t t = 0; t < by_one.size(); ++t) {
      EXPECT_EQ(by_one[t].data.rows, by_three[t].data.rows);
      EXPECT_EQ(by_one[t].data.cells, by_three[t].data.cells);
      EXPECT_EQ(by_one[t].data.neighbors, by_three[t].data.neighbors);
    }
  }
}

TEST(TileTriangulation, Clusters) {
  for (const std::string kind : {"plummer", "clusters", "sphere", "manifold", "moment"})
    for (int d = 2; d <= largest_dimension(4); ++d)
      for (const std::size_t tiles : {2, 7})
        compare(test::PointSet{kind, d, make_point_set(kind, d, test::scaled_size(150, 50), 3)}, tiles);
}

TEST(TileTriangulation, Weights) {
  for (int d = 1; d <= largest_dimension(4); ++d)
    for (const double spread : {0.0, 1e-3, 0.05, 1.0, 100.0})
      for (const std::size_t num_tiles : {1, 2, 6, 15}) {
        SCOPED_TRACE(std::to_string(d) + "D, weights up to " + std::to_string(spread) + ", " +
                     std::to_string(num_tiles) + " tiles");
        const std::vector<double> points = make_point_set("uniform", d, test::scaled_size(150, 50), 11);
        std::vector<double> rows, weights;
        test::Random random(3);
        for (std::size_t row = 0; row < points.size() / static_cast<std::size_t>(d); ++row) {
          rows.insert(rows.end(),
                      points.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(d)),
                      points.begin() + static_cast<std::ptrdiff_t>((row + 1) * static_cast<std::size_t>(d)));
          weights.push_back(spread * random.real());
          rows.push_back(weights.back());
        }
        TestPages pages(rows, d, num_tiles, true);
        TileOptions options;
        options.try_all_points = num_tiles == 6;
        expect_same(all_tiles(pages, options), Regular<>(points, weights, d), spread > 0);
      }
}

}  // namespace
