// SPDX-License-Identifier: BSD-3-Clause
// How a construction grows beyond samples of its points: what the samples show, beside points that are spread
// evenly.
#pragma once

#include "forecast/model/cost.hpp"

#include <span>

namespace delone::cost_model {

/// A construction of some of the points.
struct SampleCost {
  double points = 0;
  int affine_dimension = 0;
  double cells = 0, infinite_cells = 0, created_cells = 0, seconds = 0;
  bool is_hard = false;  ///< many signs took exact arithmetic
};

/// The number of cells of the whole.
struct GrownCells {
  double cells = 0;
  double factor = 1.1;  ///< by which it may be wrong
};

/// Of `vertices` distinct points, from samples of growing size in one flat. REQUIRES a sample with cells.
GrownCells grown_cells(std::span<const SampleCost> samples, double vertices);

/// What n points in d dimensions cost, `vertices` of them distinct, if they have this number of cells.
/// REQUIRES a sample with cells.
Cost grown_cost(std::span<const SampleCost> samples, int d, double n, double vertices, double cells);

}  // namespace delone::cost_model
