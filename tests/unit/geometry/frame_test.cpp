// SPDX-License-Identifier: BSD-3-Clause
// Images and lifts against rationals: within the box, and as exact as promised, at all magnitudes.
#include "geometry/frame.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace delone::geometry {
namespace {

using Rational = boost::multiprecision::cpp_rational;

TEST(Frame, MapsItsBoxIntoTheUnitCube) {
  const Frame frame({-3, 1e-320, 5}, {1, 1e300, 5});
  const double low[] = {-3, 1e-320, 5}, high[] = {1, 1e300, 5}, outside[] = {2, 1, 5};
  for (const double* x : {low, high})
    for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::fabs(frame.image(x, axis)), 1);
  EXPECT_LE(frame.lift(high), 3);
  EXPECT_TRUE(frame.contains(low));
  EXPECT_FALSE(frame.contains(outside));
}

void expect_small_errors(const Frame& frame, const std::vector<double>& x) {
  const auto ambient = static_cast<std::size_t>(frame.ambient());
  const Rational u(0x1p-53), lost_by_underflow(1e-290), s(frame.lift_scale());
  ASSERT_TRUE(frame.contains(x.data()));
  Rational lift = 0;
  for (std::size_t j = 0; j < ambient; ++j) {
    const Rational difference = Rational(x[j]) - Rational(frame.center()[j]);
    const double image = frame.image(x.data(), static_cast<int>(j));
    EXPECT_LE(std::fabs(image), 1);
    EXPECT_LE(abs(Rational(image) - difference * Rational(frame.scale()[j])), u + lost_by_underflow);
    EXPECT_EQ(frame.scale()[j], std::ldexp(1.0, frame.scale_exponent(static_cast<int>(j))));
    lift += difference * s * difference * s;
  }
  if (frame.form() == kernel::RowForm::furthest_point) lift = -lift;
  if (frame.form() == kernel::RowForm::weighted_point)
    lift += (Rational(frame.high().back()) - Rational(x[ambient])) * s * s;
  EXPECT_LE(std::fabs(frame.lift(x.data())), frame.largest_lift());
  EXPECT_LE(abs(Rational(frame.lift(x.data())) - lift),
            abs(lift) * u * Rational(1.01 * (frame.ambient() + 4)) + lost_by_underflow);
}

TEST(Frame, ImagesAndLiftsAreAsExactAsPromised) {
  random::Generator generator(1);
  for (std::size_t round = 0; round < test::scaled_count(400); ++round)
    for (const auto form :
         {kernel::RowForm::point, kernel::RowForm::weighted_point, kernel::RowForm::furthest_point}) {
      const std::size_t size = 1 + round % 3 + (form == kernel::RowForm::weighted_point);
      std::vector<double> low(size), high(size), x(size);
      for (std::size_t j = 0; j < size; ++j) {
        // From denormal boxes to those whose extent overflows; some are empty.
        const double extent = std::ldexp(1.0, static_cast<int>(generator.below(2098)) - 1074);
        low[j] = (2 * generator.uniform() - 1) * extent;
        high[j] = generator.below(5) == 0 ? low[j] : (2 * generator.uniform() - 1) * extent;
        if (low[j] > high[j]) std::swap(low[j], high[j]);
        x[j] = std::clamp(low[j] + generator.uniform() * (high[j] / 2 - low[j] / 2) * 2, low[j], high[j]);
      }
      const Frame frame(low, high, form);
      expect_small_errors(frame, low);
      expect_small_errors(frame, high);
      expect_small_errors(frame, x);
    }
}

TEST(Frame, ContainsItsBorderAndNoMore) {
  const Frame frame({0, 0, 1}, {1, 2, 3}, kernel::RowForm::weighted_point);
  const double corner[] = {1, 0, 3}, beyond[] = {std::nextafter(1.0, 2.0), 0, 3},
               heavier[] = {1, 0, std::nextafter(3.0, 4.0)}, nowhere[] = {NAN, 0, 3};
  EXPECT_TRUE(frame.contains(corner));
  for (const double* x : {beyond, heavier, nowhere}) EXPECT_FALSE(frame.contains(x));
}

}  // namespace
}  // namespace delone::geometry
