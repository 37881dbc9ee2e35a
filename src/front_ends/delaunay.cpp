// SPDX-License-Identifier: BSD-3-Clause
// Triangulation: points to vertices, affine dimensions, duplicates, rows; the engine does the rest.
#include "front_ends/canonical_hash.hpp"
#include "front_ends/dispatch.hpp"
#include "kernel/predicates.hpp"
#include "order/insertion_order.hpp"

#include <delone/delaunay.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <string>
#include <utility>

namespace delone {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The complex of one point: a finite and an infinite cell of one vertex each.
constexpr Index single_point_links[4] = {1, 1, 0, 0};
constexpr CellId single_point_cells[2] = {CellId{1}, CellId{0}};

/// Makes sure that one push_back cannot fail, growing geometrically.
template <class T>
void reserve_one_more(std::vector<T>& items) {
  if (items.size() == items.capacity()) items.reserve(2 * items.size() + 2);
}

/// Calls the user's progress function now and then, and turns its `false` into Errc::cancelled.
class ProgressMeter {
 public:
  ProgressMeter(const std::function<bool(double)>& callback, std::size_t total) : callback_(callback), total_(total) {}

  void operator()(std::size_t done) {
    if (!callback_ || Clock::now() - last_ < std::chrono::milliseconds(20)) return;
    last_ = Clock::now();
    if (!callback_(total_ == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total_)))
      throw Error(Errc::cancelled, "cancelled by the progress callback");
  }

 private:
  const std::function<bool(double)>& callback_;
  std::size_t total_;
  Clock::time_point last_{};
};

}  // namespace

struct Triangulation::Impl {
  Impl(int d, Options given) : dimension(d), options(std::move(given)), points(d), affine_hull(d) {}

  int dimension;
  Options options;
  VertexPoints points;
  kernel::AffineHull affine_hull;
  std::unique_ptr<Hull> hull;           // none while the affine dimension is below 1
  std::vector<CellId> cell_of_vertex;   // by vertex id
  std::vector<Index> row_of_vertex{0};  // the first row at each vertex
  std::vector<VertexId> vertex_of_row;  // invalid_vertex for a row that was not inserted (cancelled)
  std::size_t num_rows_inserted = 0;
  Statistics statistics;

  std::size_t ambient() const { return static_cast<std::size_t>(dimension); }

  void check_finite(std::span<const double> coordinates) const {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      if (!std::isfinite(coordinates[i]) && (rows.empty() || rows.back() != i / ambient())) rows.push_back(i / ambient());
    if (rows.empty()) return;
    throw Error(Errc::not_finite,
                "a coordinate of point " + std::to_string(rows.front()) + " is not finite" +
                    (rows.size() > 1 ? " (and of " + std::to_string(rows.size() - 1) + " more points)" : ""),
                rows);
  }

  /// Makes `rows` more rows known, none of them inserted yet. Throws before anything has changed.
  std::size_t add_rows(std::size_t rows) {
    const std::size_t first = vertex_of_row.size();
    if (rows > max_index - first) throw Error(Errc::too_many, "more points than this build has ids");
    vertex_of_row.resize(first + rows, invalid_vertex);
    return first;
  }

  /// Appends the point as the next vertex, not yet part of the triangulation.
  Index append(const double* point) {
    points.grid.include(point);
    points.coordinates.insert(points.coordinates.end(), point, point + dimension);
    return points.num_vertices();
  }
  void drop_last_vertex() { points.coordinates.resize(points.coordinates.size() - ambient()); }

  void assign(std::size_t row, Index v) {
    vertex_of_row[row] = VertexId{v};
    ++num_rows_inserted;
    if (v < row_of_vertex.size())
      row_of_vertex[v] = std::min(row_of_vertex[v], static_cast<Index>(row));
    else
      row_of_vertex.push_back(static_cast<Index>(row));
  }

  /// Inserts the point of a row; points outside the affine hull raise the dimension. `track`: keep cell_of_vertex up to date.
  /// If it throws, nothing has changed.
  Index insert_row(std::size_t row, const double* point, Index start, bool track) {
    reserve_one_more(row_of_vertex);
    reserve_one_more(cell_of_vertex);
    if (affine_hull.dimension() < dimension) {
      kernel::AffineHull grown = affine_hull;
      if (grown.add(point)) return raise(row, point, std::move(grown));
    }
    if (!hull) {  // the only vertex again
      assign(row, 1);
      return 1;
    }
    const Index v = append(point);
    Index at = v;
    try {
      if (!hull->frame().contains(point)) hull->set_frame(frame_with(point, point, 1.0));
      at = hull->insert(v, start);
    } catch (...) {
      drop_last_vertex();
      throw;
    }
    if (at != v) drop_last_vertex();
    assign(row, at);
    if (at == v && track) {
      const Complex now = complex();
      cell_of_vertex.resize(v + 1);  // one more: cannot fail
      for (const HorizonFacet& facet : hull->star())
        for (int i = 0; i <= now.dimension(); ++i)
          cell_of_vertex[index(now.vertex(CellId{facet.created}, i))] = CellId{facet.created};
    }
    return at;
  }

  /// A point outside the affine hull, which has `grown` by it.
  Index raise(std::size_t row, const double* point, kernel::AffineHull grown) {
    const Index v = append(point);
    try {
      if (grown.dimension() > 0) {
        auto next = make_hull(grown.axes(), points, frame_with(point, point, 1.0), hull ? hull->effort() : engine::Effort{},
                              options.force_runtime_dimension);
        if (hull)
          next->jump(complex(), v);
        else
          next->seed(std::vector<Index>{1, v});
        hull = std::move(next);
        find_cells_of_vertices();
      }
    } catch (...) {
      drop_last_vertex();
      throw;
    }
    affine_hull = std::move(grown);
    assign(row, v);
    return v;
  }

  /// A frame for the present one, all vertices and the box [low, high]; `margin` times its size is added on each side where it
  /// had to grow, so that points arriving from ever farther away change it a logarithmic number of times.
  geometry::Frame frame_with(const double* low, const double* high, double margin) const {
    std::vector<double> lows(low, low + dimension), highs(high, high + dimension);
    const auto cover = [&](const double* x) {
      for (std::size_t j = 0; j < ambient(); ++j) {
        lows[j] = std::min(lows[j], x[j]);
        highs[j] = std::max(highs[j], x[j]);
      }
    };
    if (hull) {
      cover(hull->frame().low().data());
      cover(hull->frame().high().data());
    }
    if (!hull)
      for (Index v = 1; v <= points.num_vertices(); ++v) cover(points.point(v));
    constexpr double largest = std::numeric_limits<double>::max() / 4;
    for (std::size_t j = 0; j < ambient(); ++j) {
      const double extent = std::min(highs[j] / 2 - lows[j] / 2, largest) * 2 * margin;
      if (!hull || lows[j] < hull->frame().low()[j]) lows[j] = std::max(lows[j] - extent, std::min(lows[j], -largest));
      if (!hull || highs[j] > hull->frame().high()[j]) highs[j] = std::min(highs[j] + extent, std::max(highs[j], largest));
    }
    return {std::move(lows), std::move(highs)};
  }

  /// The first sphere of a batch: the frame of the whole box, and a simplex of the batch's affine hull found along the order.
  void start_batch(std::span<const double> coordinates, std::size_t first_row, std::span<const Index> order) {
    std::vector<double> low(coordinates.begin(), coordinates.begin() + dimension), high = low;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      low[i % ambient()] = std::min(low[i % ambient()], coordinates[i]);
      high[i % ambient()] = std::max(high[i % ambient()], coordinates[i]);
    }
    if (hull) {
      if (!hull->frame().contains(low.data()) || !hull->frame().contains(high.data()))
        hull->set_frame(frame_with(low.data(), high.data(), 0.0));
      return;
    }
    for (const Index row : order) {
      if (affine_hull.dimension() == dimension) break;
      const double* point = coordinates.data() + static_cast<std::size_t>(row) * ambient();
      if (affine_hull.add(point)) assign(first_row + row, append(point));
    }
    if (affine_hull.dimension() < 1) return;
    hull = make_hull(affine_hull.axes(), points, frame_with(low.data(), high.data(), 0.0), {}, options.force_runtime_dimension);
    std::vector<Index> simplex(points.num_vertices());
    std::iota(simplex.begin(), simplex.end(), Index{1});
    hull->seed(simplex);
  }

  void insert_range(std::span<const double> coordinates) {
    if (coordinates.size() % ambient() != 0)
      throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
    check_finite(coordinates);
    const std::size_t n = coordinates.size() / ambient();
    if (n == 0) return;
    const std::size_t first_row = add_rows(n);

    auto start = Clock::now();
    const PointsView view(coordinates, dimension);
    const std::vector<Index> order = insertion_order(view);
    statistics.order_seconds += seconds_since(start);

    start = Clock::now();
    ProgressMeter progress(options.progress, n);
    const auto finish = [&] {
      find_cells_of_vertices();
      statistics.build_seconds += seconds_since(start);
    };
    try {
      points.coordinates.reserve(points.coordinates.size() + coordinates.size() + ambient());
      row_of_vertex.reserve(row_of_vertex.size() + n);
      start_batch(coordinates, first_row, order);
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t row = order[i];
        if (vertex_of_row[first_row + row] == invalid_vertex)
          insert_row(first_row + row, coordinates.data() + row * ambient(), invalid_index, false);
        progress(i + 1);
      }
    } catch (...) {
      finish();
      throw;
    }
    finish();
  }

  std::vector<Index> insertion_order(PointsView view) const {
    switch (options.order) {
      case InsertionOrder::shuffled:
        return order::shuffled_order(view.size(), options.seed);
      case InsertionOrder::as_given: {
        std::vector<Index> rows(view.size());
        std::iota(rows.begin(), rows.end(), Index{0});
        return rows;
      }
      case InsertionOrder::automatic:
        break;
    }
    return order::brio_order(view, options.seed);
  }

  void find_cells_of_vertices() {
    if (!hull) return;
    cell_of_vertex.assign(points.num_vertices() + 1, invalid_cell);
    const Complex now = complex();
    for (const CellId c : now.cells())
      for (int i = 0; i <= now.dimension(); ++i) cell_of_vertex[index(now.vertex(c, i))] = c;
  }

  Complex complex() const {
    if (hull) return hull->complex(points.num_vertices(), cell_of_vertex.data());
    if (affine_hull.dimension() == 0) return {single_point_links, 2, 0, 2, 1, 1, 1, single_point_cells};
    return {};
  }

  const double* checked_query(std::span<const double> query) const {
    if (query.size() != ambient()) throw Error(Errc::bad_dimension, "the query has not as many coordinates as the space");
    check_finite(query);
    return query.data();
  }
  Index checked_hint(std::optional<CellId> hint) const {
    if (!hint) return invalid_index;
    if (!complex().is_cell(*hint)) throw Error(Errc::invalid_argument, "the hint is not a cell");
    return index(*hint);
  }
};

Triangulation::Triangulation(int dimension, const Options& options) {
  if (dimension < 1) throw Error(Errc::bad_dimension, "the dimension must be at least 1");
  impl_ = std::make_unique<Impl>(dimension, options);
}
Triangulation::Triangulation(std::span<const double> coordinates, int dimension, const Options& options)
    : Triangulation(dimension, options) {
  insert_range(coordinates);
}
Triangulation::Triangulation(PointsView points, const Options& options)
    : Triangulation(points.coordinates(), points.dimension(), options) {}
Triangulation::Triangulation(Triangulation&&) noexcept = default;
Triangulation& Triangulation::operator=(Triangulation&&) noexcept = default;
Triangulation::~Triangulation() = default;

void Triangulation::insert_range(std::span<const double> coordinates) {
  try {
    impl_->insert_range(coordinates);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the triangulation");
  }
}

InsertResult Triangulation::insert(std::span<const double> point, std::optional<CellId> hint) {
  const double* coordinates = impl_->checked_query(point);
  const Index start = impl_->checked_hint(hint);
  const Index before = impl_->points.num_vertices();
  try {
    const std::size_t row = impl_->add_rows(1);
    try {
      const Index v = impl_->insert_row(row, coordinates, start, true);
      return {VertexId{v}, v > before};
    } catch (...) {
      impl_->vertex_of_row.resize(row);
      throw;
    }
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the triangulation");
  }
}

int Triangulation::dimension() const { return impl_->dimension; }
int Triangulation::affine_dimension() const { return impl_->affine_hull.dimension(); }
std::size_t Triangulation::num_points() const { return impl_->num_rows_inserted; }
Index Triangulation::num_vertices() const { return impl_->points.num_vertices(); }
Complex Triangulation::complex() const { return impl_->complex(); }
std::vector<int> Triangulation::axes() const { return impl_->affine_hull.axes(); }

std::span<const double> Triangulation::point(VertexId v) const {
  if (v == infinite_vertex || index(v) > num_vertices()) throw Error(Errc::invalid_argument, "not a finite vertex");
  return {impl_->points.point(index(v)), impl_->ambient()};
}
std::size_t Triangulation::row_of(VertexId v) const {
  if (v == infinite_vertex || index(v) > num_vertices()) throw Error(Errc::invalid_argument, "not a finite vertex");
  return impl_->row_of_vertex[index(v)];
}
VertexId Triangulation::vertex_at(std::size_t row) const {
  if (row >= impl_->vertex_of_row.size()) throw Error(Errc::invalid_argument, "not a row of the input");
  return impl_->vertex_of_row[row];
}

Location Triangulation::locate(std::span<const double> query, std::optional<CellId> hint) const {
  const double* q = impl_->checked_query(query);
  const Index start = impl_->checked_hint(hint);
  Location location;
  if (affine_dimension() < dimension() && !impl_->affine_hull.contains(q)) return location;
  if (!impl_->hull) {  // one point, and the query is in its affine hull: at it
    location.kind = Location::Kind::on_vertex;
    location.cell = CellId{0};
    location.face = {VertexId{1}};
    return location;
  }
  HullLocation found = impl_->hull->locate(q, start);
  location.cell = CellId{found.cell};
  location.face = std::move(found.face);
  const int face_dimension = location.face_dimension();
  location.kind = found.outside                          ? Location::Kind::outside_hull
                  : face_dimension == affine_dimension() ? Location::Kind::in_cell
                  : face_dimension == 0                  ? Location::Kind::on_vertex
                                                         : Location::Kind::on_face;
  return location;
}

std::vector<CellId> Triangulation::conflict_zone(std::span<const double> query, std::optional<CellId> hint) const {
  const double* q = impl_->checked_query(query);
  const Index start = impl_->checked_hint(hint);
  if (!impl_->hull || (affine_dimension() < dimension() && !impl_->affine_hull.contains(q))) return {};
  return impl_->hull->conflict_zone(q, start);
}

Sign Triangulation::in_sphere(CellId cell, std::span<const double> query) const {
  const double* q = impl_->checked_query(query);
  const Complex now = complex();
  if (!now.is_cell(cell) || now.is_infinite(cell)) throw Error(Errc::invalid_argument, "not a finite cell");
  if (affine_dimension() < dimension() && !impl_->affine_hull.contains(q))
    throw Error(Errc::invalid_argument, "the query is outside the affine hull of the points");
  if (!impl_->hull) return Sign::zero;
  return impl_->hull->in_sphere(index(cell), q);
}

ComplexData Triangulation::to_data(bool with_points) const {
  const Complex now = complex();
  ComplexData data;
  data.dimension = dimension();
  data.affine_dimension = now.dimension();
  const std::size_t rows = impl_->vertex_of_row.size();
  const auto row_of_vertex = [&](Index v) { return static_cast<SignedIndex>(impl_->row_of_vertex[v]); };
  data.vertex_of_point.resize(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const VertexId v = impl_->vertex_of_row[row];
    data.vertex_of_point[row] = v == invalid_vertex ? -1 : row_of_vertex(index(v));
    if (!with_points) continue;
    if (v == invalid_vertex)
      data.points.insert(data.points.end(), impl_->ambient(), std::numeric_limits<double>::quiet_NaN());
    else
      data.points.insert(data.points.end(), impl_->points.point(index(v)), impl_->points.point(index(v)) + dimension());
  }
  std::vector<SignedIndex> number(now.num_cell_slots(), -1);
  SignedIndex count = 0;
  for (const CellId c : now.finite_cells()) number[index(c)] = count++;
  const std::size_t entries = static_cast<std::size_t>(count) * static_cast<std::size_t>(now.dimension() + 1);
  data.cells.reserve(entries);
  data.neighbors.reserve(entries);
  for (const CellId c : now.finite_cells())
    for (int i = 0; i <= now.dimension(); ++i) {
      data.cells.push_back(row_of_vertex(index(now.vertex(c, i))));
      data.neighbors.push_back(number[index(now.neighbor(c, i))]);
    }
  return data;
}

CanonicalHash Triangulation::hash() const {
  std::vector<front_ends::PointTag> tags{{}};  // by vertex id
  tags.reserve(num_vertices() + 1);
  front_ends::HashAccumulator hash;
  for (Index v = 1; v <= num_vertices(); ++v) {
    tags.push_back(front_ends::point_tag(impl_->points.point(v), dimension()));
    hash.add_vertex(tags.back());
  }
  const Complex now = complex();
  for (const CellId c : now.finite_cells()) {
    front_ends::PointTag sum;
    for (int i = 0; i <= now.dimension(); ++i) sum += tags[index(now.vertex(c, i))];
    hash.add_cell(sum);
  }
  return hash.finish(dimension(), affine_dimension());
}

Statistics Triangulation::statistics() const {
  Statistics s = impl_->statistics;
  if (impl_->hull) {
    const engine::Effort& effort = impl_->hull->effort();
    s.created_cells = effort.created_cells;
    s.visited_cells = effort.visited_cells;
    s.filter = effort.stages.filter;
    s.direct = effort.stages.direct;
    s.exact = effort.stages.exact;
    s.perturbed = effort.stages.perturbed;
    s.cell_bytes = impl_->hull->bytes();
  }
  s.insertions = num_vertices();
  return s;
}

}  // namespace delone
