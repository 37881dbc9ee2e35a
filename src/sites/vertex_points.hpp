// SPDX-License-Identifier: BSD-3-Clause
// The points of vertices, as the engine reads them.
#pragma once

#include "kernel/flat.hpp"
#include "kernel/grid.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace delone::sites {

/// By vertex id: d coordinates each, and then the weight if points have one; vertex 0 is a dummy.
struct VertexPoints {
  VertexPoints(int dimension, kernel::RowForm given)
      : ambient(dimension), form(given), coordinates(row_size(), 0.0), grid(dimension, weighted()) {}
  int ambient;
  kernel::RowForm form;
  std::vector<double> coordinates;
  kernel::Grid grid;  ///< one that all points lie on

  bool weighted() const { return form == kernel::RowForm::weighted_point; }
  std::size_t row_size() const { return static_cast<std::size_t>(ambient) + (weighted() ? 1 : 0); }
  /// The largest vertex id. Some vertices may have no cell: those that are hidden, removed, or not inserted
  /// yet.
  Index last_vertex() const { return static_cast<Index>(coordinates.size() / row_size()) - 1; }
  /// What that may become without more memory.
  Index last_expected() const { return static_cast<Index>(coordinates.capacity() / row_size()) - 1; }
  const double* point(Index v) const { return coordinates.data() + static_cast<std::size_t>(v) * row_size(); }
  /// Gives a vertex another point.
  void set_point(Index v, const double* point) {
    grid.include(point);
    std::copy_n(point, row_size(), coordinates.begin() + static_cast<std::ptrdiff_t>(v * row_size()));
  }
  /// Appends the point of the next vertex. Returns the vertex.
  Index append(const double* point) {
    grid.include(point);
    coordinates.insert(coordinates.end(), point, point + row_size());
    return last_vertex();
  }
  void drop_last() { coordinates.resize(coordinates.size() - row_size()); }
  /// A grid for the points and a query.
  kernel::Grid grid_with(const double* query) const {
    kernel::Grid larger = grid;
    larger.include(query);
    return larger;
  }
};

}  // namespace delone::sites
