// SPDX-License-Identifier: BSD-3-Clause
// Hidden points, and ties between furthest sites. Cells by themselves: check_test.cpp.
#include <delone/check.hpp>
#include <delone/furthest_site.hpp>
#include <delone/regular.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace delone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The two cells of a square whose corners have weight 0, and a hidden point, row 4.
ComplexData square_with_hidden(double x, double y, double weight) {
  const std::vector<double> corners{0, 0, 4, 0, 0, 4, 4, 4};
  ComplexData data = Regular<>(corners, std::vector<double>(4, 0), 2).to_data();
  data.points.insert(data.points.end(), {x, y});
  data.weights.push_back(weight);
  data.vertex_of_point.push_back(-1);
  return data;
}

void expect_refused(const ComplexData& data, const char* message, const std::vector<std::size_t>& points,
                    bool canonical = false) {
  const CheckReport report = check(data, {.canonical = canonical});
  EXPECT_FALSE(report.ok) << message;
  EXPECT_EQ(report.reached.name, "completeness");
  EXPECT_THAT(report.violation, HasSubstr(message));
  EXPECT_EQ(report.points, points);
}

TEST(CheckHidden, PointsAreAboveTheirCell) {
  for (const double x : {0.5, 1.0, 3.5}) {
    EXPECT_TRUE(check(square_with_hidden(x, x, -100)).ok);
    // The lifted corners are in the plane of height 4x + 4y.
    const double tie = 2 * x * x - 8 * x;
    EXPECT_TRUE(check(square_with_hidden(x, x, tie)).ok);
    EXPECT_TRUE(check(square_with_hidden(x, x, std::nextafter(tie, -100))).ok);
    expect_refused(square_with_hidden(x, x, std::nextafter(tie, 100)),
                   "point 4 is given as hidden, but in conflict with cell", {4});
  }
}

TEST(CheckHidden, TiesAreThoseOfThePerturbation) {
  int num_visible = 0;
  for (const double x : {0.5, 2.0, 3.0})
    for (const double y : {0.0, 0.5, 3.5}) {
      const ComplexData data = square_with_hidden(x, y, x * x + y * y - 4 * x - 4 * y);
      EXPECT_TRUE(check(data).ok);
      if (Regular<>(data.points, data.weights, 2).num_hidden() == 1) {
        EXPECT_TRUE(check(data, {.canonical = true}).ok);
      } else {
        ++num_visible;
        expect_refused(data, "ties perturbed", {4}, true);
      }
    }
  EXPECT_GT(num_visible, 0);
}

TEST(CheckHidden, PointsAreInTheHullAndNoVertices) {
  for (const auto& [x, y] : {std::pair{-1.0, 2.0}, {5.0, 5.0}, {4.0, -1e-300}})
    expect_refused(square_with_hidden(x, y, -100), "point 4 is no vertex, but outside the hull", {4});
  EXPECT_TRUE(check(square_with_hidden(4, 1, -100)).ok) << "on an edge of the hull";
  expect_refused(square_with_hidden(4, 0, 0), "point 4 is given as hidden, but equal to the vertex 1",
                 {4, 1});
  EXPECT_TRUE(check(square_with_hidden(4, 0, -1)).ok) << "another point, with a smaller weight";
  expect_refused(square_with_hidden(4, 0, 1), "in conflict with cell", {4});
}

TEST(CheckHidden, OfOnePoint) {
  ComplexData data{2, 0, {1, 2, 1, 2}, {0}, {}, {0, -1}};
  data.kind = DataKind::regular;
  data.weights = {3, 2};
  EXPECT_TRUE(check(data).ok) << check(data).violation;
  data.weights = {3, 3};
  expect_refused(data, "equal to the vertex 0", {1, 0});
  data.weights = {2, 3};
  expect_refused(data, "in conflict with cell 0", {1});
}

TEST(CheckFurthestSites, TiesAreThoseOfThePerturbation) {
  ComplexData data = FurthestSite<>(std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}, 2).to_data();
  ASSERT_TRUE(check(data, {.canonical = true}).ok);
  // The other diagonal of the square.
  const bool has_rising = std::count(data.cells.begin(), data.cells.end(), 0) == 2;
  data.cells =
      has_rising ? std::vector<SignedIndex>{0, 1, 2, 1, 3, 2} : std::vector<SignedIndex>{0, 1, 3, 0, 3, 2};
  data.neighbors.clear();
  EXPECT_TRUE(check(data).ok);
  const CheckReport report = check(data, {.canonical = true});
  EXPECT_FALSE(report.ok);
  EXPECT_THAT(report.violation, HasSubstr("and outside when ties are perturbed"));
  EXPECT_THAT(report.cells, ElementsAre(0, 1));
}

}  // namespace
}  // namespace delone
