// SPDX-License-Identifier: BSD-3-Clause
// How much is asked until all images are known.
#include "periodic/ghost_triangulation.hpp"
#include "periodic/stored_set.hpp"
#include "periodic_sets.hpp"

#include <delone/periodic.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace delone::periodic {
namespace {

/// Two layers of points, turned so that rounding makes neither of them flat. Spheres at the hull have radii
/// of 2^40 and more: of such a ball one part after the other is asked about, each twice as long as the one
/// before, but each copy of the points once.
TEST(GhostTriangulation, AsksEachCopyOnce) {
  constexpr double turn[3][3] = {{0.6, 0, 0.8}, {0.48, 0.8, -0.36}, {-0.64, 0.6, 0.48}};
  std::vector<double> points = test::random_fractions(300, 3);
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const double x = points[i], y = points[i + 1], z = i % 2 == 0 ? 0 : 0.2;
    for (std::size_t j = 0; j < 3; ++j) points[i + j] = x * turn[0][j] + y * turn[1][j] + z * turn[2][j];
  }
  for (const std::size_t rank : {2, 1}) {
    Lattice lattice{3, {}};
    for (std::size_t i = 0; i < rank; ++i)
      lattice.vectors.insert(lattice.vectors.end(), turn[i], turn[i] + 3);
    const PeriodicDelaunay<3> t(PointsView(points, 3), lattice);
    const GhostTriangulation& ghosts = StoredSet::ghosts(t);
    std::size_t most_pages = ghosts.images().table().num_pages();
    for (std::size_t i = 0; i < rank; ++i)
      most_pages *= 2 * static_cast<std::size_t>(ghosts.images().set().period.reach(i)) + 1;
    EXPECT_GT(ghosts.effort().questions, 100u);
    EXPECT_LE(ghosts.effort().pages, ghosts.effort().questions * most_pages);
  }
}

}  // namespace
}  // namespace delone::periodic
