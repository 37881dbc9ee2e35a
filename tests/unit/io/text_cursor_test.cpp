// SPDX-License-Identifier: BSD-3-Clause
// Numbers and counts by themselves; lines, comments and tokens; errors that name the place.
#include "io/text_cursor.hpp"
#include "io_support.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace {

using namespace delone;
using delone_test::expect_error;
using io::TextCursor;

TEST(Numbers, AreReadWhole) {
  EXPECT_EQ(io::to_number("0.1"), 0.1);
  EXPECT_EQ(io::to_number("+2e-3"), 0.002);
  EXPECT_EQ(io::to_number("-.5"), -0.5);
  EXPECT_TRUE(std::isnan(io::to_number("nan").value()));
  for (const char* text : {"", "+", "+-1", "-+1", " 1", "1 ", "1x", "1,5", "one"})
    EXPECT_EQ(io::to_number(text), std::nullopt) << text;
}

TEST(Numbers, BeyondTheRangeAreInfiniteOrZero) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(io::to_number("1e999"), infinity);
  EXPECT_EQ(io::to_number("-1e999"), -infinity);
  EXPECT_EQ(io::to_number("1e-999"), 0.0);
}

TEST(Counts, HaveAtMost64Bits) {
  EXPECT_EQ(io::to_count("0"), 0u);
  EXPECT_EQ(io::to_count("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"", "-1", "+1", " 1", "1 ", "1.0", "0x1", "18446744073709551616"})
    EXPECT_EQ(io::to_count(text), std::nullopt) << text;
}

TEST(TextOf, SkipsTheByteOrderMark) {
  EXPECT_EQ(io::text_of("\xef\xbb\xbf"
                        "1 2",
                        "f"),
            "1 2");
  EXPECT_EQ(io::text_of("1 2", "f"), "1 2");
  expect_error(Errc::bad_format, {"f", "empty"}, [] { io::text_of("", "f"); });
  expect_error(Errc::bad_format, {"f", "empty"}, [] { io::text_of("\xef\xbb\xbf", "f"); });
  for (const char* mark : {"\xff\xfe", "\xfe\xff"})
    expect_error(Errc::bad_format, {"f", "UTF-16"}, [&] { io::text_of(mark, "f"); });
}

TEST(TextCursor, KnowsItsLineWhateverEndsLines) {
  TextCursor cursor("a\nb\r\nc\rd", "f");
  for (const char* expected : {"a", "b", "c", "d"}) {
    EXPECT_EQ(cursor.place(), "f:" + std::to_string(expected[0] - 'a' + 1));
    EXPECT_EQ(cursor.token(), expected);
    ASSERT_TRUE(cursor.at_line_end());
    cursor.take_line_end();
  }
  EXPECT_TRUE(cursor.at_end());
  EXPECT_EQ(cursor.line(), 4u);  // there is no line after the last
}

TEST(TextCursor, SkipsBlanksAndComments) {
  TextCursor cursor("# first\n\n \t one#two\n#three\n  four five \v\n", "f");
  EXPECT_EQ(cursor.next_token(), "one");
  EXPECT_EQ(cursor.line(), 3u);
  EXPECT_TRUE(cursor.skip_to_content());
  EXPECT_EQ(cursor.token(), "");
  EXPECT_TRUE(cursor.find_content());
  EXPECT_EQ(cursor.line(), 5u);
  EXPECT_EQ(cursor.rest_of_line(), "four five");
  EXPECT_TRUE(cursor.at_line_end());
  EXPECT_FALSE(cursor.find_content());
  EXPECT_EQ(cursor.next_token(), "");
  EXPECT_EQ(cursor.remaining(), 0u);
}

TEST(TextCursor, ReadsNumbersUpToTheirDelimiter) {
  TextCursor cursor("1.5#comment\n-2\t3x", "f");
  EXPECT_EQ(cursor.number("x"), 1.5);
  EXPECT_TRUE(cursor.find_content());
  EXPECT_EQ(cursor.number("x"), -2);
  cursor.skip_blanks();
  expect_error(Errc::bad_format, {"f:2", "height", "'3x'", "not a number"}, [&] { cursor.number("height"); });
  TextCursor nothing("", "f");
  expect_error(Errc::bad_format, {"f:1", "''"}, [&] { nothing.number("height"); });
}

TEST(TextCursor, ReadsCountsUpToTheLargest) {
  TextCursor cursor("\n7 8 -1", "f");
  EXPECT_EQ(cursor.count("rows", 7), 7u);
  expect_error(Errc::bad_format, {"f:2", "rows", "8", "7"}, [&] { cursor.count("rows", 7); });
  expect_error(Errc::bad_format, {"f:2", "'-1'", "not a count"}, [&] { cursor.count("rows", 7); });
  expect_error(Errc::bad_format, {"f:2", "ends before rows"}, [&] { cursor.count("rows", 7); });
}

}  // namespace
