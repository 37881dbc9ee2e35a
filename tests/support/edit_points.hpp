// SPDX-License-Identifier: BSD-3-Clause
// Points one by one for histories of edits: general ones, and such that almost every edit makes or ends ties,
// flats and duplicates. Reproducible from the source of random numbers.
#pragma once

#include "degenerate.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace delone::test {

enum class EditWorld {
  uniform,
  lattice,      ///< few integers, zeros of either sign
  cospherical,  ///< integers on one sphere, and its center
  flats,        ///< in flats of all dimensions, parallel to axes or tilted
  ulps,         ///< integers, some to the next double
  turned,       ///< a grid turned by an angle with sine 0.6: no point is where it should be
  exponents,    ///< from 10^−300 to 10^300
  denormal,     ///< multiples of the smallest double
  huge,         ///< multiples of 10^307
};
inline constexpr std::array edit_worlds{EditWorld::uniform,   EditWorld::lattice,  EditWorld::cospherical,
                                        EditWorld::flats,     EditWorld::ulps,     EditWorld::turned,
                                        EditWorld::exponents, EditWorld::denormal, EditWorld::huge};
inline const char* name(EditWorld world) {
  static constexpr const char* names[] = {"uniform", "lattice",   "cospherical", "flats", "ulps",
                                          "turned",  "exponents", "denormal",    "huge"};
  return names[static_cast<int>(world)];
}

inline std::vector<double> new_point(EditWorld world, int dimension, Random& random) {
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<double> x(d, 0.0);
  switch (world) {
    case EditWorld::uniform:
      for (double& c : x) c = random.real();
      break;
    case EditWorld::lattice:
      for (double& c : x) c = random.integer(0, 2) * (random.integer(0, 2) == 0 ? -1.0 : 1.0);
      for (double& c : x)
        if (c < 0) c = -0.0;
      break;
    case EditWorld::cospherical: {
      const std::size_t i = random.bits() % d, j = random.bits() % d;
      const auto sign = [&] { return random.integer(0, 1) == 0 ? -1 : 1; };
      if (random.integer(0, 9) == 0) break;
      if (i == j) {
        x[i] = 5 * sign();
      } else {
        x[i] = 3 * sign();
        x[j] = 4 * sign();
      }
      break;
    }
    case EditWorld::flats: {
      const int k = random.integer(0, dimension);
      const bool is_tilted = random.integer(0, 1) == 0;
      for (int i = 0; i < k; ++i) x[static_cast<std::size_t>(i)] = random.integer(0, 3);
      if (is_tilted && d > 1) x[d - 1] += x[0] - (d > 2 ? 2 * x[1] : 0);
      break;
    }
    case EditWorld::ulps:
      for (double& c : x) {
        c = random.integer(1, 4);
        if (const int way = random.integer(0, 5); way < 2) c = std::nextafter(c, way == 0 ? 0.0 : 9.0);
      }
      break;
    case EditWorld::turned:
      for (std::size_t j = 0; j < d; ++j) x[j] = random.integer(-2, 2);
      for (std::size_t j = 0; j + 1 < d; j += 2) {
        const double a = x[j], b = x[j + 1];
        x[j] = 0.8 * a - 0.6 * b;
        x[j + 1] = 0.6 * a + 0.8 * b;
      }
      break;
    case EditWorld::exponents:
      for (double& c : x)
        if (random.integer(0, 7) != 0) c = std::ldexp(random.integer(-7, 7) | 1, random.integer(-1000, 1000));
      break;
    case EditWorld::denormal:
      for (double& c : x) c = random.integer(-2, 2) * 0x1p-1074;
      break;
    case EditWorld::huge:
      for (double& c : x) c = random.integer(-9, 9) * 1e307;
      break;
  }
  return x;
}

/// A place nearby: one coordinate is another one.
inline std::vector<double> nudged_point(EditWorld world, std::vector<double> x, Random& random) {
  double& c = x[random.bits() % x.size()];
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double way = random.integer(0, 1) == 0 ? -1 : 1;
  switch (world) {
    case EditWorld::uniform:
      c += 1e-3 * (random.real() - 0.5);
      break;
    case EditWorld::ulps:
    case EditWorld::turned:
    case EditWorld::huge:
      c = c == 0 ? way : std::nextafter(c, way * infinity);
      break;
    case EditWorld::denormal:
      c += way * 0x1p-1074;
      break;
    case EditWorld::exponents:
      c *= way * 0x1p-3;
      break;
    default:
      c += way;
  }
  return std::isfinite(c) ? x : std::vector<double>(x.size(), 0.0);
}

/// Weights that hide some points, and let them come back.
inline double new_weight(EditWorld world, Random& random) {
  switch (world) {
    case EditWorld::uniform:
      return 0.3 * (random.real() - 0.5);
    case EditWorld::exponents:
      return random.integer(0, 1) == 0 ? 0 : std::ldexp(random.integer(-7, 7), random.integer(-600, 600));
    case EditWorld::denormal:
      return random.integer(-3, 3) * 0x1p-1074;
    case EditWorld::huge:
      return random.integer(-3, 3) * 1e307;
    case EditWorld::ulps:
      return std::nextafter(random.integer(0, 3), random.integer(-1, 5));
    default:
      return random.integer(-1, 4);
  }
}

}  // namespace delone::test
