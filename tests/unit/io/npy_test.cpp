// SPDX-License-Identifier: BSD-3-Clause
// The .npy format: headers of all versions, item types and byte orders; what is malformed or does not fit.
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io_support.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace delone;
using delone_test::expect_error;
using delone_test::npy;
using delone_test::npy_of;

std::vector<double> doubles(const std::string& bytes) {
  return io::to_doubles(io::parse_npy(bytes, "a"), "a");
}
std::vector<SignedIndex> indices(const std::string& bytes) {
  return io::to_indices(io::parse_npy(bytes, "a"), "a");
}

TEST(Npy, Texts) {
  const std::vector<std::vector<std::string>> cases{
      {}, {std::string{}}, {"x", "", "h\xc3\xb6he", "\xf0\x9f\x98\x80!"}};
  for (const std::vector<std::string>& texts : cases)
    EXPECT_EQ(io::parse_npy_texts(io::npy_of_texts(texts), "a"), texts);
  EXPECT_EQ(io::parse_npy_texts(io::npy_of_texts({"a\xff"}), "a")[0], "a\xef\xbf\xbd");
  EXPECT_NE(io::npy_of_texts({"a", "bcd"}).find("'descr': '<U3'"), std::string::npos);
  std::string storage;
  const std::vector<double> number{1};
  const std::string good = io::npy_of_texts({"ab", "c"}),
                    doubles = io::npy_header("f8", {1}) +
                              std::string(io::little_endian_bytes(std::span(number), storage));
  for (const std::string& bad :
       {std::string{}, good.substr(0, 9), good.substr(0, 40), good + "1234", good.substr(0, good.size() - 4),
        good.substr(0, good.size() - 1), doubles, io::npy_header("U0", {std::size_t{1} << 60}),
        io::npy_header("U", {1}), io::npy_header("U2", {1, 1})})
    expect_error(Errc::bad_format, {"a: "}, [&] { io::parse_npy_texts(bad, "a"); });
}

TEST(Npy, WhatIsWrittenIsReadAgain) {
  const std::vector<double> values{1, -0.5, 1e300, 4, 5, 6};
  std::string storage;
  std::string bytes = io::npy_header("f8", {2, 3});
  EXPECT_EQ(bytes.size() % 64, 0u);
  EXPECT_EQ(bytes.back(), '\n');
  bytes += io::little_endian_bytes(std::span(values), storage);
  const io::NpyArray array = io::parse_npy(bytes, "a");
  EXPECT_EQ(array.shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(array.num_items(), 6u);
  EXPECT_FALSE(array.fortran_order || array.big_endian);
  EXPECT_EQ(io::to_doubles(array, "a"), values);
  EXPECT_NE(io::npy_header("i4", {7}).find("'shape': (7,)"), std::string::npos);
}

TEST(Npy, ItemsOfAllTypesAndOrders) {
  const std::vector<double> values{1, 2, 3, 4, 5, 6}, transposed{1, 3, 5, 2, 4, 6};
  EXPECT_EQ(doubles(npy_of<double>(">f8", "(6,)", {1, 2, 3, 4, 5, 6})), values);
  EXPECT_EQ(doubles(npy_of<float>("<f4", "(2, 3)", {1, 2, 3, 4, 5, 6})), values);
  EXPECT_EQ(doubles(npy_of<std::int16_t>(">i2", "(2, 3)", {1, 2, 3, 4, 5, 6}, true)), transposed);
  EXPECT_EQ(doubles(npy_of<double>("<f8", "(2, 3)", {1, 2, 3, 4, 5, 6}, true)), transposed);
  EXPECT_EQ(doubles(npy_of<std::uint8_t>("|u1", "(2L, 1L)", {255, 0})), (std::vector<double>{255, 0}));
  EXPECT_EQ(doubles(npy_of<std::int8_t>("|i1", "()", {-128})), std::vector<double>{-128});
  EXPECT_EQ(doubles(npy_of<double>("<f8", "(0, 3)", {})), std::vector<double>{});
  for (const int version : {1, 2, 3})
    EXPECT_EQ(doubles(npy("<f8", "(1,)", delone_test::bytes_of(2.5), false, version)),
              std::vector<double>{2.5});
}

TEST(Npy, IntegersMustBeExact) {
  constexpr std::int64_t two_to_53 = std::int64_t{1} << 53;
  EXPECT_EQ(doubles(npy_of<std::int64_t>("<i8", "(2,)", {-two_to_53, 2 * two_to_53 + 4})),
            (std::vector<double>{-9007199254740992.0, 18014398509481988.0}));
  expect_error(Errc::bad_format, {"a", "row 1", "9007199254740993", "not exact"}, [] {
    doubles(npy_of<std::int64_t>("<i8", "(2, 1)", {0, two_to_53 + 1}));
  });
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  expect_error(Errc::bad_format, {"row 0"}, [] { doubles(npy_of<std::uint64_t>("<u8", "(1,)", {largest})); });
}

TEST(Npy, IndicesMustFit) {
  EXPECT_EQ(indices(npy_of<std::int64_t>("<i8", "(3,)", {-1, 0, 7})), (std::vector<SignedIndex>{-1, 0, 7}));
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  expect_error(Errc::bad_format, {"a", "row 1", "does not fit"}, [] {
    indices(npy_of<std::uint64_t>("<u8", "(2,)", {0, largest}));
  });
  expect_error(Errc::bad_format, {"expected integers"}, [] { indices(npy_of<float>("<f4", "(1,)", {1})); });
}

TEST(Npy, UnsupportedData) {
  for (const char* type : {"<f2", "<c16", "|b1", "|O", "<U4", "<M8", "<i3", ""})
    expect_error(Errc::unsupported, {"a", "data type"}, [&] { doubles(npy(type, "(0,)", "")); });
  std::string bytes = npy("<f8", "(0,)", "");
  bytes[6] = 4;
  expect_error(Errc::unsupported, {"version 4"}, [&] { doubles(bytes); });
}

TEST(Npy, Malformed) {
  expect_error(Errc::bad_format, {"a", "empty"}, [] { doubles(""); });
  expect_error(Errc::bad_format, {"signature"}, [] { doubles("1 2 3\n4 5 6\n"); });
  const std::string whole = npy_of<double>("<f8", "(2,)", {1, 2});
  for (std::size_t size = 1; size < whole.size(); ++size)
    expect_error(Errc::bad_format, {"a"}, [&] { doubles(whole.substr(0, size)); });
  expect_error(Errc::bad_format, {"expected 16 bytes", "found 17"}, [&] { doubles(whole + "x"); });
  for (const char* shape : {"(2", "2", "(-2,)", "(2.0,)", "(2 3)", "[2]", "(99999999999999999999,)", "None"})
    expect_error(Errc::bad_format, {"malformed"}, [&] { doubles(npy("<f8", shape, "")); });
  expect_error(Errc::bad_format, {"(1, 1, 1)", "at most 2"},
               [] { doubles(npy_of<double>("<f8", "(1, 1, 1)", {1})); });
  expect_error(Errc::bad_format, {"2^64"}, [] { doubles(npy("<f8", "(4294967296, 4294967296)", "")); });
}

}  // namespace
