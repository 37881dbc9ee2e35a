// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernel/determinant.hpp"

namespace delone::voronoi {

/// The unit roundoff of binary64, as the room's error bounds write it.
inline constexpr double u = kernel::unit_roundoff;

}  // namespace delone::voronoi
