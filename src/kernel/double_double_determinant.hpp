// SPDX-License-Identifier: BSD-3-Clause
// Determinants of rows as they are given, in twice the precision of binary64, with a certified bound.
#pragma once

#include <delone/types.hpp>

#include <optional>
#include <span>

namespace delone::kernel {

/// The sign of the determinant of as many rows as there are axes, restricted to these columns; nullopt if the
/// sign is uncertain or there are more than 6.
std::optional<Sign> double_double_determinant(std::span<const int> axes, const double* const* rows);

}  // namespace delone::kernel
