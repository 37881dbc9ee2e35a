// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/model/tiles_share.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace delone::cost_model {

double inner_faces(int k, double num_tiles) { return std::min(2.0 * k, std::log2(num_tiles)); }

double foreign_per_face(int k) {
  constexpr std::array<double, 7> factors{0, 1, 1.1, 1.3, 1.6, 2.5, 3.5};
  return factors[std::min(static_cast<std::size_t>(std::max(k, 0)), factors.size() - 1)];
}

bool tiles_pay(int k, double points, double bytes, double memory) {
  constexpr double least_own = 100;
  if (k < 1) return false;
  for (double tiles = 2; points / tiles >= least_own; tiles *= 1.25) {
    const double own = points / tiles,
                 share = foreign_per_face(k) * inner_faces(k, tiles) * std::pow(own, -1.0 / k);
    if (share > 1) return false;  // it only grows
    if (bytes / tiles * (1 + share) <= memory) return true;
  }
  return false;
}

}  // namespace delone::cost_model
