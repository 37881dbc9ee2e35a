// SPDX-License-Identifier: BSD-3-Clause
// Roles of rows: what parts may say of them, and what they may not. Whole folders: check_tiles_test.cpp.
#include "tiles/check/check_rows.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace delone::tiles {
namespace {

template <class Work>
void expect_violation(const std::string& message, const std::vector<std::size_t>& points, const Work& work) {
  try {
    work();
    ADD_FAILURE() << "nothing was found; expected: " << message;
  } catch (const Violation& violation) {
    EXPECT_EQ(violation.message, message);
    EXPECT_EQ(violation.points, points);
  }
}

/// The rows 10 … 14: two vertices, a duplicate of each, and a hidden row.
class RolesOfRows : public ::testing::Test {
 protected:
  RolesOfRows() {
    roles_.add(10, 10, 0);
    roles_.add(12, 10, 3);
    roles_.add(11, 11, 1);
    roles_.add(13, -1, 1);
  }
  RowRoles roles_{10, 15};
};

TEST_F(RolesOfRows, AreAsTheCellsSay) {
  EXPECT_EQ(roles_.vertex_of(10, true), 10);
  EXPECT_EQ(roles_.vertex_of(12, false), 10);
  EXPECT_EQ(roles_.vertex_of(13, false), -1);
  expect_violation("point 11 is its own vertex, but no cell has it", {11},
                   [&] { roles_.vertex_of(11, false); });
  expect_violation("point 12 is a vertex of a cell, but merged into another", {12},
                   [&] { roles_.vertex_of(12, true); });
  expect_violation("point 13 is a vertex of a cell, but hidden", {13}, [&] { roles_.vertex_of(13, true); });
}

TEST_F(RolesOfRows, AreThoseOfOnePart) {
  for (const bool has_cell : {false, true})
    expect_violation("point 14 is in no part", {14}, [&] { roles_.vertex_of(14, has_cell); });
  roles_.add(14, 11, 2);
  EXPECT_EQ(roles_.vertex_of(14, false), 11);
  expect_violation("point 12 is in part-0003.npz and in part-0000.npz", {12}, [&] { roles_.add(12, 10, 0); });
}

TEST_F(RolesOfRows, DuplicatesAreOfEarlierVertices) {
  EXPECT_NO_THROW(roles_.require_earlier_vertex(12, 10));
  EXPECT_NO_THROW(roles_.require_earlier_vertex(99, 11)) << "a row of another range";
  expect_violation("point 10 was merged into point 11, which is a later one", {10, 11},
                   [&] { roles_.require_earlier_vertex(10, 11); });
  for (const std::int64_t vertex : {12, 13, 14})
    expect_violation("point 20 was merged into point " + std::to_string(vertex) + ", which is no vertex",
                     {20, static_cast<std::size_t>(vertex)},
                     [&] { roles_.require_earlier_vertex(20, vertex); });
}

TEST_F(RolesOfRows, AreCounted) {
  RoleCounts counts;
  for (const std::int64_t row : {10, 11}) counts.add(row, roles_.vertex_of(row, true));
  for (const std::int64_t row : {12, 13}) counts.add(row, roles_.vertex_of(row, false));
  TilesIndex index;
  index.num_vertices = 2;
  index.num_duplicates = index.num_hidden = 1;
  EXPECT_NO_THROW(counts.compare_with_index(index));
  index.num_hidden = 0;
  expect_violation("there are 1 hidden points, but index.json says 0", {},
                   [&] { counts.compare_with_index(index); });
  index.num_duplicates = 3;
  expect_violation("there are 1 duplicates, but index.json says 3", {},
                   [&] { counts.compare_with_index(index); });
  index.num_vertices = 1;
  expect_violation("there are 2 vertices, but index.json says 1", {},
                   [&] { counts.compare_with_index(index); });
}

}  // namespace
}  // namespace delone::tiles
