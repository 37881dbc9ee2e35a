// SPDX-License-Identifier: BSD-3-Clause
// The engine against CGAL in 4 and 5 dimensions.
#include "cgal_delaunay.hpp"

namespace delone {
namespace {

TEST(CgalIn, UniformPointsAgreeIn4D) { test::expect_cgal<4>(250, 4); }
TEST(CgalIn, UniformPointsAgreeIn5D) { test::expect_cgal<5>(120, 5); }

}  // namespace
}  // namespace delone
