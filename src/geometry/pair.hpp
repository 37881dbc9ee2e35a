// SPDX-License-Identifier: BSD-3-Clause
// Two doubles that are loaded, stored, added and multiplied together, on every processor. What is loaded soon
// after it was stored must be stored in the same pairs: a load that combines several recent stores is a
// store-forwarding stall.
#pragma once

#include "base/compiler.hpp"

#include <cstring>

namespace delone::geometry {

using Pair = internal::Lanes<double, 2>;

inline Pair load_pair(const double* from) {
  Pair pair;
  std::memcpy(&pair, from, sizeof(pair));
  return pair;
}

inline void store_pair(double* to, Pair pair) { std::memcpy(to, &pair, sizeof(pair)); }

}  // namespace delone::geometry
