// SPDX-License-Identifier: BSD-3-Clause
// The cells at each vertex, and the star of one vertex in local numbers. Ids of cells may depend on threads,
// and so may the order of the cells of a star. That of its neighbors is set by the caller; see CellMeasure
// for the sums.
#pragma once

#include <delone/complex.hpp>
#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::particles {

class Stars {
 public:
  /// Of a complex of dimension k ≥ 1, which must not change. `wanted`: by vertex, whether its star is; empty:
  /// the stars of all finite vertices are. Cost O(cells·k).
  explicit Stars(const Complex& complex, std::vector<unsigned char> wanted = {});

  const Complex& complex() const { return complex_; }
  std::size_t dimension() const { return k_; }
  bool is_wanted(Index v) const { return wanted_.empty() ? v != index(infinite_vertex) : wanted_[v] != 0; }
  /// Whether a cell is in a star that is wanted.
  bool has(CellId cell) const;
  /// The cells at a vertex, in no order. REQUIRES that its star is wanted.
  std::span<const CellId> cells_at(Index v) const {
    return std::span(cells_).subspan(offsets_[v], offsets_[v + 1] - offsets_[v]);
  }
  /// Prefetches a cell that will be needed soon: some places after cell `c` at v, or in the stars that
  /// follow.
  void prefetch_after(Index v, std::size_t c) const {
    constexpr std::size_t distance = 16;
    complex_.prefetch(cells_[std::min(offsets_[v] + c + distance, cells_.size() - 1)]);
  }

 private:
  template <int K>
  void fill();

  Complex complex_;
  std::size_t k_;
  std::vector<unsigned char> wanted_;
  std::vector<CellId> cells_;
  std::vector<std::size_t> offsets_;
};

/// The star of one vertex. Its neighbors, the vertices that edges join to it, have numbers: *slots*.
class Star {
 public:
  explicit Star(const Stars& stars)
      : stars_(stars), k_(stars.dimension()), places_(stars.complex().num_vertex_slots()) {}

  /// Finds the star, with slots in the order in which neighbors are met.
  void find(Index v);
  /// Gives them new slots: neighbor i is the one whose slot was order[i]. The slots of each cell increase.
  void arrange(std::span<const std::uint32_t> order);

  std::span<const Index> neighbors() const { return neighbors_; }
  /// The k slots of each finite cell.
  std::span<const std::uint32_t> corners() const { return corners_; }
  /// The cells, infinite ones first.
  std::size_t num_cells() const { return infinite_.size() + finite_.size(); }
  std::size_t num_infinite() const { return infinite_.size(); }
  CellId cell(std::size_t c) const {
    return c < infinite_.size() ? infinite_[c] : finite_[c - infinite_.size()];
  }
  std::span<const std::uint32_t> slots_of(std::size_t c) const {
    if (c < infinite_.size()) return std::span(infinite_corners_).subspan(c * (k_ - 1), k_ - 1);
    return std::span(corners_).subspan((c - infinite_.size()) * k_, k_);
  }
  /// Whether infinite cells are at the edge to a neighbor.
  bool is_at_infinity(std::size_t slot) const { return !infinite_.empty() && at_infinity_[slot] != 0; }
  bool is_bounded() const { return infinite_.empty(); }
  /// By slot, the number of finite cells at the edge.
  void count_cells_at_edges(std::vector<std::uint32_t>& counts) const;

 private:
  template <int K>
  void collect(Index v);
  template <int K>
  void renumber();

  const Stars& stars_;
  std::size_t k_;
  struct Place {
    Index vertex = 0;  // the vertex that the slot was given for; 0: none
    std::uint32_t slot = 0;
  };
  std::vector<Place> places_;  // by vertex
  std::vector<Index> neighbors_, old_neighbors_;
  std::vector<CellId> finite_, infinite_;
  std::vector<std::uint32_t> corners_, infinite_corners_, new_slots_;
  std::vector<unsigned char> at_infinity_;
};

}  // namespace delone::particles
