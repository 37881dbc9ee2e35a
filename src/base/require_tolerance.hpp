// SPDX-License-Identifier: BSD-3-Clause
// Refuses tolerances, and limits of time, that mean nothing. All functions that throw throw
// Errc::invalid_argument.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace delone::internal {

/// Throws unless a tolerance is finite and at least 0. `name`: what it is called.
void require_tolerance(double tolerance, const std::string& name = "tolerance");

/// The same for Options::time_limit.
void require_time_limit(double seconds);

/// Throws if a tolerance is larger than the extent of what it is for, unless that is 0. `what`: "the set of
/// points, whose longest side is".
void require_tolerance_within(double tolerance, double extent, const std::string& what);

/// The same for the longest side of the bounding box of points, d coordinates each, in two parts, multiplied
/// by the factors of an AxisScale, which must not overflow. Coordinates that are NaN do not count.
void require_tolerance_within(double tolerance, std::span<const double> points, std::size_t d,
                              std::span<const double> more_points = {}, std::span<const double> factors = {});

/// Throws unless the tolerance is 0, and none is given per axis. `what`: those that have none.
void refuse_tolerance(double tolerance, std::span<const double> per_axis, const std::string& what);
/// Throws if a tolerance is given per axis. `what`: those that have but one.
void refuse_axis_tolerances(std::span<const double> per_axis, const std::string& what);

}  // namespace delone::internal
