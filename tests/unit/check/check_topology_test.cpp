// SPDX-License-Identifier: BSD-3-Clause
// Levels 2 and 3 of check() one by one: pairing of facets, coherent orientation, and spheres.
#include "check/check_stages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace delone::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Rows = std::vector<SignedIndex>;

/// Simplices of dimension k on n points; coordinates are not looked at.
ComplexData complex_of(int k, std::size_t n, Rows cells) {
  ComplexData data;
  data.dimension = data.affine_dimension = k;
  data.points.resize(n * static_cast<std::size_t>(k));
  data.cells = std::move(cells);
  return data;
}

Examined incidence_of(const ComplexData& data, bool oriented = true) {
  Examined examined{data, static_cast<std::size_t>(data.affine_dimension + 1)};
  check_incidence(examined, oriented);
  return examined;
}

template <class Work>
std::string violation(Work work) {
  try {
    work();
  } catch (const Violation& found) {
    return found.message;
  }
  return "none";
}
std::string violation_of_sphere(const ComplexData& data, bool oriented = true) {
  return violation([&] {
    Examined examined = incidence_of(data, oriented);
    check_sphere(examined);
  });
}

TEST(CheckTopology, FacetsArePaired) {
  EXPECT_THAT(paired_facets(Rows{0, 1, 2, 3, 2, 1}, 3), ElementsAre(1, -1, -1, 0, -1, -1));
  EXPECT_THAT(paired_facets(Rows{0, 1, 1, 2}, 2), ElementsAre(1, -1, -1, 0));
  EXPECT_THAT(paired_facets(Rows{5}, 1), ElementsAre(-1));
  EXPECT_THAT(paired_facets({}, 3), ElementsAre());
  EXPECT_THAT(violation([] {
                paired_facets(Rows{0, 1, 2, 0, 1, 3, 1, 0, 4}, 3);
              }),
              HasSubstr("the cells 0, 1 and 2 share the facet {1, 0}"));
}

TEST(CheckTopology, PairsDoNotDependOnThreads) {
  // a strip of triangles, long enough for several parts
  Rows cells;
  for (SignedIndex i = 0; i < 30000; ++i) cells.insert(cells.end(), {i, i + 1, i + 2});
  const std::vector<SignedIndex> one = paired_facets(cells, 3), many = paired_facets(cells, 3, {}, 4);
  EXPECT_EQ(one, many);
  EXPECT_THAT((Rows{one[3], one[4], one[5]}), ElementsAre(2, -1, 0));
}

TEST(CheckTopology, EqualFacetsAndMirrors) {
  const Rows a{0, 1, 2}, b{3, 2, 1}, c{3, 2, 0};
  EXPECT_TRUE(equal_facets(a, 0, b, 0));
  EXPECT_FALSE(equal_facets(a, 0, c, 0));
  EXPECT_FALSE(equal_facets(a, 1, b, 0));
  EXPECT_EQ(mirror(a, 0, b), 0u);
  EXPECT_EQ(mirror(b, 0, a), 0u);
  EXPECT_EQ(mirror(a, 1, c), 0u);
}

TEST(CheckTopology, CoherentOrientation) {
  Rows scratch;
  const Rows a{0, 1, 2}, same{3, 2, 1}, other{3, 1, 2};
  EXPECT_TRUE(coherent(a, 0, same, 0, scratch));
  EXPECT_FALSE(coherent(a, 0, other, 0, scratch));
  EXPECT_FALSE(coherent(a, 0, a, 0, scratch)) << "a cell and its copy lie on one side";
}

TEST(CheckTopology, Incidence) {
  ComplexData square = complex_of(2, 4, {0, 1, 2, 3, 2, 1});
  EXPECT_THAT(incidence_of(square).neighbors, ElementsAre(1, -1, -1, 0, -1, -1));
  square.neighbors = {1, -1, -1, 0, -1, -1};
  EXPECT_EQ(violation([&] { incidence_of(square); }), "none");
  square.neighbors = {1, -1, -1, -1, -1, -1};
  EXPECT_NE(violation([&] { incidence_of(square); }), "none");
  square.neighbors = {-1, 1, -1, 0, -1, -1};
  EXPECT_NE(violation([&] { incidence_of(square); }), "none");
  const ComplexData turned = complex_of(2, 4, {0, 1, 2, 3, 1, 2});
  EXPECT_NE(violation([&] { incidence_of(turned); }), "none");
  EXPECT_EQ(violation([&] { incidence_of(turned, false); }), "none");
}

TEST(CheckTopology, Spheres) {
  EXPECT_EQ(violation_of_sphere(complex_of(1, 3, {0, 1, 1, 2})), "none");
  EXPECT_EQ(violation_of_sphere(complex_of(2, 4, {0, 1, 2, 3, 2, 1})), "none");
  EXPECT_EQ(violation_of_sphere(complex_of(2, 5, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4})), "none");
  EXPECT_EQ(violation_of_sphere(complex_of(3, 5, {0, 1, 2, 3, 4, 1, 3, 2})), "none");
  ComplexData point = complex_of(1, 1, {0});
  point.affine_dimension = 0;
  EXPECT_EQ(violation_of_sphere(point), "none");
}

TEST(CheckTopology, WhatIsNoSphere) {
  // two triangles apart, two that share a vertex only, and a ring
  EXPECT_NE(violation_of_sphere(complex_of(2, 6, {0, 1, 2, 3, 4, 5})), "none");
  EXPECT_NE(violation_of_sphere(complex_of(2, 5, {0, 1, 2, 0, 3, 4})), "none");
  const Rows ring{0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 2, 0, 5, 0, 3, 5};
  EXPECT_NE(violation_of_sphere(complex_of(2, 6, ring)), "none");
  EXPECT_NE(violation_of_sphere(complex_of(1, 4, {0, 1, 2, 3})), "none");
}

TEST(CheckTopology, HullFacetsAndTheirNeighbors) {
  const ComplexData square = complex_of(2, 5, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
  Examined examined = incidence_of(square);
  check_sphere(examined);
  ASSERT_EQ(examined.hull.size(), 4u);
  for (std::size_t h = 0; h < 4; ++h) {
    EXPECT_EQ(examined.hull[h].second, 2u) << "opposite the center";
    const auto facet = examined.hull_facet(h);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto next = examined.hull_facet(static_cast<std::size_t>(examined.hull_neighbors[2 * h + i]));
      EXPECT_TRUE(next[0] == facet[1 - i] || next[1] == facet[1 - i]);
    }
  }
}

}  // namespace
}  // namespace delone::internal
