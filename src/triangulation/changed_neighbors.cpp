// SPDX-License-Identifier: BSD-3-Clause
// Changes of neighbors from changes of edges. A vertex is named by its first row. Where the name of an id is
// the same in both triangulations, edges are compared by ids; those at other vertices by names, all of them.
#include <delone/neighbor_changes.hpp>

#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "triangulation/changed_edges.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <array>

namespace delone {

namespace {

using triangulation::Edge;
using Rows = std::array<SignedIndex, 2>;

/// The first row of each vertex; −1 for ids without a row.
std::vector<SignedIndex> first_rows(const Triangulation& t) {
  const std::vector<VertexId>& vertices = triangulation::StoredPoints::vertices_of_rows(t);
  std::vector<SignedIndex> rows(triangulation::StoredPoints::of(t).last_vertex() + std::size_t{1}, -1);
  for (std::size_t row = vertices.size(); row-- > 0;)
    if (vertices[row] != invalid_vertex) rows[index(vertices[row])] = static_cast<SignedIndex>(row);
  return rows;
}

class NeighborsByRow {
 public:
  NeighborsByRow(const Triangulation& before, const Triangulation& after)
      : before_(before), after_(after), rows_before_(first_rows(before)), rows_after_(first_rows(after)) {}

  NeighborChanges find() {
    const triangulation::ChangedEdges edges =
        triangulation::find_changed_edges(before_.complex(), after_.complex());
    NeighborChanges changes;
    std::vector<Rows> of_before = renamed(before_, rows_before_), of_after = renamed(after_, rows_after_);
    changes.ended = merged(edges.ended, rows_before_, of_before, of_after);
    changes.began = merged(edges.began, rows_after_, of_after, of_before);
    return changes;
  }

 private:
  bool is_renamed(VertexId v) const {
    const std::size_t id = index(v);
    return id >= rows_before_.size() || id >= rows_after_.size() || rows_before_[id] != rows_after_[id];
  }
  static Rows named(VertexId v, VertexId w, const std::vector<SignedIndex>& rows) {
    const auto [a, b] = std::minmax(rows[index(v)], rows[index(w)]);
    return {a, b};
  }
  /// All edges at vertices that have another name in the other triangulation, sorted.
  std::vector<Rows> renamed(const Triangulation& t, const std::vector<SignedIndex>& rows) const {
    std::vector<Rows> pairs;
    triangulation::each_edge_at(
        t.complex(), [&](VertexId v) { return is_renamed(v); },
        [&](VertexId v, VertexId w) { pairs.push_back(named(v, w, rows)); });
    triangulation::sort_unique(pairs);
    return pairs;
  }
  std::vector<SignedIndex> merged(const std::vector<Edge>& edges, const std::vector<SignedIndex>& rows,
                                  const std::vector<Rows>& here, const std::vector<Rows>& there) const {
    std::vector<Rows> pairs = triangulation::difference(here, there);
    for (const auto& [v, w] : edges)
      if (!is_renamed(v) && !is_renamed(w)) pairs.push_back(named(v, w, rows));
    std::sort(pairs.begin(), pairs.end());
    std::vector<SignedIndex> flat;
    for (const Rows& pair : pairs) flat.insert(flat.end(), pair.begin(), pair.end());
    return flat;
  }

  const Triangulation &before_, &after_;
  const std::vector<SignedIndex> rows_before_, rows_after_;
};

}  // namespace

NeighborChanges changed_neighbors(const Triangulation& before, const Triangulation& after,
                                  const Execution& how) {
  return internal::guarded("the pairs of neighbors", [&] {
    const internal::ProgressMeter meter(how.progress);
    return NeighborsByRow(before, after).find();
  });
}

}  // namespace delone
