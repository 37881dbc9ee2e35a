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
  /// `inner`, and `outside`, in slot `mirror`, of the survivor.
  struct BorderFacet {
    Index survivor;
    std::uint32_t inner;
    Index outside;
    std::uint16_t slot, mirror;
  };

  /// Marks the cells around vertex v, one of which is `cell`, and makes them the zone. v goes with them.
  /// Throws std::bad_alloc; then the zone tells what has been marked.
  template <class Geometry>
  void open_star(CellStore<K>& cells, const Geometry& geometry, Index v, Index cell, ConflictZone& zone) {
    begin(cells, zone);
    leaving_ = v;
    auto marks = cells.marks();
    const auto add = [&](Index next) {
      zone.reserve(1, width());
      zone.cells[zone.num_cells++] = next;
      marks.set(next, Mark::in_conflict);
      cells.prefetch_around(next);
      slots_.push_back(copy_vertices(cells, next, v));
    };
    add(cell);
    for (std::size_t i = 0; i < zone.num_cells; ++i) {
      const Index* const neighbors = cells.neighbors(zone.cells[i]);
      for (int slot = 0; slot < static_cast<int>(width()); ++slot)
        if (slot != slots_[i] && !marks.is_in_conflict(neighbors[slot])) add(neighbors[slot]);
      add_border(cells, zone.cells[i], static_cast<std::uint32_t>(i), slots_[i]);
    }
    number_vertices(geometry);
  }

  /// Marks the given cells, which are different, and makes them the zone. All their vertices stay.
  template <class Geometry>
  void open_cells(CellStore<K>& cells, const Geometry& geometry, std::span<const Index> dead,
                  ConflictZone& zone) {
    begin(cells, zone);
    leaving_ = invalid_index;
    zone.reserve(dead.size(), width());
    auto marks = cells.marks();
    for (const Index cell : dead) {
      zone.cells[zone.num_cells++] = cell;
      marks.set(cell, Mark::in_conflict);
      copy_vertices(cells, cell, invalid_index);
    }
    number_vertices(geometry);
    for (std::uint32_t i = 0; i < dead.size(); ++i)
      for (int slot = 0; slot < static_cast<int>(width()); ++slot)
        if (!marks.is_in_conflict(cells.neighbors(dead[i])[slot])) add_border(cells, dead[i], i, slot);
  }

  /// The vertex that goes, or invalid_index.
  Index leaving() const { return leaving_; }
  std::size_t num_cells() const { return numbers_of_cells_.size() / width(); }
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
  const Index* numbers_of_cell(std::size_t cell) const { return numbers_of_cells_.data() + cell * width(); }
  /// The slot of the vertex that goes in one of its cells.
  int slot_of_leaving(std::size_t cell) const { return slots_[cell]; }

 private:
  std::size_t width() const { return static_cast<std::size_t>(K > 0 ? K : dimension_) + 1; }
  void begin(const CellStore<K>& cells, ConflictZone& zone) {
    dimension_ = cells.dimension();
    zone.num_cells = zone.num_facets = zone.num_marked = zone.num_infinite = 0;
    zone.num_undecided = zone.num_open = 0;
    num_finite_ = 0;
    slots_.clear();
    numbers_of_cells_.clear();
    border_.clear();
  }
  /// Adds the vertices of a cell to the list, by their ids, and returns the slot of one of them.
  int copy_vertices(const CellStore<K>& cells, Index cell, Index v) {
    const std::size_t first = numbers_of_cells_.size();
    numbers_of_cells_.resize(first + width());
    Index* const ids = numbers_of_cells_.data() + first;
    const auto vertices = cells.vertices(cell);
    const Index* const ids_of_cell = vertices;
    int slot = 0;
    bool is_infinite = false;
    for (int i = 0; i < static_cast<int>(width()); ++i) {
      ids[i] = ids_of_cell[i];
      is_infinite |= ids[i] == index(infinite_vertex);
      slot |= i & -static_cast<int>(ids[i] == v);
    }
    num_finite_ += is_infinite ? 0 : 1;
    return slot;
  }
  /// Replaces ids by numbers.
  template <class Geometry>
  void number_vertices(const Geometry& geometry) {
    numbers_.clear(ids_.size());  // of the last hole
    ids_.assign(1, index(infinite_vertex));
    for (Index& v : numbers_of_cells_)
      v = v == index(infinite_vertex) ? 0 : v == leaving_ ? invalid_index : number_of(v, geometry);
    for (std::size_t cell = 0; cell < slots_.size(); ++cell)
      numbers_of_cells_[cell * width() + static_cast<std::size_t>(slots_[cell])] =
          static_cast<Index>(ids_.size());
  }
  template <class Geometry>
  Index number_of(Index v, const Geometry& geometry) {
    const auto [number, is_new] = numbers_.insert(v, static_cast<std::uint32_t>(ids_.size()));
    if (is_new) {
      ids_.push_back(v);
      internal::prefetch(geometry.point(v));
    }
    return number;
  }
  void add_border(const CellStore<K>& cells, Index dead, std::uint32_t inner, int slot) {
    const Index survivor = cells.neighbors(dead)[slot];
    const int mirror = cells.slot_of_neighbor(survivor, dead);
    border_.push_back({survivor, inner, cells.vertex(survivor, mirror), static_cast<std::uint16_t>(slot),
                       static_cast<std::uint16_t>(mirror)});
  }

  int dimension_ = K;
  Index leaving_ = invalid_index, num_finite_ = 0;
  std::vector<int> slots_;          // of the vertex that goes, in its cells
  std::vector<Index> ids_;          // of the vertices, by number
  internal::StampedTable numbers_;  // by id
  std::vector<Index> numbers_of_cells_;
  std::vector<BorderFacet> border_;
};

}  // namespace delone::engine
