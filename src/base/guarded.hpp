// SPDX-License-Identifier: BSD-3-Clause
// The library throws delone::Error and nothing else: here exhausted memory becomes one. Most of what is
// public does its work in here, so this also sees to the floating-point state.
#pragma once

#include <delone/arithmetic.hpp>
#include <delone/error.hpp>

#include <new>
#include <string>
#include <utility>

namespace delone::internal {

/// Runs `work` and returns what it returns; std::bad_alloc becomes Errc::out_of_memory, "not enough memory
/// for " and `what`.
template <class Work>
decltype(auto) guarded(const char* what, Work&& work) {
  const ArithmeticScope arithmetic;
  try {
    return std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, std::string("not enough memory for ") + what);
  }
}

}  // namespace delone::internal
