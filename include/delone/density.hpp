// SPDX-License-Identifier: BSD-3-Clause
// The density of particles by the Delaunay tessellation field estimator (DTFE): Schaap and van de Weygaert,
// "Continuous fields and discrete samples", Astronomy & Astrophysics 363 (2000), L29–L32.
//
// The density at a particle of mass m is (k+1)·m/W. W is the volume of its star: all finite cells of the
// Delaunay triangulation that have it as a vertex. Between particles the density is linear in each cell, so
// it is continuous, and its integral over all cells is the sum of the masses. A LinearInterpolator, or a
// PeriodicLinearInterpolator, with these densities as values evaluates it at any place.
#pragma once

#include <delone/data.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/periodic.hpp>
#include <delone/triangulation.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace delone {

/// The DTFE density at each row of the points, n numbers; NaN for removed rows. `masses`: one finite number,
/// also a negative one, for each row; empty: 1 each. Masses at one point add up, and all rows there have the
/// same density. Stars of vertices at the convex hull end there, so densities at the hull are too high.
///
/// For points that span only a k-flat, densities are masses per k-volume; for k = 0, the sum of the masses.
/// Accuracy: the volume of each cell is off by at most 2⁻⁵⁰ of that of the star; where binary64 does not
/// achieve this, integers do. A density beyond the range of doubles is infinite. Results are the same to the
/// last bit for every number of threads and order of insertion. Cost: O(c·2^k·k) for c cells, in space about
/// that of the triangulation. Throws Errc::bad_dimension for another number of masses, not_finite (rows()
/// names them), unsupported (k > 12; points have weights or the triangulation is a furthest-site one),
/// cancelled, out_of_memory.
DELONE_EXPORT std::vector<double> dtfe_densities(const Triangulation& triangulation,
                                                 std::span<const double> masses = {},
                                                 const Execution& how = {});
/// The same of a periodic set: the integral over one period is the sum of the masses. Volumes are those of
/// the points on the grid of the set.
DELONE_EXPORT std::vector<double> dtfe_densities(const PeriodicTriangulation& triangulation,
                                                 std::span<const double> masses = {},
                                                 const Execution& how = {});

/// A regular grid: the parallelepiped origin + Σ t_j · side j, 0 ≤ t_j ≤ 1, divided into shape[j] equal parts
/// along side j.
struct DELONE_EXPORT DensityGrid {
  std::vector<double> origin;      ///< d
  std::vector<double> sides;       ///< d×d, a vector per row
  std::vector<std::size_t> shape;  ///< d, each at least 1

  /// Throws Errc::bad_dimension for corners with different numbers of coordinates.
  static DensityGrid of(const Box& box, std::vector<std::size_t> shape);
  /// The box that the d vectors of a lattice span from the origin of coordinates. Throws
  /// Errc::invalid_argument for fewer vectors.
  static DensityGrid of(const Lattice& lattice, std::vector<std::size_t> shape);
};

/// The function that is linear in each cell and has these values at the rows, such as dtfe_densities(), on a
/// grid: one number for each part of it, the last axis fastest. This is the mean of the function at samples^d
/// places, the centers of as many equal parts of the part. Outside of the convex hull the function is 0.
///
/// The sum times the volume of a part is not quite the integral; the difference tends to 0 as
/// 1/(shape·samples)².
/// Throws as LinearInterpolator and PeriodicLinearInterpolator; Errc::invalid_argument for a grid of other
/// dimensions, or with numbers that are not finite, and for samples of 0; too_many. Cost: that of a query for
/// each place.
DELONE_EXPORT std::vector<double> density_on_grid(const Triangulation& triangulation,
                                                  std::span<const double> densities, const DensityGrid& grid,
                                                  std::size_t samples = 1, const Execution& how = {});
DELONE_EXPORT std::vector<double> density_on_grid(const PeriodicTriangulation& triangulation,
                                                  std::span<const double> densities, const DensityGrid& grid,
                                                  std::size_t samples = 1, const Execution& how = {});

/// Writes values on a grid:
///   npy   the values, an array of that shape
///   npz   the arrays density, origin and sides
///   csv   a row for each part: the coordinates of its center and the value; standard output
/// Throws Errc::bad_dimension unless there is a value for each part, and as all writers (io.hpp).
DELONE_EXPORT void write(const std::string& path, const DensityGrid& grid, std::span<const double> densities,
                         const std::string& format = {});

}  // namespace delone
