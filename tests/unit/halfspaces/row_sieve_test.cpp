// SPDX-License-Identifier: BSD-3-Clause
// The route with the sieve and the one without give the same intersection: of random halfspaces, of such that
// touch it or miss that by one unit in the last place, and at the ends of the range.
#include "halfspaces/row_sieve.hpp"

#include "degenerate.hpp"

#include <delone/halfspaces.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <vector>

namespace delone::halfspaces {
namespace {

constexpr std::size_t many = 2100;

struct Halfspaces {
  int dimension;
  std::vector<double> rows, point;  // a point strictly inside
};

/// What does not depend on the numbering of vertices and directions.
void expect_same(const Halfspaces& given) {
  const auto make = [&](InsertionOrder order) {
    Options options;
    options.order = order;
    return HalfspaceIntersection(given.rows, given.dimension, given.point, options).to_data();
  };
  const IntersectionData a = make(InsertionOrder::automatic), b = make(InsertionOrder::shuffled);
  const auto canonical = [&](const IntersectionData& data) {
    std::map<std::vector<SignedIndex>, std::vector<double>> vertices;
    for (std::size_t v = 0; v < data.num_vertices(); ++v)
      vertices.emplace(
          std::vector<SignedIndex>(
              data.vertex_halfspaces.begin() + static_cast<std::ptrdiff_t>(data.vertex_offsets[v]),
              data.vertex_halfspaces.begin() + static_cast<std::ptrdiff_t>(data.vertex_offsets[v + 1])),
          std::vector<double>(data.vertex(v).begin(), data.vertex(v).end()));
    return vertices;
  };
  EXPECT_EQ(a.kinds, b.kinds);
  EXPECT_EQ(a.first_of_halfspace, b.first_of_halfspace);
  EXPECT_EQ(a.facet_halfspaces, b.facet_halfspaces);
  EXPECT_EQ(a.bounded, b.bounded);
  EXPECT_EQ(a.edges.size(), b.edges.size());
  EXPECT_EQ(a.rays.size(), b.rays.size());
  EXPECT_EQ(a.directions.size(), b.directions.size());
  EXPECT_EQ(canonical(a), canonical(b));
}

/// The number of rows that are removed. Each row with a normal stays or is removed, once.
std::size_t count_removed(const Halfspaces& given) {
  const auto d = static_cast<std::size_t>(given.dimension);
  InteriorPoint point;
  point.rounded = given.point;
  std::vector<Index> all;
  for (Index row = 0; row * (d + 1) < given.rows.size(); ++row)
    if (std::any_of(&given.rows[row * (d + 1)], &given.rows[row * (d + 1)] + d,
                    [](double x) { return x != 0; }))
      all.push_back(row);
  std::vector<Index> staying = all;
  const std::vector<Index> removed = remove_redundant(given.rows, point, {}, staying);
  std::vector<Index> both;
  std::merge(staying.begin(), staying.end(), removed.begin(), removed.end(), std::back_inserter(both));
  EXPECT_EQ(both, all);
  return removed.size();
}

/// Halfspaces at distances from 1 to 1 + depth of the origin.
Halfspaces at_distances(int d, double depth, std::uint64_t seed) {
  test::Random random(seed);
  Halfspaces result{d, {}, std::vector<double>(static_cast<std::size_t>(d), 0.0)};
  for (std::size_t r = 0; r < many; ++r) {
    double square = 0;
    std::vector<double> normal;
    for (int j = 0; j < d; ++j) {
      normal.push_back(2 * random.real() - 1);
      square += normal.back() * normal.back();
    }
    result.rows.insert(result.rows.end(), normal.begin(), normal.end());
    result.rows.push_back(-std::sqrt(square) * (1 + depth * random.real()));
  }
  return result;
}

/// A cube of side 2 and halfspaces with small integers as normals that touch one of its corners, or are one
/// unit in the last place off.
Halfspaces touching_a_cube(int d, std::uint64_t seed) {
  test::Random random(seed);
  Halfspaces result{d, {}, {}};
  for (int j = 0; j < d; ++j) {
    result.point.push_back(0.1 * (j + 1));
    for (const double side : {-1.0, 1.0}) {
      for (int c = 0; c < d; ++c) result.rows.push_back(c == j ? side : 0.0);
      result.rows.push_back(-1);
    }
  }
  while (result.rows.size() < 2 * many * static_cast<std::size_t>(d + 1)) {
    double sum = 0;
    for (int j = 0; j < d; ++j) {
      result.rows.push_back(random.integer(-99, 99));
      sum += std::fabs(result.rows.back());
    }
    const int off = random.integer(-8, 1);
    result.rows.push_back(sum == 0 ? -1 : off < 0 ? -sum * 1.5 : off == 0 ? -sum : -std::nextafter(sum, 100));
  }
  return result;
}

TEST(RowSieve, RemovesRedundantHalfspaces) {
  for (int d = 2; d <= 4; ++d) {
    const Halfspaces deep = at_distances(d, 1, 7);
    EXPECT_GT(count_removed(deep), d < 4 ? many / 2 : many / 8) << d;
    expect_same(deep);
    if (d == 4) break;
    const Halfspaces cube = touching_a_cube(d, 3);
    EXPECT_GT(count_removed(cube), many / 2) << d;
    expect_same(cube);
  }
  const Halfspaces shallow = at_distances(2, 1e-9, 5);
  count_removed(shallow);
  expect_same(shallow);
}

TEST(RowSieve, OfUnboundedIntersectionsAndCopies) {
  Halfspaces half = at_distances(3, 1, 9);
  for (std::size_t i = 2; i < half.rows.size(); i += 4) half.rows[i] = -std::fabs(half.rows[i]);
  EXPECT_GT(count_removed(half), many / 4);
  expect_same(half);
  Halfspaces twice = at_distances(3, 1, 9);
  for (std::size_t i = 0; i < many * 4; ++i) twice.rows.push_back(2 * twice.rows[i]);
  expect_same(twice);
}

TEST(RowSieve, AtTheEndsOfTheRange) {
  Halfspaces scaled = at_distances(3, 1, 2);
  for (std::size_t r = 0; r < many; ++r)
    for (std::size_t j = 0; j < 4; ++j)
      scaled.rows[r * 4 + j] *= r % 3 == 0 ? 0x1p-900 : r % 3 == 1 ? 0x1p900 : 1;
  EXPECT_GT(count_removed(scaled), many / 2);
  expect_same(scaled);
  // Dual points between 2⁻⁷⁰⁰ and 2⁷⁰⁰, some of them beyond the range of doubles.
  for (const double far : {0x1p700, 0x1p1000}) {
    Halfspaces spread = at_distances(2, 1, 4);
    for (std::size_t r = 0; r < many; r += 5) spread.rows[r * 3 + 2] /= far;
    for (std::size_t r = 1; r < many; r += 5) spread.rows[r * 3 + 2] *= far;
    if (far > 0x1p900)
      for (std::size_t j = 0; j < 2; ++j) spread.rows[j] *= 0x1p100;
    count_removed(spread);
    expect_same(spread);
  }
}

bool same_vertices(const IntersectionVertices& some, const IntersectionData& all) {
  return some.bounded == all.bounded && some.vertices == all.vertices &&
         some.vertex_offsets == all.vertex_offsets && some.vertex_halfspaces == all.vertex_halfspaces;
}

// Whether or not redundant rows have sites yet.
TEST(RowSieve, VerticesAreThoseOfAllArrays) {
  Halfspaces open = at_distances(3, 1, 9);
  for (std::size_t i = 2; i < open.rows.size(); i += 4) open.rows[i] = -std::fabs(open.rows[i]);
  for (const Halfspaces& given :
       {at_distances(2, 1, 7), at_distances(4, 1, 7), touching_a_cube(3, 3), open}) {
    const HalfspaceIntersection all(given.rows, given.dimension, given.point);
    const IntersectionVertices before = all.to_vertices();
    const std::size_t num_cells = all.num_cells();
    EXPECT_TRUE(same_vertices(before, all.clone().data()));
    EXPECT_TRUE(same_vertices(before, all.data()));
    EXPECT_TRUE(same_vertices(all.to_vertices(), all.data()));
    EXPECT_EQ(all.num_cells(), num_cells);
    EXPECT_EQ(all.dual_volume().value, all.clone().dual_volume().value);
  }
}

// The first of equal rows is removed, and a later one on its ray may stay.
TEST(RowSieve, FirstRowsOfRays) {
  Halfspaces given = at_distances(3, 1, 9);
  for (std::size_t i = 0; i < many * 4; ++i) given.rows.push_back(given.rows[i] * 3);
  for (std::size_t i = 0; i < many * 4; ++i) given.rows[i] /= 7;
  for (std::size_t i = 0; i < many * 4; ++i) given.rows.push_back(given.rows[i] * 7);
  expect_same(given);
}

TEST(RowSieve, LaterRowsMayComeCloser) {
  const Halfspaces deep = at_distances(3, 1, 6);
  HalfspaceIntersection all(deep.rows, 3, deep.point);
  std::vector<double> more = at_distances(3, 1, 8).rows;
  for (std::size_t i = 3; i < more.size(); i += 4) more[i] /= 2;
  all.insert_range(more);
  Halfspaces both = deep;
  both.rows.insert(both.rows.end(), more.begin(), more.end());
  Options shuffled;
  shuffled.order = InsertionOrder::shuffled;
  const HalfspaceIntersection at_once(both.rows, 3, both.point, shuffled);
  EXPECT_EQ(all.data().kinds, at_once.data().kinds);
  EXPECT_EQ(all.num_vertices(), at_once.num_vertices());
  EXPECT_LT(all.count(HalfspaceKind::facet), many / 2);
}

}  // namespace
}  // namespace delone::halfspaces
