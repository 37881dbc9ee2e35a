// SPDX-License-Identifier: BSD-3-Clause
// Costs of points that are spread evenly: few points, wrapped ones, and dimensions beyond those measured.
#include "forecast/model/cost.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace delone::cost_model {
namespace {

TEST(CostOfSpread, FewPointsAreOneSimplexOfTheirFlat) {
  for (const int k : {1, 3, 8, 20})
    for (int v = 0; v <= k + 1; ++v) {
      const Cost cost = cost_of_spread(k, k, v, v, true);
      EXPECT_EQ(cost.affine_dimension, v - 1);
      EXPECT_EQ(cost.cells, v == 0 ? 0 : 1) << k << " " << v;
      EXPECT_GE(cost.created_cells + 1, cost.cells);
    }
  EXPECT_GT(cost_of_spread(2, 2, 1000, 1, true).seconds, cost_of_spread(2, 2, 10, 1, true).seconds)
      << "duplicates take time, too";
}

TEST(CostOfSpread, GrowsWithPointsAndDimensions) {
  for (int k = 1; k <= 12; ++k) {
    double cells = 0, bytes = 0, seconds = 0;
    for (double n = 32; n <= 1 << 20; n *= 4) {
      const Cost cost = cost_of_spread(k, n);
      EXPECT_GT(cost.cells, cells) << k << " " << n;
      EXPECT_GT(cost.bytes, bytes) << k << " " << n;
      EXPECT_GE(cost.created_cells, cost.cells + cost.infinite_cells - 1e-6 * cost.cells) << k << " " << n;
      // To wrap some thousand points takes longer or shorter than to insert more of them.
      if (k < 7 || k > 8) {
        EXPECT_GT(cost.seconds, seconds) << k << " " << n;
      }
      cells = cost.cells;
      bytes = cost.bytes;
      seconds = cost.seconds;
    }
  }
}

TEST(CostOfSpread, WrappedCellsAreCreatedOnce) {
  const Cost wrapped = cost_of_spread(8, 8, 300, 300, true), inserted = cost_of_spread(8, 8, 300, 300, false);
  EXPECT_EQ(wrapped.created_cells, wrapped.cells + wrapped.infinite_cells);
  EXPECT_GT(inserted.created_cells, 2 * wrapped.created_cells);
  EXPECT_EQ(wrapped.cells, inserted.cells);
  EXPECT_LT(wrapped.bytes, inserted.bytes);
}

TEST(CostOfSpread, BeyondTheMeasuredDimensionsCellsAreLarger) {
  EXPECT_GT(bytes_of(16, 16, 0, 0, 1e6, false), 1.9 * bytes_of(8, 8, 0, 0, 1e6, false));
}

}  // namespace
}  // namespace delone::cost_model
