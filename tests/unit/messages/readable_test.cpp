// SPDX-License-Identifier: BSD-3-Clause
#include "messages/readable.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace delone::messages {
namespace {

TEST(Readable, Bytes) {
  EXPECT_EQ(readable_bytes(0), "0 bytes");
  EXPECT_EQ(readable_bytes(999), "999 bytes");
  EXPECT_EQ(readable_bytes(1500), "1.5 kB");
  EXPECT_EQ(readable_bytes(8e9), "8 GB");
  EXPECT_EQ(readable_bytes(8.6e9), "8.6 GB");
  EXPECT_EQ(readable_bytes(9.97e9), "10 GB");
  EXPECT_EQ(readable_bytes(840.2e6), "840 MB");
  EXPECT_EQ(readable_bytes(999.7e6), "1 GB");
  EXPECT_EQ(readable_bytes(1e20), "100 EB");
  for (const double large : {1.1e21, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(readable_bytes(large), "more than 1000 EB");
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(readable_bytes(bad), "an unknown number of bytes");
}

TEST(Readable, Seconds) {
  EXPECT_EQ(readable_seconds(0.012), "0.01 seconds");
  EXPECT_EQ(readable_seconds(0.25), "0.25 seconds");
  EXPECT_EQ(readable_seconds(1), "1 second");
  EXPECT_EQ(readable_seconds(89), "89 seconds");
  EXPECT_EQ(readable_seconds(240), "4 minutes");
  EXPECT_EQ(readable_seconds(9000), "2.5 hours");
  EXPECT_EQ(readable_seconds(3 * 86400), "3 days");
  EXPECT_EQ(readable_seconds(1e12), "more than 1000 years");
  EXPECT_EQ(readable_seconds(std::numeric_limits<double>::quiet_NaN()), "an unknown time");
}

}  // namespace
}  // namespace delone::messages
