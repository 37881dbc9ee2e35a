// SPDX-License-Identifier: BSD-3-Clause
// A ball around the circumsphere of a triangle in the plane or a tetrahedron in space, in some ten
// nanoseconds: for cells that are not flat, to see that they are far from everything unknown.
//
// Bounds, u = 2⁻⁵³. Let a, b, c be the edges from the first vertex, P = |a||b||c| and S = |a| + |b| + |c|.
// The determinant, Σ of six products of three entries that are each off by u, is off by less than 2⁶uP, and
// each coordinate of the numerator |a|²(b×c) + |b|²(c×a) + |c|²(a×b) by less than 2⁶uPS. Where the
// determinant exceeds 2⁻¹⁶P, the center is off by less than 2⁻³⁰(S + |x|) in each coordinate, x the center
// from the first vertex, and S ≤ 6|x| as no edge is longer than the diameter. So the ball with 1 + 2⁻²⁰ times
// the radius contains the sphere. In the plane there are fewer roundings, and the same bounds hold.
//
// The diameter alone needs no division: it is |N|/|det|, N the numerator. By the same bounds |N|² and det²
// are off by less than 2⁻²⁰ of themselves, as long as they are normal numbers.
#pragma once

#include <cmath>
#include <cstddef>

namespace delone::periodic {

struct Ball {
  double center[3];
  double radius;
};

/// 2·det·(x_1 … x_D), x the center from the first vertex, and the determinant det of the edges.
template <int D>
struct BallNumerator {
  double center[D], determinant;
  bool is_flat;  ///< too flat for the bounds
};

template <int D>
BallNumerator<D> find_numerator(const double* const* corners);

template <>
inline BallNumerator<2> find_numerator<2>(const double* const* corners) {
  const double* const p = corners[0];
  const double ax = corners[1][0] - p[0], ay = corners[1][1] - p[1], bx = corners[2][0] - p[0],
               by = corners[2][1] - p[1];
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, det = ax * by - ay * bx;
  return {{aa * by - bb * ay, bb * ax - aa * bx}, det, !(det * det > 0x1p-32 * aa * bb)};
}

template <>
inline BallNumerator<3> find_numerator<3>(const double* const* corners) {
  const double* const p = corners[0];
  double e[3][3], squares[3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) e[i][j] = corners[i + 1][j] - p[j];
    squares[i] = e[i][0] * e[i][0] + e[i][1] * e[i][1] + e[i][2] * e[i][2];
  }
  double normals[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    const double *const f = e[(i + 1) % 3], *const g = e[(i + 2) % 3];
    normals[i][0] = f[1] * g[2] - f[2] * g[1];
    normals[i][1] = f[2] * g[0] - f[0] * g[2];
    normals[i][2] = f[0] * g[1] - f[1] * g[0];
  }
  BallNumerator<3> found;
  for (std::size_t j = 0; j < 3; ++j)
    found.center[j] = squares[0] * normals[0][j] + squares[1] * normals[1][j] + squares[2] * normals[2][j];
  const double det = e[0][0] * normals[0][0] + e[0][1] * normals[0][1] + e[0][2] * normals[0][2];
  found.determinant = det;
  found.is_flat = !(det * det > 0x1p-32 * squares[0] * squares[1] * squares[2]);
  return found;
}

/// False if the cell is too flat.
template <int D>
bool find_ball(const double* const* corners, Ball& ball) {
  const BallNumerator<D> numerator = find_numerator<D>(corners);
  if (numerator.is_flat) return false;
  const double factor = 0.5 / numerator.determinant;
  double square = 0;
  for (int j = 0; j < D; ++j) {
    const double x = numerator.center[j] * factor;
    ball.center[j] = corners[0][j] + x;
    square += x * x;
  }
  ball.radius = std::sqrt(square) * (1 + 0x1p-20);
  return true;
}

/// Whether the circumsphere is certain to have a smaller diameter. False if the cell is too flat.
template <int D>
bool is_narrower(const double* const* corners, double diameter) {
  const BallNumerator<D> numerator = find_numerator<D>(corners);
  double square = 0;
  for (const double x : numerator.center) square += x * x;
  const double most = diameter * numerator.determinant, square_of_most = most * most;
  return !numerator.is_flat && square * (1 + 0x1p-18) < square_of_most && square_of_most > 0x1p-900;
}

}  // namespace delone::periodic
