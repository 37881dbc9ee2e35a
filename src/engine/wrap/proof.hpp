// SPDX-License-Identifier: BSD-3-Clause
// The proof that proposed cells are a Delaunay triangulation, by exact signs (docs/predicates.md,
// "Wrapping"): every cell is a simplex, every facet has two cells on its two sides, and no vertex opposite a
// facet is inside the sphere of the cell beyond it. That the cells do not cover space several times is proved
// by one point, of which the caller proves that it is in one finite cell.
//
// Several threads check a part of the cells each, and every facet from its later cell, whose part may be
// checked before that of the other. Then the orientations of the two are compared at the end.
//
// Functionals are made for some cells at a time and forgotten: most users of a triangulation never need them.
#pragma once

#include "base/compiler.hpp"
#include "base/parallel_parts.hpp"
#include "base/stage_counts.hpp"
#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace delone::engine {

using internal::StageCounts;

/// PartSize: the number of cells that a thread checks at a time, a multiple of 64.
template <int K, Geometry G, Index PartSize = 8192>
class Proof {
  using Query = typename G::Query;
  using Evaluator = decltype(std::declval<const G&>().evaluator(std::declval<const Query&>()));

 public:
  /// How many cells each geometry must have room for: functionals are made for so many cells at a time, and
  /// not kept.
  static constexpr std::size_t batch_size = 64;

  /// `geometries`: one for each thread. `queries`: one at every vertex, in the order of their ids; that of
  /// vertex 0 is not used.
  Proof(CellStore<K>& cells, std::span<G* const> geometries, std::span<const Query> queries,
        StageCounts& counts)
      : cells_(cells),
        geometries_(geometries),
        queries_(queries),
        counts_(counts),
        is_flipped_((cells.num_slots() + bits_of_word - 1) / bits_of_word),
        parts_((cells.num_slots() + part_size - 1) / part_size) {}

  /// Returns whether the cells are proved, without ties, every vertex has a cell, and the point is on the
  /// inner side of all infinite cells. If so, orients the cells. `tick` is called often by this thread, with
  /// the fraction done, and may throw. REQUIRES cells with wide vertices in ascending order, and no vacant
  /// slot.
  bool run(const Query& point, const std::function<void(double)>& tick) {
    workers_.clear();
    for (G* const geometry : geometries_) workers_.push_back({*geometry, queries_});
    std::size_t num_checked = 0;
    const bool is_proved = for_all_parts([&](Index first, Index last, Worker& worker) {
                             return check_finite_cells(first, last, worker, tick);
                           }) &&
                           have_cells() && for_all_parts([&](Index first, Index last, Worker& worker) {
                             return check_infinite_cells(first, last, worker, point);
                           });
    for (const Worker& worker : workers_) {
      num_checked += worker.num_checked;
      add(worker.counts);
    }
    // Otherwise some links are one-way.
    return is_proved && 2 * num_checked == std::size_t{cells_.num_slots()} * (K + 1) &&
           for_all_parts([&](Index first, Index last, Worker&) { return orient(first, last); });
  }
  Index num_infinite() const {
    std::size_t count = 0;
    for (const Part& part : parts_) count += part.infinite_cells.size();
    return static_cast<Index>(count);
  }

 private:
  static constexpr Index infinite = index(infinite_vertex);
  /// How many cells ahead memory is prefetched.
  static constexpr Index ahead = 6;
  static constexpr Index bits_of_word = 64;

  /// A facet between two parts of the cells. What the orientations of its two cells have to do with each
  /// other is known, but not whether they have it.
  struct Pending {
    Index cell, neighbor;
    bool differ;
  };
  /// Consecutive cells, which one thread checks at a time.
  struct Part {
    std::vector<Index> infinite_cells;
    std::vector<Pending> pending;
    std::atomic<int> stage = 0;  ///< how many stages have been completed
  };
  static constexpr Index part_size = PartSize;
  static_assert(part_size % bits_of_word == 0);

  /// The memory of a thread.
  struct alignas(64) Worker {
    Worker(G& own, std::span<const Query> queries) : geometry(&own), has_cell(queries.size()) {
      evaluators.reserve(queries.size());
      for (const Query& q : queries) evaluators.push_back(own.evaluator(q));
    }
    G* geometry;
    std::vector<Evaluator> evaluators;
    std::vector<unsigned char> has_cell;  // of the vertices; bytes, as bits would be slower to write
    std::size_t num_checked = 0;          // facets
    StageCounts counts;
    Index first = 0;  // cell of the present part
    int stage = 0;
  };

  /// Calls check(first, last, worker) for all parts, in all threads, until one returns false. Returns whether
  /// none did.
  template <class Check>
  bool for_all_parts(const Check& check) {
    std::atomic<bool> is_right = true;
    std::atomic<std::size_t> num_workers = 0;
    ++stage_;
    internal::work_in_parts(static_cast<unsigned>(workers_.size()), cells_.num_slots(), part_size, [&] {
      Worker& worker = workers_[num_workers.fetch_add(1, std::memory_order_relaxed)];
      return [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
        if (!is_right.load(std::memory_order_relaxed)) return;
        stop();
        worker.first = static_cast<Index>(first);
        if (!check(worker.first, static_cast<Index>(last), worker))
          is_right.store(false, std::memory_order_relaxed);
        parts_[first / part_size].stage.store(stage_, std::memory_order_release);
      };
    });
    return is_right;
  }

  bool check_finite_cells(Index first, Index last, Worker& worker, const std::function<void(double)>& tick) {
    G& geometry = *worker.geometry;
    std::vector<Index>& infinite_cells = parts_[first / part_size].infinite_cells;
    std::array<Index, batch_size> batch, numbers;
    std::iota(numbers.begin(), numbers.end(), Index{0});
    std::array<const Index*, batch_size> vertices;
    std::array<Sign, batch_size> orientations;
    for (Index next = first; next < last;) {
      if (std::this_thread::get_id() == caller_)
        tick(static_cast<double>(next) / static_cast<double>(cells_.num_slots()));
      std::size_t count = 0;
      for (; count < batch_size && next < last; ++next) {
        const Index* const v = cells_.wide_vertices(next);
        for (int i = 0; i <= K; ++i) worker.has_cell[v[i]] = 1;
        if (is_infinite(next)) {
          infinite_cells.push_back(next);
        } else {
          batch[count] = next;
          vertices[count++] = v;
        }
      }
      geometry.create({numbers.data(), count}, {vertices.data(), count}, orientations.data());
      for (std::size_t i = 0; i < count; ++i) {
        if (orientations[i] == Sign::zero) orientations[i] = geometry.orientation(vertices[i]);
        if (orientations[i] == Sign::zero) return false;
        set_flipped(batch[i], orientations[i] == Sign::negative);
      }
      for (std::size_t i = 0; i < count; ++i) {
        prefetch_earlier(batch[i] + ahead);
        if (!check_earlier(batch[i], numbers[i], worker)) return false;
      }
    }
    return true;
  }

  /// Whether all vertices have.
  bool have_cells() const {
    for (std::size_t v = 0; v < queries_.size(); ++v)
      if (std::none_of(workers_.begin(), workers_.end(),
                       [&](const Worker& worker) { return worker.has_cell[v] != 0; }))
        return false;
    return true;
  }

  /// Infinite cells are oriented like their finite neighbors. Then the hull facet between them has them on
  /// its two sides.
  bool check_infinite_cells(Index first, [[maybe_unused]] Index last, Worker& worker, const Query& point) {
    G& geometry = *worker.geometry;
    const std::span<const Index> infinite_cells = parts_[first / part_size].infinite_cells;
    const Evaluator at_point = geometry.evaluator(point);
    for (std::size_t i = 0; i < infinite_cells.size(); ++i) {
      if (i + ahead < infinite_cells.size()) {
        const Index later = infinite_cells[i + ahead];
        prefetch_earlier(later);
        if (const Index finite = cells_.neighbors(later)[0]; finite != invalid_index)
          cells_.prefetch_links(finite);
      }
      const Index cell = infinite_cells[i];
      const Index finite = cells_.neighbors(cell)[0];
      if (finite == invalid_index || is_infinite(finite)) return false;
      const int slot = mirror_slot(cell, 0, finite);
      if (slot < 0 || cells_.neighbors(finite)[slot] != cell) return false;
      set_flipped(cell, is_flipped(finite) != (slot % 2 == 0));
      ++worker.num_checked;
      geometry.create(0, oriented(cell).data(), is_flipped(cell), 1 - is_flipped(cell));
      if (!check_earlier(cell, 0, worker)) return false;
      if (!(at_point.value(0) > at_point.threshold(0)) && exact_side(cell, point, worker) != Sign::positive)
        return false;
    }
    return true;
  }

  /// Checks what is left, and exchanges two vertices of the cells that are oriented negatively, without a
  /// branch, as these are unpredictable.
  bool orient(Index first, Index last) {
    for (const Pending& facet : parts_[first / part_size].pending)
      if ((is_flipped(facet.cell) != is_flipped(facet.neighbor)) != facet.differ) return false;
    for (Index cell = first; cell < last; ++cell) {
      const Index flipped = Index{0} - static_cast<Index>(is_flipped(cell));
      for (Index* const ids : {cells_.wide_vertices(cell), cells_.neighbors(cell)}) {
        const Index difference = (ids[0] ^ ids[1]) & flipped;
        ids[0] ^= difference;
        ids[1] ^= difference;
      }
    }
    return true;
  }

  /// Whether vertices in ascending order are oriented negatively. Threads write to the words of their own
  /// parts and read others'.
  bool is_flipped(Index cell) const {
    return (is_flipped_[cell / bits_of_word].load(std::memory_order_relaxed) >> cell % bits_of_word & 1) != 0;
  }
  void set_flipped(Index cell, bool flipped) {
    std::atomic<std::uint64_t>& word = is_flipped_[cell / bits_of_word];
    word.store(word.load(std::memory_order_relaxed) | std::uint64_t{flipped} << cell % bits_of_word,
               std::memory_order_relaxed);
  }
  void add(const StageCounts& counts) {
    counts_.filter += counts.filter;
    counts_.direct += counts.direct;
    counts_.exact += counts.exact;
    counts_.perturbed += counts.perturbed;
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
  bool check_earlier(Index cell, Index number, Worker& worker) {
    const Index* const neighbors = cells_.neighbors(cell);
    const bool with_infinite = is_infinite(cell);
    std::uint32_t earlier = 0;
    for (int i = 0; i <= K; ++i) earlier |= std::uint32_t{neighbors[i] < cell} << i;
    for (; earlier != 0; earlier &= earlier - 1) {
      const int slot = std::countr_zero(earlier);
      if (is_infinite(neighbors[slot]) != with_infinite) continue;
      if (!check_facet(cell, number, slot, neighbors[slot], worker)) return false;
      ++worker.num_checked;
    }
    return true;
  }

  bool check_facet(Index cell, Index number, int slot, Index neighbor, Worker& worker) {
    const int mirror = mirror_slot(cell, slot, neighbor);
    if (mirror < 0 || cells_.neighbors(neighbor)[mirror] != cell) return false;
    const bool differ = (slot + mirror) % 2 == 0;
    if (neighbor < worker.first &&
        parts_[neighbor / part_size].stage.load(std::memory_order_acquire) < stage_)
      parts_[worker.first / part_size].pending.push_back({cell, neighbor, differ});
    else if ((is_flipped(cell) != is_flipped(neighbor)) != differ)
      return false;
    const Index apex = cells_.wide_vertices(neighbor)[mirror];
    const Evaluator& at_apex = worker.evaluators[apex];
    if (at_apex.value(number) > at_apex.threshold(number)) {
      ++worker.counts.filter;
      return true;
    }
    return exact_side(cell, queries_[apex], worker) == Sign::positive;
  }

  Sign exact_side(Index cell, const Query& q, Worker& worker) {
    return worker.geometry->exact_side(oriented(cell).data(), is_infinite(cell) ? int{is_flipped(cell)} : -1,
                                       q, worker.counts);
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
      const FourIds v =
          internal::select(number < static_cast<Index>(slot), four_ids(a + begin), four_ids(a + begin + 1));
      same |= internal::select(four_ids(b + begin) == v, bit, FourIds{});
      next |= internal::select(four_ids(b + begin + 1) == v, bit, FourIds{});
    }
    const auto together = [](FourIds x) { return (x[0] | x[1] | x[2] | x[3]) & all; };
    const int mirror = std::countr_one(together(same));
    return together(next) >> mirror == all >> mirror ? mirror : -1;
  }
  using FourIds = internal::Lanes<Index, 4>;
  static FourIds four_ids(const Index* from) {
    FourIds ids;
    std::memcpy(&ids, from, sizeof ids);
    return ids;
  }

  bool is_infinite(Index cell) const { return cells_.wide_vertices(cell)[0] == infinite; }
  std::array<Index, K + 1> oriented(Index cell) const {
    std::array<Index, K + 1> vertices;
    std::copy_n(cells_.wide_vertices(cell), K + 1, vertices.begin());
    if (is_flipped(cell)) std::swap(vertices[0], vertices[1]);
    return vertices;
  }

  CellStore<K>& cells_;
  std::span<G* const> geometries_;
  std::span<const Query> queries_;
  StageCounts& counts_;
  std::vector<std::atomic<std::uint64_t>> is_flipped_;
  std::vector<Part> parts_;
  std::vector<Worker> workers_;
  const std::thread::id caller_ = std::this_thread::get_id();
  int stage_ = 0;  // the present one
};

}  // namespace delone::engine
