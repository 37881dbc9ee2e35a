// SPDX-License-Identifier: BSD-3-Clause
// CGAL's Delaunay triangulation of space, points given at once (which sorts them spatially). With
// CGAL_LINKED_WITH_TBB the parallel one; option: --threads N.
#include "rival.hpp"
#include "rows_by_coordinates.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_3.h>
#include <CGAL/version.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <array>
#include <memory>
#include <stdexcept>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
#ifdef CGAL_LINKED_WITH_TBB
using Concurrency = CGAL::Parallel_tag;
constexpr const char* name = "CGAL 3D parallel";
#else
using Concurrency = CGAL::Sequential_tag;
constexpr const char* name = "CGAL 3D";
#endif
using Structure =
    CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                         CGAL::Delaunay_triangulation_cell_base_3<Kernel>, Concurrency>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

class Cgal3 {
 public:
  Cgal3(const rival::Arguments& arguments, delone::PointTable&& table)
      : threads_(std::stoul(arguments.option("threads", "2"))) {
    if (table.dimension != 3) throw std::invalid_argument("this program is for points of space");
    for (std::size_t row = 0; row < table.num_points(); ++row) {
      const double* p = &table.coordinates[3 * row];
      points_.emplace_back(p[0], p[1], p[2]);
    }
    for (const auto& point : points_) box_ += point.bbox();
    if (!arguments.cells.empty()) coordinates_ = std::move(table.coordinates);
#ifdef CGAL_LINKED_WITH_TBB
    limit_ = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads_);
#endif
  }

  rival::Program program() const { return {name, CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }

  void construct() {
#ifdef CGAL_LINKED_WITH_TBB
    locks_ = std::make_unique<Triangulation::Lock_data_structure>(box_, 50);
    triangulation_ = std::make_unique<Triangulation>(points_.begin(), points_.end(), locks_.get());
#else
    triangulation_ = std::make_unique<Triangulation>(points_.begin(), points_.end());
#endif
  }

  void reset() { triangulation_.reset(); }

  /// Points that span less than space are triangulated in their plane or on their line.
  std::size_t num_cells() const {
    switch (triangulation_->dimension()) {
      case 3:
        return triangulation_->number_of_finite_cells();
      case 2:
        return triangulation_->number_of_finite_facets();
      case 1:
        return triangulation_->number_of_finite_edges();
      default:
        return triangulation_->number_of_vertices();
    }
  }

  rival::Cells cells() const {
    const rival::RowsByCoordinates row_of(coordinates_, 3);
    const int dimension = triangulation_->dimension();
    rival::Cells cells{dimension + 1, {}};
    const auto add = [&](const auto& cell) {
      for (int i = 0; i <= dimension; ++i) {
        const auto& p = cell->vertex(i)->point();
        cells.rows.push_back(row_of(std::array{p.x(), p.y(), p.z()}));
      }
    };
    // The vertices of a face of less dimension are the first of those of the cell that stands for it.
    if (dimension == 3)
      for (const auto& cell : triangulation_->finite_cell_handles()) add(cell);
    else if (dimension == 2)
      for (const auto& facet : triangulation_->finite_facets()) add(facet.first);
    else if (dimension == 1)
      for (const auto& edge : triangulation_->finite_edges()) add(edge.first);
    else
      throw std::runtime_error("a triangulation of less than two points is not written");
    return cells;
  }

  nlohmann::json details() const {
    nlohmann::json details = {{"vertices", triangulation_->number_of_vertices()}};
#ifdef CGAL_LINKED_WITH_TBB
    details["threads"] = threads_;
#endif
    return details;
  }

 private:
  std::vector<Kernel::Point_3> points_;
  std::vector<double> coordinates_;  ///< kept only where cells are written
  CGAL::Bbox_3 box_;
  std::size_t threads_;
#ifdef CGAL_LINKED_WITH_TBB
  std::unique_ptr<tbb::global_control> limit_;
  std::unique_ptr<Triangulation::Lock_data_structure> locks_;
#endif
  std::unique_ptr<Triangulation> triangulation_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Cgal3>(argc, argv); }
