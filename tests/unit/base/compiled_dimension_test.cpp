// SPDX-License-Identifier: BSD-3-Clause
#include "base/compiled_dimension.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace delone::internal {
namespace {

template <int First, int Last>
int chosen(std::size_t dimension) {
  return with_compiled_dimension<First, Last>(dimension, [](auto k) {
    static_assert(decltype(k)::value <= Last);
    return k();
  });
}

TEST(CompiledDimension, IsTheOneGivenOrZero) {
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_EQ((chosen<1, 4>(k)), k >= 1 && k <= 4 ? static_cast<int>(k) : 0) << k;
    EXPECT_EQ((chosen<3, 3>(k)), k == 3 ? 3 : 0) << k;
    EXPECT_EQ((chosen<2, 1>(k)), 0) << k;  // compiled for none
  }
}

TEST(CompiledDimension, ReferencesAreReturnedAsSuch) {
  int x = 1;
  EXPECT_EQ(&(with_compiled_dimension<1, 2>(2, [&](auto) -> int& { return x; })), &x);
}

}  // namespace
}  // namespace delone::internal
