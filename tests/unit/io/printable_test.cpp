// SPDX-License-Identifier: BSD-3-Clause
// Foreign text in messages: nothing that a terminal would act on, no more than was agreed.
#include <delone/printable.hpp>

#include "messages/in_quotes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>

namespace {

using delone::printable;
using delone::messages::in_quotes;

TEST(Printable, LeavesTextAsItIs) {
  for (const std::string text : {"", "a b", "größe in µm", "точка", "点", "x\\y 'z'", "\xf0\x9f\x98\x80"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesControlCharacters) {
  EXPECT_EQ(printable("\x1b[1m\n\r\t\x7f"), "\\x1b[1m\\x0a\\x0d\\x09\\x7f");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u{9b}31m");  // the one-character form of ESC [
}

TEST(Printable, EscapesWhatCannotBeSeen) {
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u{202e}b");
  EXPECT_EQ(printable("\xe2\x80\x8b\xef\xbb\xbf"), "\\u{200b}\\u{feff}");
}

TEST(Printable, EscapesBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("\xff\x80"), "\\xff\\x80");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");  // longer than need be
  EXPECT_EQ(printable("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half of a pair of UTF-16
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond Unicode
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");                    // cut off
  EXPECT_EQ(printable("\xe2\x82("
                      "\xe2\x82\xac"),
            "\\xe2\\x82(€");
}

TEST(Printable, EveryByteAloneAndAfterALeadByte) {
  for (int lead = -1; lead < 256; lead = lead < 0 ? 0xc0 : lead + 1)
    for (int byte = 0; byte < 256; ++byte) {
      std::string text;
      if (lead >= 0) text += static_cast<char>(lead);
      text += static_cast<char>(byte);
      for (const char c : printable(text))
        EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << lead << ' ' << byte;
      EXPECT_EQ(printable(printable(text)), printable(text));
    }
}

TEST(Printable, IsCutAtSoManyCharacters) {
  const std::string most(80, 'x');
  EXPECT_EQ(printable(most), most);
  EXPECT_EQ(printable(std::string(1'000'000, 'x')), most + "…");
  EXPECT_EQ(printable("äöü", 2), "äö…");
  EXPECT_EQ(printable("ab\x1b", 5), "ab…");  // an escape is not cut
  EXPECT_EQ(printable("ab\x1b", 6), "ab\\x1b");
  EXPECT_EQ(printable("ab", 0), "…");
  EXPECT_EQ(printable(std::string(200, 'x'), std::numeric_limits<std::size_t>::max()), std::string(200, 'x'));
}

TEST(InQuotes, EscapesAndShortens) {
  EXPECT_EQ(in_quotes("a b"), "'a b'");
  EXPECT_EQ(in_quotes(""), "''");
  EXPECT_EQ(in_quotes("\x1b[1m\xff\n"), "'\\x1b[1m\\xff\\x0a'");
  EXPECT_EQ(in_quotes(std::string(81, 'x')), "'" + std::string(80, 'x') + "…'");
}

}  // namespace
