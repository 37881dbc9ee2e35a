// SPDX-License-Identifier: BSD-3-Clause
// The engine against CGAL in 2 and 3 dimensions.
#include "cgal_delaunay.hpp"

namespace delone {
namespace {

TEST(CgalIn, UniformPointsAgreeIn2D) { test::expect_cgal<2>(1000, 2); }
TEST(CgalIn, UniformPointsAgreeIn3D) { test::expect_cgal<3>(500, 3); }

}  // namespace
}  // namespace delone
