// SPDX-License-Identifier: BSD-3-Clause
// Copies of engines are engines of their own: what is inserted into one of them is not in the other.
#include "compiled/compact_triangulation.hpp"
#include "compiled/triangulation_engine.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <numeric>
#include <set>
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

Index num_cells(const auto& held) { return complex_of(held, 1, {}).num_all_cells(); }

/// Of each of some cells, in no order.
std::multiset<std::set<Index>> vertices_of(const Complex& complex, const std::vector<Index>& cells) {
  std::multiset<std::set<Index>> result;
  for (const Index cell : cells) {
    std::set<Index> vertices;
    for (int i = 0; i <= complex.affine_dimension(); ++i)
      vertices.insert(index(complex.vertex(CellId{cell}, i)));
    result.insert(vertices);
  }
  return result;
}

TEST(EngineCopies, GoTheirOwnWays) {
  for (int d = 1; d <= 4; ++d) {
    Some original(d, 60);
    for (Index v = static_cast<Index>(d) + 2; v <= 30; ++v) original.engine->insert(v, invalid_index);
    VertexPoints points = original.points;
    const Index before = num_cells(*original.engine);
    const auto copy = original.engine->copy(points);
    EXPECT_EQ(num_cells(*copy), before);
    EXPECT_EQ(effort_of(*copy).created_cells, effort_of(*original.engine).created_cells);
    for (Index v = 31; v <= 60; ++v) EXPECT_EQ(copy->insert(v, invalid_index).vertex, v);
    EXPECT_GT(num_cells(*copy), before);
    EXPECT_EQ(num_cells(*original.engine), before);
    for (Index v = 31; v <= 60; ++v) original.engine->insert(v, invalid_index);
    EXPECT_EQ(num_cells(*copy), num_cells(*original.engine));

    const CompactTriangulation compact(original.axes, points, *copy, complex_of(*copy, 60, {}));
    const CompactTriangulation compact_copy(original.points, compact);
    EXPECT_EQ(num_cells(compact_copy), num_cells(*copy));
    const std::vector<double> center(static_cast<std::size_t>(d), 0.5);
    EXPECT_EQ(locate(compact_copy, center.data(), invalid_index).cell,
              locate(compact, center.data(), invalid_index).cell);
    std::vector<Index> of_engine, of_compact;
    for (const CellId c : conflict_zone(*copy, center.data(), invalid_index)) of_engine.push_back(index(c));
    for (const CellId c : conflict_zone(compact, center.data(), invalid_index))
      of_compact.push_back(index(c));
    EXPECT_FALSE(of_engine.empty());
    EXPECT_EQ(vertices_of(complex_of(*copy, 60, {}), of_engine),
              vertices_of(complex_of(compact, 60, {}), of_compact));
  }
}

}  // namespace
}  // namespace delone::compiled
