// SPDX-License-Identifier: BSD-3-Clause
// Points from PLY files.
#include "../io_support.hpp"

#include <limits>

namespace {

using namespace delone;
using delone_test::bytes_of;
using delone_test::expect_error;
using Doubles = std::vector<double>;
using Names = std::vector<std::string>;

class ReadPly : public delone_test::TemporaryDirectory {};

TEST_F(ReadPly, Ascii) {
  const auto t = read("a.ply",
                      "ply\nformat ascii 1.0\ncomment a # b\nobj_info x\nelement extra 2\nproperty list "
                      "uchar int a\nproperty float b\n"
                      "element vertex 2\nproperty float x\nproperty list uchar int skip\nproperty double "
                      "y\nproperty uchar red\n"
                      "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
                      "3 1 2 3 0.5\n0 0.25\n1 2 7 8 2.5 255 3\n4 0 5 0 6\n3 0 1 0\n");
  EXPECT_EQ(t.dimension, 3);
  EXPECT_EQ(t.coordinates, (Doubles{1, 2.5, 3, 4, 5, 6}));
  EXPECT_EQ(t.column_names, (Names{"x", "y", "z"}));
}

std::string binary_ply(bool big, int vertices, const std::string& data) {
  return std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
         "_endian 1.0\r\nelement fixed 2\r\nproperty int a\r\nproperty char b\r\n" +
         "element lists 2\r\nproperty list ushort double l\r\nelement vertex " + std::to_string(vertices) +
         "\r\nproperty int8 i1\r\nproperty uint8 u1\r\nproperty int16 i2\r\nproperty uint16 u2\r\nproperty "
         "list uint8 float32 "
         "skip\r\n"
         "property int32 i4\r\nproperty uint32 u4\r\nproperty float32 x\r\nproperty float64 y\r\nelement "
         "face 1\r\nproperty "
         "float q\r\nend_header\r\n" +
         data;
}

std::string binary_data(bool big) {
  std::string data(2 * 5, 'x');
  data += bytes_of<std::uint16_t>(2, big) + std::string(16, 'y') + bytes_of<std::uint16_t>(0, big);
  for (int row = 0; row < 2; ++row) {
    data += bytes_of<std::int8_t>(-1, big) + bytes_of<std::uint8_t>(200, big) +
            bytes_of<std::int16_t>(-300, big) + bytes_of<std::uint16_t>(40000, big) +
            bytes_of<std::uint8_t>(1, big) + "list" + bytes_of<std::int32_t>(-70000, big) +
            bytes_of<std::uint32_t>(4000000000u, big) + bytes_of<float>(1.5f, big) +
            bytes_of<double>(0.1 + row, big);
  }
  return data + "face";
}

TEST_F(ReadPly, BinaryOfEitherOrderAndAllTypes) {
  for (const bool big : {false, true}) {
    const std::string bytes = binary_ply(big, 2, binary_data(big));
    const auto t = read("a.ply", bytes);
    EXPECT_EQ(t.dimension, 2);
    EXPECT_EQ(t.coordinates, (Doubles{1.5, 0.1, 1.5, 1.1}));
    EXPECT_EQ(read("a.ply", bytes, {"i1", "u1", "i2", "u2", "i4", "u4"}).coordinates,
              (Doubles{-1, 200, -300, 40000, -70000, 4e9, -1, 200, -300, 40000, -70000, 4e9}));
  }
}

TEST_F(ReadPly, TruncatedBinary) {
  const std::string bytes = binary_ply(false, 2, binary_data(false));
  const std::size_t vertices_end = bytes.size() - 4;
  for (std::size_t size = bytes.find("element"); size < vertices_end; ++size)
    expect_error(Errc::bad_format, {"a.ply"}, [&] { read("a.ply", bytes.substr(0, size)); });
  expect_error(Errc::bad_format, {"a.ply"},
               [&] { read("a.ply", binary_ply(false, 2000000000, binary_data(false))); });
}

TEST_F(ReadPly, CountsThatNoFileHoldsAreNotAllocated) {
  const auto ply = [](const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n1 2\n";
  };
  const std::string vertex = "element vertex 18446744073709551615\nproperty float x\nproperty float y\n";
  const std::string before = "element other 18446744073709551615\nproperty double x\n" + vertex;
  const std::string nothing = "element other 18446744073709551615\n" + vertex;
  const std::string lists = "element other 2\nproperty list uint double x\n" + vertex;
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const std::string& elements : {vertex, before, nothing, lists})
      expect_error(Errc::bad_format, {"a.ply"}, [&] { read("a.ply", ply(format, elements)); });
}

TEST_F(ReadPly, Faults) {
  const std::string start = "ply\nformat ascii 1.0\nelement vertex 2\n",
                    xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  expect_error(Errc::bad_format, {"expected 2 vertices", "after 1"},
               [&] { read("a.ply", start + xyz + "1 2 3\n"); });
  expect_error(Errc::bad_format, {"a.ply:9", "'q'"}, [&] { read("a.ply", start + xyz + "1 2 3\n1 q 3\n"); });
  expect_error(Errc::bad_format, {"no property 'y'", "x, w"},
               [&] { read("a.ply", start + "property float x\nproperty float w\nend_header\n1 2\n1 2\n"); });
  expect_error(Errc::bad_format, {"no property 'red'", "x, y, z"},
               [&] { read("a.ply", start + xyz + "1 2 3\n4 5 6\n", {"red"}); });
  expect_error(Errc::bad_format, {"no element 'vertex'"},
               [&] { read("a.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n"); });
  expect_error(Errc::bad_format, {"a.ply:4", "'quad'"},
               [&] { read("a.ply", start + "property quad x\nend_header\n"); });
  expect_error(Errc::bad_format, {"a.ply:4", "integer"},
               [&] { read("a.ply", start + "property list float int x\nend_header\n"); });
  expect_error(Errc::bad_format, {"'end_header'"}, [&] { read("a.ply", start); });
  expect_error(Errc::bad_format, {"not a PLY"}, [&] { read("a.ply", "OFF\n"); });
  expect_error(Errc::bad_format, {"'format'"},
               [&] { read("a.ply", "ply\nelement vertex 0\nproperty int x\nproperty int y\nend_header\n"); });
  expect_error(Errc::unsupported, {"'utf8'"}, [&] { read("a.ply", "ply\nformat utf8 1.0\nend_header\n"); });
  expect_error(Errc::bad_format, {"'-5'"},
               [&] { read("a.ply", "ply\nformat ascii 1.0\nelement vertex -5\nend_header\n"); });
  EXPECT_EQ(expect_error(Errc::not_finite, {"y: nan is not finite"},
                         [&] { read("a.ply", start + xyz + "1 2 3\n4 nan 6\n"); }),
            (std::vector<std::size_t>{1}));
  expect_error(Errc::bad_format, {"empty"}, [&] { read("a.ply", ""); });
}

TEST_F(ReadPly, HeadersAreChecked) {
  const auto expect = [&](Errc code, const std::vector<std::string>& parts, const std::string& header) {
    expect_error(code, parts, [&] { read("a.ply", "ply\nformat ascii 1.0\n" + header + "end_header\n"); });
  };
  expect(Errc::bad_format, {"a.ply:3: a property before any element"}, "property float x\n");
  expect(Errc::bad_format, {"a.ply:4: a property without a name"}, "element vertex 0\nproperty float\n");
  expect(Errc::bad_format, {"a.ply:3: 'vertices' does not belong in a PLY header"}, "vertices 3\n");
  expect(Errc::unsupported, {"a.ply:3: PLY version '1.1' is not supported"}, "format ascii 1.1\n");
  expect(Errc::bad_format, {"a.ply:3: '1.5' is not a count"}, "element vertex 1.5\n");
  expect(Errc::bad_format, {"a.ply:4", "'real' is not a type"},
         "element vertex 0\nproperty list uchar real x\n");
}

TEST_F(ReadPly, PropertiesAreChosenByTheirNames) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float y\nproperty list uchar int x2\nproperty float "
      "x\n"
      "property float w\nend_header\n1 0 2 3\n4 1 9 5 6\n";
  EXPECT_EQ(read("a.ply", text).coordinates, (Doubles{2, 1, 5, 4})) << "x and y, as there is no z";
  ReadOptions with_values;
  with_values.values = {"x"};
  const PointTable table = read_points(file("a.ply", text), with_values);
  EXPECT_EQ(table.coordinates, (Doubles{1, 4})) << "x is a value now";
  EXPECT_EQ(table.values, (Doubles{2, 5}));
  expect_error(Errc::bad_format, {"no property 'x2'; they have y, x, w"},
               [&] { read("a.ply", text, {"x2"}); });
}

TEST_F(ReadPly, BinaryFaultsNameTheVertex) {
  const auto ply = [](const std::string& elements, const std::string& data) {
    return "ply\nformat binary_little_endian 1.0\n" + elements + "end_header\n" + data;
  };
  const std::string xy = "element vertex 2\nproperty double x\nproperty double y\n";
  std::string data;
  for (const double x : {1.0, 2.0, 3.0, std::numeric_limits<double>::infinity()}) data += bytes_of(x);
  EXPECT_EQ(expect_error(Errc::not_finite, {"a.ply: vertex 1: y: inf is not finite"},
                         [&] { read("a.ply", ply(xy, data)); }),
            (std::vector<std::size_t>{1}));
  expect_error(Errc::bad_format, {"expected 2 vertices, the file ends after 1"},
               [&] { read("a.ply", ply(xy, data.substr(0, 16))); });
  expect_error(Errc::bad_format, {"a.ply: a list of negative length"}, [&] {
    read("a.ply", ply("element other 1\nproperty list char int l\n" + xy, "\xff" + data));
  });
}

}  // namespace
