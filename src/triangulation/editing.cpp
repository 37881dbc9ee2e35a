// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/editing.hpp"

#include "base/build_limits.hpp"
#include "base/compiler.hpp"
#include "base/require_finite.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace delone {
namespace {

// Messages begin with the call that a list belongs to, and the place in it if there are several:
// "remove[2]: row 7 was removed".

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string place_in(const char* list, std::size_t size, std::size_t place) {
  std::string text = list;
  if (size != 1) text.append("[").append(std::to_string(place)).append("]");
  return text;
}

/// Throws where two lists that belong together are not of one length.
void require_as_many(const char* list, std::size_t found, const char* what, std::size_t expected,
                     const char* of) {
  if (found != expected)
    throw Error(Errc::bad_dimension,
                std::string(list) + ": " + counted(found, what) + " for " + counted(expected, of));
}

void require_whole_points(const char* list, std::size_t num_coordinates, std::size_t dimension) {
  if (num_coordinates % dimension != 0)
    throw Error(Errc::bad_dimension,
                std::string(list) + ": the number of coordinates is not a multiple of the dimension");
}

[[noreturn]] void throw_for_row(const char* list, std::span<const std::size_t> rows, std::size_t place,
                                const std::string& problem) {
  throw Error(Errc::invalid_argument,
              place_in(list, rows.size(), place) + ": row " + std::to_string(rows[place]) + " " + problem,
              {place});
}

[[noreturn]] void throw_for_repeated(const char* list, std::span<const std::size_t> rows, std::size_t first,
                                     std::size_t place) {
  throw_for_row(list, rows, place, "is given twice, see " + place_in(list, rows.size(), first));
}

/// `rows`: those that the numbers are for, or none: for new ones.
void require_finite(const char* list, std::span<const double> numbers, std::size_t width,
                    const std::string& what, std::span<const std::size_t> rows = {}) {
  const std::vector<std::size_t> places = internal::find_not_finite(numbers, width);
  if (places.empty()) return;
  const std::string row = rows.empty() ? "" : " for row " + std::to_string(rows[places.front()]);
  throw Error(Errc::not_finite,
              place_in(list, numbers.size() / width, places.front()) + ": " + what + row + " is not finite" +
                  internal::and_of_more(places),
              places);
}

}  // namespace

Triangulation::Impl::Editing::Editing(Impl& impl, const RowEdits& edits, Index start, bool anew)
    : impl_(impl),
      edits_(edits),
      start_(start),
      anew_(anew),
      total_(edits.remove.size() + 2 * (edits.move.size() + edits.weigh.size()) +
             edits.insert.size() / impl.ambient()),
      progress_(impl.options.progress, total_) {
  const std::size_t d = impl.ambient();
  require_whole_points("move", edits.to.size(), d);
  require_whole_points("insert", edits.insert.size(), d);
  const std::size_t num_inserted = edits.insert.size() / d;
  require_as_many("move", edits.to.size() / d, "point", edits.move.size(), "row");
  require_as_many("set_weights", edits.weights.size(), "weight", edits.weigh.size(), "row");
  if (!impl.weighted() && !(edits.weigh.empty() && edits.insert_weights.empty()))
    throw Error(Errc::invalid_argument, std::string(edits.weigh.empty() ? "insert" : "set_weights") +
                                            ": points of this triangulation have no weights");
  if (impl.weighted())
    require_as_many("insert", edits.insert_weights.size(), "weight", num_inserted, "point");
  require_rows("remove", edits.remove);
  require_rows("move", edits.move);
  require_rows("set_weights", edits.weigh);
  require_disjoint("move", edits.move);
  require_disjoint("set_weights", edits.weigh);
  require_finite("move", edits.to, d, "a coordinate", edits.move);
  require_finite("set_weights", edits.weights, 1, "the weight", edits.weigh);
  require_finite("insert", edits.insert, d, "a coordinate");
  require_finite("insert", edits.insert_weights, 1, "the weight");
  if (num_inserted > max_index - impl.vertex_of_row.size())
    throw Error(Errc::too_many, "insert: more points than this build has ids");
}

Triangulation::Impl::Editing::~Editing() {
  impl_.record = nullptr;
  if (record_ && !is_done_) impl_.roll_back(*record_);
}

/// Rows of one list are there, and are different.
void Triangulation::Impl::Editing::require_rows(const char* list, std::span<const std::size_t> rows) const {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] >= impl_.vertex_of_row.size()) throw_for_row(list, rows, i, "is not a row of the input");
    if (impl_.vertex_of_row[rows[i]] == invalid_vertex) throw_for_row(list, rows, i, "was removed");
  }
  if (rows.size() < 2) return;
  if (rows.size() > impl_.vertex_of_row.size() / 16) {
    std::vector<bool> is_known(impl_.vertex_of_row.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (is_known[rows[i]]) {
        const auto first = std::find(rows.begin(), rows.end(), rows[i]);
        throw_for_repeated(list, rows, static_cast<std::size_t>(first - rows.begin()), i);
      }
      is_known[rows[i]] = true;
    }
    return;
  }
  std::vector<std::pair<std::size_t, std::size_t>> sorted;
  for (std::size_t i = 0; i < rows.size(); ++i) sorted.emplace_back(rows[i], i);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first)
      throw_for_repeated(list, rows, sorted[i - 1].second, sorted[i].second);
}

/// No row of the list is removed.
void Triangulation::Impl::Editing::require_disjoint(const char* list,
                                                    std::span<const std::size_t> rows) const {
  if (edits_.remove.empty() || rows.empty()) return;
  std::vector<std::size_t> removed(edits_.remove.begin(), edits_.remove.end());
  std::sort(removed.begin(), removed.end());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::binary_search(removed.begin(), removed.end(), rows[i])) {
      const auto there = std::find(edits_.remove.begin(), edits_.remove.end(), rows[i]);
      const auto place = static_cast<std::size_t>(there - edits_.remove.begin());
      throw_for_row(list, rows, i, "is removed, see " + place_in("remove", removed.size(), place));
    }
}

/// One step more; a move is two, and may be none.
void Triangulation::Impl::Editing::tick() { progress_(std::min(++done_, total_)); }

/// So many vertices of all have been placed anew: a part of what was left to do before.
void Triangulation::Impl::Editing::tick_batch(std::size_t placed, std::size_t of) {
  const std::size_t begun = std::min(done_, total_);
  progress_(begun + (total_ - begun) * placed / of);
}

void Triangulation::Impl::Editing::run() {
  begin();
  plan();
  settle_all();
  settle_some();
  if (is_worth_building_anew() || !take_all_out())
    build_anew();
  else
    place_all();
  finish();
}

/// From here on everything that changes is noted.
void Triangulation::Impl::Editing::begin() {
  impl_.expand();
  impl_.forget_undo();
  auto record = std::make_unique<internal::EditRecord>();
  record->affine_hull = impl_.affine_hull;
  record->num_coordinates = impl_.points.coordinates.size();
  record->num_rows = impl_.vertex_of_row.size();
  record->num_row_of_vertex = impl_.row_of_vertex.size();
  record->num_cell_of_vertex = impl_.cell_of_vertex.size();
  record->num_rows_inserted = impl_.num_rows_inserted;
  record->num_vertices = impl_.num_vertices;
  record->only_vertex = impl_.only_vertex();
  record->had_ids_of_threads = impl_.has_ids_of_threads;
  impl_.known_shared_rows();
  record_ = std::move(record);
  impl_.record = record_.get();
}

/// What becomes of vertices.
void Triangulation::Impl::Editing::plan() {
  for (const std::size_t row : edits_.remove) {
    const Index v = index(impl_.vertex_of_row[row]);
    impl_.detach(row);
    if (is_dying(v)) dead_.push_back(v);
  }
  for (const Index v : dead_)
    if (impl_.is_visible(v)) leaving_.push_back({v, none});
  const std::size_t d = impl_.ambient(), num_inserted = edits_.insert.size() / d;
  const std::size_t num_placed = edits_.move.size() + edits_.weigh.size() + num_inserted;
  placements_.reserve(num_placed);
  points_.reserve(num_placed * impl_.row_size());
  leaving_.reserve(leaving_.size() + edits_.move.size() + edits_.weigh.size());
  record_->moved.reserve(edits_.move.size() + edits_.weigh.size());
  record_->points.reserve((edits_.move.size() + edits_.weigh.size()) * impl_.row_size());
  plan_moves();
  const std::size_t first_row = impl_.vertex_of_row.size();
  impl_.vertex_of_row.resize(first_row + num_inserted, invalid_vertex);
  for (std::size_t i = 0; i < num_inserted; ++i) {
    const auto row = static_cast<Index>(first_row + i);
    placements_.push_back({invalid_index, row, next_point(), invalid_index});
    add_point(edits_.insert.subspan(i * d, d), impl_.weighted() ? edits_.insert_weights[i] : 0);
  }
}

/// Rows that get another point, another weight, or both.
void Triangulation::Impl::Editing::plan_moves() {
  const std::size_t d = impl_.ambient();
  std::vector<std::pair<std::size_t, std::size_t>> weighed;  // rows, and their numbers in the list
  for (std::size_t i = 0; i < edits_.weigh.size(); ++i) weighed.emplace_back(edits_.weigh[i], i);
  std::sort(weighed.begin(), weighed.end());
  const auto find = [&](std::size_t row) {
    const auto found = std::lower_bound(weighed.begin(), weighed.end(), std::pair(row, std::size_t{0}));
    return found != weighed.end() && found->first == row ? found : weighed.end();
  };
  const auto move_row = [&](std::size_t row, std::span<const double> to, double weight) {
    const Index v = index(impl_.vertex_of_row[row]);
    const double* const before = impl_.points.point(v);
    if (std::equal(to.begin(), to.end(), before) && (!impl_.weighted() || weight == before[d])) return;
    const Index number = next_point();
    add_point(to, weight);
    if (impl_.known_shared_rows().has_several(v)) {
      impl_.detach(row);
      placements_.push_back({invalid_index, static_cast<Index>(row), number, v});
      return;
    }
    if (impl_.is_visible(v)) leaving_.push_back({v, static_cast<Index>(placements_.size())});
    placements_.push_back({v, static_cast<Index>(row), number, invalid_index});
  };
  constexpr std::size_t ahead = 16;
  for (std::size_t i = 0; i < edits_.move.size(); ++i) {
    if (i + ahead < edits_.move.size()) {
      const Index soon = index(impl_.vertex_of_row[edits_.move[i + ahead]]);
      prefetch(impl_.points.point(soon));
      prefetch(impl_.cell_of_vertex.data() + soon);
    }
    const std::size_t row = edits_.move[i];
    double weight = impl_.weighted() ? impl_.points.point(index(impl_.vertex_of_row[row]))[d] : 0;
    if (const auto found = find(row); found != weighed.end()) {
      weight = edits_.weights[found->second];
      weighed.erase(found);
    }
    move_row(row, edits_.to.subspan(i * d, d), weight);
  }
  for (const auto& [row, i] : weighed) {
    const double* const before = impl_.points.point(index(impl_.vertex_of_row[row]));
    const std::vector<double> there(before, before + d);
    move_row(row, there, edits_.weights[i]);
  }
}

void Triangulation::Impl::Editing::add_point(std::span<const double> coordinates, double weight) {
  points_.insert(points_.end(), coordinates.begin(), coordinates.end());
  if (impl_.weighted()) points_.push_back(weight);
}

/// One vertex after the other costs about as much as two insertions for each that leaves and one for each
/// that comes, and those of a batch cost less than half.
bool Triangulation::Impl::Editing::is_worth_building_anew() const {
  const std::size_t left = impl_.num_vertices - leaving_.size() + placements_.size();
  constexpr std::size_t fewest = 16;
  if (anew_) return true;
  return leaving_.size() + placements_.size() >= fewest &&
         2 * leaving_.size() + placements_.size() > left / 2;
}

/// The same when so many have been taken out. A batch inserts those that stay hidden, too.
bool Triangulation::Impl::Editing::has_freed_many(std::size_t num_taken_out) const {
  constexpr std::size_t fewest = 64;
  if (freed_.size() < fewest) return false;
  const std::size_t left_to_go = leaving_.size() - num_taken_out;
  const std::size_t num_hidden = impl_.hidden_points ? impl_.hidden_points->size() : 0;
  const std::size_t in_all =
      impl_.num_vertices - left_to_go + num_hidden + freed_.size() + placements_.size();
  return 2 * left_to_go + freed_.size() + placements_.size() > in_all / 2;
}

void Triangulation::Impl::Editing::begin_batch() {
  if (!impl_.engine || record_->engine_has_log) return;
  const std::size_t changes = leaving_.size() + placements_.size();
  impl_.engine->begin_batch(changes < impl_.num_vertices / 64 + 16);
  record_->engine_has_log = true;
}

void Triangulation::Impl::Editing::finish() {
  if (impl_.records_changes) impl_.changes = impl_.changes_since(*record_);
  impl_.record = nullptr;
  is_done_ = true;
  if (impl_.records_undo)
    impl_.last_edit = std::move(record_);
  else if (impl_.engine && !record_->has_other_engine)
    impl_.engine->keep_batch();
}

/// The vertex of a row that is alone at it and may go or move without anything that a record or hidden points
/// have to know; invalid_index for others.
Index Triangulation::Impl::lone_vertex_of(std::size_t row) {
  if (records_changes || records_undo || may_hide() || !engine) return invalid_index;
  if (options.progress || options.memory_limit > 0 || options.time_limit > 0) return invalid_index;
  if (row >= vertex_of_row.size() || vertex_of_row[row] == invalid_vertex) return invalid_index;
  const Index v = index(vertex_of_row[row]);
  return known_shared_rows().has_several(v) ? invalid_index : v;
}

/// Nothing has been done unless the outcome is `done`; `flat` also where it takes the long way.
engine::Outcome Triangulation::Impl::remove_at_once(std::size_t row) {
  const Index v = lone_vertex_of(row);
  if (v == invalid_index) return engine::Outcome::flat;
  const engine::Change change = engine->remove(v, index(cell_of_vertex[v]));
  if (!change.is_done()) return change.outcome;
  update_cells(change.made);
  cell_of_vertex[v] = invalid_cell;
  --num_vertices;
  detach(row);
  return change.outcome;
}

/// The same for a row that moves a little.
bool Triangulation::Impl::move_at_once(std::size_t row, std::span<const double> to) {
  const Index v = lone_vertex_of(row);
  if (v == invalid_index || to.size() != ambient() || !engine->frame().contains(to.data())) return false;
  if (affine_hull.dimension() < dimension && !affine_hull.contains(to.data())) return false;
  const engine::Change change = engine->move(v, index(cell_of_vertex[v]), to.data());
  update_cells(change.made);
  return change.is_done();
}

void Triangulation::Impl::edit(const RowEdits& edits, Index start) {
  require_idle();
  if (edits.is_empty()) return;
  bool anew = false;
  if (edits.remove.size() == 1 && edits.move.empty() && edits.weigh.empty() && edits.insert.empty()) {
    const engine::Outcome outcome = remove_at_once(edits.remove[0]);
    if (outcome == engine::Outcome::done) return;
    anew = outcome == engine::Outcome::costly;
  }
  if (edits.move.size() == 1 && edits.remove.empty() && edits.weigh.empty() && edits.insert.empty() &&
      move_at_once(edits.move[0], edits.to))
    return;
  internal::BuildLimits limits(options.memory_limit, options.time_limit, "changes");
  limits.guard([&] { Editing(*this, edits, start, anew).run(); });
}

InsertResult Triangulation::Impl::insert_on_record(std::span<const double> point, double weight,
                                                   Index start) {
  const std::size_t row = vertex_of_row.size();
  const std::size_t num_ids = row_of_vertex.size();
  edit({.insert = point, .insert_weights = {&weight, weighted() ? std::size_t{1} : std::size_t{0}}}, start);
  const VertexId v = vertex_of_row[row];
  if (!is_visible(index(v))) return {};
  return {v, index(v) >= num_ids};
}

}  // namespace delone
