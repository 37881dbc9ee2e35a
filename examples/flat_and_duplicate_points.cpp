// SPDX-License-Identifier: BSD-3-Clause
// Input that other programs refuse: coplanar points in space, duplicates, a single point, none at all.
#include <delone/delone.hpp>

#include <cstdio>
#include <limits>
#include <vector>

int main() {
  // A square of the plane x + y + z = 1, with one corner twice.
  const std::vector<double> square = {1, 0, 0, 0, 1, 0, 1, 1, -1, 0, 0, 1, 0, 1, 0};
  delone::Triangulation triangulation(square, 3);
  std::printf("%zu points in %d dimensions span %d: %u triangles, %zu duplicate\n", triangulation.num_points(),
              triangulation.dimension(), triangulation.affine_dimension(), triangulation.num_finite_cells(),
              triangulation.num_duplicates());
  std::printf("point 4 is the vertex of row %zu\n", triangulation.row_of(triangulation.vertex_at(4)));
  const bool flat = triangulation.affine_dimension() == 2 && triangulation.num_finite_cells() == 2;

  // A point off the plane raises the dimension; nothing has to be rebuilt by hand.
  triangulation.insert(std::vector<double>{0, 0, 0});
  std::printf("with a point off the plane: dimension %d, %u tetrahedra\n", triangulation.affine_dimension(),
              triangulation.num_finite_cells());

  const delone::Triangulation one(std::vector<double>{1, 2, 3}, 3);
  const delone::Triangulation none(3);
  std::printf("one point spans dimension %d, none %d\n", one.affine_dimension(), none.affine_dimension());

  // What is not a point is an error that names its row, and leaves the triangulation as it was.
  try {
    triangulation.insert_range(std::vector<double>{3, 3, 3, 0, std::numeric_limits<double>::quiet_NaN(), 0});
  } catch (const delone::Error& error) {
    std::printf("refused: %s\n", error.what());
    return flat && triangulation.num_points() == 6 ? 0 : 1;
  }
  return 1;
}
