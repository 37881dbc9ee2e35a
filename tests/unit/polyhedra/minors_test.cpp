// SPDX-License-Identifier: BSD-3-Clause
// Minors and sums of magnitudes against all permutations.
#include "polyhedra/minors.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace delone::polyhedra {
namespace {

using Numbers = std::vector<std::int64_t>;

/// The sum over all permutations of columns, without one of them; with signs, or of magnitudes.
std::int64_t minor_without(const std::vector<Numbers>& rows, std::size_t column, bool is_magnitude) {
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c <= rows.size(); ++c)
    if (c != column) columns.push_back(c);
  std::int64_t sum = 0;
  do {
    std::int64_t product = 1;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      product *= is_magnitude ? std::abs(rows[i][columns[i]]) : rows[i][columns[i]];
      for (std::size_t j = 0; j < i && !is_magnitude; ++j)
        if (columns[j] > columns[i]) product = -product;
    }
    sum += product;
  } while (std::next_permutation(columns.begin(), columns.end()));
  return sum;
}

TEST(Minors, AreSumsOverPermutations) {
  random::Generator random(3);
  for (std::size_t d = 1; d <= most_rows_of_minors; ++d)
    for (int repeat = 0; repeat < 5; ++repeat) {
      std::vector<Numbers> rows(d, Numbers(d + 1));
      for (Numbers& row : rows)
        for (std::int64_t& x : row) x = static_cast<std::int64_t>(random.below(9)) - 4;
      if (repeat == 4 && d > 1) rows[d - 1] = rows[0];  // dependent: all are 0
      Numbers signed_minors(d + 1), magnitudes(d + 1);
      find_minors(
          d, [&](std::size_t i, std::size_t c) { return rows[i][c]; }, signed_minors.data());
      find_minors<true>(
          d, [&](std::size_t i, std::size_t c) { return std::abs(rows[i][c]); }, magnitudes.data());
      for (std::size_t c = 0; c <= d; ++c) {
        EXPECT_EQ(signed_minors[c], (c % 2 == 0 ? 1 : -1) * minor_without(rows, c, false)) << d;
        EXPECT_EQ(magnitudes[c], minor_without(rows, c, true)) << d;
      }
      for (const Numbers& row : rows)
        EXPECT_EQ(std::inner_product(row.begin(), row.end(), signed_minors.begin(), std::int64_t{0}), 0);
    }
}

}  // namespace
}  // namespace delone::polyhedra
