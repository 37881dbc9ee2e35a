// SPDX-License-Identifier: BSD-3-Clause
// CGAL's convex hull with exact predicates: quickhull in space; in DIMENSION 4 and above a triangulation of
// the points, which is what CGAL offers there, whose infinite cells are the facets of the hull (and which has
// to triangulate the inside, too).
#include "rival.hpp"
#include "rows_by_coordinates.hpp"

#include <CGAL/version.h>
#if DIMENSION == 3
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#else
#include <CGAL/Epick_d.h>
#include <CGAL/Triangulation.h>
#endif

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

#if DIMENSION == 3
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Hull = CGAL::Surface_mesh<Point>;
#else
using Hull = CGAL::Triangulation<CGAL::Epick_d<CGAL::Dimension_tag<DIMENSION> > >;
using Point = Hull::Point;
#endif

class Cgal {
 public:
  Cgal(const rival::Arguments& arguments, delone::PointTable&& table) {
    if (table.dimension != DIMENSION)
      throw std::invalid_argument("this program is for points of dimension " + std::to_string(DIMENSION));
    points_.reserve(table.num_points());
    for (std::size_t row = 0; row < table.num_points(); ++row) {
      const double* p = table.coordinates.data() + DIMENSION * row;
#if DIMENSION == 3
      points_.emplace_back(p[0], p[1], p[2]);
#else
      points_.emplace_back(p, p + DIMENSION);
#endif
    }
    if (!arguments.cells.empty()) coordinates_ = std::move(table.coordinates);
  }

#if DIMENSION == 3
  rival::Program program() const { return {"CGAL 3D", CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }
  void construct() {
    hull_ = std::make_unique<Hull>();
    CGAL::convex_hull_3(points_.begin(), points_.end(), *hull_);
  }
  std::size_t num_cells() const { return hull_->number_of_faces(); }
#else
  rival::Program program() const { return {"CGAL dD", CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }
  void construct() {
    hull_ = std::make_unique<Hull>(DIMENSION);
    hull_->insert(points_.begin(), points_.end());
  }
  std::size_t num_cells() const { return hull_cells().size(); }
#endif
  void reset() { hull_.reset(); }

  rival::Cells cells() const {
    const rival::RowsByCoordinates row_of(coordinates_, DIMENSION);
    rival::Cells cells{DIMENSION, {}};
    std::vector<double> point(DIMENSION);
    const auto add = [&](const Point& p) {
      for (int axis = 0; axis < DIMENSION; ++axis) point[static_cast<std::size_t>(axis)] = p[axis];
      cells.rows.push_back(row_of(point));
    };
#if DIMENSION == 3
    for (const auto face : hull_->faces())
      for (const auto vertex : hull_->vertices_around_face(hull_->halfedge(face))) add(hull_->point(vertex));
#else
    for (const auto cell : hull_cells())
      for (int i = 0; i <= DIMENSION; ++i)
        if (!hull_->is_infinite(cell->vertex(i))) add(cell->vertex(i)->point());
#endif
    return cells;
  }

  nlohmann::json details() const { return {{"facets", num_cells()}}; }

 private:
#if DIMENSION > 3
  std::vector<Hull::Full_cell_const_handle> hull_cells() const {
    std::vector<Hull::Full_cell_const_handle> found;
    for (auto cell = hull_->full_cells_begin(); cell != hull_->full_cells_end(); ++cell)
      if (hull_->is_infinite(cell)) found.push_back(cell);
    return found;
  }
#endif

  std::vector<Point> points_;
  std::vector<double> coordinates_;  ///< kept only where cells are written
  std::unique_ptr<Hull> hull_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Cgal>(argc, argv); }
