// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries by a certified visibility walk. The nearest vertex is in nearest_vertex.cpp.
#include "base/quick_rounds.hpp"
#include "queries/point_locator_impl.hpp"

#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "queries/barycentric.hpp"
#include "queries/table_walk.hpp"
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
  static constexpr std::size_t least_many = std::numeric_limits<std::size_t>::max();
  template <class Answer>
  bool locate(const double*, CellId, Answer) {
    return false;
  }
  template <class Answer, class BeyondRange>
  CellId locate_all(const double*, std::span<const Index>, CellId start, Answer, BeyondRange) {
    return start;
  }
};

template <class Table>
void walk_through(const PointLocator::Impl& where, Table table, std::span<const double> queries,
                  const LocateOptions& options, internal::TolerantLocation* tolerant,
                  const PointLocator::Visit& visit) {
  PlainWalk plain(where);
  CellId start = invalid_cell;
  const double* const coordinates = queries.data();
  const auto width = static_cast<std::size_t>(where.dimension);
  internal::QuickRounds round;
  const auto answer = [&](Index query, LocatedPoint& found, auto complete) {
    round();
    const double* const exact = found.barycentric.data();
    if (tolerant != nullptr && !tolerant->is_final(found))
      tolerant->refine(coordinates + static_cast<std::size_t>(query) * width, found);
    if (options.coordinates && found.barycentric.data() == exact) complete();
    visit(query, found);
  };
  const auto walk_plainly = [&](const double* q, CellId from, LocatedPoint& found) {
    plain.locate(q, from, found);
  };
  where.in_pieces(queries, [&](std::span<const Index> piece) {
    if (piece.size() >= Table::least_many) {
      start = table.locate_all(coordinates, piece, start, answer, walk_plainly);
      return;
    }
    for (const Index query : piece) {
      const double* const q = coordinates + static_cast<std::size_t>(query) * width;
      const auto take = [&](LocatedPoint& found, auto complete) {
        if (found.cell != invalid_cell) {
          const int infinite = where.complex.infinite_index(found.cell);
          start = infinite < 0 ? found.cell : where.complex.neighbor(found.cell, infinite);
        }
        answer(query, found, complete);
      };
      if (table.locate(q, start, take)) continue;
      LocatedPoint found;
      plain.locate(q, start, found);
      take(found, [] {});
    }
  });
}

template <int K>
void dispatch(const PointLocator::Impl& where, std::span<const double> queries, const LocateOptions& options,
              internal::TolerantLocation* tolerant, const PointLocator::Visit& visit) {
  if (where.affine_dimension != where.dimension || where.dimension > largest_table)
    return walk_through(where, NoTable{}, queries, options, tolerant, visit);
  if constexpr (K < largest_table)
    if (where.dimension > K) return dispatch<K + 1>(where, queries, options, tolerant, visit);
  walk_through(where, internal::TableWalk<K>(where), queries, options, tolerant, visit);
}

}  // namespace

void PointLocator::locate(std::span<const double> queries, const Visit& visit) const {
  locate(queries, {}, visit);
}

void PointLocator::locate(std::span<const double> queries, const LocateOptions& options,
                          const Visit& visit) const {
  internal::require_tolerance(options.tolerance);
  if (options.tolerance > 0)
    internal::require_tolerance_within(options.tolerance, impl_->longest_side(),
                                       "the set of points, whose longest side is");
  try {
    if (options.tolerance == 0 && !options.project)
      return dispatch<1>(*impl_, queries, options, nullptr, visit);
    const auto thick = impl_->thick_cells(options.tolerance);
    internal::TolerantLocation tolerant(*impl_, options, thick.get());
    dispatch<1>(*impl_, queries, options, &tolerant, visit);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the queries");
  }
}

void PointLocator::cells_within(std::span<const double> queries, double radius,
                                const std::function<bool(std::size_t, CellId)>& visit) const {
  internal::require_tolerance(radius);
  internal::TolerantLocation near(*impl_, {.tolerance = radius}, nullptr);
  const auto width = static_cast<std::size_t>(impl_->dimension);
  const auto look_around = [&](std::size_t query, const LocatedPoint& found) {
    near.visit_near(queries.data() + query * width, found, [&](CellId cell) { return visit(query, cell); });
  };
  locate(queries, {.coordinates = false}, look_around);
}

double PointLocator::Impl::longest_side() const {
  std::call_once(side_once, [&] {
    const std::vector<VertexId> vertices = complex.finite_vertices();
    for (std::size_t j = 0; j < static_cast<std::size_t>(dimension) && !vertices.empty(); ++j) {
      double low = point(vertices[0])[j], high = low;
      for (const VertexId v : vertices) {
        low = std::min(low, point(v)[j]);
        high = std::max(high, point(v)[j]);
      }
      side = std::max(side, high - low);
    }
  });
  return side;
}

std::shared_ptr<const internal::ThickCells> PointLocator::Impl::thick_cells(double tolerance) const {
  if (tolerance == 0) return nullptr;
  const std::lock_guard lock(thick_mutex);
  if (!thick || thick->tolerance() != tolerance)
    thick = std::make_shared<const internal::ThickCells>(complex.num_cell_slots(), tolerance);
  return thick;
}

}  // namespace delone
