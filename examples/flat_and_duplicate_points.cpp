// SPDX-License-Identifier: BSD-3-Clause
// Degenerate input has a result like any other: coplanar points in space, duplicates, a single point, none at
// all.
#include <delone/delone.hpp>

#include <iostream>
#include <limits>
#include <vector>

int main() {
  // A square of the plane x + y + z = 1, with one corner twice.
  const std::vector<double> square = {1, 0, 0, 0, 1, 0, 1, 1, -1, 0, 0, 1, 0, 1, 0};
  delone::Delaunay<> triangulation(square, 3);
  std::cout << triangulation.num_points() << " points in " << triangulation.dimension() << " dimensions span "
            << triangulation.affine_dimension() << ": " << triangulation.num_finite_cells() << " triangles, "
            << triangulation.num_duplicates() << " duplicate\n";
  std::cout << "row 4 is the same vertex as row " << triangulation.row_of(triangulation.vertex_at(4)) << '\n';
  const bool flat = triangulation.affine_dimension() == 2 && triangulation.num_finite_cells() == 2;

  // A point off the plane raises the dimension.
  triangulation.insert(std::vector<double>{0, 0, 0});
  std::cout << "with a point off the plane: dimension " << triangulation.affine_dimension() << ", "
            << triangulation.num_finite_cells() << " tetrahedra\n";

  const delone::Delaunay<> one(std::vector<double>{1, 2, 3}, 3), none(3);
  std::cout << "one point has dimension " << one.affine_dimension() << ", no point "
            << none.affine_dimension() << '\n';

  // What is not a point is an error that names its row, and leaves the triangulation as it was.
  try {
    triangulation.insert_range(std::vector<double>{3, 3, 3, 0, std::numeric_limits<double>::quiet_NaN(), 0});
  } catch (const delone::Error& error) {
    std::cout << "refused: " << error.what() << '\n';
    return flat && triangulation.num_points() == 6 ? 0 : 1;
  }
  return 1;
}
