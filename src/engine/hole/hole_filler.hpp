// SPDX-License-Identifier: BSD-3-Clause
// Fills a hole in the sphere: the place of cells that go, such as those around a vertex that is removed. The
// hole is wrapped from its border inwards: across every open facet lies the cell whose apex comes first in
// the pencil of the facet, of all vertices around the hole, ties perturbed. So every cell is found once,
// beside one that is there already.
//
// The search works with rounded numbers and asks exact predicates where these leave several vertices
// (geometry/hole_search/). Its result is proved afterwards. Let all new finite cells be positively oriented,
// all facets between cells have two, and no vertex opposite a facet of the hole be in conflict with the cell
// beyond. Old and new cells of the hole have the same border, so new less old ones cover every point of the
// sphere equally often. If there is no infinite cell among them, that is 0 times, as it is near infinity;
// else one vertex that no new cell has in its sphere shows it. So the cells are a triangulation, and one that
// is locally Delaunay is Delaunay everywhere.
//
// Where a proof fails, and it does for rounding errors alone, the search is repeated with exact predicates
// for all vertices. Then every cell is right because the one beside it is.
#pragma once

#include "base/random.hpp"
#include "base/stamped_table.hpp"
#include "engine/conflict.hpp"
#include "engine/conflict_zone.hpp"
#include "engine/retriangulate.hpp"
#include "engine/wrap/facet_table.hpp"
#include "geometry/hole_search/hole_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace delone::engine {

/// K is the dimension of the cells, or 0 when it is chosen at run time. Memory is kept from hole to hole.
template <int K, Geometry G>
class HoleFiller {
  using Query = typename G::Query;

 public:
  HoleFiller(CellStore<K>& cells, G& geometry) : cells_(cells), geometry_(geometry) {}

  /// Marks the cells around vertex v, one of which is `cell`, and makes them the zone; their other vertices
  /// are around the hole. Throws std::bad_alloc; then the zone tells what has been marked.
  void open_star(Index v, Index cell, ConflictZone& zone) {
    const int k = dimension();
    zone.num_cells = zone.num_facets = zone.num_marked = zone.num_infinite = 0;
    zone.num_undecided = zone.num_open = 0;
    center_ = v;
    slots_.clear();
    auto marks = cells_.marks();
    const auto add = [&](Index next) {
      zone.reserve(1, static_cast<std::size_t>(k) + 1);
      slots_.push_back(cells_.slot_of_vertex(next, v));
      zone.cells[zone.num_cells++] = next;
      marks.set(next, Mark::in_conflict);
      cells_.prefetch_neighbors(next);
    };
    add(cell);
    for (std::size_t i = 0; i < zone.num_cells; ++i) {
      const Index* const neighbors = cells_.neighbors(zone.cells[i]);
      for (int slot = 0; slot <= k; ++slot)
        if (slot != slots_[i] && !marks.is_in_conflict(neighbors[slot])) add(neighbors[slot]);
    }
    number_vertices({zone.cells.data(), zone.num_cells});
  }

  /// Whether all other vertices lie in one hyperplane. REQUIRES an open star, and the number of finite cells.
  bool is_flat_without_center(const ConflictZone& zone, Index num_finite) const {
    const int k = dimension();
    Index num_here = 0;
    for (std::size_t i = 0; i < zone.num_cells; ++i) num_here += geometry_.is_infinite(zone.cells[i]) ? 0 : 1;
    if (num_here != num_finite) return false;
    std::size_t finite = 0;
    while (geometry_.is_infinite(zone.cells[finite])) ++finite;
    const auto vertices = cells_.vertices(zone.cells[finite]);
    const Index* const simplex = vertices;
    for (std::size_t i = 1; i < ids_.size(); ++i)
      if (std::find(simplex, simplex + k + 1, ids_[i]) == simplex + k + 1 &&
          geometry_.side_of_facet(simplex, slots_[finite], geometry_.query_at(ids_[i])) != Sign::zero)
        return false;
    return true;
  }

  /// Replaces the zone by cells of the other vertices. `on_size` is called with their number before anything
  /// changes, and may throw. Strong guarantee.
  template <class OnSize>
  Filling fill(ConflictZone& zone, StageCounts& counts, OnSize&& on_size) {
    find_border({zone.cells.data(), zone.num_cells});
    geometry_.place({ids_.data() + 1, ids_.size() - 1}, center_, begin_search());
    for (const bool exact : {false, true}) {
      if (!find_cells(exact, counts)) continue;
      on_size(num_cells_);
      if (const std::optional<Filling> made = create(zone, exact, counts)) return *made;
    }
    throw Error(Errc::invalid_argument, "cells of a hole do not fit together");
  }

  /// The cells that were created last.
  std::span<const Index> created() const { return created_; }

 private:
  static constexpr std::uint32_t none = FacetTable::none;

  /// A facet between the hole and the cells around it: its cell in the hole is number `inner`, with the
  /// opposite vertex in a slot; the survivor has the opposite vertex in slot `mirror`.
  struct BorderFacet {
    Index survivor;
    std::uint32_t inner;
    int slot, mirror;
  };

  int dimension() const { return cells_.dimension(); }
  std::size_t width() const { return static_cast<std::size_t>(dimension()) + 1; }

  /// Gives numbers to the finite vertices of the hole but its center: from 1 on; the infinite one is 0, and
  /// the center the last.
  void number_vertices(std::span<const Index> dead) {
    numbers_.clear();
    ids_.assign(1, index(infinite_vertex));
    dead_vertices_.resize(dead.size() * width());
    std::uint32_t* number = dead_vertices_.data();
    for (const Index cell : dead)
      for (int slot = 0; slot <= dimension(); ++slot, ++number) {
        const Index v = cells_.vertex(cell, slot);
        *number = 0;
        if (v == index(infinite_vertex)) continue;
        *number = unknown;
        if (v == center_) continue;
        const auto [known, is_new] = numbers_.insert(v, static_cast<std::uint32_t>(ids_.size()));
        *number = known;
        if (is_new) ids_.push_back(v);
      }
    for (std::uint32_t& n : dead_vertices_)
      if (n == unknown) n = static_cast<std::uint32_t>(ids_.size());
    while (keys_.size() <= ids_.size())
      keys_.push_back(random::mix(0x9e3779b97f4a7c15u * (keys_.size() + 1)));
  }
  static constexpr std::uint32_t unknown = ~std::uint32_t{0};
  Index id(std::uint32_t number) const { return number < ids_.size() ? ids_[number] : center_; }

  void find_border(std::span<const Index> dead) {
    border_.clear();
    for (std::size_t i = 0; i < dead.size(); ++i)
      for (int slot = 0; slot <= dimension(); ++slot) {
        const Index survivor = cells_.neighbors(dead[i])[slot];
        if (cells_.mark(survivor) == Mark::in_conflict) continue;
        border_.push_back(
            {survivor, static_cast<std::uint32_t>(i), slot, cells_.slot_of_neighbor(survivor, dead[i])});
      }
  }
  const std::uint32_t* inner_vertices(const BorderFacet& facet) const {
    return dead_vertices_.data() + facet.inner * width();
  }

  geometry::HoleSearch& begin_search() {
    search_.begin(dimension(), ids_.size() - 1, ids_.size());
    return search_;
  }

  /// Finds all cells of the hole. Returns whether every facet has two in the end.
  bool find_cells(bool exact, StageCounts& counts) {
    is_exact_ = exact;
    num_cells_ = 0;
    if (facets_.size() != 0) facets_ = FacetTable();
    open_.clear();
    is_closed_.assign(border_.size(), none);
    const std::size_t functions_size = geometry::size_of_functions(dimension());
    facets_.reserve(border_.size());
    for (std::uint32_t f = 0; f < border_.size(); ++f) {
      const std::uint32_t* const vertices = inner_vertices(border_[f]);
      std::uint64_t key = 0;
      for (int i = 0; i <= dimension(); ++i)
        if (i != border_[f].slot) key += keys_[vertices[i]];
      std::uint32_t other;
      facets_.match({&key, 1}, f, &other);
    }
    start_.resize(functions_size);
    const std::size_t most = exact ? static_cast<std::size_t>(-1) : 64 * border_.size() + 4096;
    for (std::uint32_t f = 0; f < border_.size(); ++f) {
      if (is_closed_[f] != none) continue;
      const std::uint32_t* const inner = inner_vertices(border_[f]);
      if (std::find(inner, inner + width(), 0u) != inner + width()) continue;  // infinite cells follow
      if (!exact) search_.solve(inner, start_.data());
      add_cell(inner, start_.data(), border_[f].slot, false, false, counts);
      while (!open_.empty()) {
        const std::uint32_t facet = open_.back();
        open_.pop_back();
        if (beside_[facet] != none) continue;
        if (num_cells_ > most) return false;
        const std::size_t cell = facet / width();
        vertices_of_source_.assign(vertices_.begin() + static_cast<std::ptrdiff_t>(cell * width()),
                                   vertices_.begin() + static_cast<std::ptrdiff_t>((cell + 1) * width()));
        if (!exact)
          std::copy_n(functions_.begin() + static_cast<std::ptrdiff_t>(cell * functions_size), functions_size,
                      start_.begin());
        add_cell(vertices_of_source_.data(), start_.data(), static_cast<int>(facet % width()), true,
                 !is_odd_[cell], counts);
      }
    }
    return facets_.size() == 0;
  }

  /// Adds the cell beyond a facet of a cell, or on its side where that is in the hole.
  void add_cell(const std::uint32_t* source, const double* functions, int slot, bool beyond, bool is_odd,
                StageCounts& counts) {
    const std::uint32_t apex = find_apex(source, functions, slot, beyond, is_odd, counts);
    const std::size_t cell = num_cells_++, functions_size = geometry::size_of_functions(dimension());
    if (vertices_.size() < num_cells_ * width()) {
      vertices_.resize(2 * num_cells_ * width());
      beside_.resize(2 * num_cells_ * width());
      is_odd_.resize(2 * num_cells_);
      functions_.resize(2 * num_cells_ * functions_size);
    }
    std::uint32_t* const vertices = vertices_.data() + cell * width();
    std::copy_n(source, width(), vertices);
    vertices[slot] = apex;
    is_odd_[cell] = is_odd;
    if (apex != 0 && !is_exact_)
      search_.replace(functions, slot, apex, functions_.data() + cell * functions_size);
    std::uint64_t key = 0;
    for (std::size_t i = 0; i < width(); ++i) key += keys_[vertices[i]];
    facet_keys_.resize(width());
    others_.resize(width());
    for (std::size_t i = 0; i < width(); ++i) facet_keys_[i] = key - keys_[vertices[i]];
    facets_.reserve(width());
    const auto first = static_cast<std::uint32_t>(border_.size() + cell * width());
    for (std::size_t i = 0; i < width(); i += FacetTable::most_at_once)
      facets_.match(std::span(facet_keys_).subspan(i, std::min(FacetTable::most_at_once, width() - i)),
                    first + static_cast<std::uint32_t>(i), others_.data() + i);
    for (std::size_t i = 0; i < width(); ++i) {
      const std::uint32_t here = static_cast<std::uint32_t>(cell * width() + i), other = others_[i];
      beside_[here] = other;
      if (other == none) {
        if (apex != 0) open_.push_back(here);
      } else if (other < border_.size()) {
        is_closed_[other] = here;
      } else {
        beside_[other - border_.size()] = static_cast<std::uint32_t>(border_.size()) + here;
      }
    }
  }

  std::uint32_t find_apex(const std::uint32_t* source, const double* functions, int slot, bool beyond,
                          bool is_odd, StageCounts& counts) {
    if (!is_exact_) {
      const std::span<const std::uint32_t> found = search_.first(functions, slot, beyond, source);
      if (found.empty()) return 0;
      if (found.size() == 1) return found.front();
      contenders_.assign(found.begin(), found.end());
    } else {
      contenders_.clear();
      for (std::uint32_t n = 1; n < ids_.size(); ++n)
        if (std::find(source, source + width(), n) == source + width()) contenders_.push_back(n);
    }
    for (std::uint32_t& n : contenders_) n = static_cast<std::uint32_t>(id(n));
    simplex_.resize(width());
    for (std::size_t i = 0; i < width(); ++i) simplex_[i] = id(source[i]);
    const Index apex =
        geometry_.first_in_pencil(simplex_.data(), slot, is_odd ? Sign::negative : Sign::positive,
                                  {contenders_.data(), contenders_.size()}, geometry_.grid(), counts);
    return apex == index(infinite_vertex) ? 0 : *numbers_.find_value(apex);
  }

  /// Writes the cells to vacant slots, computes their functionals and, unless they are exact, proves them.
  /// Nothing is returned, and nothing has changed, if the proof fails.
  std::optional<Filling> create(ConflictZone& zone, bool exact, StageCounts& counts) {
    cells_.reserve(num_cells_);
    cells_.reserve_vacancies(std::max(num_cells_, zone.num_cells));
    created_.resize(num_cells_);
    if (!exact) prepare_proof();
    for (Index& cell : created_) cell = cells_.allocate();
    bool is_proved = false;
    Index num_infinite = 0;
    try {
      for (std::size_t c = 0; c < num_cells_; ++c) num_infinite += write_cell(c) ? 1 : 0;
      is_proved = create_functionals() && (exact || is_delaunay(num_infinite > 0, counts));
    } catch (...) {
      for (const Index cell : created_) cells_.release(cell);
      created_.clear();
      throw;
    }
    if (!is_proved) {
      for (const Index cell : created_) cells_.release(cell);
      created_.clear();
      return std::nullopt;
    }
    for (std::size_t f = 0; f < border_.size(); ++f)
      cells_.neighbors(border_[f].survivor)[border_[f].mirror] = created_[is_closed_[f] / width()];
    for (std::size_t i = 0; i < zone.num_cells; ++i) {
      zone.num_infinite += geometry_.is_infinite(zone.cells[i]) ? 1 : 0;
      cells_.release(zone.cells[i]);
    }
    return Filling{num_cells_, num_infinite, created_.front()};
  }

  /// Returns whether it is infinite.
  bool write_cell(std::size_t c) {
    const Index cell = created_[c];
    bool is_infinite = false;
    for (std::size_t i = 0; i < width(); ++i) {
      const std::size_t at = c * width() + i;
      const int slot = slot_of(c, i);
      is_infinite |= vertices_[at] == 0;
      cells_.set_vertex(cell, slot, id(vertices_[at]));
      const std::uint32_t other = beside_[at];
      cells_.neighbors(cell)[slot] =
          other < border_.size() ? border_[other].survivor : created_[(other - border_.size()) / width()];
    }
    return is_infinite;
  }
  /// Where vertex i of cell c is written: odd cells have their first two exchanged.
  int slot_of(std::size_t c, std::size_t i) const {
    return static_cast<int>(i < 2 && is_odd_[c] ? 1 - i : i);
  }

  /// Returns whether all finite cells are positively oriented.
  bool create_functionals() {
    for (const Index cell : created_) {
      const auto vertices = cells_.vertices(cell);
      const int infinite_slot = cells_.infinite_slot(cell);
      const Sign orientation = geometry_.create(cell, vertices, infinite_slot, infinite_slot == 0 ? 1 : 0);
      if (infinite_slot < 0 && orientation != Sign::positive &&
          geometry_.orientation(vertices) != Sign::positive)
        return false;
    }
    return true;
  }

  void prepare_proof() {
    queries_.clear();
    queries_.reserve(ids_.size());
    for (const Index v : ids_)
      queries_.push_back(geometry_.query_at(v == index(infinite_vertex) ? center_ : v));
  }

  bool is_delaunay(bool has_infinite, StageCounts& counts) {
    for (std::size_t at = 0; at < num_cells_ * width(); ++at) {
      const std::uint32_t other = beside_[at];
      const std::size_t c = at / width();
      if (other < border_.size()) {
        if (!is_locally_delaunay(border_[other].survivor, vertices_[at], counts)) return false;
      } else if (const std::size_t there = other - border_.size(); there / width() < c) {
        if (!is_locally_delaunay(created_[there / width()], vertices_[at], counts)) return false;
      }
    }
    return !has_infinite || has_cells_around_once(counts);
  }

  /// Whether vertex number `apex`, opposite the common facet, is not in conflict with a cell. On the hull, it
  /// may lie in the plane of an infinite cell.
  bool is_locally_delaunay(Index cell, std::uint32_t apex, StageCounts& counts) {
    if (apex == 0)
      return true;  // then the facet is one of the hull, and the finite cell is on its inner side
    const Query& q = queries_[apex];
    const auto functional = geometry_.evaluator(q);
    const double value = functional.value(cell);
    if (std::fabs(value) > functional.threshold(cell)) {
      ++counts.filter;
      return value > 0;
    }
    const auto vertices = cells_.vertices(cell);
    const Index* const v = vertices;
    if (std::find(v, v + width(), ids_[apex]) != v + width()) return false;
    if (const int slot = cells_.infinite_slot(cell); slot >= 0)
      return geometry_.exact_side(vertices, slot, q, counts) != Sign::negative;
    return !in_conflict_exactly(cells_, geometry_, cell, q, functional, counts);
  }

  /// Whether a vertex is found that is strictly outside of all new cells.
  bool has_cells_around_once(StageCounts& counts) {
    int tries = 8;
    for (const BorderFacet& facet : border_) {
      const Index outside = cells_.vertex(facet.survivor, facet.mirror);
      if (outside == index(infinite_vertex) || outside == center_ || numbers_.contains(outside)) continue;
      const Query q = geometry_.query_at(outside);
      const auto functional = geometry_.evaluator(q);
      const bool is_outside = std::all_of(created_.begin(), created_.end(), [&](Index cell) {
        if (functional.value(cell) > functional.threshold(cell)) return true;
        const auto vertices = cells_.vertices(cell);
        return geometry_.exact_side(vertices, cells_.infinite_slot(cell), q, counts) == Sign::positive;
      });
      if (is_outside) return true;
      if (--tries == 0) break;
    }
    return false;
  }

  CellStore<K>& cells_;
  G& geometry_;
  geometry::HoleSearch search_;
  Index center_ = invalid_index;
  std::vector<int> slots_;          // of the center in the cells of its star
  std::vector<Index> ids_;          // of the vertices, by number
  internal::StampedTable numbers_;  // of the vertices, by id
  std::vector<std::uint32_t> dead_vertices_;
  std::vector<std::uint64_t> keys_;  // by number; that of a facet is the sum of those of its vertices
  std::vector<BorderFacet> border_;
  FacetTable facets_;  // those with one cell: of the border first, then cell · (k + 1) + slot
  // The cells that have been found.
  bool is_exact_ = false;
  std::size_t num_cells_ = 0;
  std::vector<std::uint32_t> vertices_;  // numbers
  std::vector<std::uint32_t> beside_;    // the facet there, in the numbering of the table
  std::vector<std::uint8_t> is_odd_;
  std::vector<double> functions_;
  std::vector<std::uint32_t> is_closed_;  // for each facet of the border, that of the cell in the hole
  std::vector<std::uint32_t> open_;
  std::vector<Index> created_;
  std::vector<Query> queries_;  // by number
  // Of one cell.
  std::vector<double> start_;
  std::vector<std::uint32_t> vertices_of_source_, others_;
  std::vector<std::uint64_t> facet_keys_;
  std::vector<Index> simplex_, contenders_;
};

}  // namespace delone::engine
