// SPDX-License-Identifier: BSD-3-Clause
// Geogram's Delaunay triangulations of the plane and of space, from its single source file. Option: --method
// BDEL (the default for space, one thread), PDEL (several threads), BDEL2d (the plane).
#include "rival.hpp"

#include <Delaunay_psm.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace {

class Geogram {
 public:
  Geogram(const rival::Arguments& arguments, delone::PointTable&& table) : table_(std::move(table)) {
    if (table_.dimension != 2 && table_.dimension != 3)
      throw std::invalid_argument("this program is for points of the plane and of space");
    method_ = arguments.option("method", table_.dimension == 2 ? "BDEL2d" : "BDEL");
    GEO::initialize(GEO::GEOGRAM_INSTALL_NONE);
    GEO::Logger::instance()->set_quiet(true);
    GEO::CmdLine::import_arg_group("standard");
    GEO::CmdLine::import_arg_group("algo");
    reset();
  }

  rival::Program program() const { return {"Geogram", method_, DELONE_BENCHMARK_FLAGS}; }

  void construct() {
    delaunay_->set_vertices(static_cast<GEO::index_t>(table_.num_points()), table_.coordinates.data());
  }

  void reset() {
    delaunay_ = GEO::Delaunay::create(static_cast<GEO::coord_index_t>(table_.dimension), method_);
  }

  std::size_t num_cells() const { return delaunay_->nb_cells(); }

  rival::Cells cells() const {
    const auto size = static_cast<GEO::index_t>(table_.dimension) + 1;
    rival::Cells cells{static_cast<int>(size), {}};
    for (GEO::index_t cell = 0; cell < delaunay_->nb_cells(); ++cell)
      for (GEO::index_t i = 0; i < size; ++i) cells.rows.push_back(delaunay_->cell_vertex(cell, i));
    return cells;
  }

  nlohmann::json details() const { return nlohmann::json::object(); }

 private:
  delone::PointTable table_;
  std::string method_;
  GEO::Delaunay_var delaunay_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Geogram>(argc, argv); }
