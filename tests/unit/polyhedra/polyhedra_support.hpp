// SPDX-License-Identifier: BSD-3-Clause
// Polyhedra and rational numbers for the tests.
#pragma once

#include "cone_support.hpp"

#include <delone/polyhedron.hpp>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace delone::polyhedra {

inline brute_force::Number as_fraction(const Rational& x) { return brute_force::Number(x.to_string()); }
inline Rational as_rational(const brute_force::Number& x) { return Rational(x.str()); }

inline brute_force::Number value_at(std::span<const Rational> function, std::span<const Rational> x) {
  brute_force::Number sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += as_fraction(function[i]) * as_fraction(x[i]);
  return sum;
}

/// Small fractions, many of them 0, some rows twice.
inline RationalRows random_rationals(random::Generator& generator, std::size_t count, std::size_t width,
                                     int largest) {
  RationalRows rows;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Rational> row;
    for (std::size_t c = 0; c < width; ++c) {
      const int x = static_cast<int>(generator.below(static_cast<std::uint64_t>(2 * largest + 1))) - largest;
      row.emplace_back(Rational(x), Rational(generator.below(6) == 0 ? 3 : 1));
    }
    if (i > 0 && generator.below(6) == 0) row.assign(rows[i - 1].begin(), rows[i - 1].end());
    rows.push_back(row);
  }
  return rows;
}

inline Polyhedron box(int d, const Rational& lower, const Rational& upper) {
  RationalRows rows;
  for (int i = 0; i < d; ++i)
    for (const int sign : {1, -1}) {
      std::vector<Rational> row(static_cast<std::size_t>(d) + 1);
      row[static_cast<std::size_t>(i)] = sign;
      row.back() = sign > 0 ? upper : as_rational(-as_fraction(lower));
      rows.push_back(row);
    }
  return Polyhedron::from_inequalities(rows, {}, d);
}
inline Polyhedron unit_cube(int d) { return box(d, 0, 1); }
inline Polyhedron cube_around_origin(int d) { return box(d, -1, 1); }

inline RationalRows permutations(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 1);
  RationalRows rows;
  do rows.push_back(std::vector<Rational>(order.begin(), order.end()));
  while (std::next_permutation(order.begin(), order.end()));
  return rows;
}

inline RationalRows moment_curve(int n, int d) {
  RationalRows rows;
  for (int t = 0; t < n; ++t) {
    std::vector<Rational> row;
    std::int64_t power = 1;
    for (int i = 0; i < d; ++i) row.emplace_back(power *= t);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace delone::polyhedra
