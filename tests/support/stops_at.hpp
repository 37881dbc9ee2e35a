// SPDX-License-Identifier: BSD-3-Clause
// A progress function that ends a call at a given report, on machines of any speed.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace delone::test {

/// Says `false` at the report of this number, which starts at 1. Each report lasts longer than the time
/// between two, so that the next look at the clock reports again.
inline std::function<bool(double)> stops_at(int report) {
  return [report, seen = 0](double) mutable {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    return ++seen < report;
  };
}

}  // namespace delone::test
