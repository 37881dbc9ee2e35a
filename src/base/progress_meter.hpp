// SPDX-License-Identifier: BSD-3-Clause
// Calls the user's progress function about every 20 milliseconds, and turns its `false` into
// Errc::cancelled.
//
// Loops that can take long call cancellation_point() in every round of up to some milliseconds. It asks the
// meter of this thread, if there is one: that of the call with a progress function, or of a ProgressScope.
// So the innermost loops need no parameter for it.
#pragma once

#include <delone/error.hpp>

#include <chrono>
#include <cstddef>
#include <functional>

namespace delone::internal {

class ProgressMeter;
/// The innermost meter of this thread that has a function.
extern constinit thread_local ProgressMeter* current_meter;

/// Meters of one thread end in the reverse order of their beginning. One without a function, or with
/// that of the meter around it, hands what is done to that one, unless another counts for it already.
class ProgressMeter {
 public:
  /// `callback` must outlive the meter; without a total the fraction is that of meters within this one.
  explicit ProgressMeter(const std::function<bool(double)>& callback);
  ProgressMeter(const std::function<bool(double)>& callback, std::size_t total);
  ProgressMeter(const ProgressMeter&) = delete;
  ProgressMeter& operator=(const ProgressMeter&) = delete;
  ~ProgressMeter();

  /// Throws Errc::cancelled if the function says so.
  void operator()(std::size_t done) {
    if (target_ == nullptr) return;
    if (counts_) target_->done_ = done;
    target_->poll();
  }
  /// Reads the clock less often while calls follow each other within microseconds.
  void poll() {
    if (++calls_ >= step_) look();
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Few, as a slow round may follow quick ones.
  static constexpr std::size_t longest_step = 16;

  void look();

  const std::function<bool(double)>& callback_;
  ProgressMeter* const outer_;
  ProgressMeter* const target_;  // this one, or the one that has the function
  bool counts_ = false;          // says what of the target is done
  bool is_counted_ = false;      // some meter does for this one
  std::size_t done_ = 0, total_ = 1;
  double fraction_ = 0;
  std::size_t calls_ = 0, step_ = 1;  // since the clock was last read, and from one reading to the next
  Clock::time_point last_look_{}, last_call_{};
};

/// Throws Errc::cancelled if the progress function of this thread's call says so. Costs nanoseconds.
inline void cancellation_point() {
  if (ProgressMeter* const meter = current_meter; meter != nullptr) meter->poll();
}

}  // namespace delone::internal
