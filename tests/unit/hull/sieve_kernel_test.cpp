// SPDX-License-Identifier: BSD-3-Clause
// Extremes and thresholds of linear functions agree with a loop over points, whatever the number of points.
#include "hull/sieve_kernel.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace delone::hull {
namespace {

/// Entries are small multiples of 1/8: all values are exact, in any order of summation.
std::vector<double> coarse(int dimension, std::size_t n, std::uint64_t seed) {
  std::vector<double> numbers = make_point_set("uniform", dimension, n, seed);
  for (double& x : numbers) x = std::nearbyint(x * 64) / 8 - 4;
  return numbers;
}

double value(const LinearFunctions& functions, std::size_t f, const double* point) {
  const std::size_t d = functions.origin.size();
  double sum = 0;
  for (std::size_t j = 0; j < d; ++j) sum += functions.normals[f * d + j] * (point[j] - functions.origin[j]);
  return sum;
}

TEST(SieveKernel, AgreesWithALoop) {
  for (int d = 1; d <= 7; ++d)
    for (const std::size_t n : {1u, 7u, 63u, 64u, 65u, 200u}) {
      const auto width = static_cast<std::size_t>(d);
      const std::vector<double> points = coarse(d, n, n + width);
      const LinearFunctions functions{coarse(d, 1, 1), coarse(d, 37, 2)};
      ASSERT_EQ(functions.size(), 37u);
      std::vector<Extreme> extremes(functions.size(), Extreme{-1e300});
      extremes[3].value = 1e300;
      find_extremes(points, functions, extremes);
      const std::vector<double> thresholds(functions.size(), 20.0);
      std::vector<char> is_below(n, 2);
      find_below(points, functions, thresholds, is_below);
      for (std::size_t f = 0; f < functions.size(); ++f) {
        Extreme best{-1e300};
        for (std::size_t i = 0; i < n; ++i)
          if (const double x = value(functions, f, &points[i * width]); x > best.value) best = {x, i};
        if (f == 3) best = {1e300, Extreme::nowhere};
        EXPECT_EQ(extremes[f].value, best.value) << d << ' ' << n << ' ' << f;
        EXPECT_EQ(extremes[f].at, best.at) << d << ' ' << n << ' ' << f;
      }
      for (std::size_t i = 0; i < n; ++i) {
        bool all = true;
        for (std::size_t f = 0; f < functions.size(); ++f)
          all = all && value(functions, f, &points[i * width]) < 20.0;
        EXPECT_EQ(is_below[i], all ? 1 : 0) << d << ' ' << n << ' ' << i;
      }
    }
}

TEST(SieveKernel, ValuesThatAreNoNumbersAreNotBelow) {
  constexpr double huge = std::numeric_limits<double>::max();
  const std::vector<double> points{huge, -huge, 0, 0};
  const LinearFunctions functions{{0, 0}, {4, 4}};
  std::vector<char> is_below(2, 2);
  find_below(points, functions, std::vector<double>{1.0}, is_below);
  EXPECT_EQ(is_below[0], 0);
  EXPECT_EQ(is_below[1], 1);
}

TEST(SieveKernel, ThreadsFindTheSame) {
  const std::size_t n = 70000;  // several parts
  const std::vector<double> points = coarse(3, n, 1);
  const LinearFunctions functions{coarse(3, 1, 1), coarse(3, 9, 2)};
  const std::vector<double> thresholds(functions.size(), 20.0);
  std::vector<Extreme> extremes(functions.size(), Extreme{-1e300}), in_threads = extremes;
  std::vector<char> is_below(n, 2), below_in_threads = is_below;
  find_extremes(points, functions, extremes);
  find_below(points, functions, thresholds, is_below);
  for (const unsigned threads : {2u, 3u}) {
    find_extremes(points, functions, in_threads, threads);
    find_below(points, functions, thresholds, below_in_threads, threads);
    for (std::size_t f = 0; f < functions.size(); ++f) {
      std::size_t first = 0;
      while (value(functions, f, &points[3 * first]) != extremes[f].value) ++first;
      EXPECT_EQ(extremes[f].at, first);
      EXPECT_EQ(in_threads[f].value, extremes[f].value);
      EXPECT_EQ(in_threads[f].at, extremes[f].at);
    }
    EXPECT_EQ(below_in_threads, is_below);
  }
}

}  // namespace
}  // namespace delone::hull
