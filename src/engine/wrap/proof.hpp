// SPDX-License-Identifier: BSD-3-Clause
// The proof that proposed cells are a Delaunay triangulation, by exact signs (docs/predicates.md,
// "Wrapping"): every cell is a simplex, every facet has two cells on its two sides, and no vertex opposite a
// facet is inside the sphere of the cell beyond it. That the cells do not cover space several times is proved
// by one point, of which the caller proves that it is in one finite cell.
//
// Functionals are made for some cells at a time and forgotten: most users of a triangulation never need them.
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
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

template <int K, Geometry G>
class Proof {
  using Query = typename G::Query;
  using Evaluator = decltype(std::declval<const G&>().evaluator(std::declval<const Query&>()));

 public:
  /// How many cells `geometry` must have room for: functionals are made for so many cells at a time, and not
  /// kept.
  static constexpr std::size_t batch_size = 64;

  /// `queries`: one at every vertex, in the order of their ids; that of vertex 0 is not used.
  Proof(CellStore<K>& cells, G& geometry, std::span<const Query> queries, StageCounts& counts)
      : cells_(cells),
        geometry_(geometry),
        queries_(queries),
        counts_(counts),
        is_flipped_(cells.num_slots()) {
    evaluators_.reserve(queries.size());
    for (const Query& q : queries) evaluators_.push_back(geometry.evaluator(q));
  }

  /// Returns whether the cells are proved, without ties, every vertex has a cell, and the point is on the
  /// inner side of all infinite cells. If so, orients the cells. `tick` is called often with the
  /// fraction done, and may throw.
  /// REQUIRES cells with wide vertices in ascending order, and no vacant slot.
  bool run(const Query& point, const std::function<void(double)>& tick) {
    if (!check_finite_cells(tick) || !check_infinite_cells(point)) return false;
    if (2 * num_checked_ != std::size_t{cells_.num_slots()} * (K + 1))
      return false;  // some links are one-way
    orient();
    return true;
  }
  Index num_infinite() const { return static_cast<Index>(infinite_cells_.size()); }

 private:
  static constexpr Index infinite = index(infinite_vertex);
  /// How many cells ahead memory is prefetched.
  static constexpr Index ahead = 6;

  bool check_finite_cells(const std::function<void(double)>& tick) {
    std::vector<unsigned char> has_cell(queries_.size());  // bytes, as bits would be slower to write
    std::array<Index, batch_size> batch, numbers;
    std::iota(numbers.begin(), numbers.end(), Index{0});
    std::array<const Index*, batch_size> vertices;
    std::array<Sign, batch_size> orientations;
    for (Index next = 0; next < cells_.num_slots();) {
      tick(static_cast<double>(next) / static_cast<double>(cells_.num_slots()));
      std::size_t count = 0;
      for (; count < batch_size && next < cells_.num_slots(); ++next) {
        const Index* const v = cells_.wide_vertices(next);
        for (int i = 0; i <= K; ++i) has_cell[v[i]] = 1;
        if (is_infinite(next)) {
          infinite_cells_.push_back(next);
        } else {
          batch[count] = next;
          vertices[count++] = v;
        }
      }
      geometry_.create({numbers.data(), count}, {vertices.data(), count}, orientations.data());
      for (std::size_t i = 0; i < count; ++i) {
        if (orientations[i] == Sign::zero) orientations[i] = geometry_.orientation(vertices[i]);
        if (orientations[i] == Sign::zero) return false;
        is_flipped_[batch[i]] = orientations[i] == Sign::negative;
      }
      for (std::size_t i = 0; i < count; ++i) {
        prefetch_earlier(batch[i] + ahead);
        if (!check_earlier(batch[i], numbers[i])) return false;
      }
    }
    return std::find(has_cell.begin(), has_cell.end(), 0) == has_cell.end();
  }

  /// Infinite cells are oriented like their finite neighbors. Then the hull facet between them has them on
  /// its two sides.
  bool check_infinite_cells(const Query& point) {
    const Evaluator at_point = geometry_.evaluator(point);
    for (std::size_t i = 0; i < infinite_cells_.size(); ++i) {
      if (i + ahead < infinite_cells_.size()) {
        const Index later = infinite_cells_[i + ahead];
        prefetch_earlier(later);
        if (const Index finite = cells_.neighbors(later)[0]; finite != invalid_index)
          cells_.prefetch_links(finite);
      }
      const Index cell = infinite_cells_[i];
      const Index finite = cells_.neighbors(cell)[0];
      if (finite == invalid_index || is_infinite(finite)) return false;
      const int slot = mirror_slot(cell, 0, finite);
      if (slot < 0 || cells_.neighbors(finite)[slot] != cell) return false;
      is_flipped_[cell] = is_flipped_[finite] != (slot % 2 == 0);
      ++num_checked_;
      geometry_.create(0, oriented(cell).data(), is_flipped_[cell], 1 - is_flipped_[cell]);
      if (!check_earlier(cell, 0)) return false;
      if (!(at_point.value(0) > at_point.threshold(0)) && exact_side(cell, point) != Sign::positive)
        return false;
    }
    return true;
  }

  /// Exchanges two vertices of the cells that are oriented negatively, without a branch, as these are
  /// unpredictable.
  void orient() {
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      const Index flipped = Index{0} - static_cast<Index>(is_flipped_[cell]);
      for (Index* const ids : {cells_.wide_vertices(cell), cells_.neighbors(cell)}) {
        const Index difference = (ids[0] ^ ids[1]) & flipped;
        ids[0] ^= difference;
        ids[1] ^= difference;
      }
    }
  }

  /// Prefetches the neighbors of a cell that come before it, without a branch.
  [[gnu::always_inline]] void prefetch_earlier(
      Index cell) const {  // otherwise GCC drops calls as having no effect
    if (cell >= cells_.num_slots()) return;
    for (int i = 0; i <= K; ++i) {
      const Index n = cells_.neighbors(cell)[i];
      const Index is_earlier = Index{0} - static_cast<Index>(n < cell);
      cells_.prefetch_links((n & is_earlier) | (cell & ~is_earlier));
    }
  }

  /// Checks the facets to the cells before this one that are finite or infinite like it. The geometry has its
  /// functional under the id `number`.
  bool check_earlier(Index cell, Index number) {
    const Index* const neighbors = cells_.neighbors(cell);
    const bool with_infinite = is_infinite(cell);
    std::uint32_t earlier = 0;
    for (int i = 0; i <= K; ++i) earlier |= std::uint32_t{neighbors[i] < cell} << i;
    for (; earlier != 0; earlier &= earlier - 1) {
      const int slot = std::countr_zero(earlier);
      if (is_infinite(neighbors[slot]) != with_infinite) continue;
      if (!check_facet(cell, number, slot, neighbors[slot])) return false;
      ++num_checked_;
    }
    return true;
  }

  bool check_facet(Index cell, Index number, int slot, Index neighbor) {
    const int mirror = mirror_slot(cell, slot, neighbor);
    if (mirror < 0 || cells_.neighbors(neighbor)[mirror] != cell) return false;
    if (is_flipped_[cell] != (is_flipped_[neighbor] != ((slot + mirror) % 2 == 0))) return false;
    const Index apex = cells_.wide_vertices(neighbor)[mirror];
    if (evaluators_[apex].value(number) > evaluators_[apex].threshold(number)) {
      ++counts_.filter;
      return true;
    }
    return exact_side(cell, queries_[apex]) == Sign::positive;
  }

  Sign exact_side(Index cell, const Query& q) {
    return geometry_.exact_side(oriented(cell).data(), is_infinite(cell) ? int{is_flipped_[cell]} : -1, q,
                                counts_);
  }

  /// The facet of a neighbor that has the same vertices as facet `slot` of a cell, or −1 if they are not
  /// neighbors.
  int mirror_slot(Index cell, int slot, Index neighbor) const {
    const Index* a = cells_.wide_vertices(cell);
    const Index* b = cells_.wide_vertices(neighbor);
    // A bit for each vertex of the facet: does the neighbor have it in the same place among its own, or in
    // the next one? Ids read beyond the vertices are neighbors of the same cell.
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

  bool is_infinite(Index cell) const { return cells_.wide_vertices(cell)[0] == infinite; }
  std::array<Index, K + 1> oriented(Index cell) const {
    std::array<Index, K + 1> vertices;
    std::copy_n(cells_.wide_vertices(cell), K + 1, vertices.begin());
    if (is_flipped_[cell]) std::swap(vertices[0], vertices[1]);
    return vertices;
  }

  CellStore<K>& cells_;
  G& geometry_;
  std::span<const Query> queries_;
  StageCounts& counts_;
  std::vector<bool> is_flipped_;  // whether vertices in ascending order are oriented negatively
  std::vector<Evaluator> evaluators_;
  std::vector<Index> infinite_cells_;
  std::size_t num_checked_ = 0;  // facets
};

}  // namespace delone::engine
