// SPDX-License-Identifier: BSD-3-Clause
// The dimension chosen at run time: random points in 2 to 6 dimensions, and how many cells they have.
#include <delone/delone.hpp>

#include <iostream>
#include <vector>

int main() {
  bool euler = true;
  for (int dimension = 2; dimension <= 6; ++dimension) {
    const std::vector<double> coordinates = delone::make_point_set("uniform", dimension, 200, /*seed=*/1);
    const delone::Delaunay<> triangulation(coordinates, dimension);
    const delone::Complex complex = triangulation.complex();
    std::cout << dimension << " dimensions: " << complex.num_vertices() << " vertices, "
              << complex.num_finite_cells() << " cells, " << complex.num_infinite_cells()
              << " hull facets, hash " << triangulation.hash() << '\n';

    // The faces of a triangulated ball: their numbers, with alternating signs, add up to 1.
    long sum = 0;
    for (int j = 0; j <= dimension; ++j) {
      const long faces = static_cast<long>(complex.faces(j).size()) / (j + 1);
      sum += j % 2 == 0 ? faces : -faces;
    }
    euler = euler && sum == 1;
  }
  return euler ? 0 : 1;
}
