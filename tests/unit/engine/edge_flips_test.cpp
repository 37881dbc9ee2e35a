// SPDX-License-Identifier: BSD-3-Clause
// After a vertex of the plane has moved in its star, flips lead to the triangles of the points where they
// are.
#include "engine/hole/edge_flips.hpp"

#include "engine/hole/relocation.hpp"
#include "engine_support.hpp"

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
/// here and there, 3 on a grid of tenths, 4 on a circle.
Rows rows_of_flips(Index n, int kind) {
  random::Generator random(static_cast<std::uint64_t>(kind));
  Rows rows{0, 0, 8, 0, 0, 8, 8, 8};
  std::set<std::vector<double>> seen{{0, 0}, {8, 0}, {0, 8}, {8, 8}};
  while (seen.size() < n) {
    std::vector<double> x{8 * random.uniform(), 8 * random.uniform()};
    if (kind == 4) {
      const double angle = 0.8 * x[0];
      x = {4 + 3 * std::cos(angle), 4 + 3 * std::sin(angle)};
    } else if (kind > 0) {
      for (double& c : x) {
        c = kind == 3 ? 0.1 * std::floor(10 * c) : std::floor(c);
        if (kind == 2 && random.uniform() < 0.3) c = std::nextafter(c, 9.0);
      }
    }
    if (seen.insert(x).second) rows.insert(rows.end(), x.begin(), x.end());
  }
  return rows;
}

/// Points of a set with an engine that moves them.
struct MovingPoints : Points<2> {
  explicit MovingPoints(const Rows& rows)
      : Points<2>(rows, 2, 0, 9),
        last(static_cast<Index>(rows.size() / 2)),
        filler(build.cells(), build.geometry()),
        relocation(build, filler) {
    seed();
    for (Index v = 4; v <= last; ++v) build.insert(v);
  }
  Index any_cell_of(Index v) const {
    for (Index cell = 0;; ++cell) {
      if (build.cells().is_vacant(cell)) continue;
      const std::vector<Index> vertices = corners(cell);
      if (std::find(vertices.begin(), vertices.end(), v) != vertices.end()) return cell;
    }
  }
  void set_point(Index v, double x, double y) {
    coordinates[2 * v] = x;
    coordinates[2 * v + 1] = y;
    grid.include(&coordinates[2 * v]);
    build.geometry().rewrite_row(v);
  }
  Rows rows() const { return Rows(coordinates.begin() + 2, coordinates.end()); }

  Index last;
  HoleFiller<2, Geometry> filler;
  Relocation<2, Geometry> relocation;
};

TEST(EdgeFlips, LeadToTheTrianglesOfTheMovedPoints) {
  for (int kind = 0; kind < 5; ++kind)
    for (const bool is_on_record : {false, true}) {
      SCOPED_TRACE(testing::Message() << "kind " << kind << (is_on_record ? ", on record" : ""));
      random::Generator random(100 + static_cast<std::uint64_t>(kind));
      MovingPoints points(rows_of_flips(48, kind));
      const auto before = points.sphere();
      const Rows rows_before = points.rows();
      if (is_on_record) points.build.begin_batch(true);
      int num_flipped = 0, num_costly = 0;
      for (int round = 0; round < 200; ++round) {
        const Index v = 5 + static_cast<Index>(random.below(points.last - 4));
        const double x = points.coordinates[2 * v], y = points.coordinates[2 * v + 1];
        const double step = round % 5 == 0 ? 1e-12 : round % 5 == 1 ? 0.01 : 0.6;
        double to_x = x + step * (2 * random.uniform() - 1), to_y = y + step * (2 * random.uniform() - 1);
        if (kind > 0 && round % 3 == 0) to_x = std::round(to_x), to_y = std::round(to_y);
        if (!(to_x >= 0 && to_x <= 8 && to_y >= 0 && to_y <= 8)) continue;
        const auto unmoved = points.sphere();
        points.set_point(v, to_x, to_y);
        const Change change = points.relocation.relocate(v, points.any_cell_of(v));
        if (!change.is_done()) {
          points.set_point(v, x, y);
          points.relocation.take_back();
          ASSERT_EQ(points.sphere(), unmoved);
          ++num_costly;
        } else {
          MovingPoints others(points.rows());
          ASSERT_EQ(points.sphere(), others.sphere()) << "round " << round << ", vertex " << v;
          num_flipped += change.created_cells.empty() ? 0 : 1;
        }
        // Functionals are those of the cells, too: a walk, and an insertion, find their way.
        for (Index u = 1; u <= points.last; ++u)
          for (Index cell = 0; cell < points.build.cells().num_slots(); ++cell)
            if (!points.build.cells().is_vacant(cell)) {
              const auto functional = points.build.geometry().evaluator(points.build.geometry().query_at(u));
              EXPECT_FALSE(functional.value(cell) < -functional.threshold(cell));
            }
        ASSERT_FALSE(HasFailure()) << "round " << round;
      }
      EXPECT_GT(num_flipped, 20);
      EXPECT_GT(num_costly, 5);
      if (!is_on_record) continue;
      for (Index v = 1; v <= points.last; ++v)
        points.set_point(v, rows_before[2 * v - 2], rows_before[2 * v - 1]);
      points.build.undo_batch();
      EXPECT_EQ(points.sphere(), before);
    }
}

TEST(EdgeFlips, AreTakenBackIfTheyAreTooMany) {
  random::Generator random(1);
  int num_taken_back = 0;
  for (int round = 0; round < 100; ++round) {
    MovingPoints points(rows_of_flips(24, 0));
    const Index v = 5 + static_cast<Index>(random.below(points.last - 4));
    StarInPlane star;
    if (!star.find(points.build.cells(), points.build.geometry(), v, points.any_cell_of(v))) continue;
    points.set_point(v, points.coordinates[2 * v] + 0.5 * random.uniform(),
                     points.coordinates[2 * v + 1] + 0.5 * random.uniform());
    bool is_positive = true;
    for (const StarInPlane::Sector& sector : star.sectors()) {
      const auto vertices = points.build.cells().vertices(sector.cell);
      is_positive &= points.build.geometry().orientation(vertices) == Sign::positive;
      create_functional(points.build.cells(), points.build.geometry(), sector.cell);
    }
    if (!is_positive) continue;
    const auto before = points.sphere();
    MovedCells<2, MovingPoints::Geometry> moved_cells(points.build.cells(), points.build.geometry());
    for (const std::size_t most : {0, 1, 2, 100}) {
      EdgeFlips<MovingPoints::Geometry> flips;
      flips.begin();
      for (Index cell = 0; cell < points.build.cells().num_slots(); ++cell)
        for (int slot = 0; slot < 3; ++slot)
          if (points.build.cells().infinite_slot(cell) < 0) flips.add(cell, slot);
      if (flips.run(points.build, moved_cells, most)) {
        MovingPoints others(points.rows());
        EXPECT_EQ(points.sphere(), others.sphere());
        break;
      }
      ++num_taken_back;
      EXPECT_EQ(points.sphere(), before);
    }
  }
  EXPECT_GT(num_taken_back, 5);
}

}  // namespace
}  // namespace delone::engine
