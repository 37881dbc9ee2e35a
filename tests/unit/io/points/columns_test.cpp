// SPDX-License-Identifier: BSD-3-Clause
#include "io/points/columns.hpp"

#include "../io_support.hpp"

#include <algorithm>
#include <cmath>

namespace delone::io {
namespace {

using delone_test::expect_error;
using ColumnNames = std::vector<std::string>;
using Positions = std::vector<std::size_t>;

Positions chosen(const ColumnNames& wanted, const ColumnNames& last = {}, const ColumnNames& names = {},
                 std::size_t width = 6) {
  const ChosenColumns found =
      choose_columns({.wanted = wanted, .last = last}, names, names.empty() ? width : names.size(), "f");
  EXPECT_LE(found.num_last, found.columns.size());
  return found.columns;
}

TEST(Columns, NamesNumbersAndRanges) {
  EXPECT_EQ(chosen({}), (Positions{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(chosen({"2-4"}), (Positions{2, 3, 4}));
  EXPECT_EQ(chosen({"5", "0-1", "3-3"}), (Positions{5, 0, 1, 3}));
  EXPECT_EQ(chosen({}, {"1-2"}), (Positions{0, 3, 4, 5, 1, 2}));
  EXPECT_EQ(chosen({"0"}, {"4", "0"}), (Positions{0, 4, 0}));
  const ColumnNames names{"a", "2", "1-2", "b", "b"};
  EXPECT_EQ(chosen({"a", "3-4", "2", "1-2"}, {}, names), (Positions{0, 3, 4, 1, 2}));  // names come first
  EXPECT_EQ(chosen({"2-2"}, {}, names), Positions{2});                                 // a number for certain
  EXPECT_EQ(choose_columns({.wanted = {}, .last = {"0-1"}}, {}, 3, "f").num_last, 2u);
}

TEST(Columns, Faults) {
  const ColumnNames names{"a", "b", "b"};
  for (const std::string bad : {"6", "x", "", "-", "1-", "-1", "1-2-3", "0-99999999999999999999", "0x1"})
    expect_error(Errc::bad_format, {"f: columns: there is no column '" + bad + "'; the columns are 0 to 5"},
                 [&] { chosen({bad}); });
  expect_error(Errc::bad_format, {"f: columns: there is no column '6';"}, [&] { chosen({"6-6"}); });
  expect_error(Errc::bad_format, {"f: columns: the range '0-6' ends beyond column 5, the last one"},
               [&] { chosen({"0-6"}); });
  expect_error(Errc::bad_format, {"f: columns: the range '4-2' runs backwards"}, [&] { chosen({"4-2"}); });
  expect_error(Errc::bad_format, {"f: columns: there is no column 'c'; the columns are a, b, b"},
               [&] { chosen({"c"}, {}, names); });
  expect_error(Errc::bad_format, {"f: columns: 1 and 2 are both named 'b'"},
               [&] { chosen({"b"}, {}, names); });
  expect_error(Errc::bad_format, {"f: values: there is no column 'c'"}, [&] { chosen({}, {"c"}, names); });
}

class ValueColumns : public delone_test::TemporaryDirectory {};

TEST_F(ValueColumns, AreBesideTheCoordinates) {
  const std::string text = "1 2 3 4\n5 6 7 8\n";
  for (const std::string name : {"a.txt", "a.csv"}) {
    std::string content = text;
    if (name == "a.csv") std::replace(content.begin(), content.end(), ' ', ',');
    const PointTable table =
        read_points(file(name, content), {.format = {}, .columns = {}, .values = {"1", "3"}});
    EXPECT_EQ(table.coordinates, (std::vector<double>{1, 3, 5, 7}));
    EXPECT_EQ(table.values, (std::vector<double>{2, 4, 6, 8}));
    EXPECT_EQ(table.num_values, 2);
  }
  const PointTable named =
      read_points(file("n.csv", "v,x,y\n1,2,3\n"), {.format = {}, .columns = {"y"}, .values = {"v"}});
  EXPECT_EQ(named.column_names, (ColumnNames{"y"}));
  EXPECT_EQ(named.value_names, (ColumnNames{"v"}));
  EXPECT_EQ(named.coordinates, (std::vector<double>{3}));
  const PointTable mesh = read_points(file("m.ply",
                                           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float "
                                           "x\nproperty float y\nproperty float q\nend_header\n1 2 3\n"),
                                      {.format = {}, .columns = {}, .values = {"q"}});
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.values, (std::vector<double>{3}));
  expect_error(Errc::bad_dimension, {"beside the values"},
               [&] { read_points(path("a.txt"), {.format = {}, .columns = {}, .values = {"0-3"}}); });
}

TEST_F(ValueColumns, TablesMayHoldWhatIsNotFinite) {
  PointTable table;
  table.dimension = 2;
  table.coordinates = {1, NAN, -INFINITY, 0.1};
  table.column_names = {"a \"b\"", "\xff"};
  write_table(path("t.csv"), table);
  EXPECT_EQ(content("t.csv"), "\"a \"\"b\"\"\",\xff\n1,nan\n-inf,0.1\n");
  write_table(path("t.json"), table);
  EXPECT_EQ(content("t.json"),
            "{\"columns\": [\"a \\\"b\\\"\", \"\xef\xbf\xbd\"],\n\"data\": [\n[1, null],\n[null, 0.1]\n]}\n");
  write_table(path("t.npy"), table);
  EXPECT_EQ(content("t.npy").size(), 128 + 4 * sizeof(double));
  expect_error(Errc::unsupported, {"writing a table"}, [&] { write_table(path("t.off"), table); });
  table.coordinates.pop_back();
  expect_error(Errc::invalid_argument, {"no multiple"}, [&] { write_table(path("t.csv"), table); });
}

}  // namespace
}  // namespace delone::io
