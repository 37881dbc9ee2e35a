// SPDX-License-Identifier: BSD-3-Clause
#include "base/progress_meter.hpp"

#include "base/arithmetic.hpp"
#include "base/coarse_clock.hpp"

#include <delone/progress.hpp>

#include <algorithm>
#include <utility>

namespace delone {
namespace internal {

constinit thread_local ProgressMeter* current_meter = nullptr;

ProgressMeter::ProgressMeter(const std::function<bool(double)>& callback)
    : callback_(callback),
      outer_(current_meter),
      target_(callback && !(outer_ != nullptr && &outer_->callback_ == &callback) ? this : current_meter) {
  if (target_ == this) current_meter = this;
}

ProgressMeter::ProgressMeter(const std::function<bool(double)>& callback, std::size_t total)
    : ProgressMeter(callback) {
  if (target_ == nullptr || target_->is_counted_) return;
  counts_ = target_->is_counted_ = true;
  target_->done_ = 0;
  target_->total_ = total;
  target_->fraction_ = 0;
}

ProgressMeter::~ProgressMeter() {
  if (counts_) target_->is_counted_ = false;
  if (target_ == this) current_meter = outer_;
}

void ProgressMeter::look() {
  calls_ = 0;
  const Clock::time_point now = platform::coarse_now();
  step_ = now - last_look_ < std::chrono::milliseconds(1) ? std::min(2 * step_, longest_step) : 1;
  last_look_ = now;
  // The clock goes on in steps of some milliseconds.
  if (now - last_call_ < std::chrono::milliseconds(16)) return;
  last_call_ = now;
  const double share = total_ == 0 ? 1.0 : static_cast<double>(done_) / static_cast<double>(total_);
  fraction_ = std::max(fraction_, share);
  // What the function calls of the library has no part in this.
  ProgressMeter* const meter = std::exchange(current_meter, nullptr);
  bool goes_on = false;
  try {
    const CallersArithmetic arithmetic;
    goes_on = callback_(fraction_);
  } catch (...) {
    current_meter = meter;
    throw;
  }
  current_meter = meter;
  if (!goes_on) throw Error(Errc::cancelled, "cancelled by the progress callback");
  if (outer_ == nullptr) return;
  if (!outer_->is_counted_) {  // it hears what is done here
    outer_->done_ = done_;
    outer_->total_ = total_;
    outer_->fraction_ = fraction_;
  }
  outer_->poll();
}

}  // namespace internal

ProgressScope::ProgressScope(std::function<bool(double)> progress)
    : progress_(std::move(progress)), meter_(std::make_unique<internal::ProgressMeter>(progress_)) {}
ProgressScope::~ProgressScope() = default;

void cancellation_point() { internal::cancellation_point(); }

}  // namespace delone
