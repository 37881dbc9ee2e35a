// SPDX-License-Identifier: BSD-3-Clause
// The floating-point state in which the library computes.
#pragma once

#include <delone/export.hpp>

#include <cstdint>

namespace delone {

/// While it lives, its thread computes as IEEE 754 says: subnormal numbers are numbers, results are rounded
/// to nearest, and no operation traps. Afterwards the thread has the state back that it had before, also if
/// an exception leaves.
///
/// Every function of the library makes one, in each of its threads, so callers need none: what -ffast-math,
/// fesetround() or feenableexcept() have set neither changes a result nor is changed. One around many single
/// calls saves the two changes of state per call. If the state is already right, it costs nanoseconds.
///
/// Progress functions are called in the state of the caller, other callbacks in that of the library. Scopes
/// of one thread end in the reverse order of their creation.
class DELONE_EXPORT ArithmeticScope {
 public:
  ArithmeticScope() noexcept;
  ArithmeticScope(const ArithmeticScope&) = delete;
  ArithmeticScope& operator=(const ArithmeticScope&) = delete;
  ~ArithmeticScope();

 private:
  bool is_changed_;
  std::uint64_t state_ = 0;            // of the caller, if it was changed
  std::uint64_t* of_outer_ = nullptr;  // the state_ of the scope around this one that changed it
};

}  // namespace delone
