// SPDX-License-Identifier: BSD-3-Clause
// Tables of points written and read back bit by bit, and files that appear whole or not at all.
#include "../io_support.hpp"
#include "io/atomic_file.hpp"

#include <cmath>
#include <limits>

namespace {

using namespace delone;
using delone_test::expect_error;
namespace fs = std::filesystem;

class WritePoints : public delone_test::TemporaryDirectory {};
class AtomicFileTest : public delone_test::TemporaryDirectory {};

/// Denormals, extremes, negative zero, and random bit patterns.
PointTable hard_numbers(int dimension) {
  PointTable t;
  t.dimension = dimension;
  t.coordinates = {5e-324, -0.0, 0.1, 1e23, std::numeric_limits<double>::max(), -2.2250738585072011e-308};
  std::mt19937_64 random(7);
  while (t.coordinates.size() < 600) {
    const auto x = std::bit_cast<double>(random());
    if (std::isfinite(x)) t.coordinates.push_back(x);
  }
  return t;
}

TEST_F(WritePoints, RoundTripsAreBitwise) {
  for (const int dimension : {1, 2, 3, 5}) {
    const PointTable t = hard_numbers(dimension);
    for (const char* name : {"a.npy", "a.csv", "a.tsv", "a.txt", "a.xyz", "a.pts", "a.off", "a.qhull"}) {
      write_points(path(name), t);
      const PointTable back = read_points(path(name));
      EXPECT_EQ(back.dimension, dimension) << name;
      ASSERT_EQ(back.coordinates.size(), t.coordinates.size()) << name;
      EXPECT_EQ(
          std::memcmp(back.coordinates.data(), t.coordinates.data(), t.coordinates.size() * sizeof(double)),
          0)
          << name;
    }
  }
  EXPECT_EQ(num_files(), 8u);
}

TEST_F(WritePoints, NoPointsKeepTheirDimension) {
  PointTable t;
  t.dimension = 4;
  t.column_names = {"a", "b", "c", "d"};
  for (const char* name : {"a.npy", "a.csv", "a.off", "a.qhull"}) {
    write_points(path(name), t);
    const PointTable back = read_points(path(name));
    EXPECT_EQ(back.dimension, 4) << name;
    EXPECT_EQ(back.num_points(), 0u) << name;
  }
}

TEST_F(WritePoints, Names) {
  PointTable t{2, {1, 2}, {"a, \"b\"\nc", "#y"}};
  for (const char* name : {"a.csv", "a.tsv"}) {
    write_points(path(name), t);
    const PointTable back = read_points(path(name));
    EXPECT_EQ(back.column_names, t.column_names) << name;
    EXPECT_EQ(back.coordinates, t.coordinates) << name;
  }
  t.column_names = {"#a", "b"};
  write_points(path("a.csv"), t);
  EXPECT_EQ(read_points(path("a.csv")).column_names, t.column_names);
  t.column_names = {"\xEF\xBB\xBF.5", ".5"};  // begins like a file with a byte order mark
  write_points(path("a.csv"), t);
  EXPECT_EQ(read_points(path("a.csv")).column_names, t.column_names);
  EXPECT_EQ(read_points(path("a.csv")).coordinates, t.coordinates);
  t.column_names = {"2001", "2002"};  // would be read as a point
  write_points(path("a.csv"), t);
  EXPECT_EQ(content("a.csv"), "1,2\n");
}

TEST_F(WritePoints, StandardOutput) {
  const PointTable t{2, {1, 2.5}, {}};
  const auto printed = [&](const std::string& format) {
    testing::internal::CaptureStdout();
    write_points("-", t, format);
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(printed(""), "2\n1\n1 2.5\n");
  EXPECT_EQ(printed("csv"), "1,2.5\n");
  EXPECT_EQ(printed("off"), "nOFF\n2\n1 0 0\n1 2.5\n");
  expect_error(Errc::unsupported, {"binary"}, [&] { write_points("-", t, "npy"); });
}

TEST_F(WritePoints, Faults) {
  const PointTable t{2, {1, 2}, {}};
  expect_error(Errc::unsupported, {"'ply'", "npy, csv"}, [&] { write_points(path("a.ply"), t); });
  expect_error(Errc::bad_dimension, {"dimension is 0"}, [&] { write_points(path("a.csv"), PointTable{}); });
  expect_error(Errc::invalid_argument, {"multiple"}, [&] {
    write_points(path("a.csv"), PointTable{2, {1, 2, 3}, {}});
  });
  EXPECT_EQ(expect_error(Errc::not_finite, {"row 1"},
                         [&] {
                           write_points(path("a.csv"), PointTable{1, {1, NAN}, {}});
                         }),
            (std::vector<std::size_t>{1}));
  expect_error(Errc::cannot_write, {"none/a.csv", "No such file"},
               [&] { write_points(path("none/a.csv"), t); });
  fs::create_directory(path("dir.csv"));
  expect_error(Errc::cannot_write, {"dir.csv", "directory"}, [&] { write_points(path("dir.csv"), t); });
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(WritePoints, DiskFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  expect_error(Errc::cannot_write, {"/dev/full", "No space left"}, [&] {
    write_points("/dev/full", PointTable{2, {1, 2}, {}}, "csv");
  });
  PointTable large{1, std::vector<double>(100000, 0.1), {}};
  for (const char* format : {"csv", "npy", "off"})
    expect_error(Errc::cannot_write, {"/dev/full", "No space left"},
                 [&] { write_points("/dev/full", large, format); });
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(AtomicFileTest, NothingAppearsBeforeCommit) {
  file("a", "old");
  {
    io::AtomicFile out(path("a"));
    out.write("new");
    EXPECT_EQ(content("a"), "old");
    EXPECT_EQ(num_files(), 2u);  // the temporary is in the same directory
    out.commit();
  }
  EXPECT_EQ(content("a"), "new");
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(AtomicFileTest, UnwindingRemovesTheTemporary) {
  file("a", "old");
  for (const char* name : {"a", "b"}) {
    try {
      io::AtomicFile out(path(name));
      out.write(std::string(1 << 20, 'x'));
      out.print("{}", 1);
      throw 1;
    } catch (int) {
    }
  }
  EXPECT_EQ(content("a"), "old");
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(AtomicFileTest, SmallAndLargePiecesKeepTheirOrder) {
  std::string expected;
  {
    io::AtomicFile out(path("a"));
    for (int i = 0; i < 200; ++i) {
      const std::string piece(static_cast<std::size_t>(i) * 997, static_cast<char>('a' + i % 26));
      out.write(piece);
      out.print("[{}]", i);
      out.put(i);
      out.put('\n');
      expected += piece + "[" + std::to_string(i) + "]" + std::to_string(i) + "\n";
    }
    out.commit();
  }
  EXPECT_EQ(content("a"), expected);
}

TEST_F(AtomicFileTest, NamesOfAnyLength) {
  const std::string name(250, 'n');
  io::AtomicFile out(path(name));
  out.write("x");
  out.commit();
  EXPECT_EQ(content(name), "x");
}

}  // namespace
