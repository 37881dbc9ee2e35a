// SPDX-License-Identifier: BSD-3-Clause
#include "io/crc32.hpp"

#include <gtest/gtest.h>

namespace {

using namespace delone;

TEST(Crc32, IsThatOfZip) {
  EXPECT_EQ(io::crc32("123456789"), 0xcbf43926u);
  EXPECT_EQ(io::crc32(""), 0u);
  EXPECT_EQ(io::crc32("The quick brown fox jumps over the lazy dog"), 0x414fa339u);
  EXPECT_EQ(io::crc32("over the lazy dog", io::crc32("The quick brown fox jumps ")), 0x414fa339u);
}

TEST(FileContent, IsThatOfAllPieces) {
  io::FileContent whole, pieces;
  whole.add("123456789");
  for (const char* piece : {"1", "", "2345", "6789"}) pieces.add(piece);
  EXPECT_EQ(pieces, whole);
  EXPECT_EQ(whole.num_bytes, 9);
  EXPECT_EQ(whole.crc32, 0xcbf43926);
}

}  // namespace
