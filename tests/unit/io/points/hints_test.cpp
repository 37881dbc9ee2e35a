// SPDX-License-Identifier: BSD-3-Clause
#include "io/points/hints.hpp"

#include "../io_support.hpp"
#include "io/points/text_rows.hpp"

namespace delone::io {
namespace {

TEST(QhullForm, IsToldFromRows) {
  for (const char* text : {"3 rbox 10 D3\n1\n0 0 0\n", "3\n2\n0 0 0\n1 1 1\n", "1 rbox 2 D1\n2\n0.5\n1\n",
                           "# c\n\n2 x\n# d\n2\n0 0\n1 1\n", "3 nothing\n0\n",
                           "\xef\xbb\xbf"
                           "2\r\n1\r\n5 6\r\n",
                           "2 rbox\n4\n1 2 3 4 5 6 7 8\n"})
    EXPECT_TRUE(is_qhull_form(text)) << text;
  // All that can be rows of numbers, and other things.
  for (const char* text : {"", "\n", "3\n", "3\n4\n", "1\n2\n3\n", "1\n3\n0.5\n0.7\n0.9\n", "2 3\n4 5\n6 7\n",
                           "2 1\n2 2\n", "2\n3\n4\n", "3\n2\n0 0\n", "2.5 x\n1\n0 0\n", "0 x\n1\n0\n",
                           "x\n1\n0\n", "3 rbox\n1 2\n0 0 0\n", "2\nwater\nO 0 0 0\n"})
    EXPECT_FALSE(is_qhull_form(text)) << text;
}

TEST(Hints, SayWhatAFileLooksLike) {
  struct Case {
    const char *format, *text, *said;
  };
  using namespace std::string_literals;
  for (const Case& c : std::vector<Case>{{"csv", "a;b\n1;2\n", "separated by ';', which no format is"},
                                         {"csv", "1,5;2,5\n1,25;3\n", "decimal commas"},
                                         {"csv", "a|b\n1|2\n", "separated by '|'"},
                                         {"csv", "name;x;y\nfoo;1;2\n", "separated by ';'"},
                                         {"csv", "1 2\n3 4\n", "format = \"txt\""},
                                         {"csv", "1\t2\n3\t4\n", "format = \"tsv\""},
                                         {"tsv", "1,2\n3,4\n", "format = \"csv\""},
                                         {"txt", "x,y\n1,2\n", "format = \"csv\""},
                                         {"txt", "1, 2\n3, 4\n", "format = \"csv\""},
                                         {"qhull", "1 2\n3 4\n", "format = \"txt\""},
                                         {"qhull", "x,y\n3,4\n", "format = \"csv\""},
                                         {"txt", "x y\n1 2\n", "looks like a header"},
                                         {"csv", "2 rbox\n2\n0 0\n1 1\n", "format = \"qhull\""},
                                         {"txt", "1\nc\nH 0 0 0\n", "format = \"xyz\""},
                                         {"csv", "LASF", "format = \"las\""},
                                         {"txt", "nOFF\n2\n", "format = \"off\""},
                                         {"npy", "ply\nformat", "format = \"ply\""},
                                         {"csv", "%PDF-1.4", "a PDF file"},
                                         {"csv", "1,2\n3,x\n", ""},
                                         {"csv", "a,b\n1,\n", ""},
                                         {"txt", "1 2\n3\n", ""},
                                         {"txt", "a b\nc d\n", ""},
                                         {"csv", "words\nand more\n", ""},
                                         {"qhull", "2\n3\n0 0\n", ""},
                                         {"csv", "", ""},
                                         {"ply", "ply\n", ""}}) {
    const std::string hint = hint_for(c.text, c.format);
    EXPECT_TRUE(*c.said == '\0' ? hint.empty() : hint.find(c.said) != std::string::npos)
        << c.text << ": " << hint;
  }
  EXPECT_EQ(hint_for("1,\0\n"s, "csv"), "this is a binary file");
}

TEST(Hints, AreAddedToWhatReadersSay) {
  const auto read = []() -> int { throw Error(Errc::bad_format, "f: bad", {3}); };
  EXPECT_EQ(delone_test::expect_error(Errc::bad_format, {"f: bad; this looks like it is separated by tabs"},
                                      [&] { with_hint("1\t2\n", "csv", read); }),
            std::vector<std::size_t>{3});
  delone_test::expect_error(Errc::cannot_open, {"f"}, [&] {
    with_hint("1\t2\n", "csv", []() -> int { throw Error(Errc::cannot_open, "f"); });
  });
  EXPECT_EQ(with_hint("", "csv", [] { return 7; }), 7);
}

TEST(Hints, PiecesOfATableAreRecognised) {
  const std::string text = "2 rbox 3 D2\n3\n0 0\n1 0\n0 1\n";
  const auto rows = open_text_rows("txt", "f");
  PointCollector points;
  EXPECT_EQ(rows->read(text, true, points), text.size());
  EXPECT_EQ(rows->width(), 2u);
  EXPECT_EQ(points.table.coordinates.size(), 6u);
}

}  // namespace
}  // namespace delone::io
