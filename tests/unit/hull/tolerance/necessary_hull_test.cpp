// SPDX-License-Identifier: BSD-3-Clause
// The hull of the necessary points is what the exact hull of all points leads to.
#include "hull/tolerance/necessary_hull.hpp"

#include "hull/tolerance/tolerant_hull.hpp"
#include "rounded_sets.hpp"
#include "scale.hpp"

#include <delone/convex_hull.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

namespace delone::hull {
using internal::AxisScale;

namespace {

std::vector<double> random_points(int d, std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> points(n * static_cast<std::size_t>(d));
  for (double& x : points) x = normal(random);
  return points;
}

Options within(double tolerance) {
  Options options;
  options.tolerance = tolerance;
  return options;
}

std::set<std::vector<double>> vertices_of(const HullState& state) {
  std::set<std::vector<double>> vertices;
  for (const Index site : state.hull().cells)
    vertices.emplace(state.sites().point(site), state.sites().point(site) + state.sites().ambient);
  return vertices;
}

/// Whether the route was taken; if it was, expects the hull that the other one leads to.
bool agrees_if_found(const std::vector<double>& points, int d, double tolerance) {
  const auto found = find_necessary_hull(points, d, AxisScale(tolerance), {});
  if (!found) return false;
  HullState exact(d);
  exact.insert_range(points, {});
  const TolerantHull reference(exact, AxisScale(tolerance), {}, false);
  EXPECT_EQ(vertices_of(*found->state), vertices_of(reference.state()));
  EXPECT_EQ(found->state->hull().num_cells(), reference.state().hull().num_cells());
  EXPECT_EQ(found->rows.size(), found->state->num_rows());
  std::set<std::vector<double>> rows;
  for (std::size_t i = 0; i < found->rows.size(); ++i) {
    const double* const p = points.data() + found->rows[i] * static_cast<std::size_t>(d);
    EXPECT_TRUE(std::equal(p, p + d, found->state->point_of_row(i)));
    EXPECT_TRUE(rows.emplace(p, p + d).second);
    for (Index row = 0; row < found->rows[i]; ++row)  // the first of equal ones
      EXPECT_FALSE(std::equal(p, p + d, points.data() + row * static_cast<std::size_t>(d)));
  }
  return true;
}

TEST(NecessaryHull, OfTurnedShapes) {
  const std::size_t seeds = test::scaled_size(3, 1);
  int found = 0;
  for (const auto& shape :
       {test::subdivided_box("box", {1, 2, 0.5}, 5, false),
        test::subdivided_box("4D", {1, 2, 0.5, 3}, 3, true), test::l_prism(), test::chamfered_hexagon()})
    for (std::uint64_t seed = 0; seed < seeds; ++seed)
      for (const double tolerance : {1e-14, 1e-13, 1e-3}) {
        const std::vector<double> points = test::turned(shape, seed);
        const bool agrees = agrees_if_found(points, shape.dimension, tolerance);
        if (tolerance > 1e-14) {
          EXPECT_TRUE(agrees) << shape.name << ' ' << tolerance;
        }
        found += agrees;
      }
  EXPECT_GT(found, 8 * static_cast<int>(seeds));
}

TEST(NecessaryHull, OfRandomPointsAndLattices) {
  for (int d = 2; d <= 5; ++d)
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      EXPECT_TRUE(agrees_if_found(random_points(d, 150, seed), d, 1e-13));
      std::vector<double> lattice = random_points(d, 200, seed);
      for (double& x : lattice) x = std::nearbyint(x) / 7;
      agrees_if_found(lattice, d, 1e-13);
      agrees_if_found(random_points(d, 80, seed), d, 0.3);
    }
}

TEST(NecessaryHull, NoneWhereBinary64ProvesLess) {
  std::vector<double> flat = random_points(3, 100, 1);
  for (std::size_t i = 0; i < flat.size(); i += 3) flat[i + 2] = 0.25 * flat[i];
  EXPECT_FALSE(find_necessary_hull(flat, 3, AxisScale(1e-13), {}));
  for (std::size_t i = 0; i < flat.size(); i += 3) flat[i + 2] = 1e-9 * flat[i + 2] * flat[i + 1];
  EXPECT_FALSE(find_necessary_hull(flat, 3, AxisScale(1e-13), {}));
  std::vector<double> huge = random_points(3, 100, 2);
  EXPECT_FALSE(find_necessary_hull(huge, 3, AxisScale(5), {}));
  for (double& x : huge) x *= 0x1p1000;
  EXPECT_FALSE(find_necessary_hull(huge, 3, AxisScale(0x1p960), {}));
  EXPECT_FALSE(find_necessary_hull(random_points(3, 10, 2), 3, AxisScale(1e-13), {}));
  EXPECT_FALSE(find_necessary_hull(random_points(1, 100, 2), 1, AxisScale(1e-13), {}));
}

TEST(NecessaryHull, OfScaledColumnsIsThatOfTheSameRows) {
  const auto box = test::turned(test::subdivided_box("box", {1, 2, 0.5}, 6, false), 2);
  for (const std::vector<double>& points : {box, random_points(3, 300, 4)}) {
    const auto plain = find_necessary_hull(points, 3, AxisScale(1e-13), {});
    ASSERT_TRUE(plain);
    const std::array<double, 3> units{0x1p40, 1, 0x1p-70};
    std::vector<double> scaled = points, tolerances;
    for (std::size_t i = 0; i < points.size(); ++i) scaled[i] *= units[i % 3];
    for (const double unit : units) tolerances.push_back(1e-13 * unit);
    const auto found = find_necessary_hull(scaled, 3, AxisScale(0, tolerances, 3), {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->rows, plain->rows);
    EXPECT_EQ(found->state->num_rows(), plain->state->num_rows());
    EXPECT_EQ(found->state->hull().num_cells(), plain->state->hull().num_cells());
    for (std::size_t row = 0; row < found->rows.size(); ++row)
      EXPECT_TRUE(std::equal(units.begin(), units.end(), found->state->point_of_row(row),
                             [&, p = plain->state->point_of_row(row)](double unit, double x) mutable {
                               return x == *p++ * unit;
                             }));
  }
}

TEST(NecessaryHull, TakesMorePointsLikeTheHullOfAll) {
  const std::vector<double> points = test::turned(test::subdivided_box("box", {1, 2, 0.5}, 6, false), 3);
  const std::vector<double> more{0.1, 0.2, 5, 7, 0.5, 0.5};
  constexpr double tolerance = 1e-13;
  ASSERT_TRUE(find_necessary_hull(points, 3, AxisScale(tolerance), {}));
  ConvexHull<3> hull(within(tolerance)), reference(within(tolerance));
  const auto rows = hull.insert_extreme_points(PointsView(points, 3));
  reference.insert_range(PointsView(points, 3));
  EXPECT_EQ(hull.num_vertices(), 8);
  EXPECT_EQ(hull.hash(), reference.hash());
  EXPECT_EQ(hull.num_points(), rows.size());
  EXPECT_GT(hull.max_distance(), 0);
  EXPECT_EQ(hull.max_distance(), reference.max_distance());
  EXPECT_LE(hull.data().max_distance, tolerance);

  ConvexHull<3> copy = hull.clone();
  EXPECT_EQ(copy.hash(), reference.hash());
  EXPECT_EQ(copy.max_distance(), reference.max_distance());
  EXPECT_EQ(copy.insert(std::array{0.1, 0.2, 5.0}).row, rows.size());
  EXPECT_EQ(copy.insert(std::array{7.0, 0.5, 0.5}).row, rows.size() + 1);
  hull.insert_range(PointsView(more, 3));
  reference.insert_range(PointsView(more, 3));
  EXPECT_EQ(hull.hash(), reference.hash());
  EXPECT_EQ(copy.hash(), reference.hash());
  EXPECT_EQ(hull.num_points(), rows.size() + 2);
  EXPECT_THROW(hull.insert_extreme_points(PointsView(points, 3)), Error);
}

TEST(NecessaryHull, CanBeCancelled) {
  const std::vector<double> points = test::turned(test::subdivided_box("box", {1, 2, 0.5}, 6, false), 3);
  const Options options{.progress = [](double) { return false; }};
  EXPECT_THROW(find_necessary_hull(points, 3, AxisScale(1e-13), options), Error);
}

// A polygon with a vertical edge on the right. One more point is the rightmost one, but nearer to that edge
// than the tolerance.
TEST(NecessaryHull, NoVertexIsKeptThatIsNearTheOthers) {
  constexpr std::size_t n = 96;
  constexpr double tolerance = 1e-6, pi = 3.14159265358979;
  std::vector<double> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * pi * (static_cast<double>(i) + 0.5) / n;
    points.insert(points.end(), {std::cos(angle), std::sin(angle)});
  }
  points[2 * n - 2] = points[0];
  EXPECT_TRUE(agrees_if_found(points, 2, tolerance));
  for (const double share : {0.5, 2.0})
    for (const std::size_t at : {std::size_t{0}, n / 2, n}) {
      std::vector<double> more = points;
      more.insert(more.begin() + static_cast<std::ptrdiff_t>(2 * at), {points[0] + share * tolerance, 0});
      EXPECT_EQ(agrees_if_found(more, 2, tolerance), share > 1) << share << ' ' << at;
    }
}

}  // namespace
}  // namespace delone::hull
