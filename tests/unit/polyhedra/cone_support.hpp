// SPDX-License-Identifier: BSD-3-Clause
// Random cones, and what the tests of them share.
#pragma once

#include "base/random.hpp"
#include "cone_brute_force.hpp"
#include "polyhedra/integer_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::polyhedra {

inline Integer random_integer(random::Generator& generator, const Integer& largest) {
  Integer x = 0;
  for (int i = 0; i < 6; ++i) x = (x << 62) + static_cast<std::int64_t>(generator.bits() >> 2);
  return x % (2 * largest + 1) - largest;
}

/// Rows with entries up to `largest`, many of them 0; some are copies, multiples or sums of others.
inline Rows random_rows(random::Generator& generator, std::size_t count, std::size_t width,
                        const Integer& largest) {
  Rows rows;
  while (rows.size() < count) {
    Row row;
    for (std::size_t i = 0; i < width; ++i)
      row.push_back(generator.below(10) < 7 ? random_integer(generator, largest) : Integer(0));
    if (rows.size() > 1 && generator.below(5) == 0) {
      const Row &a = rows[generator.below(rows.size())], &b = rows[generator.below(rows.size())];
      const int factor = static_cast<int>(generator.below(3)) - 1;
      for (std::size_t i = 0; i < width; ++i) row[i] = 2 * a[i] + factor * b[i];
    }
    rows.push_back(row);
  }
  return rows;
}

inline brute_force::Matrix as_fractions(const Rows& rows) {
  brute_force::Matrix matrix;
  for (const Row& row : rows) {
    brute_force::Vector vector;
    for (const Integer& x : row) vector.emplace_back(x);
    matrix.push_back(vector);
  }
  return matrix;
}

}  // namespace delone::polyhedra
