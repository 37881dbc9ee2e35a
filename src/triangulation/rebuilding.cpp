// SPDX-License-Identifier: BSD-3-Clause
// An edit that changes much builds all cells anew, of the points that are there after it. Vertices keep their
// ids, and the engine of before is kept until the edit is done.
#include "order/insertion_order.hpp"
#include "triangulation/editing.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace delone {

void Triangulation::Impl::Editing::build_anew() {
  const std::vector<CellId> cells_before = impl_.cell_of_vertex;
  const std::size_t num_noted = record_->were_visible.size();
  for (const Placement& placement : placements_) {
    if (placement.vertex != invalid_index) {
      set_point(placement.vertex, point(placement));
    } else {
      impl_.assign(placement.row, impl_.append(point(placement)));
    }
  }
  std::vector<Index> vertices;
  std::vector<double> coordinates;
  vertices.reserve(impl_.row_of_vertex.size());
  coordinates.reserve(impl_.row_of_vertex.size() * impl_.ambient());
  std::vector<double> low, high;
  for (Index v = 1; v < impl_.row_of_vertex.size(); ++v) {
    if (is_dying(v)) continue;
    const double* const x = impl_.points.point(v);
    if (vertices.empty()) low.assign(x, x + impl_.row_size()), high = low;
    for (std::size_t j = 0; j < impl_.row_size(); ++j) {
      low[j] = std::min(low[j], x[j]);
      high[j] = std::max(high[j], x[j]);
    }
    vertices.push_back(v);
    coordinates.insert(coordinates.end(), x, x + impl_.ambient());
  }
  std::vector<std::size_t> rounds;
  const std::vector<Index> order =
      order::insertion_order({coordinates, impl_.dimension}, impl_.options, &rounds);
  std::vector<Index> sorted(order.size());
  std::transform(order.begin(), order.end(), sorted.begin(), [&](Index i) { return vertices[i]; });

  const engine::Effort effort = impl_.engine ? impl_.engine->effort() : engine::Effort{};
  impl_.replace_engine(nullptr);
  impl_.affine_hull = kernel::AffineHull(impl_.dimension);
  std::size_t num_spanning = 0;
  for (std::size_t i = 0; i < sorted.size() && impl_.affine_hull.dimension() < impl_.dimension; ++i) {
    if (!impl_.affine_hull.add(impl_.points.point(sorted[i]))) continue;
    std::rotate(sorted.begin() + static_cast<std::ptrdiff_t>(num_spanning),
                sorted.begin() + static_cast<std::ptrdiff_t>(i),
                sorted.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    ++num_spanning;
  }
  std::vector<std::pair<Index, Index>> equal;  // vertices, and those at their points that came before them
  const std::span<const Index> spanning(sorted.data(), num_spanning);
  const std::span<const Index> others(sorted.data() + num_spanning, sorted.size() - num_spanning);
  const auto on_placed = [&](Index v, Index at) {
    if (at != v && at != invalid_index) equal.emplace_back(v, at);
  };
  if (impl_.affine_hull.dimension() == 0) {
    impl_.only_vertex() = spanning.front();
    impl_.find_cells_of_vertices();
    for (const Index v : others) on_placed(v, impl_.place_at_only_vertex(v));
  } else if (impl_.affine_hull.dimension() > 0) {
    impl_.engine =
        make_triangulation_engine(impl_.affine_hull.axes(), impl_.points,
                                  geometry::Frame(std::move(low), std::move(high), impl_.points.form), effort,
                                  impl_.options.force_runtime_dimension);
    impl_.engine->seed(spanning);
    if (!others.empty()) insert_others(others, rounds, on_placed);
  }
  merge_equal(equal);
  impl_.has_ids_of_threads = impl_.engine && impl_.engine->shares_batches_of(others.size());
  if (impl_.has_ids_of_threads && (impl_.records_changes || impl_.records_undo)) {
    // A sort_cells() after the edit would drop both records.
    impl_.engine->sort_cells(internal::threads_to_use(impl_.options.threads));
    impl_.has_ids_of_threads = false;
  }
  if (impl_.affine_hull.dimension() > 0) impl_.find_cells_of_vertices();
  if (impl_.affine_hull.dimension() < 0) {  // no row is left
    impl_.cell_of_vertex.assign(impl_.row_of_vertex.size(), invalid_cell);
    impl_.num_vertices = 0;
  }
  record_->were_visible.resize(num_noted);  // what came and went at one place meanwhile does not count
  for (Index v = 1; v < cells_before.size(); ++v)
    if ((cells_before[v] != invalid_cell) != impl_.is_visible(v))
      record_->were_visible.emplace_back(v, cells_before[v] != invalid_cell);
}

/// Of equal points, one that has neither come nor moved keeps its id, and else the oldest.
void Triangulation::Impl::Editing::merge_equal(std::vector<std::pair<Index, Index>>& equal) {
  if (equal.empty()) return;
  std::vector<Index> changed(record_->moved);
  std::sort(changed.begin(), changed.end());
  const auto rank = [&](Index v) {
    const bool is_untouched =
        v < record_->num_row_of_vertex && !std::binary_search(changed.begin(), changed.end(), v);
    return std::pair(!is_untouched, v);
  };
  std::sort(equal.begin(), equal.end(), [&](const auto& a, const auto& b) {
    return std::pair(a.second, rank(a.first)) < std::pair(b.second, rank(b.first));
  });
  std::vector<Index> new_ids;
  for (std::size_t i = 0; i < equal.size();) {
    const Index at = equal[i].second;
    const Index kept = rank(equal[i].first) < rank(at) ? equal[i].first : at;
    if (kept != at) {
      if (new_ids.empty()) {
        new_ids.resize(impl_.row_of_vertex.size());
        std::iota(new_ids.begin(), new_ids.end(), Index{0});
      }
      new_ids[at] = kept;
    }
    for (; i < equal.size() && equal[i].second == at; ++i)
      if (equal[i].first != kept) merge(equal[i].first, kept);
    if (kept != at) merge(at, kept);
  }
  if (new_ids.empty()) return;
  if (impl_.engine) return impl_.engine->renumber_vertices(new_ids);
  impl_.only_vertex() = new_ids[impl_.only_vertex()];
  impl_.find_cells_of_vertices();
}

void Triangulation::Impl::Editing::insert_others(std::span<const Index> others,
                                                 std::span<const std::size_t> rounds_of_all,
                                                 const std::function<void(Index, Index)>& on_placed) {
  const unsigned threads =
      impl_.engine->shares_batches_of(others.size())
          ? engine::threads_for_batch(impl_.options.threads, others.size(), impl_.dimension)
          : 1;
  const std::size_t num_spanning = static_cast<std::size_t>(impl_.affine_hull.dimension()) + 1;
  std::vector<std::size_t> rounds;
  for (const std::size_t end : rounds_of_all)
    if (end > num_spanning) rounds.push_back(end - num_spanning);
  std::vector<Index> at(others.size());
  engine::ParallelBatch batch{threads, 0, at, rounds};
  batch.steps = others;
  batch.num_before = num_spanning;
  batch.tick = [&](std::size_t done) { tick_batch(done, others.size()); };
  impl_.engine->insert_all(batch);
  for (std::size_t i = 0; i < others.size(); ++i) on_placed(others[i], at[i]);
  impl_.statistics.threads = std::max(impl_.statistics.threads, threads);
}

}  // namespace delone
