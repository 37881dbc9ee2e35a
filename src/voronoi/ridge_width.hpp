// SPDX-License-Identifier: BSD-3-Clause
// The width of a bounded ridge: the least distance within which all its vertices are from the flat of one of
// its facets. It is at least the width of a convex body as geometry has it, the least distance of two
// parallel hyperplanes (of the ridge's flat) with the ridge between them; for polygons and segments both are
// the same, because one of two such lines may be assumed to contain an edge (Toussaint 1983).
#pragma once

#include "kernel/distance_bound.hpp"
#include "kernel/width_test.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace delone::voronoi {

class RidgeWidth {
 public:
  /// Of ridges of dimension k − 1 whose vertices, d coordinates each, are correctly rounded. REQUIRES k ≥ 2.
  RidgeWidth(std::size_t k, std::size_t d) : k_(k), d_(d) {}

  /// Whether the width is certainly larger than `tolerance`. False for what is not so clear.
  bool is_wide(std::span<const double* const> vertices, double tolerance) {
    return test_.is_wide(vertices, k_ - 1, d_, tolerance);
  }
  /// At least the width of a polygon (k = 3), its vertices in cyclic order, or segment (k = 2).
  double bound(std::span<const double* const> vertices);
  /// At least the distance within which all vertices are from the flat of some of them, a facet. REQUIRES at
  /// least one vertex on the facet.
  double facet_bound(std::span<const double* const> vertices, std::span<const double* const> facet);

 private:
  std::size_t k_, d_;
  kernel::WidthTest test_;
  kernel::FlatDistance flat_;
  std::vector<const double*> independent_;
};

}  // namespace delone::voronoi
