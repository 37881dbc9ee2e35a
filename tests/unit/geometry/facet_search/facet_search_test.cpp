// SPDX-License-Identifier: BSD-3-Clause
// The search beyond facets against a scan of all vertices; it ends whatever cell it starts from.
#include "geometry/facet_search/facet_search.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace delone::geometry {

using cells::ComparisonLimit;
using cells::OpenCell;

namespace {

/// Rows of points: themselves, and the sums of their squares.
std::vector<double> rows_of(int k, const std::vector<double>& points) {
  std::vector<double> rows(static_cast<std::size_t>(k) + 1);
  for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(k)) {
    double square = 0;
    for (std::size_t j = i; j < i + static_cast<std::size_t>(k); ++j) {
      rows.push_back(points[j]);
      square += points[j] * points[j];
    }
    rows.push_back(square);
  }
  return rows;
}

std::vector<double> random_points(int k, Index n, random::Generator& generator) {
  std::vector<double> points(static_cast<std::size_t>(k) * n);
  for (double& c : points) c = 2 * generator.uniform() - 1;
  return points;
}

/// Decides nothing.
std::optional<Index> undecided(const Index*, int, std::span<const Index>) { return std::nullopt; }

/// Whether no vertex is inside the sphere of a cell, or nearly; from its functional by elimination.
bool is_empty(int k, const std::vector<double>& rows, Index n, const std::vector<Index>& cell) {
  const auto d = static_cast<std::size_t>(k), width = d + 1;
  std::vector<std::vector<double>> a;  // (X, 1)·(coefficients, constant) = −lift
  for (const Index v : cell) {
    a.emplace_back(rows.begin() + static_cast<std::ptrdiff_t>(v * width),
                   rows.begin() + static_cast<std::ptrdiff_t>(v * width + d));
    a.back().push_back(1);
    a.back().push_back(-rows[v * width + d]);
  }
  for (std::size_t p = 0; p < width; ++p) {
    std::size_t pivot = p;
    for (std::size_t i = p; i < width; ++i)
      if (std::fabs(a[i][p]) > std::fabs(a[pivot][p])) pivot = i;
    std::swap(a[p], a[pivot]);
    for (std::size_t i = 0; i < width; ++i) {
      if (i == p) continue;
      const double times = a[i][p] / a[p][p];
      for (std::size_t j = p; j <= width; ++j) a[i][j] -= times * a[p][j];
    }
  }
  for (Index v = 1; v <= n; ++v) {
    double height = rows[v * width + d] + a[d][width] / a[d][d], magnitude = 1;
    for (std::size_t r = 0; r < d; ++r) {
      height += a[r][width] / a[r][r] * rows[v * width + r];
      magnitude += std::fabs(a[r][width] / a[r][r]);
    }
    if (height < -1e-9 * magnitude) return false;
  }
  return true;
}

TEST(FacetSearch, FindsCellsWithEmptySpheres) {
  for (int k = 2; k <= 9; ++k)
    for (const Index n :
         {static_cast<Index>(k + 1), static_cast<Index>(k + 2), Index{33}, Index{300}, Index{2500}}) {
      if (n > 1000 && k % 5 != 2) continue;  // more than are looked at at once
      SCOPED_TRACE(testing::Message() << n << " points in dimension " << k);
      random::Generator generator(n);
      const std::vector<double> rows = rows_of(k, random_points(k, n, generator));
      ComparisonLimit unlimited;
      FacetSearch search(k, rows.data(), n, undecided);
      const auto width = static_cast<std::size_t>(k) + 1;
      std::vector<std::vector<Index>> cells(1, std::vector<Index>(width));
      ASSERT_TRUE(search.first_cell(cells[0].data()));
      EXPECT_TRUE(is_empty(k, rows, n, cells[0]));
      std::size_t beyond_the_hull = 0;
      for (std::size_t round = 0; round < test::scaled_count(30); ++round) {
        // As many of the last cells as are treated at once, or fewer.
        const std::size_t count = std::min(1 + round % FacetSearch::batch_size, cells.size());
        const std::vector<std::vector<Index>> batch(cells.end() - static_cast<std::ptrdiff_t>(count),
                                                    cells.end());
        std::vector<OpenCell> open;
        for (const auto& cell : batch)
          open.push_back({cell.data(), static_cast<std::uint32_t>(1 + generator.below((1u << width) - 1))});
        std::vector<Index> apexes(count * width, invalid_index);
        ASSERT_TRUE(search.find_apexes(open, apexes.data(), unlimited));
        for (std::size_t i = 0; i < count * width; ++i) {
          if ((open[i / width].open_slots >> i % width & 1) == 0) {
            EXPECT_EQ(apexes[i], invalid_index);
            continue;
          }
          std::vector<Index> cell = batch[i / width];
          EXPECT_EQ(std::find(cell.begin(), cell.end(), apexes[i]), cell.end());
          cell[i % width] = apexes[i];
          if (apexes[i] == index(infinite_vertex)) {
            ++beyond_the_hull;
          } else {
            ASSERT_TRUE(is_empty(k, rows, n, cell));
            cells.push_back(cell);
          }
        }
      }
      EXPECT_TRUE(n > static_cast<Index>(k) + 1 ? cells.size() > 1 : beyond_the_hull > 0);
    }
}

// 4 and 5 are on the circle of 1, 2 and 3, or too near to it to tell.
TEST(FacetSearch, LeavesWhatIsCloseToTheArbiter) {
  for (const double distance : {0.0, 1e-17, -1e-16}) {
    const std::vector<double> rows =
        rows_of(2, {0.6, 0.8, -0.6, 0.8, 0, 1, 0.8 + distance, -0.6, -0.8, -0.6});
    const Index cell[] = {1, 2, 3};
    Index apexes[3];
    const OpenCell open{cell, 1 << 2};
    std::optional<Index> verdict;
    const auto arbiter = [&](const Index* asked, int slot, std::span<const Index> vertices) {
      EXPECT_EQ(asked, cell);
      EXPECT_EQ(slot, 2);
      EXPECT_EQ(std::vector<Index>(vertices.begin(), vertices.end()), (std::vector<Index>{4, 5}));
      return verdict;
    };
    ComparisonLimit unlimited;
    FacetSearch search(2, rows.data(), 5, arbiter);
    EXPECT_FALSE(search.find_apexes({&open, 1}, apexes, unlimited));
    verdict = 5;
    EXPECT_TRUE(search.find_apexes({&open, 1}, apexes, unlimited));
    EXPECT_EQ(apexes[2], 5u);
  }
}

TEST(FacetSearch, LeavesAllThatAreCloseToTheArbiter) {
  for (const std::size_t count : {3, 7, 40}) {
    std::vector<double> points{0.6, 0.8, -0.6, 0.8, 0, 1};
    std::vector<Index> close;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = -3.14159265358979 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      points.insert(points.end(),
                    {std::cos(angle), std::sin(angle), 3 * std::cos(angle), 2 * std::sin(angle)});
      close.push_back(static_cast<Index>(4 + 2 * i));
    }
    const auto n = static_cast<Index>(3 + 2 * count);
    const std::vector<double> rows = rows_of(2, points);
    std::vector<Index> asked;
    const auto arbiter = [&](const Index*, int, std::span<const Index> vertices) {
      asked.assign(vertices.begin(), vertices.end());
      return std::optional<Index>(close.back());
    };
    ComparisonLimit unlimited;
    FacetSearch search(2, rows.data(), n, arbiter);
    const Index cell[] = {1, 2, 3};
    Index apexes[3];
    const OpenCell open{cell, 1 << 2};
    ASSERT_TRUE(search.find_apexes({&open, 1}, apexes, unlimited));
    EXPECT_EQ(apexes[2], close.back());
    EXPECT_EQ(asked, close);
    EXPECT_EQ(unlimited.count(), count);

    ComparisonLimit limit;
    for (const bool is_enough : {false, true}) {
      limit.reset(2 * count - !is_enough);
      EXPECT_TRUE(search.find_apexes({&open, 1}, apexes, limit));
      asked.clear();
      EXPECT_EQ(search.find_apexes({&open, 1}, apexes, limit), is_enough);
      EXPECT_EQ(asked.empty(), !is_enough);
    }
  }
}

// On circles of which each is a little smaller than the one before; binary32 lists them all.
TEST(FacetSearch, FindsTheFirstOfManyThatAreClose) {
  for (const std::size_t count : {3, 7, 40}) {
    std::vector<double> points{0.6, 0.8, -0.6, 0.8, 0, 1};
    for (std::size_t i = 0; i < count; ++i) {
      const double center = -1 - 1e-4 * static_cast<double>(count - i),
                   radius = std::hypot(0.6, 0.8 - center);
      const double angle = -3.14159265358979 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      points.insert(points.end(), {radius * std::cos(angle), center + radius * std::sin(angle)});
    }
    const auto n = static_cast<Index>(3 + count);
    const std::vector<double> rows = rows_of(2, points);
    ComparisonLimit unlimited;
    FacetSearch search(2, rows.data(), n, undecided);
    const Index cell[] = {1, 2, 3};
    Index apexes[3];
    const OpenCell open{cell, 1 << 2};
    ASSERT_TRUE(search.find_apexes({&open, 1}, apexes, unlimited));
    EXPECT_EQ(apexes[2], n);
  }
}

// A vertex may be inside the sphere of a cell, by much or by little, if an earlier one was found wrongly.
TEST(FacetSearch, EndsAtCellsThatAreNotDelaunay) {
  for (double distance = 0.25; distance > 1e-18; distance /= 2) {
    SCOPED_TRACE(distance);
    const std::vector<double> rows = rows_of(2, {0.1, 0.1, 0.9, 0.1, 0.1, 0.9, 0.9 - distance, 0.9});
    ComparisonLimit unlimited;
    FacetSearch search(2, rows.data(), 4, undecided);
    const Index cell[] = {1, 2, 3};
    Index apexes[3] = {invalid_index, invalid_index, invalid_index};
    const OpenCell open{cell, 7};
    if (search.find_apexes({&open, 1}, apexes, unlimited)) {
      EXPECT_EQ(apexes[0], 4u);
    }
  }
}

}  // namespace
}  // namespace delone::geometry
