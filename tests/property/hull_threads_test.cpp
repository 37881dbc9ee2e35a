// SPDX-License-Identifier: BSD-3-Clause
// Several threads build the hull, the lower hull and the intersection that one thread builds, with the same
// arrays. What they cannot finish leaves everything as it was.
#include "degenerate.hpp"
#include "halfspace_sets.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/error.hpp>
#include <delone/halfspaces.hpp>
#include <delone/lower_hull.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

namespace delone {
namespace {

using test::PointSet;

Options with_threads(unsigned threads, InsertionOrder order = InsertionOrder::automatic) {
  Options options;
  options.threads = threads;
  options.order = order;
  return options;
}

void expect_equal(const ConvexHullBase& made, const ConvexHullBase& reference) {
  EXPECT_EQ(made.hash().hex(), reference.hash().hex());
  EXPECT_EQ(made.num_duplicates(), reference.num_duplicates());
  const HullData &a = made.data(), &b = reference.data();
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.neighbors, b.neighbors);
  EXPECT_EQ(a.facet_of_cell, b.facet_of_cell);
  EXPECT_EQ(a.facet_vertices, b.facet_vertices);
  EXPECT_EQ(a.ridge_vertices, b.ridge_vertices);
  EXPECT_EQ(a.equations, b.equations);
  EXPECT_EQ(a.point_kinds, b.point_kinds);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.vertex_of_point, b.vertex_of_point);
  EXPECT_EQ(made.volume().value, reference.volume().value);
  EXPECT_EQ(made.area().value, reference.area().value);
}

/// In two batches.
ConvexHull<> in_parts(const PointSet& set, const Options& options) {
  const std::size_t half = set.size() / 2 * static_cast<std::size_t>(set.dimension);
  ConvexHull<> result(set.dimension, options);
  result.insert_range(std::span(set.points).first(half));
  result.insert_range(std::span(set.points).subspan(half));
  return result;
}

/// Fewer where hulls take long.
std::vector<unsigned> thread_counts(int dimension) {
  return dimension <= 5 ? std::vector<unsigned>{2, 3, 8} : std::vector<unsigned>{3};
}

void expect_same_in_threads(const PointSet& set) {
  SCOPED_TRACE(set.name + " in " + std::to_string(set.dimension) + "D");
  const ConvexHull<> at_once(set.points, set.dimension, with_threads(1));
  for (const unsigned threads : thread_counts(set.dimension)) {
    SCOPED_TRACE(threads);
    expect_equal(ConvexHull<>(set.points, set.dimension, with_threads(threads)), at_once);
  }
  if (set.dimension > 5) return;
  const InsertionOrder order = InsertionOrder::shuffled;
  const ConvexHull<> shuffled(set.points, set.dimension, with_threads(1, order));
  expect_equal(ConvexHull<>(set.points, set.dimension, with_threads(4, order)), shuffled);
  const ConvexHull<> reference = in_parts(set, with_threads(1));
  const ConvexHull<> made = in_parts(set, with_threads(3));
  expect_equal(made, reference);
  EXPECT_EQ(made.hash(), at_once.hash());
}

class HullThreadsIn : public ::testing::TestWithParam<int> {
 protected:
  /// For dimensions 2 to 7. A few more than those that one thread inserts before all others.
  std::size_t num_points(std::vector<std::size_t> usual) const {
    return test::scaled_count(usual[static_cast<std::size_t>(GetParam()) - 2]);
  }
};
INSTANTIATE_TEST_SUITE_P(Dimensions, HullThreadsIn, ::testing::Range(2, 8),
                         ::testing::PrintToStringParamName());

TEST_P(HullThreadsIn, Spheres) {
  const std::size_t n = num_points({300, 1500, 600, 250, 200, 220});
  expect_same_in_threads({"sphere", GetParam(), make_point_set("sphere", GetParam(), n, 5)});
}

TEST_P(HullThreadsIn, HiddenPoints) {
  const std::size_t n = num_points({600, 3000, 1500, 500, 250, 220});
  expect_same_in_threads({"ball", GetParam(), make_point_set("ball", GetParam(), n, 5)});
  expect_same_in_threads({"uniform", GetParam(), make_point_set("uniform", GetParam(), n, 6)});
}

TEST_P(HullThreadsIn, DegenerateSets) {
  for (const PointSet& set : test::degenerate_sets(GetParam(), num_points({60, 100, 60, 30, 20, 14}), 3)) {
    expect_same_in_threads(set);
    if (HasFailure()) return;
  }
}

TEST_P(HullThreadsIn, LatticesAndDuplicates) {
  static constexpr int side[] = {40, 10, 5, 3, 3, 2};
  expect_same_in_threads(test::lattice(GetParam(), side[GetParam() - 2]));
  expect_same_in_threads(
      test::small_integers(GetParam(), num_points({300, 1500, 900, 200, 60, 60}), 0, 3, 8));
}

/// Most points are on the faces of a cube, many of them vertices of cells for a while.
TEST_P(HullThreadsIn, FacesOfCubes) {
  const auto d = static_cast<std::size_t>(GetParam());
  PointSet set{"faces", GetParam(),
               make_point_set("uniform", GetParam(), num_points({300, 1000, 400, 240, 180, 210}), 7)};
  for (std::size_t i = 0; i < set.points.size(); i += d)
    set.points[i + i / d % d] = static_cast<double>(i / d / d % 2);
  expect_same_in_threads(set);
}

TEST_P(HullThreadsIn, LowerHulls) {
  const int d = GetParam();
  const std::size_t n = num_points({300, 900, 400, 220, 170, 210});
  for (const bool is_rounded : {false, true}) {
    std::vector<double> points = make_point_set("uniform", d, n, 6);
    for (std::size_t i = 0; i < n; ++i) {
      double* const x = points.data() + i * static_cast<std::size_t>(d);
      if (is_rounded) std::transform(x, x + d, x, [](double t) { return std::round(6 * t); });
      x[d - 1] = std::inner_product(x, x + d - 1, x, 0.0);
    }
    const LowerHull<> reference(points, d, HullSide::lower, with_threads(1));
    for (const unsigned threads : thread_counts(d)) {
      const LowerHull<> made(points, d, HullSide::lower, with_threads(threads));
      EXPECT_TRUE(std::ranges::equal(made.cells(), reference.cells()));
      EXPECT_TRUE(std::ranges::equal(made.neighbors(), reference.neighbors()));
      EXPECT_TRUE(std::ranges::equal(made.facet_of_cell(), reference.facet_of_cell()));
      EXPECT_TRUE(std::ranges::equal(made.vertices(), reference.vertices()));
    }
  }
}

void expect_equal(const HalfspaceIntersectionBase& made, const HalfspaceIntersectionBase& reference) {
  const IntersectionData &a = made.data(), &b = reference.data();
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.vertex_halfspaces, b.vertex_halfspaces);
  EXPECT_EQ(a.directions, b.directions);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.facet_halfspaces, b.facet_halfspaces);
  EXPECT_EQ(a.facet_vertices, b.facet_vertices);
  EXPECT_EQ(a.kinds, b.kinds);
  EXPECT_EQ(a.dual_equations, b.dual_equations);
}

/// Halfspaces tangent to a sphere, farther ones if `farther`, rounded if `bits` ≥ 0.
std::vector<double> tangent_halfspaces(int d, std::size_t n, double farther, int bits) {
  const std::vector<double> normals = make_point_set("sphere", d, n, 9),
                            distances = make_point_set("uniform", 1, n, 10);
  std::vector<double> rows;
  for (std::size_t i = 0; i < n; ++i) {
    for (int j = 0; j < d; ++j) {
      const double x = normals[i * static_cast<std::size_t>(d) + static_cast<std::size_t>(j)];
      rows.push_back(bits < 0 ? x : std::ldexp(std::round(std::ldexp(x, bits)), -bits));
    }
    rows.push_back(-1 - farther * distances[i]);
  }
  return rows;
}

TEST_P(HullThreadsIn, Halfspaces) {
  const int d = GetParam();
  const std::size_t n = num_points({300, 1000, 400, 220, 170, 210});
  for (const auto& [farther, bits] : {std::pair(0.0, -1), std::pair(0.05, -1), std::pair(0.0, 3)}) {
    const std::vector<double> rows = tangent_halfspaces(d, n, farther, bits),
                              more = tangent_halfspaces(d, n + n / 2, farther, bits);
    const std::size_t first = n * static_cast<std::size_t>(d + 1);
    HalfspaceIntersection<> reference(rows, d, with_threads(1));
    for (const unsigned threads : thread_counts(d)) {
      SCOPED_TRACE(threads);
      HalfspaceIntersection<> made(rows, d, with_threads(threads));
      expect_equal(made, reference);
      if (threads != 3 || d > 5) continue;
      HalfspaceIntersection<> grown(rows, d, with_threads(1));
      grown.insert_range(std::span(more).subspan(first));
      made.insert_range(std::span(more).subspan(first));
      expect_equal(made, grown);
    }
  }
}

TEST(HullThreads, ResultsCanBeUsedAsAnyOther) {
  const std::vector<double> points = make_point_set("sphere", 3, 500, 2),
                            more = make_point_set("sphere", 3, 100, 3);
  ConvexHull<> made(points, 3, with_threads(4)), reference(points, 3);
  for (std::size_t i = 0; i < more.size(); i += 3) {
    made.insert(std::span(more).subspan(i, 3));
    reference.insert(std::span(more).subspan(i, 3));
  }
  EXPECT_EQ(made.hash(), reference.hash());
  EXPECT_TRUE(check(made.to_data()).ok);
  const ConvexHull<> copy = made.clone();
  EXPECT_EQ(copy.data().cells, made.data().cells);
}

TEST(HullThreads, ProgressComesFromTheCallingThread) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> others = 0;
  Options options = with_threads(4);
  double last = 0;
  options.progress = [&](double done) {
    others += std::this_thread::get_id() != caller;
    EXPECT_LE(done, 1);
    EXPECT_GE(done, last);
    last = done;
    return true;
  };
  const ConvexHull<> made(make_point_set("sphere", 3, test::scaled_count(20000), 4), 3, options);
  last = 0;
  const ConvexHull<> of_ball(make_point_set("ball", 4, test::scaled_count(20000), 4), 4, options);
  EXPECT_EQ(others, 0);
}

TEST(HullThreads, CancelledBatchesChangeNothing) {
  const std::vector<double> points = make_point_set("sphere", 3, 3000, 2),
                            more = make_point_set("sphere", 3, test::scaled_count(30000), 3);
  std::atomic<int> calls_left = 1 << 30;
  Options options = with_threads(3);
  options.progress = [&](double) { return --calls_left > 0; };
  ConvexHull<> made(points, 3, options);
  const CanonicalHash before = made.hash();
  const std::vector<SignedIndex> cells = made.data().cells;
  for (int calls = 1; calls < 3; ++calls) {
    calls_left = calls;
    try {
      made.insert_range(more);
      break;  // it was too fast
    } catch (const Error& error) {
      calls_left = 1 << 30;
      EXPECT_EQ(error.code(), Errc::cancelled);
      EXPECT_EQ(made.hash(), before);
      EXPECT_EQ(made.data().cells, cells);
      EXPECT_EQ(made.num_points(), 3000u);
    }
  }
  calls_left = 1 << 30;
  made.insert_range(more);
  std::vector<double> all = points;
  all.insert(all.end(), more.begin(), more.end());
  EXPECT_EQ(made.hash(), ConvexHull<>(all, 3).hash());
}

}  // namespace
}  // namespace delone
