// SPDX-License-Identifier: BSD-3-Clause
// Diagrams with a tolerance: lattices in rounded coordinates have the ridges of crystallography, and what is
// promised holds in rationals.
#include "voronoi/diagram_simplifier.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/error.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>

namespace delone::voronoi {
namespace {

using Rational = boost::multiprecision::cpp_rational;

struct Lattice {
  const char* name;
  std::vector<std::vector<double>> cell, basis;  // vectors of the cell; positions in these
  std::size_t ridges;                            // of an interior site
};

std::vector<Lattice> lattices() {
  const auto cubic = [](double a) {
    return std::vector<std::vector<double>>{{a, 0, 0}, {0, a, 0}, {0, 0, a}};
  };
  const std::vector<std::vector<double>> fcc{{0, 0, 0}, {0, .5, .5}, {.5, 0, .5}, {.5, .5, 0}};
  auto diamond = fcc;
  for (const auto& p : fcc) diamond.push_back({p[0] + .25, p[1] + .25, p[2] + .25});
  const std::vector<std::vector<double>> bcc{{0, 0, 0}, {.5, .5, .5}};
  const double h = std::sqrt(3.0) / 2;
  return {{"diamond", cubic(3.57), diamond, 16},
          {"fcc", cubic(3.6), fcc, 12},
          {"bcc", cubic(2.87), bcc, 14},
          {"simple cubic", cubic(2.87), {{0, 0, 0}}, 6},
          {"hcp", {{3.2, 0, 0}, {-1.6, 3.2 * h, 0}, {0, 0, 5.2}}, {{0, 0, 0}, {1 / 3., 2 / 3., .5}}, 12},
          {"hexagonal", {{3.2, 0}, {-1.6, 3.2 * h}}, {{0, 0}}, 6}};
}

/// Sites of n cells in each direction, and whether each is interior: three cells or more from the border.
std::vector<double> sites(const Lattice& lattice, int n, std::vector<bool>& interior) {
  const std::size_t d = lattice.cell.size();
  std::vector<double> points;
  interior.clear();
  std::vector<int> at(d, 0);
  for (bool more = true; more;) {
    for (const auto& b : lattice.basis) {
      bool inside = true;
      std::vector<double> p(d, 0.0);
      for (std::size_t i = 0; i < d; ++i) {
        inside = inside && at[i] >= 2 && at[i] < n - 2;
        for (std::size_t j = 0; j < d; ++j) p[j] += (at[i] + b[i]) * lattice.cell[i][j];
      }
      points.insert(points.end(), p.begin(), p.end());
      interior.push_back(inside);
    }
    std::size_t i = 0;
    while (i < d && ++at[i] == n) at[i++] = 0;
    more = i < d;
  }
  return points;
}

void rotate(std::vector<double>& points, std::size_t d, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(0, 6.283185307179586);
  for (std::size_t a = 0; a < d; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double t = angle(random), c = std::cos(t), s = std::sin(t);
      for (std::size_t i = 0; i < points.size(); i += d) {
        const double x = points[i + a], y = points[i + b];
        points[i + a] = c * x - s * y;
        points[i + b] = s * x + c * y;
      }
    }
}

std::vector<std::size_t> ridges_of_rows(const Diagram& diagram) {
  std::vector<std::size_t> count(diagram.num_points(), 0);
  for (const SignedIndex row : diagram.ridge_points()) ++count[static_cast<std::size_t>(row)];
  return count;
}

TEST(DiagramSimplifier, LatticesHaveTheRidgesOfCrystallography) {
  std::mt19937_64 random(7);
  for (const Lattice& lattice : lattices())
    for (std::size_t rotation = 0; rotation <= test::scaled_size(30, 1); ++rotation) {
      std::vector<bool> interior;
      const auto d = static_cast<int>(lattice.cell.size());
      std::vector<double> points = sites(lattice, d == 2 ? 9 : 5, interior);
      if (rotation > 0) rotate(points, lattice.cell.size(), random);
      const Delaunay<> triangulation(points, d);
      for (const double tolerance : {1e-10, 5e-13}) {
        const Voronoi diagram(triangulation, {.tolerance = tolerance});
        EXPECT_LE(diagram.max_displacement(), tolerance);
        const auto count = ridges_of_rows(diagram);
        for (std::size_t i = 0; i < interior.size(); ++i)
          if (interior[i]) {
            EXPECT_EQ(count[i], lattice.ridges) << lattice.name << ", " << rotation << ", " << tolerance;
          }
      }
    }
}

// In a rotated cubic lattice slivers of faces have centres between those of cubes; all of them go.
TEST(DiagramSimplifier, InteriorRegionsOfACubicLatticeAreCubes) {
  std::mt19937_64 random(5);
  std::vector<bool> interior;
  std::vector<double> points = sites(lattices()[3], 6, interior);
  rotate(points, 3, random);
  const Delaunay<3> triangulation(points);
  EXPECT_GT(Voronoi(triangulation).num_vertices(), 200u);
  const Voronoi diagram(triangulation, {.tolerance = 1e-10});
  for (std::size_t i = 0; i < interior.size(); ++i)
    if (interior[i]) {
      EXPECT_EQ(diagram.region(static_cast<std::size_t>(diagram.point_region()[i])).size(), 8u);
    }
  for (std::size_t i = 0; i < diagram.num_ridges(); ++i)
    if (interior[static_cast<std::size_t>(diagram.ridge_points()[2 * i])]) {
      EXPECT_EQ(diagram.ridge(i).size(), 4u);
    }
  EXPECT_GT(diagram.max_displacement(), 0);
}

/// A description that does not depend on numbers: ridges by the coordinates of their sites and vertices.
using Coordinates = std::vector<double>;
using Description = std::multiset<std::pair<std::set<Coordinates>, std::multiset<Coordinates>>>;
Description described(const Diagram& diagram) {
  Description result;
  for (std::size_t i = 0; i < diagram.num_ridges(); ++i) {
    std::set<Coordinates> of_sites;
    std::multiset<Coordinates> of_vertices;
    for (const std::size_t side : {2 * i, 2 * i + 1}) {
      const auto site = diagram.site(static_cast<std::size_t>(
          diagram.point_region()[static_cast<std::size_t>(diagram.ridge_points()[side])]));
      of_sites.emplace(site.begin(), site.end());
    }
    for (const SignedIndex v : diagram.ridge(i))
      if (v >= 0) {
        const auto x = diagram.vertex(static_cast<std::size_t>(v));
        of_vertices.emplace(x.begin(), x.end());
      }
    result.emplace(of_sites, of_vertices);
  }
  return result;
}

TEST(DiagramSimplifier, TheOrderOfRowsDoesNotMatter) {
  std::mt19937_64 random(11);
  for (std::size_t d = 1; d <= 4; ++d)
    for (std::size_t trial = 0; trial < test::scaled_size(6, 2); ++trial) {
      std::vector<std::vector<double>> rows(d < 4 ? 60 : 25, std::vector<double>(d));
      std::uniform_real_distribution<double> uniform(0, 1);
      for (auto& row : rows)
        for (double& x : row)
          x = trial % 2 == 0 ? uniform(random) : std::floor(4 * uniform(random)) + 1e-9 * uniform(random);
      const double tolerance = trial % 2 == 0 ? 0.03 : 1e-8;
      std::optional<Description> first;
      std::optional<double> displacement;
      for (int shuffle = 0; shuffle < 4; ++shuffle) {
        std::vector<double> points;
        for (const auto& row : rows) points.insert(points.end(), row.begin(), row.end());
        const Delaunay<> triangulation(points, static_cast<int>(d));
        const Voronoi diagram(triangulation, {.tolerance = tolerance});
        EXPECT_TRUE(check(diagram.to_data()).ok) << d << ", " << trial;
        if (!first) {
          first = described(diagram);
          displacement = diagram.max_displacement();
          EXPECT_GT(*displacement, 0) << d;
        }
        EXPECT_EQ(described(diagram), *first) << d;
        EXPECT_EQ(diagram.max_displacement(), *displacement);
        std::shuffle(rows.begin(), rows.end(), random);
      }
    }
}

/// The exact centre of the sphere of a cell in the plane.
std::array<Rational, 2> center(const Triangulation& t, CellId c) {
  std::array<std::array<Rational, 2>, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto x = t.point(t.complex().vertex(c, static_cast<int>(i)));
    p[i] = {Rational(x[0]), Rational(x[1])};
  }
  const Rational ax = p[1][0] - p[0][0], ay = p[1][1] - p[0][1], bx = p[2][0] - p[0][0],
                 by = p[2][1] - p[0][1];
  const Rational a = ax * ax + ay * ay, b = bx * bx + by * by, twice = 2 * (ax * by - ay * bx);
  return {p[0][0] + (by * a - ay * b) / twice, p[0][1] + (ax * b - bx * a) / twice};
}

Rational squared(const std::array<Rational, 2>& p, const std::array<Rational, 2>& q) {
  return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
}

// Every exact vertex is within the displacement of a vertex, exactly, and a ridge is there if and only if
// neither it nor what it became is short.
TEST(DiagramSimplifier, InThePlaneExactly) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t merged = 0, lost = 0;
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<double> points(120);
    for (double& x : points)
      x = trial % 2 == 0 ? uniform(random) : std::floor(6 * uniform(random)) + 1e-12 * uniform(random);
    const double tolerance = trial % 2 == 0 ? std::pow(10.0, -1 - trial % 4) : 1e-11;
    const Delaunay<2> triangulation(points);
    const Voronoi exact(triangulation), diagram(triangulation, {.tolerance = tolerance});
    const Rational limit = Rational(tolerance) * Rational(tolerance),
                   reached = Rational(diagram.max_displacement()) * Rational(diagram.max_displacement());
    EXPECT_LE(reached, limit);
    for (const CellId c : triangulation.finite_cells()) {
      const auto z = center(triangulation, c);
      const double x = z[0].convert_to<double>(), y = z[1].convert_to<double>();
      if (std::hypot(x, y) > 1e3) continue;  // rounded by more than the tolerance
      std::size_t nearest = 0;
      const auto distance = [&](std::size_t v) {
        return std::hypot(diagram.vertex(v)[0] - x, diagram.vertex(v)[1] - y);
      };
      for (std::size_t v = 0; v < diagram.num_vertices(); ++v)
        if (distance(v) < distance(nearest)) nearest = v;
      const auto v = diagram.vertex(nearest);
      const Rational square = squared(z, {Rational(v[0]), Rational(v[1])});
      // A vertex that moves nowhere may have lost all its ridges.
      if (square > std::max(reached, Rational(1e-24))) {
        ++lost;
        EXPECT_LE(square, 9 * limit);
      }
    }
    merged += exact.num_vertices() - diagram.num_vertices();
    const auto length = [](const Diagram& of, std::size_t i) {
      const auto ends = of.ridge(i);
      const auto p = of.vertex(static_cast<std::size_t>(ends[0])),
                 q = of.vertex(static_cast<std::size_t>(ends[1]));
      return std::hypot(p[0] - q[0], p[1] - q[1]);
    };
    std::map<std::pair<SignedIndex, SignedIndex>, std::size_t> before;
    for (std::size_t i = 0; i < exact.num_ridges(); ++i)
      before[{exact.ridge_points()[2 * i], exact.ridge_points()[2 * i + 1]}] = i;
    for (std::size_t i = 0; i < diagram.num_ridges(); ++i) {
      const auto found = before.find({diagram.ridge_points()[2 * i], diagram.ridge_points()[2 * i + 1]});
      ASSERT_NE(found, before.end());
      const std::size_t was = found->second;
      before.erase(found);
      if (diagram.ridge(i)[0] < 0) continue;
      EXPECT_GT(length(diagram, i), tolerance * (1 - 1e-3));
      EXPECT_GT(length(exact, was), tolerance * (1 - 1e-3));
    }
    for (const auto& [rows, i] : before) {  // those that went: at most ε longer at each end than ε
      ASSERT_GE(exact.ridge(i)[0], 0);
      EXPECT_LE(length(exact, i), 3 * tolerance * (1 + 1e-12));
    }
  }
  EXPECT_GT(merged, 200u);
  EXPECT_LT(lost, 10u);
}

/// The exact centre of the sphere of a tetrahedron, by Cramer's rule.
std::array<Rational, 3> center_in_space(const Triangulation& t, CellId c) {
  std::array<std::array<Rational, 3>, 4> p;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      p[i][j] = Rational(t.point(t.complex().vertex(c, static_cast<int>(i)))[j]);
  std::array<std::array<Rational, 4>, 3> a;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i][3] = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      a[i][j] = 2 * (p[i + 1][j] - p[0][j]);
      a[i][3] += (p[i + 1][j] - p[0][j]) * (p[i + 1][j] - p[0][j]);
    }
  }
  const auto determinant = [&](std::size_t x, std::size_t y, std::size_t z) {
    return Rational(a[0][x] * (a[1][y] * a[2][z] - a[1][z] * a[2][y]) -
                    a[0][y] * (a[1][x] * a[2][z] - a[1][z] * a[2][x]) +
                    a[0][z] * (a[1][x] * a[2][y] - a[1][y] * a[2][x]));
  };
  const Rational all = determinant(0, 1, 2);
  return {p[0][0] + determinant(3, 1, 2) / all, p[0][1] + determinant(0, 3, 2) / all,
          p[0][2] + determinant(0, 1, 3) / all};
}

template <class Number>
Number squared_from_segment(const std::array<Number, 3>& x, const std::array<Number, 3>& p,
                            const std::array<Number, 3>& q) {
  Number along = 0, length = 0, square = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    along += (x[j] - p[j]) * (q[j] - p[j]);
    length += (q[j] - p[j]) * (q[j] - p[j]);
  }
  Number part = length == 0 ? Number(0) : Number(along / length);
  part = std::min(std::max(part, Number(0)), Number(1));
  for (std::size_t j = 0; j < 3; ++j) {
    const Number rest = x[j] - p[j] - part * (q[j] - p[j]);
    square += rest * rest;
  }
  return square;
}

// Every exact vertex is within the displacement of an edge, exactly.
TEST(DiagramSimplifier, InSpaceExactly) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t checked = 0, lost = 0;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<double> points(150);
    for (double& x : points)
      x = trial % 2 == 0 ? uniform(random) : std::floor(3 * uniform(random)) + 1e-12 * uniform(random);
    const double tolerance = trial % 2 == 0 ? 0.03 : 1e-10;
    const Delaunay<3> triangulation(points);
    const Voronoi diagram(triangulation, {.tolerance = tolerance});
    EXPECT_LE(diagram.max_displacement(), tolerance);
    const Rational reached = Rational(diagram.max_displacement()) * Rational(diagram.max_displacement());
    std::set<std::pair<SignedIndex, SignedIndex>> edges;
    for (std::size_t i = 0; i < diagram.num_ridges(); ++i) {
      const auto list = diagram.ridge(i);
      for (std::size_t a = 0; a < list.size(); ++a)
        edges.insert(std::minmax(list[a] < 0 ? list.back() : list[a],
                                 list[(a + 1) % list.size()] < 0 ? list[a] : list[(a + 1) % list.size()]));
    }
    for (const CellId c : triangulation.finite_cells()) {
      const auto z = center_in_space(triangulation, c);
      const std::array x{z[0].convert_to<double>(), z[1].convert_to<double>(), z[2].convert_to<double>()};
      if (std::hypot(x[0], x[1], x[2]) > 1e3) continue;  // rounded by more than the tolerance
      double least = std::numeric_limits<double>::infinity();
      std::pair<SignedIndex, SignedIndex> nearest;
      const auto ends_of = [&](const auto& edge, auto number) {
        std::array<std::array<decltype(number), 3>, 2> ends;
        for (std::size_t j = 0; j < 3; ++j) {
          ends[0][j] = diagram.vertex(static_cast<std::size_t>(edge.first))[j];
          ends[1][j] = diagram.vertex(static_cast<std::size_t>(edge.second))[j];
        }
        return ends;
      };
      for (const auto& edge : edges) {
        const auto ends = ends_of(edge, 0.0);
        const double square = squared_from_segment(x, ends[0], ends[1]);
        if (square < least) {
          least = square;
          nearest = edge;
        }
      }
      const auto ends = ends_of(nearest, Rational(0));
      const Rational square = squared_from_segment(z, ends[0], ends[1]);
      ++checked;
      if (square > std::max(reached, Rational(1e-24))) {  // a vertex that moves nowhere lost all its ridges
        ++lost;
        EXPECT_LE(square, 9 * Rational(tolerance) * Rational(tolerance));
      }
    }
  }
  EXPECT_GT(checked, 1000u);
  EXPECT_LT(lost, checked / 50);
}

TEST(DiagramSimplifier, VolumesAreThoseOfTheExactRegions) {
  std::mt19937_64 random(17);
  for (std::size_t d = 1; d <= 4; ++d) {
    std::vector<double> points(40 * d);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (double& x : points) x = uniform(random);
    const Delaunay<> triangulation(points, static_cast<int>(d));
    const Voronoi exact(triangulation), diagram(triangulation, {.tolerance = 0.05});
    EXPECT_EQ(diagram.region_volumes(), exact.region_volumes());
    const Box box = exact.bounding_box();
    const auto volumes = diagram.region_volumes(box);
    EXPECT_EQ(volumes, exact.region_volumes(box));
    EXPECT_EQ(diagram.ridge_volumes().size(), diagram.num_ridges());
    EXPECT_LE(diagram.num_ridges(), exact.num_ridges());
    if (d > 1) {
      EXPECT_LT(diagram.num_ridges(), exact.num_ridges());
    }
  }
}

// Regions and ridges agree: the vertices of a region are those of its ridges.
TEST(DiagramSimplifier, ListsAgree) {
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t d = 2; d <= 4; ++d)
    for (const double tolerance : {0.01, 0.1, 0.5}) {
      std::vector<double> points(50 * d);
      for (double& x : points) x = uniform(random);
      const Delaunay<> triangulation(points, static_cast<int>(d));
      const Voronoi diagram(triangulation, {.tolerance = tolerance});
      std::vector<std::set<SignedIndex>> of_ridges(diagram.num_regions());
      std::set<SignedIndex> used;
      for (std::size_t i = 0; i < diagram.num_ridges(); ++i)
        for (const std::size_t side : {2 * i, 2 * i + 1})
          for (const SignedIndex v : diagram.ridge(i)) {
            of_ridges[static_cast<std::size_t>(
                          diagram.point_region()[static_cast<std::size_t>(diagram.ridge_points()[side])])]
                .insert(v);
            if (v >= 0) used.insert(v);
          }
      EXPECT_EQ(used.size(), diagram.num_vertices());
      for (std::size_t r = 0; r < diagram.num_regions(); ++r) {
        const auto list = diagram.region(r);
        const std::set<SignedIndex> of_region(list.begin(), list.end());
        EXPECT_EQ(of_region.size(), list.size()) << "each vertex once";
        if (d > 2) {
          EXPECT_EQ(of_region, of_ridges[r]);
        } else
          EXPECT_TRUE(
              std::includes(of_region.begin(), of_region.end(), of_ridges[r].begin(), of_ridges[r].end()));
        EXPECT_EQ(!list.empty() && list[0] < 0, !diagram.is_bounded(r));
      }
      for (const SignedIndex v : diagram.ray_vertices())
        EXPECT_LT(static_cast<std::size_t>(v), diagram.num_vertices());
      EXPECT_TRUE(check(diagram.to_data()).ok) << d << ", " << tolerance;
    }
}

TEST(DiagramSimplifier, BorderOfALatticeInCoordinatesThatAgree) {
  // Hull facets of a cubic lattice along the axes are squares, exactly flat but not exactly cocircular: one
  // ray each.
  std::vector<bool> interior;
  const Lattice cubic = lattices()[3];
  const std::vector<double> points = sites(cubic, 4, interior);
  const Delaunay<3> triangulation(points);
  const Voronoi diagram(triangulation, {.tolerance = 1e-10});
  EXPECT_EQ(diagram.num_vertices(), 27u);
  EXPECT_EQ(diagram.num_rays(), 54u);
  EXPECT_EQ(diagram.num_ridges(), 3u * 3 * 4 * 4);
  EXPECT_TRUE(check(diagram.to_data()).ok);
}

TEST(DiagramSimplifier, WithoutRidges) {
  std::mt19937_64 random(23);
  std::vector<bool> interior;
  std::vector<double> points = sites(lattices()[3], 4, interior);
  rotate(points, 3, random);
  const Delaunay<3> triangulation(points);
  const Voronoi all(triangulation, {.tolerance = 1e-10}),
      regions(triangulation, {.parts = DiagramParts::regions, .tolerance = 1e-10});
  EXPECT_FALSE(regions.has_ridges());
  EXPECT_EQ(regions.num_ridges(), 0u);
  EXPECT_TRUE(std::equal(all.region_vertices().begin(), all.region_vertices().end(),
                         regions.region_vertices().begin(), regions.region_vertices().end()));
  EXPECT_THROW(regions.region_volumes(), Error);
}

TEST(DiagramSimplifier, NothingToSimplifyIsTheExactDiagram) {
  const Delaunay<2> triangulation(std::vector<std::array<double, 2>>{{0, 0}, {5, 0}, {0, 4}, {7, 9}});
  const Voronoi exact(triangulation), diagram(triangulation, {.tolerance = 1e-9});
  EXPECT_EQ(diagram.max_displacement(), 0);
  EXPECT_EQ(diagram.num_vertices(), exact.num_vertices());
  EXPECT_EQ(diagram.to_data().ridge_vertices, exact.to_data().ridge_vertices);
  EXPECT_EQ(Voronoi(Delaunay<2>(), {.tolerance = 1}).num_regions(), 0u);
  EXPECT_EQ(Voronoi(Delaunay<2>(std::vector<std::array<double, 2>>{{3, 3}}), {.tolerance = 1}).num_regions(),
            1u);
}

TEST(DiagramSimplifier, ToleranceOutOfRange) {
  const Delaunay<2> triangulation(std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {0, 2}});
  for (const double tolerance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 2.1})
    EXPECT_THROW(Voronoi(triangulation, {.tolerance = tolerance}), Error) << tolerance;
  EXPECT_NO_THROW(Voronoi(triangulation, {.tolerance = 2}));
}

TEST(DiagramSimplifier, VerticesFarAwayAndExtremeScales) {
  for (const double scale : {1e-300, 1.0, 1e150, 1e300}) {
    std::vector<double> points;
    for (int x = 0; x < 6; ++x)
      for (int y = 0; y < 6; ++y) {  // turned, with slivers along the border
        points.push_back(scale * (x * std::cos(0.55) - y * std::sin(0.55)));
        points.push_back(scale * (x * std::sin(0.55) + y * std::cos(0.55)));
      }
    const Delaunay<2> triangulation(points);
    const Voronoi diagram(triangulation, {.tolerance = 1e-12 * scale});
    const auto count = ridges_of_rows(diagram);
    for (std::size_t x = 1; x < 5; ++x)
      for (std::size_t y = 1; y < 5; ++y) EXPECT_EQ(count[6 * x + y], 4u) << scale;
    EXPECT_TRUE(check(diagram.to_data()).ok) << scale;
  }
}

TEST(DiagramSimplifier, PowerDiagrams) {
  std::vector<bool> interior;
  std::mt19937_64 random(29);
  std::vector<double> points = sites(lattices()[3], 5, interior);
  rotate(points, 3, random);
  const std::vector<double> weights(points.size() / 3, 0.7);
  const Regular<3> triangulation(points, weights);
  const PowerDiagram diagram(triangulation, {.tolerance = 1e-10});
  const auto count = ridges_of_rows(diagram);
  for (std::size_t i = 0; i < interior.size(); ++i)
    if (interior[i]) {
      EXPECT_EQ(count[i], 6u);
    }
  EXPECT_TRUE(check(diagram.to_data()).ok);
}

}  // namespace
}  // namespace delone::voronoi
