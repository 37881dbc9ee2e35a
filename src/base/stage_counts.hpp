// SPDX-License-Identifier: BSD-3-Clause
// How often each stage of the conflict predicate decided.
#pragma once

#include <cstdint>

namespace delone::internal {

struct StageCounts {
  std::uint64_t filter = 0;
  std::uint64_t direct = 0;
  std::uint64_t exact = 0;
  std::uint64_t perturbed = 0;

  StageCounts& operator+=(const StageCounts& other) {
    filter += other.filter;
    direct += other.direct;
    exact += other.exact;
    perturbed += other.perturbed;
    return *this;
  }
};

}  // namespace delone::internal
