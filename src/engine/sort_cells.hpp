// SPDX-License-Identifier: BSD-3-Clause
// Cells in an order that depends on their vertices alone, and their vertices too: lexicographic, with the ids
// of each cell increasing but for the last two where the orientation wants it so. The infinite vertex has the
// least id, so infinite cells come first. Cells are sorted by their first vertex, by counting, and then those
// of each vertex by the others.
#pragma once

#include "base/parallel.hpp"
#include "cells/cell_memory.hpp"
#include "engine/cell_store.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

/// Sorts the vertices of a cell, and its neighbors with them.
template <int K>
void sort_vertices(CellStore<K>& cells, Index cell) {
  const int k = cells.dimension();
  Index* const neighbors = cells.neighbors(cell);
  bool is_odd = false;
  const auto exchange = [&](int i, int j) {
    const Index vertex = cells.vertex(cell, i);
    cells.set_vertex(cell, i, cells.vertex(cell, j));
    cells.set_vertex(cell, j, vertex);
    std::swap(neighbors[i], neighbors[j]);
    is_odd = !is_odd;
  };
  for (int i = 1; i <= k; ++i)
    for (int j = i; j > 0 && cells.vertex(cell, j) < cells.vertex(cell, j - 1); --j) exchange(j, j - 1);
  if (is_odd) exchange(k - 1, k);
}

/// Sorts all cells, of vertices before num_vertices; there are no vacant slots then. Throws std::bad_alloc,
/// and then only the order of vertices has changed. Cost O(k·log(cells per vertex)) per cell, and for a
/// moment the memory of all cells twice.
template <int K>
void sort_cells(CellMemory<K>& memory, CellStore<K>& cells, Index num_vertices, unsigned threads) {
  constexpr std::size_t part = 8192;
  const Index num_slots = cells.num_slots();
  internal::parallel_for(threads, num_slots, part, [&](std::size_t first, std::size_t last) {
    for (auto cell = static_cast<Index>(first); cell < last; ++cell)
      if (!cells.is_vacant(cell)) sort_vertices(cells, cell);
  });
  std::vector<Index> begin(std::size_t{num_vertices} + 2, 0);
  for (Index cell = 0; cell < num_slots; ++cell)
    if (!cells.is_vacant(cell)) ++begin[cells.vertex(cell, 0) + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> order(cells.num_cells()), number(num_slots);
  for (Index cell = 0; cell < num_slots; ++cell)
    if (!cells.is_vacant(cell)) order[begin[cells.vertex(cell, 0) + 1]++] = cell;
  // Now those of vertex v begin at begin[v].
  internal::parallel_for(threads, num_vertices, part, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin[v]),
                order.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]), [&](Index a, Index b) {
                  for (int i = 1; i <= cells.dimension(); ++i)
                    if (const Index of_a = cells.vertex(a, i), of_b = cells.vertex(b, i); of_a != of_b)
                      return of_a < of_b;
                  return false;
                });
  });
  internal::parallel_for(threads, order.size(), part, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) number[order[n]] = static_cast<Index>(n);
  });
  memory.reorder(order, threads);
  cells.close_gaps();
  internal::parallel_for(threads, order.size(), part, [&](std::size_t first, std::size_t last) {
    for (auto cell = static_cast<Index>(first); cell < last; ++cell) {
      Index* const neighbors = cells.neighbors(cell);
      for (int i = 0; i <= cells.dimension(); ++i) neighbors[i] = number[neighbors[i]];
    }
  });
}

}  // namespace delone::engine
