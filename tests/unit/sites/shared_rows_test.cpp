// SPDX-License-Identifier: BSD-3-Clause
// Rows of vertices that have several: in order, and without lists of vertices that have one.
#include "sites/shared_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace delone::sites {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SharedRows, AreAllRowsButTheFirst) {
  const std::vector<VertexId> vertices{VertexId{2}, VertexId{1}, VertexId{2}, invalid_vertex, VertexId{2}};
  const std::vector<Index> first{invalid_index, 1, 0};
  SharedRows rows(vertices, first);
  EXPECT_TRUE(rows.has_several(2));
  EXPECT_FALSE(rows.has_several(1));
  EXPECT_FALSE(rows.has_several(7));
  EXPECT_THAT(rows.others(2), ElementsAre(2, 4));
  EXPECT_THAT(rows.others(1), IsEmpty());
  rows.add(2, 3);
  rows.add(2, 1);
  rows.add(1, 9);
  EXPECT_THAT(rows.others(2), ElementsAre(1, 2, 3, 4)) << "increasing, however they come";
  EXPECT_THAT(rows.others(1), ElementsAre(9));
  rows.remove(2, 3);
  EXPECT_THAT(rows.others(2), ElementsAre(1, 2, 4));
  rows.remove(1, 9);
  EXPECT_FALSE(rows.has_several(1)) << "an empty list is none";
  for (const Index row : {4u, 1u, 2u}) rows.remove(2, row);
  EXPECT_FALSE(rows.has_several(2));
}

TEST(SharedRows, OfDistinctPointsThereAreNone) {
  const std::vector<VertexId> vertices{VertexId{1}, VertexId{2}};
  const std::vector<Index> first{invalid_index, 0, 1};
  const SharedRows rows(vertices, first);
  EXPECT_FALSE(rows.has_several(1) || rows.has_several(2));
}

}  // namespace
}  // namespace delone::sites
