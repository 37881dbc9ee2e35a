// SPDX-License-Identifier: BSD-3-Clause
// Exact signs of orientation and sphere determinants in any dimension, with and without weights, for all
// finite doubles.
#pragma once

#include <delone/export.hpp>
#include <delone/types.hpp>

#include <span>

namespace delone {

/// The orientation of d+1 points of R^d (n·d coordinates, row-major): the sign of det(p_1−p_0, …, p_d−p_0).
///   +  positively oriented (counterclockwise for d = 2)   0  affinely dependent   −  negatively oriented
/// (1) exchanging two points negates the sign; (2) it is 0 if two points are equal.
/// Throws Errc::bad_dimension unless d ≥ 1 and points.size() = (d+1)·d, and not_finite.
DELONE_EXPORT Sign orientation(std::span<const double> points, int dimension);

/// The side of the sphere through d+1 points that q lies on: inside, on or outside.
/// (1) It does not depend on the order or the orientation of the points; (2) q is on the sphere if it is one
/// of them.
/// Never perturbed. Throws as orientation(), and Errc::invalid_argument if the points are affinely dependent.
DELONE_EXPORT Side in_sphere(std::span<const double> points, std::span<const double> q, int dimension);

/// As in_sphere, with ties broken by the perturbation of Devillers and Teillaud: q is on the sphere only if
/// it equals one of the points.
DELONE_EXPORT Side in_sphere_perturbed(std::span<const double> points, std::span<const double> q,
                                       int dimension);

/// The side of the sphere (center c, squared radius ρ, which may be negative) orthogonal to d+1 weighted
/// points, |p_i − c|² − ρ = w_i, that the weighted point (q, w_q) lies on: with |q − c|² − ρ − w_q
///   negative, inside: in conflict, the points are no cell of a regular triangulation that q belongs to
///   zero, on: the sphere is orthogonal to (q, w_q), too
///   positive, outside.
/// Weights have the unit of squared lengths and may have any sign. With all weights equal it is in_sphere.
/// (1) It does not depend on the order or the orientation of the points; (2) (q, w_q) is on the sphere if it
/// is one of the points; (3) if q has the coordinates of a point but another weight, it is inside for the
/// larger weight and outside for the smaller; (4) adding one number to all weights changes nothing, as long
/// as the sums are exact. Never perturbed. Throws as in_sphere, and Errc::bad_dimension unless there is one
/// weight per point.
DELONE_EXPORT Side in_power_sphere(std::span<const double> points, std::span<const double> weights,
                                   std::span<const double> q, double weight_of_q, int dimension);

/// As in_power_sphere, with ties broken by the same perturbation: on only if q equals one of the points in
/// coordinates and weight.
DELONE_EXPORT Side in_power_sphere_perturbed(std::span<const double> points, std::span<const double> weights,
                                             std::span<const double> q, double weight_of_q, int dimension);

/// The sign of the determinant of d+1 homogeneous rows of d+1 entries (row-major): a hull orientation of
/// rays, such as the halfspaces (n, c). (1) Exchanging two rows negates it; (2) multiplying a row by a
/// positive number changes nothing, if the products are exact; (3) for rows (x, 1) it is (−1)^d·orientation
/// of the points x. Throws Errc::bad_dimension unless rows.size() = (d+1)², and not_finite.
DELONE_EXPORT Sign homogeneous_orientation(std::span<const double> rows, int dimension);

/// The side of a hyperplane (n, c) of d+1 numbers that p lies on: inside if n·p + c < 0, strictly inside the
/// halfspace n·x + c ≤ 0; on if it is 0; outside if it is positive. Throws Errc::bad_dimension unless
/// hyperplane.size() = d+1 and p.size() = d, and not_finite.
DELONE_EXPORT Side side_of_hyperplane(std::span<const double> hyperplane, std::span<const double> p,
                                      int dimension);

/// The dimension of the affine hull of the points; −1 for none. Exact. Throws Errc::bad_dimension unless d ≥
/// 1 and points.size() is a multiple of d, and not_finite.
DELONE_EXPORT int affine_dimension(std::span<const double> points, int dimension);

}  // namespace delone
