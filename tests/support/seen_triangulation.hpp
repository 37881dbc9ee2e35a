// SPDX-License-Identifier: BSD-3-Clause
// All that can be seen of a triangulation, to be compared with what was seen before.
#pragma once

#include <delone/triangulation.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace delone::test {

/// Whatever members of a triangulation tell, but for what depends on nothing else.
struct SeenTriangulation {
  /// A cell: its vertices, then its neighbors.
  using Cells = std::map<CellId, std::vector<Index>>;

  explicit SeenTriangulation(const Triangulation& t)
      : affine_dimension(t.affine_dimension()),
        axes(t.axes()),
        num_points(t.num_points()),
        num_duplicates(t.num_duplicates()),
        num_hidden(t.num_hidden()),
        num_vertices(t.num_vertices()),
        num_infinite_cells(t.num_infinite_cells()),
        vertices(t.complex().finite_vertices()) {
    for (const VertexId v : vertices) {
      first_rows.push_back(t.row_of(v));
      points.emplace_back(t.point(v).begin(), t.point(v).end());
    }
    for (std::size_t row = 0; row < t.num_rows(); ++row) {
      has_row.push_back(t.has_row(row));
      is_hidden.push_back(t.has_row(row) && t.is_hidden(row));
      vertex_at.push_back(t.vertex_at(row));
    }
    for (const CellId c : t.all_cells()) {
      std::vector<Index>& links = cells[c];
      for (const VertexId v : t.vertices(c)) links.push_back(index(v));
      for (const CellId n : t.neighbors(c)) links.push_back(index(n));
    }
  }
  bool operator==(const SeenTriangulation&) const = default;
  bool sees(VertexId v) const { return std::binary_search(vertices.begin(), vertices.end(), v); }
  const std::vector<double>& point(VertexId v) const {
    return points[static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                           vertices.begin())];
  }

  int affine_dimension;
  std::vector<int> axes;
  std::size_t num_points, num_duplicates, num_hidden;
  Index num_vertices, num_infinite_cells;
  std::vector<VertexId> vertices;           // that are visible
  std::vector<std::size_t> first_rows;      // of these
  std::vector<std::vector<double>> points;  // and theirs, with weights
  std::vector<bool> has_row, is_hidden;
  std::vector<VertexId> vertex_at;
  Cells cells;
};

}  // namespace delone::test
