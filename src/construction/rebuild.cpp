// SPDX-License-Identifier: BSD-3-Clause
// An edit that changes much rebuilds all cells: the points that are left are inserted in bulk into nothing.
// Vertices keep their ids, and the engine of before is kept until the edit is done.
#include "construction/bulk_insertion.hpp"
#include "construction/editing.hpp"
#include "order/insertion_order.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace delone::construction {

using sites::VertexPoints;

namespace {

/// While it lives, a set of sites has no points; vertices of a bulk insertion may take their place.
class PointsAside {
 public:
  explicit PointsAside(VertexPoints& points) : points_(points), coordinates_(points.row_size(), 0.0) {
    coordinates_.swap(points.coordinates);
  }
  ~PointsAside() { coordinates_.swap(points_.coordinates); }
  PointsAside(const PointsAside&) = delete;
  PointsAside& operator=(const PointsAside&) = delete;
  std::span<const double> rows() const { return coordinates_; }

 private:
  VertexPoints& points_;
  std::vector<double> coordinates_;
};

}  // namespace

/// The vertices that have rows, in the order of their insertion.
struct Editing::Live {
  std::vector<Index> order;
  std::vector<std::size_t> rounds;
};

Editing::Live Editing::live_vertices() const {
  std::vector<Index> vertices;
  std::vector<double> coordinates;
  vertices.reserve(state_.sites.num_ids());
  coordinates.reserve(state_.sites.num_ids() * state_.ambient());
  for (Index v = 1; v < state_.sites.num_ids(); ++v) {
    if (!state_.sites.has_rows(v)) continue;
    const double* const x = state_.sites.point(v);
    vertices.push_back(v);
    coordinates.insert(coordinates.end(), x, x + state_.ambient());
  }
  Live live;
  live.order = order::insertion_order({coordinates, state_.dimension()}, state_.options, &live.rounds);
  for (Index& v : live.order) v = vertices[v];
  return live;
}

void Editing::rebuild() {
  const std::vector<CellId> cells_before = state_.cell_of_vertex;
  for (const Placement& placement : placements_) {
    if (placement.vertex != invalid_index)
      state_.sites.move(placement.vertex, point(placement));
    else
      state_.sites.assign(placement.row, state_.sites.points().append(point(placement)));
  }
  state_.replace_engine(nullptr);
  state_.affine_hull = kernel::AffineHull(state_.dimension());
  state_.ids_tell_of_timing = false;
  Live live = live_vertices();
  std::vector<Index> new_ids;  // by number in the order of insertion, from 1 on
  if (!live.order.empty()) {
    std::vector<std::pair<Index, Index>> equal;  // a vertex, and the number of the one at its point
    {
      const PointsAside points(state_.sites.points());
      const std::size_t num_all = live.order.size();
      constexpr double margin = 0.0625;  // moves that follow stay in the frame
      BulkInsertion bulk(state_, std::move(live.order), std::move(live.rounds), true, margin,
                         construction_.limits_, [&](std::size_t done) { tick_batch(done, num_all); });
      bulk.take(points.rows());
      bulk.run();
      new_ids.push_back(index(infinite_vertex));
      new_ids.insert(new_ids.end(), bulk.order().begin(), bulk.order().end());
      for (std::size_t i = 0; i < bulk.order().size(); ++i)
        if (bulk.is_duplicate(i)) equal.emplace_back(bulk.order()[i], bulk.at()[i]);
      if (!bulk.duplicates().empty()) {
        std::vector<Index> number(state_.sites.num_ids());
        for (Index i = 1; i < new_ids.size(); ++i) number[new_ids[i]] = i;
        for (const auto& [v, same] : bulk.duplicates()) equal.emplace_back(v, number[same]);
      }
    }
    merge_equal(equal, new_ids);
    if (state_.engine)
      state_.engine->renumber_vertices(new_ids);
    else
      state_.only_vertex() = new_ids[state_.only_vertex()];
  }
  construction_.sort_cells_on_record();
  state_.find_cells_of_vertices();
  if (state_.affine_hull.dimension() < 0) {  // no row is left
    state_.cell_of_vertex.assign(state_.sites.num_ids(), invalid_cell);
    state_.num_vertices = 0;
  }
  construction_.note_all_visibility(cells_before);
}

/// Of equal points, one that is neither new nor moved keeps its id, or else the oldest. `new_ids`: the vertex
/// of each number; afterwards the one that keeps its id.
void Editing::merge_equal(std::vector<std::pair<Index, Index>>& equal, std::vector<Index>& new_ids) {
  if (equal.empty()) return;
  std::vector<Index> changed(record().sites.moved);
  std::sort(changed.begin(), changed.end());
  const auto rank = [&](Index v) {
    const bool is_untouched =
        v < record().sites.num_ids && !std::binary_search(changed.begin(), changed.end(), v);
    return std::pair(!is_untouched, v);
  };
  std::sort(equal.begin(), equal.end(), [&](const auto& a, const auto& b) {
    return std::pair(a.second, rank(a.first)) < std::pair(b.second, rank(b.first));
  });
  for (std::size_t i = 0; i < equal.size();) {
    const Index number = equal[i].second, at = new_ids[number];
    const Index kept = rank(equal[i].first) < rank(at) ? equal[i].first : at;
    new_ids[number] = kept;
    for (; i < equal.size() && equal[i].second == number; ++i)
      if (equal[i].first != kept) state_.sites.merge(equal[i].first, kept);
    if (kept != at) state_.sites.merge(at, kept);
  }
}

}  // namespace delone::construction
