// SPDX-License-Identifier: BSD-3-Clause
// Adjacent rays are those that no third ray separates, with and without the search among simple rays.
#include "polyhedra/adjacency.hpp"

#include "cone_support.hpp"
#include "polyhedra/cone.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace delone::polyhedra {
namespace {

using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

Pairs pairs_by_definition(const BitRows& zeros) {
  Pairs pairs;
  for (std::size_t i = 0; i < zeros.size(); ++i)
    for (std::size_t j = i + 1; j < zeros.size(); ++j) {
      std::vector<std::uint64_t> common(zeros[i].begin(), zeros[i].end());
      for (std::size_t w = 0; w < common.size(); ++w) common[w] &= zeros[j][w];
      bool is_adjacent = true;
      for (std::size_t k = 0; k < zeros.size(); ++k)
        if (k != i && k != j && contains(zeros[k], common)) is_adjacent = false;
      if (is_adjacent) pairs.emplace(i, j);
    }
  return pairs;
}

Pairs found_pairs(const BitRows& zeros, std::size_t width, std::size_t dimension, bool joins,
                  unsigned threads = 1) {
  Adjacency adjacency;
  adjacency.reset(zeros.size(), width, dimension);
  for (std::size_t i = 0; i < zeros.size(); ++i)
    std::copy(zeros[i].begin(), zeros[i].end(), adjacency.rows(i).begin());
  Pairs pairs;
  const auto add = [&](std::uint32_t i, std::uint32_t j) {
    EXPECT_TRUE(pairs.emplace(std::min(i, j), std::max(i, j)).second);
  };
  if (joins)
    for (const auto& [i, j] : adjacency.join_simple_rays(threads)) add(i, j);
  adjacency.compare([](std::uint32_t i) { return i; }, [](std::uint32_t, std::uint32_t) { return true; }, add,
                    threads);
  return pairs;
}

void expect_the_same_pairs(const Rows& rows, std::size_t dimension) {
  const ConeRays cone = find_rays(rows, {}, dimension);
  ASSERT_TRUE(cone.lines.empty());
  const Pairs expected = pairs_by_definition(cone.zeros);
  EXPECT_EQ(found_pairs(cone.zeros, rows.size(), dimension, false), expected);
  EXPECT_EQ(found_pairs(cone.zeros, rows.size(), dimension, true), expected);
}

/// The cone over the cube [−1, 1]^d, cut at some corners, so that simple rays and others are mixed.
Rows cut_cube(std::size_t d, std::size_t cuts, std::int64_t depth) {
  Rows rows;
  for (std::size_t i = 0; i < d; ++i)
    for (const int sign : {1, -1}) {
      Row row(d + 1, Integer(0));
      row[i] = sign;
      row[d] = 1;
      rows.push_back(row);
    }
  for (std::size_t corner = 0; corner < cuts; ++corner) {
    Row row;
    for (std::size_t i = 0; i < d; ++i) row.emplace_back((corner * 37 >> i & 1) != 0 ? 1 : -1);
    row.emplace_back(static_cast<std::int64_t>(d) - depth);
    rows.push_back(row);
  }
  return rows;
}

TEST(Adjacency, OfSimpleAndOtherRays) {
  expect_the_same_pairs(cut_cube(8, 0, 1), 9);  // all are simple
  expect_the_same_pairs(cut_cube(8, 5, 2), 9);  // some cuts go through corners
  expect_the_same_pairs(cut_cube(7, 30, 4), 8);
  expect_the_same_pairs(cut_cube(3, 8, 2), 4);
}

TEST(Adjacency, OfRandomCones) {
  random::Generator generator(6);
  for (int round = 0; round < 60; ++round) {
    const std::size_t d = 3 + generator.below(3);
    Rows rows;
    for (std::size_t i = 0; i < 25; ++i) {
      Row row;
      for (std::size_t c = 0; c + 1 < d; ++c) row.push_back(random_integer(generator, 2));
      row.emplace_back(3);
      rows.push_back(row);
    }
    for (std::size_t i = 0; i + 1 < d; ++i)
      for (const int sign : {1, -1}) {
        Row row(d, Integer(0));
        row[i] = sign;
        row[d - 1] = 2;
        rows.push_back(row);
      }
    const ConeRays cone = find_rays(rows, {}, d);
    if (!cone.lines.empty()) continue;
    const Pairs expected = pairs_by_definition(cone.zeros);
    EXPECT_EQ(found_pairs(cone.zeros, rows.size(), d, true), expected);
  }
}

/// As many rays as several threads share: of the cone over a cube.
TEST(Adjacency, TheSameForEveryNumberOfThreads) {
  constexpr std::size_t d = 13;
  BitRows zeros(std::size_t{1} << d, 2 * d);
  for (std::size_t ray = 0; ray < zeros.size(); ++ray)
    for (std::size_t axis = 0; axis < d; ++axis) insert(zeros[ray], 2 * axis + (ray >> axis & 1));
  Pairs expected;
  for (std::size_t ray = 0; ray < zeros.size(); ++ray)
    for (std::size_t axis = 0; axis < d; ++axis)
      if ((ray >> axis & 1) == 0) expected.emplace(ray, ray | std::size_t{1} << axis);
  for (const unsigned threads : {1u, 3u})
    for (const bool joins : {false, true})
      EXPECT_EQ(found_pairs(zeros, 2 * d, d + 1, joins, threads), expected) << threads << joins;
}

}  // namespace
}  // namespace delone::polyhedra
