// SPDX-License-Identifier: BSD-3-Clause
// What hulls with a tolerance promise, with rationals: no point is farther outside than the tolerance, the
// result depends on the set of points alone, and check() agrees.
#include "exact_distance.hpp"
#include "rounded_sets.hpp"

#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/halfspaces.hpp>
#include <delone/lower_hull.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace delone {
namespace {

void expect_promises(const std::vector<double>& points, int dimension, double tolerance) {
  const auto d = static_cast<std::size_t>(dimension);
  const ConvexHull<> hull(points, dimension, {.tolerance = tolerance});
  const HullData data = hull.to_data();
  EXPECT_EQ(data.tolerance, tolerance);
  EXPECT_LE(data.max_distance, tolerance);
  const CheckReport report = check(data);
  EXPECT_TRUE(report.ok) << report.violation;
  std::vector<const double*> vertices;
  for (const SignedIndex row : data.vertices)
    vertices.push_back(points.data() + static_cast<std::size_t>(row) * d);
  if (vertices.size() > 9 || dimension > 3) return;  // rationals are slow
  for (std::size_t at = 0; at < points.size(); at += d)
    EXPECT_TRUE(test::is_within(vertices, points.data() + at, d, data.max_distance)) << "row " << at / d;
}

void expect_independent_of_order(const std::vector<double>& points, int dimension, double tolerance) {
  const auto d = static_cast<std::size_t>(dimension);
  const auto summary = [&](const std::vector<double>& x, const Options& options) {
    const ConvexHull<> hull(x, dimension, options);
    std::set<std::set<std::vector<double>>> facets;
    const HullData& data = hull.data();
    for (std::size_t f = 0; f < data.num_facets(); ++f) {
      std::set<std::vector<double>> facet;
      for (SignedIndex i = data.facet_offsets[f]; i < data.facet_offsets[f + 1]; ++i) {
        const auto p = hull.point(static_cast<std::size_t>(data.facet_vertices[static_cast<std::size_t>(i)]));
        facet.emplace(p.begin(), p.end());
      }
      facets.insert(std::move(facet));
    }
    return std::tuple(hull.hash(), hull.affine_dimension(), hull.max_distance(), hull.axes(), facets);
  };
  const auto expected = summary(points, {.tolerance = tolerance});
  std::mt19937_64 random(9);
  std::vector<std::size_t> rows(points.size() / d);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  for (std::uint64_t round = 0; round < 3; ++round) {
    std::shuffle(rows.begin(), rows.end(), random);
    std::vector<double> shuffled;
    for (const std::size_t row : rows)
      shuffled.insert(shuffled.end(), points.begin() + static_cast<std::ptrdiff_t>(row * d),
                      points.begin() + static_cast<std::ptrdiff_t>((row + 1) * d));
    EXPECT_EQ(summary(shuffled, {.seed = round, .order = InsertionOrder::shuffled, .tolerance = tolerance}),
              expected);
  }
}

TEST(TolerantHull, KeepsItsPromisesOnTurnedShapes) {
  const test::Shape shapes[] = {test::subdivided_box("segment", {3}, 7, true),
                                test::subdivided_box("square", {1, 2}, 5, true),
                                test::subdivided_box("box", {1, 2, 0.7}, 3, false),
                                test::subdivided_box("sheet", {1, 2, 0}, 3, false),
                                test::subdivided_box("line", {1, 0, 0}, 6, false),
                                test::subdivided_box("flat box", {1, 1, 0, 0}, 2, false),
                                test::subdivided_box("lattice4", {2, 2, 2, 2}, 2, true)};
  const int affine_dimensions[] = {1, 2, 3, 2, 1, 2, 4};
  for (std::size_t i = 0; i < std::size(shapes); ++i)
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE(shapes[i].name);
      const std::vector<double> points = test::turned(shapes[i], seed);
      expect_promises(points, shapes[i].dimension, 1e-14);
      expect_independent_of_order(points, shapes[i].dimension, 1e-14);
      const ConvexHull<> hull(points, shapes[i].dimension, {.tolerance = 1e-14});
      const int k = hull.affine_dimension();
      EXPECT_EQ(k, affine_dimensions[i]);
      EXPECT_EQ(hull.num_vertices(), std::size_t{1} << k);
      EXPECT_EQ(hull.num_facets(), 2 * static_cast<std::size_t>(k));
      for (const double tolerance : {1e-16, 1e-15, 0.1, 0.4})
        expect_promises(points, shapes[i].dimension, tolerance);
    }
}

// In rationals, as above, where axes are multiplied by powers of two.
TEST(TolerantHull, KeepsTheTolerancesOfAxes) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (const std::vector<double>& wanted :
       {std::vector<double>{3e5, 4e-7}, {1e-3, 0.5}, {0.3, 5e8, 7e-9}, {1e-15, 0.1, 0.1}}) {
    const std::size_t d = wanted.size();
    std::vector<double> points(30 * d);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = 2 * wanted[i % d] * normal(random);
    const ConvexHull<> hull(points, static_cast<int>(d), {.axis_tolerances = wanted});
    HullData data = hull.to_data();
    EXPECT_TRUE(check(data).ok) << check(data).violation;
    EXPECT_LT(data.vertices.size(), ConvexHull<>(points, static_cast<int>(d)).num_vertices());
    const std::vector<double> used = hull.axis_tolerances();
    EXPECT_EQ(data.axis_tolerances, used);
    std::vector<double> scaled = points;
    for (std::size_t j = 0; j < d; ++j) {
      EXPECT_TRUE(wanted[j] / 2 < used[j] && used[j] <= wanted[j]);
      for (std::size_t i = j; i < scaled.size(); i += d) scaled[i] *= hull.tolerance() / used[j];
    }
    std::vector<const double*> vertices;
    for (const SignedIndex row : data.vertices)
      vertices.push_back(scaled.data() + static_cast<std::size_t>(row) * d);
    for (std::size_t at = 0; at < scaled.size(); at += d)
      EXPECT_TRUE(test::is_within(vertices, scaled.data() + at, d, data.max_distance)) << "row " << at / d;
    data.axis_tolerances[0] /= 2;
    EXPECT_FALSE(check(data).ok);
  }
}

TEST(TolerantHull, KeepsItsPromisesOnRandomPoints) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const int d : {1, 2, 3, 4, 5})
    for (const double scale : {1.0, 1e-300, 1e300}) {
      std::vector<double> points(static_cast<std::size_t>(12 + 4 * d) * static_cast<std::size_t>(d));
      for (double& x : points) x = scale * normal(random);
      points.insert(points.end(), points.begin(), points.begin() + d);  // a duplicate
      for (const double tolerance : {1e-12, 0.3, 1.0}) {
        if (d <= 3) expect_promises(points, d, scale * tolerance);
        expect_independent_of_order(points, d, scale * tolerance);
      }
    }
}

// So many vertices that a first choice is grown: round, on a few scales, on a sheet that is nearly flat, and
// with corners that are necessary.
TEST(TolerantHull, KeepsItsPromisesOnManyVertices) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (const int d : {2, 3, 4})
    for (const double stretch : {1.0, 1e-3, 1e4})
      for (const double scale : {1.0, 1e-290, 1e290}) {
        const auto width = static_cast<std::size_t>(d);
        std::vector<double> points(300 * width);
        for (std::size_t at = 0; at < points.size(); at += width) {
          double square = 0;
          for (std::size_t j = 0; j < width; ++j)
            square += (points[at + j] = normal(random)) * points[at + j];
          for (std::size_t j = 0; j < width; ++j) points[at + j] *= scale / std::sqrt(square);
          points[at] *= stretch;
        }
        std::vector<double> corner(width, 0.0);
        corner.back() = 3 * scale;
        points.insert(points.end(), corner.begin(), corner.end());
        for (const double tolerance : {1e-6, 0.02, 0.3}) {
          SCOPED_TRACE(testing::Message() << d << "D, " << stretch << ", " << scale << ", " << tolerance);
          expect_promises(points, d, scale * tolerance);
          if (stretch != 1) expect_independent_of_order(points, d, scale * tolerance);
        }
      }
}

// The ray from a point well inside through one that is close beneath the middle of a facet leaves by it.
TEST(TolerantHull, AQueryInsideHasTheCellThatItsRayLeavesBy) {
  for (const int n : {2, 4})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const std::vector<double> points =
          test::turned(test::subdivided_box("box", {1, 2, 0.7}, n, false), seed);
      const ConvexHull<3> hull(points, {.tolerance = 1e-14});
      const HullData& data = hull.data();
      const auto mean_of = [&](std::span<const SignedIndex> rows) {
        std::vector<double> mean(3, 0.0);
        for (const SignedIndex row : rows)
          for (std::size_t j = 0; j < 3; ++j)
            mean[j] += hull.point(static_cast<std::size_t>(row))[j] / static_cast<double>(rows.size());
        return mean;
      };
      const std::vector<double> middle = mean_of(data.vertices);
      for (std::size_t f = 0; f < data.num_facets(); ++f) {
        const auto begin = static_cast<std::size_t>(data.facet_offsets[f]);
        const auto end = static_cast<std::size_t>(data.facet_offsets[f + 1]);
        std::vector<double> q = mean_of(std::span(data.facet_vertices).subspan(begin, end - begin));
        for (std::size_t j = 0; j < 3; ++j) q[j] += 0x1p-10 * (middle[j] - q[j]);
        const Containment found = hull.locate(q);
        EXPECT_EQ(found.kind, Containment::Kind::inside);
        EXPECT_EQ(data.facet_of_cell[static_cast<std::size_t>(found.cell)], static_cast<SignedIndex>(f));
      }
    }
}

// Some are kept and many are dropped: the choice does not depend on the order of rows.
TEST(TolerantHull, OfASphereIsAFunctionOfTheSet) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::vector<double> points;
  for (int i = 0; i < 1500; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const double length = std::sqrt(x * x + y * y + z * z);
    points.insert(points.end(), {x / length, y / length, z / length});
  }
  for (const double tolerance : {1e-4, 1e-3, 1e-2}) {
    expect_promises(points, 3, tolerance);
    expect_independent_of_order(points, 3, tolerance);
  }
}

TEST(TolerantHull, ATinyToleranceIsTheExactHull) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> points(600);
  for (double& x : points) x = normal(random);
  EXPECT_EQ(ConvexHull(points, 3, {.tolerance = 1e-300}).hash(), ConvexHull(points, 3).hash());
}

TEST(TolerantHull, OfPointsWithinTheToleranceOfEachOther) {
  const std::vector<double> points{0, 0, 1, 0, 0, 1, 1, 1};
  const ConvexHull<> hull(points, 2, {.tolerance = 1});
  expect_promises(points, 2, 1);
  EXPECT_LE(hull.num_vertices(), 2u);
  ConvexHull<> point(2, {.tolerance = 1});
  for (const double x : {0.0, 0x1p-30, 0x1p-31}) point.insert(std::vector{x, 0.0});
  EXPECT_EQ(point.affine_dimension(), 0);
  EXPECT_EQ(point.num_vertices(), 1u);
  EXPECT_EQ(point.count(PointKind::boundary), 2u);
  EXPECT_EQ(point.locate(std::vector{0.5, 0.0}).kind, Containment::Kind::on_boundary);
  EXPECT_EQ(point.locate(std::vector{2.5, 0.0}).kind, Containment::Kind::outside_affine_hull);
}

TEST(TolerantHull, InsertionsChooseAnew) {
  std::vector<double> circle;
  for (int i = 0; i < 60; ++i) circle.insert(circle.end(), {std::cos(i * 0.1047), std::sin(i * 0.1047)});
  ConvexHull<> one_by_one(2, {.tolerance = 0.05}), ranges(2, {.tolerance = 0.05});
  for (std::size_t i = 0; i < 60; ++i) {
    one_by_one.insert(std::span(circle).subspan(2 * i, 2));
    if (i % 20 == 0) {
      ranges.insert_range(PointsView(std::span(circle).subspan(2 * i, 40), 2));
      EXPECT_GE(one_by_one.num_vertices(), 1u);
    }
  }
  const ConvexHull<> batch(circle, 2, {.tolerance = 0.05});
  EXPECT_LT(batch.num_vertices(), 20u);
  EXPECT_EQ(one_by_one.hash(), batch.hash());
  EXPECT_EQ(ranges.hash(), batch.hash());
  EXPECT_EQ(ranges.clone().hash(), batch.hash());
}

TEST(TolerantHull, ACancelledRangeLeavesTheHullAsItWas) {
  std::vector<double> outline;
  for (int i = 0; i < 3000; ++i) outline.insert(outline.end(), {1.0 * i, i * (3000.0 - i)});
  bool stop = false;
  ConvexHull<> hull(2, {.progress = [&](double) { return !stop; }, .tolerance = 0.5});
  hull.insert_range(std::vector<double>{0, 0, 1, 1, 5, 0});
  const CanonicalHash before = hull.hash();
  const std::size_t cells = hull.num_cells();
  stop = true;
  EXPECT_THROW(hull.insert_range(outline), Error);
  EXPECT_EQ(hull.num_points(), 3u);
  EXPECT_EQ(hull.num_cells(), cells);
  EXPECT_EQ(hull.hash(), before);
}

TEST(TolerantHull, BadTolerancesAreErrors) {
  const std::vector<double> points{0, 0, 1, 0, 0, 1};
  const auto expect_error = [](const auto& make, const char* text) {
    try {
      make();
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::invalid_argument);
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  for (const double tolerance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    expect_error([&] { ConvexHull(points, 2, {.tolerance = tolerance}); }, "not a finite number from 0 on");
    expect_error([&] { LowerHull(points, 2, HullSide::lower, {.tolerance = tolerance}); }, "not a finite");
    expect_error([&] { (void)LowerHull(points, 2).height_above(points, tolerance); }, "not a finite");
  }
  expect_error([&] { ConvexHull(points, 2, {.tolerance = 1.5}); }, "larger than the set of points");
  expect_error([&] { LowerHull(points, 2, HullSide::lower, {.tolerance = 1.5}); }, "larger than the range");
  expect_error([&] { Delaunay(points, 2, {.tolerance = 0.1}); }, "triangulations have no tolerance");
  expect_error([&] { HalfspaceIntersection(points, 1, {.tolerance = 0.1}); }, "have no tolerance");
  EXPECT_NO_THROW(ConvexHull(std::vector<double>{1, 1, 1, 1}, 2, {.tolerance = 1.5}));
}

TEST(TolerantHull, HeightsWithinTheToleranceAreZeroOnRequest) {
  const std::vector<double> points{0, 0, 1, 0x1p-40, 2, 0, 1, 1};
  const LowerHull<> hull(points, 2);
  EXPECT_EQ(hull.height_above(points)[1], 0x1p-40);
  EXPECT_EQ(hull.height_above(points, 1e-9), (std::vector<double>{0, 0, 0, 1}));
}

// Damage to what is promised is found.
TEST(TolerantHull, CheckFindsWhatIsBroken) {
  const std::vector<double> points = test::turned(test::subdivided_box("box", {1, 2, 3}, 3, false), 1);
  const HullData sound = ConvexHull(points, 3, {.tolerance = 1e-14}).to_data();
  ASSERT_TRUE(check(sound).ok) << check(sound).violation;
  const auto level_of = [&](auto damage) {
    HullData data = sound;
    damage(data);
    const CheckReport report = check(data);
    EXPECT_FALSE(report.ok);
    return std::string(report.reached.name);
  };
  EXPECT_EQ(level_of([](HullData& data) { data.max_distance = 1e-17; }), "support");
  EXPECT_EQ(level_of([](HullData& data) { data.max_distance = 1; }), "storage");
  EXPECT_EQ(level_of([](HullData& data) { data.tolerance = std::nan(""); }), "storage");
  EXPECT_EQ(level_of([](HullData& data) { data.axes = {0, 1}; }), "convexity");
  EXPECT_EQ(level_of([](HullData& data) { data.points[0] += 1; }), "support");
  EXPECT_EQ(level_of([](HullData& data) { data.tolerance = data.max_distance = 0; }), "convexity");
  std::size_t cell = 0;
  while (std::count(sound.facet_of_cell.begin(), sound.facet_of_cell.end(), sound.facet_of_cell[cell]) < 2)
    ++cell;
  EXPECT_NE(
      level_of([&](HullData& data) { data.facet_of_cell[cell] = data.facet_of_cell[cell] == 0 ? 1 : 0; }),
      "storage");
}

}  // namespace
}  // namespace delone
