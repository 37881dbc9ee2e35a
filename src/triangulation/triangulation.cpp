// SPDX-License-Identifier: BSD-3-Clause
// Triangulation: its members. Insertion is in triangulation_impl.cpp.
#include <delone/arithmetic.hpp>
#include <delone/triangulation.hpp>

#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "base/require_dimension.hpp"
#include "base/require_tolerance.hpp"
#include "complex/canonical_hash.hpp"
#include "triangulation/triangulation_impl.hpp"

#include <delone/cell_numbers.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace delone {

namespace {

kernel::RowForm form_of(TriangulationKind kind) {
  switch (kind) {
    case TriangulationKind::delaunay:
      return kernel::RowForm::point;
    case TriangulationKind::regular:
      return kernel::RowForm::weighted_point;
    case TriangulationKind::furthest_site:
      return kernel::RowForm::furthest_point;
  }
  throw Error(Errc::invalid_argument, "not a kind of triangulation");
}

}  // namespace

Triangulation::Triangulation(TriangulationKind kind, int dimension, const Options& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  internal::refuse_tolerance(options.tolerance, options.axis_tolerances, "triangulations");
  internal::require_time_limit(options.time_limit);
  impl_ = internal::guarded("the triangulation",
                            [&] { return std::make_unique<Impl>(dimension, form_of(kind), options); });
}
Triangulation::Triangulation(detail::Clone, const Triangulation& other)
    : impl_(internal::guarded("the triangulation", [&] { return other.impl_->clone(); })) {}
Triangulation::Triangulation(Triangulation&&) noexcept = default;
Triangulation& Triangulation::operator=(Triangulation&&) noexcept = default;
Triangulation::~Triangulation() = default;

TriangulationKind Triangulation::kind() const {
  return impl_->points().form == kernel::RowForm::point            ? TriangulationKind::delaunay
         : impl_->points().form == kernel::RowForm::weighted_point ? TriangulationKind::regular
                                                                   : TriangulationKind::furthest_site;
}

void Triangulation::insert_points(std::span<const double> coordinates, std::span<const double> weights,
                                  const std::function<void()>& release) {
  if (impl_->weighted() && weights.empty() && coordinates.size() >= impl_->ambient())
    throw Error(Errc::bad_dimension,
                "0 weights for " + std::to_string(coordinates.size() / impl_->ambient()) + " points");
  internal::guarded("the triangulation", [&] { impl_->insert_range(coordinates, weights, release); });
}

InsertResult Triangulation::insert_point(std::span<const double> point, double weight,
                                         std::optional<CellId> hint) {
  return internal::guarded("the triangulation", [&] { return impl_->insert(point, weight, hint); });
}

void Triangulation::apply(const RowEdits& edits) {
  internal::guarded("the edit", [&] {
    impl_->edit({edits.remove, edits.move, edits.reweight, edits.to, edits.weights, edits.insert,
                 edits.insert_weights});
  });
}

void Triangulation::remove(std::span<const std::size_t> rows) { apply({.remove = rows}); }

void Triangulation::record_changes(bool wanted) { impl_->record_changes(wanted); }

const Changes& Triangulation::changes() const {
  return internal::guarded("the lists of changes",
                           [&]() -> const Changes& { return impl_->recorded_changes().lists; });
}
const std::vector<CellId>& Triangulation::removed_infinite_cells() const {
  return internal::guarded("the lists of changes", [&]() -> const std::vector<CellId>& {
    return impl_->recorded_changes().removed_infinite_cells;
  });
}

void Triangulation::record_undo(bool wanted) { impl_->record_undo(wanted); }
void Triangulation::sort_cells_later(bool wanted) { impl_->recording.sorts_later = wanted; }

bool Triangulation::can_undo() const { return impl_->wanted_of_last.undo; }
void Triangulation::undo() {
  internal::guarded("what has changed", [&] { impl_->undo(); });
}

CompactedIds Triangulation::compact_ids() {
  return internal::guarded("other ids", [&] { return impl_->compact_ids(); });
}

void Triangulation::sort_cells() {
  internal::guarded("the cells in order", [&] { impl_->sort_cells(); });
}

void Triangulation::compact() {
  internal::guarded("a second copy of the cells", [&] { impl_->compact(); });
}

int Triangulation::dimension() const { return impl_->dimension(); }
int Triangulation::affine_dimension() const { return impl_->state->affine_hull.dimension(); }
std::size_t Triangulation::num_points() const { return impl_->sites().num_present_rows(); }
std::size_t Triangulation::num_rows() const { return impl_->sites().num_rows(); }
Index Triangulation::num_vertices() const { return impl_->state->num_vertices; }
std::size_t Triangulation::num_duplicates() const {
  return num_points() - num_vertices() - impl_->num_hidden();
}
Complex Triangulation::complex() const { return impl_->complex(); }
std::vector<int> Triangulation::axes() const { return impl_->state->affine_hull.axes(); }

std::span<const double> Triangulation::point(VertexId v) const {
  return {impl_->points().point(impl_->checked_vertex(v)), impl_->ambient()};
}
std::size_t Triangulation::row_of(VertexId v) const {
  return impl_->sites().row_of(impl_->checked_vertex(v));
}
VertexId Triangulation::vertex_at(std::size_t row) const {
  impl_->require_row(row);
  const VertexId v = impl_->sites().vertex_of(row);
  return v != invalid_vertex && impl_->state->is_visible(index(v)) ? v : invalid_vertex;
}

bool Triangulation::has_row(std::size_t row) const {
  impl_->require_row(row);
  return impl_->sites().vertex_of(row) != invalid_vertex;
}
bool Triangulation::is_hidden(std::size_t row) const { return impl_->is_hidden(row); }
std::size_t Triangulation::num_hidden() const { return impl_->num_hidden(); }
std::vector<std::size_t> Triangulation::hidden_rows() const { return impl_->hidden_rows(); }

Location Triangulation::locate(const AnyPoint<>& query, std::optional<CellId> hint) const {
  const ArithmeticScope arithmetic;
  // The least weight leads a walk by values of functionals to the cell that contains the point.
  const double lightest = impl_->has_cells() && impl_->weighted()
                              ? impl_->visit([](const auto& cells) { return frame_of(cells).low().back(); })
                              : 0.0;
  std::vector<double> storage;
  const double* q = impl_->checked_query(query, lightest, storage);
  const Index start = hint ? impl_->checked_hint(hint) : impl_->state->start_near(q);
  Location location;
  if (affine_dimension() < dimension() && !impl_->state->affine_hull.contains(q)) return location;
  if (!impl_->has_cells()) {  // one point, and the query is in its affine hull: at it
    location.kind = Location::Kind::on_vertex;
    location.cell = CellId{0};
    location.face = {impl_->complex().vertex(CellId{0}, 0)};
    return location;
  }
  compiled::QueryLocation found =
      impl_->visit([&](const auto& cells) { return compiled::locate(cells, q, start); });
  location.cell = CellId{found.cell};
  location.face = std::move(found.face);
  const int face_dimension = location.face_dimension();
  location.kind = found.outside                          ? Location::Kind::outside_hull
                  : face_dimension == affine_dimension() ? Location::Kind::in_cell
                  : face_dimension == 0                  ? Location::Kind::on_vertex
                                                         : Location::Kind::on_face;
  return location;
}

std::vector<CellId> Triangulation::conflict_zone_of(std::span<const double> query, double weight,
                                                    std::optional<CellId> hint) const {
  const ArithmeticScope arithmetic;
  return impl_->conflict_zone(query, weight, hint);
}

Side Triangulation::side_of_sphere(CellId cell, std::span<const double> query, double weight) const {
  const ArithmeticScope arithmetic;
  const Sign of_distance = impl_->in_sphere(cell, query, weight);  // negative inside
  return static_cast<Side>(-static_cast<int>(of_distance));
}

double Triangulation::weight_of(VertexId v) const {
  return impl_->points().point(impl_->checked_vertex(v))[impl_->ambient()];
}

CellId Triangulation::find_hiding_cell(std::size_t row, std::optional<CellId> hint) const {
  if (!is_hidden(row)) throw Error(Errc::invalid_argument, "row " + std::to_string(row) + " is not hidden");
  const double* const point = impl_->points().point(index(impl_->sites().vertex_of(row)));
  return locate(std::span(point, impl_->ambient()), hint).cell;
}

ComplexData Triangulation::to_data(bool with_points) const {
  const Complex now = complex();
  ComplexData data;
  data.dimension = dimension();
  data.affine_dimension = now.affine_dimension();
  switch (kind()) {
    case TriangulationKind::delaunay:
      data.kind = DataKind::delaunay;
      break;
    case TriangulationKind::regular:
      data.kind = DataKind::regular;
      break;
    case TriangulationKind::furthest_site:
      data.kind = DataKind::furthest_site;
      break;
  }
  const std::size_t rows = impl_->sites().num_rows();
  const auto row_of_vertex = [&](Index v) { return static_cast<SignedIndex>(impl_->sites().row_of(v)); };
  data.vertex_of_point.resize(rows);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  internal::QuickRounds round;
  for (std::size_t row = 0; row < rows; ++row) {
    round();
    const VertexId v = impl_->sites().vertex_of(row);
    data.vertex_of_point[row] = vertex_at(row) == invalid_vertex ? -1 : row_of_vertex(index(v));
    if (!with_points) continue;
    const double* point = v == invalid_vertex ? nullptr : impl_->points().point(index(v));
    for (std::size_t j = 0; j < impl_->ambient(); ++j)
      data.points.push_back(point == nullptr ? unknown : point[j]);
    if (impl_->weighted()) data.weights.push_back(point == nullptr ? unknown : point[impl_->ambient()]);
  }
  const CellNumbers numbers(now);
  const std::size_t entries = numbers.size() * static_cast<std::size_t>(now.affine_dimension() + 1);
  data.cells.reserve(entries);
  data.neighbors.reserve(entries);
  for (const CellId c : now.finite_cells()) {
    round();
    for (int i = 0; i <= now.affine_dimension(); ++i) {
      data.cells.push_back(row_of_vertex(index(now.vertex(c, i))));
      data.neighbors.push_back(numbers.row(now.neighbor(c, i)));
    }
  }
  return data;
}

CanonicalHash Triangulation::hash(const Execution& how) const {
  const ArithmeticScope arithmetic;
  const internal::ProgressMeter meter(how.progress);
  const std::vector<VertexId> vertices = complex().finite_vertices();
  const auto weight = [&](VertexId v) { return impl_->points().point(index(v))[impl_->ambient()]; };
  const bool with_weights =
      impl_->weighted() && std::any_of(vertices.begin(), vertices.end(),
                                       [&](VertexId v) { return weight(v) != weight(vertices.front()); });
  std::vector<complex::PointTag> tags(complex().num_vertex_slots());  // by vertex id
  complex::HashAccumulator hash;
  complex::add_in_parts(how.threads, vertices.size(), hash,
                        [&](std::size_t first, std::size_t last, complex::HashAccumulator& some) {
                          for (std::size_t i = first; i < last; ++i) {
                            const Index v = index(vertices[i]);
                            tags[v] = complex::point_tag(impl_->points().point(v),
                                                         dimension() + (with_weights ? 1 : 0));
                            some.add_vertex(tags[v]);
                          }
                        });
  const Complex now = complex();
  complex::add_in_parts(how.threads, now.num_cell_slots(), hash,
                        [&](std::size_t first, std::size_t last, complex::HashAccumulator& some) {
                          for (std::size_t slot = first; slot < last; ++slot) {
                            const CellId c{static_cast<Index>(slot)};
                            if (!now.is_cell(c) || now.is_infinite(c)) continue;
                            complex::PointTag sum;
                            for (int i = 0; i <= now.affine_dimension(); ++i)
                              sum += tags[index(now.vertex(c, i))];
                            some.add_cell(sum);
                          }
                        });
  return hash.finish(dimension(), affine_dimension());
}

Statistics Triangulation::statistics() const {
  Statistics s = impl_->state->statistics;
  if (impl_->has_cells()) {
    const engine::Effort effort = impl_->visit([](const auto& cells) { return effort_of(cells); });
    s.created_cells = effort.created_cells;
    s.visited_cells = effort.visited_cells;
    s.filter = effort.stages.filter;
    s.direct = effort.stages.direct;
    s.exact = effort.stages.exact;
    s.perturbed = effort.stages.perturbed;
    s.cell_bytes = impl_->visit([](const auto& cells) { return bytes_of(cells); });
  }
  s.insertions = num_vertices();
  return s;
}

}  // namespace delone
