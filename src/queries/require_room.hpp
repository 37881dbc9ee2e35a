// SPDX-License-Identifier: BSD-3-Clause
// The arrays that callers give for answers.
#pragma once

#include <delone/error.hpp>

#include <cstddef>
#include <span>
#include <string>

namespace delone::queries {

/// Throws Errc::invalid_argument unless an array has as many entries as expected, or none.
template <class T>
void require_room(std::span<T> array, std::size_t expected, const char* what) {
  if (array.empty() || array.size() == expected) return;
  throw Error(Errc::invalid_argument,
              std::to_string(array.size()) + " entries for the " + what + " of " + std::to_string(expected));
}

}  // namespace delone::queries
