// SPDX-License-Identifier: BSD-3-Clause
// The canonical orders, against comparisons of fractions; the same for every number of threads.
#include "polyhedra/sorted_rows.hpp"

#include "cone_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace delone::polyhedra {
namespace {

using Coordinate = brute_force::Number;

/// Distinct rows; the last entry is positive, or also 0.
Rows distinct_rows_of(random::Generator& generator, std::size_t count, std::size_t width, int bits,
                      int bits_of_last, bool has_rays) {
  std::set<Row> rows;
  for (std::size_t i = 0; i < count; ++i) {
    Row row;
    for (std::size_t c = 0; c + 1 < width; ++c)
      row.push_back(
          random_integer(generator, Integer(1) << generator.below(static_cast<std::uint64_t>(bits) + 1)));
    row.push_back(abs(random_integer(generator, Integer(1) << bits_of_last)) + 1);
    if (bits_of_last == 0) row.back() = 1;
    if (has_rays && generator.below(3) == 0) row.back() = 0;
    make_primitive(row);
    if (!is_zero(row)) rows.insert(row);
  }
  return {rows.begin(), rows.end()};
}

std::tuple<bool, std::vector<Coordinate>> place_of(const Row& generator) {
  std::vector<Coordinate> coordinates;
  for (std::size_t c = 0; c + 1 < generator.size(); ++c)
    coordinates.push_back(generator.back() == 0 ? Coordinate(generator[c])
                                                : Coordinate(generator[c], generator.back()));
  return {generator.back() == 0, coordinates};
}

TEST(SortedRows, GeneratorsAsFractions) {
  random::Generator generator(3);
  for (int round = 0; round < 300; ++round) {
    const int bits_of_last = std::vector<int>{0, 0, 2, 20, 90}[generator.below(5)];
    const Rows given = distinct_rows_of(generator, generator.below(60), 1 + generator.below(5),
                                        std::vector<int>{1, 3, 20, 64, 200}[generator.below(5)], bits_of_last,
                                        generator.below(2) == 0);
    Rows sorted = given;
    const std::vector<std::size_t> order = sort_generators(sorted, 1);
    ASSERT_EQ(order.size(), given.size());
    for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(sorted[i], given[order[i]]);
    for (std::size_t i = 1; i < order.size(); ++i) ASSERT_LT(place_of(sorted[i - 1]), place_of(sorted[i]));
  }
}

TEST(SortedRows, Inequalities) {
  random::Generator generator(4);
  for (int round = 0; round < 300; ++round) {
    const int bits = std::vector<int>{1, 3, 20, 64, 200}[generator.below(5)];
    Rows rows = distinct_rows_of(generator, generator.below(60), 1 + generator.below(30), bits, bits, true);
    for (Row& row : rows)
      if (generator.below(2) == 0) row.back() = -row.back();
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    sort_inequalities(rows, 1);
    const auto as_inequality = [](Row row) {
      for (std::size_t c = 0; c + 1 < row.size(); ++c) row[c] = -row[c];
      return row;
    };
    for (std::size_t i = 1; i < rows.size(); ++i)
      ASSERT_LT(as_inequality(rows[i - 1]), as_inequality(rows[i]));
  }
}

TEST(SortedRows, TheSameForEveryNumberOfThreads) {
  random::Generator generator(5);
  for (const int bits : {2, 40}) {
    const Rows given = distinct_rows_of(generator, 40000, 7, bits, bits, true);
    ASSERT_GT(given.size(), 20000u);
    Rows one = given, three = given;
    EXPECT_EQ(sort_generators(one, 1), sort_generators(three, 3));
    EXPECT_EQ(one, three);
    EXPECT_EQ(sort_inequalities(one, 1), sort_inequalities(three, 3));
  }
}

}  // namespace
}  // namespace delone::polyhedra
