// SPDX-License-Identifier: BSD-3-Clause
// check() of data that say what they are: each kind is proved, and what is wrong with it is found.
#include "degenerate.hpp"

#include <delone/alpha.hpp>
#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/furthest_site.hpp>
#include <delone/lower_hull.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>
#include <delone/trim.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace delone {
namespace {

using ::testing::HasSubstr;

/// All levels are passed, and they are those of the kind.
void expect_proved(const ComplexData& data, DataKind kind, const char* not_examined = "") {
  ASSERT_EQ(data.kind, kind);
  const CheckReport report = check(data, {}, {.threads = 2});
  EXPECT_TRUE(report.ok) << name_of(kind) << ": " << report.violation;
  EXPECT_EQ(report.reached.number, check_levels(kind).back().number);
  EXPECT_EQ(report.reached.name, check_levels(kind).back().name);
  EXPECT_THAT(report.not_examined, HasSubstr(not_examined));
  if (*not_examined == '\0') {
    EXPECT_EQ(report.not_examined, "");
  }
}
template <class Damage>
void expect_found(ComplexData data, std::string_view level, const char* message, Damage damage) {
  damage(data);
  const CheckReport report = check(data);
  EXPECT_FALSE(report.ok) << level << ", " << message;
  EXPECT_EQ(report.reached.name, level) << report.violation;
  EXPECT_THAT(report.violation, HasSubstr(message));
}

template <class T>
void swap_corners(T& cells) {
  std::swap(cells[0], cells[1]);
}

TEST(CheckKinds, Triangulations) {
  for (const int d : {1, 2, 3, 4}) {
    const std::vector<double> points = test::small_integers(d, 60, -5, 5, 1).points;
    expect_proved(Delaunay<>(points, d).to_data(), DataKind::delaunay);
    expect_proved(FurthestSite<>(points, d).to_data(), DataKind::furthest_site);
    std::vector<double> weights(points.size() / static_cast<std::size_t>(d));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<double>(i % 7);
    expect_proved(Regular<>(points, weights, d).to_data(), DataKind::regular);
  }
}

TEST(CheckKinds, WordsAndArraysMustAgree) {
  const ComplexData good = Delaunay<>(make_point_set("uniform", 2, 30, 1), 2).to_data();
  expect_found(good, "storage", "a regular triangulation has weights, and these data have none",
               [](ComplexData& data) { data.kind = DataKind::regular; });
  expect_found(good, "storage", "a Delaunay triangulation has no weights",
               [](ComplexData& data) { data.weights.assign(30, 0); });
  expect_found(good, "storage", "they are a Voronoi diagram, which has other arrays",
               [](ComplexData& data) { data.kind = DataKind::voronoi; });
  expect_found(good, "storage", "a tolerance", [](ComplexData& data) { data.tolerance = 1; });
  expect_found(good, "local convexity", "outside the sphere",
               [](ComplexData& data) { data.kind = DataKind::furthest_site; });
  ComplexData line = Delaunay<>(std::vector<double>{1, 2}, 1).to_data();
  line.kind = DataKind::lower_hull;
  EXPECT_THAT(check(line).violation, HasSubstr("at least 2 coordinates"));
}

TEST(CheckKinds, OptionsThatContradictAreErrors) {
  const ComplexData good = Delaunay<>(make_point_set("uniform", 2, 30, 1), 2).to_data();
  EXPECT_THROW(check(good, {.furthest_site = true}), Error);
  const ComplexData lower = LowerHull<>(make_point_set("uniform", 3, 30, 1), 3).to_data();
  EXPECT_THROW(check(lower, {.canonical = true}), Error);
  EXPECT_THROW(check(lower, {.furthest_site = true}), Error);
  ComplexData furthest = FurthestSite<>(make_point_set("uniform", 2, 30, 1), 2).to_data();
  EXPECT_TRUE(check(furthest, {.canonical = true, .furthest_site = true}).ok);
  furthest.kind = DataKind::unknown;
  EXPECT_FALSE(check(furthest).ok);
  EXPECT_TRUE(check(furthest, {.furthest_site = true}).ok);
}

class CheckEnvelope : public ::testing::TestWithParam<int> {};  // the dimension
INSTANTIATE_TEST_SUITE_P(Dimensions, CheckEnvelope, ::testing::Values(2, 3, 4, 5));

TEST_P(CheckEnvelope, LowerAndUpperHulls) {
  const int d = GetParam();
  for (const bool degenerate : {false, true}) {
    const std::vector<double> points =
        degenerate ? test::small_integers(d, 80, -3, 3, 1).points : make_point_set("uniform", d, 80, 2);
    expect_proved(LowerHull<>(points, d).to_data(), DataKind::lower_hull);
    expect_proved(LowerHull<>(points, d, HullSide::upper).to_data(), DataKind::upper_hull);
    Options coarse;
    coarse.tolerance = degenerate ? 1.0 : 0.125;
    const LowerHull<> hull(points, d, HullSide::lower, coarse), upper(points, d, HullSide::upper, coarse);
    EXPECT_EQ(hull.to_data().tolerance, coarse.tolerance);
    expect_proved(hull.to_data(), DataKind::lower_hull);
    expect_proved(upper.to_data(), DataKind::upper_hull);
  }
}

TEST_P(CheckEnvelope, FlatCompositions) {
  const int d = GetParam();
  if (d < 3) return;
  // compositions on a line, and all of them one point
  std::vector<double> line, column;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < d - 1; ++j) {
      line.push_back(i % 9 + j);
      column.push_back(j);
    }
    line.push_back(i * i % 11);
    column.push_back(i * i % 11);
  }
  for (const auto& points : {line, column}) {
    expect_proved(LowerHull<>(points, d).to_data(), DataKind::lower_hull);
    expect_proved(LowerHull<>(points, d, HullSide::upper).to_data(), DataKind::upper_hull);
  }
  ComplexData wrong = LowerHull<>(column, d).to_data();
  wrong.kind = DataKind::upper_hull;
  EXPECT_FALSE(check(wrong).ok);
}

TEST_P(CheckEnvelope, FaultsAreFound) {
  const int d = GetParam();
  const LowerHull<> hull(make_point_set("uniform", d, 80, 2), d);
  const ComplexData good = hull.to_data();
  const auto stride = static_cast<std::size_t>(d);
  const auto height = [&](ComplexData& data, std::size_t row) -> double& {
    return data.points[row * stride + stride - 1];
  };
  ASSERT_GT(good.num_cells(), 1u);
  expect_found(good, "completeness", "below the hyperplane", [&](ComplexData& data) {
    std::size_t row = 0;  // no vertex
    while (std::find(data.cells.begin(), data.cells.end(), static_cast<SignedIndex>(row)) != data.cells.end())
      ++row;
    height(data, row) = -100;
  });
  expect_found(good, "local convexity", "above the hyperplane",
               [](ComplexData& data) { data.kind = DataKind::upper_hull; });
  expect_found(good, "storage", "vertex",
               [](ComplexData& data) { data.cells[0] = static_cast<SignedIndex>(data.num_points()); });
  if (d > 2) {
    expect_found(good, "incidence", "", [](ComplexData& data) { swap_corners(data.cells); });
  }
  ComplexData tolerant = good;  // the same point is near enough
  std::size_t row = 0;
  while (std::find(good.cells.begin(), good.cells.end(), static_cast<SignedIndex>(row)) != good.cells.end())
    ++row;
  const std::vector<double> composition(
      good.points.begin() + static_cast<std::ptrdiff_t>(row * stride),
      good.points.begin() + static_cast<std::ptrdiff_t>(row * stride + stride - 1));
  height(tolerant, row) = hull.heights(composition)[0] - 0.25;
  EXPECT_FALSE(check(tolerant).ok);
  tolerant.tolerance = 0.26;
  EXPECT_TRUE(check(tolerant).ok) << check(tolerant).violation;
  tolerant.tolerance = 0.24;
  EXPECT_THAT(check(tolerant).violation, HasSubstr("farther than the tolerance"));
}

TEST(CheckKinds, AlphaComplexes) {
  for (const int d : {1, 2, 3}) {
    const std::vector<double> points = test::small_integers(d, 50, -4, 4, 3).points;
    const Delaunay<> t(points, d);
    for (const double radius : {0.0, 0.6, 0.9, 1.3, 100.0}) {
      const AlphaComplex complex(t, radius);
      expect_proved(complex.to_data(), DataKind::alpha_complex, "the radius");
      expect_proved(complex.boundary_data(), DataKind::alpha_boundary, "the radius");
    }
    std::vector<double> weights(points.size() / static_cast<std::size_t>(d));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<double>(i % 5) / 4;
    const Regular<> weighted(points, weights, d);
    expect_proved(AlphaComplex(weighted, 0.8).to_data(), DataKind::alpha_complex, "the radius");
    expect_proved(AlphaComplex(weighted, 0.8).boundary_data(), DataKind::alpha_boundary, "the radius");
  }
}

TEST(CheckKinds, AlphaComplexesOfFlatPoints) {
  const test::PointSet flat = test::embedded(test::small_integers(2, 40, -4, 4, 5), 4, true, 2);
  const Delaunay<> t(flat.points, 4);
  ASSERT_EQ(t.affine_dimension(), 2);
  const AlphaComplex complex(t, 1e6);
  expect_proved(complex.to_data(), DataKind::alpha_complex, "the radius");
  expect_proved(complex.boundary_data(), DataKind::alpha_boundary, "the radius");
}

TEST(CheckKinds, FaultsOfAlphaComplexes) {
  const Delaunay<> t(make_point_set("uniform", 3, 60, 1), 3);
  const AlphaComplex complex(t, 0.25);
  const ComplexData good = complex.to_data();
  ASSERT_GT(good.num_cells(), 2u);
  expect_found(good, "incidence", "", [](ComplexData& data) {
    std::size_t at = 0;  // of a cell that has a neighbor
    while (data.neighbors[at] < 0) ++at;
    std::swap(data.cells[at - at % 4], data.cells[at - at % 4 + 1]);
    data.neighbors.clear();
  });
  expect_found(good, "part", "is none of the triangulation of all points", [](ComplexData& data) {
    data.cells = {data.cells[0], data.cells[1], data.cells[2], data.cells[3]};
    std::swap(data.cells[1], data.cells[2]);
    data.neighbors.clear();
    for (SignedIndex row = 0; row < 60; ++row)  // a cell with another vertex, oriented somehow
      if (std::find(data.cells.begin(), data.cells.end(), row) == data.cells.end()) data.cells[0] = row;
  });
  expect_found(good, "part", "is oriented the wrong way", [](ComplexData& data) {
    data.cells.resize(4);
    data.neighbors.clear();
    swap_corners(data.cells);
  });
  expect_found(good, "part", "the affine dimension is given as 2, but the points span 3",
               [](ComplexData& data) {
                 data.affine_dimension = 2;
                 data.cells.clear();
                 data.neighbors.clear();
               });
  expect_found(good, "part", "vertex_of_point of point 1",
               [](ComplexData& data) { data.vertex_of_point[1] = 0; });
  const ComplexData boundary = complex.boundary_data();
  expect_found(boundary, "closed", "the boundary is open",
               [](ComplexData& data) { data.cells.resize(data.cells.size() - 3); });
  expect_found(boundary, "closed", "not oriented", [](ComplexData& data) { swap_corners(data.cells); });
  ComplexData turned = boundary;
  swap_corners(turned.cells);
  EXPECT_TRUE(check(turned, {.oriented = false}).ok);
}

TEST(CheckKinds, TrimmedTriangulations) {
  std::vector<double> points = make_point_set("uniform", 2, 200, 1);
  for (std::size_t i = 0; i < 40; ++i) {  // a nearly straight border has flat cells
    points.push_back(static_cast<double>(i) / 39);
    points.push_back(-1e-6 * static_cast<double>(i % 3));
  }
  const TrimResult trimmed = trim(Delaunay<>(points, 2), 1e-4);
  ASSERT_GT(trimmed.num_removed, 0u);
  expect_proved(trimmed.data, DataKind::trimmed, "the tolerance");
  EXPECT_EQ(trim(Delaunay<>(points, 2), 0).data.kind, DataKind::delaunay);
  std::vector<double> weights(points.size() / 2, 1e-3);
  const TrimResult regular = trim(Regular<>(points, weights, 2), 1e-4);
  ASSERT_GT(regular.num_removed, 0u);
  expect_proved(regular.data, DataKind::trimmed, "the tolerance");
  const TrimResult furthest = trim(FurthestSite<>(points, 2), 1e-2);
  ASSERT_GT(furthest.num_removed, 0u);
  expect_proved(furthest.data, DataKind::trimmed, "the tolerance");
}

TEST(CheckKinds, CellsOfAHull) {
  for (const int d : {2, 3, 4}) {
    const HullData hull = ConvexHull<>(test::small_integers(d, 60, -3, 3, 1).points, d).to_data();
    ComplexData boundary;
    boundary.dimension = d;
    boundary.affine_dimension = d - 1;
    boundary.points = hull.points;
    boundary.cells = hull.cells;
    boundary.kind = DataKind::hull_boundary;
    expect_proved(boundary, DataKind::hull_boundary);
    expect_found(boundary, "support", "", [&](ComplexData& data) {
      for (int j = 0; j < d; ++j) data.points.push_back(100);
    });
  }
}

TEST(CheckKinds, RemovedRows) {
  Delaunay<> t(make_point_set("uniform", 2, 40, 1), 2);
  t.remove(3);
  t.remove(17);
  expect_proved(AlphaComplex(t, 0.2).to_data(), DataKind::alpha_complex, "the radius");
  FurthestSite<> furthest(make_point_set("uniform", 2, 40, 1), 2);
  furthest.remove(5);
  expect_proved(furthest.to_data(), DataKind::furthest_site);
}

}  // namespace
}  // namespace delone
