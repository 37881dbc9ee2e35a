// SPDX-License-Identifier: BSD-3-Clause
// Both descriptions of polyhedra, against all sets of rows and back; what is minimal, canonical and counted.
#include <delone/polyhedron.hpp>

#include "error_code.hpp"
#include "polyhedra_support.hpp"
#include "scale.hpp"

#include <delone/error.hpp>
#include <delone/progress.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

RationalRows without(const RationalRows& rows, const std::vector<std::size_t>& left_out) {
  RationalRows kept;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::find(left_out.begin(), left_out.end(), i) == left_out.end()) kept.push_back(rows[i]);
  return kept;
}

/// Generators found by brute force, as arguments.
struct Generators {
  RationalRows vertices, rays, lines;
};

Generators find_generators(const RationalRows& inequalities, const RationalRows& equations, std::size_t d) {
  const auto homogeneous = [&](const RationalRows& rows) {
    brute_force::Matrix matrix;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      brute_force::Vector row;
      for (std::size_t c = 0; c <= d; ++c) row.push_back(as_fraction(rows[i][c]) * (c < d ? -1 : 1));
      matrix.push_back(row);
    }
    return matrix;
  };
  brute_force::Matrix rows = homogeneous(inequalities);
  rows.emplace_back(d + 1, 0);
  rows.back()[d] = 1;
  const brute_force::Cone cone = brute_force::find_cone(rows, homogeneous(equations), d + 1);
  Generators result;
  const auto add = [&](RationalRows& to, brute_force::Vector x, const brute_force::Number& scale) {
    x.pop_back();
    std::vector<Rational> row;
    for (brute_force::Number& entry : x) row.push_back(as_rational(brute_force::Number(entry / scale)));
    to.push_back(row);
  };
  for (const brute_force::Vector& ray : cone.rays)
    if (ray[d] > 0)
      add(result.vertices, ray, ray[d]);
    else
      add(result.rays, ray, 1);
  for (const brute_force::Vector& line : cone.lines) add(result.lines, line, 1);
  return result;
}

/// That no row of either description can be left out, and all that they say about each other.
void expect_consistent(const Polyhedron& p) {
  const int d = p.dimension();
  const RationalRows vertices = p.vertices(), rays = p.rays(), lines = p.lines(),
                     inequalities = p.inequalities(), equations = p.equations();
  EXPECT_EQ(p, Polyhedron::from_inequalities(inequalities, equations, d));
  const Polyhedron back = Polyhedron::from_generators(vertices, rays, lines, d);
  EXPECT_EQ(p, back);
  EXPECT_EQ(p.hash(), back.hash());
  EXPECT_EQ(back.inequalities(), inequalities);
  EXPECT_EQ(back.equations(), equations);
  EXPECT_EQ(back.rays(), rays);
  EXPECT_EQ(back.vertices(), vertices);
  if (p.is_empty()) {
    EXPECT_THAT(inequalities, SizeIs(0));
    EXPECT_THAT(equations, SizeIs(1));
    return;
  }
  for (std::size_t i = 0; i < inequalities.size(); ++i)
    EXPECT_NE(Polyhedron::from_inequalities(without(inequalities, {i}), equations, d), p);
  for (std::size_t i = 0; i < equations.size(); ++i)
    EXPECT_NE(Polyhedron::from_inequalities(inequalities, without(equations, {i}), d), p);
  for (std::size_t i = 0; vertices.size() > 1 && i < vertices.size(); ++i)
    EXPECT_NE(Polyhedron::from_generators(without(vertices, {i}), rays, lines, d), p);
  for (std::size_t i = 0; i < rays.size(); ++i)
    EXPECT_NE(Polyhedron::from_generators(vertices, without(rays, {i}), lines, d), p);
  for (std::size_t f = 0; f < inequalities.size(); ++f) {
    for (const std::size_t v : p.vertices_of_facet(f)) {
      const std::vector<std::size_t> facets = p.facets_of_vertex(v);
      EXPECT_TRUE(std::binary_search(facets.begin(), facets.end(), f));
      EXPECT_EQ(value_at(inequalities[f], vertices[v]), as_fraction(inequalities[f].back()));
    }
    for (const std::size_t r : p.rays_of_facet(f)) EXPECT_EQ(value_at(inequalities[f], rays[r]), 0);
  }
  // Euler's relation for polytopes; in all cases edges and ridges as pairs.
  const std::vector<std::size_t> f = p.f_vector();
  const int k = p.affine_dimension();
  ASSERT_THAT(f, SizeIs(static_cast<std::size_t>(k)));
  if (p.is_bounded() && k > 0) {
    EXPECT_EQ(f.front(), vertices.size());
    long sum = 0;
    for (std::size_t j = 0; j < f.size(); ++j) sum += (j % 2 == 0 ? 1 : -1) * static_cast<long>(f[j]);
    EXPECT_EQ(sum, 1 - (k % 2 == 0 ? 1 : -1));
    if (k > 1) {
      EXPECT_THAT(p.adjacent_vertices(), SizeIs(f[1]));
    }
  }
  if (k > 0) {
    EXPECT_EQ(f.back(), inequalities.size());
  }
  if (k > 1 && static_cast<std::size_t>(k) >= p.num_lines() + 2) {
    EXPECT_THAT(p.adjacent_facets(), SizeIs(f[static_cast<std::size_t>(k) - 2]));
  }
}

TEST(Polyhedron, AgreesWithAllSetsOfRows) {
  random::Generator generator(11);
  int flat = 0, empty = 0, unbounded = 0, with_lines = 0;
  const std::size_t rounds = test::scaled_count(300);
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::size_t d = generator.below(5);
    const RationalRows inequalities = random_rationals(generator, generator.below(10), d + 1, 3),
                       equations = random_rationals(generator, generator.below(4) / 3, d + 1, 3);
    const Polyhedron p = Polyhedron::from_inequalities(inequalities, equations, static_cast<int>(d));
    const Generators expected = find_generators(inequalities, equations, d);
    ASSERT_EQ(p.num_vertices(), expected.vertices.size());
    if (p.num_vertices() > 0) {
      ASSERT_EQ(p.num_rays(), expected.rays.size());
      ASSERT_EQ(p.num_lines(), expected.lines.size());
      EXPECT_EQ(p, Polyhedron::from_generators(expected.vertices, expected.rays, expected.lines,
                                               static_cast<int>(d)));
    }
    expect_consistent(p);
    const RationalRows needed = without(inequalities, p.redundant_rows());
    EXPECT_EQ(p, Polyhedron::from_inequalities(needed, equations, static_cast<int>(d)));
    empty += p.is_empty();
    flat += !p.is_empty() && p.affine_dimension() < p.dimension();
    unbounded += !p.is_bounded();
    with_lines += p.num_lines() > 0;
  }
  for (const int count : {empty, flat, unbounded, with_lines})
    EXPECT_GT(count, static_cast<int>(rounds) / 50);
}

TEST(Polyhedron, OfGenerators) {
  random::Generator generator(12);
  const std::size_t rounds = test::scaled_count(200);
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::size_t d = 1 + generator.below(4);
    const int dimension = static_cast<int>(d);
    const RationalRows vertices = random_rationals(generator, 1 + generator.below(9), d, 2),
                       rays = random_rationals(generator, generator.below(5), d, 2),
                       lines = random_rationals(generator, generator.below(4) / 3, d, 2);
    const Polyhedron p = Polyhedron::from_generators(vertices, rays, lines, dimension);
    for (std::size_t i = 0; i < vertices.size(); ++i) EXPECT_TRUE(p.contains(vertices[i]));
    expect_consistent(p);
    const std::vector<std::size_t> redundant = p.redundant_rows();
    std::vector<std::size_t> of_vertices, of_rays;
    for (const std::size_t row : redundant)
      row < vertices.size() ? of_vertices.push_back(row) : of_rays.push_back(row - vertices.size());
    EXPECT_EQ(p, Polyhedron::from_generators(without(vertices, of_vertices), without(rays, of_rays), lines,
                                             dimension));
  }
}

TEST(Polyhedron, SmallestOnes) {
  expect_consistent(Polyhedron());
  for (int d = 0; d < 4; ++d) {
    const Polyhedron empty = Polyhedron::empty(d), space = Polyhedron::space(d);
    expect_consistent(empty);
    expect_consistent(space);
    EXPECT_TRUE(empty.is_empty());
    EXPECT_TRUE(empty.is_bounded());
    EXPECT_EQ(empty.affine_dimension(), -1);
    EXPECT_EQ(space.affine_dimension(), d);
    EXPECT_EQ(space.num_lines(), static_cast<std::size_t>(d));
    EXPECT_EQ(space.num_inequalities(), 0u);
    EXPECT_NE(empty, space);
    EXPECT_NE(empty.hash(), space.hash());
    EXPECT_NE(empty.hash(), Polyhedron::empty(d + 1).hash());
  }
  const Polyhedron point =
      Polyhedron::from_inequalities({{1, 0, 2}, {-1, 0, -2}, {0, 3, 1}, {0, -3, -1}}, {}, 2);
  expect_consistent(point);
  EXPECT_EQ(point.vertices(), (RationalRows{{2, Rational("1/3")}}));
  EXPECT_EQ(point.vertex_integers(), (RationalRows{{6, 1, 3}}));
  EXPECT_EQ(point.equations(), (RationalRows{{1, 0, 2}, {0, 3, 1}}));
  EXPECT_THAT(point.row_kinds(), testing::Each(RowKind::implicit));
  EXPECT_TRUE(Polyhedron::from_inequalities({{-1}}, {}, 0).is_empty());  // 0 ≤ −1
  EXPECT_EQ(Polyhedron::from_inequalities({{0}, {1}}, {{0}}, 0), Polyhedron::space(0));
  EXPECT_TRUE(Polyhedron::from_inequalities({}, {{0, 0, 1}}, 2).is_empty());  // 0 = 1
}

TEST(Polyhedron, ConesHaveTheOrigin) {
  const Polyhedron cone = Polyhedron::from_generators({}, {{1, 0}, {1, 1}, {3, 1}}, {}, 2);
  EXPECT_EQ(cone.vertices(), (RationalRows{{0, 0}}));
  EXPECT_EQ(cone.rays(), (RationalRows{{1, 0}, {1, 1}}));
  EXPECT_EQ(cone.inequalities(), (RationalRows{{-1, 1, 0}, {0, -1, 0}}));
  EXPECT_THAT(cone.row_kinds(), ElementsAre(RowKind::essential, RowKind::essential, RowKind::redundant));
  const Polyhedron half = Polyhedron::from_generators({}, {{1, 0}, {-2, 0}, {0, 1}}, {}, 2);
  EXPECT_EQ(half.lines(), (RationalRows{{1, 0}}));
  EXPECT_THAT(half.row_kinds(), ElementsAre(RowKind::implicit, RowKind::implicit, RowKind::essential));
  expect_consistent(half);
}

TEST(Polyhedron, KindsOfRows) {
  const Polyhedron square = Polyhedron::from_inequalities(
      {{1, 0, 1}, {-1, 0, 0}, {0, 1, 1}, {0, -2, 0}, {2, 0, 2}, {1, 1, 2}, {1, 1, 3}, {0, 0, 1}}, {}, 2);
  EXPECT_THAT(square.row_kinds(),
              ElementsAre(RowKind::essential, RowKind::essential, RowKind::essential, RowKind::essential,
                          RowKind::duplicate, RowKind::redundant, RowKind::redundant, RowKind::redundant));
  EXPECT_THAT(square.redundant_rows(), ElementsAre(4, 5, 6, 7));
  EXPECT_EQ(square.inequalities(), (RationalRows{{-1, 0, 0}, {0, -1, 0}, {0, 1, 1}, {1, 0, 1}}));
  EXPECT_EQ(square.vertices(), (RationalRows{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
}

TEST(Polyhedron, KnownPolytopes) {
  for (int d = 1; d <= 5; ++d) {
    const Polyhedron cube = unit_cube(d), cross = cube_around_origin(d).polar();
    EXPECT_EQ(cube.num_vertices(), std::size_t{1} << d);
    EXPECT_EQ(cross.num_inequalities(), std::size_t{1} << d);
    EXPECT_EQ(cross.num_vertices(), static_cast<std::size_t>(2 * d));
    if (d <= 4) expect_consistent(cube);
    if (d <= 4) expect_consistent(cross);
    std::vector<std::size_t> of_cube = cube.f_vector(), of_cross = cross.f_vector();
    std::reverse(of_cross.begin(), of_cross.end());
    EXPECT_EQ(of_cube, of_cross);
  }
  EXPECT_THAT(unit_cube(4).f_vector(), ElementsAre(16, 32, 24, 8));
  // Permutahedra: flat, and all faces are known.
  const Polyhedron permutahedron = Polyhedron::from_generators(permutations(5), {}, {}, 5);
  EXPECT_EQ(permutahedron.num_inequalities(), 30u);
  EXPECT_EQ(permutahedron.equations(), (RationalRows{{1, 1, 1, 1, 1, 15}}));
  EXPECT_THAT(permutahedron.f_vector(), ElementsAre(120, 240, 150, 30));
  EXPECT_THAT(permutahedron.adjacent_vertices(), SizeIs(240));
  EXPECT_EQ(Polyhedron::from_generators(moment_curve(12, 6), {}, {}, 6).num_inequalities(), 112u);
}

TEST(Polyhedron, UnboundedFaces) {
  const Polyhedron prism =
      Polyhedron::from_inequalities({{-1, 0, 0, 0}, {1, 0, 0, 1}, {0, -1, 0, 0}, {0, 0, -1, 0}}, {}, 3);
  EXPECT_THAT(prism.f_vector(), ElementsAre(2, 5, 4));
  EXPECT_THAT(prism.adjacent_vertices(), ElementsAre(std::pair(0, 1)));
  EXPECT_EQ(prism.num_rays(), 2u);
  expect_consistent(prism);
  const Polyhedron wedge = Polyhedron::from_inequalities({{-1, 0, 0, 0}, {0, -1, 0, 0}}, {}, 3);
  EXPECT_THAT(wedge.f_vector(), ElementsAre(0, 1, 2));
  EXPECT_THAT(wedge.adjacent_facets(), ElementsAre(std::pair(0, 1)));
  const Polyhedron strip = Polyhedron::from_inequalities({{-1, 0, 0}, {1, 0, 1}}, {}, 2);
  EXPECT_THAT(strip.adjacent_facets(), IsEmpty());
  EXPECT_THAT(strip.f_vector(), ElementsAre(0, 2));
}

TEST(Polyhedron, NumbersOfAnySize) {
  const Rational huge("1" + std::string(300, '0')), tiny(5e-324);
  const Polyhedron box =
      Polyhedron::from_inequalities({{1, 0, huge}, {-1, 0, 0}, {0, 1, tiny}, {0, -1, 0}}, {}, 2);
  EXPECT_EQ(box.vertices()[3][0], huge);
  EXPECT_EQ(box.vertices()[3][1], tiny);
  EXPECT_THAT(box.vertices().to_doubles(), ElementsAre(0, 0, 0, 5e-324, 1e300, 0, 1e300, 5e-324));
  expect_consistent(box);
  const Polyhedron thin =
      Polyhedron::from_inequalities({{1e150, 1, 1e-150}, {-1e150, 1, 0}, {0, -1e-150, 0}}, {}, 2);
  EXPECT_EQ(thin.num_vertices(), 3u);
  expect_consistent(thin);
}

TEST(Polyhedron, Errors) {
  EXPECT_EQ(test::code_of([] { Polyhedron::empty(-1); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([] { Polyhedron::from_inequalities({{1, 2}}, {}, 2); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([] { Polyhedron::from_generators({{1, 2}}, {{1}}, {}, 2); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([] { unit_cube(2).contains(std::vector<Rational>(3)); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([] { unit_cube(2).intersection(unit_cube(3)); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([] { unit_cube(2).facets_of_vertex(4); }), Errc::invalid_argument);
  Options options;
  options.time_limit = -1;
  EXPECT_EQ(test::code_of([&] { Polyhedron::from_inequalities({}, {}, 1, options); }),
            Errc::invalid_argument);
}

TEST(Polyhedron, EndsAtLimitsAndWhenCancelled) {
  const RationalRows permutations_of_7 = permutations(7);
  Options limited;
  limited.time_limit = 0.02;
  EXPECT_EQ(test::code_of([&] { Polyhedron::from_generators(permutations_of_7, {}, {}, 7, limited); }),
            Errc::time_limit);
  Options cancelled;
  double last = 0;
  cancelled.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return fraction < 0.02;
  };
  EXPECT_EQ(test::code_of([&] { Polyhedron::from_generators(permutations_of_7, {}, {}, 7, cancelled); }),
            Errc::cancelled);
  const ProgressScope scope([](double) { return false; });
  EXPECT_EQ(test::code_of([&] { Polyhedron::from_generators(permutations_of_7, {}, {}, 7); }),
            Errc::cancelled);
}

}  // namespace
}  // namespace delone::polyhedra
