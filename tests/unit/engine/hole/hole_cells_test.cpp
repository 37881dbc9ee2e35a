// SPDX-License-Identifier: BSD-3-Clause
// Cells that fill a hole are linked, and wrong links are noticed.
#include "engine/hole/hole_cells.hpp"

#include "../engine_support.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace delone::engine {
namespace {

/// A tetrahedron with vertex 5 inside, which leaves: one cell fills its place.
class HoleOfOneCell : public testing::Test {
 protected:
  HoleOfOneCell() : points_({0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8, 1, 1, 1}, 3, 0, 2) {
    points_.seed();
    points_.build.insert(5);
    auto& cells = points_.build.cells();
    Index cell = 0;
    while (cells.is_vacant(cell) || points_.build.geometry().is_infinite(cell)) ++cell;
    hole_.open_star(cells, points_.build.geometry(), 5, cell, zone_);
  }
  /// Adds the cell whose facet is that of the first cell of the hole.
  void add(std::size_t number = 0) {
    const Index* const inner = hole_.numbers_of_cell(0);
    Index apex = 1;
    while (std::find(inner, inner + 4, apex) != inner + 4) ++apex;
    found_.reserve(1);
    EXPECT_EQ(found_.add(inner, hole_.slot_of_leaving(0), apex, 0), number);
  }

  Points<3> points_;
  ConflictZone zone_;
  Hole<3> hole_;
  HoleCells<3> found_{3};
};

TEST_F(HoleOfOneCell, IsMatchedWithAllFacetsOfTheBorder) {
  ASSERT_EQ(hole_.border().size(), 4u);
  found_.begin(hole_);
  EXPECT_FALSE(found_.are_all_matched());
  add();
  EXPECT_TRUE(found_.are_all_matched());
  std::array<int, 4> open;
  EXPECT_EQ(found_.find_open(0, open.data()), 0u);
  for (std::uint32_t f = 0; f < 4; ++f) EXPECT_EQ(found_.beside(found_.beside(f)), f);
  EXPECT_TRUE(found_.are_matches_right());
  EXPECT_TRUE(found_.are_facets_the_same());
  EXPECT_TRUE(found_.have_all_vertices(hole_));
}

TEST_F(HoleOfOneCell, IsNotMatchedWithOtherFacets) {
  found_.begin(hole_);
  add();
  std::array<std::uint32_t, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end());
  int num_right = 0;
  do {
    found_.begin(hole_);
    add();
    for (std::uint32_t here = 0; here < 4; ++here) found_.link(found_.facet(here), order[here]);
    num_right += found_.are_facets_the_same() ? 1 : 0;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(num_right, 1);
}

TEST_F(HoleOfOneCell, IsNotFilledTwice) {
  found_.begin(hole_);
  for (std::size_t cell = 0; cell < 2; ++cell) add(cell);
  EXPECT_TRUE(found_.has_excess());
  EXPECT_FALSE(found_.are_all_matched());
}

/// Adds cells with any apexes, which may be on the same side of a facet, and links that are noted as they are
/// found must be judged as by sorting.
template <int K>
void expect_right_judgements() {
  SCOPED_TRACE(testing::Message() << K << "D");
  random::Generator random(static_cast<std::uint64_t>(K));
  const auto below = [&](std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(n)));
  };
  std::vector<double> rows;
  for (int i = 0; i <= K; ++i)
    for (int j = 0; j < K; ++j) rows.push_back(i == j + 1 ? 9 : 0);
  for (int i = 0; i < 10 * K * K; ++i) rows.push_back(0.1 + 0.8 * random.uniform());
  rows.insert(rows.end(), K, 0.5);  // the vertex that leaves
  Points<K> points(rows, K, 0, 9);
  points.seed();
  const auto last = static_cast<Index>(rows.size() / K);
  for (Index v = K + 2; v <= last; ++v) points.build.insert(v);
  auto& cells = points.build.cells();
  Index cell = 0;
  const auto has_last = [&] {
    const std::vector<Index> corners = points.corners(cell);
    return std::find(corners.begin(), corners.end(), last) != corners.end();
  };
  while (cells.is_vacant(cell) || !has_last()) ++cell;
  ConflictZone zone;
  Hole<K> hole;
  hole.open_star(cells, points.build.geometry(), last, cell, zone);
  HoleCells<K> found(K);
  int num_right = 0, num_wrong = 0;
  for (int round = 0; round < 300; ++round) {
    found.begin(hole);
    for (int step = 0; step < 12; ++step) {
      const Index* source = nullptr;
      int slot = 0;
      std::uint32_t across = 0;
      found.reserve(1);
      std::array<int, K + 1> open;
      const std::size_t from = found.size() == 0 ? 0 : below(found.size());
      const std::size_t num_open = found.size() == 0 ? 0 : found.find_open(from, open.data());
      if (num_open > 0) {
        source = found.vertices(from);
        slot = open[below(num_open)];
        across = found.facet(from * (K + 1) + static_cast<std::size_t>(slot));
      } else {
        across = static_cast<std::uint32_t>(below(hole.border().size()));
        if (found.beside(across) != found.none) continue;
        source = hole.numbers_of_cell(hole.border()[across].inner);
        slot = hole.border()[across].slot;
      }
      const auto apex = static_cast<Index>(1 + below(hole.vertices().size()));
      if (std::find(source, source + K + 1, apex) != source + K + 1) continue;
      found.add(source, slot, apex, across);
      if (found.has_excess()) break;
      EXPECT_EQ(found.are_matches_right(), found.are_facets_the_same());
      ++(found.are_matches_right() ? num_right : num_wrong);
    }
  }
  unmark(cells.marks(), zone);
  EXPECT_GT(num_right, 100);
  EXPECT_TRUE(K == 1 || num_wrong > 0);
}

TEST(HoleCells, JudgesLinksAsSortingDoes) {
  expect_right_judgements<1>();
  expect_right_judgements<2>();
  expect_right_judgements<3>();
  expect_right_judgements<4>();
  expect_right_judgements<5>();
  expect_right_judgements<6>();
  expect_right_judgements<7>();
}

}  // namespace
}  // namespace delone::engine
