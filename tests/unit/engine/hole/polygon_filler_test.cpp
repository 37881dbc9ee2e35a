// SPDX-License-Identifier: BSD-3-Clause
// Removing an inner vertex in the plane leaves the triangles of the set without it.
#include "engine/hole/polygon_filler.hpp"

#include "../engine_support.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace delone::engine {
namespace {

using Rows = std::vector<double>;

/// Corners of a square first, then others: 0 in general, 1 on a coarse grid, 2 on one that is off by an ulp
/// here and there, 3 on a circle around the last.
Rows rows_of(Index n, int kind) {
  random::Generator random(static_cast<std::uint64_t>(kind));
  Rows rows{0, 0, 8, 0, 0, 8, 8, 8};
  std::set<std::vector<double>> seen{{0, 0}, {8, 0}, {0, 8}, {8, 8}};
  while (seen.size() < n) {
    std::vector<double> x{8 * random.uniform(), 8 * random.uniform()};
    if (kind == 3) {
      const double angle = 0.8 * x[0];
      x = {4 + 3 * std::cos(angle), 4 + 3 * std::sin(angle)};
    }
    if (kind == 1 || kind == 2)
      for (double& c : x) {
        c = std::floor(c);
        if (kind == 2 && random.uniform() < 0.3) c = std::nextafter(c, 9.0);
      }
    if (seen.insert(x).second) rows.insert(rows.end(), x.begin(), x.end());
  }
  if (kind == 3) rows.insert(rows.end(), {4, 4});
  return rows;
}
Index last_of(const Rows& rows) { return static_cast<Index>(rows.size() / 2); }

std::set<std::vector<Index>> cells_without(const Rows& rows, const std::set<Index>& gone) {
  Points<2> points(rows, 2, 0, 9);
  points.seed();
  for (Index v = 4; v <= last_of(rows); ++v)
    if (!gone.contains(v)) points.build.insert(v);
  return points.sphere();
}
Index cell_of(Points<2>& points, Index v) {
  for (Index cell = 0;; ++cell)
    if (!points.build.cells().is_vacant(cell)) {
      const std::vector<Index> corners = points.corners(cell);
      if (std::find(corners.begin(), corners.end(), v) != corners.end()) return cell;
    }
}

TEST(PolygonFiller, LeavesTheCellsOfTheOtherVertices) {
  for (int kind = 0; kind < 4; ++kind)
    for (const bool is_on_record : {false, true}) {
      SCOPED_TRACE(testing::Message() << "kind " << kind << (is_on_record ? ", on record" : ""));
      const Rows rows = rows_of(48, kind);
      Points<2> points(rows, 2, 0, 9);
      points.seed();
      for (Index v = 4; v <= last_of(rows); ++v) points.build.insert(v);
      const auto before = points.sphere();
      PolygonFiller<Points<2>::Geometry> filler;
      std::set<Index> gone;
      if (is_on_record) points.build.begin_batch(true);
      for (Index v = last_of(rows); v > 5; v -= kind == 3 ? 1 : 2) {
        const Index num_cells = points.build.cells().num_cells();
        if (const auto outcome = filler.remove(points.build, v, cell_of(points, v))) {
          ASSERT_EQ(*outcome, Outcome::done);
          gone.insert(v);
          EXPECT_EQ(points.build.cells().num_cells() + 2, num_cells);
          for (const Index cell : filler.created()) EXPECT_FALSE(points.build.cells().is_vacant(cell));
        } else {
          EXPECT_TRUE(rows[2 * v - 2] == 0 || rows[2 * v - 1] == 0 || rows[2 * v - 2] >= 7 ||
                      rows[2 * v - 1] >= 7);
        }
        ASSERT_EQ(points.sphere(), cells_without(rows, gone)) << "without vertex " << v;
      }
      EXPECT_GT(gone.size(), 10u);
      for (Index cell = 0; cell < points.build.cells().num_slots(); ++cell)
        EXPECT_TRUE(points.build.cells().is_vacant(cell) || points.build.cells().mark(cell) == Mark::unseen);
      if (!is_on_record) continue;
      points.build.undo_batch();
      EXPECT_EQ(points.sphere(), before);
    }
}

TEST(PolygonFiller, RemovesNoneOfTheHullAndNoneInAllCells) {
  const Rows rows{0, 0, 8, 0, 0, 8, 8, 8, 4, 3};
  Points<2> points(rows, 2, 0, 9);
  points.seed();
  for (Index v = 4; v <= 5; ++v) points.build.insert(v);
  const auto before = points.sphere();
  PolygonFiller<Points<2>::Geometry> filler;
  for (Index v = 1; v <= 5; ++v) EXPECT_FALSE(filler.remove(points.build, v, cell_of(points, v))) << v;
  EXPECT_EQ(points.sphere(), before);
}

}  // namespace
}  // namespace delone::engine
