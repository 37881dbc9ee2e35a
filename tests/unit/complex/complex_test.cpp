// SPDX-License-Identifier: BSD-3-Clause
// The traversals of the read-only complex against plain scans over all cells, in every dimension, flat ones
// included.
#include <delone/complex.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <set>

namespace delone::complex {
namespace {

class ComplexOf : public ::testing::TestWithParam<std::pair<int, int>> {  // affine dimension, dimension
 protected:
  ComplexOf()
      : triangulation_(make_points(), GetParam().second),
        complex_(triangulation_.complex()),
        k_(complex_.affine_dimension()) {}

  static std::vector<double> make_points() {
    const auto [k, d] = GetParam();
    if (k < 0) return {};
    if (k == 0) return std::vector<double>(static_cast<std::size_t>(3 * d), 2.0);
    return test::embedded(test::small_integers(k, k <= 3 ? 60 : 25, -6, 6, 1), d, true, 1).points;
  }
  std::vector<VertexId> vertices_without(CellId c, int i) const {
    std::vector<VertexId> rest = complex_.vertices(c);
    rest.erase(rest.begin() + i);
    std::sort(rest.begin(), rest.end());
    return rest;
  }

  Delaunay<> triangulation_;
  Complex complex_;
  int k_;
};
INSTANTIATE_TEST_SUITE_P(Dimensions, ComplexOf,
                         ::testing::Values(std::pair{-1, 2}, std::pair{0, 3}, std::pair{1, 1},
                                           std::pair{1, 3}, std::pair{2, 2}, std::pair{2, 4}, std::pair{3, 3},
                                           std::pair{4, 4}, std::pair{5, 6}));

TEST_P(ComplexOf, CountsAndRangesAgree) {
  ASSERT_EQ(k_, GetParam().first);
  Index finite = 0, infinite = 0, all = 0;
  for (const CellId c : complex_.finite_cells()) {
    EXPECT_FALSE(complex_.is_infinite(c));
    ++finite;
  }
  for (const CellId c : complex_.infinite_cells()) {
    EXPECT_TRUE(complex_.is_infinite(c));
    ++infinite;
  }
  for (const CellId c : complex_.all_cells()) {
    EXPECT_TRUE(complex_.is_cell(c));
    ++all;
  }
  EXPECT_EQ(finite, complex_.num_finite_cells());
  EXPECT_EQ(infinite, complex_.num_infinite_cells());
  EXPECT_EQ(all, complex_.num_all_cells());
}

TEST_P(ComplexOf, NeighborsShareTheFacet) {
  for (const CellId c : complex_.all_cells())
    for (int i = 0; i <= k_; ++i) {
      const CellId other = complex_.neighbor(c, i);
      EXPECT_EQ(other, complex_.neighbors(c)[static_cast<std::size_t>(i)]);
      const int j = complex_.mirror_index(c, i);
      EXPECT_EQ(complex_.neighbor(other, j), c);
      EXPECT_EQ(vertices_without(c, i), vertices_without(other, j));
      EXPECT_EQ(complex_.index_of(c, complex_.vertex(c, i)), i);
    }
}

TEST_P(ComplexOf, StarsLinksAndAdjacentVertices) {
  if (k_ < 0) return;
  for (Index v = 0; v <= complex_.num_vertices(); ++v) {
    const VertexId vertex{v};
    std::set<CellId> expected;
    std::set<VertexId> adjacent;
    for (const CellId c : complex_.all_cells()) {
      if (complex_.index_of(c, vertex) < 0) continue;
      expected.insert(c);
      for (const VertexId other : complex_.vertices(c))
        if (other != vertex && other != infinite_vertex) adjacent.insert(other);
    }
    const std::vector<CellId> star = complex_.star(vertex);
    EXPECT_EQ(star.size(), expected.size());
    EXPECT_EQ(std::set<CellId>(star.begin(), star.end()), expected);
    EXPECT_TRUE(expected.contains(complex_.incident_cell(vertex)));
    EXPECT_EQ(complex_.adjacent_vertices(vertex), std::vector<VertexId>(adjacent.begin(), adjacent.end()));
    for (const Facet& facet : complex_.link(vertex))
      EXPECT_EQ(complex_.vertex(facet.cell, facet.opposite), vertex);
    EXPECT_EQ(complex_.link(vertex).size(), star.size());
  }
}

TEST_P(ComplexOf, FacetsOnceEach) {
  for (const bool with_infinite : {false, true}) {
    std::set<std::vector<VertexId>> expected, found;
    for (const CellId c : complex_.all_cells())
      for (int i = 0; i <= k_; ++i) {
        const auto facet = vertices_without(c, i);
        if (with_infinite || facet.empty() || facet[0] != infinite_vertex) expected.insert(facet);
      }
    const std::vector<Facet> facets = complex_.facets(with_infinite);
    for (const Facet& facet : facets) {
      found.insert(vertices_without(facet.cell, facet.opposite));
      EXPECT_TRUE(with_infinite || !complex_.is_infinite(facet.cell));
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(facets.size(), found.size());
  }
  const std::vector<Facet> hull = complex_.hull_facets();
  EXPECT_EQ(hull.size(), complex_.num_infinite_cells());
  for (const Facet& facet : hull) {
    EXPECT_FALSE(complex_.is_infinite(facet.cell));
    EXPECT_TRUE(complex_.is_infinite(complex_.neighbor(facet.cell, facet.opposite)));
  }
}

TEST_P(ComplexOf, FacesAreAllSubsets) {
  for (int j = 0; j <= k_; ++j) {
    std::set<std::vector<VertexId>> expected;
    for (const CellId c : complex_.finite_cells()) {
      const std::vector<VertexId> cell = complex_.vertices(c);
      for (unsigned subset = 0; subset < (1u << (k_ + 1)); ++subset) {
        std::vector<VertexId> face;
        for (int i = 0; i <= k_; ++i)
          if ((subset >> i) & 1) face.push_back(cell[static_cast<std::size_t>(i)]);
        std::sort(face.begin(), face.end());
        if (static_cast<int>(face.size()) == j + 1) expected.insert(face);
      }
    }
    std::vector<VertexId> flat;
    for (const auto& face : expected) flat.insert(flat.end(), face.begin(), face.end());
    EXPECT_EQ(complex_.faces(j), flat) << "dimension " << j;
    EXPECT_TRUE(j != 1 || complex_.edges() == flat);
  }
  EXPECT_THROW(complex_.faces(k_ + 1), Error);
  EXPECT_THROW(complex_.faces(-1), Error);
}

TEST(CanonicalHashText, IsThirtyTwoDigits) {
  EXPECT_EQ((CanonicalHash{0x0123456789abcdefu, 0xfedcba9876543210u}).hex(),
            "0123456789abcdeffedcba9876543210");
  EXPECT_EQ((CanonicalHash{0, 1}).hex(), "00000000000000000000000000000001");
  // Ids in arrays that hold no points cannot be hashed.
  EXPECT_THROW(canonical_hash({2, 2, {}, {0, 1, 2}, {}, {}}), Error);
}

}  // namespace
}  // namespace delone::complex
