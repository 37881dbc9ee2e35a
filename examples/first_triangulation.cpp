// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay triangulation of a few points of the plane: its triangles and their neighbors.
#include <delone/delone.hpp>

#include <array>
#include <iostream>
#include <vector>

int main() {
  const std::vector<std::array<double, 2>> points = {{0, 0}, {4, 0}, {5, 3}, {1, 4}, {2, 2}};

  const delone::Delaunay<2> triangulation(points);
  std::cout << triangulation.num_vertices() << " vertices, " << triangulation.num_finite_cells()
            << " triangles, " << triangulation.num_infinite_cells() << " edges on the convex hull\n";

  // A plain copy names points by their rows in the input; −1 stands for "beyond the convex hull".
  const delone::ComplexData data = triangulation.to_data();
  for (std::size_t cell = 0; cell < data.num_cells(); ++cell) {
    std::cout << "triangle " << cell << ": points";
    for (std::size_t i = 0; i < 3; ++i) std::cout << ' ' << data.cells[3 * cell + i];
    std::cout << ", neighbors";
    for (std::size_t i = 0; i < 3; ++i) std::cout << ' ' << data.neighbors[3 * cell + i];
    std::cout << '\n';
  }
  return data.num_cells() == 4 ? 0 : 1;
}
