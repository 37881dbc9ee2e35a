// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that can be interrupted.
#pragma once

#include "base/random.hpp"

#include <delone/progress.hpp>

#include <cstdint>

namespace delone::point_sets {

/// The random numbers of a point set, with a cancellation_point() at every 65536th.
class Generator : public random::Generator {
 public:
  using random::Generator::Generator;

  std::uint64_t bits() { return count(), random::Generator::bits(); }
  std::uint64_t below(std::uint64_t bound) { return count(), random::Generator::below(bound); }
  double uniform() { return count(), random::Generator::uniform(); }
  bool coin() { return count(), random::Generator::coin(); }

 private:
  void count() {
    if (++drawn_ % 65536 == 0) cancellation_point();
  }

  std::uint32_t drawn_ = 0;
};

}  // namespace delone::point_sets
