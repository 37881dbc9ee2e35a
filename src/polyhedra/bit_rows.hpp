// SPDX-License-Identifier: BSD-3-Clause
// Sets of small numbers as rows of bits, back to back.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::polyhedra {

using Bits = std::span<std::uint64_t>;
using ConstBits = std::span<const std::uint64_t>;

constexpr std::size_t words_for(std::size_t bits) { return (bits + 63) / 64; }
constexpr std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << (i & 63); }

inline bool test(ConstBits set, std::size_t i) { return (set[i >> 6] & bit(i)) != 0; }
inline void insert(Bits set, std::size_t i) { set[i >> 6] |= bit(i); }

inline std::size_t count(ConstBits set) {
  std::size_t sum = 0;
  for (const std::uint64_t word : set) sum += static_cast<std::size_t>(std::popcount(word));
  return sum;
}
/// Whether all of `part` is in `set`.
inline bool contains(ConstBits set, ConstBits part) {
  for (std::size_t w = 0; w < set.size(); ++w)
    if ((part[w] & ~set[w]) != 0) return false;
  return true;
}
/// Calls visit(i) for the numbers of a set, increasing.
template <class Visit>
void for_each(ConstBits set, Visit visit) {
  for (std::size_t w = 0; w < set.size(); ++w)
    for (std::uint64_t word = set[w]; word != 0; word &= word - 1)
      visit(64 * w + static_cast<std::size_t>(std::countr_zero(word)));
}

/// Sets of numbers below `width`.
class BitRows {
 public:
  BitRows() = default;
  BitRows(std::size_t size, std::size_t width)
      : words_(words_for(width)), bits_(size * words_, 0), size_(size) {}

  std::size_t size() const { return size_; }
  std::size_t words() const { return words_; }
  Bits operator[](std::size_t row) { return {bits_.data() + row * words_, words_}; }
  ConstBits operator[](std::size_t row) const { return {bits_.data() + row * words_, words_}; }
  void resize(std::size_t size) {
    bits_.resize(size * words_, 0);
    size_ = size;
  }
  /// Each number's set of the rows that have it. `width`: as that of the rows.
  BitRows transposed(std::size_t width) const {
    BitRows columns(width, size_);
    for (std::size_t row = 0; row < size_; ++row)
      for_each((*this)[row], [&](std::size_t i) { insert(columns[i], row); });
    return columns;
  }
  friend bool operator==(const BitRows&, const BitRows&) = default;

 private:
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
  std::size_t size_ = 0;
};

}  // namespace delone::polyhedra
