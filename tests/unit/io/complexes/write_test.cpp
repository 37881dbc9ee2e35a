// SPDX-License-Identifier: BSD-3-Clause
// Triangulations written and read back, the formats that take a few lines, and data that cannot be written.
#include "complex_support.hpp"
#include "small_results.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace {

using namespace delone;
using namespace delone_test;

using Write = ResultFiles;

TEST_F(Write, RoundTrips) {
  std::vector<ComplexData> all{square()};
  for (int d = 1; d <= 6; ++d)
    for (int k = -1; k <= d; ++k) all.push_back(one_cell(k, d));
  for (const ComplexData& data : all)
    for (const char* name : {"a.npz", "a.json", "a.off"}) {
      write(path(name), data);
      expect_same(read_as<ComplexData>(path(name)), data, std::string(name) != "a.off",
                  std::string(name) + " k=" + std::to_string(data.affine_dimension) +
                      " d=" + std::to_string(data.dimension));
    }
}

TEST_F(Write, WeightsRoundTripToTheBit) {
  using Limits = std::numeric_limits<double>;
  for (const std::vector<double>& weights :
       {std::vector<double>{0.1, -0.0, Limits::max(), Limits::denorm_min(), -2},
        {1, 2, 3, 4, 5},
        {-Limits::max(), 1e300, 1e-310, 0, 1 / 3.}}) {
    ComplexData data = square();
    data.weights = weights;
    data.vertex_of_point[4] = -1;  // hidden
    for (const char* name : {"a.npz", "a.json"}) {
      write(path(name), data);
      expect_same(read_as<ComplexData>(path(name)), data, true, name);
    }
  }
  write(path("a.npz"), square());
  EXPECT_TRUE(read_as<ComplexData>(path("a.npz")).weights.empty()) << "no weights are not weights of 0";
}

TEST_F(Write, WeightFaults) {
  for (const char* name : {"b.npz", "b.json"}) {
    ComplexData data = square();
    data.weights = {0, 1, 2, NAN, 4};
    EXPECT_EQ(expect_error(Errc::not_finite, {"weights: row 3"}, [&] { write(path(name), data); }),
              (std::vector<std::size_t>{3}));
    data.weights = {0, 1, 2, 3};
    expect_error(Errc::invalid_argument, {"weights"}, [&] { write(path(name), data); });
    EXPECT_FALSE(std::filesystem::exists(path(name)));
  }
}

TEST_F(Write, UnknownMembersStayUnknown) {
  ComplexData data = square();
  data.neighbors.clear();
  data.vertex_of_point.clear();
  for (const char* name : {"a.npz", "a.json"}) {
    write(path(name), data);
    expect_same(read_as<ComplexData>(path(name)), data, true, name);
  }
}

TEST_F(Write, HullsOfOtherFormatsAreTheirCells) {
  const HullData hull = test::small_hull();
  write(path("hull.txt"), hull);
  EXPECT_EQ(content("hull.txt"), "3\n0 1\n1 2\n2 0\n");
  write(path("hull.off"), hull);
  const auto data = read_as<ComplexData>(path("hull.off"));
  EXPECT_EQ(data.affine_dimension, 1);
  EXPECT_EQ(data.cells, hull.cells);
}

TEST_F(Write, CellsOnly) {
  write(path("a.txt"), square());
  EXPECT_EQ(content("a.txt"), "2\n0 1 2\n1 3 2\n");
  write(path("a.npy"), square());
  EXPECT_EQ(read_points(path("a.npy")).coordinates, (std::vector<double>{0, 1, 2, 1, 3, 2}));
}

TEST_F(Write, StandardOutput) {
  const auto printed = [&](const std::string& format) {
    testing::internal::CaptureStdout();
    write("-", square(), format);
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(printed(""), "2\n0 1 2\n1 3 2\n");
  EXPECT_EQ(printed("off").substr(0, 5), "nOFF\n");
  for (const char* format : {"npz", "npy", "vtu"})
    expect_error(Errc::unsupported, {"binary"}, [&] { write("-", square(), format); });
}

TEST_F(Write, WriteFaults) {
  const auto expect = [&](Errc code, const std::vector<std::string>& parts, const auto& change,
                          const std::string& name = "a.npz") {
    ComplexData data = square();
    change(data);
    expect_error(code, parts, [&] { write(path(name), data); });
  };
  expect(
      Errc::unsupported, {"a.xls", "npz, vtu"}, [](ComplexData&) {}, "a.xls");
  expect(Errc::bad_dimension, {"dimension is 0"}, [](ComplexData& c) { c.dimension = 0; });
  expect(Errc::invalid_argument, {"points: expected shape (4, 2)", "found 9 numbers"},
         [](ComplexData& c) { c.points.pop_back(); });
  expect(Errc::invalid_argument, {"cells"}, [](ComplexData& c) { c.cells.pop_back(); });
  expect(Errc::invalid_argument, {"neighbors"}, [](ComplexData& c) { c.neighbors.pop_back(); });
  expect(Errc::invalid_argument, {"vertex_of_point"}, [](ComplexData& c) { c.vertex_of_point.pop_back(); });
  expect(Errc::invalid_argument, {"affine dimension"}, [](ComplexData& c) { c.affine_dimension = 3; });
  expect(Errc::not_finite, {"row 1"}, [](ComplexData& c) { c.points[2] = NAN; });
  for (const char* name : {"a.off", "a.svg", "a.vtu"}) {
    expect(
        Errc::invalid_argument, {"cell 1 refers to point 5 of 5"}, [](ComplexData& c) { c.cells[5] = 5; },
        name);
    expect(
        Errc::invalid_argument, {"cell 0 refers to point -1"}, [](ComplexData& c) { c.cells[0] = -1; }, name);
  }
  EXPECT_EQ(num_files(), 0u);
  if (std::filesystem::exists("/dev/full"))
    for (const char* format : {"npz", "json", "off", "txt", "npy", "vtu", "svg"})
      expect_error(Errc::cannot_write, {"/dev/full", "No space left"},
                   [&] { write("/dev/full", square(), format); });
}

}  // namespace
