// SPDX-License-Identifier: BSD-3-Clause
// Points of laser scanners.
#include "../io_support.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace delone;
using namespace delone_test;
using Doubles = std::vector<double>;
using ReadLas = TemporaryDirectory;

struct Las {
  int minor = 2, point_format = 0;
  std::uint16_t record_bytes = 20;
  std::uint64_t count = 0;
  double scale = 0.01, offset = 1000;

  std::string bytes(const std::vector<std::int32_t>& numbers) const {
    std::string header(minor == 4 ? 375 : 227, '\0');
    const auto put = [&](std::size_t at, const std::string& field) {
      header.replace(at, field.size(), field);
    };
    put(0, "LASF");
    put(24, {1, static_cast<char>(minor), 0}), put(104, {static_cast<char>(point_format), 0});
    header.resize(minor == 4 ? 375 : 227);
    put(94, bytes_of(static_cast<std::uint16_t>(header.size())));
    put(96, bytes_of(static_cast<std::uint32_t>(header.size() + 3)));  // after a record that has other data
    put(105, bytes_of(record_bytes));
    if (minor == 4)
      put(247, bytes_of(count));
    else
      put(107, bytes_of(static_cast<std::uint32_t>(count)));
    for (std::size_t i = 0; i < 3; ++i) {
      put(131 + 8 * i, bytes_of(scale * static_cast<double>(i + 1)));
      put(155 + 8 * i, bytes_of(offset * static_cast<double>(i)));
    }
    std::string all = header + "vlr";
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      for (std::size_t j = i; j < i + 3; ++j) all += bytes_of(numbers[j]);
      all += std::string(record_bytes - 12u, '\x7f');
    }
    return all;
  }
};

TEST_F(ReadLas, CoordinatesAreScaledIntegers) {
  const std::vector<std::int32_t> numbers{1, -2, 3, INT32_MAX, INT32_MIN, 0};
  Doubles expected;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double scaled = numbers[i] * (0.01 * static_cast<double>(i % 3 + 1));
    expected.push_back(scaled + 1000.0 * static_cast<double>(i % 3));
  }
  for (const int minor : {0, 1, 2, 3, 4}) {
    Las las{.minor = minor, .count = 2};
    if (minor == 4) las.point_format = 6, las.record_bytes = 30;
    const PointTable table = read("a.las", las.bytes(numbers) + "waveforms");
    EXPECT_EQ(table.dimension, 3);
    EXPECT_EQ(table.coordinates, expected) << minor;
  }
  EXPECT_EQ(read("a.las", Las{}.bytes({})).num_points(), 0u);
  EXPECT_EQ(read("a.las", Las{.count = 1}.bytes({1, 2, 3}), {"2"}).coordinates,
            (Doubles{3 * (0.01 * 3) + 2000}));
}

TEST_F(ReadLas, FaultsSayWhat) {
  expect_error(Errc::bad_format, {"a.las: not a .las file"}, [&] { read("a.las", "LAS"); });
  expect_error(Errc::bad_format, {"the header ends after 100 of 227 bytes"},
               [&] { read("a.las", Las{}.bytes({}).substr(0, 100)); });
  expect_error(Errc::bad_format, {"the header ends after 230 of 375 bytes"},
               [&] { read("a.las", Las{.minor = 4}.bytes({}).substr(0, 230)); });
  expect_error(Errc::bad_format, {"expected 3 points of 20 bytes, the file ends after 2"}, [&] {
    read("a.las", Las{.count = 3}.bytes({1, 2, 3, 4, 5, 6}));
  });
  expect_error(Errc::bad_format, {"expected 18446744073709551615 points"}, [&] {
    read("a.las", Las{.minor = 4, .count = UINT64_MAX}.bytes({1, 2, 3}));
  });
  expect_error(Errc::bad_format, {"records of 12 bytes"}, [&] {
    read("a.las", Las{.record_bytes = 12, .count = 1}.bytes({1, 2, 3}));
  });
  expect_error(Errc::unsupported, {"LAS 1.5 is not supported"},
               [&] { read("a.las", Las{.minor = 5}.bytes({})); });
  expect_error(Errc::unsupported, {"the points are compressed", "laszip -i"},
               [&] { read("a.las", Las{.point_format = 0x81}.bytes({})); });
  expect_error(Errc::unsupported, {"a.laz: LAZ is not read", "laszip -i", "laspy.read"},
               [&] { read("a.laz", "LASF"); });
  expect_error(Errc::not_finite, {"row 0: inf is not finite"}, [&] {
    read("a.las", Las{.count = 1, .scale = 1e308}.bytes({100, 2, 3}));
  });
}

}  // namespace
