// SPDX-License-Identifier: BSD-3-Clause
// Makes triangles of the plane Delaunay again after a vertex has moved: an edge that is not locally Delaunay
// is exchanged for the other diagonal of its two triangles, until all are (Lawson 1977). Two positively
// oriented triangles of such an edge make a strictly convex quadrilateral, so the new ones are positively
// oriented, too. Cells keep their slots.
#pragma once

#include "base/progress_meter.hpp"
#include "engine/hole/moved_cells.hpp"
#include "engine/sphere.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace delone::engine {

/// Memory is kept from one use to the next.
template <Geometry G>
class EdgeFlips {
 public:
  void begin() {
    open_.clear();
    flips_.clear();
    flipped_.clear();
  }
  /// Adds an edge that is not locally Delaunay: that of a cell opposite the vertex in a slot.
  void add(Index cell, int slot) { open_.push_back({cell, slot}); }
  bool is_empty() const { return open_.empty(); }

  /// Flips until all edges are locally Delaunay, on record. Returns false if that takes more than `most`
  /// flips. Then, and after an exception, all cells are as they were. REQUIRES cells that are positively
  /// oriented, with their functionals, and that no edge is bad but those that were added.
  bool run(Sphere<2, G>& sphere, MovedCells<2, G>& moved_cells, std::size_t most) {
    try {
      while (!open_.empty()) {
        const Edge edge = open_.back();
        open_.pop_back();
        const FacetToTest facet =
            moved_cells.facet_to(edge.cell, sphere.cells().neighbors(edge.cell)[edge.slot]);
        if (facet.apex == index(infinite_vertex) ||
            moved_cells.is_locally_delaunay(facet, sphere.effort().stages))
          continue;
        if (flips_.size() == most) {
          take_back(sphere);
          return false;
        }
        if (flips_.size() % 1024 == 1023) internal::cancellation_point();
        flip(sphere, edge, facet.neighbor);
      }
    } catch (...) {
      take_back(sphere);
      throw;
    }
    sphere.log().note_new(std::span<const Index>(flipped_));
    sphere.effort().created_cells += flipped_.size();
    return true;
  }
  /// The cells of the last run that have changed, perhaps more than once.
  std::span<const Index> flipped() const { return flipped_; }

 private:
  struct Edge {
    Index cell;
    int slot;
  };
  /// Of two cells (p, a, b) and (q, b, a), the one of p and the one of q, and the slots of these. Afterwards
  /// they are (p, a, q) and (q, b, p).
  struct Flip {
    Index cell, other;
    int slot, other_slot;
    std::array<double, 4> functional, other_functional;  // what was cached before
  };
  static int after(int slot) { return slot == 2 ? 0 : slot + 1; }
  static int before(int slot) { return slot == 0 ? 2 : slot - 1; }
  /// Makes `now` the neighbor of a cell that `was` has been.
  static void relink(CellStore<2>& cells, Index cell, Index was, Index now) {
    cells.neighbors(cell)[cells.slot_of_neighbor(cell, was)] = now;
  }

  void flip(Sphere<2, G>& sphere, const Edge& edge, Index other) {
    CellStore<2>& cells = sphere.cells();
    G& geometry = sphere.geometry();
    const int p = edge.slot, q = cells.slot_of_neighbor(other, edge.cell);
    const std::array<Index, 2> dying{edge.cell, other};
    flips_.push_back({edge.cell, other, p, q, {}, {}});
    Flip& made = flips_.back();
    try {
      geometry.save(edge.cell, made.functional.data());
      geometry.save(other, made.other_functional.data());
      open_.reserve(open_.size() + 4);
      flipped_.reserve(flipped_.size() + 2);
      sphere.log().reserve_new(2 * flips_.size());
      sphere.log().note(cells, dying);
    } catch (...) {
      flips_.pop_back();
      throw;
    }
    const Index beyond_a = cells.neighbors(edge.cell)[after(p)], beyond_b = cells.neighbors(other)[after(q)];
    cells.set_vertex(edge.cell, before(p), cells.vertex(other, q));
    cells.set_vertex(other, before(q), cells.vertex(edge.cell, p));
    cells.neighbors(edge.cell)[p] = beyond_b;
    cells.neighbors(edge.cell)[after(p)] = other;
    cells.neighbors(other)[q] = beyond_a;
    cells.neighbors(other)[after(q)] = edge.cell;
    relink(cells, beyond_a, edge.cell, other);
    relink(cells, beyond_b, other, edge.cell);
    for (const Index cell : dying) {
      geometry.create(cell, cells.vertices(cell), -1, 0);
      flipped_.push_back(cell);
    }
    open_.push_back({edge.cell, p});
    open_.push_back({edge.cell, before(p)});
    open_.push_back({other, q});
    open_.push_back({other, before(q)});
  }

  void take_back(Sphere<2, G>& sphere) noexcept {
    CellStore<2>& cells = sphere.cells();
    for (; !flips_.empty(); flips_.pop_back()) {
      const Flip& made = flips_.back();
      const Index cell = made.cell, other = made.other;
      const int p = made.slot, q = made.other_slot;
      const Index beyond_a = cells.neighbors(other)[q], beyond_b = cells.neighbors(cell)[p];
      cells.set_vertex(cell, before(p), cells.vertex(other, after(q)));
      cells.set_vertex(other, before(q), cells.vertex(cell, after(p)));
      cells.neighbors(cell)[p] = other;
      cells.neighbors(cell)[after(p)] = beyond_a;
      cells.neighbors(other)[q] = cell;
      cells.neighbors(other)[after(q)] = beyond_b;
      relink(cells, beyond_a, other, cell);
      relink(cells, beyond_b, cell, other);
      sphere.geometry().put_back(cell, made.functional.data());
      sphere.geometry().put_back(other, made.other_functional.data());
    }
  }

  std::vector<Edge> open_;
  std::vector<Flip> flips_;
  std::vector<Index> flipped_;
};

}  // namespace delone::engine
