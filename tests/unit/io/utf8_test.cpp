// SPDX-License-Identifier: BSD-3-Clause
// Characters of UTF-8, and bytes that are none.
#include "io/utf8.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace {

using namespace delone;

TEST(Utf8, CharactersAreReadAsTheyAreAppended) {
  for (const std::uint32_t code :
       {0x1u, 0x7fu, 0x80u, 0x7ffu, 0x800u, 0xd7ffu, 0xe000u, 0xffffu, 0x10000u, 0x10ffffu}) {
    std::string text = "x";
    io::append_utf8(text, code);
    const io::Character c = io::first_character(std::string_view(text).substr(1));
    EXPECT_TRUE(c.is_valid) << code;
    EXPECT_EQ(c.code, code);
    EXPECT_EQ(c.size, text.size() - 1);
  }
  std::string text;
  for (const std::uint32_t code : {0xd800u, 0xdfffu, 0x110000u, 0xffffffffu}) io::append_utf8(text, code);
  EXPECT_EQ(text, "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(Utf8, BytesThatBeginNoCharacter) {
  for (const char* text :
       {"\x80", "\xc1\xbf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf5", "\xc3"}) {
    const io::Character c = io::first_character(text);
    EXPECT_FALSE(c.is_valid);
    EXPECT_EQ(c.size, 1u);
    EXPECT_EQ(c.code, static_cast<unsigned char>(text[0]));
  }
}

}  // namespace
