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
#pragma once

#include <cmath>
#include <cstddef>

namespace delone::periodic {

struct Ball {
  double center[3];
  double radius;
};

/// False if the cell is too flat.
template <int D>
bool find_ball(const double* const* corners, Ball& ball);

template <>
inline bool find_ball<2>(const double* const* corners, Ball& ball) {
  const double* const p = corners[0];
  const double ax = corners[1][0] - p[0], ay = corners[1][1] - p[1], bx = corners[2][0] - p[0],
               by = corners[2][1] - p[1];
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, det = ax * by - ay * bx;
  if (!(det * det > 0x1p-32 * aa * bb)) return false;
  const double x = (aa * by - bb * ay) / (2 * det), y = (bb * ax - aa * bx) / (2 * det);
  ball.center[0] = p[0] + x;
  ball.center[1] = p[1] + y;
  ball.radius = std::sqrt(x * x + y * y) * (1 + 0x1p-20);
  return true;
}

template <>
inline bool find_ball<3>(const double* const* corners, Ball& ball) {
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
  const double det = e[0][0] * normals[0][0] + e[0][1] * normals[0][1] + e[0][2] * normals[0][2];
  if (!(det * det > 0x1p-32 * squares[0] * squares[1] * squares[2])) return false;
  const double factor = 0.5 / det;
  double square = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const double x =
        (squares[0] * normals[0][j] + squares[1] * normals[1][j] + squares[2] * normals[2][j]) * factor;
    ball.center[j] = p[j] + x;
    square += x * x;
  }
  ball.radius = std::sqrt(square) * (1 + 0x1p-20);
  return true;
}

}  // namespace delone::periodic
