// SPDX-License-Identifier: BSD-3-Clause
// Exact signs of orientation and sphere determinants in any dimension, for all finite doubles.
#pragma once

#include <delone/types.hpp>

#include <span>

namespace delone {

/// The orientation of d+1 points of R^d (n·d coordinates, row-major): the sign of det(p_1−p_0, …, p_d−p_0).
///   +  positively oriented (counterclockwise for d = 2)   0  affinely dependent   −  negatively oriented
/// (1) exchanging two points negates the sign; (2) it is 0 if two points are equal.
/// REQUIRES coordinates.size() = (d+1)·d, all finite; otherwise throws Error.
Sign orientation(std::span<const double> points, int dimension);

/// The position of q with respect to the sphere through d+1 points:
///   −  strictly inside   0  on the sphere   +  strictly outside
/// (1) it does not depend on the order or the orientation of the points; (2) it is 0 if q is one of them.
/// REQUIRES affinely independent points (orientation ≠ 0); otherwise throws Error. Never perturbed.
Sign in_sphere(std::span<const double> points, std::span<const double> q, int dimension);

/// As in_sphere, ties broken by the perturbation of Devillers and Teillaud: never 0 unless q equals one of the points.
Sign in_sphere_perturbed(std::span<const double> points, std::span<const double> q, int dimension);

/// The dimension of the affine hull of the points; −1 for none. Exact.
int affine_dimension(std::span<const double> points, int dimension);

}  // namespace delone
