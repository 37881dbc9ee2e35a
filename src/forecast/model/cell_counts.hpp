// SPDX-License-Identifier: BSD-3-Clause
// Numbers of cells that are known in closed form. Numbers of points are doubles, so that forecasts have no
// limit.
#pragma once

namespace delone::cost_model {

/// Expected number of cells per point of the Delaunay triangulation of a Poisson process in k dimensions: 2,
/// 6.77, 31.8, 186, … for k = 2, 3, …; Miles 1974, Møller 1994 (Lectures on random Voronoi tessellations).
/// For n uniform points it is the limit of the mean number of cells per point: Dwyer 1991,
/// doi:10.1007/BF02574694. REQUIRES k ≥ 1.
double poisson_cells_per_point(int k);

/// Finite cells of the Delaunay triangulation of n points on the moment curve (t, t², …, t^k), t > 0. A
/// sphere meets that part of the curve in at most k+1 points, by Descartes' rule of signs, so that lifted
/// points are the vertices of a cyclic polytope, and Gale's evenness condition counts its lower facets: C(n −
/// (k+1)/2, (k+1)/2) for odd k, C(n − 1 − k/2, k/2) for even k. REQUIRES n ≥ k + 1.
double moment_curve_cells(int k, double n);

/// The most cells, finite and infinite, that n points in k dimensions can have. With the infinite vertex they
/// are a simplicial sphere of n+1 vertices, which has no more than a cyclic polytope in k+1 dimensions, by
/// the upper bound theorem (McMullen 1970, doi:10.1112/S0025579300002850; Stanley 1975 for spheres).
double most_cells(int k, double n);

/// The convex hull of points of a lattice, in units of its elementary box.
struct LatticeHull {
  int affine_dimension = 0;
  double volume = 1;  ///< in the flat of the points
};
/// Of the first n points of {0 … side−1}^d in lexicographic order, as `generate grid` makes them. Where the
/// last layer is not full, its hull is taken to be a box.
LatticeHull lattice_hull(int d, double n, double side);
/// The least side of a grid of n points.
double grid_side(int d, double n);

/// k!
double factorial(int k);

}  // namespace delone::cost_model
