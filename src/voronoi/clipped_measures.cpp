// SPDX-License-Identifier: BSD-3-Clause
// Volume, centroid and facets of a clipped region, and which of its facets are proper ones.
#include "voronoi/region_clipper.hpp"

#include <algorithm>
#include <numeric>

namespace delone::voronoi {

solve::SimplePolytope::Measures RegionClipper::measures() {
  polytope_.start(d_, d_);
  for (const Corner c : corners()) polytope_.add_corner(position(c), {planes_of(c), d_});
  return polytope_.measures();
}

/// Without ties no two corners coincide. With ties, those that do are rounded to the same numbers.
std::vector<Index> RegionClipper::exact_numbers() {
  std::vector<Index> rounded, number(alive_.size(), invalid_index);
  if (!has_ties_) {
    std::iota(number.begin(), number.end(), Index{0});
    return number;
  }
  const std::vector<Corner> sorted = number_corners(rounded);
  std::vector<kernel::Fractions> exact;
  for (const Corner c : sorted) exact.push_back(solve_exactly(c));
  const auto are_equal = [&](std::size_t a, std::size_t b) {
    for (std::size_t j = 0; j < d_; ++j)
      if (exact[a].numerators[j] * exact[b].denominator != exact[b].numerators[j] * exact[a].denominator)
        return false;
    return true;
  };
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    number[sorted[i]] = static_cast<Index>(i);
    for (std::size_t j = i; j-- > 0 && rounded[sorted[j]] == rounded[sorted[i]];)
      if (are_equal(i, j)) number[sorted[i]] = number[sorted[j]];
  }
  return number;
}

std::vector<RegionClipper::ProperFacet> RegionClipper::proper_facets() {
  const std::vector<Index> number = exact_numbers();
  const std::vector<Corner> all = corners();
  std::vector<ProperFacet> facets;
  for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
    std::size_t size = 0;
    if (d_ == 3) {
      size = cycle(plane, number, all).size();
    } else {
      std::vector<Index> on;
      for (const Corner c : all)
        if (std::find(planes_of(c), planes_of(c) + d_, plane) != planes_of(c) + d_) on.push_back(number[c]);
      std::sort(on.begin(), on.end());
      size = static_cast<std::size_t>(std::unique(on.begin(), on.end()) - on.begin());
    }
    if (size >= d_) facets.push_back({plane, size});
  }
  return facets.size() > d_ ? facets : std::vector<ProperFacet>{};
}

}  // namespace delone::voronoi
