// SPDX-License-Identifier: BSD-3-Clause
// The report of numbers that are NaN or infinite.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace delone::internal {

/// Throws Errc::not_finite unless all numbers are finite; rows() of the error lists all rows concerned. Rows
/// have `width` numbers and count from 0. The message reads "WHAT of ITEM 7 is not finite", as in "a
/// coordinate of point 7 is not finite".
void require_finite(std::span<const double> numbers, std::size_t width, const std::string& what,
                    const std::string& item = "point");

}  // namespace delone::internal
