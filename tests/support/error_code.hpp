// SPDX-License-Identifier: BSD-3-Clause
// The code of the Error that a call throws.
#pragma once

#include <delone/error.hpp>

#include <gtest/gtest.h>

namespace delone::test {

/// Fails the test if the call throws none.
template <class Call>
Errc code_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "no error";
  return Errc::unsupported;
}

}  // namespace delone::test
