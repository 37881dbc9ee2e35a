// SPDX-License-Identifier: BSD-3-Clause
// The last attempt of stage `direct_`: determinants of up to 10 columns in twice the precision of binary64,
// with a certified bound, for input that is degenerate but for some last places.
#pragma once

#include "kernel/flat.hpp"
#include "kernel/grid.hpp"

#include <delone/types.hpp>

#include <optional>

namespace delone::kernel {

/// The sign of det(p_i − base), i < k, over the axes of the flat; nullopt when the numbers cannot tell, or
/// when k > 10.
std::optional<Sign> double_double_orientation(const Flat& flat, const double* const* points,
                                              const double* base, const Grid& grid);

/// The sign of det(p_i − q, |p_i − q|² − w_i + w_q), i = 0 … k, all weights 0 for points without; nullopt
/// when the numbers cannot tell, or when k > 9.
std::optional<Sign> double_double_sphere(const Flat& flat, const double* const* points, const double* q,
                                         const Grid& grid);

}  // namespace delone::kernel
