// SPDX-License-Identifier: BSD-3-Clause
// A vertex outside the flat of all others is joined to all their cells, on either side of the flat.
#include "engine/dimension_jump.hpp"
#include "engine_support.hpp"

namespace delone::engine {
namespace {

using Spheres = std::set<std::vector<Index>>;

/// The cells of the sphere joined to q, and the finite ones joined to the infinite vertex.
Spheres joined(const Spheres& sphere, Index q) {
  Spheres result;
  for (std::vector<Index> cell : sphere) {
    cell.push_back(q);
    result.insert(Points<1>::sorted(cell));
    cell.back() = index(infinite_vertex);
    if (cell.front() != index(infinite_vertex)) result.insert(Points<1>::sorted(cell));
  }
  return result;
}

template <int K>
bool is_positive(const Complex& old, Points<K>& raised, Index q) {
  const CellId finite = *old.finite_cells().begin();
  std::vector<Index> simplex;
  for (int i = 0; i < K; ++i) simplex.push_back(index(old.vertex(finite, i)));
  simplex.push_back(q);
  return raised.build.geometry().orientation(simplex.data()) == Sign::positive;
}

TEST(DimensionJump, FromALineToThePlane) {
  for (const double height : {5.0, -5.0}) {
    const std::vector<double> rows{0, 0, 4, 0, 1, 0, 6, 0, 2, height};
    Points<1> line(rows, 2, -8, 8);
    line.seed();
    for (const Index v : {3u, 4u}) ASSERT_EQ(line.build.insert(v), v);
    const Complex old = line.complex(4);
    Points<2> plane(rows, 2, -8, 8);
    plane.build.jump(old, 5, is_positive(old, plane, 5));
    EXPECT_EQ(plane.sphere(), joined(line.sphere(), 5));
    EXPECT_EQ(plane.build.cells().num_cells(), old.num_all_cells() + old.num_finite_cells());
    EXPECT_EQ(plane.build.num_infinite(), old.num_finite_cells() + old.num_infinite_cells());
  }
}

TEST(DimensionJump, FromThePlaneToSpaceWhereInsertionGoesOn) {
  const std::vector<double> base{0, 0, 0, 4, 0, 0, 0, 4, 0, 5, 5, 0, 1, 2, 0};
  for (const double height : {3.0, -3.0}) {
    std::vector<double> rows = base;
    rows.insert(rows.end(), {2, 1, height, 1, 1, 1, 6, 2, -1});
    Points<2> plane(rows, 3, -8, 8);
    plane.seed();
    for (const Index v : {4u, 5u}) ASSERT_EQ(plane.build.insert(v), v);
    const Complex old = plane.complex(5);
    Points<3> space(rows, 3, -8, 8), expected(rows, 3, -8, 8);
    space.build.jump(old, 6, is_positive(old, space, 6));
    EXPECT_EQ(space.sphere(), joined(plane.sphere(), 6));
    for (const Index v : {7u, 8u}) EXPECT_EQ(space.build.insert(v), v);

    std::vector<Index> simplex{1, 2, 3, 6};
    if (expected.build.geometry().orientation(simplex.data()) == Sign::negative)
      std::swap(simplex[0], simplex[1]);
    expected.build.seed(simplex);
    for (const Index v : {4u, 5u, 7u, 8u}) EXPECT_EQ(expected.build.insert(v), v);
    EXPECT_EQ(space.sphere(), expected.sphere());
    EXPECT_EQ(space.build.num_infinite(), expected.build.num_infinite());
  }
}

}  // namespace
}  // namespace delone::engine
