// SPDX-License-Identifier: BSD-3-Clause
// Fills a hole with the Delaunay cells of the vertices around it. The hole is wrapped from its border
// inwards: across every open facet lies the cell whose apex comes first in the pencil of the facet, of all
// vertices around the hole, ties perturbed. So every cell is found once, beside one that is there already.
//
// The search works with rounded numbers and asks exact predicates where these leave several vertices
// (geometry/hole_search/). Its result is proved afterwards (is_delaunay()). Where the proof fails, the search
// is repeated with exact predicates for all vertices. Around a vertex that goes, every cell is right then
// because the one beside it is. Where vertices have moved, the hole may be too small, and the proof may fail
// again.
#pragma once

#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "engine/conflict.hpp"
#include "engine/hole/hole.hpp"
#include "engine/retriangulate.hpp"
#include "engine/wrap/facet_table.hpp"
#include "geometry/hole_search/hole_search.hpp"

#include <algorithm>
#include <array>
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
  using BorderFacet = typename Hole<K>::BorderFacet;

 public:
  HoleFiller(CellStore<K>& cells, G& geometry)
      : cells_(cells), geometry_(geometry), functions_size_(geometry::size_of_functions(cells.dimension())) {}

  /// The hole that is filled next.
  Hole<K>& hole() { return hole_; }

  /// Whether all vertices but the one that goes lie in one hyperplane. `num_finite`: the number of all finite
  /// cells.
  bool is_flat_without_leaving(const ConflictZone& zone, Index num_finite) const {
    if (hole_.num_finite() != num_finite) return false;
    std::size_t finite = 0;
    while (geometry_.is_infinite(zone.cells[finite])) ++finite;
    const auto vertices = cells_.vertices(zone.cells[finite]);
    const Index* const simplex = vertices;
    return std::all_of(hole_.vertices().begin(), hole_.vertices().end(), [&](Index v) {
      return std::find(simplex, simplex + width(), v) != simplex + width() ||
             geometry_.side_of_facet(simplex, hole_.slot_of_leaving(finite), geometry_.query_at(v)) ==
                 Sign::zero;
    });
  }

  /// Replaces the zone, which is the hole, by new cells. Nothing is returned, and nothing has changed, if
  /// cells cannot be proved to be right, which does not happen around a vertex that goes. `on_size` is called
  /// with their number before anything changes, and may throw. Strong guarantee.
  template <class OnSize>
  std::optional<Filling> fill(ConflictZone& zone, StageCounts& counts, OnSize&& on_size) {
    const bool is_star = hole_.leaving() != invalid_index;
    if constexpr (K == 2)
      if (is_star && hole_.num_finite() == hole_.num_cells()) {
        find_triangles(counts);
        on_size(num_cells_);
        return create(zone, true, counts);
      }
    const std::span<const Index> vertices = hole_.vertices();
    while (keys_.size() <= vertices.size() + 1)
      keys_.push_back(random::mix(0x9e3779b97f4a7c15u * (keys_.size() + 1)));
    search_.begin(dimension(), vertices.size(), vertices.size() + 1);
    geometry_.place(vertices, is_star ? hole_.leaving() : vertices.front(), search_);
    for (const bool exact : {false, true}) {
      if (!find_cells(exact, counts)) continue;
      on_size(num_cells_);
      if (const std::optional<Filling> made = create(zone, exact && is_star, counts)) return made;
    }
    if (is_star) throw Error(Errc::unsupported, "a vertex could not be removed: a fault of delone");
    return std::nullopt;
  }

  /// The cells that were created last.
  std::span<const Index> created() const { return created_; }

 private:
  /// Facets have numbers, first those of the border, then those of the cells: `first_facet_` + cell · (k + 1)
  /// + slot.
  static constexpr std::uint32_t none = FacetTable::none;

  int dimension() const { return cells_.dimension(); }
  std::size_t width() const { return static_cast<std::size_t>(dimension()) + 1; }

  /// In the plane, around a vertex inside: the hole is a polygon. A triangle at one of its edges, whose apex
  /// exact predicates choose, leaves a polygon on each side.
  void find_triangles(StageCounts& counts) requires(K == 2) {
    first_facet_ = static_cast<std::uint32_t>(hole_.border().size());
    beyond_border_.assign(first_facet_, none);
    num_cells_ = 0;
    const std::span<const std::uint32_t> cycle = hole_.cycle();
    const auto number = [&](std::size_t i) { return hole_.beginning(cycle[i]); };
    polygons_.assign(1, {0, static_cast<std::uint32_t>(cycle.size()) - 1, cycle.back()});
    while (!polygons_.empty()) {
      const Polygon polygon = polygons_.back();
      polygons_.pop_back();
      std::uint32_t apex = polygon.first + 1;
      if (polygon.last - polygon.first > 2) {
        contenders_.clear();
        for (std::uint32_t i = polygon.first + 1; i < polygon.last; ++i)
          contenders_.push_back(hole_.id(number(i)));
        std::array<Index, 3> triangle{hole_.id(number(polygon.first)), 0, hole_.id(number(polygon.last))};
        const Index first = geometry_.first_in_pencil(triangle.data(), 1, Sign::positive, contenders_,
                                                      geometry_.grid(), counts);
        while (hole_.id(number(apex)) != first) ++apex;
      }
      reserve_cell();
      const auto cell = static_cast<std::uint32_t>(num_cells_++), facet = 3 * cell;
      is_odd_[cell] = 0;
      vertices_[facet] = number(polygon.first);
      vertices_[facet + 1] = number(apex);
      vertices_[facet + 2] = number(polygon.last);
      const auto link = [&](std::uint32_t here, std::uint32_t other) {
        beside_[here] = other;
        if (other < first_facet_)
          beyond_border_[other] = here;
        else
          beside_[other - first_facet_] = first_facet_ + here;
      };
      link(facet + 1, polygon.beyond);
      const auto go_on = [&](std::uint32_t first, std::uint32_t last, std::uint32_t here) {
        if (last == first + 1)
          link(here, cycle[first]);
        else
          polygons_.push_back({first, last, first_facet_ + here});
      };
      go_on(polygon.first, apex, facet + 2);
      go_on(apex, polygon.last, facet);
    }
  }

  /// Finds all cells of the hole. Returns whether every facet has two in the end.
  bool find_cells(bool exact, StageCounts& counts) {
    const std::span<const BorderFacet> border = hole_.border();
    is_exact_ = exact;
    num_cells_ = 0;
    first_facet_ = static_cast<std::uint32_t>(border.size());
    if (facets_.size() != 0) facets_ = FacetTable();
    open_.clear();
    beyond_border_.assign(border.size(), none);
    facets_.reserve(border.size());
    for (std::uint32_t f = 0; f < border.size(); ++f) {
      const Index* const vertices = hole_.numbers_of_cell(border[f].inner);
      std::uint64_t key = 0;
      for (int i = 0; i <= dimension(); ++i)
        if (i != border[f].slot) key += keys_[vertices[i]];
      std::uint32_t other;
      facets_.match({&key, 1}, f, &other);
    }
    start_.resize(functions_size_);
    // After a wrong apex a search may never end. Around a vertex that goes, exact ones are right.
    const bool is_safe = exact && hole_.leaving() != invalid_index;
    const std::size_t most = is_safe ? static_cast<std::size_t>(-1) : 4 * hole_.num_cells() + 256;
    for (std::uint32_t f = 0; f < border.size(); ++f) {
      if (beyond_border_[f] != none) continue;
      const Start start = find_start(border[f]);
      if (start == Start::nowhere) continue;
      if (!exact) search_.solve(source_.data(), start_.data());
      reserve_cell();
      add_cell(source_.data(), start_.data(), border[f].slot, start == Start::outside, false, counts);
      // In the order in which they were found: then searches do not wait for each other, and few steps of
      // elimination lead to a cell.
      for (std::size_t next = 0; next < open_.size(); ++next) {
        const std::uint32_t facet = open_[next];
        if (beside_[facet] != none) continue;
        if (num_cells_ > most) return false;
        if (num_cells_ % 512 == 511) internal::cancellation_point();
        reserve_cell();
        const std::size_t cell = facet / width();
        add_cell(vertices_.data() + cell * width(), functions_.data() + cell * functions_size_,
                 static_cast<int>(facet % width()), true, !is_odd_[cell], counts);
      }
      open_.clear();
    }
    return facets_.size() == 0;
  }

  /// Where a search can start at a facet of the border, and the vertices of a cell there. Infinite facets
  /// follow from others.
  enum class Start { nowhere, inside, outside };
  Start find_start(const BorderFacet& facet) {
    const Index* const inner = hole_.numbers_of_cell(facet.inner);
    source_.assign(inner, inner + width());
    Index& opposite = source_[static_cast<std::size_t>(facet.slot)];
    const bool is_finite = opposite != 0;
    opposite = 1;
    if (std::find(source_.begin(), source_.end(), Index{0}) != source_.end()) return Start::nowhere;
    opposite = inner[facet.slot];
    if (is_finite && (hole_.leaving() != invalid_index || is_positive(source_))) return Start::inside;
    // The cell that was there is infinite, or vertices have moved and turned it inside out.
    const Index outside = cells_.vertex(facet.survivor, facet.mirror);
    if (outside == index(infinite_vertex)) return Start::nowhere;
    opposite = static_cast<Index>(hole_.vertices().size()) + 1;
    geometry_.place_one(outside, search_.row(opposite));
    return Start::outside;
  }
  bool is_positive(std::span<const Index> numbers) {
    simplex_.resize(width());
    std::transform(numbers.begin(), numbers.end(), simplex_.begin(), [&](Index n) { return hole_.id(n); });
    return geometry_.orientation(simplex_.data()) == Sign::positive;
  }

  void reserve_cell() {
    const std::size_t needed = num_cells_ + 1;
    if (is_odd_.size() >= needed) return;
    if (first_facet_ + 2 * needed * width() >= none)
      throw Error(Errc::too_many, "a vertex has more cells than can be replaced at once");
    vertices_.resize(2 * needed * width());
    beside_.resize(2 * needed * width());
    functions_.resize(2 * needed * functions_size_);
    is_odd_.resize(2 * needed);
  }

  /// Adds the cell beyond a facet of a cell, or on its side where that is in the hole. REQUIRES
  /// reserve_cell().
  void add_cell(const Index* source, const double* functions, int slot, bool beyond, bool is_odd,
                StageCounts& counts) {
    const Index apex = find_apex(source, functions, slot, beyond, is_odd, counts);
    const std::size_t cell = num_cells_++;
    Index* const vertices = vertices_.data() + cell * width();
    std::copy_n(source, width(), vertices);
    vertices[slot] = apex;
    is_odd_[cell] = is_odd;
    if (apex != 0 && !is_exact_) {
      double* const of_cell = functions_.data() + cell * functions_size_;
      if (apex == source[slot])
        std::copy_n(functions, functions_size_, of_cell);
      else
        search_.replace(functions, slot, apex, of_cell);
    }
    match_facets(cell, apex != 0);
  }

  /// Links a cell with those that have its facets already.
  void match_facets(std::size_t cell, bool is_finite) {
    const Index* const vertices = vertices_.data() + cell * width();
    std::uint64_t key = 0;
    for (std::size_t i = 0; i < width(); ++i) key += keys_[vertices[i]];
    std::array<std::uint64_t, FacetTable::most_at_once> keys;
    std::array<std::uint32_t, FacetTable::most_at_once> others;
    facets_.reserve(width());
    for (std::size_t first = 0; first < width(); first += keys.size()) {
      const std::size_t count = std::min(keys.size(), width() - first);
      const auto here = static_cast<std::uint32_t>(cell * width() + first);
      for (std::size_t i = 0; i < count; ++i) keys[i] = key - keys_[vertices[first + i]];
      facets_.match({keys.data(), count}, first_facet_ + here, others.data());
      for (std::uint32_t i = 0; i < count; ++i) {
        beside_[here + i] = others[i];
        if (others[i] == none) {
          if (is_finite) open_.push_back(here + i);
        } else if (others[i] < first_facet_) {
          beyond_border_[others[i]] = here + i;
        } else {
          beside_[others[i] - first_facet_] = first_facet_ + here + i;
        }
      }
    }
  }

  /// The number of the vertex that makes the cell there, 0 for an infinite one.
  Index find_apex(const Index* source, const double* functions, int slot, bool beyond, bool is_odd,
                  StageCounts& counts) {
    // Where vertices have moved, the cell at the border may stay.
    const bool may_stay = !beyond && hole_.leaving() == invalid_index;
    contenders_.clear();
    if (!is_exact_) {
      const std::span<const std::uint32_t> found = search_.first(functions, slot, beyond, may_stay, source);
      if (found.empty()) return 0;
      if (found.size() == 1) return found.front();
      for (const std::uint32_t number : found) contenders_.push_back(hole_.id(number));
    } else {
      for (Index number = 1; number <= hole_.vertices().size(); ++number) {
        const Index* const in_source = std::find(source, source + width(), number);
        if (in_source == source + width() || (may_stay && in_source == source + slot))
          contenders_.push_back(hole_.id(number));
      }
    }
    simplex_.resize(width());
    for (std::size_t i = 0; i < width(); ++i) simplex_[i] = hole_.id(source[i]);
    return hole_.number(geometry_.first_in_pencil(simplex_.data(), slot,
                                                  is_odd ? Sign::negative : Sign::positive, contenders_,
                                                  geometry_.grid(), counts));
  }

  /// Writes the cells to vacant slots, computes their functionals and proves them, unless they are known to
  /// be right. Nothing is returned, and nothing has changed, if the proof fails.
  std::optional<Filling> create(ConflictZone& zone, bool is_known, StageCounts& counts) {
    cells_.reserve(num_cells_);
    cells_.reserve_vacancies(std::max(num_cells_, zone.num_cells));
    created_.resize(num_cells_);
    prepare(is_known);
    for (Index& cell : created_) cell = cells_.allocate();
    bool is_right = false;
    Index num_infinite = 0;
    const auto discard = [&] {
      for (const Index cell : created_) cells_.release(cell);
      created_.clear();
    };
    try {
      for (std::size_t c = 0; c < num_cells_; ++c)
        num_infinite += write_cell(c) ? 1 : 0;  // those are infinite
      const std::span<const Index> vertices(vertices_.data(), num_cells_ * width());
      const bool reaches_hull = hole_.num_finite() < hole_.num_cells();
      is_right = (num_infinite == 0 || reaches_hull) && hole_.has_neighbors(vertices, beside_) &&
                 create_functionals() &&
                 (is_known || (hole_.all_are_in(vertices) && is_delaunay(num_infinite > 0, counts)));
    } catch (...) {
      discard();
      throw;
    }
    if (!is_right) {
      discard();
      return std::nullopt;
    }
    for (std::size_t f = 0; f < first_facet_; ++f) {
      const BorderFacet& facet = hole_.border()[f];
      cells_.neighbors(facet.survivor)[facet.mirror] = created_[beyond_border_[f] / width()];
    }
    for (std::size_t i = 0; i < zone.num_cells; ++i) {
      zone.num_infinite += geometry_.is_infinite(zone.cells[i]) ? 1 : 0;
      cells_.release(zone.cells[i]);
    }
    return Filling{num_cells_, num_infinite, created_.front()};
  }

  void prepare(bool is_known) {
    if (K != 2 || !is_known) {
      rows_.resize((hole_.vertices().size() + 1) * width());
      double* row = rows_.data();
      for (const Index v : hole_.vertices()) geometry_.write_row_of(v, row += width());
    }
    written_.resize(num_cells_ * width());
    finite_.clear();
    finite_.reserve(num_cells_);
    simplices_.clear();
    simplices_.reserve(num_cells_);
    orientations_.resize(num_cells_);
  }

  bool write_cell(std::size_t c) {
    const Index cell = created_[c];
    const Index* const numbers = vertices_.data() + c * width();
    const std::uint32_t* const beside = beside_.data() + c * width();
    Index* const written = written_.data() + c * width();
    Index* const neighbors = cells_.neighbors(cell);
    bool is_infinite = false;
    for (std::size_t i = 0; i < width(); ++i) {
      const std::uint32_t other = beside[i];
      is_infinite |= numbers[i] == 0;
      written[i] = numbers[i];
      neighbors[i] =
          other < first_facet_ ? hole_.border()[other].survivor : created_[(other - first_facet_) / width()];
    }
    if (is_odd_[c] != 0) {
      std::swap(written[0], written[1]);
      std::swap(neighbors[0], neighbors[1]);
    }
    for (std::size_t i = 0; i < width(); ++i)
      cells_.set_vertex(cell, static_cast<int>(i), hole_.id(written[i]));
    if (!is_infinite) {
      finite_.push_back(cell);
      simplices_.push_back(written);
    }
    return is_infinite;
  }

  /// Returns whether all finite cells are positively oriented.
  bool create_functionals() {
    std::fill(orientations_.begin(), orientations_.end(), Sign::zero);
    if constexpr (K >= 3)
      if (finite_.size() > 1)
        geometry_.create_from_rows(finite_, simplices_, rows_.data(), orientations_.data());
    std::size_t next = 0;
    for (const Index cell : created_) {
      const bool is_finite = next < finite_.size() && finite_[next] == cell;
      if (is_finite && orientations_[next] != Sign::zero) {
        if (orientations_[next++] == Sign::negative) return false;
        continue;
      }
      next += is_finite ? 1 : 0;
      const auto vertices = cells_.vertices(cell);
      const int infinite_slot = is_finite ? -1 : cells_.infinite_slot(cell);
      const Sign orientation = geometry_.create(cell, vertices, infinite_slot, infinite_slot == 0 ? 1 : 0);
      if (is_finite && orientation != Sign::positive && geometry_.orientation(vertices) != Sign::positive)
        return false;
    }
    return true;
  }

  /// Whether the new cells are Delaunay, given that the finite ones are positively oriented and every facet
  /// has two cells: if no vertex opposite a facet of the hole is in conflict with the cell beyond. Old and
  /// new cells have the same border, so new less old ones cover every point of the sphere equally often:
  /// never if none is infinite, as near infinity; else a vertex that is in none of them shows it. So all
  /// cells are a triangulation, and one that is locally Delaunay is Delaunay everywhere. Where vertices have
  /// moved, the old cells may have been anywhere, and who calls proves that (Settling).
  bool is_delaunay(bool has_infinite, StageCounts& counts) {
    for (std::uint32_t at = 0; at < num_cells_ * width(); ++at) {
      const std::uint32_t other = beside_[at], there = other - first_facet_;
      if (other < first_facet_) {
        if (!is_locally_delaunay(hole_.border()[other].survivor, vertices_[at], counts)) return false;
      } else if (there < at) {
        if (!is_locally_delaunay(created_[there / width()], vertices_[at], counts)) return false;
      }
    }
    return !has_infinite || hole_.leaving() == invalid_index || is_outside_of_all(counts);
  }

  /// Whether vertex number `apex`, opposite the common facet, is not in conflict with a cell. On the hull, it
  /// may lie in the plane of an infinite cell.
  bool is_locally_delaunay(Index cell, Index apex, StageCounts& counts) {
    if (apex == 0)
      return true;  // then the facet is one of the hull, and the finite cell is on its inner side
    const auto functional = geometry_.evaluator_of_row(rows_.data() + apex * width());
    const double value = functional.value(cell);
    if (std::fabs(value) > functional.threshold(cell)) [[likely]] {
      ++counts.filter;
      return value > 0;
    }
    const auto vertices = cells_.vertices(cell);
    const Index* const v = vertices;
    if (std::find(v, v + width(), hole_.id(apex)) != v + width()) return false;
    const Query q = geometry_.query_at(hole_.id(apex));
    if (const int slot = cells_.infinite_slot(cell); slot >= 0)
      return geometry_.exact_side(vertices, slot, q, counts) != Sign::negative;
    return !in_conflict_exactly(cells_, geometry_, cell, q, geometry_.evaluator(q), counts);
  }

  /// Whether a vertex is found that is strictly outside of all new cells.
  bool is_outside_of_all(StageCounts& counts) {
    int tries = 8;
    for (const BorderFacet& facet : hole_.border()) {
      const Index v = cells_.vertex(facet.survivor, facet.mirror);
      if (v == index(infinite_vertex) || hole_.has_vertex(v)) continue;
      const Query q = geometry_.query_at(v);
      const auto functional = geometry_.evaluator(q);
      const bool is_outside = std::all_of(created_.begin(), created_.end(), [&](Index cell) {
        const bool is_infinite = geometry_.is_infinite(cell);
        const bool decides = is_infinite || geometry_.is_outside_where_positive();
        if (decides && functional.value(cell) > functional.threshold(cell)) return true;
        const auto vertices = cells_.vertices(cell);
        if (decides)
          return geometry_.exact_side(vertices, cells_.infinite_slot(cell), q, counts) == Sign::positive;
        int slot = 0;
        while (slot <= dimension() && geometry_.side_of_facet(vertices, slot, q) != Sign::negative) ++slot;
        return slot <= dimension();
      });
      if (is_outside || --tries == 0) return is_outside;
    }
    return false;
  }

  CellStore<K>& cells_;
  G& geometry_;
  const std::size_t functions_size_;  // of one cell
  Hole<K> hole_;
  geometry::HoleSearch search_;
  std::vector<std::uint64_t> keys_;  // of vertices, by number; that of a facet is the sum of theirs
  FacetTable facets_;                // those with one cell
  // The cells that have been found.
  bool is_exact_ = false;
  std::size_t num_cells_ = 0;
  std::uint32_t first_facet_ = 0;
  std::vector<Index> vertices_;               // numbers
  std::vector<std::uint32_t> beside_;         // for each facet the same one of another cell, or of the border
  std::vector<std::uint8_t> is_odd_;          // oriented negatively as they are in vertices_
  std::vector<double> functions_;             // of finite cells
  std::vector<std::uint32_t> beyond_border_;  // for each facet of the border, that of the cell in the hole
  std::vector<std::uint32_t> open_;
  std::vector<double> start_;
  /// In the plane: the vertices first, …, last of the cycle, and the facet beyond the edge from the last to
  /// the first.
  struct Polygon {
    std::uint32_t first, last, beyond;
  };
  std::vector<Polygon> polygons_;
  std::vector<Index> source_, simplex_, contenders_;
  // The cells that have been created.
  std::vector<Index> created_, written_;
  std::vector<double> rows_;  // of vertices, by number
  std::vector<Index> finite_;
  std::vector<const Index*> simplices_;  // the numbers of their vertices
  std::vector<Sign> orientations_;
};

}  // namespace delone::engine
