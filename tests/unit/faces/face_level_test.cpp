// SPDX-License-Identifier: BSD-3-Clause
// Faces of every dimension against the sets of all subsets of cells; which lie in the boundary of the hull.
#include "faces/face_level.hpp"

#include <delone/delaunay.hpp>
#include <delone/faces.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace delone {
namespace {

using Rows = std::vector<SignedIndex>;

/// All subsets of `size` rows of each list of `width` rows.
std::set<Rows> subsets(const std::vector<SignedIndex>& lists, std::size_t width, std::size_t size) {
  std::set<Rows> result;
  for (std::size_t begin = 0; begin < lists.size(); begin += width)
    for (unsigned bits = 0; bits < 1u << width; ++bits) {
      Rows rows;
      for (std::size_t i = 0; i < width; ++i)
        if ((bits >> i & 1) != 0) rows.push_back(lists[begin + i]);
      std::sort(rows.begin(), rows.end());
      if (rows.size() == size) result.insert(rows);
    }
  return result;
}

void expect_faces(const Triangulation& t) {
  const ComplexData data = t.to_data();
  const int k = t.affine_dimension();
  const std::size_t width = static_cast<std::size_t>(k) + 1;
  std::vector<SignedIndex> hull;
  for (std::size_t i = 0; i < data.neighbors.size() && k > 0; ++i)
    if (data.neighbors[i] < 0)
      for (std::size_t m = 0; m < width; ++m)
        if (m != i % width) hull.push_back(data.cells[i - i % width + m]);
  for (int j = 0; j <= k; ++j) {
    const Faces found = faces(t, j);
    std::set<Rows> all, on_hull;
    ASSERT_EQ(found.dimension, j);
    ASSERT_EQ(found.vertices.size(), found.size() * (static_cast<std::size_t>(j) + 1));
    for (std::size_t i = 0; i < found.size(); ++i) {
      Rows rows(found.face(i).begin(), found.face(i).end());
      EXPECT_TRUE(j == k || std::is_sorted(rows.begin(), rows.end()));
      const auto* const cell = data.cells.data() + static_cast<std::size_t>(found.cells[i]) * width;
      for (const SignedIndex row : rows) EXPECT_NE(std::find(cell, cell + width, row), cell + width);
      std::sort(rows.begin(), rows.end());
      EXPECT_TRUE(all.insert(rows).second);
      if (found.on_hull[i] != 0) on_hull.insert(rows);
    }
    EXPECT_EQ(all, subsets(data.cells, width, static_cast<std::size_t>(j) + 1));
    EXPECT_EQ(on_hull, subsets(hull, width - 1, static_cast<std::size_t>(j) + 1));
    EXPECT_TRUE(j < k || found.vertices == data.cells);
    EXPECT_TRUE(j > 0 || std::is_sorted(found.vertices.begin(), found.vertices.end()));
    EXPECT_EQ(faces(t, j, {.threads = 3}).vertices, found.vertices);
  }
  for (int j = k + 1; j <= t.dimension(); ++j) EXPECT_EQ(faces(t, j).size(), 0u);
}

TEST(Faces, AreAllSubsetsOfCells) {
  for (int d = 1; d <= 5; ++d) expect_faces(Delaunay<>(make_point_set("uniform", d, d < 4 ? 60 : 25, 7), d));
  expect_faces(Delaunay<>(std::vector<double>{0, 0, 0, 1, 1, 1, 2, 2, 2, 1, 1, 1}, 3));
  expect_faces(Delaunay<>(std::vector<double>{4, 5, 6}, 3));
  expect_faces(Delaunay<>(3));
  expect_faces(
      Regular<>(std::vector<double>{0, 0, 4, 0, 0, 4, 1, 1, 2, 2}, std::vector<double>{0, 0, 0, -9, 1}, 2));
}

TEST(Faces, LevelsKnowTheirFacets) {
  const Delaunay<> t(make_point_set("uniform", 4, 40, 1), 4);
  internal::FaceLevel level = internal::level_of_cells(t);
  for (int j = 4; j > 0; --j) {
    internal::FaceLevel below = internal::facets_of(level, t.complex().num_vertex_slots(), 1);
    EXPECT_EQ(below.size(), faces(t, j - 1).size());
    for (std::size_t face = 0; face < level.size(); ++face)
      for (std::size_t i = 0; i < level.corners(); ++i) {
        std::vector<Index> expected(level.vertices.begin() + std::ptrdiff_t(face * level.corners()),
                                    level.vertices.begin() + std::ptrdiff_t((face + 1) * level.corners()));
        expected.erase(expected.begin() + std::ptrdiff_t(i));
        const std::size_t facet = level.facets[face * level.corners() + i];
        const std::vector<Index> found(
            below.vertices.begin() + std::ptrdiff_t(facet * below.corners()),
            below.vertices.begin() + std::ptrdiff_t((facet + 1) * below.corners()));
        EXPECT_EQ(found, expected);
      }
    level = std::move(below);
  }
}

}  // namespace
}  // namespace delone
