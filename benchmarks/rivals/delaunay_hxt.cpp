// SPDX-License-Identifier: BSD-3-Clause
// HXT's Delaunay triangulation of space, from the sources of Gmsh. Option: --threads N (1; more where it is
// compiled with OpenMP).
#include "rival.hpp"
#include "rows_by_coordinates.hpp"

#include <hxt_mesh.h>
#include <hxt_tetDelaunay.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

void check(HXTStatus status) {
  if (status != HXT_STATUS_OK) throw std::runtime_error("HXT gives up, status " + std::to_string(status));
}

class Hxt {
 public:
  Hxt(const rival::Arguments& arguments, delone::PointTable&& table)
      : coordinates_(std::move(table.coordinates)), threads_(std::stoi(arguments.option("threads", "1"))) {
    if (table.dimension != 3) throw std::invalid_argument("this program is for points of space");
    make_mesh();
  }
  ~Hxt() { hxtMeshDelete(&mesh_); }
  Hxt(const Hxt&) = delete;
  Hxt& operator=(const Hxt&) = delete;

  rival::Program program() const { return {"HXT", "contrib/hxt of Gmsh", DELONE_BENCHMARK_FLAGS}; }

  void construct() {
    HXTDelaunayOptions options{};
    options.perfectDelaunay = 1;
    options.delaunayThreads = threads_;
    check(hxtDelaunay(mesh_, &options));
  }

  void reset() {
    check(hxtMeshDelete(&mesh_));
    make_mesh();
  }

  std::size_t num_cells() const {
    std::size_t count = 0;
    for_each_cell([&](std::span<const std::uint32_t>) { ++count; });
    return count;
  }

  rival::Cells cells() const {
    const rival::RowsByCoordinates row_of(coordinates_, 3);
    rival::Cells cells{4, {}};
    for_each_cell([&](std::span<const std::uint32_t> vertices) {
      for (const std::uint32_t v : vertices)
        cells.rows.push_back(row_of(std::span(mesh_->vertices.coord + 4 * std::size_t{v}, 3)));
    });
    return cells;
  }

  nlohmann::json details() const { return {{"vertices", mesh_->vertices.num}, {"threads", threads_}}; }

 private:
  /// A vertex has four numbers, of which HXT uses the last itself.
  void make_mesh() {
    const std::size_t count = coordinates_.size() / 3;
    check(hxtMeshCreate(&mesh_));
    check(hxtAlignedMalloc(&mesh_->vertices.coord, 4 * count * sizeof(double)));
    for (std::size_t row = 0; row < count; ++row)
      std::copy_n(&coordinates_[3 * row], 3, mesh_->vertices.coord + 4 * row);
    mesh_->vertices.num = mesh_->vertices.size = static_cast<std::uint32_t>(count);
  }

  /// The finite cells; the others have the ghost vertex.
  template <class F>
  void for_each_cell(F&& f) const {
    for (std::size_t cell = 0; cell < mesh_->tetrahedra.num; ++cell) {
      const std::span vertices(mesh_->tetrahedra.node + 4 * cell, 4);
      if (std::ranges::find(vertices, HXT_GHOST_VERTEX) == vertices.end()) f(vertices);
    }
  }

  std::vector<double> coordinates_;
  int threads_;
  HXTMesh* mesh_ = nullptr;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Hxt>(argc, argv); }
