// SPDX-License-Identifier: BSD-3-Clause
// Limits of memory and time of a construction. It ends before the machine does, and says how far it came.
#pragma once

#include "base/progress_meter.hpp"
#include "base/stopwatch.hpp"

#include <cstddef>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace delone::internal {

/// What a construction takes in all.
struct WholeCost {
  double bytes = 0, seconds = 0;                ///< 0: not known
  double bytes_factor = 1, seconds_factor = 1;  ///< by which they may be wrong
};

/// What a construction takes up to a fraction of its points, by a model: bytes on top of those of the process
/// before it began.
using CostModel = std::function<WholeCost(double fraction)>;

/// How far a construction has come.
struct Passed {
  double fraction = 0;  ///< of its points
  double seconds = 0, bytes = 0;
};

/// What the whole takes, from what has passed so far, the earliest first. Cost is taken to grow as a power of
/// the fraction, the same from half of the last fraction to it as from there to the end: points are inserted
/// so that those of any stretch cover the whole set. Where it may not grow, or has hardly changed in that
/// time (by less than 20 ms, 4 MB), it goes on as it was. Zeros where that says nothing.
WholeCost extrapolated(const std::vector<Passed>& passed, bool may_grow = true);

/// The same with a model: what has passed tells how many times as much as the model says is needed, and how
/// that changes. Where it says nothing, the model alone does. `bytes_before`: of the process, before.
WholeCost extrapolated(const std::vector<Passed>& passed, const CostModel& model, double bytes_before);

/// While it lives, constructions in this thread end with an error at a limit: Errc::out_of_memory once the
/// resident memory of the process comes near `memory` bytes, Errc::time_limit after `seconds`. 0 is no
/// limit. Both are looked at where a progress function would be called.
class BuildLimits {
 public:
  /// `items`: what is inserted, as "points". Throws Errc::invalid_argument for a bad number of seconds.
  BuildLimits(std::size_t memory, double seconds, const char* items);
  BuildLimits(const BuildLimits&) = delete;
  BuildLimits& operator=(const BuildLimits&) = delete;

  /// How costs grow as far as a model knows. Called at a limit only; must outlive the limits.
  void set_model(CostModel model) { model_ = std::move(model); }
  /// Whether the fraction done is one of items from now on. At first it is.
  void count_items(bool counts);
  /// Says that no item costs more because of others, so that the cost is proportional to their number.
  void set_independent() { independent_ = true; }

  /// Runs `work`; std::bad_alloc becomes Errc::out_of_memory with the message of the limit, if there is one.
  template <class Work>
  decltype(auto) guard(Work&& work) {
    try {
      return std::forward<Work>(work)();
    } catch (const std::bad_alloc&) {
      if (memory_ == 0) throw;
      throw_at_memory();
    }
  }

 private:
  bool look(double fraction);
  double near_limit() const;
  [[noreturn]] void throw_at_memory();
  std::string message(const std::string& limit) const;
  WholeCost whole() const;

  std::size_t memory_;
  double seconds_;
  const char* items_;
  bool counts_items_ = true, independent_ = false;
  CostModel model_;
  double bytes_before_ = 0;
  Stopwatch stopwatch_;
  std::vector<Passed> passed_;
  Passed last_;
  std::function<bool(double)> look_;
  std::optional<ProgressMeter> meter_;
};

}  // namespace delone::internal
