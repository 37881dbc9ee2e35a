// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay triangulation of a few points of the plane: its triangles and their neighbors.
#include <delone/delone.hpp>

#include <array>
#include <cstdio>
#include <vector>

int main() {
  const std::vector<std::array<double, 2>> points = {{0, 0}, {4, 0}, {5, 3}, {1, 4}, {2, 2}};

  const delone::Delaunay<2> triangulation(points);
  std::printf("%zu points, %u triangles, %u edges on the convex hull\n", points.size(), triangulation.num_finite_cells(),
              triangulation.num_infinite_cells());

  // A plain copy names points by their rows in the input; -1 stands for "beyond the convex hull".
  const delone::ComplexData data = triangulation.to_data();
  for (std::size_t cell = 0; cell < data.num_cells(); ++cell) {
    const int* v = &data.cells[3 * cell];
    const int* n = &data.neighbors[3 * cell];
    std::printf("triangle %zu: points %d %d %d, neighbors %d %d %d\n", cell, v[0], v[1], v[2], n[0], n[1], n[2]);
  }
  return data.num_cells() == 4 ? 0 : 1;
}
