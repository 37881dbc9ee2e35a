// SPDX-License-Identifier: BSD-3-Clause
// The predicates for callers outside the engine: affine hulls, public functions and their errors.
#include "kernel/predicates.hpp"

#include "base/random.hpp"
#include "brute_force.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <delone/error.hpp>
#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::kernel {
namespace {

TEST(AffineHull, FindsDimensionAndAxes) {
  AffineHull hull(3);
  EXPECT_EQ(hull.dimension(), -1);
  const double p[] = {1, 1, 1}, q[] = {1, 1, 3}, r[] = {1, 1, 2}, s[] = {2, 2, 5}, t[] = {4, 4, 0},
               u[] = {0, 1, 0};
  EXPECT_TRUE(hull.add(p));
  EXPECT_FALSE(hull.add(p));
  EXPECT_TRUE(hull.add(q));
  EXPECT_EQ(hull.axes(), (std::vector<int>{2}));
  EXPECT_TRUE(hull.contains(r));
  EXPECT_FALSE(hull.add(r));
  EXPECT_TRUE(hull.add(s));
  EXPECT_EQ(hull.axes(), (std::vector<int>{0, 2}));
  EXPECT_FALSE(hull.add(t));
  EXPECT_TRUE(hull.add(u));
  EXPECT_EQ(hull.dimension(), 3);
}

TEST(AffineHull, HasTheRankOfItsPoints) {
  random::Generator generator(1);
  for (std::size_t round = 0; round < test::scaled_count(300); ++round) {
    const int d = 1 + static_cast<int>(generator.below(5)), n = 1 + static_cast<int>(generator.below(7));
    std::vector<double> points = random_numbers(static_cast<std::size_t>(n * d), round % 6, generator);
    if (round % 2 == 0 && n > 2)  // a point on the line of two others
      for (std::size_t j = 0; j < static_cast<std::size_t>(d); ++j)
        points[j] = 2 * points[j + static_cast<std::size_t>(d)] - points[j + 2 * static_cast<std::size_t>(d)];
    if (!std::all_of(points.begin(), points.end(), [](double x) { return std::isfinite(x); })) continue;
    AffineHull hull(d);
    for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(d)) {
      const bool was_in = hull.contains(&points[i]);
      EXPECT_EQ(hull.add(&points[i]), !was_in);
    }
    test::Matrix edges = test::scaled_to_integers(points, d);
    for (auto& row : edges)
      if (&row != &edges[0])
        for (std::size_t j = 0; j < row.size(); ++j) row[j] -= edges[0][j];
    edges.erase(edges.begin());
    EXPECT_EQ(hull.dimension(), static_cast<int>(test::pivot_columns(edges).size()));
  }
}

TEST(Predicates, SpheresDoNotDependOnTheOrderOfTheirPoints) {
  random::Generator generator(2);
  for (std::size_t round = 0; round < test::scaled_count(500); ++round) {
    RowCase c(RowForm::point, 2 + static_cast<int>(round % 3), {});
    c.numbers = random_numbers(static_cast<std::size_t>((c.ambient + 2) * c.ambient), round % 6, generator);
    for (std::size_t i = 0; i < c.numbers.size(); i += static_cast<std::size_t>(c.ambient))
      c.rows.push_back(&c.numbers[i]);
    const double* q = c.rows.back();
    c.rows.pop_back();
    const Sign sign = orientation(c.flat(), c.rows);
    if (sign == Sign::zero) continue;
    const Sign side = in_sphere(c.flat(), c.rows, sign, q),
               perturbed = in_sphere_perturbed(c.flat(), c.rows, sign, q);
    const bool is_vertex = std::any_of(c.rows.begin(), c.rows.end(),
                                       [&](const double* p) { return std::equal(p, p + c.ambient, q); });
    EXPECT_EQ(perturbed == Sign::zero, is_vertex);
    if (side != Sign::zero) {
      EXPECT_EQ(perturbed, side);
    }
    std::swap(c.rows[0], c.rows[1]);
    EXPECT_EQ(orientation(c.flat(), c.rows), -sign);
    EXPECT_EQ(in_sphere(c.flat(), c.rows, -sign, q), side);
    EXPECT_EQ(in_sphere_perturbed(c.flat(), c.rows, -sign, q), perturbed);
  }
}

TEST(PublicPredicates, SayWhatIsWrong) {
  const std::vector<double> triangle{0, 0, 1, 0, 0, 1}, line{0, 0, 1, 1, 2, 2}, q{0.25, 0.25},
      bad{0, 0, 1, NAN, 0, 1};
  EXPECT_EQ(delone::orientation(triangle, 2), Sign::positive);
  EXPECT_EQ(delone::in_sphere(triangle, q, 2), Side::inside);
  EXPECT_EQ(delone::in_sphere_perturbed(triangle, std::vector<double>{1, 0}, 2), Side::on);
  EXPECT_EQ(delone::affine_dimension(line, 2), 1);
  EXPECT_THROW(delone::in_sphere(line, q, 2), Error);
  EXPECT_THROW(delone::orientation(triangle, 3), Error);
  EXPECT_THROW(delone::orientation(triangle, 0), Error);
  try {
    delone::orientation(bad, 2);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), (std::vector<std::size_t>{1}));
  }
}

TEST(PublicHullPredicates, SayWhatIsWrong) {
  const std::vector<double> rows{1, 0, 0, 1}, bad{1, 0, NAN, 1}, p{2};
  EXPECT_EQ(delone::homogeneous_orientation(rows, 1), Sign::positive);
  EXPECT_EQ(delone::side_of_hyperplane(std::vector<double>{1, -2}, p, 1), Side::on);
  EXPECT_EQ(delone::side_of_hyperplane(std::vector<double>{1, -3}, p, 1), Side::inside);
  EXPECT_EQ(delone::side_of_hyperplane(std::vector<double>{1, -1}, p, 1), Side::outside);
  EXPECT_THROW(delone::homogeneous_orientation(rows, 2), Error);
  EXPECT_THROW(delone::homogeneous_orientation(rows, 0), Error);
  EXPECT_THROW(delone::side_of_hyperplane(p, p, 1), Error);
  EXPECT_THROW(delone::side_of_hyperplane(std::vector<double>{1, -2}, std::vector<double>{INFINITY}, 1),
               Error);
  try {
    delone::homogeneous_orientation(bad, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), (std::vector<std::size_t>{1}));
  }
}

TEST(PublicPowerSphere, SaysWhatIsWrong) {
  const std::vector<double> triangle{0, 0, 1, 0, 0, 1}, q{0.25, 0.25}, weights{0, 0, 0};
  EXPECT_EQ(delone::in_power_sphere(triangle, weights, q, 0, 2), Side::inside);
  EXPECT_EQ(delone::in_power_sphere(triangle, weights, q, -1, 2), Side::outside);
  EXPECT_EQ(delone::in_power_sphere_perturbed(triangle, weights, std::vector<double>{1, 0}, 0, 2), Side::on);
  EXPECT_EQ(delone::in_power_sphere_perturbed(triangle, weights, std::vector<double>{1, 0}, 1, 2),
            Side::inside);
  EXPECT_NE(delone::in_power_sphere_perturbed(triangle, weights, std::vector<double>{1, 1}, 0, 2), Side::on);
  EXPECT_THROW(delone::in_power_sphere(triangle, q, q, 0, 2), Error);
  EXPECT_THROW(delone::in_power_sphere({}, weights, q, 0, 0), Error);
  const std::vector<double> line{0, 0, 1, 1, 2, 2}, bad{0, NAN, 0};
  EXPECT_THROW(delone::in_power_sphere(line, weights, q, 0, 2), Error);
  EXPECT_THROW(delone::in_power_sphere(triangle, weights, q, INFINITY, 2), Error);
  try {
    delone::in_power_sphere(triangle, bad, q, 0, 2);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), (std::vector<std::size_t>{1}));
  }
}

}  // namespace
}  // namespace delone::kernel
