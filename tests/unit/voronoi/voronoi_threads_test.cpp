// SPDX-License-Identifier: BSD-3-Clause
// Diagrams have the same arrays and volumes for every number of threads.
#include "base/random.hpp"
#include "scale.hpp"

#include <delone/voronoi.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::voronoi {
namespace {

std::vector<double> random_rows(std::size_t count) {
  std::vector<double> rows(count);
  for (std::size_t i = 0; i < count; ++i)
    rows[i] = std::ldexp(static_cast<double>(random::mix(i) >> 11), -53);
  return rows;
}

template <class T>
std::vector<T> copy(std::span<const T> items) {
  return {items.begin(), items.end()};
}

template <class Diagram, class Triangulation>
void expect_one_diagram(const Triangulation& triangulation, const DiagramOptions& options = {}) {
  const Diagram expected(triangulation, options);
  const Box box = expected.bounding_box(0);
  for (const unsigned threads : {2u, 3u, 8u}) {
    const Execution how{.threads = threads};
    const Diagram diagram(triangulation, options, how);
    EXPECT_EQ(copy(diagram.vertices()), copy(expected.vertices()));
    EXPECT_EQ(copy(diagram.ridge_points()), copy(expected.ridge_points()));
    EXPECT_EQ(copy(diagram.ridge_vertices()), copy(expected.ridge_vertices()));
    EXPECT_EQ(copy(diagram.ridge_offsets()), copy(expected.ridge_offsets()));
    EXPECT_EQ(copy(diagram.region_vertices()), copy(expected.region_vertices()));
    EXPECT_EQ(copy(diagram.region_offsets()), copy(expected.region_offsets()));
    EXPECT_EQ(copy(diagram.ray_directions()), copy(expected.ray_directions()));
    if (options.parts == DiagramParts::regions) continue;
    EXPECT_EQ(expected.ridge_volumes(how), expected.ridge_volumes());
    EXPECT_EQ(expected.region_volumes(how), expected.region_volumes());
    if (diagram.dimension() <= 3) {
      EXPECT_EQ(expected.region_volumes(box, how), expected.region_volumes(box));
    }
  }
}

TEST(VoronoiThreads, RandomPoints) {
  const std::size_t n = test::scaled_size(1500, 300);
  expect_one_diagram<Voronoi<2>>(Delaunay<2>(random_rows(2 * n)));
  expect_one_diagram<Voronoi<2>>(Delaunay<2>(random_rows(2 * n)), {.parts = DiagramParts::regions});
  expect_one_diagram<Voronoi<3>>(Delaunay<3>(random_rows(3 * test::scaled_size(400, 100))));
  expect_one_diagram<Voronoi<4>>(Delaunay<4>(random_rows(4 * test::scaled_size(300, 40))));
}

TEST(VoronoiThreads, WeightsAndATolerance) {
  std::vector<double> weights = random_rows(800);
  for (double& w : weights) w *= 1e-3;
  expect_one_diagram<PowerDiagram<3>>(Regular<3>(random_rows(3 * 800), weights));
  expect_one_diagram<Voronoi<2>>(Delaunay<2>(random_rows(2 * 1200)), {.tolerance = 1e-3});
}

TEST(VoronoiThreads, ALatticeWhoseCellsMerge) {
  std::vector<double> lattice;
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y) lattice.insert(lattice.end(), {double(x), double(y)});
  expect_one_diagram<Voronoi<2>>(Delaunay<2>(lattice));
}

}  // namespace
}  // namespace delone::voronoi
