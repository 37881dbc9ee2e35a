// SPDX-License-Identifier: BSD-3-Clause
// Barycentric coordinates and functionals of several finite cells at once, by elimination, one cell per SIMD
// lane. Compiled for several instruction sets; the best one of the machine is chosen at run time.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <span>

namespace delone::geometry {

/// The number of cells per call; if there are fewer, the last one fills the other lanes.
inline constexpr std::size_t simplex_lanes = 8;

struct SimplexTask {
  int k;
  /// The k + 1 vertices of each: at least one simplex, at most simplex_lanes.
  std::span<const Index* const> simplices;
  const double* rows;  ///< the images and lifts of the vertices, k + 1 doubles each
  double* scratch;     ///< simplex_scratch(k) doubles, at a multiple of 64 bytes
};

/// Entry i of an array of the scratch memory, for the simplex of a lane.
inline double& lane_entry(double* array, std::size_t i, std::size_t lane) {
  return array[i * simplex_lanes + lane];
}

/// How many doubles of scratch memory simplices of dimension k take.
std::size_t simplex_scratch(int k);

/// Writes k + 2 affine functions of images to the start of the scratch memory, k + 1 entries of simplex_lanes
/// each, the constant last: the barycentric coordinates of the simplex, and its functional without the lift.
/// Rounded; not finite if the simplex seems to be flat. Cost O(k³).
void solve_simplices(const SimplexTask& task);

/// What has been proved of a simplex.
struct SimplexCertificate {
  Sign orientation;    ///< zero: nothing is known
  double spread;       ///< a bound on Σ|barycentric coordinates| in the box of the frame
  double residual;     ///< the largest magnitude of the functional at the vertices, as computed
  double determinant;  ///< a lower bound on the magnitude of that of the edge vectors
};

/// After solve_simplices: improves the functionals, and certifies all that was written (docs/predicates.md,
/// "Many simplices at once").
void certify_simplices(const SimplexTask& task, SimplexCertificate* certificates);

}  // namespace delone::geometry
