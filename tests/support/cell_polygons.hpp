// SPDX-License-Identifier: BSD-3-Clause
// What must hold for the polygons of the faces of any cells.
#pragma once

#include <delone/site_cells.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace delone::test {

/// The vertices of face i.
inline std::span<const SignedIndex> polygon(const SiteCells& cells, std::size_t i) {
  const auto first = static_cast<std::size_t>(cells.face_vertex_offsets[i]),
             last = static_cast<std::size_t>(cells.face_vertex_offsets[i + 1]);
  return std::span(cells.face_vertices).subspan(first, last - first);
}

/// Coordinate j of a vertex of a row.
inline double vertex_of(const SiteCells& cells, std::size_t row, SignedIndex vertex, std::size_t j) {
  const auto at = static_cast<std::size_t>(cells.vertex_offsets[row] + vertex);
  return cells.vertices[at * static_cast<std::size_t>(cells.dimension) + j];
}

/// Cells of k dimensions, 2 or 3, close: each edge is run through once in each direction, and infinity is a
/// vertex like others. In the plane each vertex is the end of one edge and the start of one.
inline void expect_closed(const SiteCells& cells, int k) {
  for (std::size_t row = 0; row < cells.num_rows(); ++row) {
    std::map<std::pair<SignedIndex, SignedIndex>, int> edges;
    std::map<SignedIndex, int> ends;
    const auto size = static_cast<SignedIndex>(cells.vertex_offsets[row + 1] - cells.vertex_offsets[row]);
    std::vector<int> seen(static_cast<std::size_t>(size), 0);
    for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
         i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i) {
      const auto of_face = polygon(cells, i);
      for (const SignedIndex v : of_face) {
        ASSERT_TRUE(v >= -1 && v < size);
        if (v >= 0) seen[static_cast<std::size_t>(v)] = 1;
      }
      EXPECT_EQ(std::isinf(cells.face_areas[i]), std::ranges::count(of_face, -1) > 0);
      if (k == 2) {
        ASSERT_EQ(of_face.size(), 2u);
        --ends[of_face[0]];
        ++ends[of_face[1]];
        continue;
      }
      EXPECT_EQ(of_face.size(), static_cast<std::size_t>(cells.num_edges[i]));
      EXPECT_EQ(std::ranges::min(of_face), of_face[0]);
      for (std::size_t a = 0; a < of_face.size(); ++a) {
        const SignedIndex from = of_face[a], to = of_face[(a + 1) % of_face.size()];
        ++edges[{from, to}];
        --edges[{to, from}];
      }
    }
    for (const auto& [edge, sum] : edges)
      EXPECT_EQ(sum, 0) << row << ": " << edge.first << ' ' << edge.second;
    for (const auto& [end, sum] : ends) EXPECT_EQ(sum, 0) << row << ": " << end;
    if (cells.num_faces[row] > 0) {
      EXPECT_EQ(std::ranges::count(seen, 0), 0) << row;
    }
  }
}

/// Faces of bounded cells in their own space, 2 or 3 dimensions, have their areas and look at the neighbor.
/// `lattice`: the vectors of a periodic set.
inline void expect_oriented(const SiteCells& cells, const std::vector<double>& points,
                            const std::vector<double>& lattice = {}) {
  const auto d = static_cast<std::size_t>(cells.dimension), r = static_cast<std::size_t>(cells.rank);
  constexpr double vast = 1e4;
  for (std::size_t row = 0; row < cells.num_rows(); ++row)
    for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
         i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i) {
      if (!(cells.volumes[row] < vast)) continue;
      std::array<double, 3> to{}, area{};
      for (std::size_t j = 0; j < d; ++j) {
        to[j] = points[static_cast<std::size_t>(cells.neighbors[i]) * d + j] - points[row * d + j];
        for (std::size_t l = 0; l < r; ++l) to[j] += cells.neighbor_lattice[i * r + l] * lattice[l * d + j];
      }
      std::vector<std::array<double, 3>> corners;
      double size = 0;
      for (const SignedIndex v : polygon(cells, i)) {
        corners.push_back({});
        for (std::size_t j = 0; j < d; ++j) {
          corners.back()[j] = vertex_of(cells, row, v, j) - points[row * d + j];
          size = std::max(size, std::abs(corners.back()[j]));
        }
      }
      if (size > vast) continue;
      if (d == 2) {  // the edge turned by −90°
        area = {corners[1][1] - corners[0][1], corners[0][0] - corners[1][0], 0};
      } else {
        for (std::size_t a = 0; a < corners.size(); ++a) {
          const auto &p = corners[a], &q = corners[(a + 1) % corners.size()];
          for (std::size_t j = 0; j < 3; ++j)
            area[j] += (p[(j + 1) % 3] * q[(j + 2) % 3] - p[(j + 2) % 3] * q[(j + 1) % 3]) / 2;
        }
      }
      const double along = (area[0] * to[0] + area[1] * to[1] + area[2] * to[2]) / cells.distances[i];
      const double tolerance = 1e-11 * (1 + size) * (1 + size);
      EXPECT_NEAR(along, cells.face_areas[i], tolerance) << row << ' ' << i;
      EXPECT_NEAR(std::hypot(area[0], area[1], area[2]), cells.face_areas[i], tolerance) << row << ' ' << i;
    }
}

}  // namespace delone::test
