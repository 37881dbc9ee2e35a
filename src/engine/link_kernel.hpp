// SPDX-License-Identifier: BSD-3-Clause
// The cells of a new star and their links, with all ids of a cell in one SIMD vector; compiled for several
// instruction sets, of which the best that the machine has is chosen at run time.
#pragma once

#include "cells/cell_memory.hpp"
#include "cells/horizon_facet.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::engine {

using cells::HorizonFacet;

/// Where the vertices and neighbors of all cells are, laid out as CellLayout says. Behind the last cell there
/// is room for a vector of ids more.
struct CellLinks {
  Index* first;
  int k;
  cells::VertexIds ids;
};

/// The conflict zone that a star replaces.
struct DeadCells {
  const Index* cells;
  const double* values;
};

/// Writes the vertices of created cells, and links them with the survivors of their facets. The ids in
/// facet.created are given; the other members of the facets are filled in. A cell may be created in the place
/// of the dead cell of its facet, or of that of an earlier facet.
///
/// Where zones of several threads share survivors, these write the links of one cell at a time, so that no
/// link of a survivor is read.
void create_cells(const CellLinks& links, Index apex, const DeadCells& zone, std::span<HorizonFacet> facets,
                  bool shares_survivors);

/// Whether the zones of several threads may share survivors in this dimension. In lower ones, stars are small
/// and rarely meet; in higher ones, one thread inserts.
constexpr bool shares_survivors(int k) { return k == 5 || k == 6; }

/// The number of a half-ridge is facet · 2^half_ridge_shift + its slot in the created cell. Numbers with the
/// slot of the apex, or with one beyond the last vertex, are not used.
constexpr int half_ridge_shift(int k) {
  return std::max(3, static_cast<int>(std::bit_width(static_cast<unsigned>(k))));
}

/// The table in which half-ridges are matched has 2^bits entries and one more. Each is the sum of the numbers
/// of the half-ridges that have selected it, plus 2^sum_bits for each of them.
struct RidgeEntries {
  std::uint32_t* entries;
  int bits;
  int sum_bits;
};

/// Hashes the ridges of facets first … last − 1, whose created cells have their vertices, and adds their
/// half-ridges to the table, if there is one. hashes: of all half-ridges of the star; created: the created
/// cells of all facets.
void hash_ridges(const CellLinks& links, std::span<const HorizonFacet> facets, std::size_t first,
                 std::size_t last, std::uint32_t* hashes, Index* created, const RidgeEntries* table);

/// Links the created cells across all ridges whose two half-ridges have an entry to themselves. In
/// `unmatched`, sets the bits of the other half-ridges and clears those of all other numbers.
void match_ridges(const CellLinks& links, std::span<const HorizonFacet> facets, const std::uint32_t* hashes,
                  const Index* created, const RidgeEntries& table, std::uint8_t* unmatched);

}  // namespace delone::engine
