// SPDX-License-Identifier: BSD-3-Clause
// All points move at once, by steps of any length: the result is that of the batch, whether cells that are
// right still stay or all are built anew, and however many threads look for those that are wrong.
#include "scale.hpp"
#include "seen_triangulation.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_sets.hpp>

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
std::size_t count_for_threads(int d) { return d == 2 ? 10000 : d == 3 ? 3000 : 1000; }

Options with_threads(unsigned threads) {
  Options options;
  options.threads = threads;
  return options;
}

std::vector<std::size_t> all_rows(const Delaunay<>& t) {
  std::vector<std::size_t> rows(t.num_rows());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

/// The points, each coordinate moved by up to a part of the mean distance between neighbors.
std::vector<double> stepped(const std::vector<double>& points, int d, double part, std::uint64_t seed) {
  const auto n = static_cast<double>(points.size()) / d;
  const double step = 2 * part * std::pow(n, -1.0 / d);
  const std::vector<double> directions =
      make_point_set("uniform", d, points.size() / static_cast<std::size_t>(d), seed);
  std::vector<double> moved(points);
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += step * (directions[i] - 0.5);
  return moved;
}

/// Points in the unit cube.
std::vector<double> points_of(const std::string& kind, int d, std::size_t n) {
  std::vector<double> points = make_point_set(kind, d, n, 4);
  double largest = 1;
  for (const double x : points) largest = std::max(largest, std::fabs(x));
  for (double& x : points) x /= largest;
  return points;
}

void expect_steps_in_threads(const std::string& kind, int d) {
  SCOPED_TRACE(kind + ", " + std::to_string(d) + "D");
  std::vector<double> points = points_of(kind, d, count_for_threads(d));
  Delaunay<> alone(points, d, with_threads(1)), shared(points, d, with_threads(3));
  alone.sort_cells();
  shared.sort_cells();
  alone.record_changes();
  shared.record_changes();
  shared.record_undo();
  const std::vector<std::size_t> rows = all_rows(alone);
  std::uint64_t seed = 10;
  for (const double part : {1e-12, 1e-5, 1e-3, 1e-3, 1e-2, 0.3, 1e-3}) {
    SCOPED_TRACE(part);
    points = stepped(points, d, part, ++seed);
    alone.move(rows, points);
    shared.move(rows, points);
    EXPECT_EQ(alone.changes().killed, shared.changes().killed);
    EXPECT_EQ(alone.changes().born, shared.changes().born);
    ASSERT_TRUE(test::SeenTriangulation(alone) == test::SeenTriangulation(shared));
    ASSERT_EQ(shared.hash(), Delaunay<>(points, d, with_threads(1)).hash());
  }
  const test::SeenTriangulation before(shared);
  shared.move(rows, stepped(points, d, 1e-3, 1));
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
  const std::size_t n = count_for_threads(d);
  std::vector<double> points = points_of("uniform", d, n);
  Delaunay<> t(points, d, with_threads(3));
  const std::vector<std::size_t> rows = all_rows(t);
  for (int step = 0; step < 4; ++step) {
    points = stepped(points, d, 1e-4, static_cast<std::uint64_t>(step));
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
    ASSERT_EQ(t.hash(), Delaunay<>(points, d, with_threads(1)).hash());
  }
}

}  // namespace
}  // namespace delone
