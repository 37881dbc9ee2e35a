// SPDX-License-Identifier: BSD-3-Clause
// All points move at once, by steps of any length: the result is that of the batch, whether cells that are
// right still stay or all are built anew, and however many threads look for those that are wrong.
#include "scale.hpp"
#include "seen_triangulation.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace delone {
namespace {

/// So many points have cells for several threads.
std::size_t num_points_for_threads(int d) { return d == 2 ? 10000 : d == 3 ? 3000 : 1000; }

Options by_threads(unsigned threads) {
  Options options;
  options.threads = threads;
  return options;
}

std::vector<std::size_t> rows_of_all(const Delaunay<>& t) {
  std::vector<std::size_t> rows(t.num_rows());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

/// The points, each coordinate moved by up to a part of the mean distance between neighbors.
std::vector<double> moved_by(const std::vector<double>& points, int d, double part, std::uint64_t seed) {
  const auto n = static_cast<double>(points.size()) / d;
  const double step = 2 * part * std::pow(n, -1.0 / d);
  const std::vector<double> directions =
      make_point_set("uniform", d, points.size() / static_cast<std::size_t>(d), seed);
  std::vector<double> moved(points);
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += step * (directions[i] - 0.5);
  return moved;
}

/// Points in the unit cube.
std::vector<double> points_in_cube(const std::string& kind, int d, std::size_t n) {
  std::vector<double> points = make_point_set(kind, d, n, 4);
  double largest = 1;
  for (const double x : points) largest = std::max(largest, std::fabs(x));
  for (double& x : points) x /= largest;
  return points;
}

void expect_steps_in_threads(const std::string& kind, int d) {
  SCOPED_TRACE(kind + ", " + std::to_string(d) + "D");
  std::vector<double> points = points_in_cube(kind, d, num_points_for_threads(d));
  Delaunay<> alone(points, d, by_threads(1)), shared(points, d, by_threads(3));
  alone.sort_cells();
  shared.sort_cells();
  alone.record_changes();
  shared.record_changes();
  shared.record_undo();
  const std::vector<std::size_t> rows = rows_of_all(alone);
  std::uint64_t seed = 10;
  for (const double part : {1e-12, 1e-5, 1e-3, 1e-3, 1e-2, 0.3, 1e-3}) {
    SCOPED_TRACE(part);
    points = moved_by(points, d, part, ++seed);
    alone.move(rows, points);
    shared.move(rows, points);
    EXPECT_EQ(alone.changes().removed_cells, shared.changes().removed_cells);
    EXPECT_EQ(alone.changes().created_cells, shared.changes().created_cells);
    if (part == 1e-3 && kind == "uniform") {  // most cells have stayed
      EXPECT_GT(alone.changes().removed_cells.size(), 0u);
      EXPECT_LT(4 * alone.changes().removed_cells.size(), alone.num_finite_cells());
    }
    ASSERT_TRUE(test::SeenTriangulation(alone) == test::SeenTriangulation(shared));
    ASSERT_EQ(shared.hash(), Delaunay<>(points, d, by_threads(1)).hash());
  }
  const test::SeenTriangulation before(shared);
  shared.move(rows, moved_by(points, d, 1e-3, 1));
  shared.undo();
  EXPECT_TRUE(test::SeenTriangulation(shared) == before);
}

TEST(TimeSteps, ByThreadsAreThoseOfOneThread) {
  for (const int d : {2, 3, 4})
    for (const char* const kind : {"uniform", "grid", "sphere"}) expect_steps_in_threads(kind, d);
}

/// Some cells are turned over, at places far from each other.
TEST(TimeSteps, ByThreadsTurnCellsOver) {
  constexpr int d = 2;
  const std::size_t n = num_points_for_threads(d);
  std::vector<double> points = points_in_cube("uniform", d, n);
  Delaunay<> t(points, d, by_threads(3));
  const std::vector<std::size_t> rows = rows_of_all(t);
  for (int step = 0; step < 4; ++step) {
    points = moved_by(points, d, 1e-4, static_cast<std::uint64_t>(step));
    for (std::size_t i = 0; i < n; i += 97) {
      const Complex complex = t.complex();
      const VertexId v = t.vertex_at(i);
      for (const VertexId w : complex.adjacent_vertices(v)) {
        // Beyond the first finite neighbor, as seen from v.
        if (w == infinite_vertex) continue;
        for (std::size_t j = 0; j < 2; ++j) points[2 * i + j] += 1.2 * (t.point(w)[j] - t.point(v)[j]);
        break;
      }
    }
    t.move(rows, points);
    ASSERT_EQ(t.hash(), Delaunay<>(points, d, by_threads(1)).hash());
  }
}

/// Points on the floor of a cube pass it, and each other, in any order, so holes there cannot be filled. Most
/// cells stay in spite of this.
TEST(TimeSteps, OfPointsOnAWall) {
  for (const int d : {2, 3}) {
    SCOPED_TRACE(std::to_string(d) + "D");
    const std::size_t n = d == 2 ? 20000 : 30000, num_on_floor = 100;
    std::vector<double> points = points_in_cube("uniform", d, n);
    for (std::size_t i = 0; i < num_on_floor; ++i) points[i * static_cast<std::size_t>(d)] = 0;
    Delaunay<> alone(points, d, by_threads(1)), shared(points, d, by_threads(3));
    for (Delaunay<>* const t : {&alone, &shared}) {
      t->sort_cells();
      t->record_changes();
      t->record_undo();
    }
    const std::vector<std::size_t> rows = rows_of_all(alone);
    for (std::uint64_t seed = 30; seed < 34; ++seed) {
      SCOPED_TRACE(seed);
      points = moved_by(points, d, 1e-3, seed);
      alone.move(rows, points);
      shared.move(rows, points);
      EXPECT_LT(4 * alone.changes().removed_cells.size(), alone.num_finite_cells());
      EXPECT_EQ(alone.changes().moved_vertices.size(), n);
      ASSERT_TRUE(test::SeenTriangulation(alone) == test::SeenTriangulation(shared));
      ASSERT_EQ(alone.hash(), Delaunay<>(points, d, by_threads(1)).hash());
    }
    const test::SeenTriangulation before(shared);
    shared.move(rows, moved_by(points, d, 1e-3, 34));
    EXPECT_LT(4 * shared.changes().removed_cells.size(), shared.num_finite_cells());
    shared.undo();
    EXPECT_TRUE(test::SeenTriangulation(shared) == before);
  }
}

/// Points, weights, and both; hidden points come back, and others go.
TEST(TimeSteps, OfWeightedPoints) {
  for (const int d : {2, 3}) {
    SCOPED_TRACE(std::to_string(d) + "D");
    const std::size_t n = num_points_for_threads(d);
    const double spacing = std::pow(static_cast<double>(n), -1.0 / d);
    std::vector<double> points = points_in_cube("uniform", d, n);
    std::vector<double> weights = make_point_set("uniform", 1, n, 7);
    for (double& weight : weights) weight *= 0.6 * spacing * spacing;
    Regular<> alone(points, weights, d, by_threads(1)), shared(points, weights, d, by_threads(3));
    ASSERT_GT(alone.num_hidden(), 10u);
    for (Regular<>* const t : {&alone, &shared}) {
      t->sort_cells();
      t->record_changes();
    }
    std::vector<std::size_t> rows(n);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::uint64_t seed = 20;
    std::size_t num_settled = 0, num_hid = 0, num_reappeared = 0;
    for (const double part : {1e-5, 1e-3, 1e-3, 1e-3, 0.3, 1e-3, 1e-3, 1e-3}) {
      SCOPED_TRACE(part);
      if (++seed % 3 != 0) points = moved_by(points, d, part, seed);
      if (seed % 3 != 1)
        for (std::size_t i = 0; i < n; ++i)
          weights[i] += part * spacing * spacing * std::sin(static_cast<double>(i));
      for (Regular<>* const t : {&alone, &shared}) {
        if (seed % 3 == 0)
          t->set_weights(rows, weights);
        else if (seed % 3 == 1)
          t->move(rows, points);
        else
          t->edit({.move = rows, .to = points, .reweight = rows, .weights = weights});
      }
      ASSERT_TRUE(test::SeenTriangulation(alone) == test::SeenTriangulation(shared));
      const Regular<> batch(points, weights, d);
      ASSERT_EQ(shared.hash(), batch.hash());
      ASSERT_EQ(shared.hidden_rows(), batch.hidden_rows());
      num_settled += 4 * alone.changes().removed_cells.size() < alone.num_finite_cells() ? 1 : 0;
      num_hid += alone.changes().hidden_vertices.size();
      num_reappeared += alone.changes().reappeared_vertices.size();
    }
    EXPECT_GT(num_settled, 1u);  // most cells have stayed
    EXPECT_GT(num_hid, 0u);
    EXPECT_GT(num_reappeared, 0u);
  }
}

/// One by one, of points that hide others.
TEST(SmallSteps, OfWeightedPoints) {
  for (const int d : {1, 2, 3, 5}) {
    SCOPED_TRACE(std::to_string(d) + "D");
    const std::size_t n = d < 5 ? 300 : 60;
    const double spacing = std::pow(static_cast<double>(n), -1.0 / d);
    std::vector<double> points = points_in_cube("uniform", d, n);
    std::vector<double> weights = make_point_set("uniform", 1, n, 7);
    for (double& weight : weights) weight *= spacing * spacing;
    Regular<> t(points, weights, d);
    t.record_undo();
    t.record_changes();
    const std::vector<double> directions = make_point_set("uniform", d, n, 8);
    std::size_t num_settled = 0;
    for (std::size_t row = 0; row < n; row += 3) {
      const double part = row % 2 == 0 ? 1e-6 : 0.05;
      const CanonicalHash before = t.hash();
      std::vector<double> to;
      for (std::size_t j = row * d; j < (row + 1) * d; ++j)
        to.push_back(points[j] + part * spacing * (directions[j] - 0.5));
      if (row % 4 < 2)
        t.move(row, to);
      else
        t.set_weight(row, weights[row] + part * spacing * spacing);
      num_settled += t.changes().removed_cells.empty() && !t.is_hidden(row) ? 1 : 0;
      t.undo();
      ASSERT_EQ(t.hash(), before);
      if (row % 4 < 2) {
        std::copy(to.begin(), to.end(), points.begin() + static_cast<std::ptrdiff_t>(row * d));
        t.move(row, to);
      } else {
        weights[row] += part * spacing * spacing;
        t.set_weight(row, weights[row]);
      }
      const Regular<> batch(points, weights, d);
      ASSERT_EQ(t.hash(), batch.hash()) << "row " << row;
      ASSERT_EQ(t.hidden_rows(), batch.hidden_rows()) << "row " << row;
    }
    EXPECT_GT(num_settled, 0u);
  }
}

}  // namespace
}  // namespace delone
