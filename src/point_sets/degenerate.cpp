// SPDX-License-Identifier: BSD-3-Clause
// Exactly degenerate sets: in a hyperplane, on a line, on a sphere, repeated. All coordinates are integers,
// or short binary fractions, combined without rounding.
#include <delone/error.hpp>

#include "point_sets/kinds.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <utility>

namespace delone::point_sets {
namespace {

/// A uniform multiple of 2^−30 in [0, 1): sums of a few million small multiples stay exact.
double short_uniform(Generator& generator) { return static_cast<double>(generator.bits() >> 34) * 0x1p-30; }

/// A non-zero integer of −3 … 3.
double small_integer(Generator& generator) {
  return static_cast<double>(1 + generator.below(3)) * (generator.coin() ? 1 : -1);
}

/// A right triangle: leg_1² + leg_2² = hypotenuse², the hypotenuse a prime.
struct Triple {
  std::int64_t leg_1, leg_2, hypotenuse;
};
constexpr std::array<Triple, 10> triples{{{3, 4, 5},
                                          {5, 12, 13},
                                          {8, 15, 17},
                                          {20, 21, 29},
                                          {12, 35, 37},
                                          {9, 40, 41},
                                          {28, 45, 53},
                                          {11, 60, 61},
                                          {48, 55, 73},
                                          {39, 80, 89}}};

struct IntegerSphere {
  std::vector<std::int64_t> points;  ///< n×d
  std::int64_t radius = 1;
};

/// The rotations of a point, one triple for each: enough to make n points distinct and their coordinates
/// non-zero.
std::vector<Triple> turns_for(std::size_t d, std::size_t n) {
  std::vector<Triple> turns;
  if (d == 2) {  // rotations commute: m different primes give 4·3^m points; half of them at most are used
    for (std::size_t room = 4; room < 2 * n || turns.size() < 2; room *= 3) {
      if (turns.size() == triples.size())
        throw Error(Errc::invalid_argument,
                    "cospherical points in dimension 2: at most 118098 points can be made");
      turns.push_back(triples[turns.size()]);
    }
    return turns;
  }
  const std::size_t mixing = static_cast<std::size_t>(std::bit_width(d)) + 1;
  std::size_t count = 2;
  for (std::size_t room = 2; room < n && count < 22; room *= 4) ++count;
  return std::vector<Triple>(std::min<std::size_t>(std::max(count, mixing), 22), triples[0]);
}

/// Distinct integer points with |x|² = radius², from an axis point by rotations (a, b)/c with a² + b² = c² of
/// random pairs of axes. The radius is the product of all c, so every quotient is an integer.
IntegerSphere integer_sphere(std::size_t d, std::size_t n, Generator& generator) {
  if (d < 2) throw Error(Errc::invalid_argument, "cospherical points exist from dimension 2 on");
  const std::vector<Triple> turns = turns_for(d, n);
  IntegerSphere sphere;
  for (const Triple& turn : turns) sphere.radius *= turn.hypotenuse;
  std::unordered_set<std::string> seen;
  std::vector<std::int64_t> x(d);
  std::vector<std::size_t> axes(d);
  for (std::size_t j = 0; j < d; ++j) axes[j] = j;
  for (std::size_t attempts = 0; sphere.points.size() < n * d; ++attempts) {
    if (attempts > 100 * n + 1000)
      throw Error(Errc::invalid_argument,
                  "cospherical points: too many points for dimension " + std::to_string(d));
    std::fill(x.begin(), x.end(), 0);
    x[generator.below(d)] = generator.coin() ? sphere.radius : -sphere.radius;
    for (const Triple& turn : turns) {
      for (std::size_t j = d; j > 1; --j) std::swap(axes[j - 1], axes[generator.below(j)]);
      for (std::size_t j = 0; j + 1 < d; j += 2) {
        const std::uint64_t choice = generator.below(3);
        if (choice == 0) continue;
        std::int64_t& first = x[axes[j]];
        std::int64_t& second = x[axes[j + 1]];
        const std::int64_t a = turn.leg_1, b = choice == 1 ? turn.leg_2 : -turn.leg_2, u = first, v = second;
        first = (a * u - b * v) / turn.hypotenuse;
        second = (b * u + a * v) / turn.hypotenuse;
      }
    }
    const std::string key(reinterpret_cast<const char*>(x.data()), d * sizeof(std::int64_t));
    if (seen.insert(key).second) sphere.points.insert(sphere.points.end(), x.begin(), x.end());
  }
  return sphere;
}

}  // namespace

Coordinates make_flat(std::size_t d, std::size_t n, Generator& generator) {
  if (d < 2) throw Error(Errc::invalid_argument, "flat: a tilted hyperplane exists from dimension 2 on");
  std::vector<double> slope(d - 1);
  for (double& s : slope) s = small_integer(generator);
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) {
    double* p = x.data() + i * d;
    for (std::size_t j = 0; j + 1 < d; ++j) {
      p[j] = short_uniform(generator);
      p[d - 1] += slope[j] * p[j];
    }
  }
  return x;
}

Coordinates make_collinear(std::size_t d, std::size_t n, Generator& generator) {
  std::vector<double> origin(d), direction(d);
  for (double& v : origin) v = small_integer(generator);
  for (double& v : direction) v = small_integer(generator);
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = short_uniform(generator);
    for (std::size_t j = 0; j < d; ++j) x[i * d + j] = origin[j] + t * direction[j];
  }
  return x;
}

Coordinates make_equal(std::size_t d, std::size_t n, Generator& generator) {
  const Coordinates point = make_uniform(d, 1, generator);
  Coordinates x;
  x.reserve(n * d);
  for (std::size_t i = 0; i < n; ++i) x.insert(x.end(), point.begin(), point.end());
  return x;
}

Coordinates make_duplicates(std::size_t d, std::size_t n, Generator& generator) {
  const std::size_t distinct = n / 4 + 1;
  const Coordinates points = make_uniform(d, distinct, generator);
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(points.data() + generator.below(distinct) * d, d, x.data() + i * d);
  return x;
}

Coordinates make_cospherical(std::size_t d, std::size_t n, Generator& generator) {
  const IntegerSphere sphere = integer_sphere(d, n, generator);
  return Coordinates(sphere.points.begin(), sphere.points.end());
}

Coordinates make_ulp_sphere(std::size_t d, std::size_t n, Generator& generator) {
  // Each coordinate is the double nearest to that of a point exactly on the unit sphere.
  const IntegerSphere sphere = integer_sphere(d, n, generator);
  Coordinates x(n * d);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = static_cast<double>(sphere.points[i]) / static_cast<double>(sphere.radius);
  return x;
}

}  // namespace delone::point_sets
