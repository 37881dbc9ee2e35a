// SPDX-License-Identifier: BSD-3-Clause
// The point that tells whether proposed cells cover space once.
#include "compiled/points_to_wrap.hpp"

#include "../engine/engine_support.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::compiled {
namespace {

/// Points of the plane with the cells of their triangulation.
struct Wrapped {
  explicit Wrapped(const std::vector<double>& rows)
      : points(2, kernel::RowForm::point), cells(rows, 2, -9, 9) {
    for (std::size_t i = 0; i < rows.size(); i += 2) points.append(&rows[i]);
    cells.seed();
    for (Index v = 4; v <= points.last_vertex(); ++v) cells.build.insert(v, invalid_index);
  }
  std::vector<Index> finite() const {
    std::vector<Index> found;
    for (Index cell = 0; cell < cells.build.cells().num_slots(); ++cell)
      if (cells.build.cells().infinite_slot(cell) < 0) found.push_back(cell);
    return found;
  }
  bool is_in_one(std::span<const Index> of, std::vector<double> q) {
    return is_in_one_of<2>(of, cells.build.cells(), cells.build.geometry(), points, q.data());
  }
  std::optional<std::vector<double>> find() {
    return find_point_in_one_cell<2>(cells.build.cells(), cells.build.geometry(), points);
  }

  VertexPoints points;
  engine::Points<2> cells;
};

TEST(PointsToWrap, APointIsInsideOneCellAndOnNoBoundary) {
  Wrapped square({0, 0, 4, 0, 0, 4, 4, 5});
  const std::vector<Index> cells = square.finite();
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_TRUE(square.is_in_one(cells, {1, 1}));
  EXPECT_TRUE(square.is_in_one(cells, {3, 3}));
  EXPECT_FALSE(square.is_in_one(cells, {2, 2})) << "between both";
  EXPECT_FALSE(square.is_in_one(cells, {1, 0})) << "on an edge of one";
  EXPECT_FALSE(square.is_in_one(cells, {5, 5})) << "in none";
  const std::vector<Index> twice{cells[0], cells[1], cells[0], cells[1]};
  EXPECT_FALSE(square.is_in_one(twice, {1, 1})) << "in two";
}

TEST(PointsToWrap, ThePointIsBesideAnExtremeVertex) {
  // Two vertices have the least x, so that the second axis serves.
  for (const std::vector<double>& rows : {std::vector<double>{0, 1, 4, 0, 1, 4, 4, 5, 2, 2},
                                          std::vector<double>{0, 1, 4, 0, 0, 4, 4, 5, 2, 2}}) {
    Wrapped set(rows);
    const auto point = set.find();
    ASSERT_TRUE(point);
    EXPECT_TRUE(set.is_in_one(set.finite(), *point));
  }
  // A square along the axes has no such vertex.
  EXPECT_FALSE(Wrapped({0, 0, 4, 0, 0, 4, 4, 4}).find());
}

}  // namespace
}  // namespace delone::compiled
