// SPDX-License-Identifier: BSD-3-Clause
// Several threads build what one thread builds: the same cells, of the same vertices. What they cannot finish
// leaves everything as it was.
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace delone {
namespace {

using test::PointSet;

Options with_threads(unsigned threads, std::uint64_t seed = 0) {
  Options options;
  options.threads = threads;
  options.seed = seed;
  return options;
}

template <class Product>
void expect_equal(Product& made, Product& reference) {
  EXPECT_EQ(made.hash().hex(), reference.hash().hex());
  EXPECT_EQ(made.num_finite_cells(), reference.num_finite_cells());
  EXPECT_EQ(made.num_infinite_cells(), reference.num_infinite_cells());
  EXPECT_EQ(made.num_vertices(), reference.num_vertices());
  EXPECT_EQ(made.num_duplicates(), reference.num_duplicates());
  const CanonicalHash before = made.hash();
  made.sort_cells();
  reference.sort_cells();
  EXPECT_EQ(made.hash(), before);
  const ComplexData a = made.to_data(false), b = reference.to_data(false);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.neighbors, b.neighbors);
  EXPECT_EQ(a.vertex_of_point, b.vertex_of_point);
}

/// In two batches.
Delaunay<> in_parts(const PointSet& set, const Options& options) {
  const std::size_t half = set.size() / 2 * static_cast<std::size_t>(set.dimension);
  Delaunay<> result(set.dimension, options);
  result.insert_range(std::span(set.points).first(half));
  result.insert_range(std::span(set.points).subspan(half));
  return result;
}

void expect_same_in_threads(const PointSet& set, std::uint64_t seed = 0) {
  SCOPED_TRACE(set.name + " in " + std::to_string(set.dimension) + "D");
  Delaunay<> reference(set.points, set.dimension, with_threads(1, seed));
  for (const unsigned threads : {2u, 3u, 8u}) {
    SCOPED_TRACE(threads);
    Delaunay<> made(set.points, set.dimension, with_threads(threads, seed));
    expect_equal(made, reference);
  }
  Delaunay<> reference_in_parts = in_parts(set, with_threads(1, seed)),
             made = in_parts(set, with_threads(3, seed));
  expect_equal(made, reference_in_parts);
  EXPECT_EQ(made.hash(), reference.hash());
}

class ThreadsIn : public ::testing::TestWithParam<int> {
 protected:
  std::size_t num_points(std::vector<std::size_t> usual) const {
    return test::scaled_count(usual[static_cast<std::size_t>(GetParam()) - 1]);
  }
};
INSTANTIATE_TEST_SUITE_P(Dimensions, ThreadsIn, ::testing::Range(1, 8), ::testing::PrintToStringParamName());

TEST_P(ThreadsIn, UniformPoints) {
  const std::size_t n = num_points({500, 4000, 2000, 600, 300, 260, 30});
  for (const std::uint64_t seed : {0, 1})
    expect_same_in_threads({"uniform", GetParam(), make_point_set("uniform", GetParam(), n, 5)}, seed);
}

TEST_P(ThreadsIn, DegenerateSets) {
  for (const PointSet& set :
       test::degenerate_sets(GetParam(), num_points({100, 300, 200, 100, 40, 24, 14}), 3)) {
    expect_same_in_threads(set);
    if (HasFailure()) return;
  }
}

TEST_P(ThreadsIn, LatticesAndDuplicates) {
  static constexpr int side[] = {200, 30, 9, 4, 3, 2, 2};
  expect_same_in_threads(test::lattice(GetParam(), side[GetParam() - 1]));
  expect_same_in_threads(
      test::small_integers(GetParam(), num_points({500, 3000, 2000, 800, 300, 250, 30}), 0, 3, 8));
}

TEST_P(ThreadsIn, WeightedPoints) {
  const int d = GetParam();
  const std::size_t n = num_points({500, 3000, 2000, 500, 180, 90, 30});
  for (const bool is_rounded : {false, true}) {
    std::vector<double> points = make_point_set("uniform", d, n, 6),
                        weights = make_point_set("uniform", 1, n, 7);
    for (double& x : points) x = is_rounded ? std::round(8 * x) : x;
    for (double& w : weights) w = is_rounded ? std::round(4 * w) : 0.05 * w;
    Regular<> reference(points, weights, d, with_threads(1));
    for (const unsigned threads : {2u, 8u}) {
      Regular<> made(points, weights, d, with_threads(threads));
      expect_equal(made, reference);
      EXPECT_EQ(made.hidden_rows(), reference.hidden_rows());
    }
  }
}

// Batches of so many points in 7D and 8D are wrapped: cell ids do not depend on threads either.
TEST(Threads, WrappedBatches) {
  if (test::scale() == test::Scale::small) GTEST_SKIP() << "too slow where engines are not compiled for 7D";
  for (const int d : {7, 8}) {
    std::vector<double> points = make_point_set("clusters", d, d == 7 ? test::scaled_count(200) : 100, 5);
    points.insert(points.end(), points.begin(), points.begin() + 3 * d);  // duplicates
    const Delaunay<> reference(points, d, with_threads(1));
    const ComplexData data = reference.to_data(false);
    for (const unsigned threads : {2u, 3u, 8u}) {
      if (d == 8 && threads != 3) continue;
      SCOPED_TRACE(threads);
      const Delaunay<> made(points, d, with_threads(threads));
      EXPECT_EQ(made.statistics().threads, threads);
      EXPECT_EQ(made.hash(), reference.hash());
      EXPECT_EQ(made.num_duplicates(), 3u);
      const ComplexData data_made = made.to_data(false);
      EXPECT_EQ(data_made.cells, data.cells);
      EXPECT_EQ(data_made.neighbors, data.neighbors);
      EXPECT_EQ(data_made.vertex_of_point, data.vertex_of_point);
    }
  }
}

TEST(Threads, ResultsCanBeUsedAsAnyOther) {
  const std::vector<double> points = make_point_set("uniform", 3, 1500, 2),
                            more = make_point_set("uniform", 3, 300, 3);
  Delaunay<> made(points, 3, with_threads(4));
  EXPECT_TRUE(check(made.to_data()).ok);
  Delaunay<> reference(points, 3);
  for (std::size_t i = 0; i < more.size(); i += 3) {
    made.insert(std::span(more).subspan(i, 3));
    reference.insert(std::span(more).subspan(i, 3));
  }
  expect_equal(made, reference);
  EXPECT_TRUE(check(made.to_data()).ok);
  Delaunay<> copy = made.clone();
  made.compact();
  expect_equal(made, reference);
  expect_equal(copy, reference);
}

TEST(Threads, ProgressComesFromTheCallingThread) {
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
  const Delaunay<> made(make_point_set("uniform", 3, test::scaled_count(20000), 4), 3, options);
  EXPECT_EQ(others, 0);
}

TEST(Threads, CancelledBatchesChangeNothing) {
  const std::vector<double> points = make_point_set("uniform", 3, 3000, 2),
                            more = make_point_set("uniform", 3, test::scaled_count(30000), 3);
  std::atomic<int> calls_left = 1 << 30;
  Options options = with_threads(3);
  options.progress = [&](double) { return --calls_left > 0; };
  Delaunay<> made(points, 3, options);
  const CanonicalHash before = made.hash();
  for (int calls = 1; calls < 3; ++calls) {
    calls_left = calls;
    try {
      made.insert_range(more);
      break;  // it was too fast
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::cancelled);
      EXPECT_EQ(made.hash(), before);
      EXPECT_EQ(made.num_points(), 3000u);
    }
  }
  calls_left = 1 << 30;
  made.insert_range(more);
  EXPECT_TRUE(check(made.to_data()).ok);
}

}  // namespace
}  // namespace delone
