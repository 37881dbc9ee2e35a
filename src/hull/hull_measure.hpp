// SPDX-License-Identifier: BSD-3-Clause
// Lengths, areas and volumes of simplices, and hyperplanes of facets: binary64 with error bounds.
#pragma once

#include "base/compensated_sum.hpp"
#include "compiled/simplicial_hull.hpp"

#include <delone/convex_hull.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace delone::hull {

using compiled::SimplicialHull;
using sites::BoundarySites;

/// The sum of measures and of their errors, compensated.
class MeasureSum {
 public:
  void add(const Measure& term);
  /// Adds all that was added to another sum.
  void add(const MeasureSum& other);
  Measure result() const;

 private:
  internal::CompensatedSum sum_;
  double error_ = 0, magnitude_ = 0;
};

/// The j-dimensional volume of the simplex of j+1 points of R^d: |r_11 ⋯ r_jj|/j!, where R is the triangular
/// factor of the edges by Householder reflections.
///
/// Error. A computed reflection of a column of length d is off by at most 10·(d + 8)·u times the norm of the
/// column: dot product, scaling, subtraction and the rounding of the reflector itself, to first order. So R
/// is the exact factor for edges e_i + δ_i with |δ_i| ≤ 10·j·(d + 8)·u·|e_i|. The volume is multilinear in
/// the edges and at most the product of their lengths over j!. Hence its error is at most Π|e_i|·((1 +
/// 10·j·(d + 8)·u)^j − 1)/j!. The slack covers the rounding of the edges.
Measure simplex_volume(std::span<const double* const> points, int ambient);

/// The volume of the hull and the area of its boundary, both within the flat, with one elimination per cell.
/// The volume is the sum over the simplices that join each cell to one fixed vertex. None of them has
/// negative volume, so nothing cancels. Up to `threads` threads (Options::threads) share the cells; the
/// result does not depend on them.
struct HullMeasures {
  Measure volume, area;
};
HullMeasures measure_hull(const BoundarySites& sites, const SimplicialHull& hull, unsigned threads = 1);

/// For each facet the outward unit normal of its hyperplane within the flat and the offset, d+1 numbers, with
/// the error bounds of ConvexHullBase::data(). Each facet takes the equation of its cell with the smallest
/// bound. `inner(c)`: a site strictly inside the hyperplane of cell c. `seeds`: if not empty, the cell of
/// each facet whose equation it takes. `measures`: if not null, set to measure_hull() with the same
/// eliminations; then no seeds.
struct FacetEquations {
  std::vector<double> equations, errors;
};
FacetEquations facet_equations(const BoundarySites& sites, const SimplicialHull& hull,
                               std::span<const Index> facet_of_cell, std::size_t num_facets,
                               const std::function<const double*(std::size_t)>& inner,
                               std::span<const Index> seeds = {}, HullMeasures* measures = nullptr);

}  // namespace delone::hull
