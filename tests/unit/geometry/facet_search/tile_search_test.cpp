// SPDX-License-Identifier: BSD-3-Clause
// What is listed beyond facets, against ratios in binary64.
#include "geometry/facet_search/tile_search.hpp"

#include "base/random.hpp"
#include "geometry/cache_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::geometry {
namespace {

/// A batch of one cell whose vertices are the first k + 1, and one facet.
struct Batch {
  Batch(int dimension, std::size_t n, double least_lift, random::Generator& generator)
      : k(static_cast<std::size_t>(dimension)),
        num_blocks((n + block * most_together - 1) / (block * most_together) * most_together),
        images(num_blocks * block * (k + 1) + cache_line_of<float>),
        heights(most_tile_blocks * block + cache_line_of<float>),
        height_function(k + 1),
        beyond(k + 1) {
    for (std::size_t b = 0; b < num_blocks; ++b)
      for (std::size_t lane = 0; lane < block; ++lane) {
        for (std::size_t r = 0; r < k; ++r)
          entry(b * block + lane, r) = static_cast<float>(2 * generator.uniform() - 1);
        entry(b * block + lane, k) =
            b * block + lane < n ? static_cast<float>(least_lift + generator.uniform()) : out_of_reach;
      }
    for (std::size_t r = 0; r <= k; ++r) {
      height_function[r] = static_cast<float>((generator.uniform() - 0.5) / 64);
      beyond[r] = static_cast<float>(2 * generator.uniform() - 1);
    }
    for (std::size_t i = 0; i <= k; ++i) vertices.push_back(static_cast<Index>(i + 1));
    cell = {vertices.data(), 1};
    facet.cell = facet.slot = 0;
    facet.beyond = beyond.data();
    facet.least = out_of_reach;
    facet.listed_up_to = largest_ratio;
    facet.num_listed = 0;
  }
  float& entry(std::size_t v, std::size_t r) {
    return at_cache_line(images.data())[(v / block * (k + 1) + r) * block + v % block];
  }
  SearchTask task(std::size_t tile_blocks) {
    return {static_cast<int>(k),           num_blocks, at_cache_line(images.data()), tile_blocks,
            at_cache_line(heights.data()), {&cell, 1}, height_function.data(),       {&facet, 1}};
  }
  double ratio(std::size_t v) {
    double height = static_cast<double>(entry(v, k)) + height_function[k], value = beyond[k];
    for (std::size_t r = 0; r < k; ++r) {
      height += static_cast<double>(height_function[r]) * entry(v, r);
      value += static_cast<double>(beyond[r]) * entry(v, r);
    }
    const bool is_of_cell = v <= k;
    return value > 1e-6 && !is_of_cell ? height / value : std::numeric_limits<double>::infinity();
  }

  std::size_t k, num_blocks;
  std::vector<float> images, heights, height_function, beyond;
  std::vector<Index> vertices;
  cells::OpenCell cell;
  SoughtFacet facet;
};

/// As bound_of(), in binary64 and narrower by what binary32 may be off.
double certainly_in(double ratio) { return ratio + (0x1p-6 - 1e-3) * std::fabs(ratio) - 1e-5; }

// Heights of which some are negative are divided; positive ones are compared by keys.
TEST(TileSearch, ListsTheLeastRatio) {
  random::Generator generator(1);
  for (const int k : {2, 3, 7, 8, 9})
    for (const std::size_t n : {11, 100, 1000, 3000})
      for (const double least_lift : {-0.1, 0.25})
        for (const std::size_t tile_blocks : {most_tile_blocks, most_tile_blocks / 2}) {
          SCOPED_TRACE(testing::Message() << k << ' ' << n << ' ' << least_lift);
          Batch batch(k, n, least_lift, generator);
          const SearchTask task = batch.task(tile_blocks);
          search_tiles(task);
          std::size_t least = 0;
          for (std::size_t v = 0; v < n; ++v)
            if (batch.ratio(v) < batch.ratio(least)) least = v;
          const SoughtFacet& facet = batch.facet;
          if (!(batch.ratio(least) < largest_ratio)) {
            EXPECT_EQ(facet.num_listed, 0u);
            continue;
          }
          EXPECT_GE(facet.listed_up_to, batch.ratio(least) - 1e-5);
          if (facet.num_listed > facet.listed.size()) continue;
          const auto end = facet.listed.begin() + static_cast<std::ptrdiff_t>(facet.num_listed);
          EXPECT_NE(std::find(facet.listed.begin(), end, least), end);
          for (std::size_t v = 0; v < n; ++v) {
            if (batch.ratio(v) < certainly_in(batch.ratio(least))) {
              EXPECT_NE(std::find(facet.listed.begin(), end, v), end) << v;
            }
          }
        }
}

TEST(TileSearch, ListsAllUpToABound) {
  random::Generator generator(2);
  for (const int k : {2, 8}) {
    Batch batch(k, 3000, -0.1, generator);
    const SearchTask task = batch.task(most_tile_blocks);
    std::vector<double> ratios;
    for (std::size_t v = 0; v < 3000; ++v) ratios.push_back(batch.ratio(v));
    std::vector<std::uint32_t> list(4000);
    for (const float bound : {-0.5f, 0.0f, 0.5f, 2.0f}) {
      const std::size_t count = list_up_to(task, batch.facet, bound, list);
      std::vector<bool> is_listed(3000);
      for (std::size_t i = 0; i < count; ++i) is_listed[list[i]] = true;
      for (std::size_t v = 0; v < 3000; ++v) {
        if (std::fabs(ratios[v] - bound) > 1e-3 && ratios[v] < 100) {
          ASSERT_EQ(is_listed[v], ratios[v] < bound) << v;
        }
      }
      std::vector<std::uint32_t> room_for_two(2);
      EXPECT_EQ(list_up_to(task, batch.facet, bound, room_for_two), count);
    }
  }
}

}  // namespace
}  // namespace delone::geometry
