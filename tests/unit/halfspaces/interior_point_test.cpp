// SPDX-License-Identifier: BSD-3-Clause
// The linear program: what it finds is strictly inside, and what it names as a witness has no interior.
#include "halfspaces/interior_point.hpp"

#include "degenerate.hpp"
#include "halfspaces/intersection_arrays.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace delone::halfspaces {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using enum IntersectionState;

InteriorSearch search(const std::vector<double>& rows, int d) {
  std::vector<std::size_t> all(rows.size() / static_cast<std::size_t>(d + 1));
  std::iota(all.begin(), all.end(), std::size_t{0});
  return find_interior_point(rows, d, all);
}

void expect_inside(const std::vector<double>& rows, int d) {
  const InteriorSearch found = search(rows, d);
  ASSERT_EQ(found.state, full);
  EXPECT_THAT(found.witness, IsEmpty());
  for (std::size_t at = 0; at < rows.size(); at += static_cast<std::size_t>(d + 1))
    EXPECT_TRUE(is_strictly_inside(rows.data() + at, found.point)) << at;
}

/// The state, and a witness that has it by itself but not without any of its rows.
void expect_no_interior(IntersectionState state, const std::vector<double>& rows, int d) {
  const InteriorSearch found = search(rows, d);
  ASSERT_EQ(found.state, state);
  ASSERT_LE(found.witness.size(), static_cast<std::size_t>(d) + 1);
  EXPECT_TRUE(std::is_sorted(found.witness.begin(), found.witness.end()));
  EXPECT_EQ(find_interior_point(rows, d, found.witness).state, state);
  for (std::size_t i = 0; i < found.witness.size(); ++i) {
    std::vector<std::size_t> fewer = found.witness;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(find_interior_point(rows, d, fewer).state, full);
  }
}

TEST(InteriorPoint, OfPolytopesAndCones) {
  expect_inside({1, 0, -1, -1, 0, 0, 0, 1, -1, 0, -1, 0}, 2);  // the unit square
  expect_inside({-1, 0, 5, 0, -1, 7}, 2);                      // a quadrant
  expect_inside({1, 1, -1e-9, -1, -1, 0}, 2);                  // a narrow strip
  expect_inside({1, -1}, 1);
  expect_inside({1, 0, -1, 1, 0, -1, 2, 0, -2, 1, 0, -7}, 2);  // duplicates and redundant rows
  EXPECT_EQ(search({}, 3).state, full);
  EXPECT_THAT(search({}, 3).point.rounded, ElementsAre(0, 0, 0));
}

TEST(InteriorPoint, MaximizesTheDistance) {
  EXPECT_THAT(search({1, -1, -1, 0}, 1).point.rounded, ElementsAre(0.5));
  EXPECT_THAT(search({1, 0, -4, -1, 0, 0, 0, 1, -4, 0, -1, 0}, 2).point.rounded, ElementsAre(2, 2));
}

/// The largest t with n·x + c + w·t ≤ 0 for all rows of R²: the best of the common points of three rows that
/// satisfies the others. Rounded; −infinity where no three rows have one.
double largest_distance(const std::vector<double>& rows) {
  const std::size_t m = rows.size() / 3;
  const auto entry = [&](std::size_t r, std::size_t j) {
    if (j != 2) return rows[3 * r + std::min<std::size_t>(j, 2)];
    return std::ldexp(1, std::ilogb(std::max(std::fabs(rows[3 * r]), std::fabs(rows[3 * r + 1]))) + 1);
  };
  const auto det = [](const double(&a)[3][3]) {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  };
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < m; ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t c = 0; c < b; ++c) {
        double matrix[3][3], x[3];
        const std::size_t chosen[3] = {a, b, c};
        const auto fill = [&](std::size_t column) {  // with the right-hand side in one column
          for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
              matrix[i][j] = j == column ? -rows[3 * chosen[i] + 2] : entry(chosen[i], j);
          return det(matrix);
        };
        const double whole = fill(3);
        if (std::fabs(whole) < 1e-9) continue;
        for (std::size_t j = 0; j < 3; ++j) x[j] = fill(j) / whole;
        bool is_feasible = true;
        for (std::size_t r = 0; r < m; ++r)
          is_feasible = is_feasible &&
                        entry(r, 0) * x[0] + entry(r, 1) * x[1] + entry(r, 2) * x[2] + rows[3 * r + 2] < 1e-9;
        if (is_feasible) best = std::max(best, x[2]);
      }
  return best;
}

TEST(InteriorPoint, IsFarthestFromAllRows) {
  test::Random random(5);
  int states[3] = {};
  for (int run = 0; run < 300; ++run) {
    std::vector<double> rows = {1, 0, -9, -1, 0, -9, 0, 1, -9, 0, -1, -9};  // a square around the others
    for (int i = 0; i < 6; ++i) {
      const int x = random.integer(-3, 3);
      rows.insert(rows.end(), {static_cast<double>(x), x == 0 ? 1.0 : random.integer(-3, 3),
                               static_cast<double>(random.integer(run % 3 == 0 ? -9 : -2, 3))});
    }
    const double t = largest_distance(rows);
    const InteriorSearch found = search(rows, 2);
    ++states[static_cast<int>(found.state)];
    ASSERT_EQ(found.state, t > 1e-9 ? full : t < -1e-9 ? empty : flat) << run;
    if (found.state != full) {
      expect_no_interior(found.state, rows, 2);
      continue;
    }
    double least = t + 1;
    for (std::size_t r = 0; r < rows.size(); r += 3) {
      const double w = std::ldexp(1, std::ilogb(std::max(std::fabs(rows[r]), std::fabs(rows[r + 1]))) + 1);
      const double* x = found.point.rounded.data();
      least = std::min(least, -(rows[r] * x[0] + rows[r + 1] * x[1] + rows[r + 2]) / w);
    }
    EXPECT_NEAR(least, t, 1e-9) << run;
  }
  for (const int count : states) EXPECT_GT(count, 3);
}

TEST(InteriorPoint, OfSelectedRows) {
  const std::vector<double> rows = {1, -1, 1, 1, -1, -3, -1, -5};  // x ≤ 1, x ≤ −1, −x ≤ 3, −x ≤ 5
  EXPECT_THAT(find_interior_point(rows, 1, std::vector<std::size_t>{1, 3}).point.rounded, ElementsAre(-3));
  EXPECT_THAT(find_interior_point(rows, 1, std::vector<std::size_t>{0, 2}).point.rounded, ElementsAre(-1));
}

TEST(InteriorPoint, FlatIntersections) {
  expect_no_interior(flat, {1, 0, -1, 0}, 1);                   // x = 0
  expect_no_interior(flat, {1, 2, -3, 0, 1, 9, -2, -4, 6}, 2);  // a line
  expect_no_interior(flat, {-1, 0, 0, 0, -1, 0, 1, 1, 0}, 2);   // one point, three rows
  expect_no_interior(flat, {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 1, 1, 1, 0, 1, 0, 0, -1}, 3);
  EXPECT_THAT(search({0, 1, 9, 1, 2, -3, -2, -4, 6}, 2).witness, ElementsAre(1, 2));
  const std::vector<double> rows = {1, -9, 1, -1, 1, -5, -1, 1};
  EXPECT_THAT(find_interior_point(rows, 1, std::vector<std::size_t>{1, 2, 3}).witness, ElementsAre(1, 3));
}

TEST(InteriorPoint, EmptyIntersections) {
  expect_no_interior(empty, {1, 1, -1, 1}, 1);  // x ≤ −1 and x ≥ 1
  expect_no_interior(empty, {-1, 0, 0, 0, -1, 0, 1, 1, 1}, 2);
  expect_no_interior(empty, {0, 1, -9, 1, 0, 1, -1, 0, 1, 0, -1, -9}, 2);
  EXPECT_THAT(search({5, -5, 1, 1, -1, 1}, 1).witness, ElementsAre(1, 2));
}

// Between 1 and the next double there is no double: the fraction serves.
TEST(InteriorPoint, BetweenNeighboringDoubles) {
  const double next = std::nextafter(1.0, 2.0);
  const std::vector<double> rows = {-1, 1, 1, -next};
  expect_inside(rows, 1);
  const InteriorPoint p = search(rows, 1).point;
  EXPECT_FALSE(p.is_exact());
  ASSERT_EQ(p.exponent, 0);
  EXPECT_EQ(p.numerators[0] << 53, ((kernel::Integer(1) << 53) + 1) * p.denominator);
  EXPECT_TRUE(search({-1, 1, 1, -std::nextafter(next, 2.0)}, 1).point.is_exact());
  expect_no_interior(flat, {-1, 1, 1, -1}, 1);
  expect_no_interior(empty, {-1, next, 1, -1}, 1);
}

TEST(InteriorPoint, AtTheEndsOfTheRange) {
  expect_inside({1e300, -1e300, -1e300, 0}, 1);
  expect_inside({1e-300, -1e300, -1e-300, 0}, 1);  // up to 10⁶⁰⁰: beyond the doubles
  expect_inside({0x1p-1074, -0x1p-1074, -0x1p-1074, 0}, 1);
  expect_inside({1, 1e-300, -1e-300, -1, 0, 0, 0, -1, 0}, 2);
  expect_no_interior(empty, {1e300, 1e-300, -1e-300, 0x1p-1074}, 1);
  EXPECT_EQ(search({1, -0x1p-1074, -1, 0}, 1).state, full);
}

// Many rows through one point: ties of ratios in nearly every step.
TEST(InteriorPoint, OfDegenerateRows) {
  for (int d = 2; d <= 4; ++d) {
    std::vector<double> touching, cut;
    const test::PointSet normals = test::lattice(d, 3);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      std::vector<double> n;
      double sum = 0;
      for (int j = 0; j < d; ++j) {
        n.push_back(normals.points[i * static_cast<std::size_t>(d) + static_cast<std::size_t>(j)] - 1);
        sum += n.back();
      }
      if (sum <= 0) continue;  // all normals in one open halfspace: a cone with its apex at the origin
      touching.insert(touching.end(), n.begin(), n.end());
      touching.push_back(0);
    }
    expect_inside(touching, d);
    cut = touching;
    for (int j = 0; j < d; ++j) cut.push_back(-1);
    cut.push_back(0);  // Σx ≥ 0 leaves the apex
    expect_no_interior(flat, cut, d);
    cut.back() = 0x1p-1074;
    expect_no_interior(empty, cut, d);
  }
}

}  // namespace
}  // namespace delone::halfspaces
