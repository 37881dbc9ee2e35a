// SPDX-License-Identifier: BSD-3-Clause
// Faces from sets alone: the hulls here are lists of cells, and which of them are coplanar is stated.
#include "hull/hull_faces.hpp"

#include "hull/hull_state.hpp"
#include "hull_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace delone::hull {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Pairs = std::vector<std::pair<Index, Index>>;

std::vector<Index> list(const Lists& lists, std::size_t i) { return {lists[i].begin(), lists[i].end()}; }

/// A pyramid: the square 0 1 2 3, cut into two cells, and the apex 4.
const SimplicialHull pyramid = hull_of(3, {0, 1, 4, 0, 1, 2, 1, 2, 4, 2, 3, 4, 0, 2, 3, 0, 3, 4});

TEST(HullFaces, OfAPyramid) {
  const PolytopeFaces faces = find_faces(pyramid, 5, Pairs{{1, 4}});
  EXPECT_THAT(faces.facet_of_cell, ElementsAre(0, 1, 2, 3, 1, 4));  // numbered by their first cells
  EXPECT_THAT(list(faces.cells_of_facet, 1), ElementsAre(1, 4));
  EXPECT_THAT(faces.is_extreme, ElementsAre(1, 1, 1, 1, 1));
  const Lists sites = find_facet_sites(pyramid, faces);
  EXPECT_THAT(list(sites, 0), ElementsAre(0, 1, 4));
  EXPECT_THAT(list(sites, 1), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(count_faces(sites, 3), ElementsAre(5, 8, 5));
  EXPECT_THAT(common_vertices(sites, std::vector<Index>{0, 1}), ElementsAre(0, 1));
  EXPECT_THAT(common_vertices(sites, std::vector<Index>{0, 2, 3, 4}), ElementsAre(4));
  EXPECT_THAT(common_vertices(sites, std::vector<Index>{0, 3}), ElementsAre(4));
  EXPECT_THAT(common_vertices(sites, {}), IsEmpty());

  const PolytopeRidges ridges = find_ridges(pyramid, faces, sites);
  EXPECT_EQ(count_ridges(pyramid, faces), 8u);
  EXPECT_THAT(ridges.facets, ElementsAre(0, 1, 0, 2, 0, 4, 1, 2, 1, 3, 1, 4, 2, 3, 3, 4));
  EXPECT_EQ(neighboring_facets(pyramid, faces), ridges.facets);
  EXPECT_THAT(list(ridges.sites, 0), ElementsAre(0, 1));
  EXPECT_THAT(list(ridges.sites, 2), ElementsAre(0, 4));
  EXPECT_THAT(list(ridges.sites, 7), ElementsAre(3, 4));
}

TEST(HullFaces, OfASimplicialHullAreItsCells) {
  const PolytopeFaces faces = find_faces(pyramid, 6, Pairs{});
  EXPECT_THAT(faces.facet_of_cell, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(faces.is_extreme, ElementsAre(1, 1, 1, 1, 1, 0));  // site 5 is in no cell
  const Lists sites = find_facet_sites(pyramid, faces);
  EXPECT_EQ(count_ridges(pyramid, faces), 9u);
  EXPECT_EQ(find_ridges(pyramid, faces, sites).sites.size(), 9u);
  EXPECT_THAT(count_faces(sites, 3), ElementsAre(5, 9, 6));
}

// Site 5 is in the middle of the base of the pyramid, 6 in the middle of its edge 0 1: both are vertices of
// cells, and neither is extreme.
TEST(HullFaces, SitesInFacetsAndRidgesAreNotExtreme) {
  const SimplicialHull hull =
      hull_of(3, {0, 6, 4, 6, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 6, 5, 6, 1, 5, 1, 2, 5, 2, 3, 5, 3, 0, 5});
  const PolytopeFaces faces = find_faces(hull, 7, Pairs{{0, 1}, {5, 6}, {6, 7}, {7, 8}, {8, 9}, {9, 5}});
  EXPECT_THAT(faces.facet_of_cell, ElementsAre(0, 0, 1, 2, 3, 4, 4, 4, 4, 4));
  EXPECT_THAT(faces.is_extreme, ElementsAre(1, 1, 1, 1, 1, 0, 0));
  const Lists sites = find_facet_sites(hull, faces);
  EXPECT_THAT(list(sites, 0), ElementsAre(0, 1, 4));
  EXPECT_THAT(list(sites, 4), ElementsAre(0, 1, 2, 3));
  const PolytopeRidges ridges = find_ridges(hull, faces, sites);
  EXPECT_THAT(ridges.facets, ElementsAre(0, 1, 0, 3, 0, 4, 1, 2, 1, 4, 2, 3, 2, 4, 3, 4));
  EXPECT_EQ(neighboring_facets(hull, faces), ridges.facets);
  EXPECT_THAT(list(ridges.sites, 2), ElementsAre(0, 1));  // two cells of both facets meet along it
  EXPECT_EQ(count_ridges(hull, faces), 8u);
}

// Pairs of one hyperplane chain up in any order.
TEST(HullFaces, MergesChains) {
  const SimplicialHull polygon = hull_of(2, {0, 1, 1, 2, 2, 3, 3, 4, 4, 0});
  const PolytopeFaces faces = find_faces(polygon, 5, Pairs{{2, 3}, {4, 3}, {3, 2}});
  EXPECT_THAT(faces.facet_of_cell, ElementsAre(0, 1, 2, 2, 2));
  EXPECT_THAT(faces.is_extreme, ElementsAre(1, 1, 1, 0, 0));
  EXPECT_EQ(count_ridges(polygon, faces), 3u);
}

TEST(HullFaces, OfASegmentAndOfNothing) {
  const SimplicialHull segment{1, {3, 1}, {1, 0}, {}};
  const PolytopeFaces faces = find_faces(segment, 4, Pairs{});
  EXPECT_THAT(faces.is_extreme, ElementsAre(0, 1, 0, 1));
  const Lists sites = find_facet_sites(segment, faces);
  EXPECT_THAT(count_faces(sites, 1), ElementsAre(2));
  EXPECT_EQ(count_ridges(segment, faces), 0u);
  EXPECT_EQ(find_ridges(segment, faces, sites).sites.size(), 0u);

  const PolytopeFaces none = find_faces(SimplicialHull{}, 2, Pairs{});
  EXPECT_EQ(none.num_facets(), 0u);
  EXPECT_THAT(none.is_extreme, ElementsAre(0, 0));
  EXPECT_THAT(count_faces(find_facet_sites(SimplicialHull{}, none), -1), IsEmpty());
}

// The facets of the cube {0, 1, 2}^d hold many cells; 2^(d−j)·C(d, j) of its faces have dimension j.
TEST(HullFaces, OfLatticeCubes) {
  const std::vector<std::size_t> expected[] = {{4, 4}, {8, 12, 6}, {16, 32, 24, 8}};
  for (int d = 2; d <= 4; ++d) {
    HullState state(d);
    state.insert_range(test::lattice(d, 3).points, {});
    const SimplicialHull& hull = state.hull();
    const auto coplanar = state.boundary()->coplanar_neighbors(hull);
    const PolytopeFaces faces = find_faces(hull, state.sites().size(), coplanar);
    const Lists sites = find_facet_sites(hull, faces);
    const auto& counts = expected[d - 2];
    EXPECT_EQ(std::count(faces.is_extreme.begin(), faces.is_extreme.end(), 1), 1 << d);
    EXPECT_EQ(count_faces(sites, d), counts);
    EXPECT_EQ(count_ridges(hull, faces), counts[counts.size() - 2]);
    const PolytopeRidges ridges = find_ridges(hull, faces, sites);
    EXPECT_EQ(ridges.sites.size(), counts[counts.size() - 2]);
    for (std::size_t r = 0; r < ridges.sites.size(); ++r) EXPECT_EQ(ridges.sites[r].size(), 1u << (d - 2));
    for (std::size_t f = 0; f < sites.size(); ++f) EXPECT_EQ(sites[f].size(), 1u << (d - 1));
  }
}

}  // namespace
}  // namespace delone::hull
