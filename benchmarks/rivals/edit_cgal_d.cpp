// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation in any dimension, edited, with the dimension compiled in (DIMENSION). It has
// no moves: a vertex that moves is removed, and inserted from the cell that the removal returns.
#include "edit_cgal.hpp"

#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Epick_d.h>

#include <array>
#include <iterator>

namespace {

struct Peer {
  using Triangulation = CGAL::Delaunay_triangulation<CGAL::Epick_d<CGAL::Dimension_tag<DIMENSION>>>;
  using Point = Triangulation::Point;
  using Vertex = Triangulation::Vertex_handle;
  using Cell = Triangulation::Full_cell_handle;
  static constexpr int dimension = DIMENSION;
  static constexpr const char* name = "CGAL dD";

  static Triangulation make() { return Triangulation(DIMENSION); }
  static Point to_point(std::span<const double> p) { return Point(p.begin(), p.end()); }
  static std::array<double, DIMENSION> coordinates_of(Vertex v) {
    std::array<double, DIMENSION> coordinates{};
    for (int axis = 0; axis < DIMENSION; ++axis)
      coordinates[static_cast<std::size_t>(axis)] = v->point()[axis];
    return coordinates;
  }
  static std::vector<Vertex> finite_vertices(Triangulation& t) {
    std::vector<Vertex> vertices;
    for (auto v = t.vertices_begin(); v != t.vertices_end(); ++v)
      if (!t.is_infinite(v)) vertices.push_back(v);
    return vertices;
  }
  static std::set<Vertex> neighbors(const Triangulation& t, Vertex v) {
    std::vector<Cell> star;
    t.incident_full_cells(v, std::back_inserter(star));
    std::set<Vertex> neighbors;
    for (const Cell cell : star)
      for (int i = 0; i <= DIMENSION; ++i)
        if (const Vertex u = cell->vertex(i); u != v && !t.is_infinite(u)) neighbors.insert(u);
    return neighbors;
  }
  static Vertex insert(Triangulation& t, const Point& point, Vertex hint) { return t.insert(point, hint); }
};

class CgalD : public rival::CgalEditor<Peer> {
 public:
  using CgalEditor::CgalEditor;

  void move(std::size_t row, std::span<const double> point) {
    const Peer::Cell near = triangulation_.remove(vertices_[row]);
    vertices_[row] = triangulation_.insert(Peer::to_point(point), near);
  }

  std::size_t num_cells() const {
    std::size_t count = 0;
    for (auto cell = triangulation_.finite_full_cells_begin(); cell != triangulation_.finite_full_cells_end();
         ++cell)
      ++count;
    return count;
  }
  std::uint64_t checksum() const {
    rival::Checksum sum;
    for (auto cell = triangulation_.finite_full_cells_begin(); cell != triangulation_.finite_full_cells_end();
         ++cell) {
      for (int i = 0; i <= DIMENSION; ++i) sum.add_vertex(Peer::coordinates_of(cell->vertex(i)));
      sum.end_cell();
    }
    return sum.value();
  }
};

}  // namespace

int main(int argc, char** argv) { return rival::run_edits<CgalD>(argc, argv); }
