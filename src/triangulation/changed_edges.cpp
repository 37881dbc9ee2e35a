// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/changed_edges.hpp"

#include "base/quick_rounds.hpp"
#include "base/spread.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace delone::triangulation {

namespace {

bool has_same_cell(const Complex& a, const Complex& b, CellId cell) {
  if (!a.is_cell(cell) || !b.is_cell(cell)) return false;
  const VerticesOfCell of_a = a.vertices(cell), of_b = b.vertices(cell);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end());
}

void add_edges(const Complex& complex, CellId cell, std::vector<Edge>& edges) {
  const VerticesOfCell vertices = complex.vertices(cell);
  for (auto v = vertices.begin(); v != vertices.end(); ++v)
    for (auto w = std::next(v); w != vertices.end(); ++w)
      if (*v != infinite_vertex && *w != infinite_vertex)
        edges.push_back({std::min(*v, *w), std::max(*v, *w)});
}

/// Many edges go to their first vertices before they are sorted.
void sort_unique_edges(std::vector<Edge>& edges, Index num_ids) {
  if (edges.size() >= num_ids) {
    std::vector<std::size_t> first;
    std::vector<Edge> sorted;
    internal::QuickRounds round;
    internal::spread(num_ids, first, sorted, [&](const auto& put) {
      for (const Edge& edge : edges) {
        round();
        put(index(edge[0]), edge);
      }
    });
    for (std::size_t v = 0; v + 1 < first.size(); ++v) {
      round();
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first[v]),
                sorted.begin() + static_cast<std::ptrdiff_t>(first[v + 1]));
    }
    edges = std::move(sorted);
  } else {
    std::sort(edges.begin(), edges.end());
  }
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace

ChangedEdges find_changed_edges(const Complex& before, const Complex& after) {
  std::vector<Edge> of_before, of_after;
  const Index slots = std::max(before.num_cell_slots(), after.num_cell_slots());
  internal::QuickRounds round;
  for (Index slot = 0; slot < slots; ++slot) {
    round();
    const CellId cell{slot};
    if (has_same_cell(before, after, cell)) continue;
    if (before.is_cell(cell)) add_edges(before, cell, of_before);
    if (after.is_cell(cell)) add_edges(after, cell, of_after);
  }
  const Index ids = std::max(before.num_vertex_slots(), after.num_vertex_slots());
  sort_unique_edges(of_before, ids);
  sort_unique_edges(of_after, ids);
  return {difference(of_before, of_after), difference(of_after, of_before)};
}

}  // namespace delone::triangulation
