// SPDX-License-Identifier: BSD-3-Clause
// The implementation of HullBoundary for one dimension: joins engine/ and geometry/.
#pragma once

#include "compiled/boundary_cells.hpp"
#include "compiled/hull_engine.hpp"
#include "engine/build.hpp"
#include "engine/seed.hpp"
#include "geometry/hull_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace delone::internal {

template <int K>
class HullBoundaryOfDimension final : public HullBoundary {
  using Query = typename geometry::HullGeometry<K>::Query;

 public:
  HullBoundaryOfDimension(const HullSites& sites, const HullView& view, std::vector<Index> simplex)
      : HullBoundaryOfDimension(sites, view, std::move(simplex), nullptr) {
    std::vector<Index> vertices = vertices_of(simplex_);
    const Index last = vertices.back();
    vertices.pop_back();
    StageCounts uncounted;
    if (geometry_.side(vertices.data(), geometry_.point(last), uncounted) == Sign::negative)
      std::swap(vertices[0], vertices[1]);
    engine::seed(cells_, geometry_, vertices, last);
    effort_.created_cells = cells_.num_cells();
  }

  Insertion insert(Index site) override {
    const Index v = site + 1;
    const auto q = geometry_.make_query(sites_.point(site));
    if (view_.is_inside) {
      if (walk(q) == Sign::positive) return Insertion::interior;
      if (engine::insert(cells_, geometry_, v, q, work_.last_cell, work_, effort_) == invalid_index) {
        // q is in the cone of the cell where the walk ended.
        const auto h = geometry_.evaluator(q);
        return h.value(work_.last_cell) > h.threshold(work_.last_cell) ? Insertion::interior
                                                                       : Insertion::hidden;
      }
    } else {
      const Index cell = find_conflict(cells_, geometry_, q, effort_.stages);
      if (cell == invalid_index) return Insertion::hidden;
      engine::insert_in_conflict(cells_, geometry_, v, q, cell, work_, effort_);
    }
    work_.last_cell = work_.star().back().created;
    return Insertion::vertex;
  }

  bool is_surely_interior(Index site) override {
    return view_.is_inside && walk(geometry_.make_query(sites_.point(site))) == Sign::positive;
  }

  void update_box() override {
    geometry_.set_box(view_.low.data(), view_.high.data());
    create_functionals(cells_, geometry_);
  }

  std::unique_ptr<HullBoundary> copy(const HullSites& sites, const HullView& view) const override {
    return std::unique_ptr<HullBoundary>(new HullBoundaryOfDimension(sites, view, simplex_, this));
  }

  SimplicialHull to_simplicial_hull() const override { return simplicial_hull_of(cells_); }

  std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const override {
    std::vector<std::pair<Index, Index>> pairs;
    StageCounts uncounted;
    const auto is_certainly_inside = [&](Index cell, Index vertex) {
      const auto q = geometry_.make_query(geometry_.point(vertex));
      const auto h = geometry_.evaluator(q);
      return h.value(cell) > h.threshold(cell);
    };
    constexpr std::size_t ahead = 4;  // cells whose neighbors are on the way from memory
    for (Index c = 0; c < hull.num_cells(); ++c) {
      const Index cell = hull.slots[c];
      if (c + ahead < hull.num_cells()) cells_.prefetch_neighbors(hull.slots[c + ahead]);
      for (int i = 0; i <= cells_.dimension(); ++i) {
        const Index across = cells_.neighbors(cell)[i];
        if (across < cell) continue;
        const Index opposite = cells_.vertex(across, cells_.slot_of_neighbor(across, cell));
        // One cell is convex at the ridge iff the other is.
        if (is_certainly_inside(cell, opposite) || is_certainly_inside(across, cells_.vertex(cell, i)))
          continue;
        const auto vertices = cells_.vertices(cell);
        if (geometry_.side(vertices, geometry_.point(opposite), uncounted) == Sign::zero)
          pairs.emplace_back(c, hull.neighbors_of(c)[static_cast<std::size_t>(i)]);
      }
    }
    return pairs;
  }

  Sign certain_side(Index slot, const double* point) const override {
    const auto q = geometry_.make_query(point);
    const auto h = geometry_.evaluator(q);
    const double value = h.value(slot), threshold = h.threshold(slot) * reach(q);
    return value > threshold ? Sign::positive : value < -threshold ? Sign::negative : Sign::zero;
  }

  std::pair<Index, Sign> descend(const double* point, const std::vector<Index>& starts) const override {
    const auto q = geometry_.make_query(point);
    const auto h = geometry_.evaluator(q);
    const Index start = *std::min_element(starts.begin(), starts.end(),
                                          [&](Index a, Index b) { return h.value(a) < h.value(b); });
    const auto [outcome, walk] = engine::descend(cells_, geometry_, q, start);
    if (reach(q) > 1)
      return {walk.cell, certain_side(walk.cell, point) == Sign::negative ? Sign::negative : Sign::zero};
    return {walk.cell, certain_sign(outcome, q, walk.cell)};
  }

  const engine::Effort& effort() const override { return effort_; }
  std::size_t bytes() const override { return cells_.bytes(); }

 private:
  /// An empty boundary, or a copy.
  HullBoundaryOfDimension(const HullSites& sites, const HullView& view, std::vector<Index> simplex,
                          const HullBoundaryOfDimension* other)
      : sites_(sites),
        view_(view),
        simplex_(std::move(simplex)),
        memory_(static_cast<int>(sites.axes.size()) - 1, ids_for(sites.size())),
        cells_(memory_),
        geometry_(memory_, sites.axes, sites.ambient, sites.coordinates, view.grid, view.center,
                  view.is_inside, vertices_of(simplex_)) {
    geometry_.set_box(view.low.data(), view.high.data());
    if (other == nullptr) return;
    memory_.copy(other->memory_, other->cells_.num_slots());
    cells_.copy_slots(other->cells_);
    work_.last_cell = other->work_.last_cell;
    effort_ = other->effort_;
  }

  /// What a descent that ended in `cell` has proved: − q is beyond some cell, + it is in the interior of the
  /// hull.
  Sign certain_sign(engine::Descent outcome, const Query& q, Index cell) const {
    if (outcome == engine::Descent::conflict) return Sign::negative;
    return outcome == engine::Descent::hidden || is_above_plateau(q, cell) ? Sign::positive : Sign::zero;
  }
  /// Walks towards q from where the last walk ended.
  Sign walk(const Query& q) {
    const auto [outcome, walk] = engine::descend(cells_, geometry_, q, work_.last_cell);
    work_.last_cell = walk.cell;
    return certain_sign(outcome, q, walk.cell);
  }

  /// Whether q is in the interior for certain, by the cells around one whose functional is nearly the least
  /// at q: cells of one facet of the polytope have equal functionals, of which the descent knows no least.
  ///
  /// A set of cells is collected until each neighbor outside of it is certainly greater than the cell of the
  /// set it is a neighbor of. The cell of the set that is truly the least then has no lesser neighbor, nor
  /// has any cell of its facet, all of which are in the set; so it is the least of all (a local minimum of a
  /// linear function on the polar polytope), and positive as all of the set are.
  bool is_above_plateau(const Query& q, Index cell) const {
    constexpr std::size_t most_cells = 32;
    std::array<Index, most_cells> plateau{cell};
    std::size_t size = 1;
    const auto h = geometry_.evaluator(q);
    for (std::size_t next = 0; next < size; ++next) {
      const double value = h.value(plateau[next]), threshold = h.threshold(plateau[next]);
      if (!(value > threshold)) return false;
      const Index* neighbors = cells_.neighbors(plateau[next]);
      for (int i = 0; i <= cells_.dimension(); ++i) {
        if (h.value(neighbors[i]) - h.threshold(neighbors[i]) > value + threshold) continue;
        const auto end = plateau.begin() + static_cast<std::ptrdiff_t>(size);
        if (std::find(plateau.begin(), end, neighbors[i]) != end) continue;
        if (size == most_cells) return false;
        plateau[size++] = neighbors[i];
      }
    }
    return true;
  }

  /// Thresholds are for rows in [−1, 1]. Functionals are off by a linear function of the row, and evaluations
  /// round in proportion to it, so for a row outside the threshold grows by this factor.
  double reach(const Query& q) const {
    double largest = 1;
    for (std::size_t r = 0; r < sites_.axes.size(); ++r)
      if (const double x = std::fabs(q.row[r]); !(x <= largest)) largest = x;
    return largest > 1 ? largest * (1 + 0x1p-50) : 1;
  }

  const HullSites& sites_;
  const HullView& view_;
  std::vector<Index> simplex_;
  CellMemory<K> memory_;
  engine::CellStore<K> cells_;
  geometry::HullGeometry<K> geometry_;
  engine::Workspace work_;
  engine::Effort effort_;
};

template <int K>
std::unique_ptr<HullBoundary> make_hull_boundary(const HullSites& sites, const HullView& view,
                                                 std::vector<Index> simplex) {
  return std::make_unique<HullBoundaryOfDimension<K>>(sites, view, std::move(simplex));
}

}  // namespace delone::internal
