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
    found_.begin(hole_);
    start_.resize(functions_size_);
    const bool is_star = hole_.leaving() != invalid_index;
    const std::size_t most = is_star ? exact ? static_cast<std::size_t>(-1) : 16 * hole_.num_cells() + 256
                                     : 4 * hole_.num_cells() + 16;  // a wrong apex may lead on forever
    for (std::uint32_t f = 0; f < border.size(); ++f) {
      if (found_.beyond_border(f) != none) continue;
      const Start start = find_start(border[f]);
      if (start == Start::nowhere) continue;
      if (!exact) search_.solve(source_.data(), start_.data());
      reserve_cell();
      if (!add_cell(source_.data(), start_.data(), border[f].slot, start == Start::outside, false, counts))
        return false;
      // In the order in which they were found: then searches do not wait for each other, and few steps of
      // elimination lead to a cell.
      for (std::size_t next = 0; next < found_.unmatched().size(); ++next) {
        const std::uint32_t facet = found_.unmatched()[next];
        if (found_.beside(facet) != none) continue;
        if (found_.size() > most) return false;
        if (found_.size() % 512 == 511) internal::cancellation_point();
        reserve_cell();
        const std::size_t cell = found_.cell_of(facet);
        if (!add_cell(found_.vertices(cell), functions_.data() + cell * functions_size_,
                      static_cast<int>(facet - cell * width()), true, !found_.is_odd(cell), counts))
          return false;
      }
      found_.clear_unmatched();
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
    found_.reserve_one();
    const std::size_t size = found_.capacity() * functions_size_;
    if (functions_.size() < size) functions_.resize(size);
  }

  /// Adds the cell beyond a facet of a cell, or on its side where that is in the hole. REQUIRES
  /// reserve_cell(). Returns false if that takes too long.
  bool add_cell(const Index* source, const double* functions, int slot, bool beyond, bool is_odd,
                StageCounts& counts) {
    const Index apex = find_apex(source, functions, slot, beyond, is_odd, counts);
    if (apex == invalid_index) return false;
    const std::size_t cell = found_.add(source, slot, apex, is_odd);
    if (apex != 0 && !is_exact_) {
      double* const of_cell = functions_.data() + cell * functions_size_;
      if (apex == source[slot])
        std::copy_n(functions, functions_size_, of_cell);
      else
        search_.replace(functions, slot, apex, of_cell);
    }
    found_.match_facets(cell, apex != 0);
    return true;
  }

  /// The number of the vertex that makes the cell there, 0 for an infinite one; invalid_index if to find it
  /// takes too long.
  Index find_apex(const Index* source, const double* functions, int slot, bool beyond, bool is_odd,
                  StageCounts& counts) {
    // Where vertices have moved, the cell at the border may stay.
    const bool may_stay = !beyond && hole_.leaving() == invalid_index;
    contenders_.clear();
    if (!spend(hole_.vertices().size())) return invalid_index;
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
    const Index first =
        first_of_contenders(simplex_.data(), slot, is_odd ? Sign::negative : Sign::positive, counts);
    return first == invalid_index ? first : hole_.number(first);
  }

  /// Writes the cells to vacant slots, computes their functionals and proves them, unless they are known to
  /// be right. Nothing is returned, and nothing has changed, if the proof fails.
  std::optional<Filling> create(ConflictZone& zone, bool is_known, StageCounts& counts) {
    cells_.reserve(found_.size());
    cells_.reserve_vacancies(std::max(found_.size(), zone.num_cells));
    created_.resize(found_.size());
    prepare();
    for (Index& cell : created_) cell = cells_.allocate();
    bool is_right = false;
    Index num_infinite = 0;
    const auto discard = [&] {
      for (const Index cell : created_) cells_.release(cell);
      created_.clear();
    };
    try {
      for (std::size_t c = 0; c < found_.size(); ++c)
        num_infinite += write_cell(c) ? 1 : 0;  // those are infinite
      const bool reaches_hull = hole_.num_finite() < hole_.num_cells();
      is_right = (num_infinite == 0 || reaches_hull) && found_.are_matches_right(hole_) &&
                 create_functionals() &&
                 (is_known || (found_.have_all_vertices(hole_) && is_delaunay(num_infinite > 0, counts)));
    } catch (...) {
      discard();
      throw;
    }
    if (!is_right) {
      discard();
      return std::nullopt;
    }
    for (std::size_t f = 0; f < hole_.border().size(); ++f) {
      const BorderFacet& facet = hole_.border()[f];
      cells_.neighbors(facet.survivor)[facet.mirror] = created_[found_.cell_of(found_.beyond_border(f))];
    }
    for (std::size_t i = 0; i < zone.num_cells; ++i) {
      zone.num_infinite += geometry_.is_infinite(zone.cells[i]) ? 1 : 0;
      cells_.release(zone.cells[i]);
    }
    return Filling{found_.size(), num_infinite, created_.front()};
  }

  void prepare() {
    rows_.resize((hole_.vertices().size() + 1) * width());
    double* row = rows_.data();
    for (const Index v : hole_.vertices()) geometry_.write_row_of(v, row += width());
    written_.resize(found_.size() * width());
    finite_.clear();
    finite_.reserve(found_.size());
    simplices_.clear();
    simplices_.reserve(found_.size());
    orientations_.resize(found_.size());
  }

  bool write_cell(std::size_t c) {
    const Index cell = created_[c];
    const Index* const numbers = found_.vertices(c);
    Index* const written = written_.data() + c * width();
    Index* const neighbors = cells_.neighbors(cell);
    bool is_infinite = false;
    for (std::size_t i = 0; i < width(); ++i) {
      const std::uint32_t other = found_.beside(c * width() + i);
      is_infinite |= numbers[i] == 0;
      written[i] = numbers[i];
      neighbors[i] = other < found_.first_facet() ? hole_.border()[other].survivor
                                                  : created_[found_.cell_of(other - found_.first_facet())];
    }
    if (found_.is_odd(c)) {
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
  /// has a cell on both sides: if no vertex opposite a facet of the hole is in conflict with the cell beyond.
  /// Around a vertex that goes, that is so across the border, as survivors are in conflict with no vertex.
  /// Old and new cells have the same border, so new less old ones cover every point of the sphere equally
  /// often: never if none is infinite, as near infinity; else a vertex that is in none of them shows it. So
  /// all cells are a triangulation, and one that is locally Delaunay is Delaunay everywhere. Where vertices
  /// have moved, the old cells may have been anywhere, and who calls proves that (Settling).
  bool is_delaunay(bool has_infinite, StageCounts& counts) {
    const bool is_star = hole_.leaving() != invalid_index;
    for (std::uint32_t here = 0; here < found_.num_facets(); ++here) {
      const std::uint32_t other = found_.beside(here), there = other - found_.first_facet();
      const Index apex = found_.vertex_opposite(here);
      if (other < found_.first_facet()) {
        const BorderFacet& facet = hole_.border()[other];
        if (is_star ? hole_.id(apex) == cells_.vertex(facet.survivor, facet.mirror)
                    : !is_locally_delaunay(facet.survivor, apex, counts))
          return false;
      } else if (there < here) {
        if (!is_locally_delaunay(created_[found_.cell_of(there)], apex, counts)) return false;
      }
    }
    return !has_infinite || !is_star || is_outside_of_all(counts);
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
    return is_outside_exactly(cells_, geometry_, cell, hole_.id(apex), counts);
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
  Search search_;
  HoleCells<K> found_;
  bool is_exact_ = false;
  std::size_t looks_left_ = 0;
  std::vector<double> functions_;  // of finite cells that have been found
  std::vector<double> start_;
  std::vector<Index> source_, simplex_, contenders_;
  // The cells that have been created.
  std::vector<Index> created_, written_;
  std::vector<double> rows_;  // of vertices, by number
  std::vector<Index> finite_;
  std::vector<const Index*> simplices_;  // the numbers of their vertices
  std::vector<Sign> orientations_;
};

}  // namespace delone::engine
