// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/ridge_width.hpp"

#include "kernel/linear_bound.hpp"
#include "voronoi/roundoff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::voronoi {

double RidgeWidth::bound(std::span<const double* const> vertices) {
  double width = std::numeric_limits<double>::infinity();
  if (k_ == 2) return kernel::distance_bound(vertices[0], vertices[1], d_, u);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double* const edge[2] = {vertices[v], vertices[(v + 1) % vertices.size()]};
    if (std::equal(edge[0], edge[0] + d_, edge[1])) continue;
    width = std::min(width, facet_bound(vertices, edge));
  }
  return width;
}

double RidgeWidth::facet_bound(std::span<const double* const> vertices,
                               std::span<const double* const> facet) {
  // The vertices of the facet farthest from each other, in a canonical order, span it best; the others are
  // within rounding errors of their flat. Which ones are taken only affects how sharp the bound is.
  independent_.assign(facet.begin(), facet.end());
  std::sort(independent_.begin(), independent_.end(), [&](const double* p, const double* q) {
    return std::lexicographical_compare(p, p + d_, q, q + d_);
  });
  std::size_t known = 1;
  while (known < independent_.size() && known + 1 < k_) {
    flat_.set_flat({independent_.data(), known}, d_, kernel::unit_roundoff);
    double most = 0;
    std::size_t farthest = known;
    for (std::size_t v = known; v < independent_.size(); ++v)
      if (const double distance = flat_.bound(independent_[v]); distance > most) {
        most = distance;
        farthest = v;
      }
    std::swap(independent_[known++], independent_[farthest]);
  }
  independent_.resize(known);
  flat_.set_flat(independent_, d_, kernel::unit_roundoff);
  double extent = 0;
  for (const double* v : vertices) {
    if (std::find(independent_.begin(), independent_.end(), v) != independent_.end()) continue;
    const double distance = flat_.bound(v);
    if (!(distance <= extent)) extent = distance;
    if (!(extent < std::numeric_limits<double>::infinity())) return extent;
  }
  return extent;
}

}  // namespace delone::voronoi
