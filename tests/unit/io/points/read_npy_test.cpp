// SPDX-License-Identifier: BSD-3-Clause
// Points from .npy: every kind of number, either byte order, either memory order, and headers that lie.
#include "../io_support.hpp"

#include <limits>

namespace {

using namespace delone;
using delone_test::bytes_of;
using delone_test::expect_error;
using delone_test::npy;
using delone_test::npy_of;
using Doubles = std::vector<double>;

class ReadNpy : public delone_test::TemporaryDirectory {
 protected:
  PointTable read_bytes(const std::string& bytes) const { return read("a.npy", bytes); }

  template <class T>
  void expect_all_orders(const std::string& type, const std::vector<T>& row_major) const {
    const std::vector<T>& v = row_major;
    const Doubles expected(v.begin(), v.end());
    for (const std::string order : {"<", ">"}) {
      const auto t = read_bytes(npy_of(order + type, "(2, 3)", v));
      EXPECT_EQ(t.dimension, 3);
      EXPECT_EQ(t.coordinates, expected) << order + type;
      EXPECT_EQ(
          read_bytes(npy_of(order + type, "(2, 3)", std::vector<T>{v[0], v[3], v[1], v[4], v[2], v[5]}, true))
              .coordinates,
          expected)
          << order + type << " Fortran";
    }
  }
};

TEST_F(ReadNpy, AllNumbersInAllOrders) {
  expect_all_orders<double>("f8", {1.5, -2.25, 5e-324, 1e308, 0.1, -0.0});
  expect_all_orders<float>("f4", {1.5f, -2.25f, 1e-45f, 3e38f, 0.1f, 0});
  expect_all_orders<std::int8_t>("i1", {-128, 127, 1, 2, 3, 4});
  expect_all_orders<std::int16_t>("i2", {-32768, 32767, 1, 2, 3, 4});
  expect_all_orders<std::int32_t>("i4", {-2147483647 - 1, 2147483647, 1, 2, 3, 4});
  expect_all_orders<std::int64_t>("i8", {-(std::int64_t{1} << 53), std::int64_t{1} << 53,
                                         std::numeric_limits<std::int64_t>::min(), 2, 3, 4});
  expect_all_orders<std::uint8_t>("u1", {255, 127, 1, 2, 3, 4});
  expect_all_orders<std::uint16_t>("u2", {65535, 1, 1, 2, 3, 4});
  expect_all_orders<std::uint32_t>("u4", {4294967295u, 1, 1, 2, 3, 4});
  expect_all_orders<std::uint64_t>("u8", {std::uint64_t{1} << 63, (std::uint64_t{1} << 53) - 1, 1, 2, 3, 4});
}

TEST_F(ReadNpy, Shapes) {
  const auto one = read_bytes(npy_of<double>("<f8", "(3,)", {1, 2, 3}));
  EXPECT_EQ(one.dimension, 1);
  EXPECT_EQ(one.coordinates, (Doubles{1, 2, 3}));
  const auto none = read_bytes(npy("<f8", "(0, 4)", ""));
  EXPECT_EQ(none.dimension, 4);
  EXPECT_EQ(none.num_points(), 0u);
  EXPECT_EQ(read_bytes(npy_of<std::uint8_t>("|u1", "(1L, 2L)", {7, 8})).coordinates, (Doubles{7, 8}));
}

TEST_F(ReadNpy, HeaderVersionsAndForeignOrderOfKeys) {
  EXPECT_EQ(read_bytes(npy("<f8", "(1, 1)", bytes_of(2.5), false, 2)).coordinates, (Doubles{2.5}));
  EXPECT_EQ(read_bytes(npy("<f8", "(1, 1)", bytes_of(2.5), false, 3)).coordinates, (Doubles{2.5}));
  const std::string header = "{\"shape\":(1,1),\"fortran_order\":False,\"descr\":\"<f8\"}\n";
  EXPECT_EQ(read_bytes(std::string("\x93NUMPY\1\0", 8) + bytes_of(static_cast<std::uint16_t>(header.size())) +
                       header + bytes_of(2.5))
                .coordinates,
            (Doubles{2.5}));
}

TEST_F(ReadNpy, Columns) {
  EXPECT_EQ(read("a.npy", npy_of<double>("<f8", "(2, 3)", {1, 2, 3, 4, 5, 6}), {"2", "0"}).coordinates,
            (Doubles{3, 1, 6, 4}));
  expect_error(Errc::bad_format, {"'3'", "0 to 2"}, [&] {
    read("a.npy", npy_of<double>("<f8", "(1, 3)", {1, 2, 3}), {"3"});
  });
}

TEST_F(ReadNpy, NotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto rows = expect_error(Errc::not_finite, {"a.npy: row 1: column 0", "nan", "1 more row)"}, [&] {
    read_bytes(npy_of<double>("<f8", "(3, 2)", {1, 2, nan, nan, 1, -1 / 0.0}));
  });
  EXPECT_EQ(rows, (std::vector<std::size_t>{1, 2}));
  expect_error(Errc::not_finite, {"row 0: column 1"}, [&] {
    read_bytes(npy_of<float>(">f4", "(1, 2)", {1, std::numeric_limits<float>::infinity()}));
  });
}

TEST_F(ReadNpy, IntegersThatAreNotExact) {
  const std::int64_t odd = (std::int64_t{1} << 53) + 1;
  expect_error(Errc::bad_format, {"a.npy: row 1", "9007199254740993"}, [&] {
    read_bytes(npy_of<std::int64_t>("<i8", "(2, 2)", {1, 2, 3, odd}));
  });
  expect_error(Errc::bad_format, {"row 0", "-9007199254740993"}, [&] {
    read_bytes(npy_of<std::int64_t>("<i8", "(2, 2)", {-odd, 2, 3, 4}, true));
  });
  expect_error(Errc::bad_format, {"row 2", "18446744073709551615"}, [&] {
    read_bytes(npy_of<std::uint64_t>(">u8", "(3,)", {1, 2, ~std::uint64_t{0}}));
  });
}

TEST_F(ReadNpy, KindsThatAreNotSupported) {
  for (const char* type : {"<c16", "|O", "<U7", "|S3", "<f2", "<f16", "|b1", "<M8[ns]", "|V8"})
    expect_error(Errc::unsupported, {"a.npy", type},
                 [&] { read_bytes(npy(type, "(1, 1)", std::string(64, '\0'))); });
  const std::string header =
      "{'descr': [('x', '<f8'), ('y', '<f8')], 'fortran_order': False, 'shape': (1,), }\n";
  expect_error(Errc::unsupported, {"a.npy", "named fields"}, [&] {
    read_bytes(std::string("\x93NUMPY\1\0", 8) + bytes_of(static_cast<std::uint16_t>(header.size())) +
               header + std::string(16, '\0'));
  });
  expect_error(Errc::unsupported, {"version 9"},
               [&] { read_bytes(npy("<f8", "(1,)", bytes_of(1.0), false, 9)); });
}

TEST_F(ReadNpy, WrongShapes) {
  expect_error(Errc::bad_format, {"a.npy", "(1, 1, 1)"},
               [&] { read_bytes(npy_of<double>("<f8", "(1, 1, 1)", {1})); });
  expect_error(Errc::bad_format, {"a.npy", "single number"},
               [&] { read_bytes(npy_of<double>("<f8", "()", {1})); });
  expect_error(Errc::bad_dimension, {"a.npy", "(5, 0)", "dimension is 0"},
               [&] { read_bytes(npy("<f8", "(5, 0)", "")); });
}

TEST_F(ReadNpy, Truncated) {
  const std::string whole = npy_of<double>("<f8", "(2, 2)", {1, 2, 3, 4});
  expect_error(Errc::bad_format, {"a.npy", "expected 32 bytes", "found 31"},
               [&] { read_bytes(whole.substr(0, whole.size() - 1)); });
  expect_error(Errc::bad_format, {"expected 32 bytes", "found 33"}, [&] { read_bytes(whole + "x"); });
  // Every prefix is an error, never a crash and never a table.
  for (std::size_t size = 0; size < whole.size(); ++size)
    expect_error(Errc::bad_format, {"a.npy"}, [&] { read_bytes(whole.substr(0, size)); });
}

TEST_F(ReadNpy, ShapesThatNoFileHoldsAreNotAllocated) {
  expect_error(Errc::bad_format, {"a.npy", "truncated"},
               [&] { read_bytes(npy("<f8", "(1000000000000, 3)", "12345678")); });
  expect_error(Errc::bad_format, {"a.npy", "truncated"},
               [&] { read_bytes(npy("<f8", "(4611686018427387904, 4)", "")); });
  expect_error(Errc::bad_format, {"malformed"},
               [&] { read_bytes(npy("<f8", "(99999999999999999999, 4)", "")); });
  expect_error(Errc::bad_dimension, {"too large"}, [&] { read_bytes(npy("<f8", "(0, 4294967296)", "")); });
}

TEST_F(ReadNpy, MalformedHeaders) {
  const auto with_header = [&](std::string header) {
    header += '\n';
    read_bytes(std::string("\x93NUMPY\1\0", 8) + bytes_of(static_cast<std::uint16_t>(header.size())) +
               header + bytes_of(1.0));
  };
  for (const char* header :
       {"", "{", "{}", "[1]", "{'descr': '<f8'}", "{'descr': '<f8', 'fortran_order': Maybe, 'shape': (1,)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': 1}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), 'more': 1}", "{'descr': '<f8"})
    expect_error(Errc::bad_format, {"a.npy", "malformed"}, [&] { with_header(header); });
  expect_error(Errc::bad_format, {"signature"}, [&] { read_bytes("PK\3\4 this is a zip"); });
  expect_error(Errc::bad_format, {"empty"}, [&] { read_bytes(""); });
}

}  // namespace
