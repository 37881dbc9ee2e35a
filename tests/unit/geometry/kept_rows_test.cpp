// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/kept_rows.hpp"

#include <gtest/gtest.h>

#include <array>

namespace delone::geometry {
namespace {

TEST(KeptRows, AreReadByOthersWhereTheyAre) {
  KeptRows rows(2);
  rows.reserve(3);
  const std::array<double, 2> first{1, 2}, other{3, 4};
  rows.set(1, first.data());
  rows.row(3)[0] = 5;
  KeptRows shared(rows, KeptRows::ForThread());
  EXPECT_EQ(shared.data(), rows.data());
  shared.reserve(1000);
  shared.set(1, other.data());  // another thread has set it
  EXPECT_EQ(rows.data()[2], 1);
  EXPECT_EQ(shared.data()[3], 2);
  EXPECT_EQ(shared.data()[6], 5);
}

}  // namespace
}  // namespace delone::geometry
