// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/dependent_points.hpp"

#include "kernel/exact.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

namespace delone::kernel {
namespace {

/// k + 2 points of a small lattice, of which number `odd` is off it.
class AlmostLattice {
 public:
  AlmostLattice(std::size_t k, std::size_t odd, double unit, std::mt19937_64& random) : axes_(k) {
    std::iota(axes_.begin(), axes_.end(), 0);
    std::uniform_int_distribution<int> multiples(1, 3);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    for (std::size_t i = 0; i <= k + 1; ++i) {
      points_.emplace_back();
      for (std::size_t j = 0; j < k; ++j)
        points_.back().push_back(unit * (i == odd ? anywhere(random) : multiples(random)));
    }
  }
  double& coordinate(std::size_t point, std::size_t axis) { return points_[point][axis]; }
  bool is_proved() const { return is_on_sphere_of_others(flat(), pointers().data(), points_.back().data()); }
  /// Of the simplex of all points but the last.
  bool is_proved_flat() const {
    return is_flat_without_one(flat(), pointers().data() + 1, points_[0].data());
  }
  bool is_flat() const {
    return exact_orientation(flat(), pointers().data() + 1, points_[0].data()) == Sign::zero;
  }
  bool is_true() const {
    return exact_sphere(flat(), pointers().data(), points_.back().data()) == Sign::zero;
  }

 private:
  Flat flat() const { return {static_cast<int>(axes_.size()), axes_}; }
  std::vector<const double*> pointers() const {
    std::vector<const double*> result;
    for (const std::vector<double>& point : points_) result.push_back(point.data());
    return result;
  }
  std::vector<int> axes_;
  std::vector<std::vector<double>> points_;
};

TEST(DependentPoints, AreOnOneSphereWithAnyOther) {
  std::mt19937_64 random(1);
  for (std::size_t k = 2; k <= 6; ++k) {
    std::size_t num_proved = 0, num_others = 0;
    for (const double unit : {1.0, 0x1p-40, 0x1p450, 0x1p-450, 0x1p-1000, 0x1p1000})
      for (std::size_t round = 0; round < test::scaled_size(200, 60); ++round) {
        AlmostLattice points(k, random() % (k + 2), unit, random);
        ASSERT_EQ(points.is_proved() && !points.is_true(), false) << k << ' ' << unit;
        const bool is_moderate = unit >= 0x1p-450 && unit <= 0x1p450;
        if (is_moderate) {
          ASSERT_EQ(points.is_proved(), points.is_true()) << k << ' ' << unit;
        }
        ++(points.is_proved() ? num_proved : num_others);
      }
    EXPECT_GT(num_proved, 10u) << k;
    EXPECT_GT(num_others, 10u) << k;
  }
}

TEST(DependentPoints, MakeFlatSimplicesWithAnyOther) {
  std::mt19937_64 random(3);
  for (std::size_t k = 2; k <= 6; ++k) {
    std::size_t num_proved = 0, num_others = 0;
    for (const double unit : {1.0, 0x1p-40, 0x1p450, 0x1p-450, 0x1p-1000, 0x1p1000})
      for (std::size_t round = 0; round < test::scaled_size(200, 60); ++round) {
        const std::size_t odd = random() % (k + 2);
        AlmostLattice points(k, odd, unit, random);
        ASSERT_EQ(points.is_proved_flat() && !points.is_flat(), false) << k << ' ' << unit;
        const bool is_moderate = unit >= 0x1p-450 && unit <= 0x1p450;
        if (is_moderate && odd <= k) {
          ASSERT_EQ(points.is_proved_flat(), points.is_flat()) << k << ' ' << unit;
        }
        ++(points.is_proved_flat() ? num_proved : num_others);
      }
    EXPECT_GT(num_proved, 10u) << k;
    EXPECT_GT(num_others, 10u) << k;
  }
}

TEST(DependentPoints, OffTheLatticeByAnUlpAreNotProved) {
  std::mt19937_64 random(2);
  for (std::size_t k = 2; k <= 6; ++k)
    for (std::size_t round = 0; round < test::scaled_size(300, 60); ++round) {
      AlmostLattice points(k, 0, 1, random);
      double& x = points.coordinate(1 + random() % (k + 1), random() % k);
      x = std::nextafter(x, random() % 2 ? 4 : -4);
      EXPECT_TRUE(!points.is_proved() || points.is_true());
    }
}

TEST(DependentPoints, MayBeThousandsOfUnitsApart) {
  constexpr std::array axes{0, 1, 2};
  for (const double unit : {1.0, 0x1p-40, 0x1p450}) {
    // The corners of a square, and a point off their grid.
    double points[][3] = {{0, 0, 0}, {1501, 1001, 0}, {-1001, 1501, 0}, {500, 2502, 0}, {0.3, 0.7, 0.1}};
    for (double(&point)[3] : points)
      for (double& x : point) x *= unit;
    std::array<std::size_t, 5> order{0, 1, 2, 3, 4};
    do {
      const double* const cell[] = {points[order[0]], points[order[1]], points[order[2]], points[order[3]]};
      EXPECT_TRUE(is_on_sphere_of_others(Flat{3, axes}, cell, points[order[4]]));
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(DependentPoints, OfOtherKindsNothingIsSaid) {
  // Three points on a line, and one off their lattice.
  const double p[] = {0, 0, 0}, q[] = {1, 0, 0}, r[] = {2, 0, 0}, s[] = {0.3, 0.7, 0};
  const double* const points[] = {p, q, s};
  constexpr std::array plane{0, 1}, turned{0, 2};
  EXPECT_FALSE(is_on_sphere_of_others(Flat{2, plane}, points, r));  // on a line, but on no circle
  const double corner[] = {0, 1, 0}, far[] = {1, 1, 0};
  const double* const square[] = {p, q, corner};
  EXPECT_FALSE(
      is_on_sphere_of_others(Flat{2, plane}, square, far));  // no point is off the grid of the others
  EXPECT_FALSE(is_on_sphere_of_others(Flat{3, turned}, points, r));
  EXPECT_FALSE(is_on_sphere_of_others(Flat{2, plane, RowForm::weighted_point}, points, r));
}

}  // namespace
}  // namespace delone::kernel
