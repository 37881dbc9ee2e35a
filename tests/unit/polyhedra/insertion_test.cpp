// SPDX-License-Identifier: BSD-3-Clause
// Insertion finds the rays that the double description method finds, and the rows that are facets.
#include "polyhedra/insertion.hpp"

#include "cone_support.hpp"
#include "polyhedra/cone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace delone::polyhedra {
namespace {

constexpr double enough = 60;

/// Distinct primitive rows, independent ones first, with the rays of these: as find_rays() makes them.
PointedCone cone_of(const Rows& rows, std::size_t d) {
  PointedCone cone;
  std::set<Row> known;
  Rows others;
  Echelon echelon(d);
  for (Row row : rows) {
    make_primitive(row);
    if (is_zero(row) || !known.insert(row).second) continue;
    (echelon.rank() < d && echelon.add(row) ? cone.rows : others).push_back(row);
  }
  if (echelon.rank() < d) return {};
  cone.rows.insert(cone.rows.end(), others.begin(), others.end());
  for (std::size_t i = 0; i < d; ++i) {
    Rows rest;
    for (std::size_t j = 0; j < d; ++j)
      if (j != i) rest.push_back(cone.rows[j]);
    Row ray = Echelon(d, rest).kernel().front();
    if (scalar_product(ray, cone.rows[i]) < 0)
      for (Integer& x : ray) x = -x;
    cone.first_rays.push_back(ray);
  }
  return cone;
}

/// Whether there was a result, which is the same then.
bool expect_the_same(const Rows& rows, std::size_t d) {
  const PointedCone cone = cone_of(rows, d);
  if (cone.rows.empty()) return false;
  const std::optional<PointedRays> found = find_rays_by_insertion(cone, enough).rays;
  if (!found) return false;
  const PointedRays expected = find_rays_by_steps(cone);
  std::map<Row, std::size_t> number;
  for (std::size_t i = 0; i < found->rays.size(); ++i) EXPECT_TRUE(number.emplace(found->rays[i], i).second);
  EXPECT_EQ(number.size(), expected.rays.size());
  const BitRows columns = expected.zeros.transposed(cone.rows.size());
  std::vector<char> is_facet(cone.rows.size());
  for (std::size_t row = 0; row < cone.rows.size(); ++row) {
    Rows on;
    for_each(columns[row], [&](std::size_t ray) { on.push_back(expected.rays[ray]); });
    is_facet[row] = Echelon(d, on).rank() + 1 == d;
  }
  for (std::size_t i = 0; i < expected.rays.size(); ++i) {
    const auto at = number.find(expected.rays[i]);
    EXPECT_NE(at, number.end());
    if (at == number.end()) continue;
    for (std::size_t row = 0; row < cone.rows.size(); ++row) {
      const bool lies_on_it = test(found->zeros[at->second], row);
      if (lies_on_it || is_facet[row] != 0) {
        EXPECT_EQ(lies_on_it, test(expected.zeros[i], row));
      }
    }
  }
  return true;
}

TEST(Insertion, Points) {
  random::Generator generator(1);
  int count = 0;
  for (int round = 0; round < 150; ++round) {
    const std::size_t d = 3 + generator.below(5);
    const Integer largest = Integer(1) << std::vector<int>{0, 1, 10, 40, 52}[generator.below(5)];
    Rows rows = random_rows(generator, d + generator.below(16), d, largest);
    for (Row& row : rows) row.back() = 1 << generator.below(3);
    count += expect_the_same(rows, d);
  }
  EXPECT_GT(count, 100);
}

TEST(Insertion, Halfspaces) {
  random::Generator generator(2);
  int count = 0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t d = 3 + generator.below(5);
    const Integer largest = Integer(1) << std::vector<int>{0, 1, 10, 40, 52}[generator.below(5)];
    Rows rows = random_rows(generator, d + generator.below(12), d, largest);
    for (Row& row : rows)
      if (generator.below(4) != 0) row.back() = 1 + generator.below(3);  // has points inside, often
    Row infinity(d, Integer(0));
    infinity.back() = 1;
    rows.push_back(infinity);
    count += expect_the_same(rows, d);
  }
  EXPECT_GT(count, 100);
}

/// Flat cones, numbers that are no doubles, and sets that take long.
TEST(Insertion, SaysNo) {
  EXPECT_FALSE(expect_the_same({{1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}, 4));
  EXPECT_FALSE(expect_the_same({{1, 0, 0, 3}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}}, 4)) << "a third";
  const Integer large = (Integer(1) << 60) + 1;
  EXPECT_FALSE(expect_the_same({{large, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0, 0, 0, 1}}, 4));
  Rows grid;
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 9; ++y)
      for (int z = 0; z < 9; ++z)
        for (int t = 0; t < 9; ++t)
          for (int s = 0; s < 3; ++s) grid.push_back({x, y, z, t, s, 1});
  const InsertedRays stopped = find_rays_by_insertion(cone_of(grid, 6), 0);
  EXPECT_FALSE(stopped.rays);
  EXPECT_TRUE(stopped.can_go_on);
  EXPECT_LT(stopped.fraction, 1);
  EXPECT_FALSE(find_rays_by_insertion(cone_of({{1, 0, 0, 3}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}}, 4), 9)
                   .can_go_on);
}

}  // namespace
}  // namespace delone::polyhedra
