// SPDX-License-Identifier: BSD-3-Clause
// Periodic triangulations of random points, crystals, slabs and wires: check() proves them, and they do not
// depend on what stands for the set.
#include "error_code.hpp"
#include "periodic_sets.hpp"
#include "scale.hpp"
#include "stops_at.hpp"

#include <delone/check.hpp>
#include <delone/periodic.hpp>
#include <delone/progress.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace delone {
namespace {

PeriodicDelaunay<> delaunay(const std::vector<double>& points, const Lattice& lattice,
                            const PeriodicOptions& how = {}) {
  return {PointsView(points, lattice.dimension), lattice, how};
}

void expect_valid(const PeriodicTriangulation& t) {
  const CheckReport report = check(t.to_data(), {.canonical = true});
  EXPECT_TRUE(report.ok) << report;
}

/// The vertices of all cells by rows and offsets from the first one, whatever stands for the points.
using Cell = std::vector<std::vector<std::int64_t>>;
std::multiset<Cell> cells_of(const PeriodicTriangulation& t,
                             const std::vector<std::vector<std::int64_t>>& moved = {}) {
  const auto corners = static_cast<std::size_t>(t.affine_dimension() + 1),
             r = static_cast<std::size_t>(t.rank());
  std::multiset<Cell> cells;
  for (std::size_t c = 0; c < t.num_cells(); ++c) {
    Cell cell;
    for (std::size_t i = 0; i < corners; ++i) {
      const auto row = static_cast<std::size_t>(t.cells()[c * corners + i]);
      std::vector<std::int64_t> vertex{static_cast<std::int64_t>(row)};
      for (std::size_t l = 0; l < r; ++l)
        vertex.push_back(t.cell_offsets()[(c * corners + i) * r + l] + (moved.empty() ? 0 : moved[row][l]));
      cell.push_back(vertex);
    }
    // Relative to each vertex of the least row; the least of these.
    Cell least;
    for (const auto& base : cell) {
      Cell relative = cell;
      for (auto& vertex : relative)
        for (std::size_t l = 1; l <= r; ++l) vertex[l] -= base[l];
      std::sort(relative.begin(), relative.end());
      if (least.empty() || relative < least) least = relative;
    }
    cells.insert(least);
  }
  return cells;
}

/// Other translates of the points, and a translation of all.
TEST(Periodic, ResultsDependOnTheSetOnly) {
  std::mt19937 random(3);
  for (const auto& [name, box] : test::lattices_in_space())
    for (const auto& [set_name, fractions] : test::sets_in_space(test::scaled_count(100)))
      for (const int rank : {3, 2, 1}) {
        SCOPED_TRACE(std::string(name) + ", " + set_name + ", rank " + std::to_string(rank));
        const Lattice lattice = test::of_rank(box, rank);
        const std::vector<double> points = test::at_fractions(fractions, box);
        const auto t = delaunay(points, lattice);
        EXPECT_EQ(t.displacement(), 0);
        expect_valid(t);
        const auto r = static_cast<std::size_t>(rank), n = points.size() / 3;
        std::vector<double> others = points, shifted = points;
        std::vector<std::vector<std::int64_t>> moved(n, std::vector<std::int64_t>(r));
        for (std::size_t row = 0; row < n; ++row)
          for (std::size_t l = 0; l < r; ++l) {
            moved[row][l] = static_cast<std::int64_t>(random() % 7) - 3;
            for (std::size_t j = 0; j < 3; ++j)
              others[3 * row + j] += static_cast<double>(moved[row][l]) * lattice.vectors[3 * l + j];
          }
        // Vectors minus multiples of each other are another basis.
        Lattice basis = lattice;
        for (std::size_t l = 1; l < r; ++l)
          for (std::size_t j = 0; j < 3; ++j) basis.vectors[3 * l + j] -= 2 * basis.vectors[3 * (l - 1) + j];
        EXPECT_EQ(delaunay(others, basis).hash(), t.hash());
        EXPECT_EQ(cells_of(delaunay(others, lattice), moved), cells_of(t));
        for (std::size_t i = 0; i < shifted.size(); ++i) shifted[i] += i % 3 == 0 ? .375 : -.21875;
        EXPECT_EQ(cells_of(delaunay(shifted, lattice)).size(), t.num_cells());
      }
}

TEST(Periodic, LargerSetsAreValid) {
  for (const auto& [name, box] : test::lattices_in_space()) {
    SCOPED_TRACE(name);
    const auto points = test::at_fractions(test::random_fractions(3 * test::scaled_count(1000), 5), box);
    expect_valid(delaunay(points, box));
  }
}

TEST(Periodic, SimpleLatticesHaveSixCellsPerPoint) {
  for (const auto& [name, box] : test::lattices_in_space()) {
    SCOPED_TRACE(name);
    const auto t = delaunay({.25, .25, .25}, box);
    EXPECT_EQ(t.num_cells(), 6u);
    EXPECT_FALSE(t.is_simplicial());
    EXPECT_EQ(cells_of(t), cells_of(delaunay({.5, -.75, .125}, box)));
  }
}

TEST(Periodic, EveryDimension) {
  for (int d = 1; d <= 5; ++d)
    for (int rank = 0; rank <= d; ++rank)
      for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{12}}) {
        if (d == 5 && rank > 3) continue;
        SCOPED_TRACE(testing::Message() << n << " points in dimension " << d << ", rank " << rank);
        Lattice lattice{d, {}};
        for (int i = 0; i < rank; ++i)
          for (int j = 0; j < d; ++j) lattice.vectors.push_back(i == j ? 1 : i == j + 1 ? .25 : 0);
        std::vector<double> points = test::random_fractions(n * static_cast<std::size_t>(d), 17);
        for (double& x : points) x = test::coarse(x);
        const auto t = delaunay(points, lattice);
        EXPECT_EQ(t.affine_dimension(), std::min<int>(d, rank + static_cast<int>(n) - 1));
        if (rank > 0) expect_valid(t);
      }
}

TEST(Periodic, WeightedPoints) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto& [name, box] : test::lattices_in_space())
    for (const int rank : {3, 2, 1})
      for (const double range : {0.0, 1e-3, 0.05, 1.0, 1e3}) {
        SCOPED_TRACE(testing::Message() << name << ", rank " << rank << ", weights up to " << range);
        const Lattice lattice = test::of_rank(box, rank);
        const auto points = test::at_fractions(test::random_fractions(3 * 40, 21), box);
        std::vector<double> weights(40);
        for (double& w : weights) w = range * uniform(random);
        const PeriodicRegular<> t(PointsView(points, 3), weights, lattice);
        expect_valid(t);
        EXPECT_EQ(t.num_vertices() + t.num_hidden(), 40u);
        if (range == 0) {
          EXPECT_EQ(cells_of(t), cells_of(delaunay(points, lattice)));
          EXPECT_EQ(t.hash(), delaunay(points, lattice).hash());
        }
      }
}

TEST(Periodic, DuplicatesAcrossTheBorder) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  const auto t = delaunay({0, 0, 0, 1, 0, 0, 0, 1, -2, .5, .5, .5, 1.5, .5, .5}, box);
  EXPECT_EQ(t.num_vertices(), 2u);
  EXPECT_EQ(t.num_duplicates(), 3u);
  EXPECT_EQ(std::vector<SignedIndex>(t.vertex_of_point().begin(), t.vertex_of_point().end()),
            (std::vector<SignedIndex>{0, 0, 0, 3, 3}));
  EXPECT_EQ(std::vector<std::int32_t>(t.point_offsets().begin(), t.point_offsets().end()),
            (std::vector<std::int32_t>{0, 0, 0, 1, 0, 0, 0, 1, -2, 0, 0, 0, 1, 0, 0}));
  expect_valid(t);
}

TEST(Periodic, PlanarPointsInASlabAndOnAWire) {
  const Lattice slab = Lattice::box(std::vector<double>{1, 1, 5}, std::vector<int>{0, 1});
  std::vector<double> flat = test::random_fractions(3 * 50, 4), lattice;
  for (std::size_t i = 0; i < flat.size(); ++i) flat[i] = i % 3 == 2 ? .25 : test::coarse(flat[i]);
  auto t = delaunay(flat, slab);
  EXPECT_EQ(t.affine_dimension(), 2);
  EXPECT_EQ(t.num_cells(), 100u);  // two triangles per point on a torus
  expect_valid(t);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) lattice.insert(lattice.end(), {i * .25, j * .25, i * .25});
  const Lattice tilted{3, {1, 0, 1, 0, 1, 0}};
  t = delaunay(lattice, tilted);
  EXPECT_EQ(t.affine_dimension(), 2);
  EXPECT_EQ(t.num_cells(), 32u);
  expect_valid(t);
  t = delaunay({0, 0, 0, .5, 0, 0, .75, 0, 0},
               Lattice::box(std::vector<double>{1, 1, 1}, std::vector<int>{0}));
  EXPECT_EQ(t.affine_dimension(), 1);
  EXPECT_EQ(t.num_cells(), 3u);
  expect_valid(t);
}

/// A decimal face-centered crystal in a box of 0.7: with a unit its ties are ties.
TEST(Periodic, DecimalLattices) {
  std::vector<double> points;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j)
      for (int l = 0; l < 7; ++l)
        for (const auto& [x, y, z] : {std::array{0., 0., 0.}, {.05, .05, 0.}, {.05, 0., .05}, {0., .05, .05}})
          points.insert(points.end(), {i * .1 + x, j * .1 + y, l * .1 + z});
  const Lattice box = Lattice::box(std::vector<double>{.7, .7, .7});
  const auto rounded = delaunay(points, box);
  EXPECT_GT(rounded.displacement(), 0);
  EXPECT_LT(rounded.displacement(), 1e-15);
  expect_valid(rounded);
  const auto exact = delaunay(points, box, {.exact = true, .unit = .01});
  EXPECT_EQ(exact.displacement(), 0);
  expect_valid(exact);
  EXPECT_EQ(exact.num_cells(), 343u * 24);  // tetrahedra, and octahedra cut into four
  EXPECT_EQ(test::code_of([&] { delaunay(points, box, {.exact = true}); }), Errc::invalid_argument);
}

TEST(Periodic, BoxesOfAllSizes) {
  const std::vector<double> points =
      test::at_fractions(test::random_fractions(3 * 30, 2), test::lattices_in_space()[3].lattice);
  const Lattice box = test::lattices_in_space()[3].lattice;
  const auto expected = cells_of(delaunay(points, box));
  for (const int exponent : {-1020, -400, -333, -100, 100, 333, 900, 1000}) {
    SCOPED_TRACE(exponent);
    std::vector<double> scaled = points;
    Lattice scaled_box = box;
    for (double& x : scaled) x = std::ldexp(x, exponent);
    for (double& x : scaled_box.vectors) x = std::ldexp(x, exponent);
    const auto t = delaunay(scaled, scaled_box);
    EXPECT_EQ(t.displacement(), 0);
    EXPECT_EQ(cells_of(t), expected);
    expect_valid(t);
  }
}

TEST(Periodic, PointsFarAway) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1});
  const std::vector<double> near{.25, .125, .5, .75, .875, .25};
  std::vector<double> far = near;
  far[0] += 1 << 20;
  far[3] -= 1 << 21;
  EXPECT_EQ(delaunay(far, box).hash(), delaunay(near, box).hash());
  expect_valid(delaunay(far, box));
  far[0] = 1e300;
  EXPECT_EQ(test::code_of([&] { delaunay(far, box); }), Errc::invalid_argument);
}

TEST(Periodic, BadInputIsRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Lattice box = Lattice::box(std::vector<double>{1, 1});
  EXPECT_EQ(test::code_of([&] { delaunay({0, nan}, box); }), Errc::not_finite);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0}, {2, {1, 0, nan, 1}}); }), Errc::not_finite);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0}, {2, {1, 0, 2, 0}}); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0}, {2, {1, 0, 0, 0}}); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0}, {2, {1, 0, 0}}); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0}, {2, {1, 0, 0, 1, 1, 1}}); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0, 1.5, 0}, box, {.wrap = false}); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0}, box, {.unit = -1}); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { delaunay({0, 0}, box, {.unit = 1e-17}); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] {
              Lattice::box(std::vector<double>{1, 1}, std::vector<int>{0, 2});
            }),
            Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] {
              PeriodicRegular<2>(std::vector<std::array<double, 2>>{{0, 0}}, std::vector<double>{1, 2}, box);
            }),
            Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] {
              PeriodicDelaunay<3>(std::vector<std::array<double, 3>>{{0, 0, 0}}, box);
            }),
            Errc::bad_dimension);
  try {
    delaunay({.5, .5, 1.5, 0, 0, 0, 0, -1}, box, {.wrap = false});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.rows(), (std::vector<std::size_t>{1, 3}));
  }
}

TEST(Periodic, NoPoints) {
  const auto t = delaunay({}, Lattice::box(std::vector<double>{1, 1}));
  EXPECT_EQ(t.affine_dimension(), -1);
  EXPECT_EQ(t.num_cells(), 0u);
}

TEST(Periodic, ConstructionsStop) {
  const auto points = test::random_fractions(3 * 20000, 9);
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  const ProgressScope scope(test::stops_at(3));
  EXPECT_EQ(test::code_of([&] { delaunay(points, box); }), Errc::cancelled);
}

}  // namespace
}  // namespace delone
