// SPDX-License-Identifier: BSD-3-Clause
// Point by point: insertion, location of queries without tolerance, and a star.
#include <delone/delone.hpp>

#include <array>
#include <cstdio>

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
  for (const Point& p : {Point{0, 0, 0}, Point{2, 0, 0}, Point{0, 2, 0}, Point{0, 0, 2}}) triangulation.insert(p);

  // The point lies in the one cell there is, near the vertex that came last; a hint may name a cell close by.
  const delone::CellId hint = triangulation.locate(Point{0.1, 0.1, 0.1}).cell;
  const delone::InsertResult added = triangulation.insert(Point{0.5, 0.5, 0.5}, hint);
  const delone::InsertResult again = triangulation.insert(Point{0.5, 0.5, 0.5});
  std::printf("inserted: %d, and again: %d, as the same vertex: %d\n", added.inserted, again.inserted,
              added.vertex == again.vertex);
  std::printf("cells around it: %zu of %u\n", triangulation.complex().star(added.vertex).size(),
              triangulation.num_finite_cells());

  for (const Point& q : {Point{0.2, 0.3, 0.4}, Point{1, 0, 0}, Point{0.5, 0.5, 0.5}, Point{2, 2, 2}}) {
    const delone::Location where = triangulation.locate(q);
    std::printf("(%g, %g, %g) is %s", q[0], q[1], q[2], in_words(where.kind));
    if (where.kind == delone::Location::Kind::on_face) std::printf(" of dimension %d", where.face_dimension());
    std::printf("\n");
  }
  return triangulation.num_finite_cells() == 4 && !again.inserted ? 0 : 1;
}
