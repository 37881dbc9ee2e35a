// SPDX-License-Identifier: BSD-3-Clause
// Copies of engines are engines of their own: what is inserted into one of them is not in the other.
#include "compiled/compact_triangulation.hpp"
#include "compiled/dispatch.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace delone::compiled {
namespace {

struct Some {
  explicit Some(int d, std::size_t n) : points(d, kernel::RowForm::point) {
    points.coordinates.reserve((n + 1) * static_cast<std::size_t>(d));
    for (const double x : make_point_set("uniform", d, n, 1)) points.coordinates.push_back(x);
    for (Index v = 1; v <= points.last_vertex(); ++v) points.grid.include(points.point(v));
    const auto size = static_cast<std::size_t>(d);
    axes.resize(size);
    std::iota(axes.begin(), axes.end(), 0);
    engine = make_triangulation_engine(
        axes, points, {std::vector<double>(size, 0.0), std::vector<double>(size, 1.0)}, {}, false);
    std::vector<Index> simplex(size + 1);
    std::iota(simplex.begin(), simplex.end(), Index{1});
    engine->seed(simplex);
  }
  VertexPoints points;
  std::vector<int> axes;
  std::unique_ptr<TriangulationEngine> engine;
};

Index num_cells(const TriangulationQueries& queries) { return queries.complex(1, {}).num_all_cells(); }

TEST(EngineCopies, GoTheirOwnWays) {
  for (int d = 1; d <= 4; ++d) {
    Some original(d, 60);
    for (Index v = static_cast<Index>(d) + 2; v <= 30; ++v) original.engine->insert(v, invalid_index);
    VertexPoints points = original.points;
    const Index before = num_cells(*original.engine);
    const auto copy = original.engine->copy(points);
    EXPECT_EQ(num_cells(*copy), before);
    EXPECT_EQ(copy->effort().created_cells, original.engine->effort().created_cells);
    for (Index v = 31; v <= 60; ++v) EXPECT_EQ(copy->insert(v, invalid_index).vertex, v);
    EXPECT_GT(num_cells(*copy), before);
    EXPECT_EQ(num_cells(*original.engine), before);
    for (Index v = 31; v <= 60; ++v) original.engine->insert(v, invalid_index);
    EXPECT_EQ(num_cells(*copy), num_cells(*original.engine));

    const auto compact = make_compact_triangulation(original.axes, points, *copy, copy->complex(60, {}));
    const auto compact_copy = compact->copy(original.points);
    EXPECT_EQ(num_cells(*compact_copy), num_cells(*copy));
    const std::vector<double> center(static_cast<std::size_t>(d), 0.5);
    EXPECT_EQ(compact_copy->locate(center.data(), invalid_index).cell,
              compact->locate(center.data(), invalid_index).cell);
  }
}

}  // namespace
}  // namespace delone::compiled
