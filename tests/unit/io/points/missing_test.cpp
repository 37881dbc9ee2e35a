// SPDX-License-Identifier: BSD-3-Clause
// Rows with missing values: refused, with advice, or left out and named.
#include "../io_support.hpp"
#include "io/collect.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace delone;
using namespace delone_test;
using Doubles = std::vector<double>;
using Rows = std::vector<std::size_t>;

class Missing : public TemporaryDirectory {
 protected:
  PointTable skip(const std::string& name, std::string_view text, std::vector<std::string> columns = {},
                  std::vector<std::string> values = {}, unsigned threads = 1) const {
    return read_points(
        file(name, text),
        {.format = {}, .columns = std::move(columns), .values = std::move(values), .skip_missing = true},
        {.threads = threads});
  }
  void expect_kept(const PointTable& table, const Doubles& coordinates, const Rows& skipped) const {
    EXPECT_EQ(table.coordinates, coordinates);
    EXPECT_EQ(table.skipped_rows, skipped);
  }
};

TEST(MissingWords, AreThoseOfPandasAndR) {
  for (const char* word : {"",       "#N/A",    "#N/A N/A", "#NA", "-1.#IND", "-1.#QNAN", "-NaN", "-nan",
                           "1.#IND", "1.#QNAN", "<NA>",     "N/A", "NA",      "NULL",     "NaN",  "None",
                           "n/a",    "nan",     "null",     "-",   "na",      "none",     "NAN"})
    EXPECT_TRUE(io::is_missing(word)) << word;
  for (const char* word : {"0", "--", "inf", "N", "nano", "missing", "1-", " ", "#N/A N/A ", "-1"})
    EXPECT_FALSE(io::is_missing(word)) << word;
}

TEST_F(Missing, RowsAreLeftOutInEveryFormat) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Doubles kept{0, 1, 4, 5};
  const Rows skipped{1, 3};
  expect_kept(skip("a.csv", "x,y\n0,1\n,3\n4,5\n6,NA\n"), kept, skipped);
  expect_kept(skip("b.csv", "# c\n\n0,1\n2, - \n# c\n\n4,5\n\"n/a\",\"\"\n"), kept, skipped);
  expect_kept(skip("c.csv", "NA,3\n0,1\n"), {0, 1}, {0});  // no header
  expect_kept(skip("d.csv", "#N/A,3\n#NA\t,3\n#N/A is a comment,3\n0,1\n #NA ,2\n#"), {0, 1}, {0, 1, 3});
  expect_error(Errc::bad_format, {"e.csv:2: column 0: '#N/A' is not a number"},
               [&] { read("e.csv", "0,1\n#N/A,2\n"); });
  expect_kept(skip("a.tsv", "x\ty\n0\t1\n2\t\n4\t5\nNULL\t7\n"), kept, skipped);
  expect_kept(skip("a.txt", "0 1\n2 NaN\n4 5\n- None # c\n"), kept, skipped);
  expect_kept(skip("b.txt", "NA 1\n0 1\n"), {0, 1}, {0});
  expect_kept(skip("a.qhull", "2\n4\n0 1\n2 nan\n4 5\nNA 7\n"), kept, skipped);
  expect_kept(skip("a.off", "nOFF 2\n4 0 0\n0 1\n2 nan\n4 5\nNA 7\n"), kept, skipped);
  expect_kept(skip("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
                   "end_header\n0 1\n2 nan\n4 5\nnan nan\n"),
              kept, skipped);
  expect_kept(skip("a.npy", npy_of<double>("<f8", "(4, 2)", {0, 1, nan, 3, 4, 5, 6, nan})), kept, skipped);
  expect_kept(skip("none.csv", "x,y\n,\n"), {}, {0});
  expect_kept(skip("all.csv", "0,1\n4,5\n"), kept, {});
}

TEST_F(Missing, OnlyColumnsThatAreReadCount) {
  const std::string text = "x,y,z\n0,1,\n2,NA,3\n4,5,-\n";
  expect_kept(skip("a.csv", text, {"x", "y"}), {0, 1, 4, 5}, {1});
  expect_kept(skip("a.txt", "0 1 NA\n2 NA 3\n4 5 -\n", {"0", "1"}), {0, 1, 4, 5}, {1});
  const PointTable table = skip("b.csv", "x,y,v\n0,1,7\n2,3,\n4,5,8\nNA,6,9\n", {"x", "y"}, {"v"});
  expect_kept(table, {0, 1, 4, 5}, {1, 3});
  EXPECT_EQ(table.values, (Doubles{7, 8}));
}

TEST_F(Missing, OtherFaultsAreStillErrors) {
  expect_error(Errc::bad_format, {"a.csv:2: column 1: 'x' is not a number"},
               [&] { skip("a.csv", "0,1\n2,x\n"); });
  expect_error(Errc::bad_format, {"a.csv:2: expected 2 fields, found 1"},
               [&] { skip("a.csv", "0,1\nNA\n"); });
  EXPECT_EQ(expect_error(Errc::not_finite, {"a.csv:3: column 0: 'inf' is not finite"},
                         [&] { skip("a.csv", "0,1\nNA,2\ninf,3\n"); }),
            Rows{2});
  EXPECT_EQ(expect_error(Errc::not_finite, {"row 1: column 0: inf is not finite"},
                         [&] {
                           skip("a.npy", npy_of<double>("<f8", "(2, 1)", {NAN, INFINITY}));
                         }),
            Rows{1});
}

TEST_F(Missing, RefusalsNameTheOption) {
  const std::string advice = "; skip_missing leaves out rows with missing values";
  expect_error(Errc::bad_format, {"a.csv:2: column 1 (y): the field is empty" + advice},
               [&] { read("a.csv", "x,y\n0,\n"); });
  expect_error(Errc::bad_format, {"a.csv:2: column 1 (y): 'NA' is not a number" + advice},
               [&] { read("a.csv", "x,y\n0,NA\n"); });
  expect_error(Errc::bad_format, {"a.csv:1: column 1: 'NA' is not a number; a header", advice},
               [&] { read("a.csv", "0,NA\n"); });
  EXPECT_EQ(expect_error(Errc::not_finite, {"'nan' is not finite" + advice},
                         [&] { read("a.csv", "x,y\n0,nan\n"); }),
            Rows{0});
  EXPECT_EQ(expect_error(Errc::not_finite, {"row 0: column 0: nan is not finite" + advice},
                         [&] { read("a.npy", npy_of<double>("<f8", "(1,)", {NAN})); }),
            Rows{0});
  expect_error(Errc::bad_format, {"a.txt:2", "'-' is not a number" + advice},
               [&] { read("a.txt", "1 2\n1 -\n"); });
  // What the option does not heal.
  for (const char* text : {"0,1\n2,x\n", "0,1\n2,inf\n", "0,nan\n2,inf\n", "0,1\n2\n"}) try {
      read("a.csv", text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find("skip_missing"), std::string::npos) << error.what();
    }
}

TEST_F(Missing, RowsDoNotDependOnThreads) {
  std::string csv = "x,y\n", txt;
  Doubles kept;
  Rows skipped;
  for (std::size_t row = 0; row < 400'000; ++row) {
    const std::string number = std::to_string(row);
    const bool is_missing = row % 7 == 3 || row % 1000 > 990;
    csv += number + (is_missing ? ",\n" : "," + number + "\n");
    txt += number + (is_missing ? " NA\n" : " " + number + "\n");
    if (is_missing)
      skipped.push_back(row);
    else
      kept.insert(kept.end(), 2, static_cast<double>(row));
  }
  for (const unsigned threads : {1u, 3u}) {
    expect_kept(skip("a.csv", csv, {}, {}, threads), kept, skipped);
    expect_kept(skip("a.txt", txt, {}, {}, threads), kept, skipped);
  }
}

}  // namespace
