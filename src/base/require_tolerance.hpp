// SPDX-License-Identifier: BSD-3-Clause
// Refuses tolerances that mean nothing.
#pragma once

#include <delone/error.hpp>

#include <charconv>
#include <cmath>
#include <string>

namespace delone::internal {

/// The shortest decimal number that is read as x.
inline std::string shortest_text(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

/// Throws Errc::invalid_argument unless a tolerance is finite and at least 0.
inline void require_tolerance(double tolerance) {
  if (!(tolerance >= 0) || std::isinf(tolerance))
    throw Error(Errc::invalid_argument,
                "the tolerance is " + shortest_text(tolerance) + ", which is not a finite number from 0 on");
}

/// Throws Errc::invalid_argument unless the tolerance is 0; `what`: those that have none.
inline void refuse_tolerance(double tolerance, const char* what) {
  if (tolerance != 0)
    throw Error(Errc::invalid_argument,
                std::string(what) + " have no tolerance: Options::tolerance must be 0");
}

}  // namespace delone::internal
