// SPDX-License-Identifier: BSD-3-Clause
// Calls that are stopped in the middle of exact arithmetic, by a ProgressScope or by their own function: what
// they were called on is as before, and goes on.
#include <delone/alpha.hpp>
#include <delone/alpha_shape.hpp>
#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/faces.hpp>
#include <delone/forecast.hpp>
#include <delone/halfspaces.hpp>
#include <delone/html.hpp>
#include <delone/measures.hpp>
#include <delone/natural_neighbors.hpp>
#include <delone/point_locator.hpp>
#include <delone/point_sets.hpp>
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

/// Sorting is in place: it asks until it writes to the first cell.
TEST(Interruption, CellsThatWereToBeSortedAreAsBefore) {
  const std::vector<double> points = make_point_set("uniform", 3, 40000, 7),
                            more = make_point_set("uniform", 3, 500, 8);
  Delaunay<> triangulation(points, 3, {.threads = 4});
  Delaunay<> same = triangulation.clone();
  const std::vector<SignedIndex> cells = triangulation.to_data().cells;
  for (int patience = 1; patience <= 20; ++patience) {
    const bool stopped = is_stopped(patience, [&] { triangulation.sort_cells(); });
    EXPECT_TRUE(stopped || patience > 1 || triangulation.statistics().threads < 2);
    if (!stopped) break;
    ASSERT_EQ(triangulation.to_data().cells, cells);
  }
  same.sort_cells();
  EXPECT_EQ(triangulation.to_data().cells, same.to_data().cells);
  triangulation.insert_range(more);
  same.insert_range(more);
  EXPECT_EQ(triangulation.hash(), same.hash());
  EXPECT_TRUE(check(triangulation.to_data()).ok);
}

TEST(Interruption, CopiesAsk) {
  const Delaunay<> triangulation(make_point_set("uniform", 3, 20000, 9), 3);
  EXPECT_TRUE(is_stopped(1, [&] { static_cast<void>(triangulation.clone()); }));
  EXPECT_EQ(triangulation.clone().hash(), triangulation.hash());
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

TEST(Interruption, DiagramsAskTheFunctionOfTheCall) {
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
  EXPECT_TRUE(is_cancelled([&] { Voronoi<> made(triangulation, {}, {.progress = stop}); }));
  EXPECT_TRUE(is_cancelled([&] { Voronoi<> made(triangulation, {.tolerance = 0.01}, {.progress = stop}); }));
  const Voronoi<> made(triangulation, {}, {.progress = [](double) { return true; }});
  EXPECT_EQ(made.num_regions(), 1500u);
}

TEST(Interruption, EveryCallWithAnExecutionAsksItsFunction) {
  std::mt19937 random(9);
  std::vector<double> points(2 * 6000);
  for (double& x : points) x = static_cast<double>(random()) * 0x1p-32;
  const Delaunay<> triangulation(points, 2);
  const ComplexData data = triangulation.to_data();
  const std::vector<double> few(points.begin(), points.begin() + 1000);
  const ConvexHull<> hull(few, 5);
  const HullData of_hull = hull.to_data();
  const Voronoi<> diagram(triangulation);
  const AlphaComplex alpha(triangulation, 0.01);
  const Box box = diagram.bounding_box();
  const PointLocator locator(triangulation);
  const LinearInterpolator linear(triangulation, std::span(points).first(6000));
  const NaturalNeighborCoordinates coordinates(triangulation);
  std::vector<double> values(6000), gradients(2 * 6000);
  const auto ignore = [](const auto&...) {};
  const std::vector<std::pair<const char*, std::function<void(const Execution&)>>> calls{
      {"hash", [&](const Execution& how) { triangulation.hash(how); }},
      {"canonical_hash", [&](const Execution& how) { canonical_hash(data, how); }},
      {"check", [&](const Execution& how) { check(data, {}, how); }},
      {"check of a hull", [&](const Execution& how) { check(of_hull, {}, how); }},
      {"check of a diagram", [&](const Execution& how) { check(diagram.to_data(), {}, how); }},
      {"trim", [&](const Execution& how) { trim(triangulation, 0.01, how); }},
      {"faces", [&](const Execution& how) { faces(triangulation, 1, how); }},
      {"circumradii", [&](const Execution& how) { circumradii(triangulation, how); }},
      {"circumcenters", [&](const Execution& how) { circumcenters(triangulation, how); }},
      {"qualities",
       [&](const Execution& how) { qualities(triangulation, QualityMeasure::radius_ratio, how); }},
      {"alpha_values", [&](const Execution& how) { alpha_values(triangulation, 1, how); }},
      {"alpha_filtration", [&](const Execution& how) { alpha_filtration(triangulation, how); }},
      {"AlphaComplex", [&](const Execution& how) { AlphaComplex(triangulation, 0.01, how); }},
      {"boundary_components", [&](const Execution& how) { boundary_components(alpha, how); }},
      {"polygons", [&](const Execution& how) { polygons(alpha, how); }},
      {"optimal_alpha_value", [&](const Execution& how) { optimal_alpha_value(triangulation, 1, how); }},
      {"Voronoi", [&](const Execution& how) { Voronoi<> made(triangulation, {}, how); }},
      {"ridge_volumes", [&](const Execution& how) { diagram.ridge_volumes(how); }},
      {"region_volumes", [&](const Execution& how) { diagram.region_volumes(how); }},
      {"volumes in a box", [&](const Execution& how) { diagram.region_volumes(box, how); }},
      {"clipped regions", [&](const Execution& how) { diagram.for_each_clipped_region(box, ignore, how); }},
      {"clipped_regions", [&](const Execution& how) { diagram.clipped_regions(box, {}, how); }},
      {"locate", [&](const Execution& how) { locator.locate(points, ignore, how); }},
      {"locate as arrays",
       [&](const Execution& how) { locator.locate(points, {}, CellNumbers(triangulation.complex()), how); }},
      {"cells_within",
       [&](const Execution& how) {
         locator.cells_within(
             points, 0.01, [](auto...) { return true; }, how);
       }},
      {"nearest",
       [&](const Execution& how) {
         locator.nearest(
             points, [](std::size_t, VertexId) {}, how);
       }},
      {"k nearest",
       [&](const Execution& how) {
         locator.nearest(
             points, 2, [](std::size_t, std::span<const VertexId>) {}, how);
       }},
      {"evaluate", [&](const Execution& how) { linear.evaluate(points, values, {}, how); }},
      {"gradients", [&](const Execution& how) { linear.gradients(points, gradients, {}, how); }},
      {"natural neighbors", [&](const Execution& how) { coordinates.find(points, ignore, false, how); }},
      {"natural neighbors' centers",
       [&](const Execution& how) { NaturalNeighborCoordinates made(triangulation, how); }},
      {"site gradients",
       [&](const Execution& how) {
         NaturalNeighborInterpolator made(triangulation, std::span(points).first(6000), 1, true, {}, how);
       }},
      {"f_vector", [&](const Execution& how) { hull.f_vector(how); }},
      {"to_html", [&](const Execution& how) { to_html(data, {}, how); }},
      {"forecast", [&](const Execution& how) { forecast(3, 100000, "sphere", {.progress = how.progress}); }},
      {"estimate", [&](const Execution& how) { estimate(points, 2, {.progress = how.progress}); }},
  };
  for (const unsigned threads : {1u, 3u})
    for (const auto& [name, call] : calls) {
      int asked = 0;
      const std::function<bool(double)> stop = [&](double share) {
        EXPECT_TRUE(share >= 0 && share <= 1) << name;
        ++asked;
        return false;
      };
      try {
        call({.threads = threads, .progress = stop});
        ADD_FAILURE() << name << " was not stopped, by " << threads << " threads";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Errc::cancelled) << name << ": " << error.what();
        EXPECT_EQ(asked, 1) << name;
      }
    }
}

TEST(Interruption, ProgressMovesWhileInterpolating) {
  std::mt19937 random(10);
  std::vector<double> points(3 * 400);
  for (double& x : points) x = static_cast<double>(random()) * 0x1p-32;
  const Delaunay<> triangulation(points, 3);
  const NaturalNeighborInterpolator natural(triangulation, std::span(points).first(400));
  std::vector<double> queries(3 * 5000), values(5000);
  for (double& x : queries) x = static_cast<double>(random()) * 0x1p-32;
  for (const bool in_scope : {false, true}) {
    std::vector<double> shares;
    const std::function<bool(double)> hear = [&](double share) { return shares.push_back(share), true; };
    const ProgressScope scope(in_scope ? hear : nullptr);
    natural.evaluate(queries, values, {}, {.progress = in_scope ? nullptr : hear});
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    ASSERT_GT(shares.size(), 4u);
    EXPECT_GT(shares[shares.size() / 2], shares.front());
    EXPECT_GT(shares.back(), 0.5);
  }
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
