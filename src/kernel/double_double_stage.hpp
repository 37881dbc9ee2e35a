// SPDX-License-Identifier: BSD-3-Clause
// The last part of stage `direct_`: determinants of up to 12 columns in twice the precision of binary64, with
// a certified bound, for input that is degenerate up to its last bits.
#pragma once

#include "kernel/flat.hpp"

#include <delone/types.hpp>

#include <optional>

namespace delone::kernel {

/// The sign of det(p_i − base), i < k, over the axes of the flat; nullopt if the sign is uncertain or k > 11.
std::optional<Sign> double_double_orientation(const Flat& flat, const double* const* points,
                                              const double* base);

/// The sign of det(p_i − q, |p_i − q|² − w_i + w_q), i = 0 … k, all weights 0 for points without; nullopt if
/// the sign is uncertain or k > 11.
std::optional<Sign> double_double_sphere(const Flat& flat, const double* const* points, const double* q);

}  // namespace delone::kernel
