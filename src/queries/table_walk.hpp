// SPDX-License-Identifier: BSD-3-Clause
// The visibility walk with the table of minors of each cell, for k = d ≤ 6: for one query, and for many at
// once.
#pragma once

#include "base/compiler.hpp"
#include "kernel/grid.hpp"
#include "kernel/stages.hpp"
#include "queries/barycentric.hpp"
#include "queries/cell_minors.hpp"
#include "queries/point_locator_impl.hpp"

#include <delone/point_locator.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace delone::queries {

/// k = d = K.
template <int K>
class TableWalk {
 public:
  explicit TableWalk(const PointLocator::Impl& where) : where_(where) {}

  /// Locates q, starting from a finite cell, any of them if `start` is invalid, and calls answer(found,
  /// complete). The coordinates may be too inaccurate until complete() is called. Returns false if the
  /// numbers are beyond the range of CellMinors.
  template <class Answer>
  bool locate(const double* q, CellId start, Answer answer) {
    LocatedPoint found;
    Walk walk;
    walk.q = q;
    walk.cell = start != invalid_cell ? start : any_cell();
    CellMinors<K> minors;
    while (load(walk)) {
      if (!minors.evaluate(walk.points, q)) return false;
      for (int i = 0; i <= K; ++i) weights_[i] = minors.weight(i);
      bound_ = minors.bound();
      const int slot = facet_with_query_beyond(walk.points, q);
      if (slot < 0) {
        finish(walk, found);
        answer(found, [&] { complete(walk, found); });
        return true;
      }
      walk.cell = where_.complex.neighbor(walk.cell, slot);
    }
    found = {Location::Kind::outside_hull, walk.cell, {}, 0};
    answer(found, [] {});
    return true;
  }

  /// Locates queries along several stretches of the list in turn, so that processors compute in one cell
  /// while they wait for the records of the next ones. The stretches are short and follow each other, so that
  /// all walks find most records in the cache. Calls answer(query, found, complete) for each, as locate();
  /// where the numbers are beyond the range of CellMinors, found is the result of beyond_range(q, cell,
  /// found). Returns a finite cell near one of the last queries.
  template <class Answer, class BeyondRange>
  CellId locate_all(const double* coordinates, std::span<const Index> queries, CellId start, Answer answer,
                    BeyondRange beyond_range) {
    Walk walks[num_walks];
    std::size_t active = 0, begun = 0;
    // The cell of the first query of the stretch begun last, of those where it is known.
    CellId near = start != invalid_cell ? start : any_cell();
    LocatedPoint found;
    const auto go_on = [&](Walk& walk) {
      if (walk.next++ == walk.first) near = walk.cell;
    };
    // Goes on to the next query of a walk that needs the minors of its cell; false after the last query.
    const auto prepare = [&](Walk& walk) {
      for (;;) {
        if (walk.next == walk.end) {
          if (begun == queries.size()) return false;
          walk.first = walk.next = begun;
          walk.end = begun = std::min(begun + stretch, queries.size());
          walk.cell = near;
        }
        walk.q = coordinates + static_cast<std::size_t>(queries[walk.next]) * K;
        if (load(walk)) return true;
        found = {Location::Kind::outside_hull, walk.cell, {}, 0};
        answer(queries[walk.next], found, [] {});
        walk.cell = where_.complex.neighbor(walk.cell, where_.complex.infinite_index(walk.cell));
        go_on(walk);
      }
    };
    while (active < num_walks && prepare(walks[active])) ++active;
    CellMinors<K, TwoNumbers> minors;
    while (active > 0) {
      for (std::size_t w = 0; w < active; w += 2) {
        Walk* const pair[2] = {&walks[w], &walks[std::min(w + 1, active - 1)]};
        minors.evaluate([&](int j, int c) {
          const TwoNumbers p{pair[0]->points[j][c], pair[1]->points[j][c]};
          return p - TwoNumbers{pair[0]->q[c], pair[1]->q[c]};
        });
        for (std::size_t lane = 0; lane < 2 && w + lane < active; ++lane) {
          Walk& walk = *pair[lane];
          for (int i = 0; i <= K; ++i) weights_[i] = minors.weight(i)[lane];
          bound_ = minors.bound()[lane];
          const bool is_in_range = bound_ <= std::numeric_limits<double>::max();
          const int slot = is_in_range ? facet_with_query_beyond(walk.points, walk.q) : -1;
          if (slot >= 0) {
            walk.cell = where_.complex.neighbor(walk.cell, slot);
            where_.complex.prefetch(walk.cell);
            continue;
          }
          if (is_in_range)
            finish(walk, found);
          else
            beyond_range(walk.q, walk.cell, found);
          answer(queries[walk.next], found, [&] {
            if (is_in_range) complete(walk, found);
          });
          go_on(walk);
        }
      }
      for (std::size_t w = 0; w < active;)
        if (prepare(walks[w]))
          ++w;
        else
          walks[w] = walks[--active];
    }
    return near;
  }

  /// For fewer queries locate_all() saves nothing.
  static constexpr std::size_t least_many = 64;

 private:
  static constexpr std::size_t num_walks = 8, stretch = 64;

  struct Walk {
    const double* q;
    const double* points[K + 1];  // of the cell
    CellId cell;
    std::size_t first = 0, next = 0, end = 0;  // places of a stretch of queries, and of the one to come
  };

  CellId any_cell() const { return *where_.complex.finite_cells().begin(); }

  /// Sets the points of the cell. Returns false if it is infinite.
  bool load(Walk& walk) const {
    const VerticesOfCell vertices = where_.complex.vertices(walk.cell);
    bool is_finite = true;
    for (std::size_t i = 0; i <= K; ++i) {
      const VertexId v = vertices[i];
      is_finite = is_finite && v != infinite_vertex;
      walk.points[i] = where_.point(v);
      internal::prefetch(walk.points[i]);
    }
    return is_finite;
  }

  /// A facet with q strictly beyond it, certain ones first; −1 if there is none, and then signs_ is exact.
  int facet_with_query_beyond(const double* const* points, const double* q) {
    double smallest = weights_[0];
    for (int i = 1; i <= K; ++i) smallest = std::min(smallest, weights_[i]);
    if (smallest < -bound_) {  // without a branch per facet, which would be unpredictable
      unsigned equal = 0;
      for (int i = 0; i <= K; ++i) equal |= static_cast<unsigned>(weights_[i] == smallest) << i;
      return std::countr_zero(equal);
    }
    num_positive_ = K + 1;
    for (int i = 0; i <= K; ++i) signs_[i] = Sign::positive;
    if (smallest > bound_) return -1;
    for (int i = 0; i <= K; ++i) grid_.include(points[i]);
    grid_.include(q);
    for (int i = 0; i <= K; ++i) {
      if (weights_[i] > bound_) continue;
      const double* moved[K + 1];
      std::copy_n(points, K + 1, moved);
      moved[i] = q;
      signs_[i] = kernel::orientation<K>(kernel::Flat{K, where_.axes}, moved, grid_);
      if (signs_[i] == Sign::negative) return i;
      if (signs_[i] == Sign::zero) --num_positive_;
    }
    return -1;
  }

  /// Each coordinate is off by at most the bound, and so is each one that is left out as zero or negative;
  /// their sum is off by at most K+1 times the bound. If that is too much, complete() solves the system of
  /// the cell.
  void finish(const Walk& walk, LocatedPoint& found) {
    found.kind = num_positive_ > K    ? Location::Kind::in_cell
                 : num_positive_ == 1 ? Location::Kind::on_vertex
                                      : Location::Kind::on_face;
    found.cell = walk.cell;
    found.distance = 0;
    found.barycentric = std::span<const double>(weights_, K + 1);
    double sum = 0;
    for (int i = 0; i <= K; ++i) {
      weights_[i] = signs_[i] == Sign::zero ? 0 : std::max(weights_[i], 0.0);
      sum += weights_[i];
    }
    is_accurate_ = (K + 3) * bound_ < largest_weight_error * sum;
    if (!is_accurate_) sum = 1;
    for (int i = 0; i <= K; ++i)
      if (signs_[i] == Sign::positive)
        weights_[i] = std::max(weights_[i] / sum, std::numeric_limits<double>::min());
  }
  void complete(const Walk& walk, LocatedPoint& found) {
    if (is_accurate_) return;
    unsigned char on_face[K + 1];
    for (int i = 0; i <= K; ++i) on_face[i] = signs_[i] == Sign::zero ? 0 : 1;
    barycentric({walk.points, K + 1}, on_face, where_.axes, walk.q, solved_);
    found.barycentric = solved_;
  }

  const PointLocator::Impl& where_;
  kernel::Grid grid_{K};  // of all points compared exactly so far
  Sign signs_[K + 1];
  int num_positive_ = 0;
  bool is_accurate_ = false;
  double weights_[K + 1], bound_ = 0;
  std::vector<double> solved_;
};

}  // namespace delone::queries
