// SPDX-License-Identifier: BSD-3-Clause
// Values that are not finite are reported after the last row, all rows together.
#include "io/collect.hpp"
#include "io_support.hpp"

#include <limits>
#include <string>
#include <vector>

namespace {

using namespace delone;
using delone_test::expect_error;
using Rows = std::vector<std::size_t>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(RequireFiniteRows, NamesTheRowsOnceEach) {
  io::require_finite(std::vector<double>{1, -0.0, std::numeric_limits<double>::max()}, 3, "f");
  io::require_finite({}, 3, "f");
  EXPECT_EQ(expect_error(Errc::not_finite, {"f: row 1: column 0: nan is not finite"},
                         [] {
                           io::require_finite(std::vector<double>{0, 0, nan, infinity}, 2, "f");
                         }),
            Rows{1});
  EXPECT_EQ(expect_error(Errc::not_finite, {"row 0: column 1", "(and 1 more row)"},
                         [] {
                           io::require_finite(std::vector<double>{0, -infinity, 0, 0, nan, 0}, 2, "f");
                         }),
            (Rows{0, 2}));
  EXPECT_EQ(expect_error(Errc::not_finite, {"here (and 2 more rows)"},
                         [] {
                           io::require_finite(std::vector<double>{nan, nan, nan}, 1, "f", "here");
                         }),
            (Rows{0, 1, 2}));
  EXPECT_EQ(expect_error(Errc::not_finite, {"f: row 11: column 0"},
                         [] {
                           io::require_finite(std::vector<double>{0, 0, nan, 0}, 2, "f", {}, 10);
                         }),
            Rows{11});
}

TEST(DescribeNotFinite, TellsNamesFromDecimals) {
  EXPECT_EQ(io::describe_not_finite("nan"), "'nan' is not finite");
  EXPECT_EQ(io::describe_not_finite("1e999"), "'1e999' is beyond the range of double precision");
}

TEST(PointCollector, DescribesTheFirstValueOnly) {
  io::PointCollector points;
  points.table.dimension = 2;
  int described = 0;
  const auto describe = [&] { return "value " + std::to_string(++described); };
  for (const double value : {0.0, 1.0, infinity, 2.0, 3.0, nan}) points.add(value, describe);
  EXPECT_EQ(described, 1);
  EXPECT_EQ(expect_error(Errc::not_finite, {"value 1 (and 1 more row)"}, [&] { points.finish(); }),
            (Rows{1, 2}));
}

TEST(PointCollector, GivesWhatWasAdded) {
  io::PointCollector points;
  points.table.dimension = 2;
  for (const double value : {0.0, 1.0, 2.0, 3.0}) points.add(value, [] { return std::string("unused"); });
  const PointTable table = points.finish();
  EXPECT_EQ(table.dimension, 2);
  EXPECT_EQ(table.coordinates, (std::vector<double>{0, 1, 2, 3}));
}

}  // namespace
