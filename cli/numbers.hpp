// SPDX-License-Identifier: BSD-3-Clause
// Numbers as options have them: counts, as 1000 or 1e6, sizes, as 500MB or 1.5GiB, and real numbers. And
// lists.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace delone::cli {

/// What stands for every number that is larger.
inline constexpr std::uint64_t beyond_numbers = std::numeric_limits<std::uint64_t>::max();

/// Digits, also with a decimal point and an exponent. Nothing for other text, and if the value is not whole.
std::optional<std::uint64_t> parse_count(std::string_view text);

/// The same as a number of bytes, and with a unit after it, in letters of either case: B; KB, MB, GB, TB,
/// powers of 1000; KiB, MiB, GiB, TiB and K, M, G, T, powers of 1024. The product must be whole.
std::optional<std::uint64_t> parse_size(std::string_view text);

/// A number above 0, and with a unit after it, s, m, h or d, of seconds, minutes, hours or days; in seconds.
std::optional<double> parse_duration(std::string_view text);

/// The whole of `text` as a number, correctly rounded. Nothing for other text, for infinities, and for
/// magnitudes beyond binary64; small ones give a zero.
std::optional<double> parse_real(std::string_view text);

/// The parts of a list with commas.
std::vector<std::string> split_list(const std::string& list);

}  // namespace delone::cli
