// SPDX-License-Identifier: BSD-3-Clause
// The memory of all cells. What the engine keeps of a cell and what the geometry caches of it are always needed together, so
// they are side by side:
//   record   k + 2 words of 64 bits, for geometry/; two bits of the last one are the engine's mark
//   links    k + 1 vertices and k + 1 neighbors, for engine/
#pragma once

#include "growable_array.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace delone {

/// What an insertion has found out about a cell.
enum class Mark : std::uint8_t { unseen = 0, in_conflict = 1, not_in_conflict = 2 };

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class CellMemory {
 public:
  explicit CellMemory(int dimension) : dimension_(dimension), words_(pages_for(dimension)) {}

  int dimension() const { return K > 0 ? K : dimension_; }
  /// From a cell to the next, in words.
  std::size_t stride() const { return stride_of(static_cast<std::size_t>(dimension())); }

  double* record(Index cell) { return words_.data() + cell * stride(); }
  const double* record(Index cell) const { return words_.data() + cell * stride(); }
  Index* links(Index cell) { return reinterpret_cast<Index*>(record(cell) + dimension() + 2); }
  const Index* links(Index cell) const { return reinterpret_cast<const Index*>(record(cell) + dimension() + 2); }

  std::size_t capacity() const { return (std::max(words_.capacity(), spare) - spare) / stride(); }
  std::size_t bytes() const { return words_.capacity() * sizeof(double); }
  /// Makes room for cells, keeping the present ones. Throws std::bad_alloc, and then changes nothing.
  void reserve(std::size_t cells) { words_.reserve(cells * stride() + spare); }
  /// Cells to come are met in no order: what they are mapped to is to be in large pages.
  void use_large_pages() { words_.use_large_pages(); }
  /// Says that cells before `cells`, of which there is room for, will now be written.
  void prepare(std::size_t cells) { words_.prepare(cells * stride()); }
  /// Copies the first `cells` cells of a memory of the same dimension.
  void copy(const CellMemory& other, std::size_t cells) {
    reserve(cells);
    std::copy_n(other.words_.data(), cells * stride(), words_.data());
  }

 private:
  /// Insertion in a sorted order stays near where it was, so that large pages gain nothing while stars are small
  /// (docs/performance.md, "Memory").
  static Pages pages_for(int dimension) { return dimension >= 5 ? Pages::large : Pages::usual; }

  /// Lines of the cache have 8 words: one word more is no waste if it keeps cells from straddling more lines than they need.
  static constexpr std::size_t stride_of(std::size_t k) {
    const std::size_t words = k + 2 + (2 * (k + 1) * sizeof(Index) + sizeof(double) - 1) / sizeof(double);
    return words % 8 == 7 ? words + 1 : words;
  }

  /// Words behind the last cell, so that vectors may reach beyond its ids.
  static constexpr std::size_t spare = 4;

  int dimension_;
  GrowableArray<double> words_;
};

/// The marks, in bits that certificates leave free.
namespace mark_bits {
constexpr int in_conflict = 47, not_in_conflict = 63;
constexpr std::uint64_t all = std::uint64_t{1} << in_conflict | std::uint64_t{1} << not_in_conflict;

inline Mark read(std::uint64_t word) {
  return static_cast<Mark>((word >> in_conflict & 1) | (word >> (not_in_conflict - 1) & 2));
}
inline std::uint64_t write(Mark mark) {
  const auto bits = static_cast<std::uint64_t>(mark);
  return (bits & 1) << in_conflict | (bits & 2) << (not_in_conflict - 1);
}
}  // namespace mark_bits

}  // namespace delone
