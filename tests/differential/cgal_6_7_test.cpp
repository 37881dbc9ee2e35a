// SPDX-License-Identifier: BSD-3-Clause
// The engine against CGAL in 6 and 7 dimensions.
#include "cgal_delaunay.hpp"

namespace delone {
namespace {

TEST(CgalIn, UniformPointsAgreeIn6D) { test::expect_cgal<6>(60, 6); }
TEST(CgalIn, UniformPointsAgreeIn7D) { test::expect_cgal<7>(30, 7); }

}  // namespace
}  // namespace delone
