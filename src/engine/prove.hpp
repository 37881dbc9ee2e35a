// SPDX-License-Identifier: BSD-3-Clause
// The proof that proposed cells are a Delaunay triangulation, by exact signs (docs/predicates.md, "Wrapping"): every cell is a
// simplex, every facet has two cells on its two sides, and no vertex opposite a facet is inside the sphere of the cell beyond
// it. That the cells do not cover space several times is for the caller to prove, by one point.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

template <int K, Geometry G>
class Proof {
  using Query = typename G::Query;
  using Evaluator = decltype(std::declval<const G&>().evaluator(std::declval<const Query&>()));

 public:
  /// `queries`: one at every vertex, in the order of their ids; that of vertex 0 is not used.
  Proof(CellStore<K>& cells, G& geometry, std::span<const Query> queries, StageCounts& counts)
      : cells_(cells), geometry_(geometry), queries_(queries), counts_(counts), is_flipped_(cells.num_slots()) {
    cells_.reserve(0);  // what wraps needs links alone, a proof records too
    evaluators_.reserve(queries.size());
    for (const Query& q : queries) evaluators_.push_back(geometry.evaluator(q));
  }

  /// Cells have their vertices in ascending order, and no slot is vacant. Creates what is cached for each, and orients them.
  /// Returns whether all holds, without ties, and every vertex has a cell.
  /// `tick` is called often, and may throw.
  bool run(const std::function<void()>& tick) {
    return create_finite_cells(tick) && create_infinite_cells() && check_facets(tick);
  }

 private:
  static constexpr Index infinite = index(infinite_vertex);
  static constexpr std::size_t batch_size = 64;
  /// How many cells ahead memory is asked for.
  static constexpr Index ahead = 6;

  bool create_finite_cells(const std::function<void()>& tick) {
    std::vector<unsigned char> has_cell(queries_.size());  // written more often than bits should be
    std::array<Index, batch_size> batch;
    std::array<const Index*, batch_size> vertices;
    std::array<Sign, batch_size> orientations;
    std::size_t count = 0;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      const Index* const v = cells_.vertices(cell);
      for (int i = 0; i <= K; ++i) has_cell[v[i]] = 1;
      if (!is_infinite(cell)) {
        batch[count] = cell;
        vertices[count++] = v;
      }
      if (count < batch_size && cell + 1 < cells_.num_slots()) continue;
      tick();
      geometry_.create({batch.data(), count}, {vertices.data(), count}, orientations.data());
      for (std::size_t i = 0; i < count; ++i) {
        if (orientations[i] == Sign::zero) orientations[i] = geometry_.orientation(vertices[i]);
        if (orientations[i] == Sign::zero) return false;
        is_flipped_[batch[i]] = orientations[i] == Sign::negative;
      }
      count = 0;
    }
    return std::find(has_cell.begin(), has_cell.end(), 0) == has_cell.end();
  }

  /// Infinite cells are oriented like their finite neighbors.
  bool create_infinite_cells() {
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      if (!is_infinite(cell)) continue;
      const Index finite = cells_.neighbors(cell)[0];
      if (finite == invalid_index || is_infinite(finite)) return false;
      const int slot = mirror_slot(cell, 0, finite);
      if (slot < 0) return false;
      is_flipped_[cell] = is_flipped_[finite] != (slot % 2 == 0);
      const auto vertices = oriented(cell);
      geometry_.create(cell, vertices.data(), is_flipped_[cell], 1 - is_flipped_[cell]);
    }
    return true;
  }

  bool check_facets(const std::function<void()>& tick) {
    std::size_t num_checked = 0;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      if (cell % batch_size == 0) tick();
      if (const Index asking = cell + ahead; asking < cells_.num_slots())
        for (int i = 0; i <= K; ++i) {  // those of facets that have not been checked then, without a branch
          const Index n = cells_.neighbors(asking)[i];
          const Index is_later = Index{0} - static_cast<Index>((n > asking) & (n != invalid_index));
          cells_.prefetch_links((n & is_later) | (asking & ~is_later));
        }
      const Index* const neighbors = cells_.neighbors(cell);
      std::uint32_t later = 0;  // the neighbors whose facets have not been checked
      for (int i = 0; i <= K; ++i) later |= std::uint32_t{neighbors[i] > cell} << i;
      for (std::uint32_t rest = later; rest != 0; rest &= rest - 1) {
        const int slot = std::countr_zero(rest);
        if (neighbors[slot] == invalid_index || !check_facet(cell, slot, neighbors[slot])) return false;
      }
      num_checked += static_cast<std::size_t>(std::popcount(later));
      // No facet of it is looked at again. Whether it is flipped cannot be predicted: there is no branch.
      const Index flipped = Index{0} - static_cast<Index>(is_flipped_[cell]);
      for (Index* const ids : {cells_.vertices(cell), cells_.neighbors(cell)}) {
        const Index difference = (ids[0] ^ ids[1]) & flipped;
        ids[0] ^= difference;
        ids[1] ^= difference;
      }
    }
    return 2 * num_checked == std::size_t{cells_.num_slots()} * (K + 1);  // no link is one-way
  }

  bool check_facet(Index cell, int slot, Index neighbor) {
    const int mirror = mirror_slot(cell, slot, neighbor);
    if (mirror < 0 || cells_.neighbors(neighbor)[mirror] != cell) return false;
    if (is_flipped_[cell] != (is_flipped_[neighbor] != ((slot + mirror) % 2 == 0))) return false;
    // Between a finite cell and an infinite one it is the latter that says on which side the other's vertex is.
    const bool asks_neighbor = is_infinite(neighbor) && !is_infinite(cell);
    const Index asked = asks_neighbor ? neighbor : cell;
    const Index apex = asks_neighbor ? cells_.vertices(cell)[slot] : cells_.vertices(neighbor)[mirror];
    if (evaluators_[apex].value(asked) > evaluators_[apex].threshold(asked)) {
      ++counts_.filter;
      return true;
    }
    return geometry_.exact_side(oriented(asked).data(), is_infinite(asked) ? int{is_flipped_[asked]} : -1, queries_[apex],
                                counts_) == Sign::positive;
  }

  /// The facet of a neighbor that has the same vertices as facet `slot` of a cell, or −1 if they are no neighbors.
  int mirror_slot(Index cell, int slot, Index neighbor) const {
    const Index* a = cells_.vertices(cell);
    const Index* b = cells_.vertices(neighbor);
    // Which vertices of the facet the neighbor has in the same place among its own, and which in the next one: a bit for each.
    // What is read beyond them are neighbors of the same cell.
    constexpr std::uint32_t all = (std::uint32_t{1} << K) - 1;
    static_assert(K >= 2 && K <= 16);
    FourIds same{}, next{};
    for (Index begin = 0; begin < K; begin += 4) {
      const FourIds number = FourIds{0, 1, 2, 3} + begin, bit = FourIds{1, 2, 4, 8} << begin;
      const FourIds v = number < static_cast<Index>(slot) ? four_ids(a + begin) : four_ids(a + begin + 1);
      same |= four_ids(b + begin) == v ? bit : FourIds{};
      next |= four_ids(b + begin + 1) == v ? bit : FourIds{};
    }
    const auto together = [](FourIds x) { return (x[0] | x[1] | x[2] | x[3]) & all; };
    const int mirror = std::countr_one(together(same));
    return together(next) >> mirror == all >> mirror ? mirror : -1;
  }
  using FourIds = Index __attribute__((vector_size(16)));
  static FourIds four_ids(const Index* from) {
    FourIds ids;
    std::memcpy(&ids, from, sizeof ids);
    return ids;
  }

  bool is_infinite(Index cell) const { return cells_.vertices(cell)[0] == infinite; }
  std::array<Index, K + 1> oriented(Index cell) const {
    std::array<Index, K + 1> vertices;
    std::copy_n(cells_.vertices(cell), K + 1, vertices.begin());
    if (is_flipped_[cell]) std::swap(vertices[0], vertices[1]);
    return vertices;
  }

  CellStore<K>& cells_;
  G& geometry_;
  std::span<const Query> queries_;
  StageCounts& counts_;
  std::vector<bool> is_flipped_;  // whether vertices in ascending order are oriented negatively
  std::vector<Evaluator> evaluators_;
};

}  // namespace delone::engine
