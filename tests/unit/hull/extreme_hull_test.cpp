// SPDX-License-Identifier: BSD-3-Clause
// The hull of the extreme points is that of exactly the rows that the hull of all rows finds extreme: its
// cells are those of the hull of these rows alone.
#include "hull/extreme_hull.hpp"

#include "degenerate.hpp"
#include "hull/hull_analysis.hpp"
#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace delone::hull {
namespace {

using Cells = std::vector<std::vector<Index>>;

/// The rows of the input of the cells' vertices, increasing.
Cells cells_of(const HullState& state, const std::vector<Index>& rows) {
  Cells cells;
  for (std::size_t c = 0; c < state.hull().num_cells(); ++c) {
    cells.emplace_back();
    for (const Index site : state.hull().cell(c))
      cells.back().push_back(rows[static_cast<std::size_t>(state.row(site))]);
    std::sort(cells.back().begin(), cells.back().end());
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

void check(const std::vector<double>& coordinates, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  HullState all(dimension);
  all.insert_range(coordinates, {});
  const HullAnalysis analysis(all);
  std::vector<Index> extreme;
  std::vector<double> points;
  for (std::size_t row = 0; row < all.num_rows(); ++row)
    if (analysis.kinds()[row] == PointKind::extreme) {
      extreme.push_back(static_cast<Index>(row));
      points.insert(points.end(), all.point_of_row(row), all.point_of_row(row) + d);
    }
  HullState reference(dimension);
  reference.insert_range(points, {});
  const ExtremeHull found = find_extreme_hull(coordinates, dimension, {});
  EXPECT_EQ(found.state->affine_hull().dimension(), all.affine_hull().dimension());
  EXPECT_EQ(cells_of(*found.state, found.rows), cells_of(reference, extreme));
  const HullAnalysis of_found(*found.state);
  std::vector<Index> rows;
  for (std::size_t i = 0; i < found.rows.size(); ++i)
    if (of_found.kinds()[i] == PointKind::extreme) rows.push_back(found.rows[i]);
  std::sort(rows.begin(), rows.end());
  EXPECT_EQ(rows, extreme);
}

TEST(ExtremeHull, IsTheHullOfTheExtremePoints) {
  const int most = static_cast<int>(test::scaled_size(5, 3));
  for (int d = 1; d <= most; ++d) {
    const std::size_t n = d < 4 ? test::scaled_size(1200, 300) : 400;
    for (const char* kind : {"uniform", "ball", "sphere"})
      for (const std::size_t some : {n, std::size_t{90}}) check(make_point_set(kind, d, some, 2), d);
    for (const test::PointSet& set : test::degenerate_sets(d, d < 5 ? 200 : 90, 4))
      check(set.points, set.dimension);
    check(test::small_integers(d, n, -3, 3, 7).points, d);
  }
}

/// Fractions c/s for small whole c with sum s: points of the faces of a simplex, rounded, and a height.
TEST(ExtremeHull, DecidesRoundedFacetsExactly) {
  for (int d = 3; d <= 4; ++d) {
    std::vector<double> rows;
    const std::vector<double> parts = test::small_integers(d, 300, 0, 5, 11).points;
    const std::vector<double> heights = make_point_set("uniform", 1, 300, 12);
    const auto width = static_cast<std::size_t>(d);
    for (std::size_t i = 0; i < 300; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < width; ++j) sum += parts[i * width + j];
      if (sum == 0) continue;
      for (std::size_t j = 0; j + 1 < width; ++j) rows.push_back(parts[i * width + j] / sum);
      rows.push_back(heights[i]);
    }
    check(rows, d);
  }
}

/// So many points on walls that the shell grows for long.
TEST(ExtremeHull, ManyPointsOnWalls) {
  for (int d = 2; d <= 4; ++d)
    for (const bool all : {false, true}) {
      const auto width = static_cast<std::size_t>(d);
      const std::size_t n = test::scaled_size(6000, 2000);
      std::vector<double> rows = make_point_set("uniform", d, n, 5);
      for (std::size_t i = n / 3; i < n; ++i) rows[i * width + (all ? i % width : 0)] = all && i % 2 ? 1 : 0;
      check(rows, d);
    }
}

}  // namespace
}  // namespace delone::hull
