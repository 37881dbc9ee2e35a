// SPDX-License-Identifier: BSD-3-Clause
// The size of randomized tests: DELONE_TEST_SCALE=small or large in the environment, for sanitizers and for
// nightly runs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string_view>

namespace delone::test {

enum class Scale { small, usual, large };
inline Scale scale() {
  const char* const given = std::getenv("DELONE_TEST_SCALE");
  const std::string_view name = given == nullptr ? "" : given;
  return name == "small" ? Scale::small : name == "large" ? Scale::large : Scale::usual;
}

/// A number of rounds or points for a usual run, turned into that for the present scale; at least 1.
inline std::size_t scaled_count(std::size_t usual) {
  return scale() == Scale::small   ? std::max<std::size_t>(1, usual / 10)
         : scale() == Scale::large ? 10 * usual
                                   : usual;
}

/// A size of which the work is a power, as the side of a lattice: the second one in a small run.
inline std::size_t scaled_size(std::size_t usual, std::size_t small) {
  return scale() == Scale::small ? small : usual;
}

}  // namespace delone::test
