// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernel/determinant.hpp"

namespace delone::internal {

/// The unit roundoff of binary64, as the room's error bounds write it.
inline constexpr double u = kernel::unit_roundoff;

}  // namespace delone::internal
