// SPDX-License-Identifier: BSD-3-Clause
// The places of keys in lines of the table, against a loop over each line.
#include "engine/wrap/facet_table_kernel.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::engine {
namespace {

/// Lines with some vacant places. Values and counts, which lie between the keys of two lines, must not be
/// taken for keys.
TEST(FacetTableKernel, HitsAndVacancies) {
  test::Random random(8);
  for (const std::size_t num_lines : {1, 2, 64}) {
    std::vector<FacetLine> lines(num_lines);
    for (FacetLine& line : lines) {
      for (int i = 0; i < FacetLine::room; ++i) {
        line.keys[i] = random.integer(0, 2) == 0 ? 0 : random.bits() | 1;
        line.values[i] = static_cast<std::uint32_t>(random.bits());
      }
      line.num_beside = static_cast<std::uint16_t>(random.integer(0, 3));
      line.num_elsewhere = 0;
    }
    for (const std::size_t count : {0, 1, 2, 3, 8, 50}) {
      std::vector<std::uint64_t> keys;
      for (std::size_t i = 0; i < count; ++i) {
        std::uint64_t key = random.bits() | 1;
        // Often a key of its own line, or one that differs from it in a low or a high half only.
        FacetLine& line = lines[FacetLine::place(key, num_lines)];
        const auto place = static_cast<std::size_t>(random.integer(0, FacetLine::room - 1));
        const int kind = random.integer(0, 3);
        if (kind == 1) line.keys[place] = key;
        if (kind == 2) line.keys[place] = key ^ 0x100;
        if (kind == 3) line.keys[place] = key ^ (std::uint64_t{1} << 63);
        keys.push_back(key);
      }
      std::vector<FacetPlaces> places(count, FacetPlaces{~0u, ~0u});
      find_facets(lines.data(), num_lines, keys, places.data());
      for (std::size_t i = 0; i < count; ++i) {
        const FacetLine& line = lines[FacetLine::place(keys[i], num_lines)];
        std::uint32_t hits = 0, vacancies = 0;
        for (int p = 0; p < FacetLine::room; ++p) {
          if (line.keys[p] == keys[i]) hits |= 1u << p;
          if (line.keys[p] == 0) vacancies |= 1u << p;
        }
        EXPECT_EQ(places[i].hits, hits) << num_lines << " " << i;
        EXPECT_EQ(places[i].vacancies, vacancies) << num_lines << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace delone::engine
