// SPDX-License-Identifier: BSD-3-Clause
// A hole in the sphere: cells that go, the vertices around them, and the facets between them and the cells
// that stay.
#pragma once

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
      zone.cells[zone.num_cells++] = next;
      marks.set(next, Mark::in_conflict);
      cells.prefetch_around(next);
    };
    zone.reserve(1, width());
    add(cell);
    for (std::size_t i = 0; i < zone.num_cells; ++i) {
      zone.reserve(width(), width());
      const Index dead = zone.cells[i];
      const int slot = add_cell(cells, geometry, dead);
      const Index* const neighbors = cells.neighbors(dead);
      for (int other = 0; other < static_cast<int>(width()); ++other)
        if (other != slot && !marks.is_in_conflict(neighbors[other])) add(neighbors[other]);
      add_border(cells, dead, static_cast<std::uint32_t>(i), slot);
    }
    number_leaving();
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
      add_cell(cells, geometry, cell);
    }
    for (std::uint32_t i = 0; i < dead.size(); ++i)
      for (int slot = 0; slot < static_cast<int>(width()); ++slot)
        if (!marks.is_in_conflict(cells.neighbors(dead[i])[slot])) add_border(cells, dead[i], i, slot);
  }

  /// The vertex that goes, or invalid_index.
  Index leaving() const { return leaving_; }
  std::size_t num_cells() const { return slots_.size(); }
  /// How many of the cells are finite.
  Index num_finite() const { return num_finite_; }
  /// The finite vertices that stay, in the order of their numbers, from 1 on.
  std::span<const Index> vertices() const { return std::span(ids_).subspan(1); }
  Index id(Index number) const { return number < ids_.size() ? ids_[number] : leaving_; }
  /// The vertices that stay, by number, the infinite one included.
  const Index* ids() const { return ids_.data(); }
  /// Whether a vertex stays and is one of the hole.
  bool has_vertex(Index id) const { return id < numbers_.size() && numbers_[id] != 0; }
  /// REQUIRES that it has the vertex, or that this is the infinite one.
  Index number(Index id) const { return numbers_[id]; }
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
    border_.clear();
    for (const Index id : ids_) numbers_[id] = 0;  // of the last hole
    ids_.assign(1, index(infinite_vertex));
  }
  /// Adds a cell, and returns the slot of the vertex that goes: its number is not known yet.
  template <class Geometry>
  int add_cell(const CellStore<K>& cells, const Geometry& geometry, Index cell) {
    const std::size_t first = slots_.size() * width();
    if (numbers_of_cells_.size() < first + width()) numbers_of_cells_.resize(2 * (first + width()));
    Index* const numbers = numbers_of_cells_.data() + first;
    const auto vertices = cells.vertices(cell);
    const Index* const ids = vertices;
    int slot = 0;
    bool is_infinite = false;
    for (int i = 0; i < static_cast<int>(width()); ++i) {
      is_infinite |= ids[i] == index(infinite_vertex);
      if (ids[i] == leaving_)
        slot = i;
      else
        numbers[i] = number_of(ids[i], geometry);
    }
    num_finite_ += is_infinite ? 0 : 1;
    slots_.push_back(slot);
    return slot;
  }
  void number_leaving() {
    for (std::size_t cell = 0; cell < slots_.size(); ++cell)
      numbers_of_cells_[cell * width() + static_cast<std::size_t>(slots_[cell])] =
          static_cast<Index>(ids_.size());
  }
  template <class Geometry>
  Index number_of(Index v, const Geometry& geometry) {
    if (v < numbers_.size() && (numbers_[v] != 0 || v == index(infinite_vertex))) [[likely]]
      return numbers_[v];
    if (v >= numbers_.size()) numbers_.resize(v + std::size_t{v} / 2 + 1);
    const auto number = static_cast<Index>(ids_.size());
    ids_.push_back(v);
    numbers_[v] = number;
    internal::prefetch(geometry.point(v));
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
  std::vector<int> slots_;         // of the vertex that goes, in its cells
  std::vector<Index> ids_{0};      // of the vertices, by number
  std::vector<Index> numbers_{0};  // by id; 0 for vertices that are not of the hole
  std::vector<Index> numbers_of_cells_;
  std::vector<BorderFacet> border_;
};

}  // namespace delone::engine
