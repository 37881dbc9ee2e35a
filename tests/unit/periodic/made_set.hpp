// SPDX-License-Identifier: BSD-3-Clause
// Periodic sets of points in the order of their rows, and of weights if there are some.
#pragma once

#include "periodic/periodic_set.hpp"

#include <cstddef>
#include <vector>

namespace delone::periodic {

inline PeriodicSet set_of(const std::vector<double>& points, const std::vector<double>& lattice,
                          std::size_t dimension, const std::vector<double>& weights = {}) {
  SetInput input;
  input.points = points;
  input.weights = weights;
  input.lattice = lattice;
  input.dimension = dimension;
  input.is_weighted = !weights.empty();
  return make_periodic_set(input);
}

}  // namespace delone::periodic
