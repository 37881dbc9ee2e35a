// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation of space, edited.
#include "edit_cgal.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_3.h>

#include <array>
#include <iterator>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Structure = CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                                       CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;

struct Peer {
  using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;
  using Point = Kernel::Point_3;
  using Vertex = Triangulation::Vertex_handle;
  static constexpr int dimension = 3;
  static constexpr const char* name = "CGAL 3D";

  static Triangulation make() { return {}; }
  static Point to_point(std::span<const double> p) { return {p[0], p[1], p[2]}; }
  static std::array<double, 3> coordinates_of(Vertex v) {
    return {v->point().x(), v->point().y(), v->point().z()};
  }
  static auto finite_vertices(const Triangulation& t) { return t.finite_vertex_handles(); }
  static std::vector<Vertex> neighbors(const Triangulation& t, Vertex v) {
    std::vector<Vertex> neighbors;
    t.finite_adjacent_vertices(v, std::back_inserter(neighbors));
    return neighbors;
  }
  static Vertex insert(Triangulation& t, const Point& point, Vertex hint) { return t.insert(point, hint); }
};

class Cgal3 : public rival::CgalMover<Peer> {
 public:
  using CgalMover::CgalMover;

  std::size_t num_cells() const { return triangulation_.number_of_finite_cells(); }
  std::uint64_t checksum() const {
    rival::Checksum sum;
    for (const auto& cell : triangulation_.finite_cell_handles()) {
      for (int i = 0; i < 4; ++i) sum.add_vertex(Peer::coordinates_of(cell->vertex(i)));
      sum.end_cell();
    }
    return sum.value();
  }
};

}  // namespace

int main(int argc, char** argv) { return rival::run_edits<Cgal3>(argc, argv); }
