// SPDX-License-Identifier: BSD-3-Clause
// The report of numbers that are NaN or infinite.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone::internal {

/// The rows that have a number that is NaN or infinite, increasing. Rows have `width` numbers and count from
/// 0.
std::vector<std::size_t> find_not_finite(std::span<const double> numbers, std::size_t width);

/// What a message about the first of these rows ends with: "", or " (and of 3 more)".
std::string and_of_more(std::span<const std::size_t> rows);

/// Throws Errc::not_finite unless all numbers are finite; rows() of the error lists all rows concerned, as
/// above. The message reads "WHAT of ITEM 7 is not finite", as in "a coordinate of point 7 is not finite".
void require_finite(std::span<const double> numbers, std::size_t width, std::string_view what,
                    std::string_view item = "point");

}  // namespace delone::internal
