// SPDX-License-Identifier: BSD-3-Clause
// Proofs that a point off a lattice is on one sphere with points of the lattice.
#pragma once

#include "kernel/flat.hpp"

namespace delone::kernel {

/// Whether it is proved that the k + 1 points of a cell and q are on one sphere, or that the cell is flat.
/// The proof leaves out the point among them on the finest grid: the others are on a sphere of less
/// dimension, as the corners of a face of a cube are, so the coordinates of that point do not matter. The
/// grid of all the points is too fine to decide such ties. For points of R^k without weights, 2 ≤ k ≤ 6;
/// false for others, and where the remaining points are on no coarse grid.
///
/// *Proof.* Let the others be p_0 … p_k. The rows (p_i − p_0, |p_i − p_0|²), i = 1 … k, are linearly
/// dependent iff all k × k minors vanish. Then the lifted points (p_i, |p_i|²) are affinely dependent, and so
/// are these with one more point: the determinant of the sphere is 0. The minors are exact: coordinates are
/// multiples of 2^e. With D at least the magnitude of all differences in units of 2^e, and L of their
/// squares' sums, no term and no partial sum of a minor exceeds k!·D^(k − 1)·max(D, L), and that is below
/// 2^53. A computed difference of two multiples of 2^e that is below 2^52 units is exact.
bool is_on_sphere_of_others(const Flat& flat, const double* const* points, const double* q);

/// The same without lifts: whether it is proved that k points and a base are affinely dependent, without the
/// one on the finest grid. For points of R^k, 2 ≤ k ≤ 6.
bool is_flat_without_one(const Flat& flat, const double* const* points, const double* base);

}  // namespace delone::kernel
