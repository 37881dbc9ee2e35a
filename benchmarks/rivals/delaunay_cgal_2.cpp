// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation of the plane, points given at once (which sorts them spatially).
#include "rival.hpp"
#include "rows_by_coordinates.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <array>
#include <stdexcept>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

class Cgal2 {
 public:
  Cgal2(const rival::Arguments& arguments, delone::PointTable&& table) {
    if (table.dimension != 2) throw std::invalid_argument("this program is for points of the plane");
    for (std::size_t row = 0; row < table.num_points(); ++row)
      points_.emplace_back(table.coordinates[2 * row], table.coordinates[2 * row + 1]);
    if (!arguments.cells.empty()) coordinates_ = std::move(table.coordinates);
  }

  rival::Program program() const { return {"CGAL 2D", CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }
  void construct() { triangulation_.insert(points_.begin(), points_.end()); }
  void reset() { triangulation_.clear(); }
  std::size_t num_cells() const { return triangulation_.number_of_faces(); }

  rival::Cells cells() const {
    const rival::RowsByCoordinates row_of(coordinates_, 2);
    rival::Cells cells{3, {}};
    for (const auto& face : triangulation_.finite_face_handles())
      for (int i = 0; i < 3; ++i) {
        const auto& p = face->vertex(i)->point();
        cells.rows.push_back(row_of(std::array{p.x(), p.y()}));
      }
    return cells;
  }

  nlohmann::json details() const { return {{"vertices", triangulation_.number_of_vertices()}}; }

 private:
  std::vector<Kernel::Point_2> points_;
  std::vector<double> coordinates_;  ///< kept only where cells are written
  CGAL::Delaunay_triangulation_2<Kernel> triangulation_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Cgal2>(argc, argv); }
