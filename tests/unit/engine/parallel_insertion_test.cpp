// SPDX-License-Identifier: BSD-3-Clause
// Workers that are held up anywhere, and that fail anywhere: between two insertions, within a walk or a
// search, and after all cells are claimed. The triangulation is that of one thread, or nothing has changed.
#include "engine/parallel_insertion.hpp"

#include "engine_support.hpp"
#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <new>
#include <set>
#include <thread>
#include <vector>

namespace delone::engine {
namespace {

/// Now and then other threads go first, sometimes for long.
void maybe_wait() {
  static std::atomic<std::uint32_t> seeds = 1;
  thread_local std::uint32_t random = seeds.fetch_add(1) * 0x9e3779b9u;
  random = random * 1664525u + 1013904223u;
  if (random >> 21 == 0)
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  else if (random >> 28 == 0)
    std::this_thread::yield();
}

/// How many stars may be made until memory runs out.
std::atomic<int> stars_left = 1 << 30;

template <int K>
struct UnsteadyGeometry : geometry::DelaunayGeometry<K> {
  using Base = geometry::DelaunayGeometry<K>;
  using Base::Base;
  UnsteadyGeometry(const UnsteadyGeometry& shared, typename Base::ForThread form) : Base(shared, form) {}

  auto evaluator(const typename Base::Query& q) const {
    maybe_wait();
    return Base::evaluator(q);
  }
  void reserve_star(Index v, std::size_t facets) {
    maybe_wait();
    if (--stars_left < 0) throw std::bad_alloc();
    Base::reserve_star(v, facets);
  }
  auto create_star(Index v, const typename Base::Query& q, std::span<const HorizonFacet> facets) {
    maybe_wait();
    return Base::create_star(v, q, facets);
  }
};

/// Workers keep what they have claimed while they wait.
struct UnsteadyWorkers {
  template <class TakeTurn>
  void operator()(unsigned n, TakeTurn step) const {
    internal::run_workers(n, [&](unsigned w) {
      while (step(w) != Step::ended) maybe_wait();
    });
  }
};

template <int K>
struct Batches {
  using Geometry = UnsteadyGeometry<K>;

  Batches(const std::vector<double>& rows, double high)
      : num_points(rows.size() / K), points(rows, K, 0, high) {
    points.seed();
    for (Index v = K + 2; v <= num_first(); ++v) points.build.insert(v);
  }
  Index num_first() const { return std::min<Index>(static_cast<Index>(num_points), 8 * K); }
  void insert_rest(unsigned threads) {
    at.assign(num_points - num_first(), invalid_index);
    const std::vector<std::size_t> rounds{at.size() / 5, at.size()};
    const Batch batch{threads, num_first() + 1, at, rounds, [](std::size_t) {}};
    ParallelInsertion<K, Geometry, UnsteadyWorkers>(points.build.insertion_parts(), batch).insert_from(0);
  }

  std::size_t num_points;
  Points<K, Geometry> points;
  std::vector<Index> at;
};

template <int K>
void expect_that_of_one_thread(const std::vector<double>& rows, double high) {
  SCOPED_TRACE(K);
  stars_left = 1 << 30;
  Batches<K> one(rows, high);
  for (Index v = one.num_first() + 1; v <= one.num_points; ++v) ASSERT_EQ(one.points.build.insert(v), v);
  const auto expected = one.points.sphere();
  for (const unsigned threads : {2u, 3u, 7u}) {
    SCOPED_TRACE(threads);
    Batches<K> several(rows, high);
    several.insert_rest(threads);
    EXPECT_EQ(several.points.sphere(), expected);
    EXPECT_EQ(several.points.build.num_infinite(), one.points.build.num_infinite());
    for (std::size_t i = 0; i < several.at.size(); ++i) EXPECT_EQ(several.at[i], several.num_first() + 1 + i);
  }
}

template <int K>
void expect_nothing_where_memory_runs_out(const std::vector<double>& rows) {
  SCOPED_TRACE(K);
  stars_left = 1 << 30;
  Batches<K> batches(rows, 1);
  const auto before = batches.points.sphere();
  for (int stars = 0; stars < 60; stars += 1 + stars / 4) {
    batches.points.build.begin_batch();
    stars_left = stars;
    EXPECT_THROW(batches.insert_rest(3), std::bad_alloc);
    stars_left = 1 << 30;
    batches.points.build.undo_batch();
    EXPECT_EQ(batches.points.sphere(), before);
  }
  batches.insert_rest(3);
  Batches<K> one(rows, 1);
  for (Index v = one.num_first() + 1; v <= one.num_points; ++v) one.points.build.insert(v);
  EXPECT_EQ(batches.points.sphere(), one.points.sphere());
}

/// All points of {0, …, side − 1}^K, in an order that is none, a simplex that spans them first.
template <int K>
std::vector<double> lattice(int side) {
  std::vector<double> rows;
  std::set<std::vector<double>> seen;
  const auto add = [&](const std::vector<double>& point) {
    if (seen.insert(point).second) rows.insert(rows.end(), point.begin(), point.end());
  };
  add(std::vector<double>(K, 0));
  for (int i = 0; i < K; ++i) {
    std::vector<double> corner(K, 0);
    corner[static_cast<std::size_t>(i)] = side - 1;
    add(corner);
  }
  int count = 1;
  for (int i = 0; i < K; ++i) count *= side;
  for (int j = 0; j < count; ++j) {
    int number = static_cast<int>(j * 7919LL % count);
    std::vector<double> point(K);
    for (double& x : point) {
      x = number % side;
      number /= side;
    }
    add(point);
  }
  return rows;
}

TEST(ParallelInsertion, UniformPointsWhileWorkersWait) {
  expect_that_of_one_thread<3>(make_point_set("uniform", 3, test::scaled_count(700), 3), 1);
  expect_that_of_one_thread<5>(make_point_set("uniform", 5, test::scaled_count(120), 3), 1);
}

TEST(ParallelInsertion, LatticesWhileWorkersWait) {
  expect_that_of_one_thread<3>(lattice<3>(7), 6);
  expect_that_of_one_thread<5>(lattice<5>(2), 1);
}

TEST(ParallelInsertion, FailuresOfAnyWorkerChangeNothing) {
  expect_nothing_where_memory_runs_out<3>(make_point_set("uniform", 3, 200, 4));
  expect_nothing_where_memory_runs_out<5>(make_point_set("uniform", 5, 110, 4));
}

}  // namespace
}  // namespace delone::engine
