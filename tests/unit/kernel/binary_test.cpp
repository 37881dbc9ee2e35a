// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/binary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace delone::kernel {
namespace {

TEST(Binary, IsTheNumberItself) {
  using Limits = std::numeric_limits<double>;
  for (const double x : {0.0, -0.0, 1.0, -1.5, 0.1, -1e300, Limits::max(), Limits::min(),
                         Limits::denorm_min(), -Limits::denorm_min(), std::nextafter(Limits::min(), 0.0)}) {
    const Binary binary = decompose(x);
    EXPECT_LT(std::abs(binary.mantissa), std::int64_t{1} << 53) << x;
    EXPECT_EQ(std::ldexp(static_cast<double>(binary.mantissa), binary.exponent), x);
  }
}

}  // namespace
}  // namespace delone::kernel
