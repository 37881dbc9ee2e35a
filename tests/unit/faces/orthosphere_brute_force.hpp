// SPDX-License-Identifier: BSD-3-Clause
// Smallest orthospheres and alpha values in rationals, by definition: over all sets of at most k+1 points.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace delone::test {

using Rational = boost::multiprecision::cpp_rational;

/// Rows of d coordinates and a weight.
using WeightedPoints = std::vector<std::vector<double>>;

struct RationalSphere {
  std::vector<Rational> barycentric;  // of the center
  std::vector<Rational> center;
  Rational square;
};

/// Of affinely independent points; nothing for others.
inline std::optional<RationalSphere> smallest_orthosphere(const WeightedPoints& points,
                                                          const std::vector<std::size_t>& rows) {
  const std::size_t n = rows.size() - 1, d = points[0].size() - 1;
  const auto at = [&](std::size_t i, std::size_t j) { return Rational(points[rows[i]][j]); };
  std::vector<std::vector<Rational>> a(n, std::vector<Rational>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    a[i][n] = (at(0, d) - at(i + 1, d)) / 2;
    for (std::size_t j = 0; j < d; ++j) {
      const Rational edge = at(i + 1, j) - at(0, j);
      a[i][n] += edge * edge / 2;
      for (std::size_t m = 0; m < n; ++m) a[i][m] += edge * (at(m + 1, j) - at(0, j));
    }
  }
  for (std::size_t s = 0; s < n; ++s) {
    if (a[s][s] == 0) return std::nullopt;  // a Gram matrix is singular if and only if a pivot is 0
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s) continue;
      const Rational factor = a[r][s] / a[s][s];
      for (std::size_t c = s; c <= n; ++c) a[r][c] -= factor * a[s][c];
    }
  }
  RationalSphere sphere;
  sphere.barycentric.assign(n + 1, Rational(1));
  for (std::size_t i = 0; i < n; ++i) {
    sphere.barycentric[i + 1] = a[i][n] / a[i][i];
    sphere.barycentric[0] -= sphere.barycentric[i + 1];
  }
  sphere.square = -at(0, d);
  for (std::size_t j = 0; j < d; ++j) {
    Rational x = 0;
    for (std::size_t i = 0; i <= n; ++i) x += sphere.barycentric[i] * at(i, j);
    sphere.center.push_back(x);
    sphere.square += (x - at(0, j)) * (x - at(0, j));
  }
  return sphere;
}

/// The least squared radius of an orthosphere of each set of at most k+1 points without a point strictly
/// inside; of those that have one. By increasing rows.
inline std::map<std::vector<std::size_t>, Rational> alpha_values_by_definition(const WeightedPoints& points,
                                                                               std::size_t k) {
  const std::size_t d = points[0].size() - 1;
  std::map<std::vector<std::size_t>, Rational> values;
  for (unsigned bits = 1; bits < 1u << points.size(); ++bits) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((bits >> i & 1) != 0) rows.push_back(i);
    if (rows.size() > k + 1) continue;
    const auto sphere = smallest_orthosphere(points, rows);
    if (!sphere) continue;
    bool is_empty = true;
    for (const std::vector<double>& p : points) {
      Rational power = -Rational(p[d]) - sphere->square;
      for (std::size_t j = 0; j < d; ++j)
        power += (sphere->center[j] - Rational(p[j])) * (sphere->center[j] - Rational(p[j]));
      is_empty = is_empty && power >= 0;
    }
    if (!is_empty) continue;
    for (unsigned part = 1; part < 1u << rows.size(); ++part) {
      std::vector<std::size_t> face;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if ((part >> i & 1) != 0) face.push_back(rows[i]);
      const auto [known, is_new] = values.emplace(face, sphere->square);
      if (!is_new && sphere->square < known->second) known->second = sphere->square;
    }
  }
  return values;
}

/// Whether x is the least double that is not below an exact number.
inline bool is_rounded_up(double x, const Rational& exact) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (x == -infinity || std::isnan(x)) return false;
  const double before = std::nextafter(x, -infinity);
  return (x == infinity || Rational(x) >= exact) && (before == -infinity || Rational(before) < exact);
}

}  // namespace delone::test
