// SPDX-License-Identifier: BSD-3-Clause
// Intersections of halfspaces that are degenerate on purpose: redundant, touching and repeated rows, flat and
// empty intersections of every dimension, one unit in the last place to either side, entries at the ends of
// the exponent range.
#include "scale.hpp"

#include <gtest/gtest.h>
#include <delone/check.hpp>
#include <delone/halfspaces.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace {

using namespace delone;
using namespace delone::test;
using Rows = std::vector<SignedIndex>;

/// Halfspaces around the origin with small integers.
std::vector<double> small_integer_rows(std::mt19937& random, int d, int m) {
  std::uniform_int_distribution<int> entry(-3, 3);
  std::vector<double> rows;
  for (int r = 0; r < m; ++r) {
    for (int j = 0; j < d; ++j) rows.push_back(entry(random));
    rows.push_back(-1 - static_cast<double>(random() % 3));
  }
  return rows;
}

std::map<Rows, std::vector<double>> vertices_by_facets(const IntersectionData& data) {
  std::map<Rows, std::vector<double>> result;
  for (std::size_t v = 0; v < data.num_vertices(); ++v)
    result.emplace(Rows(data.halfspaces_of_vertex(v).begin(), data.halfspaces_of_vertex(v).end()),
                   std::vector<double>(data.vertex(v).begin(), data.vertex(v).end()));
  return result;
}

void expect_proven(const HalfspaceIntersectionBase& found) {
  const CheckReport report = check(found.to_data());
  EXPECT_TRUE(report.ok) << report.violation;
}

TEST(HalfspaceDegenerate, RedundantRowsChangeNothing) {
  std::mt19937 random(31);
  for (std::size_t repeat = 0; repeat < scaled_count(30); ++repeat) {
    const int d = 2 + static_cast<int>(repeat % 3);
    const auto width = static_cast<std::size_t>(d) + 1;
    std::vector<double> rows = small_integer_rows(random, d, 5 + 3 * d);
    const HalfspaceIntersection plain(rows, d);
    const IntersectionData& data = plain.data();
    const std::size_t m = plain.num_halfspaces();
    if (data.rank < d) continue;
    std::vector<HalfspaceKind> expected;
    for (const SignedIndex r : data.facet_halfspaces) {
      const std::vector<double> row(&rows[static_cast<std::size_t>(r) * width],
                                    &rows[static_cast<std::size_t>(r) * width] + width);
      for (const double x : row) rows.push_back(3 * x);
      expected.push_back(HalfspaceKind::duplicate);
      for (std::size_t j = 0; j < width; ++j) rows.push_back(j + 1 < width ? row[j] : 2 * row[j]);
      expected.push_back(HalfspaceKind::redundant);
    }
    for (std::size_t v = 0; v < data.num_vertices();
         ++v) {  // the sum of the rows of a vertex touches there, and nowhere else
      std::vector<double> sum(width, 0.0);
      for (const SignedIndex r : data.halfspaces_of_vertex(v))
        for (std::size_t j = 0; j < width; ++j) sum[j] += rows[static_cast<std::size_t>(r) * width + j];
      rows.insert(rows.end(), sum.begin(), sum.end());
      expected.push_back(HalfspaceKind::touching);
    }
    rows.insert(rows.end(), width, 0.0);
    expected.push_back(HalfspaceKind::trivial);
    const HalfspaceIntersection more(rows, d);
    EXPECT_EQ(vertices_by_facets(more.data()), vertices_by_facets(data));
    EXPECT_EQ(more.data().facet_halfspaces, data.facet_halfspaces);
    EXPECT_EQ(more.data().num_rays(), data.num_rays());
    for (std::size_t r = 0; r < m; ++r) EXPECT_EQ(more.data().kinds[r], data.kinds[r]) << r;
    for (std::size_t r = m; r < more.num_halfspaces(); ++r)
      EXPECT_TRUE(more.data().kinds[r] == expected[r - m] || more.data().kinds[r] == HalfspaceKind::duplicate)
          << r;
    expect_proven(more);
    if (HasFailure()) FAIL() << "dimension " << d << ", repeat " << repeat;
  }
}

TEST(HalfspaceDegenerate, FlatAndEmptyInEveryDimension) {
  constexpr double below = 1 - 0x1p-53, above = 1 + 0x1p-52;
  for (int d = 1; d <= 4; ++d)
    for (int k = 0; k < d; ++k) {
      // |x_j| ≤ 1 for j < k; x_j ≤ 1 and x_j ≥ low for the others.
      const auto rows = [&](double low) {
        std::vector<double> result;
        for (int j = 0; j < d; ++j)
          for (const double sign : {1.0, -1.0}) {
            for (int c = 0; c < d; ++c) result.push_back(c == j ? sign : 0.0);
            result.push_back(j >= k && sign < 0 ? low : -1.0);
          }
        return result;
      };
      const HalfspaceIntersection flat(rows(1), d), empty(rows(above), d), thin(rows(below), d);
      EXPECT_EQ(flat.state(), IntersectionState::flat);
      EXPECT_EQ(empty.state(), IntersectionState::empty);
      EXPECT_EQ(thin.state(), IntersectionState::full);
      for (const HalfspaceIntersectionBase* none : {&flat, &empty}) {
        expect_proven(*none);
        EXPECT_EQ(none->witness().size(), 2u);
        EXPECT_EQ(none->witness()[0] + 1, none->witness()[1]);
        EXPECT_GE(none->witness()[0], 2 * k);
        EXPECT_EQ(none->num_vertices(), 0u);
        EXPECT_EQ(none->volume().value, 0);
      }
      // No double is strictly between two neighbors.
      EXPECT_FALSE(thin.data().interior_point_is_exact);
      EXPECT_EQ(thin.num_vertices(), std::size_t{1} << d);
      expect_proven(thin);
      std::vector<double> point(static_cast<std::size_t>(d), 0.0);
      std::fill(point.begin() + k, point.end(), 1.0);
      for (const double low : {1.0, above, below}) {
        try {
          const HalfspaceIntersection given(rows(low), d, point);
          ADD_FAILURE() << "on the border";
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), Errc::invalid_argument);
          EXPECT_EQ(error.rows().front(), static_cast<std::size_t>(2 * k));
        }
      }
      // From flat to full is not far: without one row each there is an interior again.
      std::vector<double> open;
      for (std::size_t r = 0; r < static_cast<std::size_t>(k + d); ++r) {
        const std::vector<double> all = rows(1);
        const std::size_t row =
            r < static_cast<std::size_t>(2 * k) ? r : 2 * r - static_cast<std::size_t>(2 * k);
        open.insert(open.end(),
                    all.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(d + 1)),
                    all.begin() + static_cast<std::ptrdiff_t>((row + 1) * static_cast<std::size_t>(d + 1)));
      }
      const HalfspaceIntersection again(open, d);
      EXPECT_EQ(again.num_vertices(), std::size_t{1} << k);
      EXPECT_FALSE(again.is_bounded());
      expect_proven(again);
    }
}

TEST(HalfspaceDegenerate, ContradictoryRows) {
  // x + y ≤ −1 with x, y ≥ 0, and a crowd around that takes no part.
  std::vector<double> rows{-1, 0, 0, 0, -1, 0, 1, 1, 1};
  for (int i = 0; i < 50; ++i)
    for (const double x : {std::cos(i), std::sin(i), -10.0}) rows.push_back(x);
  const HalfspaceIntersection empty(rows, 2);
  EXPECT_EQ(empty.state(), IntersectionState::empty);
  EXPECT_EQ(Rows(empty.witness().begin(), empty.witness().end()), (Rows{0, 1, 2}));
  expect_proven(empty);
  rows.resize(6);
  HalfspaceIntersection quadrant(rows, 2);
  EXPECT_EQ(quadrant.state(), IntersectionState::full);
  EXPECT_THROW(quadrant.insert_range(std::vector<double>{1, 1, 1}), Error);
  EXPECT_EQ(quadrant.num_vertices(), 1u);
  // 0 ≤ −1
  const HalfspaceIntersection never(std::vector<double>{1, 0, -1, 0, 0, 1}, 2);
  EXPECT_EQ(never.state(), IntersectionState::empty);
  EXPECT_EQ(Rows(never.witness().begin(), never.witness().end()), Rows{1});
}

TEST(HalfspaceDegenerate, OneUlpAtACorner) {
  for (int d = 2; d <= 5; ++d) {
    std::vector<double> rows;
    for (int j = 0; j < d; ++j)
      for (const double sign : {-1.0, 1.0}) {
        for (int c = 0; c < d; ++c) rows.push_back(c == j ? sign : 0.0);
        rows.push_back(-1);
      }
    const std::size_t corners = std::size_t{1} << d, last = rows.size() / static_cast<std::size_t>(d + 1);
    rows.insert(rows.end(), static_cast<std::size_t>(d), 1.0);
    rows.push_back(-d);
    const auto expect = [&](std::size_t vertices, HalfspaceKind kind) {
      const HalfspaceIntersection found(rows, d);
      EXPECT_EQ(found.num_vertices(), vertices) << d;
      EXPECT_EQ(found.data().kinds[last], kind) << d;
      expect_proven(found);
    };
    expect(corners, HalfspaceKind::touching);
    rows.back() = std::nextafter(-d, -10.0);
    expect(corners, HalfspaceKind::redundant);
    rows.back() = std::nextafter(-d, 0.0);
    expect(corners - 1 + static_cast<std::size_t>(d), HalfspaceKind::facet);
  }
}

TEST(HalfspaceDegenerate, PowersOfTwoScaleTheResult) {
  std::mt19937 random(32);
  for (std::size_t repeat = 0; repeat < scaled_count(20); ++repeat) {
    const int d = 2 + static_cast<int>(repeat % 2);
    const auto width = static_cast<std::size_t>(d) + 1;
    const std::vector<double> rows = small_integer_rows(random, d, 12);
    const IntersectionData data = HalfspaceIntersection(rows, d).to_data();
    // Coordinate j becomes 2^e_j times as large; then the rows become as short as doubles can be, or long.
    const std::vector<int> exponents =
        repeat % 2 == 0 ? std::vector<int>{990, -990, 0} : std::vector<int>{-500, 400, -30};
    for (const bool denormal : {false, true}) {
      std::vector<double> scaled = rows;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t j = i % width;
        scaled[i] = denormal        ? std::ldexp(rows[i], -1074)
                    : j + 1 < width ? std::ldexp(rows[i], -exponents[j])
                                    : rows[i];
      }
      const HalfspaceIntersection found(scaled, d);
      std::map<Rows, std::vector<double>> expected = vertices_by_facets(data);
      if (!denormal)
        for (auto& [facets, x] : expected)
          for (std::size_t j = 0; j < x.size(); ++j) x[j] = std::ldexp(x[j], exponents[j]);
      EXPECT_EQ(vertices_by_facets(found.data()), expected);
      EXPECT_EQ(found.data().kinds, data.kinds);
      expect_proven(found);
    }
    if (HasFailure()) FAIL() << "dimension " << d << ", repeat " << repeat;
  }
}

}  // namespace
