// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation of the plane, edited. A single move and each of a time step is
// move_if_no_collision(); a time step goes through the vertices in their order in memory.
#include "edit.hpp"
#include "rows_by_coordinates.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <array>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel>;
using Point = Kernel::Point_2;
using Vertex = Triangulation::Vertex_handle;

Point to_point(std::span<const double> p) { return {p[0], p[1]}; }

class Cgal2 {
 public:
  Cgal2(const rival::Arguments&, int dimension) {
    if (dimension != 2) throw std::invalid_argument("this program is for points of the plane");
  }

  rival::Program program() const { return {"CGAL 2D", CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }

  void prepare(std::span<const double> coordinates) {
    coordinates_.assign(coordinates.begin(), coordinates.end());
    for (std::size_t i = 0; i < coordinates.size(); i += 2)
      points_.push_back(to_point(coordinates.subspan(i, 2)));
  }
  void build() { triangulation_.insert(points_.begin(), points_.end()); }

  void find_vertices() {
    if (triangulation_.number_of_vertices() != points_.size())
      throw std::invalid_argument("this program is for distinct points");
    const rival::RowsByCoordinates row_of(std::move(coordinates_), 2);
    vertices_.resize(points_.size());
    for (const Vertex v : triangulation_.finite_vertex_handles())
      vertices_[static_cast<std::size_t>(row_of(std::array{v->point().x(), v->point().y()}))] = v;
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
      std::vector<Vertex> neighbors;
      auto neighbor = triangulation_.incident_vertices(v);
      const auto first = neighbor;
      do {
        if (!triangulation_.is_infinite(neighbor)) neighbors.push_back(neighbor);
      } while (++neighbor != first);
      hints_.push_back(rival::nearest_that_stays(
          neighbors, [&](Vertex u) { return gone.contains(u); },
          [&](Vertex u) { return CGAL::squared_distance(u->point(), v->point()); }, any));
    }
  }

  void remove(std::size_t row) { triangulation_.remove(vertices_[row]); }
  void insert(std::size_t number, std::size_t row, std::span<const double> point) {
    vertices_[row] = triangulation_.insert(to_point(point), hints_[number]->face());
  }
  void move(std::size_t row, std::span<const double> point) {
    vertices_[row] = triangulation_.move_if_no_collision(vertices_[row], to_point(point));
  }

  void prepare_time_step(std::span<const double> coordinates) {
    for (std::size_t row = 0; row < vertices_.size(); ++row)
      targets_.emplace_back(vertices_[row], to_point(coordinates.subspan(2 * row, 2)));
    std::sort(targets_.begin(), targets_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  void time_step() {
    for (const auto& [vertex, point] : targets_) triangulation_.move_if_no_collision(vertex, point);
  }

  std::size_t num_cells() const { return triangulation_.number_of_faces(); }
  std::uint64_t checksum() const {
    rival::Checksum sum;
    for (const auto& face : triangulation_.finite_face_handles()) {
      for (int i = 0; i < 3; ++i)
        sum.add_vertex(std::array{face->vertex(i)->point().x(), face->vertex(i)->point().y()});
      sum.end_cell();
    }
    return sum.value();
  }

 private:
  std::vector<double> coordinates_;  ///< until the vertices have been found
  std::vector<Point> points_;
  Triangulation triangulation_;
  std::vector<Vertex> vertices_, hints_;
  std::vector<std::pair<Vertex, Point>> targets_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run_edits<Cgal2>(argc, argv); }
