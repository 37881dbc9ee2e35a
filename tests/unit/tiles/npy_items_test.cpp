// SPDX-License-Identifier: BSD-3-Clause
// Arrays of parts have exactly the types that are written, their rank, and C order.
#include "tiles/npy_items.hpp"

#include "../io/io_support.hpp"

#include <string>
#include <vector>

namespace delone_test {
namespace {

using namespace delone;

template <class T>
std::vector<T> items(const std::string& bytes, std::size_t rank) {
  return tiles::npy_items<T>(io::parse_npy(bytes, "f"), rank, "f");
}

TEST(NpyItems, OfEachTypeComeBack) {
  EXPECT_EQ(items<double>(npy_of<double>("<f8", "(2, 2)", {1, -0.5, 1e300, 0}), 2),
            (std::vector<double>{1, -0.5, 1e300, 0}));
  EXPECT_EQ(items<std::int64_t>(npy_of<std::int64_t>("<i8", "(2,)", {-1, std::int64_t{1} << 60}), 1),
            (std::vector<std::int64_t>{-1, std::int64_t{1} << 60}));
  EXPECT_EQ(items<std::int32_t>(npy_of<std::int32_t>("<i4", "(2, 1)", {-7, 1 << 30}), 2),
            (std::vector<std::int32_t>{-7, 1 << 30}));
  EXPECT_TRUE(items<double>(npy_of<double>("<f8", "(0, 3)", {}), 2).empty());
  // Fortran order says nothing about one dimension.
  EXPECT_EQ(items<double>(npy_of<double>("<f8", "(2,)", {1, 2}, true), 1), (std::vector<double>{1, 2}));
}

TEST(NpyItems, OfOtherTypesAndShapesAreRefused) {
  expect_error(Errc::bad_format, {"f: expected numbers of type <f8, found >f8"},
               [] { items<double>(npy_of<double>(">f8", "(1,)", {1}), 1); });
  expect_error(Errc::bad_format, {"expected numbers of type <i4, found <i8"},
               [] { items<std::int32_t>(npy_of<std::int64_t>("<i8", "(1,)", {1}), 1); });
  expect_error(Errc::bad_format, {"expected numbers of type <i8, found <f8"},
               [] { items<std::int64_t>(npy_of<double>("<f8", "(1,)", {1}), 1); });
  expect_error(Errc::bad_format, {"expected numbers of type <i4, found <u4"},
               [] { items<std::int32_t>(npy_of<std::uint32_t>("<u4", "(1,)", {1}), 1); });
  expect_error(Errc::bad_format, {"f: expected a 2-D array, found shape (2,)"}, [] {
    items<double>(npy_of<double>("<f8", "(2,)", {1, 2}), 2);
  });
  expect_error(Errc::bad_format, {"expected a 2-D array, found shape (1, 2) in Fortran order"}, [] {
    items<double>(npy_of<double>("<f8", "(1, 2)", {1, 2}, true), 2);
  });
}

}  // namespace
}  // namespace delone_test
