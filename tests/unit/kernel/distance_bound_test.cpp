// SPDX-License-Identifier: BSD-3-Clause
// Bounds against exact squared distances, for points that were rounded and not, far away and next to slivers.
#include "kernel/distance_bound.hpp"

#include "kernel/fractions.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace delone::kernel {
namespace {

using Rational = boost::multiprecision::cpp_rational;
constexpr double u = 0x1p-53;

/// The exact squared distance of x from the flat through the points, by Gram–Schmidt in rationals.
Rational squared_distance(const std::vector<Rational>& x, const std::vector<std::vector<Rational>>& points) {
  const std::size_t d = x.size();
  std::vector<std::vector<Rational>> basis;
  const auto project = [&](std::vector<Rational> v) {
    for (const auto& b : basis) {
      Rational dot = 0, square = 0;
      for (std::size_t j = 0; j < d; ++j) {
        dot += v[j] * b[j];
        square += b[j] * b[j];
      }
      for (std::size_t j = 0; j < d; ++j) v[j] -= dot / square * b[j];
    }
    return v;
  };
  const auto from_origin = [&](const std::vector<Rational>& p) {
    std::vector<Rational> v;
    for (std::size_t j = 0; j < d; ++j) v.push_back(p[j] - points[0][j]);
    return v;
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    auto b = project(from_origin(points[i]));
    if (std::any_of(b.begin(), b.end(), [](const Rational& r) { return r != 0; })) basis.push_back(b);
  }
  Rational square = 0;
  for (const Rational& r : project(from_origin(x))) square += r * r;
  return square;
}

std::vector<Rational> exact(const double* p, std::size_t d) { return std::vector<Rational>(p, p + d); }

TEST(DistanceBound, IsAboveAndSharp) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t d = 1 + static_cast<std::size_t>(trial % 5);
    const double offset = trial % 3 == 0 ? 1e6 : 0, size = std::ldexp(1.0, trial % 41 - 20);
    std::vector<double> p, q;
    for (std::size_t j = 0; j < d; ++j) {
      p.push_back(offset + uniform(random));
      q.push_back(p.back() + size * uniform(random));
    }
    const double bound = distance_bound(p.data(), q.data(), d, 0);
    const Rational square = squared_distance(exact(p.data(), d), {exact(q.data(), d)});
    EXPECT_GE(Rational(bound) * Rational(bound), square);
    EXPECT_LE(Rational(bound) * Rational(bound), square * Rational(1 + 1e-13));
    // Coordinates that are off by as much as they may be.
    std::vector<Rational> far_p = exact(p.data(), d), far_q = exact(q.data(), d);
    for (std::size_t j = 0; j < d; ++j) {
      far_p[j] += (p[j] < q[j] ? -1 : 1) * Rational(u) * abs(far_p[j]);
      far_q[j] += (p[j] < q[j] ? 1 : -1) * Rational(u) * abs(far_q[j]);
    }
    const double wider = distance_bound(p.data(), q.data(), d, u);
    EXPECT_GE(Rational(wider) * Rational(wider), squared_distance(far_p, {far_q}));
  }
}

TEST(DistanceBound, IsAboveBelowTheNormalNumbers) {
  const double least = std::numeric_limits<double>::denorm_min(), origin[] = {0, 0, 0};
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> multiple(0, 9);
  for (int trial = 0; trial < 100; ++trial) {
    const double p[] = {multiple(random) * least, multiple(random) * least, multiple(random) * least};
    const double bound = distance_bound(origin, p, 3, 0);
    EXPECT_GE(Rational(bound) * Rational(bound), squared_distance(exact(p, 3), {exact(origin, 3)}));
    EXPECT_LE(bound, p[0] + p[1] + p[2] + least);
  }
  EXPECT_EQ(distance_bound(origin, origin, 3, 0), 0);
}

TEST(DistanceBound, OfWhatIsNotFiniteIsWithinNothing) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double p[] = {infinity, 0}, q[] = {infinity, 0}, r[] = {1e308, 0}, s[] = {-1e308, 1e308};
  EXPECT_FALSE(distance_bound(p, q, 2, u) <= 1e308);
  EXPECT_FALSE(distance_bound(p, r, 2, u) <= 1e308);
  EXPECT_FALSE(distance_bound(r, s, 2, u) <= 1e308);
  FlatDistance line;
  const double* ends[] = {p, r};
  line.set_flat(ends, 2, u);
  EXPECT_FALSE(line.bound(s) <= 1e308);
}

TEST(FlatDistance, IsAboveAndSharp) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t d = 2 + static_cast<std::size_t>(trial % 4);
    const std::size_t m = 1 + static_cast<std::size_t>(trial) % d;
    const double scale = trial % 7 == 0 ? 1e-300 : trial % 7 == 1 ? 1e150 : 1;
    std::vector<double> numbers((m + 1) * d);
    for (double& x : numbers) x = scale * uniform(random);
    if (trial % 5 == 0 && m > 1)  // a point next to the first
      for (std::size_t j = 0; j < d; ++j) numbers[d + j] = numbers[j] * (1 + 1e-15 * uniform(random));
    std::vector<const double*> points;
    std::vector<std::vector<Rational>> exact_points;
    for (std::size_t i = 0; i < m; ++i) {
      points.push_back(numbers.data() + i * d);
      exact_points.push_back(exact(points.back(), d));
    }
    const double* x = numbers.data() + m * d;
    FlatDistance flat;
    flat.set_flat(points, d, 0);
    const Rational square = squared_distance(exact(x, d), exact_points);
    const double bound = flat.bound(x);
    EXPECT_GE(Rational(bound) * Rational(bound), square) << trial;
    if (trial % 5 != 0) {
      const Rational relative = square / (Rational(scale) * Rational(scale));
      EXPECT_LE(bound / scale, std::sqrt(relative.convert_to<double>()) + 1e-13) << trial;
    }
    for (std::size_t i = 0; i < m; ++i) EXPECT_LE(flat.bound(points[i]), scale * 1e-14);
  }
}

TEST(FlatDistance, OfASegmentEndsThere) {
  const double p[] = {0, 0}, q[] = {4, 0}, beyond[] = {7, 4}, beside[] = {1, 2};
  const double* ends[] = {p, q};
  FlatDistance segment;
  segment.set_flat(ends, 2, 0);
  EXPECT_NEAR(segment.segment_bound(beyond), 5, 1e-14);
  EXPECT_NEAR(segment.bound(beyond), 4, 1e-14);
  EXPECT_NEAR(segment.segment_bound(beside), 2, 1e-14);
}

}  // namespace
}  // namespace delone::kernel
