// SPDX-License-Identifier: BSD-3-Clause
// What one part alone tells, by the numbers of the whole; and which of several violations counts.
#include "tiles/check/check_part.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace delone::tiles {
namespace {

TEST(Findings, KeepTheFirstOfEachLevelAndStopThere) {
  Findings findings(6);
  EXPECT_TRUE(findings.wanted(6));
  findings.add(5, {"one"});
  EXPECT_FALSE(findings.wanted(6));
  EXPECT_TRUE(findings.wanted(5));
  findings.add(5, {"another"});
  findings.add(2, {"earlier"});
  EXPECT_FALSE(findings.wanted(3));
  EXPECT_NO_THROW(findings.require(4));
  try {
    findings.require(5);
    FAIL();
  } catch (const Violation& violation) {
    EXPECT_EQ(violation.message, "one");
  }
  EXPECT_FALSE(Findings(3).wanted(4));
}

/// Part 2, whose cells are 10, 11, …, and whose points are the rows 100, 101, …
class CheckPart : public ::testing::Test {
 protected:
  void set(int dimension, int affine_dimension, std::vector<double> points, std::vector<SignedIndex> cells,
           std::vector<std::int32_t> neighbors) {
    part_ = {};
    part_.number = 2;
    part_.first_cell = 10;
    part_.data.dimension = dimension;
    part_.data.affine_dimension = affine_dimension;
    part_.data.points = std::move(points);
    part_.data.cells = std::move(cells);
    part_.tile.neighbors = std::move(neighbors);
    for (std::size_t v = 0; v < part_.data.num_points(); ++v)
      part_.tile.rows.push_back(100 + static_cast<std::int64_t>(v));
    reference_ = {};
  }
  std::size_t check(bool canonical = false) {
    findings_ = Findings(6);
    return check_part(part_, reference_, canonical, 1, findings_);
  }
  void expect_found(int level, const std::string& message, const std::vector<std::size_t>& cells,
                    const std::vector<std::size_t>& points = {}) {
    check();
    try {
      findings_.require(level);
      ADD_FAILURE() << "nothing at level " << level << "; expected " << message;
    } catch (const Violation& violation) {
      EXPECT_EQ(violation.message, "part-0002.npz, by its own numbers: " + message);
      EXPECT_EQ(violation.cells, cells);
      EXPECT_EQ(violation.points, points);
    }
    EXPECT_FALSE(findings_.wanted(level + 1));
  }

  CheckedPart part_;
  Reference reference_;
  Findings findings_{6};
};

const std::vector<double> corners_of_square{0, 0, 2, 0, 2, 2, 0, 2};

TEST_F(CheckPart, SoundOnesPassAndTheFirstIsTheReference) {
  set(2, 2, corners_of_square, {0, 1, 2, 0, 2, 3}, {-2, 1, -3, -1, -1, 0});
  EXPECT_EQ(check(), 1u) << "a tie";
  EXPECT_TRUE(findings_.wanted(6));
  EXPECT_EQ(reference_.cell, 10);
  EXPECT_EQ(reference_.rows, (std::vector<std::int64_t>{100, 101, 102}));
  EXPECT_EQ(reference_.points, (std::vector<double>{0, 0, 2, 0, 2, 2}));
  set(2, 2, corners_of_square, {}, {});
  EXPECT_EQ(check(), 0u);
  EXPECT_EQ(reference_.cell, -1) << "a part without cells";
  EXPECT_TRUE(findings_.wanted(6));
}

TEST_F(CheckPart, NeighborsAreMutualAndShareTheirFacet) {
  set(2, 2, corners_of_square, {0, 1, 2, 0, 2, 3}, {1, -1, -3, -1, -1, 0});
  expect_found(2, "neighbor 0 of cell 0 is cell 1, which does not share the facet {1, 2}", {10, 11});
  set(2, 2, corners_of_square, {0, 1, 2, 0, 2, 3}, {0, 1, -1, -1, -1, 0});
  expect_found(2, "neighbor 0 of cell 0 is cell 0, which does not share the facet {1, 2}", {10, 10});
  set(2, 2, corners_of_square, {0, 1, 2, 0, 2, 3}, {-2, 1, -1, -1, -1, -1});
  expect_found(2, "neighbor 1 of cell 0 is cell 1, but not the other way round", {10, 11});
  set(2, 2, corners_of_square, {0, 1, 2, 2, 0, 3}, {-2, 1, -1, -1, -1, 0});
  expect_found(2, "the cells 0 {0, 1, 2} and 1 {2, 0, 3} are not oriented coherently", {10, 11});
}

TEST_F(CheckPart, CellsLieInTheFlatOfTheReference) {
  // Two triangles in space that share an edge, one of them out of the plane of the other.
  set(3, 2, {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 1e-300}, {0, 1, 2, 0, 2, 3}, {-2, 1, -3, -1, -1, 0});
  expect_found(4, "cell 1 leaves the flat of dimension 2 of the cell 10 of the whole", {11}, {103});
  set(3, 2, {0, 0, 0, 2, 0, 0, 4, 0, 0}, {0, 1, 2}, {-1, -1, -1});
  check();
  EXPECT_THROW(findings_.require(4), Violation) << "the reference is flat";
  EXPECT_TRUE(reference_.is_flat);
}

TEST_F(CheckPart, NoOtherCellCoversTheReference) {
  // The same triangle, of other rows; and a larger one that holds it.
  for (const double size : {2.0, 9.0}) {
    set(2, 2, {0, 0, 2, 0, 0, 2, 0, 0, size, 0, 0, size}, {0, 1, 2, 3, 4, 5}, {-1, -1, -1, -1, -1, -1});
    expect_found(5, "cell 1 overlaps the cell 10 of the whole", {11});
  }
  set(2, 2, {0, 0, 2, 0, 0, 2, -1, 0, 0, -2, 0, 0}, {0, 1, 2, 3, 4, 5}, {-1, -1, -1, -1, -1, -1});
  check();
  EXPECT_TRUE(findings_.wanted(6)) << "one that only touches it";
}

TEST_F(CheckPart, SpheresAreEmptyWithin) {
  set(2, 2, {0, 0, 3, 0, 0, 3, 2, 2}, {0, 1, 2, 1, 3, 2}, {1, -1, -1, -1, 0, -1});
  check();
  EXPECT_THROW(findings_.require(5), Violation);
}

}  // namespace
}  // namespace delone::tiles
