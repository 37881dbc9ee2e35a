// SPDX-License-Identifier: BSD-3-Clause
// The order of the neighbors of a site: by row, and in a periodic set those of one row by their translations.
// It depends on the sites alone.
#pragma once

#include "particles/periodic_sites.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::particles {

class NeighborOrder {
 public:
  /// The places of neighbors, in this order. `rows`: by vertex. `periodic`: null, or the set.
  std::span<const std::uint32_t> find(Index site, std::span<const Index> neighbors,
                                      std::span<const Index> rows, const PeriodicSites* periodic);
  /// The translation of the i-th neighbor in this order, `rank` numbers.
  std::span<const std::int32_t> offsets(std::size_t i, std::size_t rank) const {
    return rank == 0 ? std::span<const std::int32_t>() : std::span(offsets_).subspan(order_[i] * rank, rank);
  }

 private:
  void order_rows(bool are_equal);
  void order_images(std::size_t rank);

  std::vector<Index> rows_;
  std::vector<std::uint32_t> order_;
  std::vector<std::int32_t> offsets_;
  bool are_zeros_ = true;  // all offsets
};

}  // namespace delone::particles
