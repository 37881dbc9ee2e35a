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
  constexpr std::size_t few = 64;
  if (periodic == nullptr && n <= few) {  // rows differ, so each tells its place; without branches
    for (std::size_t i = 0; i < n; ++i) {
      std::uint32_t place = 0;
      for (std::size_t j = 0; j < n; ++j) place += rows_[j] < rows_[i] ? 1 : 0;
      order_[place] = static_cast<std::uint32_t>(i);
    }
    return order_;
  }
  std::iota(order_.begin(), order_.end(), 0u);
  const std::size_t rank = periodic == nullptr ? 0 : periodic->rank();
  if (periodic != nullptr) periodic->find_offsets(site, neighbors, offsets_);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (rows_[a] != rows_[b]) return rows_[a] < rows_[b];
    const std::int32_t* const of_a = offsets_.data() + a * rank;
    const std::int32_t* const of_b = offsets_.data() + b * rank;
    return std::lexicographical_compare(of_a, of_a + rank, of_b, of_b + rank);
  });
  return order_;
}

}  // namespace delone::particles
