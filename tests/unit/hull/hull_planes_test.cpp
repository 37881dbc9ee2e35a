// SPDX-License-Identifier: BSD-3-Clause
// What the thresholds of planes prove is so in exact arithmetic, for points next to the planes, too; and they
// do prove something.
#include "hull/hull_planes.hpp"

#include "hull/hull_state.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace delone::hull {
namespace {

void check(int dimension, double scale, double offset) {
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<double> corners = make_point_set("sphere", dimension, 20, 1);
  for (double& x : corners) x = offset + scale * x;
  HullState state(dimension);
  state.insert_range(corners, {});
  const SimplicialHull& hull = state.hull();
  std::vector<Index> cells(hull.num_cells());
  std::iota(cells.begin(), cells.end(), Index{0});
  const CenteredBox box{std::vector<double>(d, offset),
                        std::vector<double>(d, scale * 1.125 + std::fabs(offset) * 0x1p-50)};
  const HullPlanes planes = hull_planes(state.sites(), hull, cells, box);
  // Points of the cells, rounded, and some next to them.
  std::vector<const double*> scratch;
  std::size_t inside = 0, beyond = 0, open = 0;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const double factor : {1.0, 1 - 0x1p-52, 1 + 0x1p-51, 0.999, 1.001}) {
      std::vector<double> x(d, 0.0);
      for (const Index site : hull.cell(c))
        for (std::size_t j = 0; j < d; ++j)
          x[j] += (state.sites().point(site)[j] - offset) / static_cast<double>(d);
      for (double& t : x) t = offset + t * factor;
      kernel::Grid grid = state.sites().grid;
      grid.include(x.data());
      for (std::size_t f = 0; f < cells.size(); ++f) {
        double value = 0;
        for (std::size_t j = 0; j < d; ++j)
          value += planes.functions.normals[f * d + j] * (x[j] - box.center[j]);
        const Sign side = compiled::side_of_cell(state.sites(), hull, f, x.data(), grid, scratch);
        if (value < planes.low[f]) {
          ASSERT_EQ(side, Sign::positive);
          ++inside;
        } else if (value > planes.high[f]) {
          ASSERT_EQ(side, Sign::negative);
          ++beyond;
        } else {
          ++open;
        }
      }
    }
  EXPECT_GT(inside, 10 * open);
  EXPECT_GT(beyond, cells.size() / 2);
}

TEST(HullPlanes, ProveWhatIsSo) {
  for (int d = 2; d <= 5; ++d) {
    check(d, 1, 0);
    check(d, 0x1p-200, 0);
    check(d, 1, 1000);
  }
}

// A square whose corners and all other points may be off by 1/64 on one axis and 1/16 on the other.
TEST(HullPlanes, LeaveRoomForRoundedPoints) {
  HullState state(2);
  state.insert_range(std::vector<double>{-1, -1, 1, -1, 1, 1, -1, 1}, {});
  const std::vector<Index> cells{0, 1, 2, 3};
  const HullPlanes exact = hull_planes(state.sites(), state.hull(), cells, {{0, 0}, {1, 1}});
  const HullPlanes rounded =
      hull_planes(state.sites(), state.hull(), cells, {{0, 0}, {1, 1}, {0x1p-6, 0x1p-4}});
  for (std::size_t f = 0; f < 4; ++f) {
    const double* const normal = exact.functions.normals.data() + 2 * f;
    const double room = 2 * (std::fabs(normal[0]) * 0x1p-6 + std::fabs(normal[1]) * 0x1p-4);
    EXPECT_LE(rounded.low[f], exact.low[f] - room);
    EXPECT_GE(rounded.low[f], exact.low[f] - 1.02 * room);
    EXPECT_GE(rounded.high[f], exact.high[f] + room);
  }
}

TEST(HullPlanes, ProveNothingWithoutANormal) {
  HullState state(2);
  state.insert_range(std::vector<double>{0, 0, 1e-310, 0, 0, 1e-310}, {});
  const std::vector<Index> cells{0, 1, 2};
  const HullPlanes planes = hull_planes(state.sites(), state.hull(), cells, {{0, 0}, {1, 1}});
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(planes.low[f], -std::numeric_limits<double>::infinity());
    EXPECT_EQ(planes.high[f], std::numeric_limits<double>::infinity());
  }
}

}  // namespace
}  // namespace delone::hull
