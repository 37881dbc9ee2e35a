// SPDX-License-Identifier: BSD-3-Clause
// check() on damaged complexes: every level must be seen to fail, with the right cells and points, and on
// sound complexes that other programs might write. The sound ones come from brute force, so nothing here
// depends on the engine.
#include <delone/check.hpp>

#include "brute_force.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace delone {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

CheckReport check_up_to(const ComplexData& data, int level) {
  CheckOptions options;
  options.up_to = level;
  options.canonical = true;
  return check(data, options);
}
CheckReport check_all(const ComplexData& data) { return check_up_to(data, CheckOptions::all); }

// The damage is found at this level and not before.
void expect_failure(const ComplexData& data, std::string_view level, const char* message) {
  const CheckReport report = check_all(data);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.reached.name, level) << report.violation;
  EXPECT_THAT(report.violation, HasSubstr(message));
  if (report.reached.number == 1) return;
  EXPECT_TRUE(check_up_to(data, report.reached.number - 1).ok);
}

// A few points in general position in R^d and their Delaunay triangulation.
ComplexData sound(int d, std::size_t n = 9) {
  return test::BruteForce(make_point_set("uniform", d, n, 3), d).to_data();
}

// A square with its center: cells around point 4.
ComplexData square() {
  return {2, 2, {0, 0, 2, 0, 2, 2, 0, 2, 1, 1}, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}, {}, {}};
}

TEST(Check, SaysWhatIsNoTriangulationOfItsPoints) {
  // two triangles of a lower hull, and a square without one of its triangles
  const ComplexData surface{3, 2, {0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 0}, {0, 1, 2, 2, 1, 3}, {}, {}};
  expect_failure(surface, "volume", "these cells of dimension 2 do not lie in one flat: they are a surface");
  ComplexData part = square();
  part.cells.resize(9);
  expect_failure(part, "local convexity", "if the cells are a part of a triangulation");
  ComplexData flat = surface;
  flat.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  std::swap(flat.cells[0], flat.cells[1]);
  EXPECT_THAT(check_all(flat).violation, ::testing::Not(HasSubstr("surface")));
}

// The neighbors of the cells, by comparing all pairs.
void add_neighbors(ComplexData& data) {
  const auto corners = static_cast<std::size_t>(data.affine_dimension + 1);
  data.neighbors.assign(data.cells.size(), -1);
  const auto facet = [&](std::size_t c, std::size_t i) {
    std::vector<SignedIndex> rows;
    for (std::size_t j = 0; j < corners; ++j)
      if (j != i) rows.push_back(data.cells[c * corners + j]);
    std::sort(rows.begin(), rows.end());
    return rows;
  };
  for (std::size_t a = 0; a < data.num_cells(); ++a)
    for (std::size_t b = 0; b < data.num_cells(); ++b)
      for (std::size_t i = 0; i < corners; ++i)
        for (std::size_t j = 0; j < corners; ++j)
          if (a != b && facet(a, i) == facet(b, j))
            data.neighbors[a * corners + i] = static_cast<SignedIndex>(b);
}

TEST(Check, SoundComplexesPass) {
  for (int d = 1; d <= static_cast<int>(test::scaled_size(5, 4)); ++d)
    for (const test::PointSet& set : test::degenerate_sets(d, static_cast<std::size_t>(d) + 4, 1)) {
      ComplexData data = test::BruteForce(set.points, d).to_data();
      EXPECT_TRUE(check_all(data).ok) << set.name << ": " << check_all(data).violation;
      add_neighbors(data);
      data.vertex_of_point.clear();
      EXPECT_TRUE(check_all(data).ok)
          << set.name << " with neighbors, duplicates derived: " << check_all(data).violation;
    }
}

TEST(Check, NoPointAndOnePointPass) {
  EXPECT_TRUE(check_all({3, -1, {}, {}, {}, {}}).ok);
  EXPECT_TRUE(check_all({3, 0, {1, 2, 3}, {0}, {}, {}}).ok);
  EXPECT_TRUE(check_all({3, 0, {1, 2, 3}, {0}, {-1}, {0}}).ok);
  EXPECT_TRUE(check_all({1, 0, {5, 5}, {0}, {}, {0, 0}}).ok);
  EXPECT_TRUE(check_all({1, 0, {5, 5}, {1}, {}, {}}).ok);
  expect_failure({3, -1, {1, 2, 3}, {}, {}, {}}, "completeness", "point 0");
  expect_failure({1, 0, {5, 6}, {0}, {}, {0, 0}}, "completeness", "not equal");
  expect_failure({1, 0, {5, 6}, {0}, {}, {}}, "completeness", "point 1 is neither");
  expect_failure({3, 0, {1, 2, 3}, {}, {}, {}}, "sphere", "no cell");
}

TEST(Check, ReachedIsTheLastLevelWanted) {
  for (int level = 1; level <= 6; ++level) {
    const CheckReport report = check_up_to(sound(3), level);
    EXPECT_TRUE(report.ok);
    EXPECT_EQ(report.reached.number, level);
  }
}

TEST(CheckStorage, Damage) {
  const auto damaged = [](auto&& damage) {
    ComplexData data = sound(3);
    add_neighbors(data);
    damage(data);
    return data;
  };
  expect_failure(damaged([](ComplexData& c) { c.dimension = 0; }), "storage", "dimension");
  expect_failure(damaged([](ComplexData& c) { c.affine_dimension = 4; }), "storage", "affine dimension");
  expect_failure(damaged([](ComplexData& c) { c.affine_dimension = -1; }), "storage", "affine dimension");
  expect_failure(damaged([](ComplexData& c) { c.points.pop_back(); }), "storage", "multiple");
  expect_failure(damaged([](ComplexData& c) { c.cells.pop_back(); }), "storage", "multiple");
  expect_failure(damaged([](ComplexData& c) { c.neighbors.pop_back(); }), "storage", "neighbors");
  expect_failure(damaged([](ComplexData& c) { c.vertex_of_point.pop_back(); }), "storage", "vertex_of_point");
  expect_failure(damaged([](ComplexData& c) { c.cells[5] = 9; }), "storage", "cell 1 has the vertex 9");
  expect_failure(damaged([](ComplexData& c) { c.cells[5] = -1; }), "storage", "cell 1 has the vertex -1");
  expect_failure(damaged([](ComplexData& c) { c.cells[5] = c.cells[7]; }), "storage", "twice");
  expect_failure(damaged([](ComplexData& c) { c.neighbors[5] = 1000; }), "storage", "neighbor 1 of cell 1");
  expect_failure(damaged([](ComplexData& c) { c.neighbors[5] = -2; }), "storage", "neighbor 1 of cell 1");
  expect_failure(damaged([](ComplexData& c) { c.vertex_of_point[2] = 9; }), "storage", "point 2");
  expect_failure(damaged([](ComplexData& c) { c.points[7] = std::nan(""); }), "storage", "point 2");
  expect_failure(damaged([](ComplexData& c) {
                   c.points.clear();
                   c.vertex_of_point.clear();
                 }),
                 "storage", "no points");
}

TEST(CheckIncidence, ThreeCellsOnOneFacet) {
  ComplexData data = square();
  data.points.insert(data.points.end(), {9, 9});
  data.cells.insert(data.cells.end(), {4, 1, 5});
  expect_failure(data, "incidence", "share the facet {4, 1}");
  EXPECT_THAT(check_all(data).cells, ::testing::UnorderedElementsAre(0, 1, 4));
}

TEST(CheckIncidence, WrongNeighbors) {
  for (const SignedIndex wrong : {-1, 2, 3}) {
    ComplexData data = square();
    add_neighbors(data);
    ASSERT_EQ(data.neighbors[0], 1);  // across the edge {1, 4} of cell 0
    data.neighbors[0] = wrong;
    expect_failure(data, "incidence",
                   wrong < 0 ? "neighbor 0 of cell 0 is missing" : "cell 1 shares the facet {1, 4}");
  }
  ComplexData data = square();
  add_neighbors(data);
  data.neighbors[2] = 2;
  expect_failure(data, "incidence", "does not share the facet {0, 1}");
}

TEST(CheckIncidence, OrientationMatters) {
  ComplexData data = square();
  std::swap(data.cells[3], data.cells[4]);
  expect_failure(data, "incidence", "not oriented coherently");
  CheckOptions options;
  options.oriented = false;
  EXPECT_TRUE(check(data, options).ok) << check(data, options).violation;
}

TEST(CheckSphere, TwoPieces) {
  // Two triangles far apart, and two that share a vertex only.
  expect_failure({2, 2, {0, 0, 1, 0, 0, 1, 5, 5, 6, 5, 5, 6}, {0, 1, 2, 3, 4, 5}, {}, {}}, "sphere",
                 "falls apart");
  expect_failure({2, 2, {0, 0, 1, 0, 0, 1, -1, 0, 0, -1}, {0, 1, 2, 0, 3, 4}, {}, {}}, "sphere",
                 "share the ridge {0}");
}

TEST(CheckSphere, ARingHasAHole) {
  // Six triangles around a triangular hole: two closed curves of hull edges.
  const ComplexData ring{
      2,  2, {0, 0, 9, 0, 0, 9, 2, 2, 4, 2, 2, 4}, {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5},
      {}, {}};
  expect_failure(ring, "sphere", "hull falls apart");
}

TEST(CheckSphere, ClosedSurfaceHasNoHull) {
  const ComplexData tetrahedron{
      3, 2, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, {}, {}};
  expect_failure(tetrahedron, "sphere", "no hull");
}

TEST(CheckSphere, TwoTetrahedraAtAnEdge) {
  // They share the edge {0, 1} and nothing else, so four hull facets meet there.
  const ComplexData data{
      3, 3, {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0}, {0, 2, 3, 1, 0, 4, 5, 1}, {}, {}};
  expect_failure(data, "sphere", "share the ridge {0, 1}");
}

// A row of triangular prisms bent into a closed tube, three tetrahedra each: a solid torus.
TEST(CheckSphere, ASolidTorusIsNoBall) {
  ComplexData data{3, 3, {}, {}, {}, {}};
  constexpr SignedIndex length = 5;
  for (SignedIndex i = 0; i < length; ++i)
    for (int j = 0; j < 3; ++j)
      data.points.insert(data.points.end(),
                         {static_cast<double>(i), static_cast<double>(j), static_cast<double>(i * j)});
  for (SignedIndex i = 0; i < length; ++i) {
    const SignedIndex a = 3 * i, b = 3 * ((i + 1) % length);
    for (const auto& cell :
         {std::vector{a, a + 1, a + 2, b + 2}, {a, a + 1, b + 1, b + 2}, {a, b, b + 1, b + 2}})
      data.cells.insert(data.cells.end(), cell.begin(), cell.end());
  }
  CheckOptions options;
  options.oriented = false;
  const CheckReport report = check(data, options);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.reached.name, "sphere");
  EXPECT_THAT(report.violation, HasSubstr("Euler characteristic"));
}

TEST(CheckVolume, FlatAndNegativeCells) {
  ComplexData flat = square();
  flat.points[8] = 0;  // the center moves into the left side
  expect_failure(flat, "volume", "flat");
  EXPECT_THAT(check_all(flat).cells, Contains(3u));

  ComplexData folded = square();
  folded.points[8] = -0x1p-1000;  // and barely beyond it
  expect_failure(folded, "volume", "negatively oriented");

  ComplexData mirrored = square();
  for (std::size_t i = 0; i < mirrored.points.size(); i += 2) mirrored.points[i] *= -1;
  expect_failure(mirrored, "volume", "negatively oriented");
  CheckOptions options;
  options.oriented = false;
  EXPECT_TRUE(check(mirrored, options).ok) << "a mirrored triangulation is one, if cells are sets";
  const CheckReport report = check(folded, options);
  EXPECT_EQ(report.reached.name, "volume");
  EXPECT_THAT(report.violation, HasSubstr("same side"));
}

TEST(CheckVolume, CellsLeaveTheirFlat) {
  const ComplexData bent{3, 2, {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 1}, {0, 1, 2, 0, 2, 3}, {}, {}};
  expect_failure(bent, "volume", "leaves the flat of dimension 2 with its vertex 3");
  const ComplexData thin{3, 2, {0, 0, 0, 1, 1, 1, 2, 2, 2}, {0, 1, 2}, {}, {}};
  expect_failure(thin, "volume", "cell 0 is flat");
}

TEST(CheckLocalConvexity, WrongDiagonal) {
  // Points on a thin kite: the long diagonal is not Delaunay.
  ComplexData data{2, 2, {-3, 0, 0, -1, 3, 0, 0, 1}, {0, 1, 2, 0, 2, 3}, {}, {}};
  expect_failure(data, "local convexity", "is inside the sphere of cell");
  EXPECT_THAT(check_all(data).cells, ::testing::ElementsAre(0, 1));
  data.cells = {0, 1, 3, 1, 2, 3};
  EXPECT_TRUE(check_all(data).ok);
}

TEST(CheckLocalConvexity, OneUlpInside) {
  ComplexData data{2, 2, {-1, 0, 0, -1, 1, 0, 0, 1}, {0, 1, 2, 0, 2, 3}, {}, {}};
  data.points[7] = std::nextafter(1.0, 0.0);
  expect_failure(data, "local convexity", "inside the sphere");
  data.points[7] = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(check_all(data).ok);
}

TEST(CheckLocalConvexity, TiesAndTheCanonicalChoice) {
  const ComplexData canonical{2, 2, {0, 0, 1, 0, 0, 1, 1, 1}, {0, 1, 2, 1, 3, 2}, {}, {}};
  EXPECT_TRUE(check_all(canonical).ok);
  EXPECT_EQ(check_all(canonical).ties, 1u);
  ComplexData other = canonical;
  other.cells = {0, 1, 3, 0, 3, 2};
  EXPECT_TRUE(check(other).ok) << "Delaunay, but not the one of the perturbation";
  EXPECT_EQ(check(other).ties, 1u);
  expect_failure(other, "local convexity", "inside when ties are perturbed");
}

TEST(CheckLocalConvexity, HullWithADent) {
  // An outer triangle is missing: the point 3 lies inside the hull edge {1, 2}, seen from 0.
  const ComplexData dent{2, 2, {0, 0, 4, 0, 0, 4, 1, 1}, {0, 1, 3, 0, 3, 2}, {}, {}};
  expect_failure(dent, "local convexity", "hull is not convex");
  // A point on the hull edge is fine.
  const ComplexData straight{2, 2, {0, 0, 4, 0, 0, 4, 2, 2}, {0, 1, 3, 0, 3, 2}, {}, {}};
  EXPECT_TRUE(check_all(straight).ok) << check_all(straight).violation;
}

TEST(CheckLocalConvexity, WoundTwiceAroundAVertex) {
  // A disk of triangles that turns twice around point 0. Everywhere it looks like a Delaunay triangulation
  // with a convex hull, and it has the topology of one; only the cover is double. Eight places on a circle,
  // each visited twice, the second time by other rows.
  ComplexData data{2, 2, {0, 0}, {}, {}, {}};
  const double around[8][2] = {{5, 0}, {4, 3}, {0, 5}, {-3, 4}, {-5, 0}, {-4, -3}, {0, -5}, {3, -4}};
  for (SignedIndex i = 0; i < 16; ++i) {
    data.points.insert(data.points.end(), {around[i % 8][0], around[i % 8][1]});
    data.cells.insert(data.cells.end(), {0, i + 1, (i + 1) % 16 + 1});
  }
  const CheckReport report = check(data);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.reached.name, "local convexity");
  EXPECT_THAT(report.violation, HasSubstr("overlap"));
}

TEST(CheckCompleteness, PointsWithoutAVertex) {
  ComplexData data = square();
  data.points.insert(data.points.end(), {1.5, 1.25});
  expect_failure(data, "completeness", "point 5 is neither a vertex of a cell nor equal to one");
  data.vertex_of_point = {0, 1, 2, 3, 4, 5};
  expect_failure(data, "completeness", "point 5 is its own vertex, but no cell has it");
  data.vertex_of_point[5] = 4;
  expect_failure(data, "completeness", "point 5 was merged into point 4, but they are not equal");
  data.points[10] = data.points[11] = 1;
  EXPECT_TRUE(check_all(data).ok);
  data.vertex_of_point[4] = 5;
  expect_failure(data, "completeness", "no cell has that");
  data.vertex_of_point[4] = 3;
  expect_failure(data, "completeness", "point 4 is a vertex of a cell, but was merged into point 3");
}

TEST(CheckCompleteness, AffineDimension) {
  // A duplicate cannot raise the dimension, so only a point without a vertex could: it is named first.
  ComplexData data{3, 2, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2}, {}, {}};
  expect_failure(data, "completeness", "point 3");
  EXPECT_THAT(check_all(data).points, ::testing::ElementsAre(3));
}

}  // namespace
}  // namespace delone
