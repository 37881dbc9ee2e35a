// SPDX-License-Identifier: BSD-3-Clause
// Progress and cancellation of calls without options of their own.
#pragma once

#include <delone/export.hpp>

#include <functional>
#include <memory>

namespace delone {
namespace internal {
class ProgressMeter;
}

/// While it lives, all calls of the library in this thread that take long ask a progress function about every
/// 20 ms, and throw Errc::cancelled if it returns false; objects then are as they were before the call. So
/// queries, volumes, diagrams, checks and files can be stopped as constructions can.
///
///   const ProgressScope scope([&](double) { return !stop; });
///   const Measure volume = hull.volume();
///
/// The function gets the fraction done, 0…1, of constructions; 0 where that is not known. A progress function
/// in the options of a call is asked, too. Scopes of one thread end in the reverse order of their beginning.
class DELONE_EXPORT ProgressScope {
 public:
  /// Nothing is asked if `progress` is empty.
  explicit ProgressScope(std::function<bool(double)> progress);
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
  ~ProgressScope();

 private:
  std::function<bool(double)> progress_;
  std::unique_ptr<internal::ProgressMeter> meter_;
};

/// For loops of the caller, as between queries: asks the function of the innermost scope, as the library
/// does, and throws Errc::cancelled if it returns false. Costs nanoseconds.
DELONE_EXPORT void cancellation_point();

}  // namespace delone
