// SPDX-License-Identifier: BSD-3-Clause
// Vertices have moved a little, or have other weights: most cells around them are still Delaunay, and only
// their functionals are new. The others, and those next to them, are holes that are filled again.
//
// Cells that are positively oriented and locally Delaunay at all facets are Delaunay if they are a
// triangulation. That they are one follows from what they were before the vertices moved. While vertices
// move, and when a hole is filled with cells of the same border, the number of times that cells cover a
// point, counted with orientation, stays what it is for all points but those that the hull passes. It is 1
// inside the hull. So where no infinite cell is touched, positive cells cover each point inside once. Where
// all vertices move, a point is sought that one finite cell contains and that is on the inner side of all
// infinite cells. Seen from there, the hull is covered once, too, so no two of its facets are folded onto
// each other, and it is convex since it is at every ridge.
#pragma once

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "engine/change.hpp"
#include "engine/hole/edge_flips.hpp"
#include "engine/hole/moved_cells.hpp"
#include "engine/hole/refill.hpp"
#include "engine/hole/star_in_plane.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone::engine {

/// Memory is kept from one use to the next.
template <int K, Geometry G>
class Relocation {
  using Query = typename G::Query;

 public:
  Relocation(Sphere<K, G>& sphere, HoleFiller<K, G>& filler)
      : sphere_(sphere),
        cells_(sphere.cells()),
        geometry_(sphere.geometry()),
        filler_(filler),
        moved_cells_(cells_, geometry_) {}

  /// After one vertex has moved, one of whose cells is `cell`: keeps it where it is in the cells. `costly` if
  /// that cannot be, as on the hull, or if many cells would change. Then no cell has changed, but the
  /// functionals of those in star() are wrong.
  Change relocate(Index v, Index cell) {
    bad_.clear();
    seeds_.clear();
    num_saved_ = 0;
    if constexpr (K == 2)
      if (!geometry_.may_hide()) return relocate_by_flips(v, cell);
    if (!find_bad_cells_of_star(v, cell) || !fill_one_hole()) return {Outcome::costly};
    around_.insert(around_.end(), hole_.begin(), hole_.end());
    return {Outcome::done, v, around_, hole_.empty() ? std::span<const Index>() : filler_.created()};
  }
  /// After any vertices have moved, in up to `threads` threads (Options::threads). `find_inside` returns a
  /// query in the interior of the hull, with weights one as heavy as any vertex, or nothing. Where a hole at
  /// the hull cannot be filled, `put_back` is called at most once, with vertices, those of the hull among
  /// them: these are to get the points that they had. Where much has changed, the result is `costly`, and
  /// soon found to be so; then some cells may have changed, and all functionals are wrong. Some of the cells
  /// that were made may be gone again.
  template <class FindInside, class PutBack>
  Change relocate_all(unsigned threads, FindInside&& find_inside, PutBack&& put_back) {
    bad_.clear();
    seeds_.clear();
    created_.clear();
    if (!is_promising()) return {Outcome::costly};
    find_all_bad_cells(threads);
    if (!fill_holes()) {
      const bool is_at_hull =
          std::any_of(hole_.begin(), hole_.end(), [&](Index cell) { return geometry_.is_infinite(cell); });
      if (!is_at_hull || !release_hull(put_back) || !fill_holes()) return {Outcome::costly};
    }
    if (!covers_once(threads, find_inside)) return {Outcome::costly};
    return {Outcome::done, invalid_index, {}, created_};
  }
  /// After a relocation that was too costly, when the vertex is where it was: its cells get their functionals
  /// back.
  void take_back() noexcept {
    for (std::size_t i = 0; i < num_saved_; ++i)
      geometry_.put_back(around_[i], saved_.data() + i * (width() + 1));
  }

 private:
  enum State : std::uint32_t { is_bad, is_in_hole, is_new };
  static constexpr std::size_t batch_size = MovedCells<K, G>::batch_size;
  /// Threads take so many slots of cells at a time.
  static constexpr std::size_t slots_per_part = 8192;

  int dimension() const { return cells_.dimension(); }
  std::size_t width() const { return static_cast<std::size_t>(dimension()) + 1; }

  /// In the plane, where no vertex can be hidden: keeps the vertex if it is inside the polygon of its star.
  Change relocate_by_flips(Index v, Index cell) requires(K == 2) {
    flips_.begin();
    if (!find_star_in_plane(v, cell)) return {Outcome::costly};
    find_bad_edges(v);
    if (flips_.is_empty()) return {Outcome::done, v, around_, {}};
    sphere_.workspace().clear();
    constexpr std::size_t flips_per_cell = 4;
    around_.reserve((1 + 2 * flips_per_cell) * star_.size());  // nothing must fail when cells have changed
    if (!flips_.run(sphere_, moved_cells_, flips_per_cell * star_.size())) return {Outcome::costly};
    around_.insert(around_.end(), flips_.flipped().begin(), flips_.flipped().end());
    return {Outcome::done, v, around_, flips_.flipped()};
  }
  void find_bad_edges(Index v) requires(K == 2) {
    const std::span<const StarInPlane::Sector> sectors = star_.sectors();
    const StarInPlane::Sector* before = &sectors[sectors.size() - 2];
    const StarInPlane::Sector* last = &sectors.back();
    for (const StarInPlane::Sector& sector : sectors) {
      if (!is_locally_delaunay({sector.cell, sector.survivor, cells_.vertex(sector.survivor, sector.mirror)}))
        flips_.add(sector.cell, cells_.slot_of_vertex(sector.cell, v));
      if (!is_locally_delaunay(
              {before->cell, last->cell, sector.vertex}))  // where the edge of the last one ends
        flips_.add(before->cell, cells_.slot_of_neighbor(before->cell, last->cell));
      before = std::exchange(last, &sector);
    }
  }
  /// The star of a vertex, with new functionals. Returns false if one of its cells is infinite or not
  /// positively oriented.
  bool find_star_in_plane(Index v, Index cell) requires(K == 2) {
    const bool is_inside = star_.find(cells_, geometry_, v, cell);
    around_.clear();
    for (const StarInPlane::Sector& sector : star_.sectors()) around_.push_back(sector.cell);
    return is_inside && may_stay_in_plane(v) && renew_star_in_plane();
  }

  /// Finds the cells of a vertex, computes their functionals, and finds those that are bad now. Returns false
  /// if one of them is infinite or not positively oriented, or if so many are bad that removing the vertex
  /// costs no more.
  bool find_bad_cells_of_star(Index v, Index cell) {
    if constexpr (K == 2)
      return find_star_in_plane(v, cell) && find_bad_cells_in_plane();
    else
      return find_star(v, cell) && renew_star() && find_bad_cells();
  }
  bool are_too_many_bad() const { return 2 * seeds_.size() > around_.size(); }
  /// Keeps the functionals of the star for take_back().
  void save_functionals() {
    saved_.resize(around_.size() * (width() + 1));
    for (std::size_t i = 0; i < around_.size(); ++i)
      geometry_.save(around_[i], saved_.data() + i * (width() + 1));
    num_saved_ = around_.size();
  }
  /// Whether no edge around the vertex has it on the wrong side for certain.
  bool may_stay_in_plane(Index v) const requires(K == 2) {
    const std::span<const StarInPlane::Sector> sectors = star_.sectors();
    Index to = sectors.front().vertex;
    for (std::size_t i = sectors.size(); i-- > 0;) {
      const Index from = sectors[i].vertex;
      if (geometry_.certain_side(from, to, v) == Sign::negative) return false;
      to = from;
    }
    return true;
  }
  /// Stars of the plane have few cells, which are faster one by one.
  bool renew_star_in_plane() requires(K == 2) {
    save_functionals();
    for (const StarInPlane::Sector& sector : star_.sectors()) {
      geometry_.prefetch_row(cells_.vertex(sector.survivor, sector.mirror));
      const auto vertices = cells_.vertices(sector.cell);
      const Index* const v = vertices;
      if (geometry_.create(sector.cell, v, -1, 0) != Sign::positive &&
          geometry_.orientation(v) != Sign::positive)
        return false;
    }
    return true;
  }
  bool find_bad_cells_in_plane() requires(K == 2) {
    const std::span<const StarInPlane::Sector> sectors = star_.sectors();
    const auto test = [&](const FacetToTest& facet) {
      if (!is_locally_delaunay(facet)) add_bad(facet);
    };
    const StarInPlane::Sector* before = &sectors[sectors.size() - 2];
    const StarInPlane::Sector* last = &sectors.back();
    for (const StarInPlane::Sector& sector : sectors) {
      test({sector.cell, sector.survivor, cells_.vertex(sector.survivor, sector.mirror)});
      test({before->cell, last->cell, sector.vertex});  // where the edge of the last one ends
      before = std::exchange(last, &sector);
      if (are_too_many_bad()) return false;
    }
    return true;
  }

  /// Returns false as soon as a cell of the star is infinite.
  bool find_star(Index v, Index cell) {
    around_.clear();
    around_set_.clear();
    const auto add = [&](Index next) {
      if (!around_set_.insert(next, 0).second) return true;
      around_.push_back(next);
      cells_.prefetch_neighbors(next);
      return !geometry_.is_infinite(next);
    };
    if (!add(cell)) return false;
    for (std::size_t i = 0; i < around_.size(); ++i) {
      const int slot_of_v = cells_.slot_of_vertex(around_[i], v);
      for (int slot = 0; slot <= dimension(); ++slot)
        if (slot != slot_of_v && !add(cells_.neighbors(around_[i])[slot])) return false;
    }
    return true;
  }

  /// Returns false if a cell of the star is not positively oriented.
  bool renew_star() {
    save_functionals();
    bool are_positive = true;
    for (std::size_t i = 0; i < around_.size() && are_positive; i += batch_size) {
      internal::cancellation_point();
      const std::size_t count = std::min(batch_size, around_.size() - i);
      moved_cells_.renew({around_.data() + i, count}, [&](Index) { are_positive = false; });
    }
    return are_positive;
  }
  void add_bad(Index cell) {
    const auto [state, is_unknown] = bad_.insert(cell, is_bad);
    if (!is_unknown && state == is_bad) return;
    state = is_bad;
    seeds_.push_back(cell);
  }
  void add_bad(const FacetToTest& facet) {
    add_bad(facet.cell);
    add_bad(facet.neighbor);
  }
  bool is_locally_delaunay(const FacetToTest& facet) {
    return facet.apex == index(infinite_vertex) ||
           moved_cells_.is_locally_delaunay(facet, sphere_.effort().stages);
  }

  /// The cells on both sides of facets where those of the star are not locally Delaunay.
  bool find_bad_cells() {
    for (const Index cell : around_) {
      if (++calls_ % 1024 == 0) internal::cancellation_point();
      for (int slot = 0; slot <= dimension(); ++slot) {
        const Index neighbor = cells_.neighbors(cell)[slot];
        if (neighbor < cell && around_set_.contains(neighbor)) continue;
        if (const FacetToTest facet = moved_cells_.facet_to(cell, neighbor); !is_locally_delaunay(facet))
          add_bad(facet);
      }
      if (are_too_many_bad()) return false;
    }
    return true;
  }

  /// Whether few of some cells, evenly spaced, are bad. If more are, holes grow into each other, and to
  /// rebuild costs less.
  bool is_promising() {
    constexpr std::size_t most = 1024;
    const std::size_t one_in = 8 * static_cast<std::size_t>(dimension());
    std::size_t num_tested = 0, num_bad = 0;
    const std::size_t step = cells_.num_slots() / most + 1;
    for (std::size_t slot = 0; slot < cells_.num_slots(); slot += step) {
      const auto cell = static_cast<Index>(slot);
      if (cells_.is_vacant(cell)) continue;
      bool is_good = true;
      moved_cells_.renew({&cell, 1}, [&](Index) { is_good = false; });
      for (int i = 0; i <= dimension() && is_good; ++i)
        is_good = is_locally_delaunay(moved_cells_.facet_to(cell, cells_.neighbors(cell)[i]));
      ++num_tested;
      num_bad += is_good ? 0 : 1;
    }
    return num_bad * one_in <= num_tested;
  }

  /// Computes the functionals of all cells, and finds those that are not positively oriented, and those on
  /// both sides of facets where they are not locally Delaunay. A neighbor of a cell of the first kind may be
  /// missed; whatever fills the hole is tested against it.
  void find_all_bad_cells(unsigned threads) {
    struct Found {
      std::vector<Index> inverted;
      std::vector<FacetToTest> bad;
      StageCounts counts;
    };
    std::vector<Found> found(cells_.num_slots() / slots_per_part + 1);
    internal::work_in_parts(threads, cells_.num_slots(), slots_per_part, [&] {
      return [&, of_thread = MovedCellsOfThread<K, G>(cells_, geometry_)](
                 std::size_t first, std::size_t last, const internal::StopPoint& stop) mutable {
        Found& part = found[first / slots_per_part];
        of_thread.cells.renew_slots(first, last, part.inverted, part.bad, part.counts, stop);
      };
    });
    for (const Found& part : found)
      for (const Index cell : part.inverted) add_bad(cell);
    for (const Found& part : found) {
      for (const FacetToTest& facet : part.bad) add_bad(facet);
      sphere_.effort().stages += part.counts;
    }
  }

  /// After a hole at the hull that cannot be filled: puts back the vertices of the hull, and those of all
  /// holes that reach it, as vertices close to a flat part of the hull may cross it in any order. Then the
  /// hull is as it was before. Finds the cells around these vertices that are bad now. If the vertices are
  /// not few, returns false and puts none back: moving them one by one takes tens of times as long as
  /// inserting them in a batch.
  template <class PutBack>
  bool release_hull(PutBack&& put_back) {
    constexpr std::size_t one_in = 32;
    vertices_.clear();
    is_put_back_.clear();
    const auto put_all = [&](Index cell) {
      for (int i = 0; i <= dimension(); ++i) {
        const Index v = cells_.vertex(cell, i);
        if (v >= is_put_back_.size()) is_put_back_.resize(2 * std::size_t{v} + 1, 0);
        if (v != index(infinite_vertex) && is_put_back_[v] == 0) vertices_.push_back(v);
        is_put_back_[v] = v != index(infinite_vertex);
      }
    };
    for (const Index seed : seeds_)
      if (geometry_.is_infinite(seed) && *bad_.find_value(seed) == is_bad) take(seed);
    collect();
    for (const Index cell : hole_) put_all(cell);
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell) && geometry_.is_infinite(cell)) put_all(cell);
    // A vertex has more cells than a cell has vertices.
    if (one_in * vertices_.size() > cells_.num_cells() / width()) return false;
    put_back(std::span<const Index>(vertices_));
    around_.clear();
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      if (cells_.is_vacant(cell)) continue;
      const std::uint32_t* const state = bad_.find_value(cell);
      bool is_around = state != nullptr && *state == is_in_hole;  // of the hole that was not filled
      for (int i = 0; i <= dimension(); ++i) {
        const Index v = cells_.vertex(cell, i);
        is_around |= v < is_put_back_.size() && is_put_back_[v] != 0;
      }
      if (!is_around) continue;
      around_.push_back(cell);
      if (state != nullptr) bad_.set(cell, is_new);
    }
    std::erase_if(seeds_, [&](Index cell) { return *bad_.find_value(cell) != is_bad; });
    around_set_.clear();
    for (std::size_t i = 0; i < around_.size(); i += batch_size) {
      internal::cancellation_point();
      const std::size_t count = std::min(batch_size, around_.size() - i);
      moved_cells_.renew({around_.data() + i, count}, [&](Index cell) {
        around_set_.insert(cell, 0);
        add_bad(cell);
      });
    }
    for (const Index cell : around_) {
      if (++calls_ % 1024 == 0) internal::cancellation_point();
      if (around_set_.contains(cell)) continue;
      for (int slot = 0; slot <= dimension(); ++slot)
        if (const FacetToTest facet = moved_cells_.facet_to(cell, cells_.neighbors(cell)[slot]);
            !is_locally_delaunay(facet))
          add_bad(facet);
    }
    return true;
  }

  /// All bad cells make one hole, so that it is filled or nothing changes. It may not reach the hull.
  bool fill_one_hole() {
    hole_.clear();
    for (const Index cell : seeds_) take(cell);
    return hole_.empty() || fill_hole(8 * width(), 1, false);
  }
  /// Bad cells that are neighbors make a hole.
  bool fill_holes() {
    // It takes time as the square of its size, and may take some per cent of what a rebuild takes.
    const auto share = static_cast<std::size_t>(3 * std::sqrt(static_cast<double>(cells_.num_cells())));
    const std::size_t most_cells = std::max(64 * width(), share);
    // Those at the hull first: they are the largest, and the likeliest to be too large.
    std::stable_partition(seeds_.begin(), seeds_.end(),
                          [&](Index cell) { return geometry_.is_infinite(cell); });
    for (const Index seed : seeds_) {
      if (*bad_.find_value(seed) != is_bad) continue;
      internal::cancellation_point();
      hole_.clear();
      take(seed);
      collect();
      if (!fill_hole(most_cells, 8, true)) return false;
      created_.insert(created_.end(), filler_.created().begin(), filler_.created().end());
      for (const Index cell : filler_.created())  // some in the slots of bad ones
        if (bad_.contains(cell)) bad_.set(cell, is_new);
    }
    return true;
  }
  /// Where no cells fit, the hole is made larger so many times. A large hole costs more than its vertices one
  /// by one.
  bool fill_hole(std::size_t most_cells, int most_rounds, bool may_reach_hull) {
    for (int round = 0;; ++round) {
      if (hole_.size() > most_cells) return false;
      if (!may_reach_hull &&
          std::any_of(hole_.begin(), hole_.end(), [&](Index cell) { return geometry_.is_infinite(cell); }))
        return false;
      around_.reserve(around_.size() + hole_.size());  // relocate() must not fail when cells have changed
      if (refill(sphere_, hole_, filler_)) break;
      if (round == most_rounds) return false;
      const std::size_t before = hole_.size();
      for (std::size_t i = 0; i < before; ++i)
        for (int slot = 0; slot <= dimension(); ++slot) take(cells_.neighbors(hole_[i])[slot]);
      collect();
    }
    return true;
  }
  /// Puts a cell into the hole, unless it is there.
  void take(Index cell) {
    if (const auto [state, is_unknown] = bad_.insert(cell, is_in_hole); !is_unknown) {
      if (state == is_in_hole) return;
      bad_.set(cell, is_in_hole);
    }
    hole_.push_back(cell);
  }
  /// Adds the bad cells that are next to those of the hole.
  void collect() {
    for (std::size_t i = 0; i < hole_.size(); ++i)
      for (int slot = 0; slot <= dimension(); ++slot) {
        const Index neighbor = cells_.neighbors(hole_[i])[slot];
        if (const std::uint32_t* const state = bad_.find_value(neighbor);
            state != nullptr && *state == is_bad)
          take(neighbor);
      }
  }

  /// Whether a point is in one finite cell and on the inner side of all infinite ones.
  template <class FindInside>
  bool covers_once(unsigned threads, FindInside&& find_inside) {
    const std::optional<Query> found = find_inside();
    if (!found) return false;
    const Query& q = *found;
    std::atomic<int> num_containing = 0;
    std::atomic<bool> is_certain = true;
    internal::for_parts(threads, cells_.num_slots(), slots_per_part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          stop();
                          const std::optional<int> count = count_containing(q, first, last);
                          if (count)
                            num_containing += *count;
                          else
                            is_certain = false;
                        });
    return is_certain && num_containing == 1;
  }
  /// How many of the cells in some slots contain q; nothing if it is on the border of one, or on the outer
  /// side of an infinite one. In a cell that contains q the functional is not positive: between the vertices
  /// the power of a point is at most the largest weight of a vertex, and that is at most the weight of q.
  std::optional<int> count_containing(const Query& q, std::size_t first, std::size_t last) const {
    const G& geometry = geometry_;
    const auto functional = geometry.evaluator(q);
    StageCounts uncounted;
    int count = 0;
    for (auto cell = static_cast<Index>(first); cell < last; ++cell) {
      if (cells_.is_vacant(cell) || functional.value(cell) > functional.threshold(cell)) continue;
      const auto vertices = cells_.vertices(cell);
      if (const int slot = cells_.infinite_slot(cell); slot >= 0) {
        if (geometry.exact_side(vertices, slot, q, uncounted) != Sign::positive) return std::nullopt;
        continue;
      }
      Sign least = Sign::positive;
      for (int i = 0; i <= dimension() && least != Sign::negative; ++i)
        least = std::min(least, geometry.side_of_facet(vertices, i, q));
      if (least == Sign::zero) return std::nullopt;
      count += least == Sign::positive ? 1 : 0;
    }
    return count;
  }

  Sphere<K, G>& sphere_;
  CellStore<K>& cells_;
  G& geometry_;
  HoleFiller<K, G>& filler_;
  MovedCells<K, G> moved_cells_;
  StarInPlane star_;
  struct None {};
  [[no_unique_address]] std::conditional_t<K == 2, EdgeFlips<G>, None> flips_;
  std::vector<Index> around_;  // the cells of a vertex
  std::vector<double> saved_;  // what was cached for the first num_saved_ of them
  std::size_t num_saved_ = 0;
  internal::StampedTable around_set_;  // the same
  internal::StampedTable bad_;         // the states of cells
  std::vector<Index> seeds_, hole_, created_;
  std::vector<Index> vertices_;            // that are put back …
  std::vector<std::uint8_t> is_put_back_;  // … the same, by id
  std::size_t calls_ = 0;
};

}  // namespace delone::engine
