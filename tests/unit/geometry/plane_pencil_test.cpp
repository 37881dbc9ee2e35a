// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_pencil.hpp"

#include "base/random.hpp"
#include "kernel/exact.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace delone::geometry {
namespace {

using PlanePoint = std::array<double, 2>;
constexpr std::array axes_of_plane{0, 1};
const kernel::Flat whole_plane{2, axes_of_plane};

Sign side_of_edge(const PlanePoint& a, const PlanePoint& v, const PlanePoint& b) {
  const double* const points[] = {v.data(), b.data()};
  return kernel::exact_orientation(whole_plane, points, a.data());
}
/// Of u, for a positively oriented triangle: negative inside of its circle.
Sign side_of_circle(const PlanePoint& a, const PlanePoint& v, const PlanePoint& b, const PlanePoint& u) {
  const double* const points[] = {a.data(), v.data(), b.data()};
  return -kernel::exact_sphere(whole_plane, points, u.data());
}

/// Points of the square [−size, size]²: anywhere, on a lattice, nearly on one, or in a cluster and far away.
PlanePoint point_of_kind(random::Generator& random, int kind, double size) {
  PlanePoint p;
  for (double& x : p) {
    x = 2 * random.uniform() - 1;
    if (kind == 1 || kind == 2) x = std::round(4 * x) / 4;
    if (kind == 3 && random.below(2) == 0) x *= 1e-9;
    x *= size;
    if (kind == 2 && random.below(3) == 0) x = std::nextafter(x, random.below(2) == 0 ? size : -size);
  }
  return p;
}

TEST(PlanePencil, WhatIsCertainIsTrue) {
  random::Generator random(1);
  std::size_t num_certain = 0, num_of_uniform = 0, num_ties = 0;
  for (const double size : {1.0, 1e150, 1.7e308, 1e-100, 1e-160, 1e-300, 0x1p-1070})
    for (int kind = 0; kind < 4; ++kind)
      for (std::size_t round = 0; round < test::scaled_size(400, 100); ++round) {
        const PlanePoint a = point_of_kind(random, kind, size), b = point_of_kind(random, kind, size);
        const PlanePoint u = point_of_kind(random, kind, size), v = point_of_kind(random, kind, size);
        const PlanePencil pencil(a.data(), b.data());
        const PlanePencil::View of_u = pencil.view(u.data()), of_v = pencil.view(v.data());
        const Sign side_of_u = side_of_edge(a, u, b), side_of_v = side_of_edge(a, v, b);
        if (of_u.side() != Sign::zero) {
          ASSERT_EQ(of_u.side(), side_of_u) << size << ' ' << kind;
        }
        if (side_of_u != Sign::positive || side_of_v != Sign::positive) continue;
        const Sign expected = side_of_circle(a, v, b, u), found = of_u.against(of_v);
        num_ties += expected == Sign::zero;
        if (size == 1 && kind == 0) {
          ++num_of_uniform;
          num_certain += found != Sign::zero;
        }
        if (found != Sign::zero) {
          ASSERT_EQ(found, expected) << size << ' ' << kind;
        }
      }
  EXPECT_GT(num_of_uniform, 10u);
  EXPECT_EQ(num_certain, num_of_uniform);
  EXPECT_GT(num_ties, 10u);
}

}  // namespace
}  // namespace delone::geometry
