// SPDX-License-Identifier: BSD-3-Clause
// The ends of the exponent range: overflow and underflow inside the filters must not reach the result.
// Scaling by a power of two that loses no bit changes no cell.
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

namespace delone {
namespace {

using test::PointSet;

void expect_correct(const PointSet& set) {
  SCOPED_TRACE(set.name + "\n" + test::to_text(set.points, set.dimension));
  CheckOptions all;
  all.canonical = true;
  const CheckReport report = check(Delaunay<>(set.points, set.dimension).to_data(), all);
  EXPECT_TRUE(report.ok) << "level " << report.reached.number << ": " << report.violation;
}

class ExtremeRangeIn : public ::testing::TestWithParam<int> {
 protected:
  std::size_t num_points() const {
    static constexpr std::size_t usual[] = {1000, 1000, 500, 120, 50};
    return test::scaled_count(usual[GetParam() - 1]);
  }
};
INSTANTIATE_TEST_SUITE_P(Dimensions, ExtremeRangeIn, ::testing::Range(1, 6),
                         ::testing::PrintToStringParamName());

TEST_P(ExtremeRangeIn, PowersOfTwoChangeNoCell) {
  const int d = GetParam();
  for (const PointSet& set : {PointSet{"uniform", d, make_point_set("uniform", d, num_points(), 1)},
                              test::sampled(test::lattice(d, 6), num_points(), 2)}) {
    const test::Cells expected = test::sorted_cells(Delaunay<>(set.points, d).to_data());
    // Numbers of [2^−21, 1) with at most 53 bits stay normal down to 2^−1000; |x|² leaves the range either
    // way.
    for (const int exponent : {-1000, -900, -540, -500, -100, 100, 500, 515, 900, 1020}) {
      PointSet scaled = test::scaled(set, std::ldexp(1.0, exponent));
      bool exact = true;
      for (std::size_t i = 0; i < set.points.size(); ++i)
        exact &= std::ldexp(scaled.points[i], -exponent) == set.points[i];
      ASSERT_TRUE(exact);
      EXPECT_TRUE(test::same_cells(expected, test::sorted_cells(Delaunay<>(scaled.points, d).to_data())))
          << set.name << " 2^" << exponent;
    }
  }
}

TEST_P(ExtremeRangeIn, Denormals) {
  const int d = GetParam();
  for (const int range : {3, 100, 100000})
    expect_correct(test::scaled(test::small_integers(d, num_points(), -range, range, 3), 0x1p-1074));
}

TEST_P(ExtremeRangeIn, LargestNumbers) {
  const int d = GetParam();
  constexpr double largest = std::numeric_limits<double>::max();
  expect_correct(test::scaled(test::small_integers(d, num_points(), -1, 1, 4), largest));
  PointSet set = test::scaled({"uniform", d, make_point_set("uniform", d, num_points(), 4)}, largest);
  for (std::size_t i = 0; i < set.points.size(); i += 2) set.points[i] = -set.points[i];
  expect_correct(set);
}

TEST_P(ExtremeRangeIn, MixedExponents) {
  const int d = GetParam();
  for (std::uint64_t seed = 0; seed < test::scaled_count(4); ++seed) {
    const std::size_t n = std::min<std::size_t>(num_points(), 100 / static_cast<std::size_t>(d));
    expect_correct(test::mixed_exponents(d, n, -1074, 1020, seed));
    expect_correct(test::mixed_exponents(d, n, -60, 60, seed));
    expect_correct(test::mixed_exponents(d, n, -1074, -1000, seed));
    if (HasFailure()) return;
  }
}

TEST_P(ExtremeRangeIn, FarFromTheOrigin) {
  const int d = GetParam();
  // One bit above the last: all differences are exact and small, all squares are not.
  expect_correct(
      test::shifted(test::small_integers(d, num_points(), 0, 7, 5), {0x1p52, -0x1p51, 0x1p50}, 1.0));
  expect_correct(
      test::shifted({"uniform", d, make_point_set("uniform", d, num_points(), 5)}, {1e9, 5e6, -7e7}, 1.0));
  // A tight cluster and a few points very far away.
  PointSet set{"uniform", d, make_point_set("uniform", d, num_points(), 6)};
  const PointSet far = test::scaled(test::small_integers(d, 6, -9, 9, 6), 1e200);
  set.points.insert(set.points.end(), far.points.begin(), far.points.end());
  expect_correct(set);
}

}  // namespace
}  // namespace delone
