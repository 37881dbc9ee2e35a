// SPDX-License-Identifier: BSD-3-Clause
// Faces as sets: the largest parts of one, and numbers of faces, which are the same from above and from
// below.
#include "polyhedra/faces.hpp"

#include "cone_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

Face face_of(std::size_t width, const std::vector<std::size_t>& of) {
  Face face(words_for(width), 0);
  for (const std::size_t i : of) insert(face, i);
  return face;
}

TEST(LargestParts, AreNoPartsOfEachOtherAndNotTheWhole) {
  BitRows sets(6, 70);
  const auto fill = [&](std::size_t set, const std::vector<std::size_t>& of) {
    for (const std::size_t i : of) insert(sets[set], i);
  };
  fill(0, {0, 1, 2, 69});  // all of the face
  fill(1, {0, 1, 5});
  fill(2, {0});
  fill(3, {2, 69});
  fill(4, {1, 0});  // the same part
  EXPECT_THAT(largest_parts(face_of(70, {0, 1, 2, 69}), sets),
              UnorderedElementsAre(face_of(70, {0, 1}), face_of(70, {2, 69})));
  EXPECT_THAT(largest_parts(face_of(70, {7}), sets), ElementsAre(face_of(70, {})));
  EXPECT_TRUE(largest_parts(face_of(70, {}), sets).empty());
}

std::vector<std::size_t> counts_of(const Description& of) {
  return count_faces(of, of.incidence.transposed(of.facets.size()));
}

/// The polar of a polytope around the origin: facets and vertices change places, so the faces are counted in
/// the other direction.
Description polar_of(const Description& of) {
  Rows generators;
  for (const Row& facet : of.facets) {
    Row point = facet;
    for (std::size_t i = 0; i + 1 < point.size(); ++i) point[i] = -point[i];
    generators.push_back(point);
  }
  return from_generators(generators, {}, of.dimension);
}

TEST(CountFaces, OfPolarsAreReversed) {
  random::Generator generator(1);
  for (std::size_t d = 2; d <= 4; ++d)
    for (std::size_t n = d + 1; n <= d + 8; ++n) {
      Rows points = random_rows(generator, n, d + 1, 9);
      for (Row& point : points) point.back() = 1;
      for (std::size_t i = 0; i < d; ++i)  // the origin is inside
        for (const int sign : {2, -2}) {
          Row axis(d + 1, Integer(0));
          axis[i] = sign;
          axis.back() = 1;
          points.push_back(axis);
        }
      const Description polytope = from_generators(points, {}, d);
      std::vector<std::size_t> counts = counts_of(polytope), of_polar = counts_of(polar_of(polytope));
      EXPECT_EQ(counts.front(), polytope.num_vertices);
      EXPECT_EQ(counts.back(), polytope.facets.size());
      std::reverse(of_polar.begin(), of_polar.end());
      EXPECT_EQ(counts, of_polar);
      std::ptrdiff_t euler = 0;
      for (std::size_t j = counts.size(); j-- > 0;) euler = static_cast<std::ptrdiff_t>(counts[j]) - euler;
      EXPECT_EQ(euler, d % 2 == 0 ? 0 : 2);
    }
}

TEST(CountFaces, FacesAtInfinityAndLinesDoNotCount) {
  // A prism without ends over a square, which has no vertex; and a quadrant in space, with its axis.
  const Description pillar =
      from_inequalities({{1, 0, 0, 0}, {0, 1, 0, 0}, {-1, 0, 0, 1}, {0, -1, 0, 1}}, {}, 3);
  EXPECT_THAT(counts_of(pillar), ElementsAre(0, 4, 4));
  const Description wedge = from_inequalities({{1, 0, 0, 0}, {0, 1, 0, 0}}, {}, 3);
  EXPECT_THAT(counts_of(wedge), ElementsAre(0, 1, 2));
  const Description orthant = from_inequalities({{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, {}, 3);
  EXPECT_THAT(counts_of(orthant), ElementsAre(1, 3, 3));
  // A cone over an octahedron has fewer generators than facets, so its faces are counted upwards.
  Rows rays;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int sign : {1, -1}) {
      rays.push_back({0, 0, 0, 1, 0});
      rays.back()[axis] = sign;
    }
  EXPECT_THAT(counts_of(from_generators(rays, {}, 4)), ElementsAre(1, 6, 12, 8));
}

TEST(VolumeOf, SimplicesAndPyramids) {
  const auto volume = [](const Rows& points, std::size_t d) {
    const Description of = from_generators(points, {}, d);
    const ExactVolume found = volume_of(of, of.incidence.transposed(of.facets.size()));
    return std::pair(found.numerator, found.denominator);
  };
  EXPECT_EQ(volume({{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}, 2), std::pair(Integer(1), Integer(12)));
  EXPECT_EQ(volume({{0, 0, 1}, {3, 0, 1}, {0, 2, 1}, {3, 2, 1}}, 2), std::pair(Integer(6), Integer(1)));
  // A pyramid over a square that is parallel to no axis: it lies in x + y + z = 3.
  EXPECT_EQ(volume({{3, 0, 0, 1}, {0, 3, 0, 1}, {1, 1, 1, 1}, {2, 2, -1, 1}, {0, 0, 0, 1}}, 3),
            std::pair(Integer(3), Integer(1)));
}

}  // namespace
}  // namespace delone::polyhedra
