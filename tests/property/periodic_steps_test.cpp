// SPDX-License-Identifier: BSD-3-Clause
// Time steps of periodic sets: whatever the history, all arrays are those of a new object.
#include "error_code.hpp"
#include "periodic_sets.hpp"
#include "scale.hpp"
#include "stops_at.hpp"

#include <delone/check.hpp>
#include <delone/periodic.hpp>
#include <delone/progress.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace delone {
namespace {

template <class T>
std::vector<T> copy_of(std::span<const T> items) {
  return {items.begin(), items.end()};
}

/// Every array and number, to the last bit.
void expect_same_arrays(const PeriodicTriangulation& a, const PeriodicTriangulation& b) {
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(copy_of(a.points()), copy_of(b.points()));
  EXPECT_EQ(copy_of(a.weights()), copy_of(b.weights()));
  EXPECT_EQ(a.lattice().vectors, b.lattice().vectors);
  EXPECT_EQ(a.displacement(), b.displacement());
  EXPECT_EQ(a.affine_dimension(), b.affine_dimension());
  EXPECT_EQ(copy_of(a.cells()), copy_of(b.cells()));
  EXPECT_EQ(copy_of(a.cell_offsets()), copy_of(b.cell_offsets()));
  EXPECT_EQ(copy_of(a.neighbors()), copy_of(b.neighbors()));
  EXPECT_EQ(copy_of(a.neighbor_offsets()), copy_of(b.neighbor_offsets()));
  EXPECT_EQ(copy_of(a.vertex_of_point()), copy_of(b.vertex_of_point()));
  EXPECT_EQ(copy_of(a.point_offsets()), copy_of(b.point_offsets()));
  EXPECT_EQ(a.num_vertices(), b.num_vertices());
  EXPECT_EQ(a.num_hidden(), b.num_hidden());
  EXPECT_EQ(a.is_simplicial(), b.is_simplicial());
}

PeriodicDelaunay<> new_delaunay(const std::vector<double>& points, const Lattice& lattice,
                                const Options& options = {}) {
  return {PointsView(points, lattice.dimension), lattice, {}, options};
}

/// Points that have moved by up to a length, on a coarse grid.
std::vector<double> stirred(std::vector<double> points, double length, std::mt19937_64& random) {
  std::uniform_real_distribution<double> step(-length, length);
  for (double& x : points) x = test::coarse(x + step(random));
  return points;
}

/// Some points go to other translates of themselves, as programs do that keep particles in the box.
void wrap_some(std::vector<double>& points, const Lattice& lattice, std::mt19937_64& random) {
  const auto d = static_cast<std::size_t>(lattice.dimension), r = static_cast<std::size_t>(lattice.rank());
  for (std::size_t at = 0; at < points.size(); at += d) {
    if (random() % 8 != 0 || r == 0) continue;
    const std::size_t i = random() % r;
    const double by = static_cast<double>(random() % 5) - 2;
    for (std::size_t j = 0; j < d; ++j) points[at + j] += by * lattice.vectors[i * d + j];
  }
}

/// Several steps one after the other, each compared with a new object.
void run_steps(std::vector<double> points, const Lattice& lattice, double length, int steps, unsigned seed) {
  std::mt19937_64 random(seed);
  PeriodicDelaunay<> t = new_delaunay(points, lattice);
  for (int step = 0; step < steps; ++step) {
    points = stirred(points, length, random);
    if (step % 2 == 1) wrap_some(points, lattice, random);
    t = t.moved(PointsView(points, lattice.dimension));
    expect_same_arrays(t, new_delaunay(points, lattice, {.seed = random() | 1}));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(PeriodicSteps, AreAsNewObjects) {
  for (const auto& [name, box] : test::lattices_in_space())
    for (const auto& [set_name, fractions] : test::sets_in_space(test::scaled_count(260)))
      for (const int rank : {3, 2, 1, 0})
        for (const double length : {0.0, 0x1p-22, 1e-4, 0.5}) {
          SCOPED_TRACE(std::string(name) + ", " + set_name + ", rank " + std::to_string(rank) +
                       ", steps of " + std::to_string(length));
          run_steps(test::at_fractions(fractions, box), test::of_rank(box, rank), length, 3, 5);
          if (HasFailure()) return;
        }
}

TEST(PeriodicSteps, ClustersAndFarPoints) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> points;
  for (int i = 0; i < 600; ++i) {
    const double size = std::exp2(-static_cast<double>(i % 12));
    for (int j = 0; j < 3; ++j) points.push_back(test::coarse(.01 + size * normal(random)));
  }
  PeriodicDelaunay<> t = new_delaunay(points, box);
  for (int step = 0; step < 6; ++step) {
    points = stirred(points, 1e-6, random);
    // Some points go anywhere, one meets another one, and one comes back from there.
    for (int far = 0; far < step; ++far)
      for (int j = 0; j < 3; ++j)
        points[3 * (random() % 600) + static_cast<std::size_t>(j)] =
            test::coarse(std::ldexp(static_cast<double>(random() % 4096), -11));
    for (std::size_t j = 0; j < 3; ++j) points[3 * 5 + j] = points[3 * 9 + j] + (step % 2 == 0 ? 0 : 0.125);
    t = t.moved(PointsView(points, 3));
    expect_same_arrays(t, new_delaunay(points, box));
  }
}

/// Long runs: points drift through the border, until what is known beside the box is used up.
TEST(PeriodicSteps, ManySteps) {
  for (const int rank : {3, 1}) {
    const Lattice box = test::of_rank(test::lattices_in_space()[2].lattice, rank);
    std::vector<double> points = test::at_fractions(test::random_fractions(900, 3), box);
    PeriodicDelaunay<> t = new_delaunay(points, box);
    std::mt19937_64 random(2);
    for (std::size_t step = 0; step < test::scaled_count(100); ++step) {
      points = stirred(points, 2e-3, random);
      for (std::size_t at = 0; at < points.size(); at += 3) points[at] += 0x1p-8;
      t = t.moved(PointsView(points, 3));
      if (step % 10 == 9) expect_same_arrays(t, new_delaunay(points, box));
    }
    EXPECT_TRUE(check(t.to_data(), {.canonical = true}).ok);
  }
}

TEST(PeriodicSteps, EveryDimension) {
  for (int d = 1; d <= 5; ++d)
    for (int rank = 0; rank <= d; ++rank) {
      if (d == 5 && rank > 3) continue;
      SCOPED_TRACE(testing::Message() << "dimension " << d << ", rank " << rank);
      Lattice lattice{d, {}};
      for (int i = 0; i < rank; ++i)
        for (int j = 0; j < d; ++j) lattice.vectors.push_back(i == j ? 1 : i == j + 1 ? .25 : 0);
      const std::size_t n = d <= 2 ? 400 : d == 3 ? 200 : d == 4 ? 80 : 12;
      std::vector<double> points = test::random_fractions(n * static_cast<std::size_t>(d), 17);
      for (double& x : points) x = test::coarse(x);
      run_steps(points, lattice, 1e-4, 3, 11);
    }
}

/// Steps are also repaired where several points are at one place, or in a plane.
TEST(PeriodicSteps, DuplicatesAndFlatSets) {
  const Lattice slab = Lattice::box(std::vector<double>{1, 1, 5}, std::vector<int>{0, 1});
  std::vector<double> points = test::random_fractions(600, 4);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = i % 3 == 2 ? .25 : test::coarse(points[i]);
  for (std::size_t i = 0; i < 30; ++i) points[570 + i] = points[i];
  std::mt19937_64 random(6);
  PeriodicDelaunay<> t = new_delaunay(points, slab);
  for (int step = 0; step < 6; ++step) {
    const std::vector<double> before = points;
    points = stirred(points, 1e-5, random);
    for (std::size_t i = 2; i < points.size(); i += 3)
      points[i] = step < 3 ? .25 : step == 3 ? before[i] + 0x1p-20 * static_cast<double>(random() % 3) : .5;
    for (std::size_t i = 0; i < 15; ++i) points[570 + i] = points[i];
    t = t.moved(PointsView(points, 3));
    expect_same_arrays(t, new_delaunay(points, slab));
  }
}

TEST(PeriodicSteps, WeightsChange) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto& [name, box] : test::lattices_in_space())
    for (const int rank : {3, 2})
      for (const double range : {0.0, 1e-3, 0.02, 1.0}) {
        SCOPED_TRACE(testing::Message() << name << ", rank " << rank << ", weights up to " << range);
        const Lattice lattice = test::of_rank(box, rank);
        std::vector<double> points = test::at_fractions(test::random_fractions(900, 21), box), weights(300);
        for (double& w : weights) w = range * uniform(random);
        PeriodicRegular<> t(PointsView(points, 3), weights, lattice);
        for (int step = 0; step < 4; ++step) {
          points = stirred(points, 1e-4, random);
          for (double& w : weights) w *= 1 + 1e-3 * uniform(random);
          // Some points are hidden from now on, and one comes back.
          if (step == 1) weights[17] += 0.25;
          if (step == 2) weights[17] -= 0.25;
          t = t.moved(PointsView(points, 3), weights);
          expect_same_arrays(t, PeriodicRegular<>(PointsView(points, 3), weights, lattice));
          if (step == 0) expect_same_arrays(t.moved(PointsView(points, 3)), t);
          if (step == 1) {
            EXPECT_GT(t.num_hidden(), 2u);
          }
          if (HasFailure()) return;
        }
      }
}

/// Boxes of a barostat, and another basis of the same lattice.
TEST(PeriodicSteps, LatticesChange) {
  Lattice box = test::lattices_in_space()[2].lattice;
  std::vector<double> points = test::at_fractions(test::random_fractions(900, 9), box);
  PeriodicDelaunay<> t = new_delaunay(points, box);
  for (int step = 0; step < 4; ++step) {
    const double factor = 1 + 1e-5 * (step + 1);
    for (double& x : points) x *= factor;
    for (double& x : box.vectors) x *= factor;
    if (step == 2)
      for (std::size_t j = 0; j < 3; ++j) box.vectors[3 + j] += box.vectors[j];
    t = t.moved(PointsView(points, 3), box);
    expect_same_arrays(t, new_delaunay(points, box));
  }
}

TEST(PeriodicSteps, UnitsAndSizes) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  for (const double unit : {0.0, 1e-3})
    for (const int exponent : {0, -400, 300}) {
      if (unit > 0 && exponent != 0) continue;
      SCOPED_TRACE(exponent);
      Lattice scaled = box;
      for (double& x : scaled.vectors) x = std::ldexp(x, exponent);
      std::vector<double> points = test::random_fractions(900, 2);
      for (double& x : points) x = std::ldexp(unit > 0 ? std::nearbyint(x / unit) * unit : x, exponent);
      const PeriodicOptions how{.unit = unit};
      PeriodicDelaunay<> t(PointsView(points, 3), scaled, how);
      for (int step = 0; step < 3; ++step) {
        for (std::size_t i = 0; i < points.size(); i += 7)
          points[i] += std::ldexp(unit > 0 ? unit : 1e-5, exponent);
        t = t.moved(PointsView(points, 3));
        expect_same_arrays(t, PeriodicDelaunay<>(PointsView(points, 3), scaled, how));
      }
    }
}

TEST(PeriodicSteps, BadStepsAreRefusedByNameAndChangeNothing) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  const std::vector<double> points = test::random_fractions(900, 5);
  const PeriodicDelaunay<> t(PointsView(points, 3), box, {.wrap = false});
  const CanonicalHash hash = t.hash();
  std::vector<double> bad = points;
  bad[3 * 17 + 1] = std::numeric_limits<double>::quiet_NaN();
  try {
    (void)t.moved(PointsView(bad, 3));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), std::vector<std::size_t>{17});
  }
  bad[3 * 17 + 1] = 1.5;
  EXPECT_EQ(test::code_of([&] { (void)t.moved(PointsView(bad, 3)); }), Errc::invalid_argument);
  bad.resize(897);
  EXPECT_EQ(test::code_of([&] { (void)t.moved(PointsView(bad, 3)); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { (void)t.moved(PointsView(points, 3), test::of_rank(box, 2)); }),
            Errc::bad_dimension);
  const PeriodicRegular<3> power(PointsView(points, 3), std::vector<double>(300), box);
  EXPECT_EQ(test::code_of([&] { (void)power.moved(PointsView(points, 3), std::vector<double>(299)); }),
            Errc::bad_dimension);
  std::mt19937_64 random(1);
  const std::vector<double> many = test::random_fractions(60000, 1), next = stirred(many, 1e-6, random);
  const PeriodicDelaunay<> large(PointsView(many, 3), box);
  for (const int report : {1, 3}) {
    const ProgressScope scope(test::stops_at(report));
    EXPECT_EQ(test::code_of([&] { (void)large.moved(PointsView(next, 3)); }), Errc::cancelled);
  }
  EXPECT_EQ(t.hash(), hash);
  expect_same_arrays(large.moved(PointsView(next, 3)), PeriodicDelaunay<>(PointsView(next, 3), box));
}

}  // namespace
}  // namespace delone
