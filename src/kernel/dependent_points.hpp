// SPDX-License-Identifier: BSD-3-Clause
// Spheres that a point off a lattice lies on with points of the lattice.
#pragma once

#include "kernel/flat.hpp"

namespace delone::kernel {

/// Whether it is proved that the k + 1 points of a cell and q are on one sphere, or the cell flat, whatever
/// the coordinates of the point among them that lies on the finest grid: because the others are on a sphere
/// of less dimension, as the corners of a face of a cube. The grid of all points at hand leaves these ties
/// open, as it is fine. For points of R^k without weights, 2 ≤ k ≤ 6; false for others, and where the others
/// are on no small grid.
///
/// *Proof.* Let the others be p_0 … p_k. The rows (p_i − p_0, |p_i − p_0|²), i = 1 … k, are linearly
/// dependent iff all k × k minors vanish. Then the lifted points (p_i, |p_i|²) are affinely dependent, and so
/// are these with one more point: the determinant of the sphere is 0. The minors are exact: coordinates are
/// multiples of 2^e. With D at least the magnitude of all differences in units of 2^e, and L of their
/// squares' sums, no term and no partial sum of a minor exceeds k!·D^(k − 1)·max(D, L), and that is below
/// 2^53. A difference of two multiples of 2^e that is rounded to fewer than 2^52 units is one, and not
/// rounded.
bool is_on_sphere_of_others(const Flat& flat, const double* const* points, const double* q);

}  // namespace delone::kernel
