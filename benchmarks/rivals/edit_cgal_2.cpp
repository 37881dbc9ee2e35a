// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation of the plane, edited.
#include "edit_cgal.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Peer {
  using Triangulation = CGAL::Delaunay_triangulation_2<Kernel>;
  using Point = Kernel::Point_2;
  using Vertex = Triangulation::Vertex_handle;
  static constexpr int dimension = 2;
  static constexpr const char* name = "CGAL 2D";

  static Triangulation make() { return {}; }
  static Point to_point(std::span<const double> p) { return {p[0], p[1]}; }
  static std::array<double, 2> coordinates_of(Vertex v) { return {v->point().x(), v->point().y()}; }
  static auto finite_vertices(const Triangulation& t) { return t.finite_vertex_handles(); }
  static std::vector<Vertex> neighbors(const Triangulation& t, Vertex v) {
    std::vector<Vertex> neighbors;
    auto neighbor = t.incident_vertices(v);
    const auto first = neighbor;
    do {
      if (!t.is_infinite(neighbor)) neighbors.push_back(neighbor);
    } while (++neighbor != first);
    return neighbors;
  }
  static Vertex insert(Triangulation& t, const Point& point, Vertex hint) {
    return t.insert(point, hint->face());
  }
};

class Cgal2 : public rival::CgalMover<Peer> {
 public:
  using CgalMover::CgalMover;

  std::size_t num_cells() const { return triangulation_.number_of_faces(); }
  std::uint64_t checksum() const {
    rival::Checksum sum;
    for (const auto& face : triangulation_.finite_face_handles()) {
      for (int i = 0; i < 3; ++i) sum.add_vertex(Peer::coordinates_of(face->vertex(i)));
      sum.end_cell();
    }
    return sum.value();
  }
};

}  // namespace

int main(int argc, char** argv) { return rival::run_edits<Cgal2>(argc, argv); }
