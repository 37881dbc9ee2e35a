// SPDX-License-Identifier: BSD-3-Clause
// Many polyhedra at once, against Polyhedron one by one; threads, errors, limits.
#include <delone/polyhedra_vertices.hpp>

#include "base/random.hpp"
#include "error_code.hpp"

#include <delone/error.hpp>
#include <delone/polyhedron.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace delone {
namespace {

using ::testing::ElementsAre;

struct Systems {
  std::vector<double> matrices, bounds;
};

/// Of small integers: some are empty, some flat, some have rays or lines.
Systems random_systems(std::size_t count, std::size_t m, std::size_t d) {
  random::Generator generator(count);
  Systems systems;
  for (std::size_t i = 0; i < count * m * d; ++i)
    systems.matrices.push_back(static_cast<double>(generator.below(5)) - 2);
  for (std::size_t i = 0; i < count * m; ++i)
    systems.bounds.push_back(static_cast<double>(generator.below(5)) - 1);
  return systems;
}

std::vector<double> part_of(const std::vector<double>& all, std::size_t first, std::size_t last) {
  return {all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(last)};
}

void expect_same(const Systems& systems, std::size_t m, std::size_t d, const PolyhedraVertices& found) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    RationalRows rows;
    for (std::size_t r = i * m; r < (i + 1) * m; ++r) {
      std::vector<Rational> row(systems.matrices.begin() + static_cast<std::ptrdiff_t>(r * d),
                                systems.matrices.begin() + static_cast<std::ptrdiff_t>((r + 1) * d));
      row.emplace_back(systems.bounds[r]);
      rows.push_back(row);
    }
    const Polyhedron p = Polyhedron::from_inequalities(rows, {}, static_cast<int>(d));
    EXPECT_EQ(found.affine_dimensions[i], p.affine_dimension());
    EXPECT_EQ(part_of(found.vertices, d * found.vertex_offsets[i], d * found.vertex_offsets[i + 1]),
              p.vertices().to_doubles());
    EXPECT_EQ(part_of(found.rays, d * found.ray_offsets[i], d * found.ray_offsets[i + 1]),
              p.rays().to_doubles());
    EXPECT_EQ(part_of(found.lines, d * found.line_offsets[i], d * found.line_offsets[i + 1]),
              p.lines().to_doubles());
  }
}

TEST(PolyhedraVertices, AreThoseOfEach) {
  for (const auto& [m, d] :
       {std::pair<std::size_t, std::size_t>{1, 1}, {4, 2}, {3, 3}, {8, 3}, {6, 4}, {9, 7}}) {
    const std::size_t count = d < 7 ? 300 : 20;
    const Systems systems = random_systems(count, m, d);
    const PolyhedraVertices one =
        polyhedra_vertices(systems.matrices, systems.bounds, m, static_cast<int>(d), {.threads = 1});
    ASSERT_EQ(one.size(), count);
    expect_same(systems, m, d, one);
    for (const int threads : {0, 2, 5}) {
      const PolyhedraVertices other =
          polyhedra_vertices(systems.matrices, systems.bounds, m, static_cast<int>(d),
                             {.threads = static_cast<unsigned>(threads)});
      EXPECT_EQ(other.vertices, one.vertices);
      EXPECT_EQ(other.vertex_offsets, one.vertex_offsets);
      EXPECT_EQ(other.rays, one.rays);
      EXPECT_EQ(other.line_offsets, one.line_offsets);
      EXPECT_EQ(other.affine_dimensions, one.affine_dimensions);
    }
  }
}

TEST(PolyhedraVertices, OfNone) {
  const PolyhedraVertices none = polyhedra_vertices({}, {}, 3, 2);
  EXPECT_EQ(none.size(), 0u);
  EXPECT_THAT(none.vertex_offsets, ElementsAre(0));
}

TEST(PolyhedraVertices, BadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> a{1, 2, 3, 4, 5, nan}, b{1, 2, 3};
  EXPECT_EQ(test::code_of([&] { polyhedra_vertices(a, b, 1, 2); }), Errc::not_finite);
  EXPECT_EQ(test::code_of([&] { polyhedra_vertices(b, a, 1, 1); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { polyhedra_vertices(b, b, 2, 1); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { polyhedra_vertices(b, b, 0, 1); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { polyhedra_vertices(b, b, 1, 0); }), Errc::bad_dimension);
  try {
    polyhedra_vertices(a, b, 1, 2);
  } catch (const Error& error) {
    EXPECT_THAT(error.rows(), ElementsAre(2));
    EXPECT_STREQ(error.what(), "a coefficient of row 0 of polyhedron 2 is not finite");
  }
}

TEST(PolyhedraVertices, EndEarly) {
  const Systems systems = random_systems(20000, 8, 3);
  const Options cancelled{.progress = [](double) { return false; }};
  EXPECT_EQ(test::code_of([&] { polyhedra_vertices(systems.matrices, systems.bounds, 8, 3, cancelled); }),
            Errc::cancelled);
  EXPECT_EQ(test::code_of(
                [&] { polyhedra_vertices(systems.matrices, systems.bounds, 8, 3, {.time_limit = 1e-4}); }),
            Errc::time_limit);
}

}  // namespace
}  // namespace delone
