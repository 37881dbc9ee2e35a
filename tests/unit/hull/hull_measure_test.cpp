// SPDX-License-Identifier: BSD-3-Clause
// Volumes against exact rationals, and hulls of known measures. The bounds of random simplices in full
// dimension are in hull_normal_test.cpp.
#include "hull/hull_measure.hpp"

#include "hull/hull_analysis.hpp"
#include "hull_support.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace delone::hull {
namespace {

using Rational = boost::multiprecision::cpp_rational;

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_measure(const Measure& measure, double expected, double largest_error) {
  EXPECT_LE(std::fabs(measure.value - expected), measure.error);
  EXPECT_LE(measure.error, largest_error);
}

Measure volume_of(int d, const std::vector<double>& coordinates) {
  std::vector<const double*> points;
  for (std::size_t i = 0; i < coordinates.size(); i += static_cast<std::size_t>(d))
    points.push_back(coordinates.data() + i);
  return simplex_volume(points, d);
}

TEST(MeasureSum, KeepsWhatWouldBeRoundedAway) {
  MeasureSum sum;
  for (const double x : {1.0, 1e100, 1.0, -1e100}) sum.add({x, 0.25});
  EXPECT_EQ(sum.result().value, 2);
  EXPECT_GE(sum.result().error, 1);
  EXPECT_LE(sum.result().error, 1 + 1e82);  // 2⁻⁶⁴ of the magnitudes
}

TEST(MeasureSum, IsUnboundedBeyondTheRange) {
  MeasureSum sum;
  for (int i = 0; i < 2; ++i) sum.add({std::numeric_limits<double>::max(), 1});
  EXPECT_EQ(sum.result().value, infinity);
  EXPECT_EQ(sum.result().error, infinity);
}

TEST(SimplexVolume, OfKnownSimplices) {
  expect_measure(volume_of(3, {1, 2, 3}), 1, 0);                        // a point
  expect_measure(volume_of(2, {0, 0, 3, 4}), 5, 1e-12);                 // a segment
  expect_measure(volume_of(3, {0, 0, 1, 3, 0, 1, 0, 4, 1}), 6, 1e-12);  // a triangle in R³
  expect_measure(volume_of(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}), 1.0 / 6, 1e-13);
  expect_measure(volume_of(4, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), 1.0 / 3, 1e-12);
  expect_measure(volume_of(2, {1, 1, 2, 2, 3, 3}), 0, 1e-12);  // flat
  EXPECT_EQ(volume_of(2, {1, 1, 1, 1, 2, 5}).error, 0);        // two points are equal
}

TEST(SimplexVolume, AtTheEndsOfTheRange) {
  expect_measure(volume_of(2, {0, 0, 1e150, 0, 0, 1e150}), 5e299, 1e288);
  EXPECT_EQ(volume_of(2, {0, 0, 1e300, 0, 0, 1e300}).value, infinity);
  EXPECT_EQ(volume_of(1, {-1.5e308, 1.5e308}).error, infinity);
  EXPECT_EQ(volume_of(2, {-1.5e308, 0, 1.5e308, 0, 0, 1}).value, infinity);
  expect_measure(volume_of(1, {0, 0x1p-1074}), 0x1p-1074, 0x1p-1072);
  const Measure tiny = volume_of(2, {0, 0, 1e-200, 0, 0, 1e-200});  // 5·10⁻⁴⁰¹
  EXPECT_EQ(tiny.value, 0);
  EXPECT_GT(tiny.error, 0);
  expect_measure(volume_of(2, {0, 0, 1e300, 0, 0, 1e-300}), 0.5, 1e-12);
}

// The square of the volume is the Gram determinant over (j!)².
TEST(SimplexVolume, IsWithinItsBoundInFlats) {
  for (int d = 2; d <= 5; ++d)
    for (int j = 1; j <= d; ++j)
      for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const auto size = static_cast<std::size_t>(j);
        test::PointSet set = test::small_integers(d, size + 1, -9, 9, seed);
        if (seed % 3 == 1) set = test::nudged(set, seed);
        if (seed % 3 == 2)  // nearly on one line
          for (std::size_t i = 0; i < set.points.size(); ++i)
            set.points[i] = static_cast<double>(i) + 0x1p-30 * set.points[i];
        std::vector<std::vector<Rational>> gram(size, std::vector<Rational>(size));
        const auto edge = [&](std::size_t i, std::size_t axis) {
          const auto width = static_cast<std::size_t>(d);
          return Rational(set.points[(i + 1) * width + axis]) - Rational(set.points[axis]);
        };
        for (std::size_t a = 0; a < size; ++a)
          for (std::size_t b = 0; b < size; ++b)
            for (std::size_t axis = 0; axis < static_cast<std::size_t>(d); ++axis)
              gram[a][b] += edge(a, axis) * edge(b, axis);
        Rational square = 1;
        for (std::size_t s = 0; s < size && square != 0; ++s) {  // no pivoting: Gram matrices need none
          square *= gram[s][s] / static_cast<int>((s + 1) * (s + 1));
          for (std::size_t r = s + 1; r < size && gram[s][s] != 0; ++r)
            for (std::size_t c = size; c-- > s;) gram[r][c] -= gram[r][s] / gram[s][s] * gram[s][c];
        }
        const Measure volume = volume_of(d, set.points);
        const Rational low = std::max(volume.value - volume.error, 0.0), high = volume.value + volume.error;
        EXPECT_LE(low * low, square) << d << ' ' << j << ' ' << seed;
        EXPECT_GE(high * high, square) << d << ' ' << j << ' ' << seed;
      }
}

TEST(MeasureHull, OfLatticeCubes) {
  for (int d = 2; d <= 4; ++d) {
    HullState state(d);
    state.insert_range(test::lattice(d, 3).points, {});
    const HullMeasures measures = measure_hull(state.sites(), state.hull());
    expect_measure(measures.volume, std::pow(2, d), 1e-10);
    expect_measure(measures.area, 2 * d * std::pow(2, d - 1), 1e-10);
  }
}

TEST(MeasureHull, ThreadsFindTheSame) {
  HullState state(3);
  state.insert_range(make_point_set("sphere", 3, 9000, 1), {});
  const SimplicialHull& hull = state.hull();
  ASSERT_GT(hull.num_cells(), 2 * 8192u);  // parts
  const HullMeasures one = measure_hull(state.sites(), hull);
  MeasureSum area;
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    std::vector<const double*> points;
    for (const Index site : hull.cell(c)) points.push_back(state.sites().point(site));
    area.add(simplex_volume(points, 3));
  }
  EXPECT_LE(std::fabs(one.area.value - area.result().value), one.area.error + area.result().error);
  for (const unsigned threads : {2u, 3u}) {
    const HullMeasures measures = measure_hull(state.sites(), hull, threads);
    EXPECT_EQ(measures.volume.value, one.volume.value);
    EXPECT_EQ(measures.volume.error, one.volume.error);
    EXPECT_EQ(measures.area.value, one.area.value);
    EXPECT_EQ(measures.area.error, one.area.error);
  }
}

TEST(MeasureHull, OfFlatInput) {
  HullState segment(2);  // from (0, 0) to (3, 4)
  segment.insert_range(std::vector<double>{0, 0, 3, 4, 1.5, 2}, {});
  const HullMeasures length = measure_hull(segment.sites(), segment.hull());
  expect_measure(length.volume, 5, 1e-12);
  expect_measure(length.area, 2, 0);
  HullState square(3);  // of side 5, spanned by (3, 4, 0) and (0, 0, 5)
  square.insert_range(std::vector<double>{0, 0, 0, 3, 4, 0, 0, 0, 5, 3, 4, 5}, {});
  const HullMeasures flat = measure_hull(square.sites(), square.hull());
  expect_measure(flat.volume, 25, 1e-10);
  expect_measure(flat.area, 20, 1e-10);
  HullState point(2);
  point.insert_range(std::vector<double>{1, 2, 1, 2}, {});
  EXPECT_EQ(measure_hull(point.sites(), point.hull()).volume.value, 0);
}

TEST(FacetEquations, OfALatticeCube) {
  HullState state(3);
  state.insert_range(test::lattice(3, 3).points, {});
  const HullData data = HullAnalysis(state).data();
  ASSERT_EQ(data.num_facets(), 6u);
  int sum = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    EXPECT_LE(data.equation_errors[f], 1e-12);
    const double* equation = data.equations.data() + 4 * f;
    int axis = 0;
    while (std::fabs(equation[axis]) < 0.5) ++axis;
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(std::fabs(equation[j]), j == axis ? 1 : 0, 1e-15);
    EXPECT_NEAR(equation[3], equation[axis] > 0 ? -2 : 0, 1e-15);  // n·x + c ≤ 0 inside
    sum += equation[axis] > 0 ? 1 << axis : 8 << axis;
  }
  EXPECT_EQ(sum, 63);  // each of the six once
}

// Within the flat: normals of the edges of a triangle in the plane z = 1 of R³.
TEST(FacetEquations, OfFlatInputHaveNoBound) {
  HullState state(3);
  state.insert_range(std::vector<double>{0, 0, 1, 4, 0, 1, 0, 4, 1}, {});
  const HullData data = HullAnalysis(state).data();
  ASSERT_EQ(data.num_facets(), 3u);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(data.equation_errors[f], infinity);
    const double* equation = data.equations.data() + 4 * f;
    EXPECT_NEAR(std::hypot(equation[0], equation[1]), 1, 1e-14);
    EXPECT_NEAR(equation[2], 0, 1e-14);
    EXPECT_LT(equation[0] + equation[1] + equation[2] + equation[3], -0.5);  // (1, 1, 1) is inside
  }
}

}  // namespace
}  // namespace delone::hull
