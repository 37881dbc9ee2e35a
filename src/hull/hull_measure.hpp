// SPDX-License-Identifier: BSD-3-Clause
// Lengths, areas and volumes of simplices, hyperplanes of facets: binary64 with error bounds.
#pragma once

#include "compiled/simplicial_hull.hpp"

#include <delone/convex_hull.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace delone::internal {

/// A compensated sum (Neumaier 1974, doi:10.1002/zamm.19740540106) of measures, with their errors.
class MeasureSum {
 public:
  void add(const Measure& term);
  Measure result() const;

 private:
  double sum_ = 0, lost_ = 0, error_ = 0, magnitude_ = 0;
};

/// The j-dimensional volume of the simplex of j+1 points of R^d: |r_11 ⋯ r_jj|/j! for the triangular factor R
/// of its edges, by Householder's reflections. A reflection of a column of length d is off by at most 10·(d +
/// 8)·u of the column's norm (dot product, scaling, subtraction, and the rounding of the reflector itself,
/// counted to first order), so R is exact for edges e_i + δ_i, |δ_i| ≤ 10·j·(d + 8)·u·|e_i|. The volume is
/// multilinear in the edges and at most their product: its error is at most Π|e_i|·((1 + 10·j·(d + 8)·u)^j −
/// 1)/j!. The differences' own rounding is part of the slack.
Measure simplex_volume(std::span<const double* const> points, int ambient);

/// The volume of the hull and the area of its boundary, within the flat: one elimination per cell. Every cell
/// is joined to one vertex: none of these simplices has negative volume, so nothing cancels.
struct HullMeasures {
  Measure volume, area;
};
HullMeasures measure_hull(const HullSites& sites, const SimplicialHull& hull);

/// The unit normals of the facets' hyperplanes within the flat, outwards, with the offsets: d+1 numbers each,
/// and the bounds of Polytope::data(). Of the cells of a facet the one with the best bound is taken.
/// `inner(c)`: a site of the flat that is strictly inside the hyperplane of cell c.
struct FacetEquations {
  std::vector<double> equations, errors;
};
FacetEquations facet_equations(const HullSites& sites, const SimplicialHull& hull,
                               std::span<const Index> facet_of_cell, std::size_t num_facets,
                               const std::function<const double*(std::size_t)>& inner);

}  // namespace delone::internal
