// SPDX-License-Identifier: BSD-3-Clause
// Random variables made of exact arithmetic: their means, and the series of the sine.
#include "point_sets/distributions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace delone::point_sets {
namespace {

TEST(Distributions, BernoulliVariablesHaveTheProbabilityOfTheExponential) {
  Generator generator(1);
  for (const double t : {0.0, 0.1, 0.5, 1.0}) {
    int successes = 0;
    for (int i = 0; i < 20'000; ++i) successes += bernoulli_exp(t, generator);
    EXPECT_NEAR(successes / 2e4, std::exp(-t), 0.015) << t;
  }
}

TEST(Distributions, NormalVariablesHaveTheirTails) {
  Generator generator(2);
  std::array<int, 4> beyond{};
  double sum = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = normal(generator);
    sum += x;
    for (std::size_t k = 0; k < beyond.size(); ++k) beyond[k] += std::fabs(x) > static_cast<double>(k);
  }
  EXPECT_NEAR(sum / 1e5, 0, 0.015);
  EXPECT_NEAR(beyond[1] / 1e5, 0.31731, 0.008);
  EXPECT_NEAR(beyond[2] / 1e5, 0.04550, 0.004);
  EXPECT_NEAR(beyond[3] / 1e5, 0.00270, 0.001);
}

TEST(Distributions, TheSineIsRightToTwoUnitsInTheLastPlace) {
  EXPECT_EQ(sin_pi(0), 0);
  EXPECT_EQ(sin_pi(1), 0);
  for (int i = 1; i < 1000; ++i) {
    const double x = i / 1000.0;
    const auto expected = static_cast<double>(std::sin(3.141592653589793238462643383279L * x));
    EXPECT_NEAR(sin_pi(x), expected, 4 * 0x1p-53) << x;
  }
}

TEST(Distributions, DirectionsAreLongAsOneAndBallsAreFilled) {
  Generator generator(3);
  std::array<double, 3> x;
  int inner = 0;
  for (int i = 0; i < 4000; ++i) {
    random_direction(x, generator);
    ASSERT_NEAR(std::hypot(x[0], x[1], x[2]), 1, 1e-15);
    random_in_ball(x, generator);
    const double radius = std::hypot(x[0], x[1], x[2]);
    ASSERT_LE(radius, 1 + 1e-15);
    inner += radius < 0.5;
  }
  EXPECT_NEAR(inner, 500, 110);
  std::array<double, 1> sign;
  random_direction(sign, generator);
  EXPECT_EQ(std::fabs(sign[0]), 1);
}

}  // namespace
}  // namespace delone::point_sets
