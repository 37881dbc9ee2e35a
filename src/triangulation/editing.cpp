// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/editing.hpp"

#include "base/build_limits.hpp"
#include "base/require_finite.hpp"
#include "base/stopwatch.hpp"
#include "order/insertion_order.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace delone {
namespace {

/// Throws where a list of rows and what belongs to them are not of one length.
void require_as_many(std::size_t rows, std::size_t found, const char* what) {
  if (rows != found)
    throw Error(Errc::bad_dimension, std::to_string(found) + " " + what + " for " + std::to_string(rows) +
                                         (rows == 1 ? " row" : " rows"));
}

/// Exchanges the first two vertices of a cell, and its neighbors: the cell is oriented the other way then.
void exchange_first_two(Index* links, std::size_t corners) {
  std::swap(links[0], links[1]);
  std::swap(links[corners], links[corners + 1]);
}

[[noreturn]] void throw_for_row(std::size_t row, const std::string& problem, std::size_t place) {
  throw Error(Errc::invalid_argument, "row " + std::to_string(row) + " " + problem, {place});
}

}  // namespace

Triangulation::Impl::Editing::Editing(Impl& impl, const RowEdits& edits)
    : impl_(impl),
      edits_(edits),
      total_(edits.remove.size() + 2 * (edits.move.size() + edits.weigh.size()) +
             edits.insert.size() / impl.ambient()),
      progress_(impl.options.progress, total_) {
  const std::size_t d = impl.ambient();
  if (edits.to.size() % d != 0 || edits.insert.size() % d != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  const std::size_t num_inserted = edits.insert.size() / d;
  require_as_many(edits.move.size(), edits.to.size() / d, "points");
  require_as_many(edits.weigh.size(), edits.weights.size(), "weights");
  if (!impl.weighted() && !(edits.weigh.empty() && edits.insert_weights.empty()))
    throw Error(Errc::invalid_argument, "points of this triangulation have no weights");
  if (impl.weighted() || !edits.insert_weights.empty())
    require_as_many(num_inserted, edits.insert_weights.size(), "weights");
  require_rows(edits.remove, "removed");
  require_rows(edits.move, "moved");
  require_rows(edits.weigh, "weighed");
  require_disjoint();
  internal::require_finite(edits.to, d, "a coordinate");
  internal::require_finite(edits.weights, 1, "the weight");
  internal::require_finite(edits.insert, d, "a coordinate");
  internal::require_finite(edits.insert_weights, 1, "the weight");
  if (num_inserted > max_index - impl.vertex_of_row.size())
    throw Error(Errc::too_many, "more points than this build has ids");
}

Triangulation::Impl::Editing::~Editing() {
  impl_.record = nullptr;
  if (record_ && !is_done_) impl_.roll_back(*record_);
}

/// Rows of one list are there, and are different.
void Triangulation::Impl::Editing::require_rows(std::span<const std::size_t> rows, const char* verb) const {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] >= impl_.vertex_of_row.size()) throw_for_row(rows[i], "is not a row of the input", i);
    if (impl_.vertex_of_row[rows[i]] == invalid_vertex) throw_for_row(rows[i], "was removed", i);
  }
  if (rows.size() < 2) return;
  if (rows.size() > impl_.vertex_of_row.size() / 16) {
    std::vector<bool> is_known(impl_.vertex_of_row.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (is_known[rows[i]]) throw_for_row(rows[i], std::string("is ") + verb + " twice", i);
      is_known[rows[i]] = true;
    }
    return;
  }
  std::vector<std::pair<std::size_t, std::size_t>> sorted;
  for (std::size_t i = 0; i < rows.size(); ++i) sorted.emplace_back(rows[i], i);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first)
      throw_for_row(sorted[i].first, std::string("is ") + verb + " twice", sorted[i].second);
}

/// No row is removed and moved or weighed.
void Triangulation::Impl::Editing::require_disjoint() const {
  if (edits_.remove.empty() || (edits_.move.empty() && edits_.weigh.empty())) return;
  std::vector<std::size_t> removed(edits_.remove.begin(), edits_.remove.end());
  std::sort(removed.begin(), removed.end());
  for (const auto rows : {edits_.move, edits_.weigh})
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (std::binary_search(removed.begin(), removed.end(), rows[i]))
        throw_for_row(rows[i],
                      rows.data() == edits_.move.data() ? "is removed and moved" : "is removed and weighed",
                      i);
}

/// One step more; a move is two, and may be none.
void Triangulation::Impl::Editing::tick() { progress_(std::min(++done_, total_)); }

void Triangulation::Impl::Editing::run() {
  begin();
  plan();
  settle_all();
  settle_some();
  if (is_worth_building_anew()) {
    build_anew();
  } else {
    take_all_out();
    place_all();
  }
  finish();
}

/// From here on everything that changes is noted.
void Triangulation::Impl::Editing::begin() {
  impl_.expand();
  if (impl_.last_edit) {
    if (impl_.engine) impl_.engine->keep_batch();
    impl_.last_edit.reset();
  }
  auto record = std::make_unique<internal::EditRecord>();
  record->affine_hull = impl_.affine_hull;
  record->num_coordinates = impl_.points.coordinates.size();
  record->num_rows = impl_.vertex_of_row.size();
  record->num_row_of_vertex = impl_.row_of_vertex.size();
  record->num_cell_of_vertex = impl_.cell_of_vertex.size();
  record->num_rows_inserted = impl_.num_rows_inserted;
  record->num_vertices = impl_.num_vertices;
  record->only_vertex = impl_.only_vertex();
  record->has_ids_of_threads = impl_.has_ids_of_threads;
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
    placements_.push_back({invalid_index, first_row + i, points_.size() / impl_.row_size(), invalid_index});
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
    const std::size_t number = points_.size() / impl_.row_size();
    add_point(to, weight);
    if (impl_.known_shared_rows().has_several(v)) {
      impl_.detach(row);
      placements_.push_back({invalid_index, row, number, v});
      return;
    }
    if (impl_.is_visible(v)) leaving_.push_back({v, placements_.size()});
    placements_.push_back({v, row, number, invalid_index});
  };
  for (std::size_t i = 0; i < edits_.move.size(); ++i) {
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
  return left >= 16 && 2 * leaving_.size() + placements_.size() > left / 2;
}

void Triangulation::Impl::Editing::begin_batch() {
  if (!impl_.engine || record_->engine_has_log) return;
  const std::size_t changes = leaving_.size() + placements_.size();
  impl_.engine->begin_batch(changes < impl_.num_vertices / 64 + 16);
  record_->engine_has_log = true;
}

/// Whether a vertex may stay where it is in the cells: it has some, and gets a point that neither the
/// dimension nor the frame has to change for. Where points may be hidden, a move may hide them and set them
/// free.
bool Triangulation::Impl::Editing::can_settle(const Placement& placement) const {
  return placement.vertex != invalid_index && impl_.engine->frame().contains(point(placement)) &&
         (impl_.affine_hull.dimension() == impl_.dimension || impl_.affine_hull.contains(point(placement)));
}

/// Where many vertices move, all at once. If that fails, the cells of the engine are of no use before they
/// are rolled back.
void Triangulation::Impl::Editing::settle_all() {
  const auto moves = [](const Leaving& leaving) { return leaving.placement != none; };
  const auto num_moving = static_cast<std::size_t>(std::count_if(leaving_.begin(), leaving_.end(), moves));
  if (!impl_.engine || impl_.may_hide() || num_moving < 64 || num_moving < impl_.num_vertices / 4) return;
  std::vector<double> low(impl_.engine->frame().low()), high(impl_.engine->frame().high());
  for (const Leaving& leaving : leaving_) {
    if (!moves(leaving)) continue;
    const double* const x = point(placements_[leaving.placement]);
    if (impl_.affine_hull.dimension() < impl_.dimension && !impl_.affine_hull.contains(x)) return;
    for (std::size_t j = 0; j < low.size(); ++j) {
      low[j] = std::min(low[j], x[j]);
      high[j] = std::max(high[j], x[j]);
    }
  }
  // With a margin, so that steps that follow stay inside.
  std::optional<geometry::Frame> frame;
  if (!impl_.engine->frame().contains(low.data()) || !impl_.engine->frame().contains(high.data()))
    frame = impl_.frame_with(low.data(), high.data(), 0.0625);
  impl_.engine->begin_batch(true);
  record_->engine_has_log = true;
  record_->has_settled = true;
  const std::size_t first = record_->moved.size();
  for (const Leaving& leaving : leaving_)
    if (moves(leaving)) set_point(leaving.vertex, point(placements_[leaving.placement]));
  if (!impl_.engine->settle_all(std::move(frame))) {  // so much moves that all will be built anew
    restore_points(first);
    return;
  }
  impl_.update_cells(impl_.engine->made_by_settling());
  impl_.landmarks.reset();
  std::erase_if(placements_, [](const Placement& placement) { return placement.vertex != invalid_index; });
  std::erase_if(leaving_, moves);
}

/// One by one. Those that cannot stay where they are move in another way.
void Triangulation::Impl::Editing::settle_some() {
  if (!impl_.engine || impl_.may_hide() || is_worth_building_anew()) return;
  const auto moves = [](const Leaving& leaving) { return leaving.placement != none; };
  std::vector<std::uint8_t> is_settled(placements_.size(), 0);
  std::size_t failures = 0;
  for (const Leaving& leaving : leaving_) {
    // Where one in two does not stay, trying costs more than it saves.
    if (!moves(leaving) || failures > 16 + done_) continue;
    const Placement& placement = placements_[leaving.placement];
    if (!can_settle(placement)) continue;
    begin_batch();
    record_->has_settled = true;
    const std::size_t first = record_->moved.size();
    set_point(leaving.vertex, point(placement));
    const Index cell = index(impl_.cell_of_vertex[leaving.vertex]);
    if (!impl_.engine->settle(leaving.vertex, cell)) {
      restore_points(first);
      impl_.engine->renew(leaving.vertex, cell);
      ++failures;
      continue;
    }
    impl_.update_cells(impl_.engine->made_by_settling());
    is_settled[leaving.placement] = 1;
    tick();
  }
  if (done_ == 0) return;
  std::vector<std::size_t> new_places(placements_.size(), none);
  std::size_t count = 0;
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    if (is_settled[i] != 0) continue;
    new_places[i] = count;
    placements_[count++] = placements_[i];
  }
  placements_.resize(count);
  std::erase_if(leaving_,
                [&](const Leaving& leaving) { return moves(leaving) && is_settled[leaving.placement] != 0; });
  for (Leaving& leaving : leaving_)
    if (moves(leaving)) leaving.placement = new_places[leaving.placement];
}

/// Takes back the points that were set last.
void Triangulation::Impl::Editing::restore_points(std::size_t first) {
  const std::size_t size = impl_.row_size();
  for (std::size_t i = first; i < record_->moved.size(); ++i)
    std::copy_n(record_->points.begin() + static_cast<std::ptrdiff_t>(i * size), size,
                impl_.points.coordinates.begin() + static_cast<std::ptrdiff_t>(record_->moved[i] * size));
  record_->moved.resize(first);
  record_->points.resize(first * size);
}

/// Of vertices of new cells.
void Triangulation::Impl::update_cells(std::span<const Index> made) {
  const Complex now = complex();
  for (const Index cell : made) {
    if (!now.is_cell(CellId{cell})) continue;
    for (int i = 0; i <= now.affine_dimension(); ++i)
      cell_of_vertex[index(now.vertex(CellId{cell}, i))] = CellId{cell};
  }
}

void Triangulation::Impl::Editing::take_all_out() {
  begin_batch();
  if (impl_.engine && impl_.may_hide() && !impl_.hidden_points && !leaving_.empty()) find_hidden_points();
  if (impl_.hidden_points) {
    const auto take_from_list = [&](Index v) {
      if (impl_.hidden_points->contains(v)) impl_.hidden_points->remove(v);
    };
    for (const Index v : dead_) take_from_list(v);
    for (const Placement& placement : placements_)
      if (placement.vertex != invalid_index) take_from_list(placement.vertex);
  }
  for (const Leaving& leaving : leaving_) {
    tick();
    const Index near = take_out(leaving.vertex);
    if (leaving.placement != none) placements_[leaving.placement].near = near;
  }
}

/// Every hidden point gets its place in a list.
void Triangulation::Impl::Editing::find_hidden_points() {
  const std::size_t d = impl_.ambient();
  std::vector<Index> hidden;
  std::vector<double> coordinates;
  for (Index v = 1; v < impl_.row_of_vertex.size(); ++v) {
    if (impl_.is_visible(v) || is_dying(v)) continue;
    hidden.push_back(v);
    coordinates.insert(coordinates.end(), impl_.points.point(v), impl_.points.point(v) + d);
  }
  auto lists = std::make_unique<internal::HiddenPoints>();
  lists->reserve(std::size_t{impl_.points.last_vertex()} + 1, impl_.complex().num_cell_slots());
  Index start = invalid_index;
  for (const Index i : order::insertion_order({coordinates, impl_.dimension}, impl_.options)) {
    internal::cancellation_point();
    start = impl_.engine->locate(impl_.points.point(hidden[i]), start).cell;
    lists->add(hidden[i], start);
  }
  impl_.hidden_points = std::move(lists);
}

/// Returns a vertex that was its neighbor, or invalid_index.
Index Triangulation::Impl::Editing::take_out(Index v) {
  impl_.note_visibility(v);
  if (!impl_.engine) {
    take_out_only_vertex();
    return invalid_index;
  }
  if (!impl_.engine->remove(v, index(impl_.cell_of_vertex[v]))) {
    lower(v);
    return invalid_index;
  }
  if (impl_.hidden_points)
    for (const Index cell : impl_.engine->replaced()) impl_.hidden_points->take(cell, freed_);
  impl_.update_cells(impl_.engine->made_by_removal());
  const Complex now = impl_.complex();
  const CellId any{impl_.engine->made_by_removal().front()};
  const VertexId first = now.vertex(any, 0);
  const Index near = index(first != infinite_vertex ? first : now.vertex(any, 1));
  impl_.cell_of_vertex[v] = invalid_cell;
  --impl_.num_vertices;
  return near;
}

/// All points that are left are in its place. They come again like hidden points.
void Triangulation::Impl::Editing::take_out_only_vertex() {
  std::vector<Index> known(freed_);
  known.push_back(impl_.only_vertex());
  for (const Placement& placement : placements_)
    if (placement.vertex != invalid_index) known.push_back(placement.vertex);
  std::sort(known.begin(), known.end());
  for (Index v = 1; v < record_->num_row_of_vertex; ++v)
    if (!is_dying(v) && !std::binary_search(known.begin(), known.end(), v)) freed_.push_back(v);
  impl_.affine_hull = kernel::AffineHull(impl_.dimension);
  impl_.cell_of_vertex.assign(impl_.cell_of_vertex.size(), invalid_cell);
  impl_.num_vertices = 0;
}

/// Takes out a vertex without which all others span a flat of one dimension less: each cell of it is a cell
/// of that flat joined to it (engine/dimension_jump.hpp).
void Triangulation::Impl::Editing::lower(Index v) {
  const Complex now = impl_.complex();
  const int k = now.affine_dimension();
  const auto corners = static_cast<std::size_t>(k);
  std::vector<Index> number(now.num_cell_slots(), invalid_index), links;
  kernel::AffineHull flat(impl_.dimension);
  Index num_cells = 0, num_infinite = 0, any = invalid_index;
  const auto slot_of_v = [&](CellId c) {
    for (int i = 0; i <= k; ++i)
      if (index(now.vertex(c, i)) == v) return i;
    return -1;
  };
  for (const CellId c : now.all_cells()) {
    if (impl_.hidden_points) impl_.hidden_points->take(index(c), freed_);
    const int slot = slot_of_v(c);
    if (slot < 0) continue;
    number[index(c)] = num_cells++;
    num_infinite += now.is_infinite(c) ? 1 : 0;
    for (int i = 0; i <= k && flat.dimension() < k - 1; ++i)
      if (i != slot && now.vertex(c, i) != infinite_vertex)
        flat.add(impl_.points.point(index(now.vertex(c, i))));
    for (int i = 0; i <= k; ++i)
      if (i != slot && now.vertex(c, i) != infinite_vertex) any = index(now.vertex(c, i));
  }
  if (k == 1) {
    impl_.replace_engine(nullptr);
    impl_.only_vertex() = any;
  } else {
    // The cells of v are coherently oriented as seen from v, up to exchanges that bring v to the first slot.
    links.reserve(2 * corners * num_cells);
    for (const CellId c : now.all_cells()) {
      if (number[index(c)] == invalid_index) continue;
      const int slot = slot_of_v(c);
      const std::size_t first = links.size();
      for (int i = 0; i <= k; ++i)
        if (i != slot) links.push_back(index(now.vertex(c, i)));
      for (int i = 0; i <= k; ++i)
        if (i != slot) links.push_back(number[index(now.neighbor(c, i))]);
      if (slot % 2 == 1) exchange_first_two(links.data() + first, corners);
    }
    const auto is_finite = [&](std::size_t cell) {
      const Index* const vertices = links.data() + 2 * corners * cell;
      return std::find(vertices, vertices + corners, index(infinite_vertex)) == vertices + corners;
    };
    std::size_t finite = 0;
    while (!is_finite(finite)) ++finite;
    std::vector<const double*> simplex;
    for (std::size_t i = 0; i < corners; ++i)
      simplex.push_back(impl_.points.point(links[2 * corners * finite + i]));
    if (kernel::orientation(flat.flat(), simplex) == Sign::negative)
      for (std::size_t cell = 0; cell < num_cells; ++cell)
        exchange_first_two(links.data() + 2 * corners * cell, corners);
    auto lowered = make_triangulation_engine(flat.axes(), impl_.points, impl_.engine->frame(),
                                             impl_.engine->effort(), impl_.options.force_runtime_dimension);
    lowered->restore({{links.data(), 2 * corners, false},
                      k - 1,
                      num_cells,
                      num_cells - num_infinite,
                      num_infinite,
                      impl_.num_vertices - 1,
                      nullptr,
                      impl_.points.last_vertex() + 1});
    impl_.replace_engine(std::move(lowered));
  }
  impl_.affine_hull = std::move(flat);
  impl_.find_cells_of_vertices();
  // All hidden points have been set free.
  if (impl_.may_hide()) impl_.hidden_points = std::make_unique<internal::HiddenPoints>();
}

void Triangulation::Impl::Editing::place_all() {
  const std::size_t num_new = edits_.insert.size() / impl_.ambient();
  constexpr std::size_t worth_ordering = 32;
  if (num_new >= worth_ordering) {
    const auto first = placements_.end() - static_cast<std::ptrdiff_t>(num_new);
    const std::vector<Placement> given(first, placements_.end());
    const std::vector<Index> order = order::insertion_order({edits_.insert, impl_.dimension}, impl_.options);
    std::transform(order.begin(), order.end(), first, [&](Index i) { return given[i]; });
  }
  // In the order of their ids, and before others: of equal points, the oldest keeps its id.
  std::sort(freed_.begin(), freed_.end());
  for (const Index v : freed_) {
    internal::cancellation_point();
    place_again(v);
  }
  for (const Placement& placement : placements_) {
    tick();
    place(placement);
  }
}

/// Where a walk to a point starts; `near` is a vertex close to it, or invalid_index.
Index Triangulation::Impl::Editing::start_near(const double* point, Index near) {
  if (near != invalid_index && impl_.is_visible(near)) return index(impl_.cell_of_vertex[near]);
  if (!impl_.engine || impl_.points.form == kernel::RowForm::furthest_point) return invalid_index;
  if (!impl_.landmarks) impl_.add_landmarks(1, impl_.points.last_vertex());
  return impl_.start_near(point);
}

void Triangulation::Impl::Editing::place(const Placement& placement) {
  if (placement.vertex != invalid_index) {
    const Index v = placement.vertex;
    set_point(v, point(placement));
    const Index at = impl_.place(v, start_near(point(placement), placement.near));
    if (at != v && at != invalid_index) merge(v, at);
    return;
  }
  const Index start = start_near(point(placement), placement.near);
  const Index v = impl_.append(point(placement));
  const Index at = impl_.place(v, start);
  const bool is_duplicate = at != v && at != invalid_index;
  if (is_duplicate) impl_.drop_last_vertex();
  impl_.assign(placement.row, is_duplicate ? at : v);
  if (impl_.cell_of_vertex.size() <= v && !is_duplicate)
    impl_.cell_of_vertex.resize(std::size_t{v} + 1, invalid_cell);
  if (at == v && impl_.landmarks) impl_.add_landmarks(v, v);
}

/// A vertex that was hidden.
void Triangulation::Impl::Editing::place_again(Index v) {
  const Index start = impl_.landmarks ? impl_.start_near(impl_.points.point(v)) : invalid_index;
  const Index at = impl_.place(v, start);
  if (at != v && at != invalid_index) merge(v, at);
}

void Triangulation::Impl::Editing::set_point(Index v, const double* point) {
  const std::size_t size = impl_.row_size();
  const auto there = impl_.points.coordinates.begin() + static_cast<std::ptrdiff_t>(v * size);
  record_->points.insert(record_->points.end(), there, there + static_cast<std::ptrdiff_t>(size));
  record_->moved.push_back(v);
  impl_.points.grid.include(point);
  std::copy_n(point, size, there);
}

/// The rows of a vertex become those of another at the same point.
void Triangulation::Impl::Editing::merge(Index v, Index into) {
  while (!is_dying(v)) {
    const std::size_t row = impl_.row_of_vertex[v];
    impl_.detach(row);
    impl_.assign(row, into);
  }
  dead_.push_back(v);
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

Changes Triangulation::Impl::changes_since(const internal::EditRecord& before) const {
  Changes made;
  if (engine && !before.has_other_engine) {
    if (before.engine_has_log) engine->changed_cells(made.killed, made.born);
  } else if (engine || before.engine || affine_hull.dimension() != before.affine_hull.dimension() ||
             single_links[0] != before.only_vertex || !before.moved.empty()) {
    made.killed = cells_before(before);
    for (const CellId c : complex().all_cells()) made.born.push_back(c);
  }
  const auto is_gone = [&](Index v) { return row_of_vertex[v] == invalid_index; };
  const auto was_there = [&](Index v) { return v < before.num_row_of_vertex; };
  for (Index v = static_cast<Index>(before.num_row_of_vertex); v < row_of_vertex.size(); ++v)
    if (!is_gone(v)) made.came.push_back(VertexId{v});
  for (const internal::EditRecord::MovedRow& moved : before.rows)
    if (moved.before != invalid_vertex && was_there(index(moved.before)) && is_gone(index(moved.before)))
      made.gone.push_back(moved.before);
  std::vector<std::pair<Index, bool>> seen = before.were_visible;
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto [v, was_visible] = seen[i];
    const bool is_first = i == 0 || seen[i - 1].first != v;
    if (is_first && was_there(v) && !is_gone(v) && was_visible != is_visible(v))
      (was_visible ? made.hid : made.reappeared).push_back(VertexId{v});
  }
  for (const Index v : before.moved)
    if (!is_gone(v)) made.moved.push_back(VertexId{v});
  const auto sort = [](auto& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  };
  sort(made.killed);
  sort(made.born);
  sort(made.gone);
  sort(made.moved);
  return made;
}

/// The cells of before, where the engine is another one now.
std::vector<CellId> Triangulation::Impl::cells_before(const internal::EditRecord& before) {
  if (!before.engine)
    return before.affine_hull.dimension() == 0 ? std::vector{CellId{0}, CellId{1}} : std::vector<CellId>{};
  std::vector<CellId> gone, come, cells;
  if (before.engine_has_log) before.engine->changed_cells(gone, come);
  std::sort(come.begin(), come.end());
  for (const CellId c : before.engine->complex(0, {}).all_cells())
    if (!std::binary_search(come.begin(), come.end(), c)) cells.push_back(c);
  cells.insert(cells.end(), gone.begin(), gone.end());
  return cells;
}

/// The only row of a vertex, where nothing else can come of it. Returns false, and has done nothing, if it is
/// not so.
bool Triangulation::Impl::remove_at_once(std::size_t row) {
  if (records_changes || records_undo || last_edit || may_hide() || !engine) return false;
  if (row >= vertex_of_row.size() || vertex_of_row[row] == invalid_vertex) return false;
  const Index v = index(vertex_of_row[row]);
  if (known_shared_rows().has_several(v) || !engine->remove(v, index(cell_of_vertex[v]))) return false;
  update_cells(engine->made_by_removal());
  cell_of_vertex[v] = invalid_cell;
  --num_vertices;
  detach(row);
  return true;
}

/// The same for a row that moves a little.
bool Triangulation::Impl::move_at_once(std::size_t row, std::span<const double> to) {
  if (records_changes || records_undo || last_edit || may_hide() || !engine) return false;
  if (row >= vertex_of_row.size() || vertex_of_row[row] == invalid_vertex || to.size() != ambient())
    return false;
  const Index v = index(vertex_of_row[row]);
  if (known_shared_rows().has_several(v) || !engine->frame().contains(to.data())) return false;
  if (affine_hull.dimension() < dimension && !affine_hull.contains(to.data())) return false;
  double* const point = points.coordinates.data() + v * ambient();
  const std::vector<double> before(point, point + ambient());
  points.grid.include(to.data());
  std::copy(to.begin(), to.end(), point);
  bool is_settled = false;
  const auto take_back = [&] {
    std::copy(before.begin(), before.end(), point);
    engine->renew(v, index(cell_of_vertex[v]));
  };
  try {
    is_settled = engine->settle(v, index(cell_of_vertex[v]));
  } catch (...) {
    take_back();
    throw;
  }
  if (is_settled)
    update_cells(engine->made_by_settling());
  else
    take_back();
  return is_settled;
}

void Triangulation::Impl::edit(const RowEdits& edits) {
  if (edits.is_empty()) return;
  if (edits.remove.size() == 1 && edits.move.empty() && edits.weigh.empty() && edits.insert.empty() &&
      remove_at_once(edits.remove[0]))
    return;
  if (edits.move.size() == 1 && edits.remove.empty() && edits.weigh.empty() && edits.insert.empty() &&
      move_at_once(edits.move[0], edits.to))
    return;
  internal::BuildLimits limits(options.memory_limit, options.time_limit, "changes");
  limits.guard([&] { Editing(*this, edits).run(); });
}

InsertResult Triangulation::Impl::insert_on_record(std::span<const double> point, double weight) {
  const std::size_t row = vertex_of_row.size();
  const std::size_t num_ids = row_of_vertex.size();
  edit({.insert = point, .insert_weights = {&weight, weighted() ? std::size_t{1} : std::size_t{0}}});
  const VertexId v = vertex_of_row[row];
  if (!is_visible(index(v))) return {};
  return {v, index(v) >= num_ids};
}

void Triangulation::Impl::forget_undo() {
  if (!last_edit) return;
  if (engine) engine->keep_batch();
  last_edit.reset();
}

void Triangulation::Impl::undo() {
  if (!last_edit) throw Error(Errc::invalid_argument, "there is no edit that can be undone");
  Changes made;
  if (records_changes) {
    made = changes_since(*last_edit);
    std::swap(made.killed, made.born);
    std::swap(made.came, made.gone);
    std::swap(made.hid, made.reappeared);
  }
  const std::unique_ptr<internal::EditRecord> taken = std::move(last_edit);
  roll_back(*taken);
  changes = std::move(made);
}

void Triangulation::Impl::roll_back(internal::EditRecord& before) noexcept {
  record = nullptr;
  for (std::size_t i = before.rows.size(); i-- > 0;) {
    const internal::EditRecord::MovedRow& moved = before.rows[i];
    try {
      if (shared_rows && moved.after != invalid_vertex) detach(moved.row);
      if (shared_rows && moved.before != invalid_vertex) assign(moved.row, index(moved.before));
    } catch (const std::bad_alloc&) {
      shared_rows.reset();
    }
    vertex_of_row[moved.row] = moved.before;
    if (moved.before != invalid_vertex) row_of_vertex[index(moved.before)] = moved.first_of_before;
    if (moved.after != invalid_vertex) row_of_vertex[index(moved.after)] = moved.first_of_after;
  }
  vertex_of_row.resize(before.num_rows);
  row_of_vertex.resize(before.num_row_of_vertex);
  num_rows_inserted = before.num_rows_inserted;
  has_ids_of_threads = before.has_ids_of_threads;
  for (std::size_t i = before.moved.size(); i-- > 0;)
    std::copy_n(before.points.begin() + static_cast<std::ptrdiff_t>(i * row_size()), row_size(),
                points.coordinates.begin() + static_cast<std::ptrdiff_t>(before.moved[i] * row_size()));
  points.coordinates.resize(before.num_coordinates);
  points.num_waiting = 0;
  affine_hull = std::move(before.affine_hull);
  only_vertex() = before.only_vertex;
  hidden_points.reset();
  if (before.has_other_engine) {
    engine = std::move(before.engine);
    landmarks.reset();
  }
  // What has come to be visible is not; what was visible and has lost cells gets them back next.
  for (const auto& [v, was_visible] : before.were_visible)
    if (!was_visible && v < cell_of_vertex.size()) cell_of_vertex[v] = invalid_cell;
  if (engine && before.engine_has_log)
    engine->undo_batch([this](Index cell) {
      const Complex now = engine->complex(0, {});
      for (int i = 0; i <= now.affine_dimension(); ++i)
        cell_of_vertex[index(now.vertex(CellId{cell}, i))] = CellId{cell};
    });
  if (before.has_other_engine || !engine) {
    std::fill(cell_of_vertex.begin(), cell_of_vertex.end(), invalid_cell);
    find_cells_of_vertices();
  }
  if (engine)
    for (const Index v : before.moved) engine->rewrite_row(v);
  if (engine && before.has_settled) {
    if (before.moved.size() >= before.num_vertices / 4)
      engine->renew_all();
    else
      for (const Index v : before.moved)
        if (is_visible(v)) engine->renew(v, index(cell_of_vertex[v]));
  }
  cell_of_vertex.resize(before.num_cell_of_vertex, invalid_cell);
  num_vertices = before.num_vertices;
}

CompactedIds Triangulation::Impl::compact_ids() {
  CompactedIds ids;
  std::vector<Index> new_ids(row_of_vertex.size(), invalid_index);
  ids.vertices.assign(row_of_vertex.size(), invalid_vertex);
  ids.rows.assign(vertex_of_row.size(), CompactedIds::no_row);
  expand();
  forget_undo();
  forget_indexes();
  landmarks.reset();
  new_ids[0] = 0;
  Index next = 1;
  for (Index v = 1; v < new_ids.size(); ++v)
    if (row_of_vertex[v] != invalid_index) new_ids[v] = next++;
  const std::size_t size = row_size();
  for (Index v = 0; v < new_ids.size(); ++v) {
    if (new_ids[v] == invalid_index) continue;
    ids.vertices[v] = VertexId{new_ids[v]};
    const auto from = points.coordinates.begin() + static_cast<std::ptrdiff_t>(v * size);
    std::copy_n(from, size, points.coordinates.begin() + static_cast<std::ptrdiff_t>(new_ids[v] * size));
  }
  points.coordinates.resize(next * size);
  std::size_t next_row = 0;
  row_of_vertex.assign(next, invalid_index);
  row_of_vertex[0] = 0;
  for (std::size_t row = 0; row < vertex_of_row.size(); ++row) {
    if (vertex_of_row[row] == invalid_vertex) continue;
    const Index v = new_ids[index(vertex_of_row[row])];
    ids.rows[row] = next_row;
    row_of_vertex[v] = std::min(row_of_vertex[v], static_cast<Index>(next_row));
    vertex_of_row[next_row++] = VertexId{v};
  }
  vertex_of_row.resize(next_row);
  if (engine) engine->renumber_vertices(new_ids);
  if (affine_hull.dimension() == 0) only_vertex() = new_ids[only_vertex()];
  cell_of_vertex.resize(std::min<std::size_t>(cell_of_vertex.size(), next));
  find_cells_of_vertices();
  return ids;
}

}  // namespace delone
