// SPDX-License-Identifier: BSD-3-Clause
// The floating-point state of a thread: rounding, subnormal numbers and traps.
//
// Filters are proved, and exact arithmetic is exact, in one state only. That of a caller may be another: code
// compiled with -ffast-math sets flush-to-zero as soon as it is loaded, and then distinct points would become
// equal without an error. ArithmeticScope, in all that is public, and in run_workers() for other threads,
// sees to the state.
#pragma once

#include <delone/arithmetic.hpp>

#include <cstdint>

namespace delone::internal {

/// While it lives, the thread is in the state of the caller of the library again, for functions of the user.
/// What these change of it lasts until they return.
class CallersArithmetic {
 public:
  CallersArithmetic() noexcept;
  CallersArithmetic(const CallersArithmetic&) = delete;
  CallersArithmetic& operator=(const CallersArithmetic&) = delete;
  ~CallersArithmetic();

 private:
  std::uint64_t state_;             // of the library
  std::uint64_t* const of_caller_;  // null if the library has not changed it
};

}  // namespace delone::internal
