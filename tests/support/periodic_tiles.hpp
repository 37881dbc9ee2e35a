// SPDX-License-Identifier: BSD-3-Clause
// A folder of tiles of a periodic set against the triangulation in one piece: the hash, the counts and the
// cells; and check_tiles(). And sets for such tests.
#pragma once

#include "periodic_sets.hpp"

#include <delone/periodic.hpp>
#include <delone/point_sets.hpp>
#include <delone/tiles.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delone::test {

/// Rows of d coordinates, and of weights if there are some.
inline std::vector<double> rows_of(const std::vector<double>& points, const std::vector<double>& weights,
                                   int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<double> rows;
  for (std::size_t i = 0; i * d < points.size(); ++i) {
    rows.insert(rows.end(), points.begin() + static_cast<std::ptrdiff_t>(i * d),
                points.begin() + static_cast<std::ptrdiff_t>((i + 1) * d));
    if (!weights.empty()) rows.push_back(weights[i]);
  }
  return rows;
}

inline TilesOptions options_of_tiles(const Lattice& lattice, std::size_t tiles, bool weighted = false,
                                     unsigned threads = 1) {
  TilesOptions made;
  made.lattice = lattice;
  made.tiles = tiles;
  made.weighted = weighted;
  made.threads = threads;
  made.memory = std::uint64_t{8} << 30;
  return made;
}

/// Of each cell its vertices, a row and offsets, sorted; sorted.
class SortedCells {
 public:
  template <class Rows, class Offsets>
  void add(const Rows& rows, const Offsets& offsets, std::size_t corners, std::size_t r) {
    for (std::size_t c = 0; c * corners < rows.size(); ++c) {
      std::vector<std::vector<std::int64_t>> vertices;
      for (std::size_t i = c * corners; i < (c + 1) * corners; ++i) {
        vertices.push_back({static_cast<std::int64_t>(rows[i])});
        for (std::size_t l = 0; l < r; ++l) vertices.back().push_back(offsets[i * r + l]);
      }
      std::sort(vertices.begin(), vertices.end());
      cells_.emplace_back();
      for (const auto& vertex : vertices)
        cells_.back().insert(cells_.back().end(), vertex.begin(), vertex.end());
    }
  }
  std::vector<std::vector<std::int64_t>> sorted() {
    std::sort(cells_.begin(), cells_.end());
    return std::move(cells_);
  }

 private:
  std::vector<std::vector<std::int64_t>> cells_;
};

/// `index`: what make_tiles() has returned for the folder `out`.
inline void expect_as_in_one_piece(const TilesIndex& index, const std::string& out,
                                   const std::vector<double>& points, const std::vector<double>& weights,
                                   const Lattice& lattice, double unit = 0) {
  const auto d = static_cast<std::size_t>(lattice.dimension), r = static_cast<std::size_t>(lattice.rank());
  const auto compare = [&](const PeriodicTriangulation& whole) {
    EXPECT_EQ(index.hash, whole.hash());
    EXPECT_EQ(index.num_cells, static_cast<std::int64_t>(whole.num_cells()));
    EXPECT_EQ(index.num_vertices, static_cast<std::int64_t>(whole.num_vertices()));
    EXPECT_EQ(index.num_duplicates, static_cast<std::int64_t>(whole.num_duplicates()));
    EXPECT_EQ(index.num_hidden, static_cast<std::int64_t>(whole.num_hidden()));
    EXPECT_EQ(index.affine_dimension, whole.affine_dimension());
    EXPECT_EQ(index.lattice.vectors, whole.lattice().vectors);
    EXPECT_EQ(index.unit, unit);
    SortedCells found, expected;
    const auto corners = static_cast<std::size_t>(index.affine_dimension + 1);
    expected.add(whole.cells(), whole.cell_offsets(), corners, r);
    bool is_same_point = true;
    for (std::size_t i = 0; i < index.parts.size(); ++i) {
      const TileData part = read_tile(out, i);
      std::vector<std::int64_t> cells;
      for (const std::int32_t v : part.cells) cells.push_back(part.rows[static_cast<std::size_t>(v)]);
      found.add(cells, part.cell_offsets, corners, r);
      for (std::size_t v = 0; v < part.rows.size(); ++v)
        is_same_point =
            is_same_point && std::equal(&part.points[v * d], &part.points[v * d] + d,
                                        &whole.points()[static_cast<std::size_t>(part.rows[v]) * d]);
    }
    if (!is_same_point) return;  // points outside of the box have other offsets
    EXPECT_EQ(found.sorted(), expected.sorted());
  };
  const PointsView view(points, lattice.dimension);
  if (weights.empty())
    compare(PeriodicDelaunay<>(view, lattice, {.unit = unit}));
  else
    compare(PeriodicRegular<>(view, weights, lattice, {.unit = unit}));
  const CheckReport report = check_tiles(out, {.canonical = true});
  EXPECT_TRUE(report.ok) << report;
  EXPECT_EQ(read_tiles_index(out).hash, index.hash);
}

inline Lattice cube(int d, double side = 1) {
  return Lattice::box(std::vector<double>(static_cast<std::size_t>(d), side));
}

/// A cubic lattice of n^d points, in a cube of side 1.
inline std::vector<double> grid(int d, int n) {
  std::vector<double> points;
  std::vector<int> at(static_cast<std::size_t>(d), 0);
  for (;;) {
    for (const int i : at) points.push_back(static_cast<double>(i) / n);
    std::size_t j = 0;
    while (j < at.size() && ++at[j] == n) at[j++] = 0;
    if (j == at.size()) return points;
  }
}

inline std::vector<double> some_weights(std::size_t n, double size) {
  std::vector<double> weights = make_point_set("uniform", 1, n, 5);
  for (double& w : weights) w = coarse(w) * size;
  return weights;
}

}  // namespace delone::test
