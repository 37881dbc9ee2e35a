// SPDX-License-Identifier: BSD-3-Clause
#include "io/points/text_rows.hpp"
#include "../io_support.hpp"

namespace delone::io {
namespace {

/// Reads a text in pieces: of `num_lines` lines each at first, and more where that is not enough.
PointTable read_in_pieces(const std::string& format, const std::string& text, std::size_t num_lines) {
  const auto rows = open_text_rows(format, "f");
  PointCollector points;
  std::size_t begin = 0, wanted = num_lines;
  for (bool is_last = false; !is_last;) {
    std::size_t end = begin;
    for (std::size_t line = 0; line < wanted && end < text.size(); ++line)
      end = std::min(text.find('\n', end), text.size() - 1) + 1;
    is_last = end == text.size();
    const std::size_t size = rows->read(std::string_view(text).substr(begin, end - begin), is_last, points);
    EXPECT_LE(size, end - begin);
    if (is_last) {
      EXPECT_EQ(size, end - begin);
    }
    wanted = size == 0 ? wanted + 1 : num_lines;
    begin += size;
  }
  points.table.dimension = static_cast<int>(rows->width());
  return points.finish();
}

class TextRowsTest : public delone_test::TemporaryDirectory {};

TEST_F(TextRowsTest, ReadPiecesOfAnySize) {
  const std::pair<std::string, std::string> texts[] = {
      {"csv", "x,y\n1,2\n\n# c\n3,4\n5,6"},
      {"csv", "\xef\xbb\xbf\"a\n\nb\",\"y\"\n\"1\n\n\",2\n3,\"\n4\"\n"},
      {"tsv", "1\t2\n3\t4\n"},
      {"txt", "\xef\xbb\xbf# c\n\n1 2 3\n4 5 6 # c\n\n7 8 9"},
      {"txt", "1 2\r\n3 4\r\n5 6\r\n"},
      {"qhull", "2 c\n# c\n4\n1 2\n3\n\n4 5 6 7\n8\n# end\n"},
      {"qhull", "3\n0\n"},
  };
  for (const auto& [format, text] : texts) {
    const PointTable whole = read("whole." + format, text);
    for (std::size_t num_lines = 1; num_lines < 12; ++num_lines) {
      SCOPED_TRACE(text + " in pieces of " + std::to_string(num_lines));
      const PointTable table = read_in_pieces(format, text, num_lines);
      EXPECT_EQ(table.dimension, whole.dimension);
      EXPECT_EQ(table.coordinates, whole.coordinates);
    }
  }
}

TEST_F(TextRowsTest, NameTheLine) {
  const std::pair<std::string, std::string> texts[] = {
      {"csv", "x,y\n1,2\n\n3\n"},          {"csv", "x,y\n\"1\n\",2\n3,4,5\n"}, {"csv", "x\n1\n\"2\n3"},
      {"csv", "x,y\n1,2\n3,nan\n4,inf\n"}, {"txt", "# c\n1 2\n\n3\n"},         {"txt", "1\n2\n1e999\n"},
      {"qhull", "2\n3\n1 2\n3 4\n5\n"},    {"qhull", "2\n1\n1 2\n\n3\n"},      {"qhull", "1\n2\n0\nx\n"},
      {"qhull", "1\n3\n0\nnan\n1\n"},
  };
  for (const auto& [format, text] : texts) {
    std::string expected;
    try {
      read("f." + format, text);
    } catch (const Error& error) {
      expected = error.what();
    }
    const std::string name = path("f." + format);
    ASSERT_TRUE(expected.starts_with(name)) << expected;
    expected = "f" + expected.substr(name.size());
    expected = expected.substr(0, expected.find("; skip_missing"));  // what read_points() adds
    for (std::size_t num_lines = 1; num_lines < 8; ++num_lines) {
      SCOPED_TRACE(text + " in pieces of " + std::to_string(num_lines));
      try {
        read_in_pieces(format, text, num_lines);
        ADD_FAILURE();
      } catch (const Error& error) {
        EXPECT_EQ(error.what(), expected);
      }
    }
  }
}

}  // namespace
}  // namespace delone::io
