// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation in any dimension, edited, with the dimension compiled in (DIMENSION). It has
// no moves: a vertex that moves is removed, and inserted from the cell that the removal returns.
#include "edit.hpp"
#include "rows_by_coordinates.hpp"

#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Epick_d.h>
#include <CGAL/version.h>

#include <array>
#include <iterator>

namespace {

using Kernel = CGAL::Epick_d<CGAL::Dimension_tag<DIMENSION>>;
using Triangulation = CGAL::Delaunay_triangulation<Kernel>;
using Point = Triangulation::Point;
using Vertex = Triangulation::Vertex_handle;
using Cell = Triangulation::Full_cell_handle;

Point to_point(std::span<const double> p) { return Point(p.begin(), p.end()); }
std::array<double, DIMENSION> coordinates_of(Vertex v) {
  std::array<double, DIMENSION> coordinates{};
  for (int axis = 0; axis < DIMENSION; ++axis) coordinates[static_cast<std::size_t>(axis)] = v->point()[axis];
  return coordinates;
}

class CgalD {
 public:
  CgalD(const rival::Arguments&, int dimension) : triangulation_(DIMENSION) {
    if (dimension != DIMENSION)
      throw std::invalid_argument("this program is for points of dimension " + std::to_string(DIMENSION));
  }

  rival::Program program() const { return {"CGAL dD", CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }

  void prepare(std::span<const double> coordinates) {
    coordinates_.assign(coordinates.begin(), coordinates.end());
    for (std::size_t i = 0; i < coordinates.size(); i += DIMENSION)
      points_.push_back(to_point(coordinates.subspan(i, DIMENSION)));
  }
  void build() { triangulation_.insert(points_.begin(), points_.end()); }

  void find_vertices() {
    if (triangulation_.number_of_vertices() != points_.size())
      throw std::invalid_argument("this program is for distinct points");
    const rival::RowsByCoordinates row_of(std::move(coordinates_), DIMENSION);
    vertices_.resize(points_.size());
    for (auto v = triangulation_.vertices_begin(); v != triangulation_.vertices_end(); ++v)
      if (!triangulation_.is_infinite(v)) vertices_[static_cast<std::size_t>(row_of(coordinates_of(v)))] = v;
  }

  void find_hints(std::span<const std::size_t> rows) {
    std::set<Vertex> gone;
    for (const std::size_t row : rows) gone.insert(vertices_[row]);
    Vertex any = vertices_[0];
    for (const Vertex v : vertices_)
      if (!gone.contains(v)) any = v;
    hints_.clear();
    for (const std::size_t row : rows) {
      const Vertex v = vertices_[row];
      std::vector<Cell> star;
      triangulation_.incident_full_cells(v, std::back_inserter(star));
      std::set<Vertex> neighbors;
      for (const Cell cell : star)
        for (int i = 0; i <= DIMENSION; ++i)
          if (const Vertex u = cell->vertex(i); u != v && !triangulation_.is_infinite(u)) neighbors.insert(u);
      hints_.push_back(rival::nearest_that_stays(
          neighbors, [&](Vertex u) { return gone.contains(u); },
          [&](Vertex u) { return rival::squared_distance(coordinates_of(u), coordinates_of(v)); }, any));
    }
  }

  void remove(std::size_t row) { triangulation_.remove(vertices_[row]); }
  void insert(std::size_t number, std::size_t row, std::span<const double> point) {
    vertices_[row] = triangulation_.insert(to_point(point), hints_[number]);
  }
  void move(std::size_t row, std::span<const double> point) {
    const Cell near = triangulation_.remove(vertices_[row]);
    vertices_[row] = triangulation_.insert(to_point(point), near);
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
      for (int i = 0; i <= DIMENSION; ++i) sum.add_vertex(coordinates_of(cell->vertex(i)));
      sum.end_cell();
    }
    return sum.value();
  }

 private:
  std::vector<double> coordinates_;  ///< until the vertices have been found
  std::vector<Point> points_;
  Triangulation triangulation_;
  std::vector<Vertex> vertices_, hints_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run_edits<CgalD>(argc, argv); }
