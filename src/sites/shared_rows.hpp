// SPDX-License-Identifier: BSD-3-Clause
// The rows of vertices that have several: equal points are one vertex.
#pragma once

#include <delone/types.hpp>

#include <algorithm>
#include <span>
#include <unordered_map>
#include <vector>

namespace delone::sites {

/// For each vertex the rows at it but the first, ascending.
class SharedRows {
 public:
  SharedRows(std::span<const VertexId> vertex_of_row, std::span<const Index> row_of_vertex) {
    for (std::size_t row = 0; row < vertex_of_row.size(); ++row) {
      const VertexId v = vertex_of_row[row];
      if (v != invalid_vertex && row_of_vertex[index(v)] != row)
        others_[index(v)].push_back(static_cast<Index>(row));
    }
  }

  bool has_several(Index vertex) const { return !others_.empty() && others_.contains(vertex); }
  std::span<const Index> others(Index vertex) const {
    const auto found = others_.find(vertex);
    return found == others_.end() ? std::span<const Index>() : found->second;
  }
  /// Throws std::bad_alloc, and then changes nothing.
  void add(Index vertex, Index row) {
    std::vector<Index>& rows = others_[vertex];
    try {
      rows.insert(std::lower_bound(rows.begin(), rows.end(), row), row);
    } catch (...) {
      if (rows.empty()) others_.erase(vertex);
      throw;
    }
  }
  void remove(Index vertex, Index row) {
    const auto found = others_.find(vertex);
    std::vector<Index>& rows = found->second;
    rows.erase(std::lower_bound(rows.begin(), rows.end(), row));
    if (rows.empty()) others_.erase(found);
  }

 private:
  std::unordered_map<Index, std::vector<Index>> others_;
};

}  // namespace delone::sites
