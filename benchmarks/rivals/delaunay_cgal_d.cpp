// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation in any dimension, which grew out of the program of the report, with the
// dimension compiled in (DIMENSION) and exact predicates; points given at once (which sorts them spatially).
#include "rival.hpp"
#include "rows_by_coordinates.hpp"

#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Epick_d.h>
#include <CGAL/version.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace {

using Kernel = CGAL::Epick_d<CGAL::Dimension_tag<DIMENSION>>;
using Triangulation = CGAL::Delaunay_triangulation<Kernel>;

class CgalD {
 public:
  CgalD(const rival::Arguments& arguments, delone::PointTable&& table) {
    if (table.dimension != DIMENSION)
      throw std::invalid_argument("this program is for points of dimension " + std::to_string(DIMENSION));
    points_.reserve(table.num_points());
    for (std::size_t row = 0; row < table.num_points(); ++row) {
      const double* p = table.coordinates.data() + DIMENSION * row;
      points_.emplace_back(p, p + DIMENSION);
    }
    if (!arguments.cells.empty()) coordinates_ = std::move(table.coordinates);
  }

  rival::Program program() const { return {"CGAL dD", CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }

  void construct() {
    triangulation_ = std::make_unique<Triangulation>(DIMENSION);
    triangulation_->insert(points_.begin(), points_.end());
  }

  void reset() { triangulation_.reset(); }

  std::size_t num_cells() const {
    std::size_t count = 0;
    for (auto cell = triangulation_->finite_full_cells_begin();
         cell != triangulation_->finite_full_cells_end(); ++cell)
      ++count;
    return count;
  }

  rival::Cells cells() const {
    const rival::RowsByCoordinates row_of(coordinates_, DIMENSION);
    const int size = triangulation_->current_dimension() + 1;
    rival::Cells cells{size, {}};
    std::vector<double> point(DIMENSION);
    for (auto cell = triangulation_->finite_full_cells_begin();
         cell != triangulation_->finite_full_cells_end(); ++cell)
      for (int i = 0; i < size; ++i) {
        const auto& p = cell->vertex(i)->point();
        for (int axis = 0; axis < DIMENSION; ++axis) point[static_cast<std::size_t>(axis)] = p[axis];
        cells.rows.push_back(row_of(point));
      }
    return cells;
  }

  nlohmann::json details() const {
    return {{"vertices", triangulation_->number_of_vertices()},
            {"affine_dimension", triangulation_->current_dimension()}};
  }

 private:
  std::vector<Triangulation::Point> points_;
  std::vector<double> coordinates_;  ///< kept only where cells are written
  std::unique_ptr<Triangulation> triangulation_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<CgalD>(argc, argv); }
