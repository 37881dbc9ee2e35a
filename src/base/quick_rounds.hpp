// SPDX-License-Identifier: BSD-3-Clause
// Cancellation points for loops whose rounds take nanoseconds.
#pragma once

#include "base/progress_meter.hpp"

namespace delone::internal {

/// Called in every round; each 64th is a cancellation point.
class QuickRounds {
 public:
  void operator()() {
    if (++rounds_ % 64 == 0) cancellation_point();
  }

 private:
  unsigned rounds_ = 0;
};

}  // namespace delone::internal
