// SPDX-License-Identifier: BSD-3-Clause
// Changes of neighbors in a periodic set. After a step that was repaired, edges at points whose vertices are
// the same are compared by ids (triangulation/changed_edges.hpp): all cells at them are cells of the whole
// set, before and after. Edges at other points, such as those that cross the border, are compared as pairs.
#include <delone/neighbor_changes.hpp>

#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "periodic/stored_set.hpp"
#include "triangulation/changed_edges.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace delone {

namespace {

using periodic::GhostTriangulation;
using periodic::PeriodicSet;
using triangulation::Edge;

/// Two rows, and the number of the offset of the second point in terms of given points and lattice.
struct Pair {
  std::uint32_t i, j, offset;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// Numbers for offsets; 0 stands for the offset of zeros.
class OffsetNumbers {
 public:
  explicit OffsetNumbers(std::size_t rank) { number(std::vector<std::int64_t>(rank, 0)); }

  std::uint32_t number(const std::vector<std::int64_t>& offset) {
    const auto [found, is_new] = numbers_.try_emplace(offset, static_cast<std::uint32_t>(offsets_.size()));
    if (is_new) offsets_.push_back(offset);
    return found->second;
  }
  const std::vector<std::int64_t>& offset(std::uint32_t number) const { return offsets_[number]; }

 private:
  std::map<std::vector<std::int64_t>, std::uint32_t> numbers_;
  std::vector<std::vector<std::int64_t>> offsets_;
};

class PeriodicNeighborChanges {
 public:
  PeriodicNeighborChanges(const PeriodicTriangulation& before, const PeriodicTriangulation& after)
      : set_before_(periodic::StoredSet::set(before)),
        set_after_(periodic::StoredSet::set(after)),
        before_(periodic::StoredSet::ghosts(before)),
        after_(periodic::StoredSet::ghosts(after)),
        n_(set_after_.num_points()),
        r_(set_after_.rank),
        is_stable_(n_, 0),
        numbers_(r_) {
    find_periods();
    if (after_.comes_from(before_)) find_stable();
  }

  NeighborChanges find() {
    std::vector<Pair> of_before, of_after;
    add_all_at_others(before_, set_before_, of_before);
    add_all_at_others(after_, set_after_, of_after);
    for (Pair& pair : of_after) pair = to_before(pair);
    triangulation::sort_unique(of_before);
    triangulation::sort_unique(of_after);
    std::vector<Pair> ended = triangulation::difference(of_before, of_after),
                      began = triangulation::difference(of_after, of_before);
    for (Pair& pair : began) pair = to_after(pair);
    if (after_.comes_from(before_)) {
      const triangulation::ChangedEdges edges = triangulation::find_changed_edges(
          before_.triangulation().complex(), after_.triangulation().complex());
      add_between_stable(edges.ended, before_, set_before_, ended);
      add_between_stable(edges.began, after_, set_after_, began);
    }
    NeighborChanges changes;
    changes.rank = static_cast<int>(r_);
    take(ended, changes.ended, changes.ended_offsets);
    take(began, changes.began, changes.began_offsets);
    return changes;
  }

 private:
  /// For each row by how many of the given lattice vectors its given point differs from the translate that is
  /// nearest to where the point was before.
  void find_periods() {
    periods_.resize(n_ * r_);
    const bool is_same_basis = set_before_.sums == set_after_.sums;
    std::vector<std::int64_t> nearest(r_);
    std::vector<std::int32_t> given(r_), wraps_before(r_), wraps_after(r_);
    internal::QuickRounds round;
    for (std::size_t row = 0; row < n_; ++row) {
      round();
      std::fill(given.begin(), given.end(), 0);
      if (is_same_basis) {
        for (std::size_t i = 0; i < r_; ++i)
          nearest[i] =
              static_cast<std::int64_t>(std::nearbyint(set_before_.period.fraction(i, set_before_.row(row)) -
                                                       set_after_.period.fraction(i, set_after_.row(row))));
        set_after_.to_given_basis(nearest, given.data());
      } else {
        for (std::size_t l = 0; l < r_; ++l) {
          double apart = 0;
          for (std::size_t i = 0; i < r_; ++i)
            apart += set_before_.period.fraction(i, set_before_.row(row)) *
                         static_cast<double>(set_before_.sums[i * r_ + l]) -
                     set_after_.period.fraction(i, set_after_.row(row)) *
                         static_cast<double>(set_after_.sums[i * r_ + l]);
          given[l] = static_cast<std::int32_t>(std::nearbyint(apart));
        }
      }
      given_wraps(set_before_, row, wraps_before);
      given_wraps(set_after_, row, wraps_after);
      for (std::size_t l = 0; l < r_; ++l)
        periods_[row * r_ + l] = std::int64_t{wraps_after[l]} - wraps_before[l] - given[l];
    }
  }
  void given_wraps(const PeriodicSet& set, std::size_t row, std::vector<std::int32_t>& given) const {
    const std::vector<std::int64_t> wraps(set.wraps.begin() + static_cast<std::ptrdiff_t>(row * r_),
                                          set.wraps.begin() + static_cast<std::ptrdiff_t>((row + 1) * r_));
    set.to_given_basis(wraps, given.data());
  }

  /// The rows of points whose vertices, and images, have the same ids and rows in both.
  void find_stable() {
    for (std::size_t row = 0; row < n_; ++row) {
      const VertexId v = before_.id_of_row(row);
      is_stable_[row] = v == after_.id_of_row(row) ? 1 : 0;
    }
    const std::size_t slots = std::min(before_.num_ids(), after_.num_ids());
    for (std::size_t id = 1; id < slots; ++id) {
      const VertexId v{static_cast<Index>(id)};
      const std::uint32_t a = before_.image_of(v).row, b = after_.image_of(v).row;
      if (a == b) continue;
      for (const std::uint32_t row : {a, b})
        if (row < n_) is_stable_[row] = 0;
    }
  }

  /// The pair with its ends exchanged where the first row is the larger one, or, of one row twice, where the
  /// first number of the offset that is not 0 is negative.
  Pair pair_of(const GhostTriangulation& ghosts, const PeriodicSet& set, VertexId own, VertexId v) {
    std::uint32_t i = ghosts.image_of(own).row, j = ghosts.image_of(v).row;
    const auto of_v = ghosts.offset_of(v);
    std::vector<std::int64_t>& offset = offset_;
    offset.resize(r_);
    bool is_zero = true;
    for (std::size_t l = 0; l < r_; ++l) {
      offset[l] = std::int64_t{of_v[l]} - set.wraps[j * r_ + l] + set.wraps[i * r_ + l];
      is_zero = is_zero && offset[l] == 0;
    }
    if (is_zero) return i < j ? Pair{i, j, 0} : Pair{j, i, 0};
    given_.resize(r_);
    set.to_given_basis(offset, given_.data());
    const auto first = std::find_if(given_.begin(), given_.end(), [](std::int32_t k) { return k != 0; });
    const bool turns = i == j ? *first < 0 : i > j;
    if (turns) std::swap(i, j);
    for (std::size_t l = 0; l < r_; ++l) offset[l] = turns ? -std::int64_t{given_[l]} : given_[l];
    return {i, j, numbers_.number(offset)};
  }
  bool is_stable(const GhostTriangulation& ghosts, VertexId v) const {
    return is_stable_[ghosts.image_of(v).row] != 0;
  }
  /// The pairs of all edges at points that are not stable.
  void add_all_at_others(const GhostTriangulation& ghosts, const PeriodicSet& set, std::vector<Pair>& pairs) {
    triangulation::each_edge_at(
        ghosts.triangulation().complex(),
        [&](VertexId v) { return ghosts.is_own(v) && !is_stable(ghosts, v); },
        [&](VertexId v, VertexId w) { pairs.push_back(pair_of(ghosts, set, v, w)); });
  }
  /// The pairs of edges at points of the box, between stable points and their images.
  void add_between_stable(const std::vector<Edge>& edges, const GhostTriangulation& ghosts,
                          const PeriodicSet& set, std::vector<Pair>& pairs) {
    for (const auto& [v, w] : edges) {
      if (!is_stable(ghosts, v) || !is_stable(ghosts, w)) continue;
      if (ghosts.is_own(v))
        pairs.push_back(pair_of(ghosts, set, v, w));
      else if (ghosts.is_own(w))
        pairs.push_back(pair_of(ghosts, set, w, v));
    }
  }
  /// A pair of the triangulation after, in terms of the points before, and back.
  Pair to_before(const Pair& pair) { return translated(pair, 1); }
  Pair to_after(const Pair& pair) { return translated(pair, -1); }
  Pair translated(const Pair& pair, std::int64_t sign) {
    const std::int64_t *const of_i = periods_.data() + pair.i * r_, *const of_j =
                                                                        periods_.data() + pair.j * r_;
    if (std::equal(of_i, of_i + r_, of_j)) return pair;
    offset_ = numbers_.offset(pair.offset);
    for (std::size_t l = 0; l < r_; ++l) offset_[l] += sign * (of_j[l] - of_i[l]);
    return {pair.i, pair.j, numbers_.number(offset_)};
  }
  void take(std::vector<Pair>& pairs, std::vector<SignedIndex>& rows, std::vector<std::int32_t>& offsets) {
    triangulation::sort_unique(pairs);
    std::sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
      return a.i != b.i   ? a.i < b.i
             : a.j != b.j ? a.j < b.j
                          : numbers_.offset(a.offset) < numbers_.offset(b.offset);
    });
    for (const Pair& pair : pairs) {
      rows.push_back(static_cast<SignedIndex>(pair.i));
      rows.push_back(static_cast<SignedIndex>(pair.j));
      for (const std::int64_t k : numbers_.offset(pair.offset)) {
        if (k != static_cast<std::int32_t>(k))
          throw Error(Errc::unsupported, "offsets of neighbors do not fit into 32 bits");
        offsets.push_back(static_cast<std::int32_t>(k));
      }
    }
  }

  const PeriodicSet &set_before_, &set_after_;
  const GhostTriangulation &before_, &after_;
  const std::size_t n_, r_;
  std::vector<std::int64_t> periods_;    // n×r
  std::vector<std::uint8_t> is_stable_;  // by row
  OffsetNumbers numbers_;
  std::vector<std::int64_t> offset_;  // of a pair that is being made
  std::vector<std::int32_t> given_;   // the same
};

}  // namespace

NeighborChanges changed_neighbors(const PeriodicTriangulation& before, const PeriodicTriangulation& after,
                                  const Execution& how) {
  if (before.num_points() != after.num_points())
    throw Error(Errc::bad_dimension, std::to_string(after.num_points()) + " points, not " +
                                         std::to_string(before.num_points()) + " as before");
  if (before.rank() != after.rank() || before.dimension() != after.dimension())
    throw Error(Errc::bad_dimension, "a lattice of another rank or dimension than before");
  return internal::guarded("the pairs of neighbors", [&] {
    const internal::ProgressMeter meter(how.progress);
    return PeriodicNeighborChanges(before, after).find();
  });
}

}  // namespace delone
