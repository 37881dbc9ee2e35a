// SPDX-License-Identifier: BSD-3-Clause
// Stage `exact_`: the signs of determinants and dot products in integer arithmetic, for all finite doubles.
#pragma once

#include "kernel/flat.hpp"

#include <delone/types.hpp>

#include <span>

namespace delone::kernel {

/// The sign of det(p_i − base), i < k, over the axes of the flat.
Sign exact_orientation(const Flat& flat, const double* const* points, const double* base);

/// The sign of det(p_i − q, |p_i − q|² − w_i + w_q), i = 0 … k, all weights 0 for points without.
Sign exact_sphere(const Flat& flat, const double* const* points, const double* q);

/// The sign of the determinant of as many rows as there are axes, restricted to these columns.
Sign exact_determinant(std::span<const int> axes, const double* const* rows);

/// The sign of Σ row_j·p_j + row_d, j < d.
Sign exact_affine_form(const double* row, const double* p, int dimension);

}  // namespace delone::kernel
