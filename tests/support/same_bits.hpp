// SPDX-License-Identifier: BSD-3-Clause
// Whether numbers are equal to the last bit, NaN included.
#pragma once

#include <cstring>
#include <vector>

namespace delone::test {

inline bool are_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace delone::test
