// SPDX-License-Identifier: BSD-3-Clause
// How points are inserted and edited, and what queries ask of all kinds.
#include "triangulation/triangulation_impl.hpp"

#include "base/build_limits.hpp"
#include "base/compiler.hpp"
#include "base/parallel.hpp"
#include "base/progress_meter.hpp"
#include "base/require_finite.hpp"
#include "forecast/model/cost.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace delone {

std::unique_ptr<Triangulation::Impl> Triangulation::Impl::clone() const {
  auto copy = std::make_unique<Impl>(dimension(), points().form, state->options);
  copy->state = state->clone();
  if (compacted)
    copy->compacted = std::make_unique<compiled::CompactTriangulation>(copy->points(), *compacted);
  copy->recording = recording;
  copy->changes_ = changes();
  return copy;
}

void Triangulation::Impl::check_finite(std::span<const double> coordinates,
                                       std::span<const double> weights) const {
  internal::require_finite(coordinates, ambient(), "a coordinate");
  internal::require_finite(weights, 1, "the weight");
}

/// What progress functions call must not change the triangulation meanwhile.
void Triangulation::Impl::require_idle() const {
  if (state->record != nullptr) throw Error(Errc::invalid_argument, "the triangulation is being edited");
}

/// Makes insertions possible again after compact(): cells keep their ids.
void Triangulation::Impl::expand() {
  if (!compacted) return;
  auto restored = compiled::make_triangulation_engine(state->affine_hull.axes(), state->sites.points(),
                                                      frame_of(*compacted), effort_of(*compacted),
                                                      state->options.force_runtime_dimension);
  restored->restore(complex());
  state->engine = std::move(restored);
  compacted.reset();
}

/// A transaction, whole or not at all. If `work` returns false, nothing is done, and this returns false. The
/// changes are then still those of the last one. `items`: what it counts, as "points". `prepare` is
/// given the limits.
bool Triangulation::Impl::transact(const char* items,
                                   const std::function<bool(construction::Construction&)>& work,
                                   const std::function<void(internal::BuildLimits&)>& prepare) {
  internal::BuildLimits limits(state->options.memory_limit, state->options.time_limit, items);
  if (prepare) prepare(limits);
  const internal::ProgressMeter meter(state->options.progress);
  changes();
  expand();
  forget();
  const bool is_done = limits.guard([&] {
    construction::Construction construction(*state, recording, limits);
    if (!work(construction)) return false;
    last = construction.commit();
    return true;
  });
  if (!is_done) return false;
  wanted_of_last = recording;
  note_unknown_changes();
  return true;
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
  const auto before = static_cast<double>(points().last_vertex()), added = static_cast<double>(n);
  transact(
      "points",
      [&](construction::Construction& construction) {
        construction.insert(coordinates, weights, release);
        return true;
      },
      [&](internal::BuildLimits& limits) {
        const double speed = cost_model::speedup(internal::threads_to_use(state->options.threads));
        limits.set_model([d = dimension(), before, added, speed](double fraction) {  // of a set spread evenly
          const cost_model::Cost cost = cost_model::cost_of_spread(d, before + fraction * added);
          return internal::WholeCost{cost.bytes, cost.seconds / speed, 1.1 * cost.factor, 2 * cost.factor};
        });
      });
}

InsertResult Triangulation::Impl::insert(std::span<const double> point, double weight,
                                         std::optional<CellId> hint) {
  require_idle();
  std::vector<double> storage;
  const double* const row = checked_query(point, weight, storage);
  Index start = checked_hint(hint);
  if (recording.is_on()) {
    const std::size_t new_row = sites().num_rows();
    const Index num_ids = sites().num_ids();
    edit({.insert = point, .insert_weights = {&weight, weighted() ? std::size_t{1} : std::size_t{0}}}, start);
    const VertexId v = sites().vertex_of(new_row);
    if (!state->is_visible(index(v))) return {};
    return {v, index(v) >= num_ids};
  }
  expand();
  // Functionals of furthest points lead nowhere.
  if (!hint && !state->is_furthest()) {
    if (!state->landmarks && state->engine) state->add_landmarks(1, points().last_vertex());
    start = state->start_near(row);
  }
  return insert_at_once(row, start);
}

/// Without a record: one insertion takes back itself if it fails.
InsertResult Triangulation::Impl::insert_at_once(const double* point, Index start) {
  sites::SiteSet& sites = state->sites;
  sites.reserve_one_more();
  const std::size_t row = sites.add_rows(1);
  const Index v = sites.points().last_vertex() + 1;
  Index at = invalid_index;
  try {
    sites.points().append(point);
    at = state->place(v, start);
    const bool is_duplicate = at != v && at != invalid_index;
    if (is_duplicate) sites.points().drop_last();
    sites.assign(row, is_duplicate ? at : v);  // if it throws, it is a duplicate
  } catch (...) {
    if (sites.points().last_vertex() == v) sites.points().drop_last();
    sites.drop_rows(row);
    throw;
  }
  if (at == v && state->landmarks) state->add_landmarks(v, v);
  return {at == invalid_index ? invalid_vertex : VertexId{at}, at == v};
}

void Triangulation::Impl::edit(const construction::RowEdits& edits, Index start) {
  require_idle();
  if (edits.is_empty()) return;
  construction::EditHints hints{.start = start};
  const std::size_t num_lists =
      !edits.remove.empty() + !edits.move.empty() + !edits.reweight.empty() + !edits.insert.empty();
  if (num_lists == 1 && edits.remove.size() == 1) {
    const engine::Outcome outcome = remove_at_once(edits.remove[0]);
    if (outcome == engine::Outcome::done) return;
    hints.rebuilds = outcome == engine::Outcome::costly;
  }
  if (num_lists == 1 && edits.move.size() == 1 && lone_vertex_of(edits.move[0]) != invalid_index) {
    if (move_at_once(edits.move[0], edits.to)) return;
    hints.moves_in_place = false;
  }
  construction::require_valid(*state, edits);
  transact("changes",
           [&](construction::Construction& construction) { return construction.edit(edits, hints); });
}

bool Triangulation::Impl::edit_in_place(const construction::RowEdits& edits) {
  return transact("changes", [&](construction::Construction& construction) {
    return construction.edit(edits, {.may_rebuild = false});
  });
}

/// The row's vertex if no other row shares it and no record, hidden point, limit or progress is affected;
/// invalid_index for others.
Index Triangulation::Impl::lone_vertex_of(std::size_t row) {
  const Options& options = state->options;
  if (recording.is_on() || state->may_hide() || !state->engine) return invalid_index;
  if (options.progress || options.memory_limit > 0 || options.time_limit > 0) return invalid_index;
  if (row >= sites().num_rows() || sites().vertex_of(row) == invalid_vertex) return invalid_index;
  const Index v = index(sites().vertex_of(row));
  // What detach() will ask for is read here, while other reads are under way.
  return sites().row_of(v) != row || state->sites.has_several(v) ? invalid_index : v;
}

/// Nothing has been done unless the outcome is `done`; `flat` also if it takes a transaction.
engine::Outcome Triangulation::Impl::remove_at_once(std::size_t row) {
  const Index v = lone_vertex_of(row);
  if (v == invalid_index) return engine::Outcome::flat;
  const engine::Change change = state->engine->remove(v, index(state->cell_of(v)));
  if (!change.is_done()) return change.outcome;
  state->update_cells(change.created_cells);
  state->cell_of_vertex[v] = invalid_cell;
  --state->num_vertices;
  state->sites.detach(row);
  return change.outcome;
}

/// The same for a row that moves a little. Returns whether it has moved.
bool Triangulation::Impl::move_at_once(std::size_t row, std::span<const double> to) {
  const Index v = index(sites().vertex_of(row));
  internal::prefetch(sites().point(v));
  if (to.size() != ambient()) return false;
  if (!frame_of(*state->engine).contains(to.data())) return false;
  if (affine_dimension() < dimension() && !state->affine_hull.contains(to.data())) return false;
  const engine::Change change = state->engine->move(v, index(state->cell_of(v)), to.data());
  state->update_cells(change.created_cells);
  return change.is_done();
}

/// Drops the record of the last transaction. REQUIRES that its changes are known.
void Triangulation::Impl::forget() {
  if (last) construction::Construction::forget(*state);
  last.reset();
  wanted_of_last = {};
}

void Triangulation::Impl::forget_changes() {
  changes_ = {};
  are_changes_known_ = true;
}

/// The last transaction has changes, or its cells have got other ids.
void Triangulation::Impl::note_unknown_changes() {
  changes_ = {};
  are_changes_known_ = !wanted_of_last.changes;
}

const construction::AllChanges& Triangulation::Impl::recorded_changes() const {
  if (!recording.changes)
    throw Error(Errc::invalid_argument, "changes are not recorded: record_changes() was not called");
  return changes();
}

/// Makes the lists unless they are known. The first of several threads that ask does.
const construction::AllChanges& Triangulation::Impl::changes() const {
  const std::lock_guard lock(changes_mutex_);
  if (!are_changes_known_) {
    changes_ = construction::Construction::changes_since(*state, *last);
    are_changes_known_ = true;
  }
  return changes_;
}

void Triangulation::Impl::record_changes(bool wanted) {
  recording.changes = wanted;
  wanted_of_last.changes = false;
  forget_changes();
  if (!wanted_of_last.undo) forget();
}

void Triangulation::Impl::record_undo(bool wanted) {
  recording.undo = wanted;
  if (wanted) return;
  wanted_of_last.undo = false;
  if (are_changes_known_) forget();
}

void Triangulation::Impl::undo() {
  require_idle();
  if (!wanted_of_last.undo)
    throw Error(Errc::invalid_argument,
                "there is nothing to undo; only edits after record_undo() can be undone");
  construction::AllChanges all;
  if (recording.changes) {
    all = construction::Construction::changes_since(*state, *last);
    Changes& made = all.lists;
    all.removed_infinite_cells.clear();
    for (const CellId c : made.created_cells)
      if (complex().is_infinite(c)) all.removed_infinite_cells.push_back(c);
    std::swap(made.removed_cells, made.created_cells);
    std::swap(made.added_vertices, made.removed_vertices);
    std::swap(made.hidden_vertices, made.reappeared_vertices);
  }
  construction::Construction::roll_back(*state, *std::exchange(last, nullptr));
  wanted_of_last = {};
  forget_changes();
  changes_ = std::move(all);
}

CompactedIds Triangulation::Impl::compact_ids() {
  require_idle();
  expand();
  CompactedIds ids;
  state->cell_of_vertex.reserve(sites().num_ids());
  state->sites.compact(ids, [&](std::span<const Index> new_ids) {
    if (state->engine) state->engine->renumber_vertices(new_ids);
    if (affine_dimension() == 0) state->only_vertex() = new_ids[state->only_vertex()];
  });
  forget_changes();
  forget();
  state->hidden_points.reset();
  state->landmarks.reset();
  state->find_cells_of_vertices();
  return ids;
}

void Triangulation::Impl::compact() {
  require_idle();
  forget_changes();
  forget();
  state->hidden_points.reset();
  state->landmarks.reset();
  if (state->engine) {
    compacted = std::make_unique<compiled::CompactTriangulation>(state->affine_hull.axes(), points(),
                                                                 *state->engine, state->complex());
    state->engine.reset();
    state->find_cells_of_vertices(complex());
  }
  state->sites.shrink_to_fit();
  state->cell_of_vertex.shrink_to_fit();
}

/// Also after compact(), since insertions are possible then. If the last transaction made all cells, its
/// record does not tell their ids, and is kept.
void Triangulation::Impl::sort_cells() {
  require_idle();
  if (!state->ids_tell_of_timing) return;
  const bool keeps_record = last && last->has_other_engine;
  if (!keeps_record) {
    forget_changes();
    forget();
  }
  state->hidden_points.reset();
  expand();
  if (!state->engine) return;
  state->sort_cells();
  if (keeps_record) note_unknown_changes();
  state->find_cells_of_vertices();
  state->ids_tell_of_timing = false;
}

/// Inserted rows without a vertex that has cells.
std::size_t Triangulation::Impl::num_hidden() const {
  if (!state->may_hide()) return 0;
  return static_cast<std::size_t>(
      std::count_if(sites().vertices_of_rows().begin(), sites().vertices_of_rows().end(),
                    [&](VertexId v) { return v != invalid_vertex && !state->is_visible(index(v)); }));
}

void Triangulation::Impl::require_row(std::size_t row) const {
  if (row >= sites().num_rows())
    throw Error(Errc::invalid_argument, "row " + std::to_string(row) + " is not a row of the input");
}

bool Triangulation::Impl::is_hidden(std::size_t row) const {
  require_row(row);
  const VertexId v = sites().vertex_of(row);
  return v != invalid_vertex && !state->is_visible(index(v));
}

std::vector<std::size_t> Triangulation::Impl::hidden_rows() const {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < sites().num_rows(); ++row)
    if (is_hidden(row)) rows.push_back(row);
  return rows;
}

const double* Triangulation::Impl::checked_query(std::span<const double> query, double weight,
                                                 std::vector<double>& row) const {
  if (query.size() != ambient())
    throw Error(Errc::bad_dimension, "the point has " + std::to_string(query.size()) + " coordinates, not " +
                                         std::to_string(dimension()));
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
  if (v == infinite_vertex || !state->is_visible(index(v)))
    throw Error(Errc::invalid_argument, "not a finite vertex");
  return index(v);
}

std::vector<CellId> Triangulation::Impl::conflict_zone(std::span<const double> query, double weight,
                                                       std::optional<CellId> hint) const {
  std::vector<double> storage;
  const double* q = checked_query(query, weight, storage);
  const Index start = checked_hint(hint);
  if (affine_dimension() < dimension() && !state->affine_hull.contains(q)) return {};
  if (has_cells()) return visit([&](const auto& cells) { return compiled::conflict_zone(cells, q, start); });
  const bool is_heavier = weighted() && weight > points().point(state->only_vertex())[ambient()];
  return is_heavier ? std::vector<CellId>{CellId{0}} : std::vector<CellId>{};
}

Sign Triangulation::Impl::in_sphere(CellId cell, std::span<const double> query, double weight) const {
  std::vector<double> storage;
  const double* q = checked_query(query, weight, storage);
  const Complex now = complex();
  if (!now.is_cell(cell) || now.is_infinite(cell)) throw Error(Errc::invalid_argument, "not a finite cell");
  if (affine_dimension() < dimension() && !state->affine_hull.contains(q))
    throw Error(Errc::invalid_argument, "the query is outside the affine hull of the points");
  if (has_cells()) {
    const Sign side = visit([&](const auto& cells) { return unperturbed_side(cells, index(cell), q); });
    return state->is_furthest() ? -side : side;
  }
  if (!weighted()) return Sign::zero;
  const double weight_of_vertex = points().point(state->only_vertex())[ambient()];
  return weight > weight_of_vertex ? Sign::negative : weight < weight_of_vertex ? Sign::positive : Sign::zero;
}

}  // namespace delone
