// SPDX-License-Identifier: BSD-3-Clause
// Point by point: insertion, location of queries without tolerance, and a star.
#include <delone/delone.hpp>

#include <array>
#include <iostream>

namespace {

const char* in_words(delone::Location::Kind kind) {
  using Kind = delone::Location::Kind;
  switch (kind) {
    case Kind::in_cell:
      return "inside a cell";
    case Kind::on_face:
      return "on a face";
    case Kind::on_vertex:
      return "on a vertex";
    case Kind::outside_hull:
      return "outside the convex hull";
    case Kind::outside_affine_hull:
      return "outside the affine hull";
  }
  return "";
}

}  // namespace

int main() {
  delone::Delaunay<3> triangulation;
  using Point = delone::Delaunay<3>::Point;
  for (const Point& p : {Point{0, 0, 0}, Point{2, 0, 0}, Point{0, 2, 0}, Point{0, 0, 2}})
    triangulation.insert(p);

  // A hint names a cell close by, where the search for the new point starts.
  const delone::CellId hint = triangulation.locate(Point{0.1, 0.1, 0.1}).cell;
  const delone::InsertResult added = triangulation.insert(Point{0.5, 0.5, 0.5}, hint);
  const delone::InsertResult again = triangulation.insert(Point{0.5, 0.5, 0.5});
  std::cout << "once: " << (added.inserted ? "inserted" : "already there")
            << ", twice: " << (again.inserted ? "inserted" : "already there") << '\n';
  std::cout << triangulation.complex().star(added.vertex).size() << " of " << triangulation.num_finite_cells()
            << " cells meet at the new vertex\n";

  for (const Point& q : {Point{0.2, 0.3, 0.4}, Point{1, 0, 0}, Point{0.5, 0.5, 0.5}, Point{2, 2, 2}}) {
    const delone::Location where = triangulation.locate(q);
    std::cout << '(' << q[0] << ", " << q[1] << ", " << q[2] << ") is " << in_words(where.kind);
    if (where.kind == delone::Location::Kind::on_face)
      std::cout << " of dimension " << where.face_dimension();
    std::cout << '\n';
  }
  return triangulation.num_finite_cells() == 4 && added.vertex == again.vertex ? 0 : 1;
}
