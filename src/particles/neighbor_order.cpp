// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbor_order.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace delone::particles {

std::span<const std::uint32_t> NeighborOrder::find(Index site, std::span<const Index> neighbors,
                                                   std::span<const Index> rows,
                                                   const PeriodicSites* periodic) {
  const std::size_t n = neighbors.size();
  order_.resize(n);
  rows_.resize(n);
  if (periodic == nullptr) {
    for (std::size_t i = 0; i < n; ++i) rows_[i] = rows[neighbors[i]];
    order_rows(false);
    return order_;
  }
  std::uint32_t shifts = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const periodic::Image& image = periodic->image_of(neighbors[i]);
    rows_[i] = image.row;
    shifts |= image.shift;
  }
  // Without images rows differ, and where all points were given in the box, neighbors are not translated.
  const bool has_images = shifts != 0;
  order_rows(has_images);
  if (has_images || periodic->has_wraps()) {
    periodic->find_offsets(site, neighbors, offsets_);
    are_zeros_ = false;
  } else if (!are_zeros_ || offsets_.size() < n * periodic->rank()) {
    offsets_.assign(n * periodic->rank(), 0);
    are_zeros_ = true;
  }
  if (has_images) order_images(periodic->rank());
  return order_;
}

/// `are_equal`: whether some rows may be. These have places next to each other.
void NeighborOrder::order_rows(bool are_equal) {
  const std::size_t n = rows_.size();
  constexpr std::size_t few = 64, lanes = 16;
  if (n > few) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return rows_[a] < rows_[b]; });
    return;
  }
  // Each tells its place, the number of smaller ones, without branches. Blocks have a fixed size, so that
  // compilers make vectors of them.
  SignedIndex rows[few], smaller[lanes];
  const std::size_t padded = (n + lanes - 1) / lanes * lanes;
  for (std::size_t i = 0; i < padded; ++i)
    rows[i] = i < n ? static_cast<SignedIndex>(rows_[i]) : std::numeric_limits<SignedIndex>::max();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t lane = 0; lane < lanes; ++lane) smaller[lane] = 0;
    for (std::size_t first = 0; first < padded; first += lanes)
      for (std::size_t lane = 0; lane < lanes; ++lane) smaller[lane] += rows[first + lane] < rows[i] ? 1 : 0;
    SignedIndex place = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) place += smaller[lane];
    if (are_equal)
      for (std::size_t j = 0; j < i; ++j) place += rows[j] == rows[i] ? 1 : 0;
    order_[static_cast<std::size_t>(place)] = static_cast<std::uint32_t>(i);
  }
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
