// SPDX-License-Identifier: BSD-3-Clause
#include "compiled/compact_triangulation.hpp"

#include "compiled/queries.hpp"
#include "geometry/point_predicates.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace delone::compiled {
namespace {

/// k + 1 vertices and k + 1 neighbors per cell.
class CompactCells {
 public:
  explicit CompactCells(const Complex& complex)
      : dimension_(complex.affine_dimension()),
        num_cells_(complex.num_all_cells()),
        num_infinite_(complex.num_infinite_cells()) {
    links_.reserve(num_cells_ * stride());
    std::vector<Index> number(complex.num_cell_slots());
    Index next = 0;
    for (const CellId c : complex.all_cells()) number[index(c)] = next++;
    for (const CellId c : complex.all_cells()) {
      for (int i = 0; i <= dimension_; ++i) links_.push_back(index(complex.vertex(c, i)));
      for (int i = 0; i <= dimension_; ++i) links_.push_back(number[index(complex.neighbor(c, i))]);
    }
  }

  int dimension() const { return dimension_; }
  std::size_t stride() const { return 2 * (static_cast<std::size_t>(dimension_) + 1); }
  Index num_cells() const { return num_cells_; }
  Index num_infinite() const { return num_infinite_; }
  std::size_t bytes() const { return links_.capacity() * sizeof(Index); }

  const Index* vertices(Index cell) const { return links_.data() + cell * stride(); }
  const Index* vertices(Index cell, Index*) const { return vertices(cell); }
  const Index* neighbors(Index cell) const { return vertices(cell) + dimension_ + 1; }
  int infinite_slot(Index cell) const {
    for (int i = 0; i <= dimension_; ++i)
      if (vertices(cell)[i] == index(infinite_vertex)) return i;
    return -1;
  }
  Index num_slots() const { return num_cells_; }
  bool is_vacant(Index) const { return false; }
  void prefetch_neighbors(Index) const {}
  void prefetch_across_hull(Index) const {}

 private:
  int dimension_;
  Index num_cells_, num_infinite_;
  std::vector<Index> links_;
};

/// Has no functionals: values say nothing, and all is left to the exact stages.
class ExactGeometry : public geometry::PointPredicates<0> {
 public:
  using Query = geometry::PointQuery;

  ExactGeometry(const CompactCells& cells, const std::vector<int>& axes, const VertexPoints& points)
      : PointPredicates(axes, points.ambient, points.form, points.coordinates), cells_(cells) {}

  struct Evaluator {
    double value(Index) const { return std::numeric_limits<double>::quiet_NaN(); }
    double threshold(Index) const { return 0; }
    double error(Index, double) const { return std::numeric_limits<double>::infinity(); }
  };
  Evaluator evaluator(const Query&) const { return {}; }
  void thresholds_at(std::span<const Index> cells, const Query&, double* thresholds) const {
    std::fill_n(thresholds, cells.size(), 0.0);
  }
  bool proves_tie(Index, double, const Query&) const { return false; }
  bool is_infinite(Index cell) const { return cells_.infinite_slot(cell) >= 0; }

 private:
  const CompactCells& cells_;
};

class CompactTriangulationOfCells final : public CompactTriangulation {
 public:
  CompactTriangulationOfCells(const std::vector<int>& axes, const VertexPoints& points, CompactCells cells,
                              const geometry::Frame& frame, const engine::Effort& effort)
      : points_(points),
        cells_(std::move(cells)),
        geometry_(cells_, axes, points),
        frame_(frame),
        effort_(effort) {}

  std::unique_ptr<CompactTriangulation> copy(const VertexPoints& points) const override {
    return std::make_unique<CompactTriangulationOfCells>(geometry_.axes(), points, cells_, frame_, effort_);
  }

  const geometry::Frame& frame() const override { return frame_; }

  QueryLocation locate(const double* query, Index start) const override {
    const kernel::Grid grid = points_.grid_with(query);
    return compiled::locate(cells_, geometry_, {query, &grid, points_.ambient},
                            start == invalid_index ? 0 : start);
  }
  std::vector<CellId> conflict_zone(const double* query, Index start) const override {
    const kernel::Grid grid = points_.grid_with(query);
    const geometry::PointQuery q{query, &grid, static_cast<int>(points_.row_size())};
    return compiled::conflict_zone(cells_, geometry_, q, start == invalid_index ? 0 : start);
  }
  Sign unperturbed_side(Index cell, const double* query) const override {
    const kernel::Grid grid = points_.grid_with(query);
    return geometry_.unperturbed_side(cells_.vertices(cell), {query, &grid, points_.ambient});
  }

  Complex complex(Index num_vertices, std::span<const CellId> cell_of_vertex) const override {
    return {{cells_.vertices(0), cells_.stride(), false},
            cells_.dimension(),
            cells_.num_cells(),
            cells_.num_cells() - cells_.num_infinite(),
            cells_.num_infinite(),
            num_vertices,
            cell_of_vertex.data(),
            static_cast<Index>(cell_of_vertex.size())};
  }
  const engine::Effort& effort() const override { return effort_; }
  std::size_t bytes() const override { return cells_.bytes(); }

 private:
  const VertexPoints& points_;
  CompactCells cells_;
  ExactGeometry geometry_;
  geometry::Frame frame_;
  engine::Effort effort_;
};

}  // namespace

std::unique_ptr<CompactTriangulation> make_compact_triangulation(const std::vector<int>& axes,
                                                                 const VertexPoints& points,
                                                                 const TriangulationEngine& engine,
                                                                 const Complex& complex) {
  return std::make_unique<CompactTriangulationOfCells>(axes, points, CompactCells(complex), engine.frame(),
                                                       engine.effort());
}

}  // namespace delone::compiled
