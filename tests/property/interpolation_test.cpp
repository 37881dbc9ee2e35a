// SPDX-License-Identifier: BSD-3-Clause
// LinearInterpolator: linear functions come back within the promised bound, given values exactly; outside,
// flat input, values that are NaN, and errors.
#include <delone/interpolation.hpp>

#include "degenerate.hpp"
#include "error_code.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone {
namespace {

using Fraction = boost::multiprecision::cpp_rational;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A linear function with small integer coefficients.
struct Linear {
  std::vector<int> slope;
  int offset;

  Linear(int d, test::Random& random) : offset(random.integer(-5, 5)) {
    for (int j = 0; j < d; ++j) slope.push_back(random.integer(-7, 7));
  }
  Fraction operator()(std::span<const double> x) const {
    Fraction sum(offset);
    for (std::size_t j = 0; j < x.size(); ++j) sum += Fraction(x[j]) * slope[j];
    return sum;
  }
};

/// Convex combinations of three rows, rounded: inside the hull unless it is flat.
std::vector<double> queries_for(const test::PointSet& set, std::size_t count, std::uint64_t seed) {
  test::Random random(seed);
  const auto d = static_cast<std::size_t>(set.dimension);
  std::vector<double> queries;
  for (std::size_t i = 0; i < count; ++i) {
    const double* corner[3];
    for (const double*& c : corner) c = set.points.data() + random.bits() % set.size() * d;
    const double s = random.real() / 2, t = random.integer(0, 1) == 0 ? 0.25 : random.real() / 2;
    for (std::size_t j = 0; j < d; ++j)
      queries.push_back(s * corner[0][j] + t * corner[1][j] + (1 - s - t) * corner[2][j]);
  }
  return queries;
}

class InterpolationOfDimension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, InterpolationOfDimension, ::testing::Range(1, 8));

// Small integers, so that the values are exact: lattices, flats, nearly flat sets.
TEST_P(InterpolationOfDimension, LinearFunctionsWithinTheBound) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  test::Random random(static_cast<std::uint64_t>(d));
  std::vector<test::PointSet> sets{test::small_integers(d, d <= 3 ? 150 : 30, -9, 9, 3),
                                   test::sampled(test::lattice(d, d <= 4 ? 3 : 2), 40, 4)};
  for (int k = 1; k < d; ++k)
    sets.push_back(test::embedded(test::small_integers(k, 25, -5, 5, 6), d, true, random.bits()));
  test::PointSet thin = test::small_integers(d, 30, -1000000, 1000000,
                                             8);  // near the plane where all coordinates but one are equal
  for (std::size_t i = 0; i < thin.points.size(); ++i)
    if (i % size != 0) thin.points[i] = thin.points[i - i % size] + random.integer(-1, 1);
  sets.push_back(thin);
  for (const test::PointSet& set : sets) {
    SCOPED_TRACE(set.name);
    const Delaunay<> t(set.points, d);
    const Linear f(d, random), g(d, random);
    std::vector<double> values;
    double largest = 0;
    for (std::size_t row = 0; row < set.size(); ++row)
      for (const Linear* function : {&f, &g}) {
        values.push_back((*function)(std::span(set.points).subspan(row * size, size)).convert_to<double>());
        largest = std::max(largest, std::abs(values.back()));
      }
    const LinearInterpolator interpolate(t, values, 2);
    std::vector<double> queries = queries_for(set, test::scaled_count(60), random.bits());
    queries.insert(queries.end(), set.points.begin(), set.points.end());
    const std::size_t count = queries.size() / size;
    std::vector<double> result(2 * count), slopes(2 * count * size);
    interpolate.evaluate(queries, result);
    interpolate.gradients(queries, slopes);
    const Fraction bound = Fraction(largest) * Fraction(0x1p-35) * (t.affine_dimension() + 1);
    std::size_t num_inside = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto q = std::span(queries).subspan(i * size, size);
      const bool is_inside = !t.locate(q).face.empty();
      num_inside += is_inside ? 1 : 0;
      for (std::size_t c = 0; c < 2; ++c) {
        ASSERT_EQ(std::isnan(result[2 * i + c]), !is_inside);
        ASSERT_EQ(std::isnan(slopes[(2 * i + c) * size]), !is_inside);
        if (!is_inside) continue;
        const Linear& function = c == 0 ? f : g;
        EXPECT_LE(abs(Fraction(result[2 * i + c]) - function(q)), bound);
        if (i + set.size() >= count) {
          EXPECT_EQ(result[2 * i + c], values[2 * (i + set.size() - count) + c]);
        }
        if (t.affine_dimension() == d && &set == sets.data()) {
          for (std::size_t j = 0; j < size; ++j)
            EXPECT_NEAR(slopes[(2 * i + c) * size + j], function.slope[j], 1e-6);
        }
      }
    }
    EXPECT_GE(num_inside, set.size());
  }
}

// The gradient in a flat has the slopes of the function along the flat, and none across.
TEST(Interpolation, GradientsInsideAFlat) {
  const std::vector<double> points{0, 0, 1, 2, 0, 1, 0, 3, 1, 2, 3, 1}, values{1, 5, 7, 11};
  const Delaunay<> t(points, 3);
  ASSERT_EQ(t.affine_dimension(), 2);
  std::vector<double> slope(3), value(1);
  const std::vector<double> query{0.5, 0.75, 1}, beside{0.5, 0.75, 1.5};
  const LinearInterpolator interpolate(t, values);
  interpolate.gradients(query, slope);
  interpolate.evaluate(query, value);
  EXPECT_NEAR(slope[0], 2, 1e-14);
  EXPECT_NEAR(slope[1], 2, 1e-14);
  EXPECT_EQ(slope[2], 0);
  EXPECT_NEAR(value[0], 3.5, 1e-14);
  interpolate.evaluate(beside, value);
  EXPECT_TRUE(std::isnan(value[0]));
  interpolate.evaluate(beside, value, {.outside = Outside::nearest});
  EXPECT_EQ(value[0], 1);
}

TEST(Interpolation, Outside) {
  const std::vector<double> points{0, 0, 4, 0, 0, 4}, values{1, 10, 2, 20, 3, 30},
      queries{1, 1, 9, 0, -1, 3, 4, 0};
  const Delaunay<> t(points, 2);
  const LinearInterpolator interpolate(t, values, 2);
  std::vector<double> result(8), slopes(16);
  const std::vector<double> constants{-1, -2};
  interpolate.evaluate(queries, result, {.fill = constants});
  EXPECT_EQ(std::vector<double>(result.begin() + 2, result.end()),
            (std::vector<double>{-1, -2, -1, -2, 2, 20}));
  EXPECT_NEAR(result[0], 1.75, 1e-15);
  interpolate.evaluate(queries, result, {.outside = Outside::nearest});
  EXPECT_EQ(std::vector<double>(result.begin() + 2, result.end()),
            (std::vector<double>{2, 20, 3, 30, 2, 20}));
  interpolate.gradients(queries, slopes, {.outside = Outside::nearest});
  EXPECT_EQ(slopes[4], 0);
  EXPECT_NEAR(slopes[0], 0.25, 1e-15);
  for (const bool of_gradients : {false, true}) try {
      if (of_gradients)
        interpolate.gradients(queries, slopes, {.outside = Outside::error});
      else
        interpolate.evaluate(queries, result, {.outside = Outside::error});
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Errc::invalid_argument);
      ASSERT_EQ(e.rows().size(), 1u);
      EXPECT_TRUE(e.rows()[0] == 1 || e.rows()[0] == 2);
    }
}

// Two triangles with a common edge: a NaN at a vertex does not spread to cells and faces without that
// vertex.
TEST(Interpolation, NotANumberStaysInItsCells) {
  const std::vector<double> points{0, 0, 2, 0, 0, 2, 3, 3}, values{nan, 1, 3, 7},
      queries{0.5, 0.5, 1, 1, 2, 2, 0, 0, 2, 0};
  const Delaunay<> t(points, 2);
  std::vector<double> result(5);
  LinearInterpolator(t, values).evaluate(queries, result);
  EXPECT_TRUE(std::isnan(result[0]));
  EXPECT_EQ(result[1], 2);
  EXPECT_FALSE(std::isnan(result[2]));
  EXPECT_TRUE(std::isnan(result[3]));
  EXPECT_EQ(result[4], 1);
}

TEST(Interpolation, DuplicatesAndHiddenPoints) {
  const std::vector<double> line{0, 1, 1, 2}, values{0, 5, 6, 0};
  std::vector<double> result(1);
  const std::vector<double> query{1};
  const Delaunay<> t(line, 1);
  LinearInterpolator(t, values).evaluate(query, result);
  EXPECT_EQ(result[0], 5);  // the first row
  const std::vector<double> weights{0, -9, -9, 0};
  const Regular<> regular(line, weights, 1);
  ASSERT_EQ(regular.num_hidden(), 2u);
  LinearInterpolator(regular, values).evaluate(query, result);
  EXPECT_EQ(result[0], 0);
}

TEST(Interpolation, NoPointsAndOnePoint) {
  const std::vector<double> query{1, 2}, value{7};
  std::vector<double> result(1);
  const Delaunay<> none(2);
  LinearInterpolator(none, {}).evaluate(query, result, {.outside = Outside::nearest});
  EXPECT_TRUE(std::isnan(result[0]));
  const Delaunay<> one(query, 2);
  LinearInterpolator(one, value).evaluate(query, result);
  EXPECT_EQ(result[0], 7);
  std::vector<double> slope(2);
  LinearInterpolator(one, value).gradients(query, slope);
  EXPECT_EQ(slope, (std::vector<double>{0, 0}));
}

TEST(Interpolation, Errors) {
  const std::vector<double> points{0, 0, 4, 0, 0, 4}, values{1, 2, 3}, queries{1, 1, 2, 1}, bad{1, nan};
  const Delaunay<> t(points, 2);
  std::vector<double> result(2), wrong(3);
  const LinearInterpolator interpolate(t, values);
  EXPECT_EQ(test::code_of([&] { LinearInterpolator(t, values, 2); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { interpolate.evaluate(queries, wrong); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { interpolate.gradients(queries, wrong); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { interpolate.evaluate(queries, result, {.fill = wrong}); }),
            Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { interpolate.evaluate(bad, std::span(result).first(1)); }), Errc::not_finite);
  std::vector<double> many(2 * 5000, 1.0), answers(5000);
  EXPECT_EQ(test::code_of(
                [&] { interpolate.evaluate(many, answers, {}, {.progress = [](double) { return false; }}); }),
            Errc::cancelled);
  std::size_t calls = 0;
  interpolate.evaluate(many, answers, {}, {.progress = [&](double) { return ++calls > 0; }});
  EXPECT_GE(calls, 1u);  // at first, and then every few milliseconds
}

}  // namespace
}  // namespace delone
