// SPDX-License-Identifier: BSD-3-Clause
#include "compiled/compact_triangulation.hpp"

#include "compiled/queries.hpp"
#include "geometry/point_predicates.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace delone::compiled {

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
  Complex::Links links_of_complex() const { return {links_.data(), stride(), false}; }
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
  Query make_query(const double* at, const kernel::Grid& grid) const {
    return {at, &grid, flat().row_size()};
  }
  Evaluator evaluator(const Query&) const { return {}; }
  void thresholds_at(std::span<const Index> cells, const Query&, double* thresholds) const {
    std::fill_n(thresholds, cells.size(), 0.0);
  }
  bool proves_tie(Index, double, const Query&) const { return false; }
  bool is_infinite(Index cell) const { return cells_.infinite_slot(cell) >= 0; }

 private:
  const CompactCells& cells_;
};

/// What queries.hpp asks for.
struct CompactTriangulation::Held {
  Held(const std::vector<int>& axes, const VertexPoints& points, CompactCells cells,
       const geometry::Frame& frame, const engine::Effort& effort)
      : points_(points),
        cells_(std::move(cells)),
        geometry_(cells_, axes, points),
        frame_(frame),
        effort_(effort) {}

  const CompactCells& cells() const { return cells_; }
  const ExactGeometry& geometry() const { return geometry_; }
  const VertexPoints& points() const { return points_; }
  Index num_infinite() const { return cells_.num_infinite(); }
  Index first_cell() const { return 0; }

  const VertexPoints& points_;
  CompactCells cells_;
  ExactGeometry geometry_;
  geometry::Frame frame_;
  engine::Effort effort_;
};

CompactTriangulation::CompactTriangulation(const std::vector<int>& axes, const VertexPoints& points,
                                           const TriangulationEngine& engine, const Complex& complex)
    : held_(
          std::make_unique<Held>(axes, points, CompactCells(complex), frame_of(engine), effort_of(engine))) {}

CompactTriangulation::CompactTriangulation(const VertexPoints& points, const CompactTriangulation& other)
    : held_(std::make_unique<Held>(other.held_->geometry_.axes(), points, other.held_->cells_,
                                   other.held_->frame_, other.held_->effort_)) {}

CompactTriangulation::~CompactTriangulation() = default;

const geometry::Frame& frame_of(const CompactTriangulation& compact) { return compact.held().frame_; }
const engine::Effort& effort_of(const CompactTriangulation& compact) { return compact.held().effort_; }
std::size_t bytes_of(const CompactTriangulation& compact) { return compact.held().cells().bytes(); }

Complex complex_of(const CompactTriangulation& compact, Index num_vertices,
                   std::span<const CellId> cell_of_vertex) {
  return complex_in(compact.held(), num_vertices, cell_of_vertex);
}
QueryLocation locate(const CompactTriangulation& compact, const double* query, Index start) {
  return locate_in(compact.held(), query, start);
}
std::vector<CellId> conflict_zone(const CompactTriangulation& compact, const double* query, Index start) {
  return conflict_zone_in(compact.held(), query, start);
}
Sign unperturbed_side(const CompactTriangulation& compact, Index cell, const double* query) {
  return unperturbed_side_in(compact.held(), cell, query);
}

}  // namespace delone::compiled
