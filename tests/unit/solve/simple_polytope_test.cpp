// SPDX-License-Identifier: BSD-3-Clause
// Volumes of polytopes that are given by their corners and the facets through each.
#include "solve/simple_polytope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delone::solve {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Corners = std::vector<std::vector<double>>;

/// The volume of a polytope of dimension m.
double volume_of(std::size_t m, const Corners& corners, const std::vector<std::vector<std::size_t>>& labels) {
  SimplePolytope polytope;
  polytope.start(m, corners[0].size());
  for (std::size_t c = 0; c < corners.size(); ++c) polytope.add_corner(corners[c].data(), labels[c]);
  return polytope.volume();
}

/// Corner i of a simplex is on all facets but the i-th.
double simplex_volume(const Corners& corners) {
  std::vector<std::vector<std::size_t>> labels(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t f = 0; f < corners.size(); ++f)
      if (f != i) labels[i].push_back(f);
  return volume_of(corners.size() - 1, corners, labels);
}

/// The corners of a box, by bits, and their labels: 2j for the low and 2j+1 for the high side of axis j.
struct BoxCorners {
  BoxCorners(std::size_t d, double low, double high) {
    for (std::size_t c = 0; c < std::size_t{1} << d; ++c) {
      x.emplace_back();
      labels.emplace_back();
      for (std::size_t j = 0; j < d; ++j) {
        x.back().push_back((c >> j & 1) != 0 ? high : low);
        labels.back().push_back(2 * j + (c >> j & 1));
      }
    }
  }
  double volume() const { return volume_of(x[0].size(), x, labels); }

  Corners x;
  std::vector<std::vector<std::size_t>> labels;
};

TEST(SimplePolytope, CubesAndFlattenedCubes) {
  for (std::size_t d = 1; d <= 6; ++d) {
    BoxCorners cube(d, 1, 3);
    EXPECT_NEAR(cube.volume(), std::pow(2.0, static_cast<double>(d)), 1e-12);
    for (auto& corner : cube.x) corner[0] = 1;  // the same combinatorics, no volume
    EXPECT_EQ(cube.volume(), 0);
  }
}

// The same order of labels gives the same bits, however far they are apart.
TEST(SimplePolytope, LabelsMayBeAnyNumbers) {
  for (std::size_t d = 2; d <= 6; ++d) {
    BoxCorners cube(d, 1, 3);
    for (std::size_t c = 0; c < cube.x.size(); ++c)
      for (std::size_t j = 0; j < d; ++j)
        cube.x[c][j] = std::sin(cube.x[c][j] * static_cast<double>(j + 1)) / 3;
    const double volume = cube.volume();
    EXPECT_GT(volume, 0);
    for (auto& labels : cube.labels)
      for (std::size_t& label : labels) label = 1000003 * label + 17;
    EXPECT_EQ(cube.volume(), volume);
  }
}

TEST(SimplePolytope, Simplices) {
  EXPECT_EQ(simplex_volume({{3}, {5}}), 2);
  EXPECT_NEAR(simplex_volume({{0, 0}, {3, 0}, {0, 4}}), 6, 1e-14);
  EXPECT_NEAR(simplex_volume({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 1.0 / 6, 1e-15);
  // Within a space of more dimensions: a segment and a triangle in R³.
  EXPECT_NEAR(simplex_volume({{1, 1, 1}, {2, 3, 3}}), 3, 1e-14);
  EXPECT_NEAR(simplex_volume({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), std::sqrt(3.0) / 2, 1e-14);
}

// A pyramid with its apex cut by a plane of height 0: two corners coincide there, joined by an edge of length
// 0, so that each corner is on three facets.
TEST(SimplePolytope, CoincidentCorners) {
  const Corners corners = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}, {1, 1, 3}};
  // Facet 0 is the base, 1 … 4 are the sides at y = 0, x = 2, y = 2 and x = 0.
  EXPECT_NEAR(volume_of(3, corners, {{0, 1, 4}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {1, 2, 4}, {2, 3, 4}}), 4,
              1e-14);
}

// A cube of four dimensions has faces that belong to several facets; each is measured once.
TEST(SimplePolytope, IsReusable) {
  SimplePolytope polytope;
  EXPECT_EQ((polytope.start(2, 2), polytope.volume()), 0);  // no corners
  for (const std::size_t d : {4, 2, 5}) {
    const BoxCorners cube(d, -1, 1);
    polytope.start(d, d);
    for (std::size_t c = 0; c < cube.x.size(); ++c) polytope.add_corner(cube.x[c].data(), cube.labels[c]);
    for (int again = 0; again < 2; ++again)
      EXPECT_NEAR(polytope.volume(), std::pow(2.0, static_cast<double>(d)), 1e-12);
  }
}

// The angles are below 2⁻³⁰: one pass of Gram–Schmidt would lose half of the digits.
TEST(SimplePolytope, NeedleOfASimplex) {
  const double thin = 0x1p-30;
  EXPECT_NEAR(
      simplex_volume({{0, 0, 0}, {1, 0, 0}, {1, thin, 0}, {1, thin, thin * thin}}) / (thin * thin * thin / 6),
      1, 1e-12);
  EXPECT_NEAR(simplex_volume({{0, 0, 0}, {1, 1, 1}, {1 + thin, 1, 1}, {1, 1 + thin, 1}}) / (thin * thin / 6),
              1, 1e-6);
}

TEST(SimplePolytope, AtTheEndsOfTheRange) {
  EXPECT_NEAR(BoxCorners(2, -1e150, 1e150).volume() / 4e300, 1, 1e-14);
  EXPECT_EQ(BoxCorners(3, -1e150, 1e150).volume(), infinity);
  EXPECT_NEAR(BoxCorners(2, 1e-160, 3e-160).volume(), 4e-320, 1e-323);
  EXPECT_EQ(BoxCorners(3, 1e-160, 3e-160).volume(), 0);
  EXPECT_EQ(BoxCorners(2, 0, infinity).volume(), infinity);
  EXPECT_EQ(BoxCorners(1, -1.5e308, 1.5e308).volume(), infinity);
}

}  // namespace
}  // namespace delone::solve
