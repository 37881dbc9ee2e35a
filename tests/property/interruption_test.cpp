// SPDX-License-Identifier: BSD-3-Clause
// Calls that are stopped in the middle of exact arithmetic, whether they have options or not: what they were
// called on is as before, and goes on.
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/halfspaces.hpp>
#include <delone/progress.hpp>
#include <delone/trim.hpp>
#include <delone/voronoi.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

namespace delone {
namespace {

/// Coordinates of all exponents: only long integers decide.
std::vector<double> wild(std::size_t count, int largest_exponent, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> coordinates(count);
  for (double& x : coordinates) {
    const int exponent =
        static_cast<int>(random() % static_cast<unsigned>(2 * largest_exponent)) - largest_exponent;
    x = std::ldexp(static_cast<double>(random()) - 0x1p31, exponent);
  }
  return coordinates;
}

/// Calls work() in a scope that stops it when it asks for the `patience`-th time; whether it was stopped.
bool is_stopped(int patience, const std::function<void()>& work) {
  int calls = 0;
  const ProgressScope scope([&](double share) {
    EXPECT_TRUE(share >= 0 && share <= 1);
    return ++calls < patience;
  });
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::cancelled);
    return true;
  }
  return false;
}

TEST(Interruption, AnInsertionIsUndone) {
  const int d = 7;
  const auto first = wild(10 * d, 600, 1), more = wild(4 * d, 600, 2);
  Delaunay<> triangulation(first, d);
  const CanonicalHash before = triangulation.hash();
  for (int patience = 1; patience <= 3; ++patience) {
    if (!is_stopped(patience, [&] { triangulation.insert_range(more); })) break;
    EXPECT_EQ(triangulation.num_points(), 10u);
    EXPECT_EQ(triangulation.hash(), before);
  }
  triangulation.insert_range(more);
  std::vector<double> all = first;
  all.insert(all.end(), more.begin(), more.end());
  EXPECT_EQ(triangulation.hash(), Delaunay<>(all, d).hash());
}

TEST(Interruption, TheHullOfAnInterruptedInsertionIsAsBefore) {
  const int d = 8;
  const auto first = wild(10 * d, 600, 3), more = wild(4 * d, 600, 4);
  ConvexHull<> hull(first, d);
  const CanonicalHash before = hull.hash();
  for (int patience = 1; patience <= 3; ++patience) {
    if (!is_stopped(patience, [&] { hull.insert_range(more); })) break;
    EXPECT_EQ(hull.num_points(), 10u);
    EXPECT_EQ(hull.hash(), before);
  }
}

TEST(Interruption, QuestionsCanBeAskedAgain) {
  const int d = 8;
  const ConvexHull<> hull(wild(11 * d, 600, 5), d);
  const ConvexHull<> same = hull.clone();
  is_stopped(1, [&] { static_cast<void>(hull.num_facets()); });
  is_stopped(2, [&] { static_cast<void>(hull.to_data()); });
  EXPECT_EQ(hull.num_facets(), same.num_facets());
  EXPECT_EQ(hull.f_vector(), same.f_vector());
}

TEST(Interruption, EverythingThatTakesLongAsks) {
  std::mt19937 random(6);
  const auto numbers = [&](std::size_t count) {
    std::vector<double> x(count);
    for (double& each : x) each = static_cast<double>(random()) * 0x1p-32;
    return x;
  };
  std::vector<double> halfspaces;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 5; ++j) halfspaces.push_back(static_cast<double>(random()) * 0x1p-31 - 1);
    halfspaces.push_back(-1);
  }
  const HalfspaceIntersection<> intersection(halfspaces, 5);
  const Delaunay<> triangulation(numbers(1500), 5);
  const Delaunay<> plane(numbers(6000), 2);
  const Voronoi<> diagram(Delaunay<>(numbers(300), 5));
  // The first call is at once.
  EXPECT_TRUE(is_stopped(1, [&] { static_cast<void>(intersection.volume()); }));
  EXPECT_TRUE(is_stopped(1, [&] { static_cast<void>(triangulation.to_data()); }));
  EXPECT_TRUE(is_stopped(1, [&] { static_cast<void>(triangulation.hash()); }));
  EXPECT_TRUE(is_stopped(1, [&] { Voronoi<> made(triangulation); }));
  EXPECT_TRUE(is_stopped(1, [&] { static_cast<void>(diagram.region_volumes()); }));
  EXPECT_TRUE(is_stopped(1, [&] { static_cast<void>(diagram.ridge_volumes()); }));
  EXPECT_TRUE(is_stopped(1, [&] { static_cast<void>(trim(plane, 0.01)); }));
}

TEST(Interruption, DiagramsAskTheFunctionOfTheirOptions) {
  std::mt19937 random(8);
  std::vector<double> points(1500 * 4);
  for (double& x : points) x = static_cast<double>(random()) * 0x1p-32;
  const Delaunay<> triangulation(points, 4);
  int calls = 0;
  const auto stop = [&](double share) {
    EXPECT_TRUE(share >= 0 && share <= 1);
    return ++calls < 1;
  };
  const auto is_cancelled = [&](const auto& work) {
    calls = 0;
    try {
      work();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::cancelled);
      return calls == 1;
    }
    return false;
  };
  EXPECT_TRUE(is_cancelled([&] { Voronoi<> made(triangulation, {.progress = stop}); }));
  EXPECT_TRUE(is_cancelled([&] { Voronoi<> made(triangulation, {.tolerance = 0.01, .progress = stop}); }));
  const Voronoi<> made(triangulation, {.progress = [](double) { return true; }});
  EXPECT_EQ(made.num_regions(), 1500u);
}

TEST(Interruption, ProgressMovesWhileWrapping) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> points(220 * 7);
  for (double& x : points) x = normal(random);
  std::vector<double> shares;
  Options options;
  options.progress = [&](double share) { return shares.push_back(share), true; };
  const Delaunay<> triangulation(points, 7, options);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  ASSERT_GT(shares.size(), 4u);
  EXPECT_GT(shares[shares.size() / 2], shares.front());
  EXPECT_GT(shares.back(), 0.5);
}

}  // namespace
}  // namespace delone
