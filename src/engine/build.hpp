// SPDX-License-Identifier: BSD-3-Clause
// The incremental construction of Delaunay triangulations and convex hulls: read this file first. Sections
// are those of the report whose algorithm it is (Hornus, Boissonnat, RR-6743, 2008,
// https://hal.inria.fr/inria-00343188).
//
// The cells triangulate a sphere, thanks to the infinite vertex, so no step has special cases at the hull; of
// a convex hull they are the boundary, which is a sphere too. Vertices are indices. Whether a cell is in
// conflict with a point is asked of the geometry (geometry_concept.hpp). Other ways to cells: wrapping
// (wrap/wrap.hpp) in many dimensions, and filling holes (hole/) when vertices are removed or move.
#pragma once

#include "engine/dimension_jump.hpp"
#include "engine/restore.hpp"
#include "engine/seed.hpp"
#include "engine/sphere.hpp"

namespace delone::engine {

template <int K, Geometry G>
class Build : public Sphere<K, G> {
 public:
  using typename Sphere<K, G>::Query;
  using Sphere<K, G>::Sphere;

  /// The first sphere (§2.3, case a): the boundary of the simplex of k+1 vertices and `last`.
  void seed(std::span<const Index> vertices, Index last = index(infinite_vertex)) {
    engine::seed(cells_, geometry_, vertices, last);
    this->starts_with(this->count_infinite(), cells_.num_cells());
  }

  /// The first sphere from one of dimension k−1 and a vertex q outside its affine hull (§2.3, case b; §2.4).
  void jump(const Complex& old, Index q, bool q_is_positive) {
    engine::jump(old, cells_, geometry_, q, q_is_positive);
    this->starts_with(this->count_infinite(), cells_.num_cells());
  }

  /// The first sphere from one of the same vertices. Cells keep their ids if `old` has no vacant slots.
  void restore(const Complex& old) {
    engine::restore(old, cells_, geometry_);
    this->starts_with(this->count_infinite(), 0);
  }

  /// The loop (§2.2), in the order of §3.1; in several threads once there are enough cells for them.
  void insert_all(const Batch& batch) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (this->has_work_for_threads(batch, i)) return this->insert_in_threads(batch, i);
      batch.at[i] = insert(batch.vertex(i));
      batch.note_strictly(i, work_.is_strictly_hidden);
      if (batch.tick) batch.tick(i + 1);
    }
  }

  /// Inserts vertex v (§2.3, case c), walking from a cell `start` or from near the last insertion. Returns v;
  /// or the vertex that is at its point already; or invalid_index if no cell is in conflict with v, which is
  /// hidden. Strong guarantee. REQUIRES that v is in the affine hull of the vertices.
  Index insert(Index v, Index start = invalid_index) {
    const Query q = geometry_.query_at(v);
    const WalkResult found = this->walk_to(q, start);  // §2.5
    if (found.vertex != invalid_index || found.hidden) return found.vertex;
    this->replace_zone(  // §2.6
        [&] {
          find_conflict_zone(cells_, geometry_, q, found.cell, cells_.marks(), work_.zone, effort_.stages);
        },
        [&] {
          log_.reserve_new(work_.zone.num_facets);
          const Filling star = retriangulate(cells_, geometry_, v, q, work_);
          log_.note_new(work_.star());
          return star;
        });
    return v;
  }

 private:
  using Sphere<K, G>::cells_, Sphere<K, G>::geometry_, Sphere<K, G>::work_, Sphere<K, G>::effort_,
      Sphere<K, G>::log_;
};

}  // namespace delone::engine
