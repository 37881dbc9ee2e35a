// SPDX-License-Identifier: BSD-3-Clause
// cddlib's double description of many small polyhedra, one after the other, in rational numbers. The file has
// rows (a, b) of a·x ≤ b, and --rows says how many each polyhedron has. "cells" are the generators of all.
#include "rival.hpp"

#include <setoper.h>  // cdd.h needs it before

#include <cdd.h>

#include <gmp.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace {

class Cddlib {
 public:
  Cddlib(const rival::Arguments& arguments, delone::PointTable&& table) {
    const auto rows = static_cast<std::size_t>(std::stoul(arguments.option("rows", "8")));
    const int d = table.dimension - 1;
    if (rows == 0 || table.num_points() % rows != 0) throw std::invalid_argument("--rows: not of this file");
    dd_set_global_constants();
    const double* x = table.coordinates.data();
    for (std::size_t i = 0; i < table.num_points() / rows; ++i) {
      systems_.push_back(dd_CreateMatrix(static_cast<dd_rowrange>(rows), d + 1));
      systems_.back()->representation = dd_Inequality;
      systems_.back()->numbtype = dd_Rational;
      for (std::size_t row = 0; row < rows; ++row) {
        for (int c = 1; c <= d; ++c) dd_set_d(systems_.back()->matrix[row][c], -*x++);
        dd_set_d(systems_.back()->matrix[row][0], *x++);
      }
    }
  }

  ~Cddlib() {
    for (const dd_MatrixPtr system : systems_) dd_FreeMatrix(system);
    dd_free_global_constants();
  }
  Cddlib(const Cddlib&) = delete;
  Cddlib& operator=(const Cddlib&) = delete;

  rival::Program program() const { return {"cddlib GMP", dd_DDVERSION, DELONE_BENCHMARK_FLAGS}; }

  void construct() {
    for (const dd_MatrixPtr system : systems_) {
      dd_ErrorType error = dd_NoError;
      const dd_PolyhedraPtr polyhedron = dd_DDMatrix2Poly(system, &error);
      if (error != dd_NoError)
        throw std::runtime_error("cddlib gave up with error " + std::to_string(static_cast<int>(error)));
      const dd_MatrixPtr generators = dd_CopyGenerators(polyhedron);
      num_generators_ += static_cast<std::size_t>(generators->rowsize);
      dd_FreeMatrix(generators);
      dd_FreePolyhedra(polyhedron);
    }
  }
  void reset() { num_generators_ = 0; }

  std::size_t num_cells() const { return num_generators_; }
  rival::Cells cells() const { return {}; }
  nlohmann::json details() const { return {{"polyhedra", systems_.size()}}; }

 private:
  std::vector<dd_MatrixPtr> systems_;
  std::size_t num_generators_ = 0;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Cddlib>(argc, argv); }
