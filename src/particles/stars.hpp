// SPDX-License-Identifier: BSD-3-Clause
// The cells at each vertex, in an order that depends on the ids of vertices alone, and not on those of cells,
// which several threads give differently. So what is summed over a star has the same bits for every number of
// threads.
#pragma once

#include <delone/complex.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::particles {

/// Another order of vertices than that of their ids, in which the first ones are those whose stars are
/// wanted.
struct VertexOrder {
  std::vector<Index> ids;    ///< by rank; the infinite vertex is first
  std::vector<Index> ranks;  ///< by vertex id
  Index last_site = 0;       ///< the rank of the last vertex whose star is wanted
};

class Stars {
 public:
  /// Of a complex of dimension k ≥ 1, which must not change. Cost O(cells·k²).
  explicit Stars(const Complex& complex);
  /// The same with vertices in another order. Cells at none of the wanted vertices are left out.
  Stars(const Complex& complex, const VertexOrder& order);

  std::size_t dimension() const { return k_; }
  std::size_t num_cells() const { return ids_.size(); }
  /// The k+1 vertices of a cell, in order: the first of an infinite cell is the infinite vertex. Cells are
  /// numbered in lexicographic order.
  std::span<const Index> vertices(std::size_t cell) const {
    return {vertices_.data() + cell * (k_ + 1), k_ + 1};
  }
  CellId id(std::size_t cell) const { return ids_[cell]; }
  /// The cells at a vertex, increasing, so infinite ones come first. REQUIRES that its star is wanted.
  std::span<const Index> cells_at(Index v) const {
    return std::span(cells_).subspan(offsets_[v], offsets_[v + 1] - offsets_[v]);
  }

 private:
  Stars(const Complex& complex, const VertexOrder* order);
  template <int K>
  void sort(const Complex& complex, const VertexOrder* order);
  void fill();

  std::size_t k_;
  std::vector<Index> vertices_, cells_;
  std::vector<CellId> ids_;
  std::vector<std::size_t> offsets_;
};

/// The star of one vertex in local numbers.
class Star {
 public:
  explicit Star(const Stars& stars, std::size_t num_vertex_slots)
      : stars_(stars), places_(num_vertex_slots) {}

  void find(Index v);

  /// The vertices that edges join to it. Their places in here are *slots*.
  std::span<const Index> neighbors() const { return neighbors_; }
  /// The k slots of each finite cell.
  std::span<const std::uint32_t> corners() const { return corners_; }
  /// The slots of any cell: of cell c of Stars::cells_at().
  std::span<const std::uint32_t> slots_of(std::size_t c) const {
    const std::size_t k = stars_.dimension();
    if (c < num_infinite_) return {infinite_corners_.data() + c * (k - 1), k - 1};
    return {corners_.data() + (c - num_infinite_) * k, k};
  }
  /// The number of finite cells at the edge to a neighbor, and whether infinite cells are there, too.
  std::uint32_t num_cells_at(std::size_t slot) const { return num_cells_at_[slot]; }
  bool is_at_infinity(std::size_t slot) const { return slot < num_at_infinity_; }
  bool is_bounded() const { return num_infinite_ == 0; }
  /// How many of the cells at the vertex are infinite: the first ones.
  std::size_t num_infinite() const { return num_infinite_; }

 private:
  template <int K>
  void collect(Index v);

  const Stars& stars_;
  struct Place {
    Index vertex = 0;  // the vertex that the slot was given for; 0: none
    std::uint32_t slot = 0;
  };
  std::vector<Place> places_;  // by vertex
  std::vector<Index> neighbors_;
  std::vector<std::uint32_t> corners_, infinite_corners_, num_cells_at_;
  std::size_t num_infinite_ = 0, num_at_infinity_ = 0;
};

}  // namespace delone::particles
