// SPDX-License-Identifier: BSD-3-Clause
// OFF, written and read.
#include "complex_support.hpp"

namespace {

using namespace delone;
using namespace delone_test;

using WriteOff = ResultFiles;

TEST_F(WriteOff, Off) {
  write(path("a.off"), square());
  EXPECT_EQ(content("a.off"), "nOFF\n2\n5 2 0\n0 0\n1 0\n0 1\n1 1.5\n0 0\n3 0 1 2\n3 1 3 2\n");
  EXPECT_EQ(read_as<ComplexData>(file("b.off", "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n"))
                .affine_dimension,
            2);
  const std::string start = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  const auto expect = [&](const std::vector<std::string>& parts, const std::string& text) {
    expect_error(Errc::bad_format, parts, [&] { read_as<ComplexData>(file("a.off", text)); });
  };
  expect({"a.off:7: face 1: expected 3 vertices as before, found 2"}, start + "3 0 1 2\n2 0 1\n");
  expect({"expected 2 faces", "after 1"}, start + "3 0 1 2\n");
  expect({"a.off:7: face 1: expected 3 vertices, found 2"}, start + "3 0 1 2\n3 0 1\n");
  expect({"more than the 2 faces"}, start + "3 0 1 2\n3 0 1 2\n3 0 1 2\n");
  expect({"a.off:6", "'-1'"}, start + "3 0 1 -1\n");
  expect({"a.off:6", "99999999999999999999"}, start + "3 0 1 99999999999999999999\n");
  expect({"a.off:6", "no simplex"}, start + "5 0 1 2 0 1\n5 0 1 2 0 1\n");
  expect({"without vertices"}, start + "0\n0\n");
  expect({"18446744073709551615 faces"}, "OFF\n1 18446744073709551615 0\n0 0 0\n1 0\n");
}

TEST_F(WriteOff, FacetsWithoutLists) {
  IntersectionData data;
  data.dimension = 3;
  data.bounded = true;
  data.facet_halfspaces = {0, 1};
  expect_error(Errc::invalid_argument, {"facet_offsets has 0 numbers for 2 facets"},
               [&] { write(path("a.off"), data); });
  data.facet_halfspaces.clear();
  write(path("a.off"), data);
  EXPECT_EQ(content("a.off"), "OFF\n0 0 0\n");
}

}  // namespace
