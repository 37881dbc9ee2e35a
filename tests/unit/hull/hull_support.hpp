// SPDX-License-Identifier: BSD-3-Clause
// Hulls for the tests of this folder: sites in general and in lattices, hulls from lists of cells.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "degenerate.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::hull {

using compiled::SimplicialHull;
using sites::BoundarySites;

/// Sites on the given axes of R^dimension, all of them by default.
inline BoundarySites sites_of(int dimension, std::vector<double> coordinates, std::vector<int> axes = {}) {
  BoundarySites sites(dimension);
  sites.coordinates = std::move(coordinates);
  sites.axes = std::move(axes);
  if (sites.axes.empty()) {
    sites.axes.resize(static_cast<std::size_t>(dimension));
    std::iota(sites.axes.begin(), sites.axes.end(), 0);
  }
  for (Index site = 0; site < sites.size(); ++site) sites.grid.include(sites.point(site));
  return sites;
}

/// The boundary with the given cells of k vertices each, k > 1: neighbors share all vertices but one.
inline SimplicialHull hull_of(int k, std::vector<Index> cells) {
  const auto corners = static_cast<std::size_t>(k);
  SimplicialHull hull{k, std::move(cells), {}, {}};
  hull.neighbors.resize(hull.cells.size());
  std::map<std::vector<Index>, std::size_t> open;  // ridge → place of the vertex opposite it
  for (std::size_t at = 0; at < hull.cells.size(); ++at) {
    const auto cell = hull.cell(at / corners);
    std::vector<Index> ridge(cell.begin(), cell.end());
    ridge.erase(ridge.begin() + static_cast<std::ptrdiff_t>(at % corners));
    std::sort(ridge.begin(), ridge.end());
    const auto [other, is_new] = open.emplace(ridge, at);
    if (is_new) continue;
    hull.neighbors[at] = static_cast<Index>(other->second / corners);
    hull.neighbors[other->second] = static_cast<Index>(at / corners);
  }
  return hull;
}

}  // namespace delone::hull
