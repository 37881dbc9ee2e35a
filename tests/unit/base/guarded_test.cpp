// SPDX-License-Identifier: BSD-3-Clause
#include "base/guarded.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace delone::internal {
namespace {

TEST(Guarded, ReturnsWhatTheWorkReturns) {
  int x = 1;
  int& same = guarded("x", [&]() -> int& { return x; });
  EXPECT_EQ(&same, &x);
  guarded("x", [&] { x = 2; });
  EXPECT_EQ(x, 2);
}

TEST(Guarded, ExhaustedMemoryBecomesAnError) {
  try {
    guarded("7 cells", []() -> int { throw std::bad_alloc(); });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::out_of_memory);
    EXPECT_THAT(error.what(), testing::HasSubstr("not enough memory for 7 cells"));
  }
}

TEST(Guarded, OtherExceptionsPass) {
  EXPECT_THROW(guarded("x", [] { throw std::domain_error("x"); }), std::domain_error);
  EXPECT_THROW(guarded("x", [] { throw Error(Errc::cancelled, "x"); }), Error);
}

}  // namespace
}  // namespace delone::internal
