// SPDX-License-Identifier: BSD-3-Clause
// The nearest vertex, by a walk over edges, and the exact comparison of distances.
//
// The region of a vertex v in the Voronoi or power diagram is the intersection of one halfspace per neighbor
// of v; the other sites add nothing (Aurenhammer 1987, doi:10.1137/0216006). So a vertex that is not nearest
// has a neighbor that is strictly nearer, and a walk from any vertex to strictly nearer neighbors ends at a
// nearest vertex. This also holds for a query outside the flat of the points: its squared distances differ
// from those of its projection by a constant. The vertices nearest to a query are those of one Delaunay face,
// whose edges connect them, so a search over edges between equally near vertices finds all of them.
//
// The k nearest, in the order of power and then row: a best-first search over edges that starts from all
// vertices that are nearest. Let S be the first vertices of the order, all that are nearest among them, and v
// the next one. Then v has a neighbor in S, so the least candidate among the neighbors of S is v. For suppose
// that it has none. Then all neighbors of v come after it, and none is strictly nearer to the query. The
// lifted surface is convex and linear on cells: a linear function that touches it at v, and is nowhere above
// it at the neighbors of v, is nowhere above it at all. So no vertex is strictly nearer than v, and v is
// itself among those that are nearest, which are in S. This uses convexity only, and holds for power and for
// ties of any kind.
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "base/spread.hpp"
#include "base/stamped_table.hpp"
#include "queries/point_locator_impl.hpp"
#include "queries/powers.hpp"

#include <delone/arithmetic.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <unordered_set>

namespace delone {

using queries::certainly_less;
using queries::compare_exactly;
using queries::power;
using queries::Power;

namespace {

class Nearest {
 public:
  Nearest(const PointLocator::Impl& where, const PointLocator::Edges& edges)
      : where_(where), edges_(edges), d_(static_cast<std::size_t>(where.dimension)) {}

  VertexId operator()(const double* q, VertexId start) {
    VertexId best = start;
    Power least = power_of(q, best);
    for (bool moved = true; moved;) {
      internal::cancellation_point();
      moved = false;
      ties_.clear();
      for (const VertexId v : neighbors(best)) {
        const Power at = power_of(q, v);
        if (certainly_less(least, at, d_)) continue;
        const Sign sign = certainly_less(at, least, d_) ? Sign::negative : compare(q, v, best);
        if (sign == Sign::zero) ties_.push_back(v);
        if (sign != Sign::negative) continue;
        best = v;
        least = at;
        moved = true;
        break;
      }
    }
    return ties_.empty() ? best : first_of_ties(q, best);
  }

  /// The `count` nearest vertices, or all if there are fewer. `nearest`: the first of them.
  std::span<const VertexId> several(const double* q, VertexId nearest, std::size_t count) {
    found_.clear();
    candidates_.clear();
    seen_.clear();
    // As the order of the heap it puts the first one on top.
    const auto later = [&](const Candidate& a, const Candidate& b) { return is_later(q, a, b); };
    const auto add = [&](VertexId v) {
      if (!seen_.insert(index(v), 0).second) return;
      candidates_.push_back({power_of(q, v), v});
      std::push_heap(candidates_.begin(), candidates_.end(), later);
    };
    for (const VertexId v : all_as_near_as(q, nearest)) add(v);
    while (found_.size() < count && !candidates_.empty()) {
      internal::cancellation_point();
      std::pop_heap(candidates_.begin(), candidates_.end(), later);
      found_.push_back(candidates_.back().vertex);
      candidates_.pop_back();
      if (found_.size() == count) break;
      for (const VertexId v : neighbors(found_.back())) add(v);
    }
    return found_;
  }

 private:
  struct Candidate {
    Power at;
    VertexId vertex;
  };
  /// Whether a comes after b in the order of power and row.
  bool is_later(const double* q, const Candidate& a, const Candidate& b) const {
    if (certainly_less(a.at, b.at, d_)) return false;
    if (certainly_less(b.at, a.at, d_)) return true;
    const Sign sign = compare(q, a.vertex, b.vertex);
    if (sign != Sign::zero) return sign == Sign::positive;
    return where_.triangulation.row_of(a.vertex) > where_.triangulation.row_of(b.vertex);
  }

  double weight(VertexId v) const { return where_.points.weighted() ? where_.point(v)[d_] : 0.0; }
  Power power_of(const double* q, VertexId v) const { return power(q, where_.point(v), d_, weight(v)); }
  Sign compare(const double* q, VertexId a, VertexId b) const {
    return compare_exactly(q, where_.point(a), where_.point(b), d_, weight(a), weight(b));
  }

  /// Among all vertices as near as `best` the one with the smallest row.
  VertexId first_of_ties(const double* q, VertexId best) {
    const std::vector<VertexId> found = all_as_near_as(q, best);
    return *std::min_element(found.begin(), found.end(), [&](VertexId a, VertexId b) {
      return where_.triangulation.row_of(a) < where_.triangulation.row_of(b);
    });
  }

  /// All vertices as near as `best`, a nearest one, found over edges between them.
  std::vector<VertexId> all_as_near_as(const double* q, VertexId best) const {
    std::vector<VertexId> found{best};
    std::unordered_set<Index> seen{index(best)};
    for (std::size_t next = 0; next < found.size(); ++next) {
      internal::cancellation_point();
      for (const VertexId v : neighbors(found[next])) {
        if (!seen.insert(index(v)).second) continue;
        if (!certainly_less(power_of(q, best), power_of(q, v), d_) && compare(q, v, best) == Sign::zero)
          found.push_back(v);
      }
    }
    return found;
  }

  std::span<const VertexId> neighbors(VertexId v) const {
    const std::size_t first = edges_.offsets[index(v)];
    return std::span(edges_.vertices).subspan(first, edges_.offsets[index(v) + 1] - first);
  }

  const PointLocator::Impl& where_;
  const PointLocator::Edges& edges_;
  std::size_t d_;
  std::vector<VertexId> ties_;
  // Of several():
  std::vector<Candidate> candidates_;
  std::vector<VertexId> found_;
  internal::StampedTable seen_;
};

}  // namespace

Sign compare_distances(std::span<const double> q, std::span<const double> a, std::span<const double> b,
                       double weight_a, double weight_b) {
  const ArithmeticScope arithmetic;
  if (a.size() != q.size() || b.size() != q.size())
    throw Error(Errc::bad_dimension, "points of different dimensions");
  const auto all_finite = [](std::span<const double> x) {
    return std::all_of(x.begin(), x.end(), [](double y) { return std::isfinite(y); });
  };
  if (!all_finite(q) || !all_finite(a) || !all_finite(b) || !std::isfinite(weight_a) ||
      !std::isfinite(weight_b))
    throw Error(Errc::not_finite, "a coordinate or weight is not finite");
  const Power at_a = power(q.data(), a.data(), q.size(), weight_a),
              at_b = power(q.data(), b.data(), q.size(), weight_b);
  if (certainly_less(at_a, at_b, q.size())) return Sign::negative;
  if (certainly_less(at_b, at_a, q.size())) return Sign::positive;
  return compare_exactly(q.data(), a.data(), b.data(), q.size(), weight_a, weight_b);
}

/// Collects the cells of each vertex, then the neighbors of one vertex after the other.
const PointLocator::Edges& PointLocator::edges() const {
  const auto make = [this] {
    const Complex& complex = impl_->complex;
    const std::size_t slots = std::max<std::size_t>(complex.num_vertex_slots(), 1);
    std::vector<std::size_t> first;
    std::vector<CellId> cells;
    internal::QuickRounds round;
    internal::spread(slots, first, cells, [&](const auto& put) {
      for (const CellId c : complex.finite_cells()) {
        round();
        for (int i = 0; i <= complex.affine_dimension(); ++i) put(index(complex.vertex(c, i)), c);
      }
    });
    Edges edges;
    edges.offsets.reserve(slots + 1);
    edges.offsets.push_back(0);
    std::vector<Index> seen_from(slots, 0);
    for (std::size_t v = 0; v < slots; ++v) {
      internal::cancellation_point();
      const std::size_t begin = edges.vertices.size();
      for (std::size_t i = first[v]; i < first[v + 1]; ++i)
        for (int j = 0; j <= complex.affine_dimension(); ++j) {
          const VertexId other = complex.vertex(cells[i], j);
          if (index(other) == v || seen_from[index(other)] == v) continue;
          seen_from[index(other)] = static_cast<Index>(v);
          edges.vertices.push_back(other);
        }
      std::sort(edges.vertices.begin() + static_cast<std::ptrdiff_t>(begin), edges.vertices.end());
      edges.offsets.push_back(edges.vertices.size());
    }
    edges.vertices.shrink_to_fit();
    impl_->edges = std::move(edges);
  };
  try {
    std::call_once(impl_->edges_once, make);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the edges");
  }
  return impl_->edges;
}

/// Calls each(search, query, nearest vertex) for all queries; without a vertex, each(nullptr, query,
/// invalid_vertex).
template <class Each>
void PointLocator::each_nearest(std::span<const double> queries, const Execution& how, Each each) const {
  const ArithmeticScope arithmetic;
  const internal::ProgressMeter meter(how.progress);
  if (impl_->points.form == kernel::RowForm::furthest_point)
    throw Error(Errc::unsupported,
                "the vertex of least distance is not found by a furthest-site triangulation");
  const auto d = static_cast<std::size_t>(impl_->dimension);
  if (impl_->triangulation.num_vertices() == 0) {
    locate(queries, [&](std::size_t query, const LocatedPoint&) {
      each(static_cast<Nearest*>(nullptr), query, invalid_vertex);
    });
    return;
  }
  // The vertices of the cell that contains a query are near it. If the points lie in a flat and there is no
  // such cell, the walk starts at the answer to the previous query.
  struct Walk {
    Nearest to;
    VertexId start;
  };
  const Edges& table = edges();
  const auto make_visit = [&]() -> Visit {
    const auto walk = std::shared_ptr<Walk>(new Walk{Nearest(*impl_, table), invalid_vertex});
    return [&, walk](std::size_t query, const LocatedPoint& where) {
      const double* q = queries.data() + query * d;
      VertexId& start = walk->start;
      if (where.cell != invalid_cell) {
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= impl_->affine_dimension; ++i) {
          const VertexId v = impl_->complex.vertex(where.cell, i);
          if (v == infinite_vertex) continue;
          const double at =
              power(q, impl_->point(v), d, impl_->points.weighted() ? impl_->point(v)[d] : 0.0).value;
          if (start == invalid_vertex || at < least) {
            start = v;
            least = at;
          }
        }
      } else if (start == invalid_vertex) {
        start = impl_->complex.finite_vertices().front();
      }
      start = walk->to(q, start);
      each(&walk->to, query, start);
    };
  };
  impl_->locate(queries, {}, {.threads = how.threads, .least_part = 1024}, {.make = make_visit});
}

void PointLocator::nearest(std::span<const double> queries,
                           const std::function<void(std::size_t query, VertexId nearest)>& visit,
                           const Execution& how) const {
  each_nearest(queries, how, [&](Nearest*, std::size_t query, VertexId v) { visit(query, v); });
}

void PointLocator::nearest(
    std::span<const double> queries, std::size_t k,
    const std::function<void(std::size_t query, std::span<const VertexId> nearest)>& visit,
    const Execution& how) const {
  if (k == 0) throw Error(Errc::invalid_argument, "k, the number of nearest vertices, is at least 1, not 0");
  const auto d = static_cast<std::size_t>(impl_->dimension);
  each_nearest(queries, how, [&](Nearest* search, std::size_t query, VertexId v) {
    if (search == nullptr)
      visit(query, {});
    else
      visit(query, search->several(queries.data() + query * d, v, k));
  });
}

}  // namespace delone
