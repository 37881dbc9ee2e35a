// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/split_tree.hpp"

#include "tile_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace delone::tiles {
namespace {

TEST(SplitTree, PartsPositions) {
  for (const test::TileSet& set : test::tile_sets(700)) {
    const auto d = static_cast<std::size_t>(set.dimension()), width = static_cast<std::size_t>(set.row_size);
    const auto stream = stream_of(set.view());
    const auto sample = make_survey(*stream, set.weighted, 300).sample;
    std::set<std::vector<double>> distinct;
    for (std::size_t i = 0; i < sample.size(); i += d) distinct.insert({&sample[i], &sample[i] + d});
    for (const std::size_t num_tiles : {1, 2, 3, 7, 64, 1000}) {
      SCOPED_TRACE(set.name + " in " + std::to_string(num_tiles));
      const SplitTree tree = make_split_tree(sample, set.dimension(), num_tiles);
      const auto found = static_cast<std::size_t>(tree.num_tiles);
      ASSERT_GE(found, 1u);
      EXPECT_LE(found, std::max<std::size_t>(1, std::min(num_tiles, distinct.size())));
      const std::vector<Tile> boxes = tree.boxes();
      ASSERT_EQ(boxes.size(), found);
      std::map<std::vector<double>, std::size_t> tile_of;
      for (std::size_t i = 0; i < set.rows.size(); i += width) {
        const std::vector<double> point(&set.rows[i], &set.rows[i] + d);
        const std::size_t tile = tree.tile_of(point.data());
        ASSERT_LT(tile, found);
        EXPECT_EQ(tile_of.emplace(point, tile).first->second, tile);
        for (std::size_t other = 0; other < found; ++other) {
          bool is_within = true, is_strictly = true;
          for (std::size_t axis = 0; axis < d; ++axis) {
            is_within =
                is_within && boxes[other].low[axis] <= point[axis] && point[axis] <= boxes[other].high[axis];
            is_strictly =
                is_strictly && boxes[other].low[axis] < point[axis] && point[axis] < boxes[other].high[axis];
          }
          if (other == tile) {
            ASSERT_TRUE(is_within);
          }
          if (other != tile) {
            ASSERT_FALSE(is_strictly);
          }
        }
      }
      std::set<std::size_t> used;
      for (const auto& [point, tile] : tile_of) used.insert(tile);
      if (!set.rows.empty()) {
        EXPECT_EQ(used.size(), found);
      }
    }
  }
}

TEST(SplitTree, IsBalanced) {
  for (const test::TileSet& set : test::tile_sets(2000)) {
    if (set.name != "uniform3" && set.name != "lattice" && set.name != "uniform1") continue;
    const auto stream = stream_of(set.view());
    const auto sample = make_survey(*stream, false, 2000).sample;
    for (const std::size_t num_tiles : {2, 5, 8, 11}) {
      const SplitTree tree = make_split_tree(sample, set.dimension(), num_tiles);
      ASSERT_EQ(static_cast<std::size_t>(tree.num_tiles), num_tiles);
      std::vector<std::size_t> counts(num_tiles);
      for (std::size_t i = 0; i < set.rows.size(); i += static_cast<std::size_t>(set.row_size))
        ++counts[tree.tile_of(&set.rows[i])];
      for (const std::size_t count : counts) {
        EXPECT_GE(count + 4, 2000 / num_tiles) << set.name;
        EXPECT_LE(count, 2000 / num_tiles + 4) << set.name;
      }
    }
  }
}

}  // namespace
}  // namespace delone::tiles
