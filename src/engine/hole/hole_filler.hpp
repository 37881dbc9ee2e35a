// SPDX-License-Identifier: BSD-3-Clause
// Fills a hole with the Delaunay cells of the vertices around it. The hole is wrapped from its border
// inwards: across every open facet lies the cell whose apex comes first in the pencil of the facet, of all
// vertices around the hole, ties perturbed. So every cell is found once, beside one that is there already.
//
// The search works with rounded numbers and asks exact predicates where these leave several vertices
// (G::HoleSearch). Its result is proved afterwards (is_delaunay()). Around a vertex that goes, the
// search is repeated with exact predicates for all vertices if the proof fails; then every cell is right
// because the one beside it is. Where vertices have moved, the proof fails if the hole is too small.
#pragma once

#include "base/progress_meter.hpp"
#include "engine/conflict.hpp"
#include "engine/hole/hole.hpp"
#include "engine/hole/hole_cells.hpp"
#include "engine/retriangulate.hpp"

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
  using Search = typename G::HoleSearch;
  using BorderFacet = typename Hole<K>::BorderFacet;

 public:
  HoleFiller(CellStore<K>& cells, G& geometry)
      : cells_(cells),
        geometry_(geometry),
        functions_size_(Search::size_of_functions(cells.dimension())),
        found_(cells.dimension()) {}

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
  /// vertices have moved and the cells cannot be proved, or if a vertex is removed and a rebuild costs less.
  /// `on_size` is called with the number of new cells before anything changes, and may throw.
  /// Strong guarantee.
  template <class OnSize>
  std::optional<Filling> fill(ConflictZone& zone, StageCounts& counts, OnSize&& on_size) {
    const bool is_star = hole_.leaving() != invalid_index;
    looks_left_ = is_star ? looks_per_cell * (cells_.num_cells() + 4000) : static_cast<std::size_t>(-1);
    const std::span<const Index> vertices = hole_.vertices();
    search_.begin(dimension(), vertices.size(), vertices.size() + 1);
    geometry_.place(vertices, is_star ? hole_.leaving() : vertices.front(), search_);
    for (const bool exact : {false, true}) {
      if (exact && !is_star) break;
      if (!find_cells(exact, counts)) continue;
      on_size(found_.size());
      if (const std::optional<Filling> made = create(zone, exact, counts)) return made;
    }
    return std::nullopt;
  }

  /// The cells that were created last.
  std::span<const Index> created() const { return created_; }

 private:
  static constexpr std::uint32_t none = HoleCells<K>::none;

  int dimension() const { return cells_.dimension(); }
  std::size_t width() const { return static_cast<std::size_t>(dimension()) + 1; }

  /// What other work costs, in looks at a vertex: a cell of a rebuild, a comparison by predicates, and an
  /// exact one.
  static constexpr std::size_t looks_per_cell = 500, per_contender = 100, per_exact_test = 1000;

  /// Returns false if a rebuild would have cost less than the work so far.
  bool spend(std::size_t looks) {
    if (looks > looks_left_) return false;
    looks_left_ -= looks;
    return true;
  }
  /// The first of the contenders in a pencil, or invalid_index if that takes too long.
  Index first_of_contenders(Index* simplex, int slot, Sign orientation, StageCounts& counts) {
    const std::uint64_t exact_before = counts.exact;
    const Index first =
        geometry_.first_in_pencil(simplex, slot, orientation, contenders_, geometry_.grid(), counts);
    const bool is_left = spend(per_contender * contenders_.size() +
                               per_exact_test * static_cast<std::size_t>(counts.exact - exact_before));
    return is_left ? first : invalid_index;
  }

  /// Finds all cells of the hole. Returns whether every facet has two in the end, and false soon if that
  /// takes too long.
  bool find_cells(bool exact, StageCounts& counts) {
    const std::span<const BorderFacet> border = hole_.border();
    is_exact_ = exact;
    if (exact) found_.renew_keys();
    found_.begin(hole_);
    origins_.clear();
    num_functions_ = 0;
    slots_.resize(width());
    const bool is_star = hole_.leaving() != invalid_index;
    const std::size_t most = is_star ? exact ? static_cast<std::size_t>(-1) : 16 * hole_.num_cells() + 256
                                     : 4 * hole_.num_cells() + 16;  // a wrong apex may lead on forever
    // Cells are taken in the order in which they were found: then searches do not wait for each other, and
    // few steps of elimination lead to a cell.
    std::size_t next = 0;
    for (std::uint32_t f = 0; f < border.size(); ++f) {
      if (found_.beside(f) != none) continue;
      const Start start = find_start(border[f]);
      if (start == Start::nowhere) continue;
      const int slot = border[f].slot;
      if (is_star && start == Start::inside && is_on_hull_now(slot)) {
        found_.reserve(1);
        found_.add(source_.data(), slot, 0, f);
        origins_.push_back({none, slot});
        continue;
      }
      const std::uint32_t number = add_functions();
      if (!exact) search_.solve(source_.data(), functions(number));
      found_.reserve(1);
      if (!add_cells(source_.data(), number, {&slot, 1}, start == Start::outside, false,
                     f - static_cast<std::uint32_t>(slot), counts))
        return false;
      for (; next < found_.size(); ++next) {
        if (found_.size() > most || found_.has_excess()) return false;
        if (next % 512 == 511) internal::cancellation_point();
        if (!add_neighbors(next, counts)) return false;
      }
    }
    return found_.are_all_matched();
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
    if (facet.outside == index(infinite_vertex)) return Start::nowhere;
    opposite = static_cast<Index>(hole_.vertices().size()) + 1;
    geometry_.place_one(facet.outside, search_.row(opposite));
    return Start::outside;
  }
  bool is_positive(std::span<const Index> numbers) {
    set_simplex(numbers.data());
    return geometry_.orientation(simplex_.data()) == Sign::positive;
  }
  void set_simplex(const Index* numbers) {
    simplex_.resize(width());
    std::transform(numbers, numbers + width(), simplex_.begin(), [&](Index n) { return hole_.id(n); });
  }
  /// Whether facet `slot` of the source, which is at the border, is one of the hull without the vertex that
  /// goes, as is easily seen where it lies in a side of the box of all others. There may be thousands of
  /// these.
  bool is_on_hull_now(int slot) {
    if (hole_.num_finite() == hole_.num_cells()) return false;
    set_simplex(source_.data());
    return geometry_.is_in_side_of_box(simplex_.data(), slot);
  }

  /// Where the functions of a finite cell are: with those of the cell that it was found from. One step of
  /// elimination leads from these to its own, which few cells need.
  struct Origin {
    std::uint32_t functions;  // their number; none for an infinite cell
    int slot;  // the only one where the vertices of the two cells differ; −1: no step is needed
  };
  double* functions(std::size_t number) { return functions_.data() + number * functions_size_; }
  /// Makes room for those of one more cell, and returns their number.
  std::uint32_t add_functions() {
    const std::size_t size = (num_functions_ + 1) * functions_size_;
    if (functions_.size() < size) functions_.resize(2 * size);
    return static_cast<std::uint32_t>(num_functions_++);
  }

  /// Adds the cells beyond all facets of a cell that have none yet. Returns false if that takes too long.
  bool add_neighbors(std::size_t cell, StageCounts& counts) {
    Origin origin = origins_[cell];
    if (origin.functions == none) return true;
    const std::size_t num_slots = found_.find_open(cell, slots_.data());
    if (num_slots == 0) return true;
    found_.reserve(num_slots);
    if (origin.slot >= 0 && !is_exact_) {
      const std::uint32_t own = add_functions();
      search_.replace(functions(origin.functions), origin.slot,
                      found_.vertices(cell)[static_cast<std::size_t>(origin.slot)], functions(own));
      origin = {own, -1};
    }
    return add_cells(found_.vertices(cell), origin.functions, {slots_.data(), num_slots}, true,
                     !found_.is_odd(cell), found_.facet(cell * width()), counts);
  }
  /// Adds the cells beyond facets of a cell, or on its side where that is in the hole. `number`: of its
  /// functions; `across`: what to add to a slot for the number of its facet. REQUIRES that the cells found
  /// have room. Returns false if that takes too long.
  bool add_cells(const Index* source, std::uint32_t number, std::span<const int> slots, bool beyond,
                 bool is_odd, std::uint32_t across, StageCounts& counts) {
    // Where vertices have moved, the cell at the border may stay.
    const bool may_stay = !beyond && hole_.leaving() == invalid_index;
    if (!spend(slots.size() * hole_.vertices().size())) return false;
    if (!is_exact_) search_.search(functions(number), slots, beyond, may_stay, source);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const int slot = slots[i];
      const Index apex = find_apex(i, source, slot, may_stay, is_odd, counts);
      if (apex == invalid_index) return false;
      found_.add(source, slot, apex, across + static_cast<std::uint32_t>(slot));
      origins_.push_back({apex == 0 ? none : number, apex == source[slot] ? -1 : slot});
    }
    return true;
  }

  /// The number of the vertex that makes the cell there, 0 for an infinite one; invalid_index if to find it
  /// takes too long. `i`: which facet of the last search this is.
  Index find_apex(std::size_t i, const Index* source, int slot, bool may_stay, bool is_odd,
                  StageCounts& counts) {
    contenders_.clear();
    if (!is_exact_) {
      const std::span<const std::uint32_t> found = search_.found(i);
      if (found.empty()) return 0;
      if (found.size() == 1 && search_.is_certain(i)) return found.front();
      for (const std::uint32_t candidate : found) contenders_.push_back(hole_.id(candidate));
    } else {
      for (Index candidate = 1; candidate <= hole_.vertices().size(); ++candidate) {
        const Index* const in_source = std::find(source, source + width(), candidate);
        if (in_source == source + width() || (may_stay && in_source == source + slot))
          contenders_.push_back(hole_.id(candidate));
      }
    }
    set_simplex(source);
    geometry_.drop_coplanar(simplex_.data(), slot, contenders_);
    const Index first =
        first_of_contenders(simplex_.data(), slot, is_odd ? Sign::negative : Sign::positive, counts);
    return first == invalid_index ? first : hole_.number(first);
  }

  /// Drafts the cells, computes their functionals and proves them, unless they are known to be right. Then
  /// they get the slots of the cells of the hole, if a vertex leaves, and vacant ones. Nothing is returned,
  /// and nothing has changed, if the proof fails.
  std::optional<Filling> create(ConflictZone& zone, bool is_known, StageCounts& counts) {
    const std::size_t count = found_.size();
    // Who repairs cells after moves tells dead and new ones apart by their slots.
    const std::size_t reused = hole_.leaving() != invalid_index ? std::min(count, zone.num_cells) : 0;
    cells_.reserve(count - reused);
    cells_.reserve_vacancies(zone.num_cells - reused);
    created_.resize(count);
    prepare();
    first_draft_ = cells_.reserve_drafts(count, count - reused);
    const Index num_infinite = draft_cells();
    const bool reaches_hull = hole_.num_finite() < hole_.num_cells();
    const bool is_right =
        (num_infinite == 0 || reaches_hull) && found_.are_matches_right() && create_functionals() &&
        (is_known || (found_.have_all_vertices(hole_) && is_delaunay(num_infinite > 0, counts)));
    if (!is_right) return std::nullopt;
    std::copy_n(zone.cells.data(), reused, created_.begin());
    for (std::size_t c = reused; c < count; ++c) created_[c] = cells_.allocate();
    for (std::size_t i = reused; i < zone.num_cells; ++i) cells_.release(zone.cells[i]);
    const auto final_id = [&](Index id) { return id < first_draft_ ? id : created_[id - first_draft_]; };
    for (std::size_t c = 0; c < count; ++c) cells_.adopt_draft(draft(c), created_[c], final_id);
    const std::span<const BorderFacet> border = hole_.border();
    for (std::uint32_t f = 0; f < border.size(); ++f) {
      if (f + 8 < border.size()) cells_.prefetch_links(border[f + 8].survivor);
      cells_.neighbors(border[f].survivor)[border[f].mirror] = final_id(cells_at_[found_.beside(f)]);
    }
    zone.num_infinite = hole_.num_cells() - hole_.num_finite();
    return Filling{count, num_infinite, created_.front()};
  }

  /// The slot of a draft.
  Index draft(std::size_t cell) const { return first_draft_ + static_cast<Index>(cell); }

  void prepare() {
    rows_.resize((hole_.vertices().size() + 1) * width());
    double* row = rows_.data();
    for (const Index v : hole_.vertices()) geometry_.write_row_of(v, row += width());
    cells_at_.resize(found_.facet(found_.num_facets()));
    finite_.clear();
    finite_.reserve(found_.size());
    simplices_.clear();
    simplices_.reserve(found_.size());
    orientations_.resize(found_.size());
  }

  /// Writes the vertices and neighbors of all drafts. Returns how many are infinite.
  Index draft_cells() {
    const std::span<const BorderFacet> border = hole_.border();
    Index* const cells_at = cells_at_.data();
    for (std::size_t f = 0; f < border.size(); ++f) cells_at[f] = border[f].survivor;
    for (std::size_t c = 0; c < found_.size(); ++c)
      std::fill_n(cells_at + found_.facet(c * width()), width(), draft(c));
    const Index* const ids = hole_.ids();
    const auto layout = cells_.layout();
    for (std::size_t c = 0; c < found_.size(); ++c) {
      const Index cell = draft(c);
      const Index* const numbers = found_.vertices(c);
      const std::uint32_t* const beside = found_.beside_of_cell(c);
      Index *const vertices = cells_.wide_vertices(cell), *const neighbors = cells_.neighbors(cell);
      const std::size_t is_odd = found_.is_odd(c);
      bool is_infinite = false;
      for (std::size_t i = 0; i < width(); ++i) {
        const std::size_t to = i < 2 ? i ^ is_odd : i;  // the first two are exchanged if it is odd
        is_infinite |= numbers[i] == 0;
        layout.set_vertex(vertices, static_cast<int>(to), ids[numbers[i]]);
        neighbors[to] = cells_at[beside[i]];
      }
      if (is_infinite) continue;
      finite_.push_back(cell);
      simplices_.push_back(numbers);
    }
    return static_cast<Index>(found_.size() - finite_.size());
  }

  /// Returns whether all finite cells are positively oriented.
  bool create_functionals() {
    std::fill(orientations_.begin(), orientations_.end(), Sign::zero);
    if constexpr (K >= 3)
      if (finite_.size() > 1)
        geometry_.create_from_rows(finite_, simplices_, rows_.data(), orientations_.data());
    std::size_t next = 0;
    for (std::size_t c = 0; c < found_.size(); ++c) {
      const Index cell = draft(c);
      const bool is_finite = next < finite_.size() && finite_[next] == cell;
      if (is_finite && orientations_[next] != Sign::zero) {
        // Of the vertices before the first two are exchanged.
        if ((orientations_[next++] == Sign::negative) != found_.is_odd(c)) return false;
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
  /// has a cell on both sides: if no vertex opposite a facet of the hole is in conflict with the cell beyond.
  /// Around a vertex that goes, that is so across the border, as survivors are in conflict with no vertex.
  /// Old and new cells have the same border, so new less old ones cover every point of the sphere equally
  /// often: never if none is infinite, as near infinity; else a vertex that is in none of them shows it. So
  /// all cells are a triangulation, and one that is locally Delaunay is Delaunay everywhere. Where vertices
  /// have moved, the old cells may have been anywhere, and who calls proves that (Settling).
  bool is_delaunay(bool has_infinite, StageCounts& counts) {
    const bool is_star = hole_.leaving() != invalid_index;
    for (std::size_t c = 0; c < found_.size(); ++c) {
      const std::uint32_t first = found_.facet(c * width());
      const std::uint32_t* const beside = found_.beside_of_cell(c);
      for (std::size_t i = 0; i < width(); ++i) {
        const std::uint32_t other = beside[i];
        if (other >= first) continue;  // tested from there
        if (!found_.is_of_border(other)) {
          if (!is_locally_delaunay(draft(c), found_.vertex_opposite(other), counts)) return false;
          continue;
        }
        const BorderFacet& facet = hole_.border()[other];
        const Index apex = found_.vertices(c)[i];
        if (is_star ? hole_.id(apex) == facet.outside : !is_locally_delaunay(facet.survivor, apex, counts))
          return false;
      }
    }
    return !has_infinite || !is_star || is_outside_of_all(counts);
  }

  /// Whether vertex number `apex`, opposite the common facet, is not in conflict with a cell. On the hull, it
  /// may lie in the plane of an infinite cell.
  bool is_locally_delaunay(Index cell, Index apex, StageCounts& counts) {
    if (apex == 0)
      return true;  // then the facet is one of the hull, and the finite cell is on its inner side
    const double value = geometry_.value_at_row(cell, rows_.data() + apex * width());
    if (std::fabs(value) > geometry_.threshold(cell)) [[likely]] {
      ++counts.filter;
      return value > 0;
    }
    return is_outside_exactly(cells_, geometry_, cell, hole_.id(apex), counts);
  }

  /// Whether a vertex is found that is outside of all new cells. An infinite cell is what the vertex sees
  /// behind the hull facet from the inner side, and is empty if the vertex is in its plane. There, one that
  /// is outside of the simplex on the other side is outside of the facet.
  bool is_outside_of_all(StageCounts& counts) {
    int tries = 8;
    for (const BorderFacet& facet : hole_.border()) {
      const Index v = facet.outside;
      if (v == index(infinite_vertex) || hole_.has_vertex(v)) continue;
      const Query q = geometry_.query_at(v);
      const auto functional = geometry_.evaluator(q);
      std::size_t c = 0;
      while (c < found_.size() && is_outside(draft(c), q, functional, counts)) ++c;
      if (c == found_.size()) return true;
      if (--tries == 0) return false;
    }
    return false;
  }
  template <class Evaluator>
  bool is_outside(Index cell, const Query& q, const Evaluator& functional, StageCounts& counts) const {
    const bool is_infinite = geometry_.is_infinite(cell);
    if ((is_infinite || geometry_.is_outside_where_positive()) &&
        functional.value(cell) > functional.threshold(cell))
      return true;
    if (!is_infinite) return is_outside_of_simplex(cell, q);
    const int slot = cells_.infinite_slot(cell);
    const auto vertices = cells_.vertices(cell);
    const Sign side = geometry_.exact_side(vertices, slot, q, counts);
    if (side != Sign::zero) return side == Sign::positive;
    const Index inner = cells_.neighbors(cell)[slot];
    return !geometry_.is_infinite(inner) && is_outside_of_simplex(inner, q);
  }
  bool is_outside_of_simplex(Index cell, const Query& q) const {
    const auto vertices = cells_.vertices(cell);
    int slot = 0;
    while (slot <= dimension() && geometry_.side_of_facet(vertices, slot, q) != Sign::negative) ++slot;
    return slot <= dimension();
  }

  CellStore<K>& cells_;
  G& geometry_;
  const std::size_t functions_size_;  // of one cell
  Hole<K> hole_;
  Search search_;
  HoleCells<K> found_;
  bool is_exact_ = false;
  std::size_t looks_left_ = 0;
  std::vector<Origin> origins_;  // of the cells that have been found
  std::size_t num_functions_ = 0;
  std::vector<double> functions_;
  std::vector<int> slots_;
  std::vector<Index> source_, simplex_, contenders_;
  // The cells that have been created.
  std::vector<Index> created_;
  Index first_draft_ = 0;
  std::vector<Index> cells_at_;  // by facet: the cell beyond one of the border, or that which has it
  std::vector<double> rows_;     // of vertices, by number
  std::vector<Index> finite_;
  std::vector<const Index*> simplices_;  // the numbers of their vertices
  std::vector<Sign> orientations_;
};

}  // namespace delone::engine
