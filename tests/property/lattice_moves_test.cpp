// SPDX-License-Identifier: BSD-3-Clause
// Points of lattices that move off them and back, are removed and inserted again, on the faces of the hull,
// too, where one that moves out sees the whole face: the cells are always those of a construction.
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <random>
#include <span>
#include <vector>

namespace delone {
namespace {

/// side^d points, `unit` apart; in some rounds a few of them one ulp off.
std::vector<double> lattice(int d, int side, double unit, double origin, bool is_nudged,
                            std::mt19937_64& random) {
  std::vector<double> points;
  for (int i = 0; i < static_cast<int>(std::pow(side, d) + 0.5); ++i)
    for (int j = 0, rest = i; j < d; ++j, rest /= side) {
      points.push_back(origin + unit * (rest % side));
      if (is_nudged && random() % 8 == 0) points.back() = std::nextafter(points.back(), 1e300);
    }
  return points;
}

template <class Product>
Product construct(const std::vector<double>& points, int d, const std::vector<double>& weights) {
  if constexpr (requires { Product(points, weights, d); })
    return Product(points, weights, d);
  else
    return Product(points, d);
}

template <class Product>
void expect_moves(int d, int side, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double units[] = {1, 0.1, 0x1p-30, 1e5};
  const double unit = units[seed % 4], origin = seed % 3 == 0 ? 1e7 * unit : 0;
  SCOPED_TRACE(testing::Message() << d << "D, seed " << seed);
  const std::vector<double> start = lattice(d, side, unit, origin, seed % 5 == 4, random);
  const std::vector<double> weights(start.size() / static_cast<std::size_t>(d), 0.5);
  Product moved = construct<Product>(start, d, weights);
  std::vector<double> points = start;
  const std::size_t n = weights.size(), size = static_cast<std::size_t>(d);
  std::vector<std::size_t> off;
  const double steps[] = {0.1, 0.9, 1e-9, 0.5};
  for (int round = 0; round < 40; ++round) {
    const bool goes_back = !off.empty() && random() % 2 == 0;
    const std::size_t row = goes_back ? off[random() % off.size()] : random() % n;
    std::vector<double> to(start.begin() + static_cast<std::ptrdiff_t>(row * size),
                           start.begin() + static_cast<std::ptrdiff_t>((row + 1) * size));
    if (!goes_back) {
      const double step = steps[random() % 4];
      for (double& x : to) x += unit * step * (static_cast<double>(random() % 1000) / 500 - 1);
      off.push_back(row);
    }
    moved.move(row, std::span<const double>(to));
    std::copy(to.begin(), to.end(), points.begin() + static_cast<std::ptrdiff_t>(row * size));
    ASSERT_EQ(moved.hash(), construct<Product>(points, d, weights).hash()) << "round " << round;
  }
  // Without some, many of them beside each other.
  const std::size_t stride = 1 + random() % 3;
  std::vector<double> left;
  std::vector<std::size_t> gone;
  for (std::size_t row = 0; row < n; ++row) {
    if (row % stride == 0 && gone.size() < 40) {
      moved.remove(row);
      gone.push_back(row);
    } else {
      const auto first = points.begin() + static_cast<std::ptrdiff_t>(row * size);
      left.insert(left.end(), first, first + d);
    }
  }
  const std::vector<double> weights_left(left.size() / size, 0.5);
  EXPECT_EQ(moved.hash(), construct<Product>(left, d, weights_left).hash());
}

TEST(LatticeMoves, LeadToTheCellsOfAConstruction) {
  const int sides[] = {0, 0, 9, 5, 4, 3};
  for (int d = 2; d <= 5; ++d)
    for (std::uint64_t seed = 0; seed < test::scaled_count(d < 4 ? 10 : d == 4 ? 3 : 1); ++seed) {
      ASSERT_NO_FATAL_FAILURE(expect_moves<Delaunay<>>(d, sides[d], seed));
      if (d < 5 && seed % 3 == 0) {
        ASSERT_NO_FATAL_FAILURE(expect_moves<Regular<>>(d, sides[d], seed));
      }
    }
}

/// Batches, moves and removals in turn, of few points of a small lattice, some of them off it.
void expect_edits(int d, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  SCOPED_TRACE(testing::Message() << d << "D, seed " << seed);
  const auto size = static_cast<std::size_t>(d);
  const auto point = [&] {
    std::vector<double> x(size);
    for (double& entry : x) entry = static_cast<double>(random() % 8);
    if (random() % 4 == 0) x[random() % size] += 1e-12 * static_cast<double>(random() % 3);
    return x;
  };
  std::map<std::size_t, std::vector<double>> points;  // by row
  std::size_t num_rows = 0;
  const auto batch = [&](std::size_t count) {
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<double>& x = points[num_rows++] = point();
      rows.insert(rows.end(), x.begin(), x.end());
    }
    return rows;
  };
  Delaunay<> edited(batch(size + 3), d);
  for (int step = 0; step < 30; ++step) {
    const auto kind = points.empty() ? 0 : random() % 4;
    if (kind == 0) {
      edited.insert_range(batch(1 + random() % 4));
    } else {
      const auto at = std::next(points.begin(), static_cast<std::ptrdiff_t>(random() % points.size()));
      if (kind == 1) {
        edited.remove(at->first);
        points.erase(at);
      } else {
        std::vector<double> to = at->second;
        if (kind == 2) to[random() % size] += 1e-9;
        else to = point();
        edited.move(at->first, std::span<const double>(to));
        at->second = to;
      }
    }
    std::vector<double> left;
    for (const auto& [row, x] : points) left.insert(left.end(), x.begin(), x.end());
    ASSERT_EQ(edited.hash(), Delaunay<>(left, d).hash()) << "step " << step;
  }
}

TEST(LatticeMoves, MayComeAfterBatches) {
  for (int d = 2; d <= 4; ++d)
    for (std::uint64_t seed = 0; seed < test::scaled_count(60); ++seed)
      ASSERT_NO_FATAL_FAILURE(expect_edits(d, seed));
}

TEST(LatticeMoves, OfAPeakOnAFaceLeaveTheFace) {
  for (int d = 2; d <= 4; ++d) {
    std::mt19937_64 random(1);
    const int side = d == 2 ? 60 : d == 3 ? 16 : 7;
    const std::vector<double> start = lattice(d, side, 1, 0, false, random);
    Delaunay<> moved(start, d);
    const auto hash = moved.hash();
    const std::size_t size = static_cast<std::size_t>(d);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row * size < start.size(); ++row)
      if (start[row * size] == 0 && random() % static_cast<std::uint64_t>(side) == 0) rows.push_back(row);
    rows.push_back(0);  // a corner
    const auto move_by = [&](std::size_t row, double step) {
      std::vector<double> to(&start[row * size], &start[row * size] + size);
      to[0] -= step;
      moved.move(row, std::span<const double>(to));
    };
    for (std::size_t i = 0; i < rows.size(); ++i) move_by(rows[i], 0.01 + 0.001 * static_cast<double>(i));
    EXPECT_NE(moved.hash(), hash);
    for (const std::size_t row : rows) move_by(row, 0);
    EXPECT_EQ(moved.hash(), hash) << d;
  }
}

}  // namespace
}  // namespace delone
