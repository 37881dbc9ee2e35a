// SPDX-License-Identifier: BSD-3-Clause
// Cells of hulls: what the filter says is the exact side, ties of lattices are proved, and nothing is certain
// without an inner point.
#include "geometry/hull_geometry.hpp"

#include "base/random.hpp"
#include "geometry/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::geometry {
namespace {

/// Points of R^3, seen from a centre.
struct Hull {
  Hull(std::vector<double> x, std::vector<double> from, bool is_inside, std::vector<Index> inner)
      : coordinates(std::move(x)), center(std::move(from)), grid(3), memory(2) {
    std::vector<double> low = center, high = center;
    for (std::size_t i = 0; i < coordinates.size(); i += 3) {
      grid.include(&coordinates[i]);
      for (std::size_t j = 0; j < 3; ++j) {
        low[j] = std::min(low[j], coordinates[i + j]);
        high[j] = std::max(high[j], coordinates[i + j]);
      }
    }
    grid.include(center.data());
    memory.reserve(1);
    geometry.emplace(memory, std::vector<int>{0, 1, 2}, 3, coordinates, grid, center, is_inside, inner);
    geometry->set_box(low.data(), high.data());
  }
  Index size() const { return static_cast<Index>(coordinates.size() / 3); }

  std::vector<double> coordinates, center;
  kernel::Grid grid;
  CellMemory<2> memory;
  std::optional<HullGeometry<2>> geometry;
};

std::vector<double> corners_of_a_cube_and_points(random::Generator& generator, bool on_lattice) {
  std::vector<double> x;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 3; ++j) x.push_back((i >> j & 1) * 4.0);
  for (int i = 0; i < 60 * 3; ++i)
    x.push_back(on_lattice ? static_cast<double>(generator.below(5)) : 4 * generator.uniform());
  return x;
}

TEST(HullGeometry, TheFilterSaysTheExactSide) {
  random::Generator generator(1);
  StageCounts counts;
  for (const bool on_lattice : {false, true}) {
    Hull hull(corners_of_a_cube_and_points(generator, on_lattice), {1.75, 2.25, 2.125}, true, {1, 2, 3, 5});
    std::size_t certain = 0, tested = 0, ties = 0;
    for (int round = 0; round < 300; ++round) {
      Index cell[3];
      for (Index& v : cell) v = 1 + static_cast<Index>(generator.below(hull.size()));
      const Sign inner = hull.geometry->side(cell, hull.center.data(), counts);
      if (inner == Sign::zero) continue;
      if (inner == Sign::negative) std::swap(cell[0], cell[1]);
      hull.geometry->create(0, cell, -1, 0);
      for (Index v = 1; v <= hull.size(); ++v) {
        const auto q = hull.geometry->make_query(hull.geometry->point(v));
        if (hull.geometry->is_at(cell[0], q) || hull.geometry->is_at(cell[1], q) ||
            hull.geometry->is_at(cell[2], q))
          continue;
        const auto evaluator = hull.geometry->evaluator(q);
        const double value = evaluator.value(0), threshold = evaluator.threshold(0);
        const Sign exact = hull.geometry->exact_side(cell, -1, q, counts);
        ++tested;
        if (std::fabs(value) > threshold) {
          ASSERT_EQ(value > 0 ? Sign::positive : Sign::negative, exact);
        } else if (hull.geometry->proves_tie(0, value, q)) {
          ASSERT_EQ(exact, Sign::zero);
          ++ties;
        } else {
          continue;
        }
        ++certain;
        if (exact == Sign::zero) {
          EXPECT_NE(hull.geometry->perturbed_side(cell, q, counts), Sign::zero);
        }
      }
      for (int slot = 0; slot < 3; ++slot)
        EXPECT_EQ(hull.geometry->side_of_facet(cell, slot,
                                               hull.geometry->make_query(hull.geometry->point(cell[slot]))),
                  Sign::positive);
    }
    EXPECT_GT(certain, tested * 95 / 100);
    EXPECT_EQ(ties > 0, on_lattice);
  }
}

TEST(HullGeometry, WithoutAnInnerPointNothingIsCertainAndTiesAreBrokenFromAVertex) {
  random::Generator generator(2);
  StageCounts counts;
  Hull hull(corners_of_a_cube_and_points(generator, true), {0, 0, 0}, false, {1, 2, 3, 5});
  Index cell[] = {5, 6, 7};  // the upper face of the cube
  if (hull.geometry->side(cell, hull.geometry->point(1), counts) == Sign::negative)
    std::swap(cell[0], cell[1]);
  hull.geometry->create(0, cell, -1, 0);
  const auto q = hull.geometry->make_query(hull.geometry->point(8));
  EXPECT_FALSE(std::fabs(hull.geometry->evaluator(q).value(0)) > hull.geometry->evaluator(q).threshold(0));
  EXPECT_EQ(hull.geometry->exact_side(cell, -1, q, counts), Sign::zero);
  const Sign broken = hull.geometry->perturbed_side(cell, q, counts);
  EXPECT_NE(broken, Sign::zero);
  // As from a point that is inside.
  Hull seen(hull.coordinates, {2, 2, 2}, true, {1, 2, 3, 5});
  EXPECT_EQ(seen.geometry->perturbed_side(cell, seen.geometry->make_query(seen.geometry->point(8)), counts),
            broken);
}

}  // namespace
}  // namespace delone::geometry
