// SPDX-License-Identifier: BSD-3-Clause
// What builds a hull hands to what examines it: the distinct points, and the boundary as simplices with
// neighbors.
//
// Orientation: for x strictly inside, x followed by the vertices of a cell is positively oriented on the
// axes; so the sign of det(v_i − q) is + where q is inside of a cell's hyperplane, 0 on it, − beyond. A cell
// of one vertex (k = 1) cannot be oriented: cell 0 is the lower end, cell 1 the upper one.
#pragma once

#include "kernel/stages.hpp"
#include "sites/boundary_sites.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::compiled {

using sites::BoundarySites;

struct SimplicialHull {
  int dimension = -1;                   ///< k; cells exist for k ≥ 1 only
  std::vector<Index> cells, neighbors;  ///< m×k: sites; cells across the ridge opposite each vertex
  std::vector<Index> slots;             ///< where the cells of a BoundaryEngine are in its memory, increasing

  std::size_t corners() const { return static_cast<std::size_t>(dimension < 0 ? 0 : dimension); }
  std::size_t num_cells() const { return dimension < 1 ? 0 : cells.size() / corners(); }
  std::span<const Index> cell(std::size_t c) const { return {cells.data() + c * corners(), corners()}; }
  std::span<const Index> neighbors_of(std::size_t c) const {
    return {neighbors.data() + c * corners(), corners()};
  }
};

/// The exact sign of det(v_i − q), i < k, for k sites; `grid` is one for the sites and q. `scratch` saves an
/// allocation.
inline Sign side_of_sites(const BoundarySites& sites, std::span<const Index> cell, const double* q,
                          const kernel::Grid& grid, std::vector<const double*>& scratch) {
  scratch.assign(1, q);
  for (const Index site : cell) scratch.push_back(sites.point(site));
  return kernel::orientation<0>(sites.flat(), scratch.data(), grid);
}

/// The exact side of cell c that q is on: + inside, 0 on its hyperplane, − beyond. REQUIRES q in the flat.
inline Sign side_of_cell(const BoundarySites& sites, const SimplicialHull& hull, std::size_t c,
                         const double* q, const kernel::Grid& grid, std::vector<const double*>& scratch) {
  const Sign sign = side_of_sites(sites, hull.cell(c), q, grid, scratch);
  return hull.dimension == 1 && c == 0 ? -sign : sign;
}

}  // namespace delone::compiled
