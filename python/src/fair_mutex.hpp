// SPDX-License-Identifier: BSD-3-Clause
// The lock of an object that threads share.
#pragma once

#include <delone/progress.hpp>

#include <chrono>
#include <mutex>
#include <shared_mutex>

namespace delone::python {

/// A mutex that many threads share or one has alone, as std::shared_mutex. Threads get it by turns: while the
/// one whose turn it is waits to have it alone, no other begins to share it, so questions without end do not
/// hold up a change. A wait is a sequence of short ones with a cancellation_point() after each, so that
/// Ctrl-C ends it. A thread must not share it twice: a change may wait in between.
class FairMutex {
 public:
  void lock() {
    wait([&] { return turn_.try_lock_for(pause); });
    const std::lock_guard turn(turn_, std::adopt_lock);
    wait([&] { return mutex_.try_lock_for(pause); });
  }
  void unlock() { mutex_.unlock(); }

  void lock_shared() {
    if (!turn_.try_lock())
      wait([&] { return turn_.try_lock_for(pause); });  // the clock is read for waits alone
    const std::lock_guard turn(turn_, std::adopt_lock);
    if (!mutex_.try_lock_shared()) wait([&] { return mutex_.try_lock_shared_for(pause); });
  }
  void unlock_shared() { mutex_.unlock_shared(); }

 private:
  static constexpr std::chrono::milliseconds pause{100};

  template <class Try>
  static void wait(Try try_once) {
    while (!try_once()) cancellation_point();
  }

  std::timed_mutex turn_;  // held by the thread that is next
  std::shared_timed_mutex mutex_;
};

}  // namespace delone::python
