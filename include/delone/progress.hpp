// SPDX-License-Identifier: BSD-3-Clause
// Progress and cancellation of all calls of a thread.
#pragma once

#include <delone/export.hpp>

#include <functional>
#include <memory>

namespace delone {
namespace internal {
class ProgressMeter;
}

/// While it lives, all long calls of the library in this thread call a progress function about every 20 ms,
/// and throw Errc::cancelled if it returns false; objects are then unchanged. So queries, volumes, diagrams,
/// checks and files can be stopped as constructions can, and so can members that compute on first use.
///
///   const ProgressScope scope([&](double) { return !stop; });
///   const Measure volume = hull.volume();
///
/// The function receives the fraction done, 0…1, or 0 if it is not known. The progress function of a call
/// (Execution, Options) is called, too. Scopes of one thread end in the reverse order of their
/// creation.
class DELONE_EXPORT ProgressScope {
 public:
  /// An empty `progress` is never called.
  explicit ProgressScope(std::function<bool(double)> progress);
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
  ~ProgressScope();

 private:
  std::function<bool(double)> progress_;
  std::unique_ptr<internal::ProgressMeter> meter_;
};

/// For loops of the caller, such as over queries: calls the function of the innermost scope, as the library
/// does, and throws Errc::cancelled if it returns false. Costs nanoseconds.
DELONE_EXPORT void cancellation_point();

}  // namespace delone
