// SPDX-License-Identifier: BSD-3-Clause
// Insertion of points and batches; frames, landmarks, and what queries ask of all kinds.
#include "triangulation/triangulation_impl.hpp"

#include "base/atomic_ref.hpp"
#include "base/build_limits.hpp"
#include "base/parallel.hpp"
#include "base/progress_meter.hpp"
#include "base/require_finite.hpp"
#include "base/reserve_one_more.hpp"
#include "base/stopwatch.hpp"
#include "forecast/model/cost.hpp"
#include "order/insertion_order.hpp"
#include "triangulation/batch_insertion.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <new>
#include <numeric>
#include <string>
#include <utility>

namespace delone {
namespace {

/// Each point followed by its weight.
std::vector<double> weighted_rows(PointsView points, std::span<const double> weights) {
  std::vector<double> rows;
  rows.reserve(points.size() * (static_cast<std::size_t>(points.dimension()) + 1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows.insert(rows.end(), points[i].begin(), points[i].end());
    rows.push_back(weights.empty() ? 0.0 : weights[i]);
  }
  return rows;
}

}  // namespace

Triangulation::Impl::Impl(int d, kernel::RowForm form, const Options& given)
    : dimension(d), options(given), points(d, form), affine_hull(d) {}
Triangulation::Impl::~Impl() = default;

std::unique_ptr<Triangulation::Impl> Triangulation::Impl::clone() const {
  auto copy = std::make_unique<Impl>(dimension, points.form, options);
  copy->points = points;
  copy->affine_hull = affine_hull;
  if (engine) copy->engine = engine->copy(copy->points);
  if (compacted) copy->compacted = compacted->copy(copy->points);
  copy->cell_of_vertex = cell_of_vertex;
  copy->row_of_vertex = row_of_vertex;
  copy->vertex_of_row = vertex_of_row;
  copy->num_rows_inserted = num_rows_inserted;
  copy->num_vertices = num_vertices;
  copy->has_ids_of_threads = has_ids_of_threads;
  copy->statistics = statistics;
  copy->records_changes = records_changes;
  copy->records_undo = records_undo;
  copy->changes = changes;
  if (landmarks) copy->landmarks = std::make_unique<internal::Landmarks>(*landmarks);
  std::copy(std::begin(single_links), std::end(single_links), copy->single_links);
  return copy;
}

void Triangulation::Impl::check_finite(std::span<const double> coordinates,
                                       std::span<const double> weights) const {
  internal::require_finite(coordinates, ambient(), "a coordinate");
  internal::require_finite(weights, 1, "the weight");
}

/// Makes `rows` more rows known, none of them inserted yet. Throws before anything has changed.
std::size_t Triangulation::Impl::add_rows(std::size_t rows) {
  const std::size_t first = vertex_of_row.size();
  if (rows > max_index - first) throw Error(Errc::too_many, "more points than this build has ids");
  vertex_of_row.resize(first + rows, invalid_vertex);
  return first;
}

/// Appends the point as the next vertex, not yet part of the triangulation.
Index Triangulation::Impl::append(const double* point) {
  points.grid.include(point);
  points.coordinates.insert(points.coordinates.end(), point, point + row_size());
  return points.last_vertex();
}
void Triangulation::Impl::drop_last_vertex() {
  points.coordinates.resize(points.coordinates.size() - row_size());
}

/// Inserts the point of a row. Returns the vertex at the point, invalid_index if the point is hidden. If it
/// throws, nothing has changed.
Index Triangulation::Impl::insert_row(std::size_t row, const double* point, Index start) {
  internal::reserve_one_more(row_of_vertex);
  internal::reserve_one_more(cell_of_vertex);
  const Index v = append(point);
  Index at = v;
  try {
    at = place(v, start);
  } catch (...) {
    drop_last_vertex();
    throw;
  }
  const bool is_duplicate = at != v && at != invalid_index;
  if (is_duplicate) drop_last_vertex();
  assign(row, is_duplicate ? at : v);
  return at;
}

/// A frame for the present one, all vertices and the box [low, high]; `margin` times its size is added on
/// each side where it had to grow, so that points arriving from ever farther away change it a logarithmic
/// number of times, and a quarter of that on the other sides, which often have to grow next. Weights have a
/// range like coordinates.
geometry::Frame Triangulation::Impl::frame_with(const double* low, const double* high, double margin) const {
  std::vector<double> lows(low, low + row_size()), highs(high, high + row_size());
  const auto cover = [&](const double* x) {
    for (std::size_t j = 0; j < row_size(); ++j) {
      lows[j] = std::min(lows[j], x[j]);
      highs[j] = std::max(highs[j], x[j]);
    }
  };
  if (engine) {
    cover(engine->frame().low().data());
    cover(engine->frame().high().data());
  }
  if (!engine)
    for (Index v = 1; v <= points.last_vertex(); ++v) cover(points.point(v));
  constexpr double largest = std::numeric_limits<double>::max() / 4;
  for (std::size_t j = 0; j < row_size(); ++j) {
    const double extent = std::min(highs[j] / 2 - lows[j] / 2, largest) * 2 * margin;
    const bool low_grows = !engine || lows[j] < engine->frame().low()[j];
    const bool high_grows = !engine || highs[j] > engine->frame().high()[j];
    lows[j] = std::max(lows[j] - (low_grows ? extent : extent / 4), std::min(lows[j], -largest));
    highs[j] = std::min(highs[j] + (high_grows ? extent : extent / 4), std::max(highs[j], largest));
  }
  return {std::move(lows), std::move(highs), points.form};
}

/// An engine without cells for the present axes, in a frame of the box and of what there is.
std::unique_ptr<TriangulationEngine> Triangulation::Impl::new_engine(const double* low, const double* high,
                                                                     const engine::Effort& effort) {
  return make_triangulation_engine(affine_hull.axes(), points, frame_with(low, high, 0.0), effort,
                                   options.force_runtime_dimension);
}

void Triangulation::Impl::insert_range(std::span<const double> coordinates, std::span<const double> weights,
                                       const std::function<void()>& release) {
  require_idle();
  if (coordinates.size() % ambient() != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  const std::size_t n = coordinates.size() / ambient();
  if (!weights.empty() && weights.size() != n)
    throw Error(Errc::bad_dimension,
                std::to_string(weights.size()) + " weights for " + std::to_string(n) + " points");
  check_finite(coordinates, weights);
  if (n == 0) return;
  if (records_changes || records_undo) return edit({.insert = coordinates, .insert_weights = weights});
  forget_indexes();
  internal::BuildLimits limits(options.memory_limit, options.time_limit, "points");
  const std::size_t vertices_before = points.last_vertex();
  limits.set_model([&] {  // of a set spread evenly
    const cost_model::Cost cost =
        cost_model::cost_of_spread(dimension, static_cast<double>(vertices_before + n));
    return internal::WholeCost{cost.bytes, cost.seconds};
  });
  const internal::ProgressMeter meter(options.progress);
  expand();
  internal::Stopwatch stopwatch;
  const PointsView view(coordinates, dimension);
  std::vector<std::size_t> rounds;
  std::vector<Index> order = order::insertion_order(view, options, &rounds);
  const double order_seconds = stopwatch.restart();
  limits.guard([&] {
    BatchInsertion batch(*this, std::move(order), std::move(rounds), limits);
    batch.take(weighted() ? std::span<const double>(weighted_rows(view, weights)) : coordinates);
    if (release) release();
    batch.insert_all();
  });
  statistics.order_seconds += order_seconds;
  statistics.build_seconds += stopwatch.seconds();
}

InsertResult Triangulation::Impl::insert(std::span<const double> point, double weight,
                                         std::optional<CellId> hint) {
  require_idle();
  std::vector<double> storage;
  const double* row_of_point = checked_query(point, weight, storage);
  Index start = checked_hint(hint);
  if (records_changes || records_undo) return insert_on_record(point, weight, start);
  expand();
  const Index before = points.last_vertex();
  // Functionals of furthest points lead nowhere.
  if (!hint && points.form != kernel::RowForm::furthest_point) {
    if (!landmarks && engine) add_landmarks(1, before);
    start = start_near(row_of_point);
  }
  const std::size_t row = add_rows(1);
  try {
    const Index v = insert_row(row, row_of_point, start);
    const bool is_new = v != invalid_index && v > before;
    if (is_new && landmarks) add_landmarks(v, v);
    return {VertexId{v}, is_new};
  } catch (...) {
    vertex_of_row.resize(row);
    throw;
  }
}

void Triangulation::Impl::compact() {
  require_idle();
  forget_undo();
  changes = {};
  hidden_points.reset();
  landmarks.reset();
  if (engine) {
    compacted = make_compact_triangulation(affine_hull.axes(), points, *engine, complex());
    engine.reset();
    find_cells_of_vertices();
  }
  points.coordinates.shrink_to_fit();
  cell_of_vertex.shrink_to_fit();
  row_of_vertex.shrink_to_fit();
  vertex_of_row.shrink_to_fit();
}

/// Of what compact() has left, too: insertions are possible then.
void Triangulation::Impl::sort_cells() {
  require_idle();
  if (!has_ids_of_threads) return;
  forget_undo();
  changes = {};
  hidden_points.reset();
  expand();
  if (!engine) return;
  engine->sort_cells(internal::threads_to_use(options.threads));
  find_cells_of_vertices();
  has_ids_of_threads = false;
}

/// Makes insertions possible again after compact(): cells keep their ids.
void Triangulation::Impl::expand() {
  if (!compacted) return;
  auto restored = make_triangulation_engine(affine_hull.axes(), points, compacted->frame(),
                                            compacted->effort(), options.force_runtime_dimension);
  restored->restore(complex());
  engine = std::move(restored);
  compacted.reset();
}

/// Adds the vertices first … last. Without memory for them there are no landmarks. REQUIRES a engine.
void Triangulation::Impl::add_landmarks(Index first, Index last) {
  try {
    if (!landmarks) landmarks = std::make_unique<internal::Landmarks>(engine->frame(), ambient());
    for (Index v = first; v <= last; ++v) landmarks->add(v, points.point(v));
  } catch (const std::bad_alloc&) {
    landmarks.reset();
  }
}

Index Triangulation::Impl::start_near(const double* point) const {
  const Index v =
      landmarks ? landmarks->near(point, [&](Index near) { return is_visible(near); }) : invalid_index;
  return v != invalid_index ? index(cell_of_vertex[v]) : invalid_index;
}

void Triangulation::Impl::find_cells_of_vertices() {
  if (affine_hull.dimension() < 0) return;
  cell_of_vertex.assign(points.last_vertex() + 1, invalid_cell);
  const Complex now = complex();
  const unsigned threads = statistics.threads > 1 ? internal::threads_to_use(options.threads) : 1;
  bool is_done = false;
  if (threads > 1) try {
      internal::parallel_for(threads, now.num_cell_slots(), 65536, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
          const CellId c{static_cast<Index>(slot)};
          if (!now.is_cell(c)) continue;
          for (int i = 0; i <= now.affine_dimension(); ++i) {
            // The last one, as in one thread.
            const internal::AtomicRef<CellId> last_cell(cell_of_vertex[index(now.vertex(c, i))]);
            CellId known = last_cell.load(std::memory_order_relaxed);
            while ((known == invalid_cell || known < c) &&
                   !last_cell.compare_exchange_weak(known, c, std::memory_order_relaxed)) {
            }
          }
        }
      });
      is_done = true;
    } catch (const std::bad_alloc&) {  // of threads, before they have begun: one does it
    }
  if (!is_done)
    for (const CellId c : now.all_cells())
      for (int i = 0; i <= now.affine_dimension(); ++i) cell_of_vertex[index(now.vertex(c, i))] = c;
  num_vertices = static_cast<Index>(
      cell_of_vertex.size() - 1 -
      static_cast<std::size_t>(std::count(cell_of_vertex.begin() + 1, cell_of_vertex.end(), invalid_cell)));
}

Complex Triangulation::Impl::complex() const {
  if (queries() != nullptr) return queries()->complex(num_vertices, cell_of_vertex);
  if (affine_hull.dimension() == 0)
    return {{single_links, 2, false},
            0,
            2,
            1,
            1,
            1,
            cell_of_vertex.data(),
            static_cast<Index>(cell_of_vertex.size())};
  return {};
}

/// Inserted rows without a vertex that has cells.
std::size_t Triangulation::Impl::num_hidden() const {
  if (!may_hide()) return 0;
  return static_cast<std::size_t>(std::count_if(vertex_of_row.begin(), vertex_of_row.end(), [&](VertexId v) {
    return v != invalid_vertex && !is_visible(index(v));
  }));
}

void Triangulation::Impl::require_row(std::size_t row) const {
  if (row >= vertex_of_row.size())
    throw Error(Errc::invalid_argument, "row " + std::to_string(row) + " is not a row of the input");
}

bool Triangulation::Impl::is_hidden(std::size_t row) const {
  require_row(row);
  const VertexId v = vertex_of_row[row];
  return v != invalid_vertex && !is_visible(index(v));
}

std::vector<std::size_t> Triangulation::Impl::hidden_rows() const {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < vertex_of_row.size(); ++row)
    if (is_hidden(row)) rows.push_back(row);
  return rows;
}

const double* Triangulation::Impl::checked_query(std::span<const double> query, double weight,
                                                 std::vector<double>& row) const {
  if (query.size() != ambient())
    throw Error(Errc::bad_dimension, "the point has " + std::to_string(query.size()) + " coordinates, not " +
                                         std::to_string(dimension));
  check_finite(query, {&weight, 1});
  if (!weighted()) return query.data();
  row.assign(query.begin(), query.end());
  row.push_back(weight);
  return row.data();
}

Index Triangulation::Impl::checked_hint(std::optional<CellId> hint) const {
  if (!hint) return invalid_index;
  if (!complex().is_cell(*hint)) throw Error(Errc::invalid_argument, "the hint is not a cell");
  return index(*hint);
}

Index Triangulation::Impl::checked_vertex(VertexId v) const {
  if (v == infinite_vertex || !is_visible(index(v)))
    throw Error(Errc::invalid_argument, "not a finite vertex");
  return index(v);
}

std::vector<CellId> Triangulation::Impl::conflict_zone(std::span<const double> query, double weight,
                                                       std::optional<CellId> hint) const {
  std::vector<double> storage;
  const double* q = checked_query(query, weight, storage);
  const Index start = checked_hint(hint);
  if (affine_hull.dimension() < dimension && !affine_hull.contains(q)) return {};
  if (queries() != nullptr) return queries()->conflict_zone(q, start);
  const bool is_heavier = weighted() && weight > points.point(single_links[0])[ambient()];
  return is_heavier ? std::vector<CellId>{CellId{0}} : std::vector<CellId>{};
}

Sign Triangulation::Impl::in_sphere(CellId cell, std::span<const double> query, double weight) const {
  std::vector<double> storage;
  const double* q = checked_query(query, weight, storage);
  const Complex now = complex();
  if (!now.is_cell(cell) || now.is_infinite(cell)) throw Error(Errc::invalid_argument, "not a finite cell");
  if (affine_hull.dimension() < dimension && !affine_hull.contains(q))
    throw Error(Errc::invalid_argument, "the query is outside the affine hull of the points");
  if (queries() != nullptr) {
    const Sign side = queries()->unperturbed_side(index(cell), q);
    return points.form == kernel::RowForm::furthest_point ? -side : side;
  }
  if (!weighted()) return Sign::zero;
  const double weight_of_vertex = points.point(single_links[0])[ambient()];
  return weight > weight_of_vertex ? Sign::negative : weight < weight_of_vertex ? Sign::positive : Sign::zero;
}

}  // namespace delone
