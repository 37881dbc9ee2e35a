// SPDX-License-Identifier: BSD-3-Clause
// Two doubles that are added and multiplied, read and written at once, on every processor. What is read soon
// after it was written has to be written in the same pairs: a processor waits when it must put together what
// it reads from several recent writes.
#pragma once

#include <cstring>

namespace delone::geometry {

using Pair = double __attribute__((vector_size(16)));

inline Pair load_pair(const double* from) {
  Pair pair;
  std::memcpy(&pair, from, sizeof(pair));
  return pair;
}

inline void store_pair(double* to, Pair pair) { std::memcpy(to, &pair, sizeof(pair)); }

}  // namespace delone::geometry
