// SPDX-License-Identifier: BSD-3-Clause
// Members of .npz files: arrays of a rank, numbers, flags, choices and texts, and those that are none.
#include "io/complexes/npz_file.hpp"

#include "complex_support.hpp"

#include <string>
#include <vector>

namespace delone_test {
namespace {

using namespace delone;

class NpzFiles : public ResultFiles {
 protected:
  std::string archive() const {
    npz("a.npz", {{"n", npy_of<std::int64_t>("<i8", "()", {-3})},
                  {"one", npy_of<std::int32_t>("<i4", "(1,)", {2})},
                  {"matrix", npy_of<double>("<f8", "(2, 3)", {1, 2, 3, 4, 5, 6})},
                  {"empty", npy_of<double>("<f8", "(0, 3)", {})},
                  {"two", npy_of<std::int64_t>("<i8", "(2,)", {0, 1})},
                  {"text", io::npy_of_text("hull")},
                  {"names", io::npy_of_texts({"x", "é"})}});
    return content("a.npz");
  }
};

TEST_F(NpzFiles, HaveMembersByName) {
  const std::string bytes = archive();
  const io::NpzFile file(bytes, "a.npz");
  EXPECT_EQ(file.members(),
            (std::vector<std::string>{"n", "one", "matrix", "empty", "two", "text", "names"}));
  EXPECT_TRUE(file.has("n"));
  EXPECT_FALSE(file.has("n.npy"));
  std::vector<std::size_t> shape;
  EXPECT_EQ(file.read<double>("matrix", 2, false, shape), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_TRUE(file.read<double>("empty", 2, false, shape).empty());
  EXPECT_EQ(shape, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(file.read<SignedIndex>("two", 1, false, shape), (Indices{0, 1}));
  EXPECT_EQ(file.find_texts("names"), (std::vector<std::string>{"x", "é"}));
  EXPECT_TRUE(file.find_texts("none").empty());
  EXPECT_EQ(file.find_text("text"), "hull");
  EXPECT_EQ(file.find_text("none"), std::nullopt);
}

TEST_F(NpzFiles, TellScalars) {
  const std::string bytes = archive();
  const io::NpzFile file(bytes, "a.npz");
  EXPECT_EQ(file.find_number("n"), -3);
  EXPECT_EQ(file.find_number("one"), 2) << "an array of one item is a number";
  EXPECT_EQ(file.find_number("none"), std::nullopt);
  EXPECT_EQ(file.find_flag("one"), true);
  EXPECT_EQ(file.find_flag("none"), std::nullopt);
  const char* const choices[] = {"a", "b", "c"};
  EXPECT_EQ(file.find_choice("one", choices), 2u);
  EXPECT_EQ(file.find_choice("one", std::span(choices).first(2)), 2u) << "none of two";
  EXPECT_EQ(file.find_choice("n", choices), 3u) << "none of three";
  EXPECT_EQ(file.find_choice("none", choices), std::nullopt);
}

TEST_F(NpzFiles, WhatIsOfAnotherShapeOrKindIsNamed) {
  const std::string bytes = archive();
  const io::NpzFile file(bytes, "a.npz");
  std::vector<std::size_t> shape;
  expect_error(Errc::bad_format, {"a.npz: matrix: expected a 1-D array, found shape (2, 3)"},
               [&] { file.read<double>("matrix", 1, false, shape); });
  expect_error(Errc::bad_format, {"a.npz: two: expected one number, found shape (2,)"},
               [&] { file.find_number("two"); });
  expect_error(Errc::bad_format, {"a.npz: matrix"},
               [&] { file.read<SignedIndex>("matrix", 2, false, shape); });
  expect_error(Errc::bad_format, {"a.npz: names"}, [&] { file.find_text("names"); });
  expect_error(Errc::bad_format, {"a.npz: n"}, [&] { file.find_text("n"); });
  expect_error(Errc::unsupported, {"a.npz: text: data type '<U4'"}, [&] { file.find_number("text"); });
}

}  // namespace
}  // namespace delone_test
