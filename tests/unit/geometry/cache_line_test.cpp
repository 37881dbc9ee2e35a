// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/cache_line.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace delone::geometry {
namespace {

TEST(CacheLine, IsTheFirstFromHereOnWithinWhatIsToSpare) {
  std::vector<double> memory(4 * cache_line_of<double>);
  for (std::size_t i = 0; i < 2 * cache_line_of<double>; ++i) {
    double* const from = memory.data() + i;
    double* const line = at_cache_line(from);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(line) % cache_line, 0u);
    EXPECT_TRUE(line >= from && line < from + cache_line_of<double>);
  }
}

}  // namespace
}  // namespace delone::geometry
