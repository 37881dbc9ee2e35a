// SPDX-License-Identifier: BSD-3-Clause
// The incremental construction of Delaunay triangulations and convex hulls: read this file first. Sections
// are those of the report whose algorithm it is (Hornus, Boissonnat, RR-6743, 2008,
// https://hal.inria.fr/inria-00343188).
//
// The cells triangulate a sphere, thanks to the infinite vertex, so no step has special cases at the hull; of
// a convex hull they are the boundary, which is a sphere too. Vertices are indices. Whether a cell is in
// conflict with a point is asked of the geometry (geometry_concept.hpp).
#pragma once

#include "engine/dimension_jump.hpp"
#include "engine/hole/hole_filler.hpp"
#include "engine/hole/removal.hpp"
#include "engine/locate.hpp"
#include "engine/parallel_insertion.hpp"
#include "engine/restore.hpp"
#include "engine/retriangulate.hpp"
#include "engine/seed.hpp"
#include "engine/sphere.hpp"
#include "engine/wrap/wrap.hpp"

#include <functional>
#include <optional>

namespace delone::engine {

template <int K, Geometry G>
class Build : public Sphere<K, G> {
 public:
  using typename Sphere<K, G>::Query;
  using Sphere<K, G>::Sphere;

  /// The first sphere (§2.3, case a): the boundary of the simplex of k+1 vertices and `last`.
  void seed(std::span<const Index> vertices, Index last = index(infinite_vertex)) {
    engine::seed(cells_, geometry_, vertices, last);
    starts_with(count_infinite(), cells_.num_cells());
  }

  /// The first sphere from one of dimension k−1 and a vertex q outside its affine hull (§2.3, case b; §2.4).
  void jump(const Complex& old, Index q, bool q_is_positive) {
    engine::jump(old, cells_, geometry_, q, q_is_positive);
    starts_with(count_infinite(), cells_.num_cells());
  }

  /// The first sphere from one of the same vertices. Cells keep their ids if `old` has no vacant slots.
  void restore(const Complex& old) {
    engine::restore(old, cells_, geometry_);
    starts_with(count_infinite(), 0);
  }

  /// The loop (§2.2). `batch`: next() is a vertex, in the order of §3.1, or invalid_index after the last;
  /// placed(v, at, strictly) says what became of it, as insert() does; for certain hidden, if strictly.
  template <class Batch>
  void insert_all(Batch&& batch) {
    for (Index v = batch.next(); v != invalid_index; v = batch.next()) {
      const Index at = insert(v);
      batch.placed(v, at, work_.is_strictly_hidden);
    }
  }

  /// So few vertices have too few cells for several threads.
  static constexpr std::size_t few_vertices = K <= 4 ? 16 * K : K == 5 ? 150 : 200;
  /// Unless there are as many cells as so many vertices have if they are spread evenly.
  static constexpr std::size_t many_cells = K == 2   ? 64
                                            : K == 3 ? 300
                                            : K == 4 ? 1600
                                            : K == 5 ? 12000
                                                     : 60000;
  /// The same in several threads, once there are enough cells for them; in one thread where the geometry does
  /// not share its cells.
  void insert_all(const ParallelBatch& batch) {
    std::size_t done = 0;
    const std::size_t n = batch.at.size();
    const auto insert_until = [&](std::size_t end) {
      for (; done < end; ++done) {
        batch.at[done] = insert(batch.vertex(done));
        batch.note_strictly(done, work_.is_strictly_hidden);
        batch.tick(done + 1);
      }
    };
    if constexpr (K >= 2 && K <= 6 && requires { typename G::ForThread; }) {
      const std::size_t alone = geometry_.can_walk() ? std::min<std::size_t>(n, few_vertices) : n;
      while (done < alone && (alone == n || cells_.num_cells() < many_cells)) insert_until(done + 1);
      if (done < n) {
        work_.clear();
        ParallelInsertion<K, G>(insertion_parts(), batch).insert_from(done);
      }
    } else {
      insert_until(n);
    }
  }

  /// What insertions by several workers change.
  InsertionParts<K, G> insertion_parts() {
    return {memory_, cells_,        geometry_,      log_.is_on() ? &log_ : nullptr,
            effort_, num_infinite_, work_.last_cell};
  }

  /// Inserts vertex v (§2.3, case c), walking from a cell `start` or from near the last insertion. Returns v;
  /// or the vertex that is at its point already; or invalid_index if no cell is in conflict with v, which is
  /// hidden. Strong guarantee. REQUIRES that v is in the affine hull of the vertices.
  Index insert(Index v, Index start = invalid_index) {
    const Query q = geometry_.query_at(v);
    if (start == invalid_index) start = start_near(q);
    work_.clear();
    const WalkResult found = locate(cells_, geometry_, q, start, effort_.stages);  // §2.5
    effort_.visited_cells += found.visited;
    work_.last_cell = found.cell;
    work_.is_strictly_hidden = found.strictly;
    if (found.vertex != invalid_index || found.hidden) return found.vertex;
    try {
      find_conflict_zone(cells_, geometry_, q, found.cell, cells_.marks(), work_.zone, effort_.stages);
      replace_zone([&] {
        if (!log_.is_on()) return retriangulate(cells_, geometry_, v, q, work_);
        log_.reserve_new(work_.zone.num_facets);
        const Filling made = retriangulate(cells_, geometry_, v, q, work_);
        for (const HorizonFacet& facet : work_.star()) log_.note_new(facet.created);
        return made;
      });
    } catch (...) {
      abandon_zone();
      throw;
    }
    return v;
  }

  /// Removes vertex v, one of whose cells is `cell`. `filler`: of these cells and this geometry. Strong
  /// guarantee.
  Removal remove(Index v, Index cell, HoleFiller<K, G>& filler) {
    work_.clear();
    try {
      filler.hole().open_star(cells_, geometry_, v, cell, work_.zone);
      if (filler.is_flat_without_leaving(work_.zone, cells_.num_cells() - num_infinite_)) {
        abandon_zone();
        return Removal::flat;
      }
      note_zone();
      if (const std::optional<Filling> made = fill_hole(filler)) {
        adopt(*made);
        return Removal::taken_out;
      }
    } catch (...) {
      abandon_zone();
      throw;
    }
    abandon_zone();
    return Removal::large;
  }

  /// Replaces cells, which are different, by the Delaunay cells of their vertices, after these have moved.
  /// Returns false, and nothing has changed, if no such cells fit their place (HoleFiller::fill()). Strong
  /// guarantee.
  bool refill(std::span<const Index> dead, HoleFiller<K, G>& filler) {
    work_.clear();
    bool is_filled = false;
    try {
      filler.hole().open_cells(cells_, geometry_, dead, work_.zone);
      if (log_.is_on()) log_.note(cells_, dead);
      if (const std::optional<Filling> made = fill_hole(filler)) {
        adopt(*made);
        is_filled = true;
      }
    } catch (...) {
      abandon_zone();
      throw;
    }
    if (!is_filled) abandon_zone();
    return is_filled;
  }

  /// Whether v is in conflict with no cell for certain, by cached functionals alone; false says nothing.
  bool is_surely_hidden(Index v) { return is_surely_hidden(v, work_.last_cell); }
  /// The same; walks from a cell, and sets it to where the walk has ended.
  bool is_surely_hidden(Index v, Index& cell) const {
    const Query q = geometry_.query_at(v);
    if (!geometry_.can_walk()) return false;
    const auto [outcome, near] = approach(cells_, geometry_, q, cell);
    cell = near.cell;
    return outcome == Descent::hidden;
  }

  /// The cells of the zone in the workspace give way to others that fill their place (§2.6): fill() makes
  /// them, and says which. Strong guarantee, if fill() gives it.
  template <class Fill>
  void replace_zone(Fill&& fill) {
    note_zone();
    adopt(fill());
  }

  /// Instead of the loop, for few vertices in many dimensions: each cell is created once (wrap/wrap.hpp).
  /// Returns false, and there are no cells, where that cannot be proved to be right.
  template <class Points>
  bool wrap(Points&& points, unsigned threads, const std::function<void(double)>& tick) {
    const std::optional<Index> num_infinite = wrap_all(cells_, points, threads, effort_.stages, tick);
    if (num_infinite) starts_with(*num_infinite, cells_.num_cells());
    return num_infinite.has_value();
  }

 private:
  using Sphere<K, G>::memory_;
  using Sphere<K, G>::cells_, Sphere<K, G>::geometry_, Sphere<K, G>::work_, Sphere<K, G>::effort_,
      Sphere<K, G>::num_infinite_, Sphere<K, G>::log_;
  void note_zone() {
    if (log_.is_on()) log_.note(cells_, {work_.zone.cells.data(), work_.zone.num_cells});
  }
  void adopt(const Filling& made) {
    effort_.created_cells += made.num_cells;
    num_infinite_ += made.num_infinite - static_cast<Index>(work_.zone.num_infinite);
    work_.last_cell = made.cell;
  }
  /// Fills the hole that is the zone, on record.
  std::optional<Filling> fill_hole(HoleFiller<K, G>& filler) {
    const std::optional<Filling> made = filler.fill(work_.zone, effort_.stages, [&](std::size_t count) {
      if (log_.is_on()) log_.reserve_new(count);
    });
    if (log_.is_on() && made)
      for (const Index created : filler.created()) log_.note_new(created);
    return made;
  }

  using Sphere<K, G>::start_near, Sphere<K, G>::starts_with, Sphere<K, G>::count_infinite,
      Sphere<K, G>::abandon_zone;
};

}  // namespace delone::engine
