// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries by a certified visibility walk. The nearest vertex is in nearest_vertex.cpp.
#include "base/progress_meter.hpp"
#include "queries/point_locator_impl.hpp"

#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "queries/barycentric.hpp"
#include "queries/table_walk.hpp"
#include "queries/tolerant_location.hpp"

#include <delone/arithmetic.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
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
    // Cached functionals lead the walk, and what they round to depends on the order of insertion, which
    // several threads do not share. The face does not.
    if (location.kind != Location::Kind::in_cell && where_.affine_dimension <= largest_table)
      found.cell = first_cell_of(location.face);
    const VerticesOfCell vertices = where_.complex.vertices(found.cell);
    std::vector<const double*> points;
    std::vector<unsigned char> on_face;
    for (const VertexId v : vertices) {
      points.push_back(where_.point(v));
      on_face.push_back(std::find(location.face.begin(), location.face.end(), v) != location.face.end() ? 1
                                                                                                        : 0);
    }
    queries::barycentric(points, on_face, where_.axes, q, weights_);
    found.barycentric = weights_;
  }

 private:
  /// Of the finite cells that have a face, the one of the least id.
  CellId first_cell_of(const std::vector<VertexId>& face) const {
    const Complex& complex = where_.complex;
    CellId first = invalid_cell;
    for (const CellId cell : complex.star(face.front())) {
      const auto has = [&](VertexId v) { return complex.index_of(cell, v) >= 0; };
      if (!complex.is_infinite(cell) && (first == invalid_cell || cell < first) &&
          std::all_of(face.begin(), face.end(), has))
        first = cell;
    }
    return first;
  }

  const PointLocator::Impl& where_;
  std::vector<double> weights_;
};

struct NoTable {
  explicit NoTable(const PointLocator::Impl&) {}
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

/// The walks of one thread.
template <class Table>
class Walks {
 public:
  explicit Walks(const PointLocator::Impl& where) : where_(where), table_(where), plain_(where) {}

  /// Calls answer(query, found, complete) for each, as TableWalk.
  template <class Answer>
  void locate(std::span<const double> queries, std::span<const Index> rows, CellId start,
              const Answer& answer) {
    const double* const coordinates = queries.data();
    const auto width = static_cast<std::size_t>(where_.dimension);
    if (rows.size() >= Table::least_many) {
      table_.locate_all(
          coordinates, rows, start, answer,
          [&](const double* q, CellId from, LocatedPoint& found) { plain_.locate(q, from, found); });
      return;
    }
    for (const Index query : rows) {
      const double* const q = coordinates + static_cast<std::size_t>(query) * width;
      const auto take = [&](LocatedPoint& found, auto complete) {
        start = finite_cell(found.cell, start);
        answer(query, found, complete);
      };
      if (table_.locate(q, start, take)) continue;
      LocatedPoint found;
      plain_.locate(q, start, found);
      take(found, [] {});
    }
  }
  /// A finite cell at the query; `start` if there is none.
  CellId find(const double* q, CellId start) {
    CellId cell = start;
    const auto take = [&](const LocatedPoint& found, auto) { cell = finite_cell(found.cell, start); };
    if (table_.locate(q, start, take)) return cell;
    LocatedPoint found;
    plain_.locate(q, start, found);
    return finite_cell(found.cell, start);
  }

 private:
  CellId finite_cell(CellId cell, CellId otherwise) const {
    if (cell == invalid_cell) return otherwise;
    const int infinite = where_.complex.infinite_index(cell);
    return infinite < 0 ? cell : where_.complex.neighbor(cell, infinite);
  }

  const PointLocator::Impl& where_;
  Table table_;
  PlainWalk plain_;
};

/// The walks of one thread, what they keep for a tolerance, and who gets the answers.
template <class Table>
class Answering {
 public:
  Answering(const PointLocator::Impl& where, std::span<const double> queries, const LocateOptions& options,
            const queries::ThickCells* thick, const queries::Visits& visits)
      : walks_(where),
        queries_(queries),
        width_(static_cast<std::size_t>(where.dimension)),
        coordinates_(options.coordinates),
        own_(visits.make ? visits.make() : nullptr),
        shared_(visits.shared) {
    if (options.tolerance > 0 || options.project) tolerant_.emplace(where, options, thick);
  }

  void operator()(std::span<const Index> rows, CellId start, const internal::StopPoint& stop) {
    const PointLocator::Visit& visit = shared_ != nullptr ? *shared_ : own_;
    walks_.locate(queries_, rows, start, [&](Index query, LocatedPoint& found, auto complete) {
      stop();
      const double* const exact = found.barycentric.data();
      if (tolerant_ && !tolerant_->is_final(found))
        tolerant_->refine(queries_.data() + static_cast<std::size_t>(query) * width_, found);
      if (coordinates_ && found.barycentric.data() == exact) complete();
      visit(query, found);
    });
  }

 private:
  Walks<Table> walks_;
  std::span<const double> queries_;
  std::size_t width_;
  bool coordinates_;
  PointLocator::Visit own_;
  const PointLocator::Visit* shared_;
  std::optional<queries::TolerantLocation> tolerant_;
};

template <class Table>
void walk_through(const PointLocator::Impl& where, std::span<const double> queries,
                  const LocateOptions& options, const queries::BatchOptions& batch,
                  const queries::ThickCells* thick, const queries::Visits& visits) {
  Walks<Table> to_starts(where);
  where.in_parts(
      queries, batch, [&] { return Answering<Table>(where, queries, options, thick, visits); },
      [&](Index query, CellId start) {
        return to_starts.find(
            queries.data() + static_cast<std::size_t>(query) * static_cast<std::size_t>(where.dimension),
            start);
      });
}

template <int K>
void dispatch(const PointLocator::Impl& where, const auto&... arguments) {
  if (where.affine_dimension != where.dimension || where.dimension > largest_table)
    return walk_through<NoTable>(where, arguments...);
  if constexpr (K < largest_table)
    if (where.dimension > K) return dispatch<K + 1>(where, arguments...);
  walk_through<queries::TableWalk<K>>(where, arguments...);
}

}  // namespace

void PointLocator::locate(std::span<const double> queries, const LocateOptions& options, const Visit& visit,
                          const Execution& how) const {
  const ArithmeticScope arithmetic;
  const internal::ProgressMeter meter(how.progress);
  impl_->locate(queries, options, {.threads = how.threads}, {.shared = &visit});
}

void PointLocator::Impl::locate(std::span<const double> queries, const LocateOptions& options,
                                queries::BatchOptions batch, const queries::Visits& visits) const {
  internal::require_tolerance(options.tolerance);
  if (options.tolerance > 0)
    internal::require_tolerance_within(options.tolerance, longest_side(),
                                       "the set of points, whose longest side is");
  if (options.tolerance > 0 || options.project)
    batch.least_part = std::min<std::size_t>(batch.least_part, 512);
  try {
    const auto kinds = thick_cells(options.tolerance);
    dispatch<1>(*this, queries, options, batch, kinds.get(), visits);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the queries");
  }
}

void PointLocator::cells_within(std::span<const double> queries, double radius,
                                const std::function<bool(std::size_t, CellId)>& visit,
                                const Execution& how) const {
  const ArithmeticScope arithmetic;
  internal::require_tolerance(radius, "radius");
  const internal::ProgressMeter meter(how.progress);
  const auto width = static_cast<std::size_t>(impl_->dimension);
  const auto make_visit = [&]() -> Visit {
    const auto near =
        std::make_shared<queries::TolerantLocation>(*impl_, LocateOptions{.tolerance = radius}, nullptr);
    return [&, near](std::size_t query, const LocatedPoint& found) {
      near->visit_near(queries.data() + query * width, found,
                       [&](CellId cell) { return visit(query, cell); });
    };
  };
  impl_->locate(queries, {.coordinates = false}, {.threads = how.threads, .least_part = 512},
                {.make = make_visit});
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

std::shared_ptr<const queries::ThickCells> PointLocator::Impl::thick_cells(double tolerance) const {
  if (tolerance == 0) return nullptr;
  const std::lock_guard lock(thick_mutex);
  if (!thick || thick->tolerance() != tolerance)
    thick = std::make_shared<const queries::ThickCells>(complex.num_cell_slots(), tolerance);
  return thick;
}

}  // namespace delone
