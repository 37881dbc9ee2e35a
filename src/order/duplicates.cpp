// SPDX-License-Identifier: BSD-3-Clause
// Exact duplicates by hashing: an open-addressing table of rows, at most half full, that compares coordinates on a hit.
// Memory beyond the result: two to four indices per point, plus one hash per point of a short block.
#include "order/insertion_order.hpp"
#include "random.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace delone::order {
namespace {

std::uint64_t hash_row(const double* x, std::size_t d) {
  std::uint64_t h = 0x9e3779b97f4a7c15u * d;
  for (std::size_t i = 0; i < d; ++i) h = random::mix(h ^ std::bit_cast<std::uint64_t>(x[i] + 0.0)) + i;  // −0 + 0 is +0
  return h;
}

}  // namespace

std::vector<Index> first_equal_rows(PointsView points) {
  const std::size_t n = points.size(), d = static_cast<std::size_t>(points.dimension());
  std::vector<Index> first(n);
  if (n == 0) return first;

  std::vector<Index> table(std::bit_ceil(2 * n), invalid_index);
  const std::size_t mask = table.size() - 1;
  // Blocks: the hashes of a block are independent of its look-ups, so the misses of the look-ups overlap.
  constexpr std::size_t block = 64;
  std::array<std::size_t, block> slots;
  for (std::size_t begin = 0; begin < n; begin += block) {
    const std::size_t count = std::min(block, n - begin);
    for (std::size_t i = 0; i < count; ++i) slots[i] = hash_row(points.data() + (begin + i) * d, d) & mask;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t row = begin + i;
      const double* x = points.data() + row * d;
      std::size_t slot = slots[i];
      while (table[slot] != invalid_index && !std::equal(x, x + d, points.data() + static_cast<std::size_t>(table[slot]) * d))
        slot = (slot + 1) & mask;
      if (table[slot] == invalid_index) table[slot] = static_cast<Index>(row);
      first[row] = table[slot];
    }
  }
  return first;
}

}  // namespace delone::order
