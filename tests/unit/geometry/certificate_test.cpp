// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/certificate.hpp"

#include "cells/cell_memory.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delone::geometry {
namespace {

TEST(Certificate, PacksToTheSafeSide) {
  const auto field = [](std::uint64_t packed, int shift) {
    return static_cast<double>(
        std::bit_cast<float>(static_cast<std::uint32_t>((packed >> shift & 0x7fff) << 16)));
  };
  for (const double x : {1e-30, 1e-12, 0.3, 1.0, 1.0 + 0x1p-30, 7e5, 3e20}) {
    const std::uint64_t packed = certificate::pack(x, x, x, false);
    EXPECT_FALSE(certificate::infinite(packed));
    EXPECT_GT(certificate::threshold(packed), x);
    EXPECT_LE(certificate::threshold(packed), (1 + 0x1p-21) * x);
    EXPECT_GT(field(packed, 32), x);
    EXPECT_LE(field(packed, 32), 1.02 * x);
    EXPECT_LE(field(packed, 48), x);
    EXPECT_GE(field(packed, 48), 0.98 * x);
    EXPECT_EQ(packed & cells::mark_bits::all, 0u);
  }
  EXPECT_GT(certificate::threshold(certificate::pack(1e-300, 1e-300, 1e-300, true)), 1e-300);
  EXPECT_GT(field(certificate::pack(1, 1e-300, 1, true), 32), 1e-300);
  EXPECT_EQ(field(certificate::pack(1, 1, 1e-300, true), 48), 0);
  EXPECT_LE(field(certificate::pack(1, 1, 1e300, true), 48), 1e300);
  for (const double x : {1e300, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_TRUE(std::isinf(certificate::threshold(certificate::pack(x, 1, 1, false))));
  const std::uint64_t unknown = certificate::pack(std::nan(""), 0, 0, true);
  EXPECT_TRUE(certificate::infinite(unknown));
  EXPECT_EQ(certificate::finite_mask(unknown), 0u);
  EXPECT_EQ(~certificate::finite_mask(certificate::pack(1, 1, 1, false)), 0u);
}

}  // namespace
}  // namespace delone::geometry
