// SPDX-License-Identifier: BSD-3-Clause
// operator new of this program: counts allocations of a thread, and makes some of them fail.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace delone::test {

/// How many allocations, of all threads together, there may be before one fails; none fails if it is
/// negative.
extern std::atomic<long> left_for_all_threads;

struct Allocations {
  std::size_t count = 0;
  std::size_t first_to_fail = 0;  ///< none, if 0
  bool all_later_fail = false;

  bool fails() {
    if (left_for_all_threads.load(std::memory_order_relaxed) >= 0 && left_for_all_threads.fetch_sub(1) <= 0) {
      left_for_all_threads = -1;
      return true;
    }
    ++count;
    return first_to_fail != 0 && (all_later_fail ? count >= first_to_fail : count == first_to_fail);
  }
};
extern thread_local Allocations allocations;

/// What this thread has allocated and not freed.
extern thread_local std::int64_t num_live_allocations;

}  // namespace delone::test
