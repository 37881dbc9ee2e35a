// SPDX-License-Identifier: BSD-3-Clause
#include "construction/state.hpp"

#include "base/atomic_ref.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <new>
#include <utility>

namespace delone::construction {

using compiled::TriangulationEngine;

std::unique_ptr<State> State::clone() const {
  auto copy = std::make_unique<State>(dimension(), sites.points().form, options);
  copy->sites = sites;
  copy->sites.end();
  copy->affine_hull = affine_hull;
  if (engine) copy->engine = engine->copy(copy->sites.points());
  copy->cell_of_vertex = cell_of_vertex;
  copy->num_vertices = num_vertices;
  copy->ids_tell_of_timing = ids_tell_of_timing;
  copy->statistics = statistics;
  if (landmarks) copy->landmarks = std::make_unique<Landmarks>(*landmarks);
  std::copy(std::begin(single_links), std::end(single_links), copy->single_links);
  return copy;
}

Complex State::complex() const {
  if (engine) return complex_of(*engine, num_vertices, cell_of_vertex);
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

Index State::place(Index v, Index start) {
  if (affine_hull.dimension() < dimension()) {
    kernel::AffineHull grown = affine_hull;
    if (grown.add(sites.point(v))) {
      raise(v, std::move(grown));
      return v;
    }
  }
  if (!engine) return place_at_only_vertex(v);
  if (!frame_of(*engine).contains(sites.point(v))) {
    engine->set_frame(frame_with(sites.point(v), sites.point(v), 1.0));
    landmarks.reset();
  }
  if (cell_of_vertex.capacity() <= v) cell_of_vertex.reserve(2 * std::size_t{v} + 2);
  const engine::Change change = engine->insert(v, start);
  if (change.outcome != engine::Outcome::duplicate && cell_of_vertex.size() <= v)
    cell_of_vertex.resize(std::size_t{v} + 1, invalid_cell);
  if (change.is_done()) {
    note_visibility(v);
    for (const Index swallowed : change.swallowed) note_visibility(swallowed);
    update_cells(change.created_cells);
    for (const Index swallowed : change.swallowed) cell_of_vertex[swallowed] = invalid_cell;
    num_vertices += 1 - static_cast<Index>(change.swallowed.size());
  }
  try {
    if (change.is_done()) rehome_hidden_points(change);
    if (change.is_hidden()) hide(v, invalid_index);
  } catch (...) {
    hidden_points.reset();
    if (record != nullptr) throw;
  }
  return change.vertex;
}

Index State::place_at_only_vertex(Index v) {
  const Index only = only_vertex();
  const int heavier = compare_with_only_vertex(sites.point(v));
  if (heavier == 0) return only;
  if (cell_of_vertex.size() <= v) cell_of_vertex.resize(std::size_t{v} + 1, invalid_cell);
  if (heavier < 0) return invalid_index;
  note_visibility(v);
  note_visibility(only);
  cell_of_vertex[v] = std::exchange(cell_of_vertex[only], invalid_cell);
  only_vertex() = v;
  return v;
}

int State::compare_with_only_vertex(const double* point) const {
  if (!weighted()) return 0;
  const double weight = point[ambient()], of_vertex = sites.point(single_links[0])[ambient()];
  return weight > of_vertex ? 1 : weight < of_vertex ? -1 : 0;
}

/// Vertex v is outside the affine hull, which has `grown` by it.
void State::raise(Index v, kernel::AffineHull grown) {
  cell_of_vertex.reserve(std::size_t{sites.points().last_vertex()} + 1);
  note_visibility(v);
  if (grown.dimension() > 0) {
    auto next = new_engine(grown, frame_with(sites.point(v), sites.point(v), 1.0));
    if (engine)
      next->jump(complex(), v);
    else
      next->seed(std::vector<Index>{only_vertex(), v});
    replace_engine(std::move(next));
  } else {
    only_vertex() = v;
  }
  affine_hull = std::move(grown);
  find_cells_of_vertices();
}

/// Puts a hidden vertex where it belongs, if that is known of all others; walks from a cell.
void State::hide(Index v, Index start) {
  if (!hidden_points) return;
  hidden_points->reserve(std::size_t{sites.points().last_vertex()} + 1, complex().num_cell_slots());
  hidden_points->add(v, locate(*engine, sites.point(v), start).cell);
}

/// The same for those of the cells that an insertion has replaced, and for the vertices that it has hidden.
void State::rehome_hidden_points(const engine::Change& change) {
  if (!hidden_points) return;
  std::vector<Index> homeless(change.swallowed.begin(), change.swallowed.end());
  for (const Index cell : change.removed_cells) hidden_points->take(cell, homeless);
  for (const Index v : homeless) hide(v, change.created_cells.front());
}

void State::update_cells(std::span<const Index> made) {
  const Complex now = complex();
  for (const Index cell : made) {
    if (!now.is_cell(CellId{cell})) continue;
    for (int i = 0; i <= now.affine_dimension(); ++i)
      cell_of_vertex[index(now.vertex(CellId{cell}, i))] = CellId{cell};
  }
}

void State::find_cells_of_vertices(const Complex& now) {
  if (affine_hull.dimension() < 0) return;
  cell_of_vertex.assign(sites.points().last_vertex() + 1, invalid_cell);
  const unsigned threads = statistics.threads > 1 ? internal::threads_to_use(options.threads) : 1;
  bool is_done = false;
  if (threads > 1) try {
      internal::parallel_for(threads, now.num_cell_slots(), 65536, [&](std::size_t first, std::size_t last) {
        // The last cell of each vertex, as in one thread. From the back, nearly all cells find a later one
        // there, and an exchange is rare.
        for (std::size_t slot = last; slot-- > first;) {
          const CellId c{static_cast<Index>(slot)};
          if (!now.is_cell(c)) continue;
          for (int i = 0; i <= now.affine_dimension(); ++i) {
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
    for (Index slot = 0; slot < now.num_cell_slots(); ++slot) {
      const CellId c{slot};
      if (!now.is_cell(c)) continue;
      for (int i = 0; i <= now.affine_dimension(); ++i) cell_of_vertex[index(now.vertex(c, i))] = c;
    }
  num_vertices = static_cast<Index>(
      cell_of_vertex.size() - 1 -
      static_cast<std::size_t>(std::count(cell_of_vertex.begin() + 1, cell_of_vertex.end(), invalid_cell)));
}

void State::sort_cells() {
  engine->sort_cells({sites.points().last_vertex() + 1, weighted()},
                     internal::threads_to_use(options.threads));
}

void State::note_visibility(Index v) {
  if (record != nullptr) record->were_visible.emplace_back(v, is_visible(v));
}

void State::replace_engine(std::unique_ptr<TriangulationEngine> next) {
  if (record != nullptr && !record->has_other_engine) {
    record->engine = std::move(engine);
    record->has_other_engine = true;
  }
  engine = std::move(next);
  landmarks.reset();
  hidden_points.reset();
}

geometry::Frame State::frame_with(const double* low, const double* high, double margin) const {
  std::vector<double> lows(low, low + row_size()), highs(high, high + row_size());
  const auto cover = [&](const double* x) {
    for (std::size_t j = 0; j < row_size(); ++j) {
      lows[j] = std::min(lows[j], x[j]);
      highs[j] = std::max(highs[j], x[j]);
    }
  };
  if (engine) {
    cover(frame_of(*engine).low().data());
    cover(frame_of(*engine).high().data());
  } else
    for (Index v = 1; v <= sites.points().last_vertex(); ++v) cover(sites.point(v));
  constexpr double largest = std::numeric_limits<double>::max() / 4;
  for (std::size_t j = 0; j < row_size(); ++j) {
    const double extent = std::min(highs[j] / 2 - lows[j] / 2, largest) * 2 * margin;
    const bool low_grows = !engine || lows[j] < frame_of(*engine).low()[j];
    const bool high_grows = !engine || highs[j] > frame_of(*engine).high()[j];
    lows[j] = std::max(lows[j] - (low_grows ? extent : extent / 4), std::min(lows[j], -largest));
    highs[j] = std::min(highs[j] + (high_grows ? extent : extent / 4), std::max(highs[j], largest));
  }
  return {std::move(lows), std::move(highs), sites.points().form};
}

std::unique_ptr<TriangulationEngine> State::new_engine(const kernel::AffineHull& flat,
                                                       const geometry::Frame& frame) {
  const TriangulationEngine* const before = engine              ? engine.get()
                                            : record != nullptr ? record->engine.get()
                                                                : nullptr;
  return compiled::make_triangulation_engine(flat.axes(), sites.points(), frame,
                                             before != nullptr ? effort_of(*before) : engine::Effort{},
                                             options.force_runtime_dimension);
}

void State::add_landmarks(Index first, Index last) {
  try {
    if (!landmarks) landmarks = std::make_unique<Landmarks>(frame_of(*engine), ambient());
    for (Index v = first; v <= last; ++v) landmarks->add(v, sites.point(v));
  } catch (const std::bad_alloc&) {
    landmarks.reset();
  }
}

Index State::start_near(const double* point) const {
  const Index v =
      landmarks ? landmarks->near(point, [&](Index near) { return is_visible(near); }) : invalid_index;
  return v != invalid_index ? index(cell_of(v)) : invalid_index;
}

}  // namespace delone::construction
