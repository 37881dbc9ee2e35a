// SPDX-License-Identifier: BSD-3-Clause
// Looking up keys in lines of a table (facet_table.hpp), with all keys of a line in one SIMD vector; compiled
// for several instruction sets, of which the best that the machine has is chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::engine {

/// A cache line of the table.
struct FacetLine {
  static constexpr int room = 5;
  std::uint64_t keys[room];  ///< 0: vacant
  std::uint32_t values[room];
  std::uint16_t num_beside;     ///< keys of this line that are in the line beside it
  std::uint16_t num_elsewhere;  ///< and those that are in the map

  static std::size_t place(std::uint64_t key, std::size_t num_lines) {
    return static_cast<std::size_t>(key >> 20) & (num_lines - 1);
  }
};

/// Bits of the places of a line.
struct FacetPlaces {
  std::uint32_t hits, vacancies;
};

/// For each key, the places of its line that have it, and those that are vacant. REQUIRES that the number of
/// lines is a power of two.
void find_facets(const FacetLine* lines, std::size_t num_lines, std::span<const std::uint64_t> keys,
                 FacetPlaces* places);

}  // namespace delone::engine
