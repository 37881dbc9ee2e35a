// SPDX-License-Identifier: BSD-3-Clause
// Kinds of rows of cones by their rays alone: facets, copies, redundant ones, and cones of one ray.
#include "polyhedra/classify_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;
using enum ConeRow;

/// For each row the rays that lie on it.
ConeRows classify(std::size_t num_rays, const std::vector<std::vector<std::size_t>>& rays_of_rows) {
  BitRows columns(rays_of_rows.size(), num_rays);
  for (std::size_t row = 0; row < rays_of_rows.size(); ++row)
    for (const std::size_t ray : rays_of_rows[row]) insert(columns[row], ray);
  return classify_rows(columns.transposed(num_rays), columns);
}

TEST(ClassifyRows, ASquareWithRowsThatAreNotNeeded) {
  // Rays 0 … 3 in their order around; rows through an edge, a corner, all, none, and an edge again.
  const ConeRows rows =
      classify(4, {{0}, {0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}, {}, {2, 1}, {1, 2}, {2}});
  EXPECT_THAT(rows.kinds, ElementsAre(redundant, facet, facet, facet, facet, whole, redundant, duplicate,
                                      duplicate, redundant));
  EXPECT_THAT(rows.first, ElementsAre(0, 1, 2, 3, 4, 5, 6, 2, 2, 9));
}

TEST(ClassifyRows, CopiesOfARedundantRowAreRedundant) {
  const ConeRows rows = classify(3, {{0}, {0}, {0, 1}, {1, 2}, {2, 0}, {0}});
  EXPECT_THAT(rows.kinds, ElementsAre(redundant, redundant, facet, facet, facet, redundant));
  EXPECT_THAT(rows.first, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(ClassifyRows, OfOneRayTheFirstRowWithoutItIsTheFacet) {
  const ConeRows rows = classify(1, {{0}, {}, {0}, {}, {}});
  EXPECT_THAT(rows.kinds, ElementsAre(whole, facet, whole, duplicate, duplicate));
  EXPECT_THAT(rows.first, ElementsAre(0, 1, 2, 1, 1));
}

TEST(ClassifyRows, OfNoRayEveryRowIsWhole) {
  EXPECT_THAT(classify(0, {{}, {}}).kinds, ElementsAre(whole, whole));
  EXPECT_TRUE(classify(3, {}).kinds.empty());
}

}  // namespace
}  // namespace delone::polyhedra
