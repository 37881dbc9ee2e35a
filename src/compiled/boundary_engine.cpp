// SPDX-License-Identifier: BSD-3-Clause
#include "compiled/boundary_engine.hpp"

#include "base/compiled_dimension.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "compiled/boundary_engine_of.hpp"
#include "engine/locate.hpp"

#include <algorithm>
#include <cmath>

namespace delone::compiled {
namespace {

/// The largest dimension of cells that the engine is compiled for.
constexpr int largest_dimension_of_cells = internal::largest_compiled_dimension - 1;

template <class Ask>
decltype(auto) visit(const BoundaryEngine& boundary, Ask&& ask) {
  return visit<BoundaryEngineOf, largest_dimension_of_cells>(boundary, std::forward<Ask>(ask));
}

/// Thresholds are for rows in [−1, 1]. Functionals are off by a linear function of the row, and evaluations
/// round in proportion to it, so for a row outside the threshold grows by this factor.
template <class Geometry>
double reach(const Geometry& geometry, const typename Geometry::Query& q) {
  double largest = 1;
  for (int r = 0; r <= geometry.dimension(); ++r)
    if (const double x = std::fabs(q.row[static_cast<std::size_t>(r)]); !(x <= largest)) largest = x;
  return largest > 1 ? largest * (1 + 0x1p-50) : 1;
}

template <class Geometry>
Sign certain_side_of(const Geometry& geometry, Index slot, const typename Geometry::Query& q, double reach) {
  const auto h = geometry.evaluator(q);
  const double value = h.value(slot), threshold = h.threshold(slot) * reach;
  return value > threshold ? Sign::positive : value < -threshold ? Sign::negative : Sign::zero;
}

/// By exact stages alone.
template <class Instance>
Sign exact_side_of(const Instance& instance, Index slot, const double* row) {
  internal::StageCounts uncounted;
  const auto vertices = instance.cells().vertices(slot);
  return instance.geometry().side(vertices, row, uncounted);
}

}  // namespace

std::unique_ptr<BoundaryEngine> make_boundary_engine(const BoundarySites& sites, const CentralView& view,
                                                     const std::vector<Index>& simplex) {
  return internal::with_compiled_dimension<1, largest_dimension_of_cells>(
      static_cast<std::size_t>(sites.dimension() - 1),
      [&](auto k) { return make_boundary_engine_of<k()>(sites, view, simplex); });
}

/// The cells are numbered without gaps; their vertices are sites.
SimplicialHull simplicial_hull_of(const BoundaryEngine& boundary) {
  return visit(boundary, [&](const auto& instance) {
    const auto& cells = instance.cells();
    SimplicialHull hull;
    const std::size_t k = static_cast<std::size_t>(cells.dimension()) + 1;
    hull.dimension = static_cast<int>(k);
    std::vector<Index> compact(cells.num_slots(), invalid_index);
    hull.slots.reserve(cells.num_cells());
    for (Index cell = 0; cell < cells.num_slots(); ++cell) {
      internal::cancellation_point();
      if (cells.is_vacant(cell)) continue;
      compact[cell] = static_cast<Index>(hull.slots.size());
      hull.slots.push_back(cell);
    }
    hull.cells.resize(hull.slots.size() * k);
    hull.neighbors.resize(hull.slots.size() * k);
    Index *vertex = hull.cells.data(), *neighbor = hull.neighbors.data();
    for (const Index cell : hull.slots) {
      internal::cancellation_point();
      for (std::size_t i = 0; i < k; ++i) {
        *vertex++ = cells.vertex(cell, static_cast<int>(i)) - 1;
        *neighbor++ = compact[cells.neighbors(cell)[i]];
      }
    }
    return hull;
  });
}

const engine::Effort& effort_of(const BoundaryEngine& boundary) {
  return visit(boundary,
               [](const auto& instance) -> const engine::Effort& { return instance.sphere().effort(); });
}

std::size_t bytes_of(const BoundaryEngine& boundary) {
  return visit(boundary, [](const auto& instance) { return instance.cells().bytes(); });
}

bool shares_batches_of(const BoundaryEngine& boundary, std::size_t num_vertices) {
  return visit(boundary, [&](const auto& instance) { return shares_batches_of(instance, num_vertices); });
}

std::vector<std::pair<Index, Index>> coplanar_neighbors(const BoundaryEngine& boundary,
                                                        const SimplicialHull& hull) {
  return visit(boundary, [&](const auto& instance) {
    const auto& cells = instance.cells();
    const auto& geometry = instance.geometry();
    std::vector<std::pair<Index, Index>> pairs;
    const auto is_certainly_inside = [&](Index cell, Index vertex) {
      const auto h = geometry.evaluator_at(vertex);
      return h.value(cell) > h.threshold(cell);
    };
    constexpr std::size_t ahead = 4;  // cells whose neighbors are on the way from memory
    for (Index c = 0; c < hull.num_cells(); ++c) {
      internal::cancellation_point();
      const Index cell = hull.slots[c];
      if (c + ahead < hull.num_cells()) cells.prefetch_neighbors(hull.slots[c + ahead]);
      for (int i = 0; i <= cells.dimension(); ++i) {
        const Index across = cells.neighbors(cell)[i];
        if (across < cell) continue;
        const Index opposite = cells.vertex(across, cells.slot_of_neighbor(across, cell));
        // One cell is convex at the ridge iff the other is.
        if (is_certainly_inside(cell, opposite) || is_certainly_inside(across, cells.vertex(cell, i)))
          continue;
        if (exact_side_of(instance, cell, geometry.point(opposite)) == Sign::zero)
          pairs.emplace_back(c, hull.neighbors_of(c)[static_cast<std::size_t>(i)]);
      }
    }
    return pairs;
  });
}

void find_surely_interior(const BoundaryEngine& boundary, std::span<const Index> sites,
                          std::span<char> is_interior, unsigned threads) {
  constexpr std::size_t part = 1024;
  visit(boundary, [&](const auto& instance) {
    const auto& geometry = instance.geometry();
    if (!geometry.can_walk()) {
      std::fill(is_interior.begin(), is_interior.end(), 0);
      return;
    }
    internal::work_in_parts(threads, sites.size(), part, [&] {
      return [&, from = instance.sphere().last_cell()](std::size_t first, std::size_t last,
                                                       const internal::StopPoint& stop) mutable {
        for (std::size_t i = first; i < last; ++i) {
          stop();
          const auto [outcome, near] =
              engine::approach(instance.cells(), geometry, geometry.query_at(sites[i] + 1), from);
          from = near.cell;
          is_interior[i] = outcome == engine::Descent::hidden ? 1 : 0;
        }
      };
    });
  });
}

Sign side_of_slot(const BoundaryEngine& boundary, Index slot, Index site) {
  return visit(boundary, [&](const auto& instance) {
    const auto q = instance.geometry().query_at(site + 1);
    const Sign sign = certain_side_of(instance.geometry(), slot, q, 1);
    return sign != Sign::zero ? sign : exact_side_of(instance, slot, q.point);
  });
}

std::optional<Index> slot_through(const BoundaryEngine& boundary, Index site) {
  return visit(boundary, [&](const auto& instance) -> std::optional<Index> {
    const auto& cells = instance.cells();
    const auto& geometry = instance.geometry();
    const auto q = geometry.query_at(site + 1);
    const auto is_on = [&](Index cell) { return exact_side_of(instance, cell, q.point) == Sign::zero; };
    if (geometry.can_walk()) {
      internal::StageCounts uncounted;
      const auto [outcome, near] = engine::approach(cells, geometry, q, instance.sphere().last_cell());
      if (outcome == engine::Descent::hidden) return std::nullopt;
      const Index cell = engine::walk_exactly(cells, geometry, q, near.cell, false, uncounted).cell;
      return is_on(cell) ? std::optional(cell) : std::nullopt;
    }
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      if (!cells.is_vacant(cell) && is_on(cell)) return cell;
    return std::nullopt;
  });
}

Sign certain_side(const BoundaryEngine& boundary, Index slot, const double* point) {
  return visit(boundary, [&](const auto& instance) {
    const auto q = instance.geometry().make_query(point);
    return certain_side_of(instance.geometry(), slot, q, reach(instance.geometry(), q));
  });
}

double hyperplane(const BoundaryEngine& boundary, Index slot, double* normal) {
  return visit(boundary, [&](const auto& instance) { return instance.geometry().hyperplane(slot, normal); });
}

std::pair<Index, Sign> descend(const BoundaryEngine& boundary, const double* point,
                               const std::vector<Index>& starts) {
  return visit(boundary, [&](const auto& instance) -> std::pair<Index, Sign> {
    const auto& cells = instance.cells();
    const auto& geometry = instance.geometry();
    const auto q = geometry.make_query(point);
    const auto h = geometry.evaluator(q);
    const Index start = *std::min_element(starts.begin(), starts.end(),
                                          [&](Index a, Index b) { return h.value(a) < h.value(b); });
    const double factor = reach(geometry, q);
    if (factor > 1) {  // not in the box
      const Index near = engine::descend(cells, geometry, q, start).second.cell;
      const bool is_beyond = certain_side_of(geometry, near, q, factor) == Sign::negative;
      return {near, is_beyond ? Sign::negative : Sign::zero};
    }
    const auto [outcome, walk] = engine::approach(cells, geometry, q, start);
    return {walk.cell, outcome == engine::Descent::conflict ? Sign::negative
                       : outcome == engine::Descent::hidden ? Sign::positive
                                                            : Sign::zero};
  });
}

}  // namespace delone::compiled
