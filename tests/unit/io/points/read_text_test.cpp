// SPDX-License-Identifier: BSD-3-Clause
// Points from csv, tsv, white space separated text and Qhull's form: what is accepted, and that every fault
// is named.
#include "../io_support.hpp"

#include <delone/printable.hpp>

#include <unistd.h>
#include <cmath>
#include <limits>

namespace {

using namespace delone;
using delone_test::expect_error;
using Doubles = std::vector<double>;
using Names = std::vector<std::string>;

class ReadCsv : public delone_test::TemporaryDirectory {};
class ReadWhiteSpace : public delone_test::TemporaryDirectory {};
class ReadQhull : public delone_test::TemporaryDirectory {};
class ReadPath : public delone_test::TemporaryDirectory {};

TEST_F(ReadCsv, RowsOfNumbers) {
  const auto t = read("a.csv", "1,2,3\n4,5,6\n");
  EXPECT_EQ(t.dimension, 3);
  EXPECT_EQ(t.coordinates, (Doubles{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(t.column_names.empty());
}

TEST_F(ReadCsv, LineEndsBomBlankLinesCommentsAndSpaces) {
  const Doubles expected{1, 2, 3, 4};
  for (const char* text : {"1,2\r\n3,4\r\n", "1,2\r3,4", "1,2\n3,4",
                           "\xef\xbb\xbf"
                           "1,2\n3,4\n",
                           "# two\n\n1,2\n   \n # more\n3,4\n\n", " 1 ,\t2 \n3, 4", "+1,2.0\n3e0,.4e1\n"})
    EXPECT_EQ(read("a.csv", text).coordinates, expected) << text;
}

TEST_F(ReadCsv, BomBeforeHeaderIsNotPartOfTheName) {
  EXPECT_EQ(read("a.csv", "\xef\xbb\xbfx,y\r\n1,2\r\n").column_names, (Names{"x", "y"}));
}

TEST_F(ReadCsv, HeaderAndColumns) {
  const std::string text = "name,x,\"the y, quoted\",z\nfoo,1,2,3\n\"b\"\"a,r\",4,\"5\",6\n";
  auto t = read("a.csv", text, {"z", "the y, quoted"});
  EXPECT_EQ(t.coordinates, (Doubles{3, 2, 6, 5}));
  EXPECT_EQ(t.column_names, (Names{"z", "the y, quoted"}));
  t = read("a.csv", text, {"1"});
  EXPECT_EQ(t.dimension, 1);
  EXPECT_EQ(t.coordinates, (Doubles{1, 4}));
  EXPECT_EQ(t.column_names, (Names{"x"}));
  EXPECT_EQ(read("b.csv", "1,2,3\n4,5,6\n", {"2", "0"}).coordinates, (Doubles{3, 1, 6, 4}));
}

TEST_F(ReadCsv, DamagedFirstRowIsNoHeader) {
  for (const std::string row : {"1.O,2", "1.0D0,2", "NA,1", "1_000,2", "0x10,2"})
    expect_error(Errc::bad_format,
                 {"a.csv:1: column 0: '" + row.substr(0, row.find(',')) + "' is not a number; a header has"},
                 [&] { read("a.csv", row + "\n1,2\n"); });
  const std::string years = "x,y,2010\n1,2,3\n";
  expect_error(Errc::bad_format, {"a.csv:1: column 0: 'x'"}, [&] { read("a.csv", years, {"0", "1"}); });
  EXPECT_EQ(read("a.csv", years, {"x", "2010"}).coordinates, (Doubles{1, 3}));
  EXPECT_EQ(read("a.csv", "x,\"2010\"\n1,2\n").column_names, (Names{"x", "2010"}));
  EXPECT_EQ(read("a.csv", "\"1\",\"2010\"\n1,2\n").num_points(), 2u);
}

TEST_F(ReadCsv, HeaderAloneGivesNoPoints) {
  const auto t = read("a.csv", "x,y\n");
  EXPECT_EQ(t.dimension, 2);
  EXPECT_EQ(t.num_points(), 0u);
}

TEST_F(ReadCsv, QuotedFieldsMaySpanLines) {
  const auto t = read("a.csv", "note,x\n\"one\ntwo\",1\nthree,2\n", {"x"});
  EXPECT_EQ(t.coordinates, (Doubles{1, 2}));
  expect_error(Errc::bad_format, {"a.csv:4: column 1 (x): 'bad'"},
               [&] { read("a.csv", "note,x\n\"one\ntwo\",1\nthree,bad\n", {"x"}); });
}

TEST_F(ReadCsv, DuplicateNamesMatterOnlyWhenChosen) {
  const std::string text = "x,y,x\n1,2,3\n";
  EXPECT_EQ(read("a.csv", text).coordinates, (Doubles{1, 2, 3}));
  EXPECT_EQ(read("a.csv", text, {"y", "2"}).coordinates, (Doubles{2, 3}));
  expect_error(Errc::bad_format, {"a.csv", "columns: 0 and 2 are both", "'x'"},
               [&] { read("a.csv", text, {"x"}); });
}

TEST_F(ReadCsv, NumbersAreCorrectlyRounded) {
  const auto t = read("a.csv",
                      "5e-324\n2.2250738585072011e-308\n1.7976931348623157e308\n1e-400\n-0\n"
                      "9007199254740993\n0.1\n2.4703282292062328e-324\n");
  const Doubles expected{std::numeric_limits<double>::denorm_min(),
                         0x0.fffffffffffffp-1022,
                         std::numeric_limits<double>::max(),
                         0,
                         -0.0,
                         9007199254740992.0,
                         0.1,
                         5e-324};
  ASSERT_EQ(t.coordinates.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(t.coordinates[i], expected[i]) << i;
  EXPECT_TRUE(std::signbit(t.coordinates[4]));
}

TEST_F(ReadCsv, TsvKeepsEmptyFieldsApart) {
  EXPECT_EQ(read("a.tsv", "x\ty\n1\t2\n3 \t 4\n").coordinates, (Doubles{1, 2, 3, 4}));
  expect_error(Errc::bad_format, {"a.tsv:2: column 0", "empty"}, [&] { read("a.tsv", "1\t2\n\t4\n"); });
}

TEST_F(ReadCsv, RaggedRows) {
  expect_error(Errc::bad_format, {"a.csv:3: expected 3 fields, found 2"},
               [&] { read("a.csv", "1,2,3\n4,5,6\n7,8\n"); });
  expect_error(Errc::bad_format, {"a.csv:2: expected 2 fields, found 4"},
               [&] { read("a.csv", "1,2\n4,5,6,text\n"); });
  // also in columns that are not used
  expect_error(Errc::bad_format, {"a.csv:2: expected 2 fields, found 3"},
               [&] { read("a.csv", "x,y\n1,2,3\n", {"x"}); });
}

TEST_F(ReadCsv, TextInNumbers) {
  expect_error(Errc::bad_format, {"a.csv:2: column 1: 'abc' is not a number"},
               [&] { read("a.csv", "1,2\n3,abc\n"); });
  expect_error(Errc::bad_format, {"a.csv:3: column 1 (y): '4x' is not a number"},
               [&] { read("a.csv", "x,y\n1,2\n3,4x\n"); });
  expect_error(Errc::bad_format, {"'1;2'"}, [&] { read("a.csv", "x\n1;2\n"); });
  expect_error(Errc::bad_format, {"'+-3'"}, [&] { read("a.csv", "1,2\n+-3,4\n"); });
  expect_error(Errc::bad_format, {"'0x10'"}, [&] { read("a.csv", "1,2\n0x10,4\n"); });
  expect_error(Errc::bad_format, {"\\x00\\x01"}, [&] { read("a.csv", std::string("1,2\n\0\1,4\n", 10)); });
}

TEST_F(ReadCsv, EmptyFields) {
  expect_error(Errc::bad_format, {"a.csv:2: column 1: the field is empty"},
               [&] { read("a.csv", "1,2,3\n4,,6\n"); });
  expect_error(Errc::bad_format, {"a.csv:2: column 2", "empty"}, [&] { read("a.csv", "1,2,3\n4,5,\n"); });
  expect_error(Errc::bad_format, {"a.csv:2: column 0", "empty"}, [&] { read("a.csv", "1,2\n\"\",5\n"); });
  // a first row with a hole is a faulty row, not a header
  expect_error(Errc::bad_format, {"a.csv:1: column 1", "empty"}, [&] { read("a.csv", "1,,3\n4,5,6\n"); });
}

TEST_F(ReadCsv, NotFiniteNamesAllRows) {
  const auto rows =
      expect_error(Errc::not_finite, {"a.csv:3: column 1 (y): 'nan' is not finite", "2 more rows"},
                   [&] { read("a.csv", "x,y\n0,0\n1,nan\n2,2\n-inf,Infinity\n1e999,0\n"); });
  EXPECT_EQ(rows, (std::vector<std::size_t>{1, 3, 4}));
  EXPECT_EQ(expect_error(Errc::not_finite, {"a.csv:2: column 0: '-1e999' is beyond the range"},
                         [&] { read("a.csv", "1\n-1e999"); }),
            (std::vector<std::size_t>{1}));
  EXPECT_EQ(expect_error(Errc::not_finite, {"'NaN'"}, [&] { read("a.csv", "\"NaN\",1\n"); }),
            (std::vector<std::size_t>{0}));
  // unused columns may hold anything
  EXPECT_EQ(read("a.csv", "x,y\n1,nan\n", {"x"}).coordinates, (Doubles{1}));
}

TEST_F(ReadCsv, WrongColumns) {
  expect_error(Errc::bad_format, {"a.csv", "'w'", "x, y, z"}, [&] {
    read("a.csv", "x,y,z\n1,2,3\n", {"x", "w"});
  });
  expect_error(Errc::bad_format, {"a.csv", "'3'", "x, y, z"},
               [&] { read("a.csv", "x,y,z\n1,2,3\n", {"3"}); });
  expect_error(Errc::bad_format, {"'x'", "the columns are 0 to 2", "0 to 2"},
               [&] { read("a.csv", "1,2,3\n", {"x"}); });
}

TEST_F(ReadCsv, Quotes) {
  expect_error(Errc::bad_format, {"a.csv:2: a quoted field is not closed"},
               [&] { read("a.csv", "1,2\n3,\"4\n5,6\n"); });
  expect_error(Errc::bad_format, {"a.csv:2", "after a closing quote"},
               [&] { read("a.csv", "1,2\n3,\"4\"5\n"); });
}

TEST_F(ReadCsv, EmptyAndForeignFiles) {
  expect_error(Errc::bad_format, {"a.csv", "empty"}, [&] { read("a.csv", ""); });
  expect_error(Errc::bad_format, {"a.csv", "empty"}, [&] { read("a.csv", "\xef\xbb\xbf"); });
  expect_error(Errc::bad_format, {"a.csv", "no row"}, [&] { read("a.csv", "\n# nothing\n\n"); });
  expect_error(Errc::bad_format, {"a.csv", "UTF-16"}, [&] {
    read("a.csv", std::string("\xff\xfe"
                              "1\0,\0",
                              6));
  });
}

TEST_F(ReadWhiteSpace, RowsOfNumbers) {
  for (const char* name : {"a.txt", "a.xyz", "a.pts"}) {
    const auto t = read(name, "# x y\n 1\t2  # first\r\n\n3   4");
    EXPECT_EQ(t.dimension, 2);
    EXPECT_EQ(t.coordinates, (Doubles{1, 2, 3, 4}));
  }
  EXPECT_EQ(read("a.txt", "1 2 3\n4 5 6\n", {"2"}).coordinates, (Doubles{3, 6}));
}

TEST_F(ReadWhiteSpace, Faults) {
  expect_error(Errc::bad_format, {"a.txt:2: expected 2 numbers, found 3"},
               [&] { read("a.txt", "1 2\n3 4 5\n"); });
  expect_error(Errc::bad_format, {"a.txt:3: expected 2 numbers, found 1"},
               [&] { read("a.txt", "1 2\n\n3\n"); });
  expect_error(Errc::bad_format, {"a.txt:2", "'x'", "not a number"}, [&] { read("a.txt", "1 2\n3 x\n"); });
  expect_error(Errc::bad_format, {"'1,2'"}, [&] { read("a.txt", "1,2\n"); });
  EXPECT_EQ(
      expect_error(Errc::not_finite, {"a.txt:2: column 0: 'inf'"}, [&] { read("a.txt", "1 2\ninf 2\n"); }),
      (std::vector<std::size_t>{1}));
  expect_error(Errc::bad_format, {"a.txt", "no row"}, [&] { read("a.txt", "# only\n"); });
  expect_error(Errc::bad_format, {"a.txt", "empty"}, [&] { read("a.txt", ""); });
  expect_error(Errc::bad_format, {"'x'", "0 to 1"}, [&] { read("a.txt", "1 2\n", {"x"}); });
  expect_error(Errc::bad_format, {"'2'", "0 to 1"}, [&] { read("a.txt", "1 2\n", {"2"}); });
}

TEST_F(ReadQhull, CommentCountRows) {
  const auto t = read("a.qhull", "3 rbox 2 D3\n2\n0.5 1 2\n3 4\n5\n");
  EXPECT_EQ(t.dimension, 3);
  EXPECT_EQ(t.coordinates, (Doubles{0.5, 1, 2, 3, 4, 5}));
  const auto none = read("a.qhull", "4\n0\n");
  EXPECT_EQ(none.dimension, 4);
  EXPECT_EQ(none.num_points(), 0u);
}

TEST_F(ReadQhull, Faults) {
  expect_error(Errc::bad_format, {"expected 3 points of 2 coordinates", "after 4 numbers"},
               [&] { read("a.qhull", "2\n3\n1 2\n3 4\n"); });
  expect_error(Errc::bad_format, {"a.qhull:4", "expected 1 points", "'3'"},
               [&] { read("a.qhull", "2\n1\n1 2\n3 4\n"); });
  expect_error(Errc::bad_dimension, {"a.qhull:1", "dimension is 0"}, [&] { read("a.qhull", "0\n1\n1 2\n"); });
  expect_error(Errc::bad_format, {"a.qhull:1", "the dimension", "'x'"}, [&] { read("a.qhull", "x\n1\n"); });
  expect_error(Errc::bad_format, {"the dimension", "'-3'"}, [&] { read("a.qhull", "-3\n1\n"); });
  expect_error(Errc::bad_format, {"the dimension", "99999999999"},
               [&] { read("a.qhull", "99999999999\n1\n"); });
  expect_error(Errc::bad_format, {"the number of points"}, [&] { read("a.qhull", "3 only a dimension\n"); });
  expect_error(Errc::bad_format, {"a.qhull:4", "'abc'"}, [&] { read("a.qhull", "2\n2\n1 2\nabc 4\n"); });
  EXPECT_EQ(expect_error(Errc::not_finite, {"a.qhull:4: column 1: 'nan'"},
                         [&] { read("a.qhull", "2\n2\n1 2\n3 nan\n"); }),
            (std::vector<std::size_t>{1}));
  expect_error(Errc::bad_format, {"empty"}, [&] { read("a.qhull", ""); });
}

TEST_F(ReadQhull, CountsThatNoFileHoldsAreNotAllocated) {
  expect_error(Errc::bad_format, {"the file ends after 2 numbers"},
               [&] { read("a.qhull", "2\n9223372036854775807\n1 2\n"); });
  expect_error(Errc::bad_format, {"the file ends after 2 numbers"},
               [&] { read("a.qhull", "2147483647\n18446744073709551615\n1 2\n"); });
  expect_error(Errc::bad_format, {"'18446744073709551616'"},
               [&] { read("a.qhull", "2\n18446744073709551616\n1 2\n"); });
}

TEST_F(ReadPath, FaultsQuoteForeignTextSafely) {
  const std::string hostile = "\x1b[31m\xff" + std::string(100'000, 'y');
  std::string names = hostile + "0";
  for (int i = 1; i < 50; ++i) names += "," + hostile + std::to_string(i);
  const auto expect_safe = [&](const std::string& name, const std::string& text,
                               const std::vector<std::string>& columns) {
    try {
      read(name, text, columns);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      const std::string said = error.what();
      EXPECT_LT(said.size(), 1000u) << said.substr(0, 300);
      EXPECT_EQ(printable(said, said.size()), said);
    }
  };
  expect_safe("a.csv", names + "\n", {"none"});
  expect_safe("a.csv", names + "\n", {hostile});
  expect_safe("a.csv", hostile + "\n" + hostile + "\n", {});
  expect_safe("a.csv", hostile + "\n\n" + "nan\n", {});
  expect_safe("a.csv", hostile + "," + hostile + "\n", {hostile});
  expect_safe("a.txt", hostile, {});
  expect_safe("a.qhull", hostile, {});
  expect_safe("a.off", hostile, {});
  expect_safe("a.off", "OFF\n1 0 0\n1 2 3 " + hostile, {});
  expect_safe("a.ply", "ply\n" + hostile, {});
  expect_safe("a.ply", "ply\nformat " + hostile, {});
  expect_safe("a.ply",
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float " + hostile + "\nend_header\nnan\n",
              {hostile});
  expect_safe("a.ply",
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float " + hostile + "\nend_header\n1\n",
              {"none"});
  expect_safe("a\x1b[1m.csv", "x\ny\n", {});
  expect_safe("a." + hostile.substr(0, 100), "", {});
}

TEST_F(ReadPath, FilesThatCannotBeOpened) {
  expect_error(Errc::cannot_open, {"none.csv", "No such file"}, [&] { read_points(path("none.csv")); });
  std::filesystem::create_directory(path("dir.csv"));
  expect_error(Errc::cannot_open, {"dir.csv", "folder"}, [&] { read_points(path("dir.csv")); });
}

TEST_F(ReadPath, FormatByExtensionOrByName) {
  EXPECT_EQ(read("A.CSV", "1,2\n").dimension, 2);
  EXPECT_EQ(read_points(file("data", "1,2\n"), {"csv", {}}).dimension, 2);
  EXPECT_EQ(read_points(file("b.txt", "1,2\n"), {"csv", {}}).dimension, 2);
  expect_error(Errc::unsupported, {"a.xlsx", "'xlsx'", "npy, csv"}, [&] { read("a.xlsx", "1\n"); });
  expect_error(Errc::unsupported, {"'parquet'"}, [&] { read_points(file("a.csv", "1\n"), {"parquet", {}}); });
  expect_error(Errc::unsupported, {"no extension"}, [&] { read("plain", "1\n"); });
}

TEST_F(ReadPath, StandardInput) {
  const auto from_standard_input = [&](const std::string& text, const std::string& format) {
    const std::string name = file("input", text);
    const int saved = ::dup(STDIN_FILENO);
    EXPECT_NE(std::freopen(name.c_str(), "rb", stdin), nullptr);
    struct Restore {
      int saved;
      ~Restore() {
        ::dup2(saved, STDIN_FILENO);
        ::close(saved);
        std::clearerr(stdin);
      }
    } restore{saved};
    return read_points("-", {format, {}});
  };
  EXPECT_EQ(from_standard_input("2 comment\n1\n3 4\n", "").coordinates, (Doubles{3, 4}));
  EXPECT_EQ(from_standard_input("3,4\n5,6\n", "csv").coordinates, (Doubles{3, 4, 5, 6}));
  expect_error(Errc::bad_format, {"standard input:2", "'x'"}, [&] { from_standard_input("1\nx\n", "csv"); });
}

}  // namespace
