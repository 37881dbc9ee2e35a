// SPDX-License-Identifier: BSD-3-Clause
// The exact stages for cells given by their vertices.
#include "geometry/point_predicates.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace delone::geometry {
namespace {

/// Points of R^K by vertex id, 0 a dummy, with their grid.
template <int K>
struct Points {
  explicit Points(std::vector<double> x) : coordinates(K, 0.0), grid(K) {
    for (std::size_t i = 0; i < x.size(); i += K) grid.include(&x[i]);
    coordinates.insert(coordinates.end(), x.begin(), x.end());
    std::vector<int> axes(K);
    std::iota(axes.begin(), axes.end(), 0);
    predicates.emplace(axes, K, kernel::RowForm::point, coordinates);
  }
  PointQuery query(Index v) const { return {predicates->point(v), &grid, K}; }
  Index size() const { return static_cast<Index>(coordinates.size() / K) - 1; }

  std::vector<double> coordinates;
  kernel::Grid grid;
  std::optional<PointPredicates<K>> predicates;
};

TEST(PointPredicates, SidesOfASquareAndItsHull) {
  const Points<2> points({0, 0, 2, 0, 2, 2, 0, 2, 1, 1, 5, 5, 2, 0});
  StageCounts counts;
  const Index cell[] = {1, 2, 3};
  EXPECT_EQ(points.predicates->exact_side(cell, -1, points.query(5), counts), Sign::negative);
  EXPECT_EQ(points.predicates->exact_side(cell, -1, points.query(6), counts), Sign::positive);
  EXPECT_EQ(points.predicates->exact_side(cell, -1, points.query(4), counts), Sign::zero);
  EXPECT_NE(points.predicates->perturbed_side(cell, points.query(4), counts), Sign::zero);
  EXPECT_EQ(counts.direct, 3u);
  EXPECT_EQ(counts.perturbed, 1u);
  EXPECT_EQ(points.predicates->unperturbed_side(cell, points.query(4)), Sign::zero);
  // Infinite cells are in conflict with what is beyond their hull facet.
  const Index below[] = {2, 1, 0}, above[] = {4, 3, 0};
  EXPECT_EQ(points.predicates->exact_side(below, 2, points.query(5), counts), Sign::positive);
  EXPECT_EQ(points.predicates->exact_side(above, 2, points.query(5), counts), Sign::positive);
  EXPECT_EQ(points.predicates->exact_side(above, 2, points.query(6), counts), Sign::negative);
  EXPECT_EQ(points.predicates->side_of_facet(cell, 2, points.query(5)), Sign::positive);
  EXPECT_EQ(points.predicates->side_of_facet(cell, 1, points.query(4)), Sign::negative);
  EXPECT_TRUE(points.predicates->is_at(2, points.query(7)));
  EXPECT_FALSE(points.predicates->is_at(1, points.query(7)));
}

/// On small grids, of which some are tiny, and on a fine one.
template <int K>
void expect_perturbed_sides_as_one_by_one() {
  random::Generator generator(K);
  for (const double offset : {0.0, 1.0 / 3}) {
    std::vector<double> corners;
    for (std::size_t v = 0; v < std::size_t{1} << K; ++v)
      for (std::size_t r = 0; r < K; ++r) corners.push_back(static_cast<double>(v >> r & 1));
    corners.insert(corners.end(), K, offset);
    const Points<K> points(std::move(corners));
    ASSERT_EQ(points.grid.is_small(), offset == 0);
    std::vector<std::vector<Index>> cells;
    const Index q = 1 + static_cast<Index>(generator.below(std::uint64_t{1} << K));
    while (cells.size() < 21) {
      std::vector<Index> cell;
      for (int i = 0; i <= K; ++i)
        cell.push_back(1 + static_cast<Index>(generator.below(std::uint64_t{1} << K)));
      std::vector<const double*> rows;
      for (const Index v : cell) rows.push_back(points.predicates->point(v));
      const Sign sign = kernel::orientation<K>({K, points.predicates->axes()}, rows.data(), points.grid);
      if (sign == Sign::zero || std::find(cell.begin(), cell.end(), q) != cell.end()) continue;
      if (sign == Sign::negative) std::swap(cell[0], cell[1]);
      cells.push_back(cell);
    }
    std::vector<const Index*> pointers;
    for (const auto& cell : cells) pointers.push_back(cell.data());
    std::vector<Sign> sides(cells.size(), Sign::zero);
    StageCounts counts, uncounted;
    points.predicates->perturbed_sides(pointers, points.query(q), sides.data(), counts);
    EXPECT_EQ(counts.perturbed, cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      EXPECT_EQ(sides[i], points.predicates->perturbed_side(pointers[i], points.query(q), uncounted));
  }
}

TEST(PointPredicates, TiesOfManyCellsAreBrokenAsOneByOne) {
  expect_perturbed_sides_as_one_by_one<2>();
  expect_perturbed_sides_as_one_by_one<3>();
  expect_perturbed_sides_as_one_by_one<6>();
}

TEST(PointPredicates, NoVertexBeyondIsInsideTheFirstSphere) {
  random::Generator generator(5);
  int ties = 0, none = 0;
  for (std::size_t round = 0; round < test::scaled_count(400); ++round) {
    std::vector<double> x;
    for (int i = 0; i < 9 * 2; ++i)
      x.push_back(round % 2 == 0 ? generator.uniform() : static_cast<double>(generator.below(4)));
    const Points<2> points(std::move(x));
    const Index cell[] = {1, 2, 3};
    const auto orientation = [&](Index a, Index b, Index c) {
      const double* const rows[] = {points.predicates->point(a), points.predicates->point(b),
                                    points.predicates->point(c)};
      return kernel::orientation<2>({2, points.predicates->axes()}, rows, points.grid);
    };
    const Sign inner = orientation(1, 2, 3);
    if (inner == Sign::zero) continue;
    const Index candidates[] = {4, 5, 6, 7, 8, 9};
    const int slot = static_cast<int>(round % 3);
    const Index a = cell[(slot + 1) % 3], b = cell[(slot + 2) % 3];
    const auto is_beyond = [&](Index v) { return orientation(v, a, b) == -inner; };
    const auto side = [&](Index apex, Index v) {
      const Index other_cell[] = {apex, orientation(apex, a, b) == Sign::positive ? a : b,
                                  orientation(apex, a, b) == Sign::positive ? b : a};
      return points.predicates->unperturbed_side(other_cell, points.query(v));
    };
    const std::optional<Index> first = points.predicates->first_beyond(cell, slot, candidates, points.grid);
    std::vector<Index> beyond;
    std::copy_if(std::begin(candidates), std::end(candidates), std::back_inserter(beyond), is_beyond);
    if (!first) {
      ++ties;
      EXPECT_TRUE(std::any_of(beyond.begin(), beyond.end(), [&](Index v) {
        return std::any_of(beyond.begin(), beyond.end(),
                           [&](Index w) { return v != w && side(v, w) == Sign::zero; });
      }));
    } else if (*first == index(infinite_vertex)) {
      ++none;
      EXPECT_TRUE(beyond.empty());
    } else {
      EXPECT_TRUE(is_beyond(*first));
      for (const Index v : beyond) {
        if (v != *first) {
          EXPECT_EQ(side(*first, v), Sign::positive);
        }
      }
    }
  }
  EXPECT_GT(ties, 0);
  EXPECT_GT(none, 0);
}

}  // namespace
}  // namespace delone::geometry
