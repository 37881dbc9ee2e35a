// SPDX-License-Identifier: BSD-3-Clause
// How much randomized tests do: DELONE_TEST_SCALE=small or large in the environment, for sanitizers and for long nights.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string_view>

namespace delone::test {

/// A number of rounds or points for a usual run, turned into that for the present scale; at least 1.
inline std::size_t scaled_count(std::size_t usual) {
  const char* scale = std::getenv("DELONE_TEST_SCALE");
  const std::string_view name = scale == nullptr ? "" : scale;
  return name == "small" ? std::max<std::size_t>(1, usual / 10) : name == "large" ? 10 * usual : usual;
}

}  // namespace delone::test
