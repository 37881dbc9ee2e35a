// SPDX-License-Identifier: BSD-3-Clause
// The octant of R³, cut by one plane after the other: which edges are kept for which row, and what numbers
// rays have.
#include "polyhedra/ray_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::vector<std::uint64_t> bits_of(const std::vector<std::size_t>& rows) {
  std::vector<std::uint64_t> bits(1, 0);
  for (const std::size_t row : rows) insert(bits, row);
  return bits;
}

NewRays new_rays(const std::vector<CutEdge>& edges, const std::vector<std::vector<std::size_t>>& zeros,
                 const std::vector<std::uint32_t>& first_negative, std::size_t num_rows) {
  NewRays made{edges, BitRows(edges.size(), num_rows), first_negative};
  for (std::size_t i = 0; i < zeros.size(); ++i)
    for (const std::size_t row : zeros[i]) insert(made.zeros[i], row);
  return made;
}

/// x, y, z ≥ 0; x + y ≥ z, which cuts off the ray of z; and another row.
class OctantGraph : public ::testing::Test {
 protected:
  /// `signs`: those of the last row at the rays of x, y and z.
  void start(const Row& last, const std::vector<int>& signs) {
    rows_ = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, -1}, last};
    graph_ = RayGraph(rows_);
    for (std::size_t ray = 0; ray < 3; ++ray) {
      std::vector<std::size_t> zeros;
      for (std::size_t row = 0; row < 3; ++row)
        if (row != ray) zeros.push_back(row);
      if (ray < 2 && signs[ray] == 0) zeros.push_back(4);
      graph_.add(bits_of(zeros), ray == 2 ? 3 : signs[ray] < 0 ? 4 : RayGraph::none);
    }
    graph_.connect_all();
  }
  /// The rays (1, 0, 1) and (0, 1, 1), with the signs of the last row there.
  std::vector<RayId> cut_by_row_3(int sign_at_x, int sign_at_y) {
    const auto zeros = [](std::size_t row, int sign) {
      return sign == 0 ? std::vector<std::size_t>{row, 3, 4} : std::vector<std::size_t>{row, 3};
    };
    const auto first_negative = [](int sign) { return sign < 0 ? 4 : RayGraph::none; };
    std::vector<RayId> ids;
    graph_.commit(3,
                  new_rays(graph_.edges_cut_by(3), {zeros(1, sign_at_x), zeros(0, sign_at_y)},
                           {first_negative(sign_at_x), first_negative(sign_at_y)}, rows_.size()),
                  ids);
    graph_.connect(3, 1);
    return ids;
  }

  Rows rows_;
  RayGraph graph_;
};

TEST_F(OctantGraph, EdgesAreKeptForTheRowThatCutsThemFirst) {
  start({-2, 1, 1}, {-1, 1, 1});
  EXPECT_EQ(graph_.num_simple_rays(), 3u);
  EXPECT_FALSE(graph_.cuts(2));
  EXPECT_TRUE(graph_.cuts(3));
  EXPECT_THAT(graph_.edges_cut_by(3), ElementsAre(CutEdge{0, 2}, CutEdge{1, 2}));
  EXPECT_THAT(graph_.edges_cut_by(4), ElementsAre(CutEdge{1, 0}));
  EXPECT_THAT(cut_by_row_3(-1, 1), ElementsAre(3, 4));
  EXPECT_THAT(graph_.rays(), UnorderedElementsAre(0, 1, 3, 4));
  EXPECT_EQ(graph_.num_simple_rays(), 4u);
  // The edge between the new rays, which only the search in the section finds.
  EXPECT_THAT(graph_.edges_cut_by(4), ElementsAre(CutEdge{1, 0}, CutEdge{4, 3}));
}

TEST_F(OctantGraph, NumbersOfRemovedRaysAreUsedAgain) {
  start({-2, 1, 1}, {-1, 1, 1});
  cut_by_row_3(-1, 1);
  std::vector<RayId> ids;
  graph_.commit(
      4, new_rays(graph_.edges_cut_by(4), {{2, 4}, {3, 4}}, {RayGraph::none, RayGraph::none}, rows_.size()),
      ids);
  EXPECT_THAT(ids, ElementsAre(2, 5)) << "the number of the ray that row 3 removed, and a new one";
  EXPECT_THAT(graph_.rays(), UnorderedElementsAre(1, 4, 2, 5));
  EXPECT_EQ(graph_.capacity(), 6u);
  EXPECT_EQ(std::vector<std::uint64_t>(graph_.zeros(2).begin(), graph_.zeros(2).end()), bits_of({2, 4}));
}

TEST_F(OctantGraph, AnEdgeThatEndsOnTheRowIsNotCut) {
  start({-1, 0, 1}, {-1, 0, 1});
  EXPECT_THAT(graph_.edges_cut_by(4), IsEmpty());
  cut_by_row_3(0, 1);
  EXPECT_TRUE(graph_.cuts(4)) << "a ray is beyond it";
  EXPECT_THAT(graph_.edges_cut_by(4), IsEmpty()) << "but no edge crosses it";
}

TEST_F(OctantGraph, WhatARowRemovesAsAWholeIsNotCut) {
  start({-1, -1, 1}, {-1, -1, 1});
  EXPECT_THAT(graph_.edges_cut_by(4), IsEmpty());
  cut_by_row_3(0, 0);
  EXPECT_THAT(graph_.edges_cut_by(4), IsEmpty());
}

TEST_F(OctantGraph, AnEdgeIsListedOnce) {
  start({-2, 1, 1}, {-1, 1, 1});
  graph_.connect_all();
  EXPECT_THAT(graph_.edges_cut_by(4), ElementsAre(CutEdge{1, 0}));
}

}  // namespace
}  // namespace delone::polyhedra
