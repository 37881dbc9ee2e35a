// SPDX-License-Identifier: BSD-3-Clause
// Moves all cells to other slots, in place.
//
// A slot is filled from another one, that from a third, and so on: slots form cycles, and paths that begin
// with vacant slots. Every so many slots, the cell is set aside: the slot becomes a start, from which a chain
// is followed to the next start. Chains are independent: each thread follows several of them in turn, so that
// the processor fetches the cells of many at once.
#pragma once

#include "base/compiler.hpp"
#include "base/growable_array.hpp"
#include "base/parallel.hpp"
#include "cells/cell_memory.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::cells {

/// REQUIRES links that are not apart.
template <int K>
class CellMover {
 public:
  /// Slot n is to be filled with the cell in slot sources[n], which is not vacant. By run(): the upper halves
  /// of sources are used by it. Throws std::bad_alloc.
  CellMover(CellMemory<K>& memory, std::span<std::uint64_t> sources, std::span<const Index> vacant,
            unsigned threads)
      : memory_(memory), sources_(sources), threads_(threads) {
    starts_.reserve(vacant.size() + sources.size() / spacing + 1);
    for (const Index slot : vacant)
      if (slot < sources.size()) starts_.push_back(slot);
    for (std::size_t slot = 0; slot < sources.size(); slot += spacing)
      starts_.push_back(static_cast<Index>(slot));
    std::sort(starts_.begin(), starts_.end());
    starts_.erase(std::unique(starts_.begin(), starts_.end()), starts_.end());
    words_.reserve(starts_.size() * width());
  }

  void run() noexcept {
    for (std::size_t s = 0; s < starts_.size(); ++s) {
      sources_[starts_[s]] |= std::uint64_t{s + 1} << 32;
      set_aside(starts_[s], s);
    }
    internal::parallel_for(threads_, starts_.size(), 256,
                           [&](std::size_t first, std::size_t last) { follow_chains(first, last); });
    for (std::size_t slot = 0; slot < sources_.size(); ++slot)
      if (sources_[slot] <= slot_mask && sources_[slot] != slot) turn_cycle(static_cast<Index>(slot));
  }

  static constexpr std::uint64_t slot_mask = 0xffffffff;

 private:
  static constexpr std::size_t spacing = 256, at_once = 16;
  static constexpr std::uint64_t done = std::uint64_t{0xffffffff} << 32;

  std::size_t width() const { return memory_.layout().functional_stride() + 1; }
  Index source_of(std::size_t slot) const { return static_cast<Index>(sources_[slot]); }

  void set_aside(Index slot, std::size_t place) {
    const CellRecords<K> records = memory_.records();
    double* const to = words_.data() + place * width();
    std::copy_n(records.functional(slot), width() - 1, to);
    to[width() - 1] = *records.certificate(slot);
  }
  void put_back(std::size_t place, Index slot) {
    const CellRecords<K> records = memory_.records();
    const double* const from = words_.data() + place * width();
    std::copy_n(from, width() - 1, records.functional(slot));
    *records.certificate(slot) = from[width() - 1];
  }
  void move(Index from, Index to) {
    const CellRecords<K> records = memory_.records();
    std::copy_n(records.functional(from), width() - 1, records.functional(to));
    if (memory_.layout().certificates_are_apart()) *records.certificate(to) = *records.certificate(from);
  }
  [[gnu::always_inline]] void prefetch(Index slot) const {
    const CellRecords<K> records = memory_.records();
    const char* const first = reinterpret_cast<const char*>(records.functional(slot));
    for (std::size_t byte = 0; byte < (width() - 1) * sizeof(double); byte += 64)
      internal::prefetch_for_writing(first + byte);
    internal::prefetch_for_writing(first + (width() - 1) * sizeof(double) - 1);
    if (memory_.layout().certificates_are_apart()) internal::prefetch_for_writing(records.certificate(slot));
    if (slot < sources_.size()) internal::prefetch_for_writing(sources_.data() + slot);
  }

  void follow_chains(std::size_t first, std::size_t last) {
    std::array<Index, at_once> slots;  // the next of each chain to be filled
    std::size_t count = 0;
    for (; count < at_once && first < last; ++count) prefetch(source_of(slots[count] = starts_[first++]));
    while (count > 0)
      for (std::size_t c = 0; c < count; ++c) {
        const Index source = fill(slots[c]);
        if (source != invalid_index)
          slots[c] = source;
        else if (first < last)
          slots[c] = starts_[first++];
        else
          slots[c] = slots[--count];
        prefetch(source_of(slots[c]));
      }
  }
  /// Returns the next slot to be filled, or invalid_index where the chain ends.
  Index fill(Index slot) {
    const Index source = source_of(slot);
    if (sources_[slot] <= slot_mask) sources_[slot] |= done;
    if (source >= sources_.size()) {
      move(source, slot);
      return invalid_index;
    }
    if (const std::uint64_t start = sources_[source] >> 32; start != 0) {
      put_back(start - 1, slot);
      return invalid_index;
    }
    move(source, slot);
    return source;
  }
  /// A cycle without start.
  void turn_cycle(Index first) {
    set_aside(first, 0);
    Index slot = first;
    for (Index source = source_of(slot); source != first; source = source_of(slot)) {
      move(source, slot);
      sources_[slot] |= done;
      slot = source;
    }
    put_back(0, slot);
    sources_[slot] |= done;
  }

  CellMemory<K>& memory_;
  std::span<std::uint64_t> sources_;
  unsigned threads_;
  std::vector<Index> starts_;
  GrowableArray<double> words_;  // the cells that were in the starts
};

}  // namespace delone::cells
