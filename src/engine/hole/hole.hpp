// SPDX-License-Identifier: BSD-3-Clause
// A hole in the sphere: cells that go, the vertices around them, and the facets between them and the cells
// that stay.
#pragma once

#include "base/stamped_table.hpp"
#include "engine/cell_store.hpp"
#include "engine/conflict_zone.hpp"
#include "engine/geometry_concept.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::engine {

/// The vertices have numbers: the infinite one is 0, finite ones follow, and a vertex that goes with the
/// cells is the last. Memory is kept from hole to hole.
template <int K>
class Hole {
 public:
  /// A facet of the border: the vertex opposite it is in slot `slot` of the cell in the hole, which is number
  /// `inner`, and in slot `mirror` of the survivor.
  struct BorderFacet {
    Index survivor;
    std::uint32_t inner;
    int slot, mirror;
  };

  /// Marks the cells around vertex v, one of which is `cell`, and makes them the zone. v goes with them.
  /// Throws std::bad_alloc; then the zone tells what has been marked.
  template <class Geometry>
  void open_star(CellStore<K>& cells, const Geometry& geometry, Index v, Index cell, ConflictZone& zone) {
    begin(cells, zone);
    leaving_ = v;
    auto marks = cells.marks();
    const auto add = [&](Index next) {
      zone.reserve(1, width_);
      slots_.push_back(cells.slot_of_vertex(next, v));
      zone.cells[zone.num_cells++] = next;
      marks.set(next, Mark::in_conflict);
      cells.prefetch_neighbors(next);
      num_finite_ += geometry.is_infinite(next) ? 0 : 1;
    };
    add(cell);
    for (std::size_t i = 0; i < zone.num_cells; ++i) {
      const Index* const neighbors = cells.neighbors(zone.cells[i]);
      for (int slot = 0; slot < static_cast<int>(width_); ++slot)
        if (slot != slots_[i] && !marks.is_in_conflict(neighbors[slot])) add(neighbors[slot]);
    }
    number_vertices(cells, {zone.cells.data(), zone.num_cells});
    for (std::uint32_t i = 0; i < zone.num_cells; ++i) add_border(cells, zone.cells[i], i, slots_[i]);
  }

  /// Marks the given cells, which are different, and makes them the zone. All their vertices stay.
  template <class Geometry>
  void open_cells(CellStore<K>& cells, const Geometry& geometry, std::span<const Index> dead,
                  ConflictZone& zone) {
    begin(cells, zone);
    leaving_ = invalid_index;
    zone.reserve(dead.size(), width_);
    auto marks = cells.marks();
    for (const Index cell : dead) {
      zone.cells[zone.num_cells++] = cell;
      marks.set(cell, Mark::in_conflict);
      num_finite_ += geometry.is_infinite(cell) ? 0 : 1;
    }
    number_vertices(cells, dead);
    for (std::uint32_t i = 0; i < dead.size(); ++i)
      for (int slot = 0; slot < static_cast<int>(width_); ++slot)
        if (!marks.is_in_conflict(cells.neighbors(dead[i])[slot])) add_border(cells, dead[i], i, slot);
  }

  /// The vertex that goes, or invalid_index.
  Index leaving() const { return leaving_; }
  std::size_t num_cells() const { return numbers_of_cells_.size() / width_; }
  /// How many of the cells are finite.
  Index num_finite() const { return num_finite_; }
  /// The finite vertices that stay, in the order of their numbers, from 1 on.
  std::span<const Index> vertices() const { return std::span(ids_).subspan(1); }
  Index id(Index number) const { return number < ids_.size() ? ids_[number] : leaving_; }
  /// Whether a vertex stays and is one of the hole.
  bool has_vertex(Index id) const { return numbers_.contains(id); }
  /// REQUIRES that it has the vertex, or that this is the infinite one.
  Index number(Index id) const { return id == index(infinite_vertex) ? 0 : *numbers_.find_value(id); }
  std::span<const BorderFacet> border() const { return border_; }
  /// The numbers of the vertices of a cell of the hole.
  const Index* numbers_of_cell(std::size_t cell) const { return numbers_of_cells_.data() + cell * width_; }
  /// The slot of the vertex that goes in one of its cells.
  int slot_of_leaving(std::size_t cell) const { return slots_[cell]; }

  /// In the plane, around a vertex inside: the vertex where an edge of the border begins, seen
  /// counterclockwise, and all edges in the order in which they follow each other. Valid until the next.
  Index beginning(std::uint32_t edge) const requires(K == 2) { return end_of(edge, 1); }
  std::span<const std::uint32_t> cycle() requires(K == 2) {
    edge_at_.resize(ids_.size());
    for (std::uint32_t edge = 0; edge < border_.size(); ++edge) edge_at_[beginning(edge)] = edge;
    cycle_.clear();
    for (std::uint32_t edge = 0; cycle_.size() < border_.size(); edge = edge_at_[end_of(edge, 2)])
      cycle_.push_back(edge);
    return cycle_;
  }

  /// Whether new cells, k + 1 numbers of vertices each, have in common the facets that they are said to:
  /// `beside` tells for each of their facets the number of the same one, those of the border first.
  bool has_neighbors(std::span<const Index> cells, std::span<const std::uint32_t> beside) const {
    for (std::size_t at = 0; at < cells.size(); ++at) {
      const std::size_t other = beside[at], there = other - border_.size();
      if (other >= border_.size() && there > at) continue;  // seen from there
      const Index* const cell = cells.data() + at / width_ * width_;
      const Index* const neighbor = other < border_.size() ? numbers_of_cell(border_[other].inner)
                                                           : cells.data() + there / width_ * width_;
      for (std::size_t i = 0; i < width_; ++i)
        if (i != at % width_ && neighbor[i] != cell[i] &&  // most are in the same slots
            std::find(neighbor, neighbor + width_, cell[i]) == neighbor + width_)
          return false;
    }
    return true;
  }
  /// Whether new cells have all vertices that stay: they do not where vertices have met.
  bool all_are_in(std::span<const Index> cells) {
    is_met_.assign(ids_.size(), 0);
    for (const Index number : cells) is_met_[number] = 1;
    return std::find(is_met_.begin() + 1, is_met_.end(), 0) == is_met_.end();
  }

 private:
  /// Seen from the vertex that goes, an edge leads from the vertex in the next slot to that in the one after
  /// it.
  Index end_of(std::uint32_t edge, int slots) const {
    return numbers_of_cell(border_[edge].inner)[(border_[edge].slot + slots) % 3];
  }
  void begin(const CellStore<K>& cells, ConflictZone& zone) {
    width_ = static_cast<std::size_t>(cells.dimension()) + 1;
    zone.num_cells = zone.num_facets = zone.num_marked = zone.num_infinite = 0;
    zone.num_undecided = zone.num_open = 0;
    num_finite_ = 0;
    slots_.clear();
    border_.clear();
  }
  void number_vertices(const CellStore<K>& cells, std::span<const Index> dead) {
    numbers_.clear();
    ids_.assign(1, index(infinite_vertex));
    numbers_of_cells_.resize(dead.size() * width_);
    Index* number = numbers_of_cells_.data();
    for (const Index cell : dead) {
      const auto vertices = cells.vertices(cell);
      const Index* const v = vertices;
      for (std::size_t i = 0; i < width_; ++i, ++number)
        *number = v[i] == index(infinite_vertex) ? 0 : v[i] == leaving_ ? invalid_index : number_of(v[i]);
    }
    if (leaving_ == invalid_index) return;
    for (std::size_t cell = 0; cell < dead.size(); ++cell)
      numbers_of_cells_[cell * width_ + static_cast<std::size_t>(slots_[cell])] =
          static_cast<Index>(ids_.size());
  }
  Index number_of(Index v) {
    const auto [number, is_new] = numbers_.insert(v, static_cast<std::uint32_t>(ids_.size()));
    if (is_new) ids_.push_back(v);
    return number;
  }
  void add_border(const CellStore<K>& cells, Index dead, std::uint32_t inner, int slot) {
    const Index survivor = cells.neighbors(dead)[slot];
    border_.push_back({survivor, inner, slot, cells.slot_of_neighbor(survivor, dead)});
  }

  std::size_t width_ = 0;
  Index leaving_ = invalid_index, num_finite_ = 0;
  std::vector<int> slots_;          // of the vertex that goes, in its cells
  std::vector<Index> ids_;          // of the vertices, by number
  internal::StampedTable numbers_;  // by id
  std::vector<Index> numbers_of_cells_;
  std::vector<BorderFacet> border_;
  std::vector<std::uint8_t> is_met_;
  std::vector<std::uint32_t> edge_at_, cycle_;  // the edge that begins at a vertex
};

}  // namespace delone::engine
