// SPDX-License-Identifier: BSD-3-Clause
// What every front end does with a batch of input rows before it builds anything.
#pragma once

#include <delone/complex.hpp>
#include <delone/delaunay.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace delone::front_ends {

/// Throws Errc::not_finite if a number is not finite; rows have `width` of them, and are named by `what`, such as "a
/// coordinate".
void require_finite(std::span<const double> numbers, std::size_t width, const std::string& what);

/// The numbers of the points in the order of insertion that the options ask for.
std::vector<Index> insertion_order(PointsView points, const Options& options);

}  // namespace delone::front_ends
