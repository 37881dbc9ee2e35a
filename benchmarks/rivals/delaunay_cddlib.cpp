// SPDX-License-Identifier: BSD-3-Clause
// cddlib's double description of the lifted points, in floating point or, with GMPRATIONAL, exactly. The
// points (x, |x|²) and the upward direction generate a polyhedron whose facets that are not vertical are the
// cells. The squared norm is rounded in the first case and exact in the second.
#include "rival.hpp"

#include <setoper.h>  // cdd.h needs it before

#include <cdd.h>

#ifdef GMPRATIONAL
#include <gmp.h>
#endif

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

class Cddlib {
 public:
  Cddlib(const rival::Arguments&, delone::PointTable&& table)
      : dimension_(table.dimension), num_points_(table.num_points()) {
    dd_set_global_constants();
    const auto n = static_cast<dd_rowrange>(num_points_);
    generators_ = dd_CreateMatrix(n + 1, dimension_ + 2);
    generators_->representation = dd_Generator;
    dd_Arow square{};
    dd_InitializeArow(2, &square);
    std::set<std::vector<double>> seen;
    for (dd_rowrange row = 0; row < n; ++row) {
      const auto point = table.coordinates.begin() + static_cast<std::ptrdiff_t>(row) * dimension_;
      repeated_.push_back(!seen.emplace(point, point + dimension_).second);
      mytype* out = generators_->matrix[row];
      dd_set_si(out[0], 1);
      dd_set(out[dimension_ + 1], dd_purezero);
      for (int axis = 0; axis < dimension_; ++axis) {
        dd_set_d(out[axis + 1], point[axis]);
        dd_mul(square[0], out[axis + 1], out[axis + 1]);
        dd_add(out[dimension_ + 1], out[dimension_ + 1], square[0]);
      }
    }
    dd_FreeArow(2, square);
    for (int column = 0; column <= dimension_; ++column) dd_set(generators_->matrix[n][column], dd_purezero);
    dd_set_si(generators_->matrix[n][dimension_ + 1], 1);
  }

  ~Cddlib() {
    reset();
    dd_FreeMatrix(generators_);
    dd_free_global_constants();
  }
  Cddlib(const Cddlib&) = delete;
  Cddlib& operator=(const Cddlib&) = delete;

  rival::Program program() const {
#ifdef GMPRATIONAL
    return {"cddlib GMP", dd_DDVERSION, DELONE_BENCHMARK_FLAGS};
#else
    return {"cddlib", dd_DDVERSION, DELONE_BENCHMARK_FLAGS};
#endif
  }

  void construct() {
    dd_ErrorType error = dd_NoError;
    polyhedron_ = dd_DDMatrix2Poly(generators_, &error);
    if (error != dd_NoError)
      throw std::runtime_error("cddlib gave up with error " + std::to_string(static_cast<int>(error)));
    inequalities_ = dd_CopyInequalities(polyhedron_);
  }

  void reset() {
    if (inequalities_) dd_FreeMatrix(inequalities_);
    if (polyhedron_) dd_FreePolyhedra(polyhedron_);
    inequalities_ = nullptr;
    polyhedron_ = nullptr;
  }

  std::size_t num_cells() const {
    std::size_t count = 0;
    for (dd_rowrange row = 0; row < inequalities_->rowsize; ++row) count += is_cell(row);
    return count;
  }

  /// For points that span less than their space, each equation lowers the size of a cell by one; equal points
  /// stand for the first of them.
  rival::Cells cells() const {
    const int size = dimension_ + 1 - static_cast<int>(set_card(inequalities_->linset));
    rival::Cells cells{size, {}};
    dd_SetFamilyPtr incidence = dd_CopyIncidence(polyhedron_);
    for (dd_rowrange row = 0; row < inequalities_->rowsize; ++row) {
      if (!is_cell(row)) continue;
      const std::size_t before = cells.rows.size();
      for (std::size_t point = 0; point < num_points_; ++point)
        if (!repeated_[point] && set_member(static_cast<long>(point) + 1, incidence->set[row]))
          cells.rows.push_back(static_cast<std::int64_t>(point));
      if (cells.rows.size() - before != static_cast<std::size_t>(size)) {
        dd_FreeSetFamily(incidence);
        throw std::runtime_error("a cell is no simplex");
      }
    }
    dd_FreeSetFamily(incidence);
    return cells;
  }

  nlohmann::json details() const { return nlohmann::json::object(); }

 private:
  /// Not vertical: the coefficient of the last coordinate is not zero.
  bool is_cell(dd_rowrange row) const { return dd_Nonzero(inequalities_->matrix[row][dimension_ + 1]) != 0; }

  int dimension_;
  std::size_t num_points_;
  std::vector<bool> repeated_;  ///< equal to a point before it
  dd_MatrixPtr generators_ = nullptr;
  dd_PolyhedraPtr polyhedron_ = nullptr;
  dd_MatrixPtr inequalities_ = nullptr;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Cddlib>(argc, argv); }
