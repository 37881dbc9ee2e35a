// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/multiples_stage.hpp"

#include "kernel/exact.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace delone::kernel {
namespace {

struct Points {
  std::vector<int> axes;
  std::vector<std::vector<double>> rows;  // the last one is the base
  std::vector<const double*> points() const {
    std::vector<const double*> result;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) result.push_back(rows[i].data());
    return result;
  }
  const double* base() const { return rows.back().data(); }
  std::optional<Sign> sign() const { return orientation_of_multiples(axes, points().data(), base()); }
  Sign exact() const {
    return exact_orientation(Flat{static_cast<int>(axes.size()), axes}, points().data(), base());
  }
};

/// Whole numbers of at most `most` times a unit of each axis.
Points lattice(std::size_t n, int most, std::mt19937_64& random) {
  Points result;
  result.axes.resize(n);
  std::iota(result.axes.begin(), result.axes.end(), 0);
  std::uniform_real_distribution<double> units(0.01, 10);
  std::uniform_int_distribution<int> multiples(-most, most);
  std::vector<double> unit(n);
  for (double& x : unit) x = units(random);
  for (std::size_t i = 0; i <= n; ++i) {
    result.rows.emplace_back();
    for (std::size_t j = 0; j < n; ++j) result.rows.back().push_back(multiples(random) * unit[j]);
  }
  return result;
}

TEST(OrientationOfMultiples, IsTheExactOne) {
  std::mt19937_64 random(1);
  int zeros = 0, others = 0;
  for (std::size_t n = 1; n <= 10; ++n)
    for (std::size_t round = 0; round < test::scaled_size(300, 60); ++round) {
      // The differences of −1, 0 and 1 times a unit are doubles, and multiples of it.
      const Points points = lattice(n, 1, random);
      const auto sign = points.sign();
      ASSERT_TRUE(sign) << n;
      EXPECT_EQ(*sign, points.exact()) << n;
      ++(*sign == Sign::zero ? zeros : others);
    }
  EXPECT_GT(zeros, 100);
  EXPECT_GT(others, 100);
}

// Rounded multiples are decided where they happen to be exact, and left alone elsewhere.
TEST(OrientationOfMultiples, SaysNothingWrongOfRoundedMultiples) {
  std::mt19937_64 random(2);
  int decided = 0, left = 0;
  for (std::size_t n = 2; n <= 5; ++n)
    for (const int most : {2, 3, 50, 3000})
      for (std::size_t round = 0; round < test::scaled_size(200, 60); ++round) {
        const Points points = lattice(n, most, random);
        const auto sign = points.sign();
        ++(sign ? decided : left);
        if (sign) {
          EXPECT_EQ(*sign, points.exact()) << n << ' ' << most;
        }
      }
  EXPECT_GT(decided, 20);
  EXPECT_GT(left, 20);
}

// Integers up to a thousand, with a row of ones: what does not fit is left alone.
TEST(OrientationOfMultiples, LargeMultiples) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> multiples(-1000, 1000);
  for (std::size_t n = 2; n <= 10; ++n)
    for (std::size_t round = 0; round < test::scaled_size(100, 40); ++round) {
      Points points = lattice(n, 1, random);
      for (auto& row : points.rows)
        for (double& x : row) x = multiples(random);
      points.rows[0].assign(n, 1);
      points.rows[n].assign(n, 0);
      const auto sign = points.sign();
      EXPECT_EQ(sign.has_value(), n <= 5);
      if (sign) {
        EXPECT_EQ(*sign, points.exact()) << n;
      }
    }
}

TEST(OrientationOfMultiples, LeavesOneUlpBesideALattice) {
  std::mt19937_64 random(3);
  Points points = lattice(3, 1, random);
  for (auto& row : points.rows)
    for (double& x : row) x = x > 0 ? 0.1 : x < 0 ? -0.1 : 0;
  points.rows[0] = {0.1, 0, 0};
  points.rows[3] = {0, 0, 0.1};
  ASSERT_TRUE(points.sign());
  points.rows[0][0] = std::nextafter(0.1, 1);
  points.rows[1][0] = 0.1;
  EXPECT_FALSE(points.sign());
}

TEST(OrientationOfMultiples, AtTheEndsOfTheRange) {
  for (const double unit : {0x1p-1074, 3 * 0x1p-1074, 0x1p-1022, 0x1p1022, 0x1.fffffffffffffp1022}) {
    const Points line{{0, 1}, {{unit, 0}, {-unit, 0}, {0, 0}}},
        corner{{0, 1}, {{unit, 0}, {0, unit}, {0, 0}}};
    EXPECT_EQ(line.sign(), Sign::zero) << unit;
    EXPECT_EQ(corner.sign(), Sign::positive) << unit;
  }
  // The difference overflows.
  const Points far{{0, 1}, {{0x1p1023, 0}, {-0x1p1023, 1}, {-0x1p1023, 0}}};
  EXPECT_FALSE(far.sign());
}

TEST(OrientationOfMultiples, LeavesMoreThanTenColumnsAlone) {
  std::mt19937_64 random(4);
  EXPECT_FALSE(lattice(11, 1, random).sign());
}

}  // namespace
}  // namespace delone::kernel
