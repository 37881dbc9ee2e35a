// SPDX-License-Identifier: BSD-3-Clause
// Vertices have moved a little: most cells around them are still Delaunay, and only their functionals are
// new. The others, and those next to them, are holes that are filled anew.
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

#include "base/progress_meter.hpp"
#include "engine/build.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace delone::engine {

/// Memory is kept from one use to the next.
template <int K, Geometry G>
class Settling {
  using Query = typename G::Query;

 public:
  Settling(Build<K, G>& build, HoleFiller<K, G>& filler)
      : build_(build), cells_(build.cells()), geometry_(build.geometry()), filler_(filler) {}

  /// After one vertex has moved, one of whose cells is `cell`. Returns false if it cannot stay where it is in
  /// the cells, as on the hull, or if many of them would change. Then no cell has changed, but the
  /// functionals of its cells are wrong.
  bool settle(Index v, Index cell) {
    made_ = {};
    if (!find_star(v, cell, false)) return false;
    if (!create_functionals(true)) return false;
    find_bad_cells();
    if (2 * seeds_.size() > around_.size()) return false;  // taking the vertex out costs no more
    if (!fill_one_hole()) return false;
    if (!hole_.empty()) made_ = filler_.created();
    return true;
  }
  /// After any vertices have moved. `find_inside` returns a query in the interior of the hull, or nothing.
  /// Returns false soon where much has changed.
  template <class FindInside>
  bool settle_all(FindInside&& find_inside) {
    created_.clear();
    std::vector<Index> all;
    all.reserve(cells_.num_cells());
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell)) all.push_back(cell);
    if (!is_promising(all)) return false;
    around_ = std::move(all);
    create_functionals(false);
    find_bad_cells();
    if (!fill_holes() || !covers_once(find_inside)) return false;
    made_ = created_;
    return true;
  }
  /// Computes anew what is cached for the cells of vertex v, one of which is `cell`.
  void renew(Index v, Index cell) noexcept {
    try {
      find_star(v, cell, true);
    } catch (const std::bad_alloc&) {
      build_.create_functionals();
      return;
    }
    for (const Index around : around_) create_functional(cells_, geometry_, around);
  }
  /// Cells that have been created; some may have gone again.
  std::span<const Index> created() const { return made_; }

 private:
  enum State : std::uint32_t { is_bad, is_in_hole, is_new };
  static constexpr std::size_t batch_size = 64;

  int dimension() const { return cells_.dimension(); }
  std::size_t width() const { return static_cast<std::size_t>(dimension()) + 1; }

  /// Returns false as soon as a cell of the star is infinite, if none may be.
  bool find_star(Index v, Index cell, bool may_be_infinite) {
    around_.clear();
    around_set_.clear();
    const auto add = [&](Index next) {
      if (!around_set_.insert(next, 0).second) return true;
      around_.push_back(next);
      cells_.prefetch_neighbors(next);
      return may_be_infinite || !geometry_.is_infinite(next);
    };
    if (!add(cell)) return false;
    for (std::size_t i = 0; i < around_.size(); ++i) {
      const int slot_of_v = cells_.slot_of_vertex(around_[i], v);
      for (int slot = 0; slot <= dimension(); ++slot)
        if (slot != slot_of_v && !add(cells_.neighbors(around_[i])[slot])) return false;
    }
    return true;
  }

  /// Computes what is cached for the cells, and notes those that are not positively oriented. Returns false
  /// if there are any, and none are wanted.
  bool create_functionals(bool only_positive) {
    bad_.clear();
    inverted_.clear();
    seeds_.clear();
    const auto judge = [&](Index cell, Sign orientation) {
      if (orientation == Sign::zero) {
        const auto vertices = cells_.vertices(cell);
        orientation = geometry_.orientation(vertices);
      }
      if (orientation == Sign::positive) return true;
      inverted_.insert(cell, 0);
      add_bad(cell);
      return false;
    };
    const std::size_t width = this->width();
    std::array<Index, batch_size> batch;
    std::array<Sign, batch_size> orientations;
    rows_.resize(batch_size * width * width);
    if (simplices_.size() != batch_size || numbers_.size() != batch_size * width) {
      numbers_.resize(batch_size * width);
      std::iota(numbers_.begin(), numbers_.end(), Index{0});
      simplices_.clear();
      for (std::size_t i = 0; i < batch_size; ++i) simplices_.push_back(numbers_.data() + i * width);
    }
    std::size_t count = 0;
    const auto create_batch = [&] {
      geometry_.create_from_rows({batch.data(), count}, {simplices_.data(), count}, rows_.data(),
                                 orientations.data());
      bool are_positive = true;
      for (std::size_t i = 0; i < count; ++i) {
        if (orientations[i] == Sign::zero) {
          const auto vertices = cells_.vertices(batch[i]);
          orientations[i] = geometry_.create(batch[i], vertices, -1, 0);
        }
        are_positive = judge(batch[i], orientations[i]) && are_positive;
      }
      count = 0;
      return are_positive;
    };
    for (const Index cell : around_) {
      if (++calls_ % 1024 == 0) internal::cancellation_point();
      const auto vertices = cells_.vertices(cell);
      const Index* const v = vertices;
      if (geometry_.is_infinite(cell)) {
        const int infinite_slot = cells_.infinite_slot(cell);
        geometry_.create(cell, v, infinite_slot, infinite_slot == 0 ? 1 : 0);
        continue;
      }
      double* row = rows_.data() + count * width * width;
      for (std::size_t i = 0; i < width; ++i, row += width) geometry_.write_row_of(v[i], row);
      batch[count++] = cell;
      if (count == batch_size && !create_batch() && only_positive) return false;
    }
    return create_batch() || !only_positive;
  }
  /// Whether few of some cells, evenly spaced, are bad: else building anew costs less.
  bool is_promising(std::span<const Index> all) {
    constexpr std::size_t most = 1024, one_in = 8;
    around_.clear();
    for (std::size_t i = 0, step = all.size() / most + 1; i < all.size(); i += step)
      around_.push_back(all[i]);
    create_functionals(false);
    std::size_t num_bad = 0;
    for (const Index cell : around_) {
      bool is_good = !inverted_.contains(cell);
      for (int slot = 0; slot <= dimension() && is_good; ++slot)
        is_good = is_locally_delaunay(cell, cells_.neighbors(cell)[slot]);
      num_bad += is_good ? 0 : 1;
    }
    return num_bad * one_in <= around_.size();
  }
  void add_bad(Index cell) {
    if (bad_.insert(cell, is_bad).second) seeds_.push_back(cell);
  }

  /// The cells on both sides of facets where they are not locally Delaunay.
  void find_bad_cells() {
    for (const Index cell : around_) {
      if (++calls_ % 1024 == 0) internal::cancellation_point();
      for (int slot = 0; slot <= dimension(); ++slot) {
        const Index neighbor = cells_.neighbors(cell)[slot];
        const bool is_twin = is_around(neighbor);
        if (is_twin && neighbor < cell) continue;
        if (is_locally_delaunay(cell, neighbor)) continue;
        add_bad(cell);
        add_bad(neighbor);
      }
    }
  }
  bool is_around(Index cell) const {
    return around_.size() == cells_.num_cells() || around_set_.contains(cell);
  }

  bool is_locally_delaunay(Index cell, Index neighbor) {
    if (inverted_.size() != 0 && inverted_.contains(cell)) std::swap(cell, neighbor);
    const Index apex = cells_.vertex(neighbor, cells_.slot_of_neighbor(neighbor, cell));
    if (apex == index(infinite_vertex)) return true;
    const double value = geometry_.value_at(cell, apex);
    if (std::fabs(value) > geometry_.threshold(cell)) [[likely]]
      return value > 0;
    if (inverted_.size() != 0 && inverted_.contains(cell)) return false;
    return is_outside_exactly(cells_, geometry_, cell, apex, build_.effort().stages);
  }

  /// All bad cells make one hole, so that it is filled or nothing changes. It may not reach the hull.
  bool fill_one_hole() {
    hole_.clear();
    for (const Index cell : seeds_) take(cell);
    return hole_.empty() || fill_hole(8 * width(), 1, false);
  }
  /// Bad cells that are neighbors make a hole.
  bool fill_holes() {
    for (const Index seed : seeds_) {
      if (*bad_.find_value(seed) != is_bad) continue;
      internal::cancellation_point();
      hole_.clear();
      take(seed);
      collect();
      if (!fill_hole(64 * width(), 4, true)) return false;
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
      if (build_.refill(hole_, filler_)) break;
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
  bool covers_once(FindInside&& find_inside) {
    const std::optional<Query> found = find_inside();
    if (!found) return false;
    const Query& q = *found;
    const auto functional = geometry_.evaluator(q);
    int containing = 0;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      if (cells_.is_vacant(cell) || functional.value(cell) > functional.threshold(cell)) continue;
      const auto vertices = cells_.vertices(cell);
      if (const int slot = cells_.infinite_slot(cell); slot >= 0) {
        if (geometry_.exact_side(vertices, slot, q, build_.effort().stages) != Sign::positive) return false;
        continue;
      }
      Sign least = Sign::positive;
      for (int i = 0; i <= dimension() && least != Sign::negative; ++i)
        least = std::min(least, geometry_.side_of_facet(vertices, i, q));
      if (least == Sign::zero) return false;
      containing += least == Sign::positive ? 1 : 0;
    }
    return containing == 1;
  }

  Build<K, G>& build_;
  CellStore<K>& cells_;
  G& geometry_;
  HoleFiller<K, G>& filler_;
  std::vector<Index> around_;          // the cells of moved vertices
  internal::StampedTable around_set_;  // the same, unless they are all
  internal::StampedTable bad_;         // the states of cells
  internal::StampedTable inverted_;    // not positively oriented
  std::vector<Index> seeds_, hole_, created_;
  std::span<const Index> made_;
  // Of a batch: the vertices of its cells have numbers one after the other.
  std::vector<double> rows_;
  std::vector<Index> numbers_;
  std::vector<const Index*> simplices_;
  std::size_t calls_ = 0;
};

}  // namespace delone::engine
