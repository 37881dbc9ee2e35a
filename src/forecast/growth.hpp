// SPDX-License-Identifier: BSD-3-Clause
// How a construction grows beyond samples of its points: like the recorded kinds that have grown as the
// samples have.
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

struct Grown {
  Cost cost;
  double factor = 1.1;  ///< by which the number of cells may be wrong
};

/// What n points, of which `vertices` are distinct, cost, from samples of growing size in the same flat.
/// REQUIRES a sample with cells.
Grown grown(std::span<const SampleCost> samples, int d, double n, double vertices);

}  // namespace delone::cost_model
