// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries by a certified visibility walk. The nearest vertex is in nearest_vertex.cpp.
#include "queries/point_locator_impl.hpp"

#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "kernel/predicates.hpp"
#include "queries/barycentric.hpp"
#include "queries/cell_minors.hpp"
#include "queries/tolerant_location.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <string>

namespace delone {

PointLocator::PointLocator(const Triangulation& triangulation)
    : impl_(std::make_unique<Impl>(triangulation)) {}
PointLocator::PointLocator(PointLocator&&) noexcept = default;
PointLocator& PointLocator::operator=(PointLocator&&) noexcept = default;
PointLocator::~PointLocator() = default;

std::vector<Index> PointLocator::Impl::rows_of(std::span<const double> queries) const {
  const auto width = static_cast<std::size_t>(dimension);
  if (queries.size() % width != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  internal::require_finite(queries, width, "a coordinate", "query");
  const std::size_t count = queries.size() / width;
  if (count > max_index) throw Error(Errc::too_many, "more queries than this build has ids");
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

namespace {

constexpr int largest_table = 6;

/// The walk for k = d = K.
template <int K>
class TableWalk {
 public:
  explicit TableWalk(const PointLocator::Impl& where) : where_(where) {}

  /// Locates q, starting from a finite cell, any of them if `start` is invalid. Returns false if the numbers
  /// are beyond the range of CellMinors.
  bool locate(const double* q, CellId start, LocatedPoint& found) {
    CellId cell = start != invalid_cell ? start : *where_.complex.finite_cells().begin();
    const double* points[K + 1];
    for (;;) {
      for (int i = 0; i <= K; ++i) {
        const VertexId v = where_.complex.vertex(cell, i);
        if (v == infinite_vertex) {
          found = {Location::Kind::outside_hull, cell, {}, 0};
          return true;
        }
        points[i] = where_.point(v);
      }
      if (!minors_.evaluate(points, q)) return false;
      const int slot = facet_with_query_beyond(points, q);
      if (slot < 0) break;
      cell = where_.complex.neighbor(cell, slot);
    }
    found = {Location::Kind::in_cell, cell, finish(points, q), 0};
    const auto positive = std::count(signs_, signs_ + K + 1, Sign::positive);
    if (positive <= K) found.kind = positive == 1 ? Location::Kind::on_vertex : Location::Kind::on_face;
    return true;
  }

 private:
  /// A facet with q strictly beyond it, certain ones first; −1 if there is none, and then signs_ is exact.
  int facet_with_query_beyond(const double* const* points, const double* q) {
    int slot = -1;
    double least = -minors_.bound();
    bool uncertain = false;
    for (int i = 0; i <= K; ++i) {
      const double w = minors_.weight(i);
      uncertain = uncertain || w <= minors_.bound();
      if (w >= least) continue;
      least = w;
      slot = i;
    }
    if (slot >= 0) return slot;
    for (int i = 0; i <= K; ++i) signs_[i] = Sign::positive;
    if (!uncertain) return -1;
    for (int i = 0; i <= K; ++i) {
      if (minors_.weight(i) > minors_.bound()) continue;
      const double* moved[K + 1];
      std::copy_n(points, K + 1, moved);
      moved[i] = q;
      signs_[i] = kernel::orientation({K, where_.axes}, moved);
      if (signs_[i] == Sign::negative) return i;
    }
    return -1;
  }

  /// Each coordinate is off by at most the bound, and so is each one that is left out as zero or negative;
  /// their sum is off by at most K+1 times the bound. If that is too much, barycentric() solves the system of
  /// the cell.
  std::span<const double> finish(const double* const* points, const double* q) {
    double sum = 0;
    unsigned char on_face[K + 1];
    for (int i = 0; i <= K; ++i) {
      on_face[i] = signs_[i] == Sign::zero ? 0 : 1;
      weights_[i] = signs_[i] == Sign::zero ? 0 : std::max(minors_.weight(i), 0.0);
      sum += weights_[i];
    }
    if (!((K + 3) * minors_.bound() < internal::largest_weight_error * sum)) {
      internal::barycentric({points, K + 1}, on_face, where_.axes, q, solved_);
      return solved_;
    }
    for (int i = 0; i <= K; ++i)
      if (signs_[i] == Sign::positive)
        weights_[i] = std::max(weights_[i] / sum, std::numeric_limits<double>::min());
    return weights_;
  }

  const PointLocator::Impl& where_;
  internal::CellMinors<K> minors_;
  Sign signs_[K + 1];
  double weights_[K + 1];
  std::vector<double> solved_;
};

/// The walk of the triangulation itself: for flat input, more dimensions and extreme numbers.
class PlainWalk {
 public:
  explicit PlainWalk(const PointLocator::Impl& where) : where_(where) {}

  void locate(const double* q, CellId start, LocatedPoint& found) {
    const auto hint = start == invalid_cell ? std::nullopt : std::optional<CellId>(start);
    const Location location =
        where_.triangulation.locate(std::span(q, static_cast<std::size_t>(where_.dimension)), hint);
    found = {location.kind, location.cell, {}, 0};
    if (location.face.empty()) return;
    const VerticesOfCell vertices = where_.complex.vertices(location.cell);
    std::vector<const double*> points;
    std::vector<unsigned char> on_face;
    for (const VertexId v : vertices) {
      points.push_back(where_.point(v));
      on_face.push_back(std::find(location.face.begin(), location.face.end(), v) != location.face.end() ? 1
                                                                                                        : 0);
    }
    internal::barycentric(points, on_face, where_.axes, q, weights_);
    found.barycentric = weights_;
  }

 private:
  const PointLocator::Impl& where_;
  std::vector<double> weights_;
};

struct NoTable {
  bool locate(const double*, CellId, LocatedPoint&) { return false; }
};

template <class Table>
void walk_through(const PointLocator::Impl& where, Table table, std::span<const double> queries,
                  internal::TolerantLocation* tolerant, const PointLocator::Visit& visit) {
  PlainWalk plain(where);
  CellId start = invalid_cell;
  LocatedPoint found;
  where.in_order(queries, [&](Index query) {
    const double* q =
        queries.data() + static_cast<std::size_t>(query) * static_cast<std::size_t>(where.dimension);
    if (!table.locate(q, start, found)) plain.locate(q, start, found);
    if (found.cell != invalid_cell) {
      const int infinite = where.complex.infinite_index(found.cell);
      start = infinite < 0 ? found.cell : where.complex.neighbor(found.cell, infinite);
    }
    if (tolerant != nullptr && !tolerant->is_final(found)) tolerant->refine(q, found);
    visit(query, found);
  });
}

template <int K>
void dispatch(const PointLocator::Impl& where, std::span<const double> queries,
              internal::TolerantLocation* tolerant, const PointLocator::Visit& visit) {
  if (where.affine_dimension != where.dimension || where.dimension > largest_table)
    return walk_through(where, NoTable{}, queries, tolerant, visit);
  if constexpr (K < largest_table)
    if (where.dimension > K) return dispatch<K + 1>(where, queries, tolerant, visit);
  walk_through(where, TableWalk<K>(where), queries, tolerant, visit);
}

}  // namespace

void PointLocator::locate(std::span<const double> queries, const Visit& visit) const {
  locate(queries, {}, visit);
}

void PointLocator::locate(std::span<const double> queries, const LocateOptions& options,
                          const Visit& visit) const {
  internal::require_tolerance(options.tolerance);
  try {
    if (options.tolerance == 0 && !options.project) return dispatch<1>(*impl_, queries, nullptr, visit);
    const auto thick = impl_->thick_cells(options.tolerance);
    internal::TolerantLocation tolerant(*impl_, options, thick.get());
    dispatch<1>(*impl_, queries, &tolerant, visit);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the queries");
  }
}

void PointLocator::cells_within(std::span<const double> queries, double radius,
                                const std::function<bool(std::size_t, CellId)>& visit) const {
  internal::require_tolerance(radius);
  internal::TolerantLocation near(*impl_, {.tolerance = radius}, nullptr);
  const auto width = static_cast<std::size_t>(impl_->dimension);
  locate(queries, [&](std::size_t query, const LocatedPoint& found) {
    near.visit_near(queries.data() + query * width, found, [&](CellId cell) { return visit(query, cell); });
  });
}

std::shared_ptr<const internal::ThickCells> PointLocator::Impl::thick_cells(double tolerance) const {
  if (tolerance == 0) return nullptr;
  const std::lock_guard lock(thick_mutex);
  if (!thick || thick->tolerance() != tolerance)
    thick = std::make_shared<const internal::ThickCells>(complex.num_cell_slots(), tolerance);
  return thick;
}

}  // namespace delone
