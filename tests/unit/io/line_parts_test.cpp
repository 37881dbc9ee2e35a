// SPDX-License-Identifier: BSD-3-Clause
// Parts of a text are whole lines, in order, and know their numbers; and points read in parts by several
// threads, and errors, are those of one thread.
#include "io/line_parts.hpp"

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "io/points/read_points.hpp"
#include "scale.hpp"

#include <delone/error.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace delone::io {
namespace {

constexpr ReadingInParts tiny{.threads = 2, .part_bytes = 3};

TEST(CountLineEnds, CountsAllKinds) {
  EXPECT_EQ(count_line_ends(""), 0u);
  EXPECT_EQ(count_line_ends("a"), 0u);
  EXPECT_EQ(count_line_ends("\n"), 1u);
  EXPECT_EQ(count_line_ends("\r"), 1u);
  EXPECT_EQ(count_line_ends("\r\n"), 1u);
  EXPECT_EQ(count_line_ends("\n\r"), 2u);
  EXPECT_EQ(count_line_ends("a\r\r\nb\n\nc\rd"), 5u);
}

TEST(SplitLines, GivesWholeLinesWithTheirNumbers) {
  if (internal::threads_to_use(2) < 2) GTEST_SKIP() << "a build without threads";
  const std::string text = "one\ntwo\r\n\r\nthree\rfour\r\r5\n\nsix";
  const std::vector<LinePart> parts = split_lines(text, 10, 0, tiny);
  ASSERT_GT(parts.size(), 3u);
  std::string joined;
  std::size_t line = 10;
  for (const LinePart& part : parts) {
    EXPECT_EQ(part.first_line, line);
    const bool is_last = &part == &parts.back();
    EXPECT_EQ(part.num_lines, count_line_ends(part.text) + is_last);
    EXPECT_TRUE(is_last || part.text.ends_with('\n') || part.text.ends_with('\r'));
    EXPECT_FALSE(joined.ends_with('\r') && part.text.starts_with('\n'));
    line += part.num_lines;
    joined += part.text;
  }
  EXPECT_EQ(joined, text);
  EXPECT_EQ(line, 10u + 9);
}

TEST(SplitLines, LeavesToOneThreadWhatItMust) {
  if (internal::threads_to_use(2) < 2) GTEST_SKIP() << "a build without threads";
  const std::string text = "1,2\n3,4\n5,6\n\"7\",8\n";
  EXPECT_FALSE(split_lines(text, 1, 0, tiny).empty());
  EXPECT_TRUE(split_lines(text, 1, '"', tiny).empty());
  EXPECT_TRUE(split_lines(text, 1, 0, {.threads = 1, .part_bytes = 3}).empty());
  EXPECT_TRUE(split_lines(text, 1, 0, {.threads = 8, .part_bytes = 1000}).empty());
  EXPECT_TRUE(split_lines("", 1, 0, tiny).empty());
}

/// What a reader makes of a text: the table bit by bit, or the error.
template <class Read>
std::string outcome(const Read& read) {
  std::string result;
  try {
    const PointTable table = read();
    result = std::to_string(table.dimension);
    for (const std::string& name : table.column_names) result += " " + name;
    for (const double x : table.coordinates) result += " " + std::to_string(std::bit_cast<std::uint64_t>(x));
  } catch (const Error& error) {
    result = error.what();
    for (const std::size_t row : error.rows()) result += " " + std::to_string(row);
  }
  return result;
}

/// Lines of which most are rows of three numbers. The rate of others is that of `odd` in 1000.
std::string make_text(char delimiter, std::uint64_t odd, random::Generator& generator) {
  static constexpr const char* values[] = {"1", "-0.0", "3.25e-7", "123456789.0625", "5e-324", "0.1"};
  static constexpr const char* odd_values[] = {"nan", "-inf", "1e999", "x", "", "\"2\"", "\"a\nb\"", "4 5"};
  static constexpr const char* odd_lines[] = {"", "# comment", "  ", "7", "1 2 3 4"};
  const char* const line_end = std::vector<const char*>{"\n", "\r\n", "\r"}[generator.below(3)];
  std::string text = generator.below(3) == 0 && delimiter == ',' ? "x,y,z\n" : "";
  const auto pick = [&](const auto& from) { return from[generator.below(std::size(from))]; };
  for (std::uint64_t lines = generator.below(60); lines-- > 0;) {
    for (int i = 0; i < 3; ++i) {
      text += generator.below(1000) < odd ? pick(odd_values) : pick(values);
      if (i < 2) text += delimiter;
    }
    text += line_end;
    if (generator.below(1000) < 3 * odd) text += pick(odd_lines) + std::string(line_end);
  }
  return text + (generator.below(2) == 0 ? "1.5" + std::string(2, delimiter) : "");
}

TEST(ReadingInParts, GivesThePointsAndErrorsOfOneThread) {
  random::Generator generator(1);
  std::size_t num_tables = 0, rounds = test::scaled_count(100);
  for (std::size_t round = 0; round < rounds; ++round) {
    const char delimiter = ",\t "[generator.below(3)];
    const std::string text = make_text(delimiter, std::uint64_t{4} * generator.below(4), generator);
    const std::vector<std::string> columns =
        generator.below(4) == 0 ? std::vector<std::string>{"2", "0"} : std::vector<std::string>{};
    const auto read = [&](const ReadingInParts& how) {
      return outcome([&] {
        return delimiter == ' ' ? read_white_space(text, "f", how)
                                : read_delimited(text, "f", delimiter, {.wanted = columns, .last = {}}, how);
      });
    };
    const std::string expected = read({});
    num_tables += !expected.starts_with("f:");
    for (const unsigned threads : {2u, 3u, 8u})
      for (const std::size_t part_bytes : {1, 20, 150})
        ASSERT_EQ(read({threads, part_bytes}), expected)
            << threads << " threads, parts of " << part_bytes << " bytes: " << text;
  }
  EXPECT_GT(num_tables, rounds / 8);
  EXPECT_LT(num_tables, rounds * 7 / 8);
}

// Lines without points leave gaps, which are closed.
TEST(ReadingInParts, LeavesNoGaps) {
  std::string text = "# header\n";
  std::vector<double> expected;
  for (int i = 0; i < 200; ++i) {
    text +=
        std::to_string(i) + ".000000 " + std::to_string(i) + ".5000000\n" + (i % 7 == 3 ? "# none\n\n" : "");
    expected.insert(expected.end(), {static_cast<double>(i), i + 0.5});
  }
  EXPECT_EQ(read_white_space(text, "f", {.threads = 3, .part_bytes = 64}).coordinates, expected);
}

}  // namespace
}  // namespace delone::io
