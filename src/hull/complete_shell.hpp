// SPDX-License-Identifier: BSD-3-Clause
// The shell of a sieve grows until it is the hull of all points.
#pragma once

#include "hull/point_sieve.hpp"

#include <memory>

namespace delone::hull {

/// Extends the shell until all remaining points are in it, exactly. Returns false, and leaves points, if most
/// of them seem to be extreme: then it is better to insert all. `before`, if given: the shell before points
/// were added that may not be extreme, if it was kept. REQUIRES a shell.
bool complete_shell(PointSieve& sieve, std::unique_ptr<HullState>* before = nullptr);

}  // namespace delone::hull
