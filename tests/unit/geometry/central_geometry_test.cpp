// SPDX-License-Identifier: BSD-3-Clause
// Cells of hulls and of cones of halfspaces: what the filter says is the exact side of the points or rows,
// ties of lattices are proved, images of dual points are as exact as promised, and nothing is certain without
// an inner point.
#include "geometry/central_geometry.hpp"

#include "base/random.hpp"
#include "geometry/solve.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace delone::geometry {

namespace {

/// Points of R^3, seen from a centre.
struct Hull {
  Hull(const std::vector<double>& x, const std::vector<double>& from, bool is_inside,
       std::vector<Index> inner)
      : sites(3), view(kernel::Grid(3)), memory(2) {
    sites.coordinates = x;
    sites.axes = {0, 1, 2};
    view.center = view.low = view.high = from;
    view.is_inside = is_inside;
    view.grid.include(from.data());
    for (Index site = 0; site < sites.size(); ++site) {
      view.grid.include(sites.point(site));
      for (std::size_t j = 0; j < 3; ++j) {
        view.low[j] = std::min(view.low[j], sites.point(site)[j]);
        view.high[j] = std::max(view.high[j], sites.point(site)[j]);
      }
    }
    memory.reserve(1);
    geometry.emplace(memory, sites, view, std::move(inner));
    geometry->update_box();
  }
  Index size() const { return static_cast<Index>(sites.size()); }
  /// Makes cell 0.
  void create(const Index* vertices) {
    for (int i = 0; i < 3; ++i) memory.layout().set_vertex(memory.links(0), i, vertices[i]);
    geometry->create(0, vertices, -1, 0);
  }

  BoundarySites sites;
  CentralView view;
  CellMemory<2> memory;
  std::optional<CentralGeometry<2>> geometry;
};

std::vector<double> corners_of_a_cube_and_points(random::Generator& generator, bool on_lattice) {
  std::vector<double> x;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 3; ++j) x.push_back((i >> j & 1) * 4.0);
  for (int i = 0; i < 60 * 3; ++i)
    x.push_back(on_lattice ? static_cast<double>(generator.below(5)) : 4 * generator.uniform());
  return x;
}

TEST(CentralGeometry, TheFilterSaysTheExactSideOfPoints) {
  random::Generator generator(1);
  StageCounts counts;
  for (const bool on_lattice : {false, true}) {
    Hull hull(corners_of_a_cube_and_points(generator, on_lattice), {1.75, 2.25, 2.125}, true, {1, 2, 3, 5});
    std::size_t certain = 0, tested = 0, ties = 0;
    for (int round = 0; round < 300; ++round) {
      Index cell[3];
      for (Index& v : cell) v = 1 + static_cast<Index>(generator.below(hull.size()));
      const Sign inner = hull.geometry->side(cell, hull.view.center.data(), counts);
      if (inner == Sign::zero) continue;
      if (inner == Sign::negative) std::swap(cell[0], cell[1]);
      hull.create(cell);
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

TEST(CentralGeometry, CellsOfAWallHaveItsExactFunctional) {
  random::Generator generator(3);
  StageCounts counts;
  for (const double size : {1.0, 0x1p-300, 1e30}) {
    for (const int axis : {0, 1, 2}) {
      std::vector<double> x = corners_of_a_cube_and_points(generator, false);
      for (std::size_t i = 8; i < 30; ++i) x[3 * i + static_cast<std::size_t>(axis)] = axis == 1 ? 4 : 0;
      for (double& coordinate : x) coordinate *= size;
      Hull hull(x, {1.75 * size, 2.25 * size, 2.125 * size}, true, {1, 2, 3, 5});
      const auto is_on_wall = [&](Index v) {
        return hull.geometry->point(v)[axis] == (axis == 1 ? 4 * size : 0);
      };
      for (int round = 0; round < 30; ++round) {
        Index cell[3];
        for (Index& v : cell) v = 9 + static_cast<Index>(generator.below(22));
        const Sign inner = hull.geometry->side(cell, hull.view.center.data(), counts);
        if (inner == Sign::zero) continue;
        if (inner == Sign::negative) std::swap(cell[0], cell[1]);
        hull.create(cell);
        for (Index v = 1; v <= hull.size(); ++v) {
          if (std::find(cell, cell + 3, v) != cell + 3) continue;
          const auto q = hull.geometry->query_at(v);
          const auto evaluator = hull.geometry->evaluator(q);
          const double value = evaluator.value(0), threshold = evaluator.threshold(0);
          EXPECT_LT(threshold, 0x1p-48);
          EXPECT_EQ(hull.geometry->proves_tie(0, value, q), is_on_wall(v));
          EXPECT_EQ(hull.geometry->side(cell, q.point, counts), is_on_wall(v) ? Sign::zero : Sign::positive);
          EXPECT_EQ(std::fabs(value) > threshold, !is_on_wall(v));
          if (!is_on_wall(v)) continue;
          kernel::Buffer<const double*, 3> rows(3);
          for (std::size_t i = 0; i < 3; ++i) rows[i] = hull.geometry->point(cell[i]);
          EXPECT_EQ(hull.geometry->perturbed_side(cell, q, counts),
                    kernel::perturbed_hull_side<3>(hull.sites.flat(), rows.data(), q.point,
                                                   hull.view.center.data(), hull.view.grid));
          for (int slot = 0; slot < 3; ++slot) {
            auto moved = rows;
            moved[static_cast<std::size_t>(slot)] = q.point;
            EXPECT_EQ(hull.geometry->side_of_facet(cell, slot, q),
                      kernel::hull_side<3>(hull.sites.flat(), moved.data(), hull.view.center.data(),
                                           hull.view.grid, counts));
          }
        }
      }
    }
  }
}

TEST(CentralGeometry, WithoutAnInnerPointNothingIsCertainAndTiesAreBrokenFromAVertex) {
  random::Generator generator(2);
  StageCounts counts;
  Hull hull(corners_of_a_cube_and_points(generator, true), {0, 0, 0}, false, {1, 2, 3, 5});
  Index cell[] = {5, 6, 7};  // the upper face of the cube
  if (hull.geometry->side(cell, hull.geometry->point(1), counts) == Sign::negative)
    std::swap(cell[0], cell[1]);
  hull.create(cell);
  const auto q = hull.geometry->make_query(hull.geometry->point(8));
  EXPECT_FALSE(std::fabs(hull.geometry->evaluator(q).value(0)) > hull.geometry->evaluator(q).threshold(0));
  EXPECT_EQ(hull.geometry->exact_side(cell, -1, q, counts), Sign::zero);
  const Sign broken = hull.geometry->perturbed_side(cell, q, counts);
  EXPECT_NE(broken, Sign::zero);
  // As from a point that is inside.
  Hull seen(hull.sites.coordinates, {2, 2, 2}, true, {1, 2, 3, 5});
  EXPECT_EQ(seen.geometry->perturbed_side(cell, seen.geometry->make_query(seen.geometry->point(8)), counts),
            broken);
}

/// n/s in pairs: rounded, then what the rounding left over.
std::vector<double> dual(const std::vector<double>& row) {
  const double s = -row.back();
  std::vector<double> high, low;
  for (std::size_t j = 0; j + 1 < row.size(); ++j) {
    high.push_back(row[j] / s);
    low.push_back(std::fma(-high.back(), s, row[j]) / s);
  }
  high.insert(high.end(), low.begin(), low.end());
  return high;
}

/// Halfspaces of R^2 around the origin: the row at infinity, and random or tied ones.
struct Cone {
  Cone(bool tied, random::Generator& generator)
      : sites(3, kernel::RowForm::homogeneous), view(sites.grid), memory(1) {
    sites.axes = {0, 1, 2};
    const auto append = [&](const std::vector<double>& row) {
      sites.coordinates.insert(sites.coordinates.end(), row.begin(), row.end());
      const std::vector<double> y = dual(row);
      sites.duals.insert(sites.duals.end(), y.begin(), y.end());
      for (std::size_t j = 0; j < 2; ++j) {
        view.low.resize(2, 0.0);
        view.high.resize(2, 0.0);
        view.low[j] = std::min(view.low[j], y[j]);
        view.high[j] = std::max(view.high[j], y[j]);
      }
    };
    append({0, 0, -1});
    append({3, 1, -1});
    append({-2, 3, -1});
    append({-1, -4, -1});
    for (int i = 0; i < 60; ++i) {
      const auto entry = [&](double from, double to) {
        const double x = from + (to - from) * generator.uniform();
        return tied ? std::round(x) : x;
      };
      append({entry(-4, 4), entry(-4, 4), entry(-4, -1)});
    }
    view.center = {1, 1, -5};
    view.dual_of_center = dual(view.center);
    view.is_inside = true;
    memory.reserve(1);
    geometry.emplace(memory, sites, view, std::vector<Index>{1, 2, 3});
    geometry->update_box();
  }
  BoundarySites sites;
  CentralView view;
  CellMemory<1> memory;
  std::optional<CentralGeometry<1>> geometry;
};

TEST(CentralGeometry, TheFilterSaysTheExactSideOfRows) {
  random::Generator generator(1);
  StageCounts counts;
  for (const bool tied : {false, true}) {
    Cone cone(tied, generator);
    const auto n = static_cast<Index>(cone.sites.size());
    std::size_t certain = 0, tested = 0;
    for (int round = 0; round < 300; ++round) {
      Index cell[2];
      for (Index& v : cell) v = 1 + static_cast<Index>(generator.below(n));
      const Sign inner = cone.geometry->side(cell, cone.view.center.data(), counts);
      if (inner == Sign::zero) continue;
      if (inner == Sign::negative) std::swap(cell[0], cell[1]);
      cone.geometry->create(0, cell, -1, 0);
      for (Index v = 1; v <= n; ++v) {
        const auto q = cone.geometry->query_at(v);
        if (cone.geometry->is_at(cell[0], q) || cone.geometry->is_at(cell[1], q)) continue;
        const Sign exact = cone.geometry->exact_side(cell, -1, q, counts);
        const double value = cone.geometry->evaluator(q).value(0);
        ++tested;
        if (std::fabs(value) > cone.geometry->evaluator(q).threshold(0)) {
          ASSERT_EQ(value > 0 ? Sign::positive : Sign::negative, exact);
          ++certain;
        } else if (exact == Sign::zero) {
          ++certain;  // left open, as it must be
          EXPECT_NE(cone.geometry->perturbed_side(cell, q, counts), Sign::zero);
        }
      }
      for (int slot = 0; slot < 2;
           ++slot)  // its own row is on the side of the cell, the other is on the wall
        for (int other = 0; other < 2; ++other) {
          const auto q = cone.geometry->query_at(cell[other]);
          EXPECT_EQ(cone.geometry->side_of_facet(cell, slot, q), other == slot ? Sign::positive : Sign::zero);
        }
    }
    EXPECT_GT(certain, tested * 95 / 100);
  }
}

TEST(CentralGeometry, ImagesOfDualPointsAreOffByLessThanOneRounding) {
  using Rational = boost::multiprecision::cpp_rational;
  random::Generator generator(2);
  Cone cone(false, generator);
  const auto n = static_cast<Index>(cone.sites.size());
  const auto true_dual = [](const double* row, std::size_t j) {
    return Rational(row[j]) / -Rational(row[2]);
  };
  for (std::size_t j = 0; j < 2; ++j) {
    const double center = cone.view.dual_of_center[j];
    const double half = std::max(cone.view.high[j] - center, center - cone.view.low[j]);
    const Rational scale(std::ldexp(1.0, -std::ilogb(half) - 2));
    for (Index v = 1; v <= n; ++v) {
      const double image = cone.geometry->query_at(v).row.data()[j];
      EXPECT_LE(std::fabs(image), 0.5 + 1e-15);
      const Rational exact =
          (true_dual(cone.sites.point(v - 1), j) - true_dual(cone.view.center.data(), j)) * scale;
      EXPECT_LE(abs(Rational(image) - exact), Rational(0.52 * 0x1p-53));
    }
  }
}

}  // namespace
}  // namespace delone::geometry
