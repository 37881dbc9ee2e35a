// SPDX-License-Identifier: BSD-3-Clause
// Members of JSON objects: arrays and their shapes, and what is said of members of other kinds.
#include "io/complexes/json_file.hpp"

#include "../io_support.hpp"

#include <limits>
#include <string>
#include <vector>

namespace {

using namespace delone;
using delone_test::expect_error;
using Shape = std::vector<std::size_t>;

io::JsonFile object(const std::string& members) { return io::JsonFile("{" + members + "}", "f.json"); }

template <class T>
std::vector<T> read(const std::string& value, std::size_t rank, Shape& shape, bool nullable = false) {
  return object("\"m\": " + value).read<T>("m", rank, nullable, shape);
}

TEST(JsonFile, ArraysAndTheirShapes) {
  Shape shape;
  EXPECT_EQ(read<double>("[1, 0.5, -2e3]", 1, shape), (std::vector<double>{1, 0.5, -2000}));
  EXPECT_EQ(shape, Shape{3});
  EXPECT_EQ(read<SignedIndex>("[[1, 2, 3], [4, 5, -1.0]]", 2, shape),
            (std::vector<SignedIndex>{1, 2, 3, 4, 5, -1}));
  EXPECT_EQ(shape, (Shape{2, 3}));
  EXPECT_TRUE(read<double>("[]", 2, shape).empty());
  EXPECT_EQ(shape, Shape{0}) << "no rows do not tell columns";
  EXPECT_TRUE(read<double>("[[], []]", 2, shape).empty());
  EXPECT_EQ(shape, (Shape{2, 0}));
  EXPECT_EQ(read<double>("[1, null]", 1, shape, true),
            (std::vector<double>{1, std::numeric_limits<double>::infinity()}));
}

TEST(JsonFile, ListsOfLists) {
  io::JsonFile file = object("\"m\": [[1, 2], [], [-1, 7, 3]]");
  std::vector<std::int64_t> offsets;
  EXPECT_EQ(file.read_lists("m", offsets), (std::vector<SignedIndex>{1, 2, -1, 7, 3}));
  EXPECT_EQ(offsets, (std::vector<std::int64_t>{0, 2, 2, 5}));
  EXPECT_TRUE(object("\"m\": []").read_lists("m", offsets).empty());
  EXPECT_EQ(offsets, std::vector<std::int64_t>{0});
}

TEST(JsonFile, Scalars) {
  const io::JsonFile file =
      object("\"n\": -3, \"t\": true, \"s\": \"flat\", \"x\": 1.5, \"o\": {\"n\": [1, {}]}, \"z\": null");
  EXPECT_EQ(file.members(), (std::vector<std::string>{"n", "o", "s", "t", "x", "z"}));
  EXPECT_EQ(file.find_number("n"), -3);
  EXPECT_EQ(file.find_number("none"), std::nullopt);
  EXPECT_EQ(file.find_flag("t"), true);
  EXPECT_EQ(file.find_flag("none"), std::nullopt);
  const char* const choices[] = {"full", "flat"};
  EXPECT_EQ(file.find_choice("s", choices), 1u);
  EXPECT_EQ(file.find_choice("n", choices), 2u);
  EXPECT_EQ(file.find_choice("none", choices), std::nullopt);
  expect_error(Errc::bad_format, {"f.json: x: expected an integer, found '1.5'"},
               [&] { file.find_number("x"); });
  expect_error(Errc::bad_format, {"o: expected an integer, found an object"}, [&] { file.find_number("o"); });
  expect_error(Errc::bad_format, {"z: expected an integer, found null"}, [&] { file.find_number("z"); });
  expect_error(Errc::bad_format, {"n: expected true or false, found '-3'"}, [&] { file.find_flag("n"); });
}

TEST(JsonFile, EntriesThatAreNoNumbers) {
  Shape shape;
  const auto refused = [&](const std::string& value, std::size_t rank, const std::string& message) {
    expect_error(Errc::bad_format, {"f.json: m: " + message}, [&] { read<double>(value, rank, shape); });
  };
  refused("3", 1, "expected an array, found '3'");
  refused("true", 2, "expected an array of arrays, found a boolean");
  refused("\"text\"", 1, "expected an array, found the string 'text'");
  refused("{\"a\": [1]}", 1, "expected an array, found an object");
  refused("[1, \"x\", {}]", 1, "row 1: expected a number, found the string 'x'");
  refused("[1, false]", 1, "row 1: expected a number, found a boolean");
  refused("[0, [1]]", 1, "row 1: expected a number, found an array");
  refused("[[0], [1]]", 1, "row 0: expected a number, found an array");
  refused("[7, 8]", 2, "row 0: expected an array, found '7'");
  refused("[3, [1]]", 2, "row 0: expected an array, found '3'");
  refused("[[1], 2]", 2, "row 1: expected an array, found '2'");
  refused("[[1], [[2]]]", 2, "row 1: expected a number, found an array");
  refused("[[1], [{}]]", 2, "row 1: expected a number, found an object");
  refused("[[1, 2], [3]]", 2, "row 1: expected 2 numbers as in row 0, found 1");
  refused("[1, null]", 1, "row 1: expected a number, found null");
  refused("[[1, 2], [3, null]]", 2, "row 1: expected a number, found null");
}

TEST(JsonFile, EntriesThatAreNoIndices) {
  Shape shape;
  const auto refused = [&](const std::string& value, const std::string& message) {
    expect_error(Errc::bad_format, {"f.json: m: " + message},
                 [&] { read<SignedIndex>(value, 2, shape, true); });
  };
  refused("[[0, 1], [1.5, 2]]", "row 1: expected an integer, found '1.5'");
  refused("[[0, null]]", "row 0: expected an integer, found null");
  refused("[[0], [1e300]]", "row 1: 1e+300 does not fit");
  refused("[[-1e19]]", "row 0: -1e+19 does not fit");
  const auto largest = std::numeric_limits<SignedIndex>::max();
  if (sizeof(SignedIndex) == 4) {
    EXPECT_EQ(read<SignedIndex>("[[" + std::to_string(largest) + "]]", 2, shape).at(0), largest);
    refused("[[2147483648]]", "row 0: 2147483648 does not fit the 32-bit indices of this build");
  }
}

TEST(JsonFile, NumbersBeyondTheDoublesAreNotFinite) {
  EXPECT_EQ(expect_error(Errc::not_finite, {"f.json: m: row 2: '1e999' is beyond the range"},
                         [] { object("\"m\": [[0], [1], [1e999]]"); }),
            std::vector<std::size_t>{2});
  EXPECT_TRUE(
      expect_error(Errc::not_finite, {"f.json: m: '-1e999'"}, [] { object("\"m\": -1e999"); }).empty());
}

TEST(JsonFile, WhatIsNoObject) {
  const auto refused = [](const std::string& text, const std::string& message) {
    expect_error(Errc::bad_format, {"f.json: " + message}, [&] { io::JsonFile(text, "f.json"); });
  };
  refused("[1]", "expected an object, found an array");
  refused("3", "expected an object, found '3'");
  refused("true", "expected an object, found a boolean");
  refused("null", "expected an object, found null");
  refused("\"x\"", "expected an object, found");
  refused("{\"a\": 1, \"a\": 2}", "the member 'a' appears twice");
  refused("{\"a\": [1}", "not valid JSON (byte 9)");
  refused("{} {}", "not valid JSON");
}

}  // namespace
