// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the engine share: points with an engine for them, and what holds of all spheres.
#pragma once

#include "engine/build.hpp"
#include "geometry/delaunay_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
#include <vector>

namespace delone::engine {

/// Points of R^ambient that span the axes, and an engine for them. The first is vertex 1; weights are the
/// last entries of rows if points have any.
template <int K, class G = geometry::DelaunayGeometry<K>>
struct Points {
  using Geometry = G;

  Points(const std::vector<double>& rows, int ambient, double low, double high, bool weighted = false)
      : coordinates(width(ambient, weighted), 0.0),
        grid(ambient, weighted),
        build(K, cells::VertexIds::wide, axes(), ambient, with(rows), grid,
              frame(ambient, low, high, weighted)) {
    build.geometry().set_rows(static_cast<Index>(coordinates.size() / width(ambient, weighted)) - 1);
  }
  Points(const Points&) = delete;
  Points& operator=(const Points&) = delete;

  /// The first simplex is that of the vertices 1 … K+1, oriented positively.
  void seed() {
    std::vector<Index> simplex(K + 1);
    std::iota(simplex.begin(), simplex.end(), Index{1});
    if (build.geometry().orientation(simplex.data()) == Sign::negative) std::swap(simplex[0], simplex[1]);
    build.seed(simplex);
  }
  Complex complex(Index num_vertices) const {
    const CellStore<K>& cells = build.cells();
    return {cells.links_of_complex(),
            K,
            cells.num_slots(),
            cells.num_cells() - build.num_infinite(),
            build.num_infinite(),
            num_vertices,
            nullptr,
            num_vertices + 1};
  }
  /// The vertices of each cell, increasing. Expects mutual neighbors across common facets, and positive
  /// finite cells.
  std::set<std::vector<Index>> sphere() {
    CellStore<K>& cells = build.cells();
    std::set<std::vector<Index>> result;
    for (Index cell = 0; cell < cells.num_slots(); ++cell) {
      if (cells.is_vacant(cell)) continue;
      const std::vector<Index> vertices = corners(cell);
      if (cells.infinite_slot(cell) < 0) {
        EXPECT_EQ(build.geometry().orientation(vertices.data()), Sign::positive);
      }
      for (int i = 0; i <= K; ++i) {
        const Index neighbor = cells.neighbors(cell)[i];
        EXPECT_EQ(cells.neighbors(neighbor)[cells.slot_of_neighbor(neighbor, cell)], cell);
        const std::vector<Index> others = corners(neighbor);
        for (int j = 0; j <= K; ++j)
          EXPECT_EQ(std::count(others.begin(), others.end(), cells.vertex(cell, j)), j == i ? 0 : 1);
      }
      result.insert(sorted(vertices));
    }
    EXPECT_EQ(result.size(), cells.num_cells());
    return result;
  }
  std::vector<Index> corners(Index cell) const {
    std::vector<Index> vertices;
    for (int i = 0; i <= K; ++i) vertices.push_back(build.cells().vertex(cell, i));
    return vertices;
  }
  static std::vector<Index> sorted(std::vector<Index> vertices) {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  }
  /// Appends rows after that of the dummy.
  const std::vector<double>& with(const std::vector<double>& rows) {
    const std::size_t step = coordinates.size();
    coordinates.insert(coordinates.end(), rows.begin(), rows.end());
    for (std::size_t i = step; i < coordinates.size(); i += step) grid.include(coordinates.data() + i);
    return coordinates;
  }
  static std::size_t width(int ambient, bool weighted) {
    return static_cast<std::size_t>(ambient) + (weighted ? 1 : 0);
  }
  static std::vector<int> axes() {
    std::vector<int> all(K);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  static geometry::Frame frame(int ambient, double low, double high, bool weighted) {
    return {std::vector<double>(width(ambient, weighted), low),
            std::vector<double>(width(ambient, weighted), high),
            weighted ? kernel::RowForm::weighted_point : kernel::RowForm::point};
  }

  std::vector<double> coordinates;  // that of vertex 0 is a dummy
  kernel::Grid grid;
  Build<K, Geometry> build;
};

}  // namespace delone::engine
