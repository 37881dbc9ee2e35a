// SPDX-License-Identifier: BSD-3-Clause
// With the names of faces/edge_inverse.hpp and b_i = s_i·|a_i|²/2, which is known up to 1.02(d + 1)ε·b_i: the
// center p_0 + x has A·x = S⁻¹b, so M·y = b and x = W·y if there are as many edges as dimensions. y = X·b is
// off in entry j by at most e_j = Σ_i 2r_j·ρ_i·b_i + 1.02(n + d + 2)ε·Σ_i|X_ji|b_i, and |x|² = Σ(w_j·y_j)² by
// Σw_j²(2|y_j| + e_j)e_j and the roundings. Otherwise |x|² = bᵀM⁻¹b, which is off by Σ 2b_i·r_i·ρ_j·b_j and
// by 1.02(n² + 2d + 4)ε·Σb_i|X_ij|b_j. What underflows is far below the bounds, as scales are from 2⁻¹⁵⁰ to
// 2¹⁵⁰; what overflows makes them infinite or NaN.
#include "faces/square_in_pairs.hpp"

#include "faces/edge_inverse.hpp"

#include <cmath>

namespace delone::internal {
namespace {

using Inverse = EdgeInverse<0, DoubleDouble>;
using Entries = Inverse::Vector<DoubleDouble>;

SquareInPairs square_by_edges(const Inverse& e, const Entries& b) {
  const std::size_t n = e.n;
  const auto dn = static_cast<double>(n), dd = static_cast<double>(e.d);
  double defect = 0;
  for (std::size_t i = 0; i < n; ++i) defect += 2.02 * e.defect[i] * b[i].high;
  SquareInPairs square{{0, 0}, 0};
  for (std::size_t j = 0; j < n; ++j) {
    DoubleDouble y{0, 0};
    double magnitude = 0;
    for (std::size_t i = 0; i < n; ++i) {
      y = y + e.inverse[j * n + i] * b[i];
      magnitude += std::fabs(e.inverse[j * n + i].high) * b[i].high;
    }
    const double error = e.row_sum[j] * defect + 1.03 * (dn + dd + 2) * Inverse::epsilon * magnitude;
    const double w = e.axis_scale[j];
    const DoubleDouble x = scaled(y, w);
    square.value = square.value + x * x;
    square.error += w * error * (2 * std::fabs(x.high) + w * error);
  }
  square.error = 1.02 * (square.error + (dn + 1) * Inverse::epsilon * square.value.high);
  return square;
}

SquareInPairs square_by_gram(const Inverse& e, const Entries& b) {
  const std::size_t n = e.n;
  const auto dn = static_cast<double>(n), dd = static_cast<double>(e.d);
  double defect = 0, rows = 0, magnitude = 0;
  DoubleDouble value{0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    defect += e.defect[i] * b[i].high;
    rows += e.row_sum[i] * b[i].high;
    for (std::size_t j = 0; j < n; ++j) {
      value = value + b[i] * e.inverse[i * n + j] * b[j];
      magnitude += b[i].high * std::fabs(e.inverse[i * n + j].high) * b[j].high;
    }
  }
  return {value, 1.02 * (2.02 * rows * defect + (dn * dn + 2 * dd + 4) * Inverse::epsilon * magnitude)};
}

}  // namespace

std::optional<SquareInPairs> square_in_pairs(const double* const* points, std::size_t corners,
                                             std::size_t dimension) {
  Inverse e(points, corners, dimension);
  if (!e.invert()) return std::nullopt;
  Entries b(e.n);
  for (std::size_t i = 0; i < e.n; ++i) {
    DoubleDouble square{0, 0};
    for (std::size_t j = 0; j < e.d; ++j) square = square + e.edge(i, j) * e.edge(i, j);
    b[i] = scaled(square, 0.5 * e.edge_scale[i]);
  }
  do {
    const SquareInPairs square = e.is_square() ? square_by_edges(e, b) : square_by_gram(e, b);
    if (square.error <= 0x1p-80 * square.value.high && square.value.high > 1e-200) return square;
  } while (e.improve());
  return std::nullopt;
}

}  // namespace delone::internal
