// SPDX-License-Identifier: BSD-3-Clause
// Alpha values against their definition over all sets of points, in rationals; the complex at radii that are
// exactly those of cells, and one unit in the last place beside them; its boundary.
#include <delone/alpha.hpp>

#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/predicates.hpp>
#include <delone/regular.hpp>

#include "error_code.hpp"
#include "orthosphere_brute_force.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace delone {
namespace {

using test::Rational;
using test::WeightedPoints;
using Rows = std::vector<SignedIndex>;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> coordinates_of(const WeightedPoints& points) {
  std::vector<double> coordinates;
  for (const auto& p : points) coordinates.insert(coordinates.end(), p.begin(), p.end() - 1);
  return coordinates;
}

Rows sorted(std::span<const SignedIndex> rows) {
  Rows result(rows.begin(), rows.end());
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::size_t> as_key(const Rows& rows) { return {rows.begin(), rows.end()}; }

std::set<Rows> set_of(const Faces& faces) {
  std::set<Rows> result;
  for (std::size_t i = 0; i < faces.size(); ++i) EXPECT_TRUE(result.insert(sorted(faces.face(i))).second);
  return result;
}

/// Cells, boundary and faces of a complex, if its faces are those with a true `is_in`.
template <class IsIn>
void expect_complex(const Triangulation& t, const AlphaComplex& complex, const std::vector<FaceValues>& all,
                    const IsIn& is_in) {
  const int k = t.affine_dimension();
  std::set<Rows> facets_of_cells, twice, facets;
  for (int j = 0; j <= k; ++j) {
    std::set<Rows> expected;
    for (const Rows& face : set_of(all[static_cast<std::size_t>(j)].faces))
      if (is_in(face)) expected.insert(face);
    EXPECT_EQ(set_of(complex.faces(j)), expected) << "dimension " << j;
    if (j == k - 1) facets = expected;
    if (j < k) continue;
    std::set<Rows> cells;
    const ComplexData data = t.to_data(), part = complex.to_data();
    const std::size_t width = static_cast<std::size_t>(k) + 1;
    for (const SignedIndex c : complex.cell_numbers())
      cells.insert(sorted(std::span(data.cells).subspan(static_cast<std::size_t>(c) * width, width)));
    EXPECT_EQ(cells, expected);
    EXPECT_EQ(part.num_cells(), expected.size());
    for (Rows cell : expected)
      for (std::size_t i = 0; i < width && k > 0; ++i) {
        Rows facet = cell;
        facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
        if (!facets_of_cells.insert(facet).second) twice.insert(facet);
      }
  }
  if (k < 1) return;
  std::set<Rows> boundary, singular, expected_boundary, expected_singular;
  const auto width = static_cast<std::size_t>(k);
  for (std::size_t i = 0; i < complex.boundary_cells().size(); ++i)
    boundary.insert(sorted(complex.boundary().subspan(i * width, width)));
  for (std::size_t i = 0; i * width < complex.singular_facets().size(); ++i)
    singular.insert(sorted(complex.singular_facets().subspan(i * width, width)));
  std::set_difference(facets_of_cells.begin(), facets_of_cells.end(), twice.begin(), twice.end(),
                      std::inserter(expected_boundary, expected_boundary.end()));
  std::set_difference(facets.begin(), facets.end(), facets_of_cells.begin(), facets_of_cells.end(),
                      std::inserter(expected_singular, expected_singular.end()));
  EXPECT_EQ(boundary, expected_boundary);
  EXPECT_EQ(singular, expected_singular);
  EXPECT_EQ(boundary.size(), complex.boundary_cells().size());
}

void expect_by_definition(const Triangulation& t, const WeightedPoints& points) {
  const int k = t.affine_dimension();
  const auto exact = test::alpha_values_by_definition(points, static_cast<std::size_t>(std::max(k, 0)));
  const std::vector<FaceValues> all = alpha_filtration(t);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(k + 1));
  std::set<double> squares;
  for (int j = 0; j <= k; ++j) {
    const FaceValues& level = all[static_cast<std::size_t>(j)];
    EXPECT_EQ(alpha_values(t, j).values, level.values);
    EXPECT_EQ(faces(t, j).size(), level.faces.size());
    EXPECT_EQ(set_of(faces(t, j)), set_of(level.faces));
    for (std::size_t i = 0; i < level.values.size(); ++i) {
      const auto found = exact.find(as_key(sorted(level.faces.face(i))));
      ASSERT_NE(found, exact.end());
      EXPECT_TRUE(test::is_rounded_up(level.values[i], found->second))
          << level.values[i] << " for " << found->second << ", dimension " << j;
      squares.insert(level.values[i]);
    }
  }
  std::size_t left = test::scaled_count(8);
  for (const double square : squares) {
    if (left-- == 0) break;
    for (const double bound : {square, std::nextafter(square, -infinity)})
      expect_complex(t, AlphaComplex::of_squared_radius(t, bound), all,
                     [&](const Rows& face) { return exact.at(as_key(face)) <= Rational(bound); });
    const double root = std::sqrt(std::max(square, 0.0));
    for (const double radius : {root, std::nextafter(root, 0.0)})
      if (std::isfinite(radius) && radius >= 0)
        expect_complex(t, AlphaComplex(t, radius), all, [&](const Rows& face) {
          return exact.at(as_key(face)) <= Rational(radius) * Rational(radius);
        });
  }
}

void expect_delaunay(const WeightedPoints& points) {
  expect_by_definition(Delaunay<>(coordinates_of(points), static_cast<int>(points[0].size()) - 1), points);
}
void expect_regular(const WeightedPoints& points) {
  std::vector<double> weights;
  for (const auto& p : points) weights.push_back(p.back());
  expect_by_definition(Regular<>(coordinates_of(points), weights, static_cast<int>(points[0].size()) - 1),
                       points);
}

/// Distinct points with coordinates 0 … most; weights from −w to w.
WeightedPoints lattice_points(std::size_t n, std::size_t d, unsigned most, unsigned w,
                              std::mt19937_64& random) {
  std::set<std::vector<double>> chosen;
  while (chosen.size() < n) {
    std::vector<double> p;
    for (std::size_t j = 0; j < d; ++j) p.push_back(static_cast<double>(random() % (most + 1)));
    chosen.insert(p);
  }
  WeightedPoints points(chosen.begin(), chosen.end());
  std::shuffle(points.begin(), points.end(), random);
  for (auto& p : points) p.push_back(w == 0 ? 0.0 : static_cast<double>(random() % (2 * w + 1)) - w);
  return points;
}

TEST(AlphaComplex, LatticesByDefinition) {
  std::mt19937_64 random(1);
  for (std::size_t round = 0; round < test::scaled_count(4); ++round) {
    expect_delaunay(lattice_points(8, 2, 2, 0, random));
    expect_delaunay(lattice_points(8, 3, 2, 0, random));
    expect_delaunay(lattice_points(7, 4, 1, 0, random));
    expect_regular(lattice_points(8, 2, 3, 4, random));
    expect_regular(lattice_points(8, 3, 2, 3, random));
    expect_delaunay(lattice_points(6, 1, 20, 0, random));
  }
}

TEST(AlphaComplex, RandomPointsByDefinition) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double scale : {1.0, 1e-150, 1e150})
    for (std::size_t d = 2; d <= (scale == 1 ? 4 : 2); ++d) {
      WeightedPoints points(scale == 1 ? 7 : 5, std::vector<double>(d + 1, 0.0));
      for (auto& p : points)
        for (std::size_t j = 0; j < d; ++j) p[j] = scale * uniform(random);
      expect_delaunay(points);
      for (auto& p : points) p[d] = scale * scale * (uniform(random) - 0.5) / 4;
      expect_regular(points);
    }
}

TEST(AlphaComplex, FlatAndFewPoints) {
  std::mt19937_64 random(3);
  WeightedPoints flat = lattice_points(8, 2, 2, 0, random);
  for (auto& p : flat) p = {p[0] + p[1], p[0] - p[1], 3 * p[0], 0};
  expect_delaunay(flat);
  for (auto& p : flat) p[3] = p[0] - 1;
  expect_regular(flat);
  expect_delaunay({{1, 2, 3, 0}});
  expect_regular({{1, 2, 3, -4}});
  expect_delaunay({{1, 2, 0}, {4, 6, 0}});
  const Delaunay<2> none;
  EXPECT_TRUE(alpha_filtration(none).empty());
  EXPECT_EQ(alpha_values(none, 1).values.size(), 0u);
  const AlphaComplex empty(none, 1);
  EXPECT_TRUE(empty.cell_numbers().empty() && empty.boundary().empty() && empty.singular_facets().empty());
  EXPECT_EQ(empty.faces(2).size(), 0u);
  EXPECT_EQ(empty.to_data().num_cells(), 0u);
  EXPECT_EQ(empty.boundary_data().num_cells(), 0u);
  const Delaunay<3> segment(std::vector<std::array<double, 3>>{{0, 0, 0}, {0, 0, 2}, {0, 0, 0}});
  EXPECT_EQ(AlphaComplex(segment, 1).cell_numbers().size(), 1u);
  EXPECT_EQ(AlphaComplex(segment, 1).faces(2).size(), 0u);
  EXPECT_EQ(AlphaComplex(segment, 0.9).faces(0).size(), 2u);
}

TEST(AlphaComplex, EqualRadiiComeTogether) {
  // All cells of a lattice have the squared radius 3/4, and their longest edges, too.
  std::vector<double> points;
  for (int i = 0; i < 4 * 4 * 4; ++i)
    points.insert(points.end(), {double(i % 4), double(i / 4 % 4), double(i / 16)});
  const Delaunay<> t(points, 3);
  EXPECT_EQ(AlphaComplex::of_squared_radius(t, 0.75).cell_numbers().size(), t.num_finite_cells());
  const AlphaComplex below = AlphaComplex::of_squared_radius(t, std::nextafter(0.75, 0));
  EXPECT_EQ(below.cell_numbers().size(), 0u);
  EXPECT_EQ(below.faces(0).size(), 64u);
  EXPECT_EQ(AlphaComplex(t, 0.5).faces(1).size(), 3u * 4 * 4 * 3);
  EXPECT_EQ(AlphaComplex(t, std::nextafter(0.5, 0)).faces(1).size(), 0u);
  // Two triangles of a rectangle of 3 by 4 times powers of two: the radius is 2.5 times these.
  for (const double scale : {1.0, 0x1p-500, 0x1p500}) {
    const Delaunay<> rectangle(std::vector<double>{0, 0, 3 * scale, 0, 3 * scale, 4 * scale, 0, 4 * scale},
                               2);
    EXPECT_EQ(AlphaComplex(rectangle, 2.5 * scale).cell_numbers().size(), 2u);
    EXPECT_EQ(AlphaComplex(rectangle, std::nextafter(2.5 * scale, 0)).cell_numbers().size(), 0u);
    EXPECT_EQ(AlphaComplex(rectangle, 2.5 * scale).boundary_cells().size(), 4u);
    EXPECT_EQ(AlphaComplex(rectangle, 2 * scale).singular_facets().size(), 8u);
  }
}

TEST(AlphaComplex, BoundaryIsOrientedAndThreadsDoNotMatter) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const int d : {2, 3, 4}) {
    std::vector<double> points;
    for (int i = 0; i < 150 * d; ++i) points.push_back(uniform(random));
    const Delaunay<> t(points, d);
    const double radius = d == 2 ? 0.06 : d == 3 ? 0.15 : 0.25;
    const AlphaComplex complex(t, radius);
    const ComplexData data = t.to_data();
    const auto width = static_cast<std::size_t>(d);
    ASSERT_GT(complex.boundary_cells().size(), 10u);
    for (std::size_t i = 0; i < complex.boundary_cells().size(); ++i) {
      const auto facet = complex.boundary().subspan(i * width, width);
      const auto cell = static_cast<std::size_t>(complex.boundary_cells()[i]) * (width + 1);
      std::vector<const double*> corners;
      for (std::size_t m = 0; m <= width; ++m)
        if (std::find(facet.begin(), facet.end(), data.cells[cell + m]) == facet.end())
          corners.push_back(points.data() + static_cast<std::size_t>(data.cells[cell + m]) * width);
      ASSERT_EQ(corners.size(), 1u);
      for (const SignedIndex row : facet)
        corners.push_back(points.data() + static_cast<std::size_t>(row) * width);
      std::vector<double> simplex;
      for (const double* p : corners) simplex.insert(simplex.end(), p, p + width);
      EXPECT_EQ(orientation(simplex, d), Sign::positive);
    }
    const AlphaComplex again(t, radius, {.threads = 3});
    EXPECT_TRUE(std::equal(again.boundary().begin(), again.boundary().end(), complex.boundary().begin(),
                           complex.boundary().end()));
    for (int j = 0; j <= d; ++j) {
      EXPECT_EQ(again.faces(j, {.threads = 3}).vertices, complex.faces(j).vertices);
      EXPECT_EQ(alpha_values(t, j, {.threads = 3}).values, alpha_values(t, j).values);
    }
    const ComplexData part = complex.to_data();
    for (std::size_t i = 0; i < part.neighbors.size(); ++i)
      EXPECT_LT(part.neighbors[i], SignedIndex(part.num_cells()));
    EXPECT_EQ(std::count(part.neighbors.begin(), part.neighbors.end(), -1),
              static_cast<std::ptrdiff_t>(complex.boundary_cells().size()));
  }
}

TEST(AlphaComplex, Errors) {
  const std::vector<std::array<double, 2>> points{{0, 0}, {1, 0}, {0, 1}, {1, 1.5}};
  const Delaunay<2> t(points);
  for (const double radius : {-1.0, -infinity, std::nan("")})
    EXPECT_EQ(test::code_of([&] { AlphaComplex(t, radius); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { AlphaComplex::of_squared_radius(t, std::nan("")); }), Errc::invalid_argument);
  EXPECT_EQ(AlphaComplex(t, infinity).cell_numbers().size(), t.num_finite_cells());
  EXPECT_EQ(AlphaComplex::of_squared_radius(t, -infinity).faces(0).size(), 0u);
  for (const int j : {-1, 3}) {
    EXPECT_EQ(test::code_of([&] { alpha_values(t, j); }), Errc::invalid_argument);
    EXPECT_EQ(test::code_of([&] { faces(t, j); }), Errc::invalid_argument);
    EXPECT_EQ(test::code_of([&] { AlphaComplex(t, 1).faces(j); }), Errc::invalid_argument);
  }
  const FurthestSite<2> furthest(points);
  EXPECT_EQ(test::code_of([&] { AlphaComplex(furthest, 1); }), Errc::unsupported);
  EXPECT_EQ(test::code_of([&] { alpha_values(furthest, 1); }), Errc::unsupported);
  EXPECT_EQ(faces(furthest, 2).size(), furthest.num_finite_cells());
  EXPECT_EQ(test::code_of([&] { alpha_values(t, 1, {.progress = [](double) { return false; }}); }),
            Errc::cancelled);
}

}  // namespace
}  // namespace delone
