// SPDX-License-Identifier: BSD-3-Clause
// Stage `exact_`: orientation and sphere determinants in integer arithmetic, for all finite doubles. Never uncertain.
#pragma once

#include "kernel/flat.hpp"

#include <delone/types.hpp>

namespace delone::kernel {

/// The sign of det(p_i − base), i < k, over the axes of the flat.
Sign exact_orientation(const Flat& flat, const double* const* points, const double* base);

/// The sign of det(p_i − q, |p_i − q|²), i = 0 … k.
Sign exact_sphere(const Flat& flat, const double* const* points, const double* q);

}  // namespace delone::kernel
