// SPDX-License-Identifier: BSD-3-Clause
// The report of tolerances that are no distances, or larger than the set that they are meant for.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace delone::internal {

/// Throws Errc::invalid_argument unless the tolerance is a finite number of at least 0. `what`: "a diagram".
void require_tolerance(double tolerance, const std::string& what);

/// Throws Errc::invalid_argument if the tolerance is larger than the longest side of the bounding box of the
/// points, d coordinates each. Nothing is larger than the box of fewer than two points. Coordinates that are
/// NaN do not count.
void require_tolerance_within(double tolerance, std::span<const double> points, std::size_t d,
                              const std::string& what);

}  // namespace delone::internal
