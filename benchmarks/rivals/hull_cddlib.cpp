// SPDX-License-Identifier: BSD-3-Clause
// cddlib's double description of the polytope that the points generate, in floating point or, with
// GMPRATIONAL, exactly.
#include "rival.hpp"

#include <setoper.h>  // cdd.h needs it before

#include <cdd.h>

#ifdef GMPRATIONAL
#include <gmp.h>
#endif

#include <stdexcept>
#include <string>

namespace {

class Cddlib {
 public:
  Cddlib(const rival::Arguments&, delone::PointTable&& table)
      : dimension_(table.dimension), num_points_(table.num_points()) {
    dd_set_global_constants();
    generators_ = dd_CreateMatrix(static_cast<dd_rowrange>(num_points_), dimension_ + 1);
    generators_->representation = dd_Generator;
    const double* x = table.coordinates.data();
    for (dd_rowrange row = 0; row < generators_->rowsize; ++row) {
      dd_set_si(generators_->matrix[row][0], 1);
      for (int axis = 0; axis < dimension_; ++axis) dd_set_d(generators_->matrix[row][axis + 1], *x++);
    }
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

  std::size_t num_cells() const { return static_cast<std::size_t>(inequalities_->rowsize); }

  rival::Cells cells() const {
    rival::Cells cells{dimension_, {}};
    dd_SetFamilyPtr incidence = dd_CopyIncidence(polyhedron_);
    for (dd_rowrange row = 0; row < inequalities_->rowsize; ++row) {
      if (set_card(incidence->set[row]) != dimension_) {
        dd_FreeSetFamily(incidence);
        throw std::runtime_error("a facet is no simplex");
      }
      for (std::size_t point = 0; point < num_points_; ++point)
        if (set_member(static_cast<long>(point) + 1, incidence->set[row]))
          cells.rows.push_back(static_cast<std::int64_t>(point));
    }
    dd_FreeSetFamily(incidence);
    return cells;
  }

  nlohmann::json details() const { return {{"facets", num_cells()}}; }

 private:
  int dimension_;
  std::size_t num_points_;
  dd_MatrixPtr generators_ = nullptr;
  dd_PolyhedraPtr polyhedron_ = nullptr;
  dd_MatrixPtr inequalities_ = nullptr;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Cddlib>(argc, argv); }
