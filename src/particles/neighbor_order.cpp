// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbor_order.hpp"

#include <algorithm>
#include <numeric>

namespace delone::particles {

std::span<const std::uint32_t> NeighborOrder::find(Index site, std::span<const Index> neighbors,
                                                   std::span<const Index> rows,
                                                   const PeriodicSites* periodic) {
  const std::size_t n = neighbors.size();
  order_.resize(n);
  rows_.resize(n);
  for (std::size_t i = 0; i < n; ++i) rows_[i] = rows[neighbors[i]];
  if (periodic != nullptr) periodic->find_offsets(site, neighbors, offsets_);
  constexpr std::size_t few = 64;
  if (n <= few) {  // each tells its place, without branches
    for (std::size_t i = 0; i < n; ++i) {
      const Index row = rows_[i];
      std::uint32_t place = 0;
      for (std::size_t j = 0; j < i; ++j) place += rows_[j] <= row ? 1 : 0;
      for (std::size_t j = i + 1; j < n; ++j) place += rows_[j] < row ? 1 : 0;
      order_[place] = static_cast<std::uint32_t>(i);
    }
  } else {
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return rows_[a] < rows_[b]; });
  }
  if (periodic != nullptr) order_images(periodic->rank());
  return order_;
}

/// Neighbors of one row, which are next to each other, by their translations.
void NeighborOrder::order_images(std::size_t rank) {
  const auto is_less = [&](std::uint32_t a, std::uint32_t b) {
    const std::int32_t* const of_a = offsets_.data() + a * rank;
    const std::int32_t* const of_b = offsets_.data() + b * rank;
    return std::lexicographical_compare(of_a, of_a + rank, of_b, of_b + rank);
  };
  for (auto first = order_.begin(); first != order_.end();) {
    const Index row = rows_[*first];
    const auto last = std::find_if(first + 1, order_.end(), [&](std::uint32_t i) { return rows_[i] != row; });
    if (last - first > 1) std::sort(first, last, is_less);
    first = last;
  }
}

}  // namespace delone::particles
