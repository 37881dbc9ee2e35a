// SPDX-License-Identifier: BSD-3-Clause
// Changes of neighbors against complete lists of before and after.
#include "periodic_sets.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/neighbor_changes.hpp>
#include <delone/periodic.hpp>
#include <delone/periodic_faces.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace delone {
namespace {

using Pair = std::vector<std::int64_t>;
using Pairs = std::set<Pair>;

Pairs difference(const Pairs& a, const Pairs& b) {
  Pairs rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(rest, rest.end()));
  return rest;
}

Pairs listed_pairs(const std::vector<SignedIndex>& rows, const std::vector<std::int32_t>& offsets, int rank) {
  const auto r = static_cast<std::size_t>(rank);
  Pairs pairs;
  for (std::size_t i = 0; 2 * i < rows.size(); ++i) {
    Pair pair{rows[2 * i], rows[2 * i + 1]};
    for (std::size_t l = 0; l < r; ++l) pair.push_back(offsets[i * r + l]);
    pairs.insert(pair);
  }
  EXPECT_EQ(2 * pairs.size(), rows.size());
  return pairs;
}

// ---- Open sets --------------------------------------------------------------------------------------------

Pairs all_pairs(const Triangulation& t) {
  Pairs pairs;
  if (t.affine_dimension() < 1) return pairs;
  const std::vector<VertexId> edges = t.complex().edges();
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const auto a = static_cast<std::int64_t>(t.row_of(edges[i])),
               b = static_cast<std::int64_t>(t.row_of(edges[i + 1]));
    pairs.insert({std::min(a, b), std::max(a, b)});
  }
  return pairs;
}

void expect_changes(const Triangulation& before, const Triangulation& after) {
  const NeighborChanges changes = changed_neighbors(before, after);
  const Pairs first = all_pairs(before), then = all_pairs(after);
  EXPECT_EQ(changes.rank, 0);
  EXPECT_EQ(listed_pairs(changes.began, {}, 0), difference(then, first));
  EXPECT_EQ(listed_pairs(changes.ended, {}, 0), difference(first, then));
}

TEST(ChangedNeighbors, OfStepsAndEdits) {
  for (int d = 1; d <= 5; ++d)
    for (const double length : {0.0, 1e-4, 0.2}) {
      SCOPED_TRACE(testing::Message() << "dimension " << d << ", steps of " << length);
      const auto width = static_cast<std::size_t>(d);
      const std::size_t n = d < 4 ? 300 : 80;
      std::vector<double> points = test::random_fractions(n * width, 5);
      if (length == 0.2)
        for (double& x : points) x = std::nearbyint(4 * x) / 4;  // duplicates and ties
      Delaunay<> t(PointsView(points, d), d);
      std::vector<std::size_t> rows(n);
      std::iota(rows.begin(), rows.end(), std::size_t{0});
      std::mt19937_64 random(3);
      std::uniform_real_distribution<double> step(-length, length);
      for (int i = 0; i < 3; ++i) {
        Delaunay<> before = t.clone();
        for (double& x : points) x += step(random);
        t.move(rows, PointsView(points, d));
        expect_changes(before, t);
        before = t.clone();
        const std::vector<std::size_t> some{1, 7, 20 + static_cast<std::size_t>(i)};
        const std::vector<double> new_points = test::random_fractions(2 * width, 9);
        t.edit({.remove = std::span(some).subspan(2),
                .move = std::span(some).first(1),
                .to = PointsView(std::span(new_points).first(width), d),
                .insert = PointsView(new_points, d)});
        expect_changes(before, t);
        std::erase(rows, some[2]);
        points.clear();
        rows.clear();
        for (std::size_t row = 0; row < t.num_rows(); ++row)
          if (t.has_row(row)) {
            rows.push_back(row);
            const auto x = t.point(t.vertex_at(row));
            points.insert(points.end(), x.begin(), x.end());
          }
      }
    }
}

TEST(ChangedNeighbors, OfHiddenPoints) {
  std::vector<double> points = test::random_fractions(900, 5), weights = test::random_fractions(300, 6);
  for (double& w : weights) w *= 0.02;
  Regular<3> t(PointsView(points, 3), weights);
  std::vector<std::size_t> rows(300);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  for (int step = 0; step < 4; ++step) {
    const Regular<3> before = t.clone();
    weights[17] += step % 2 == 0 ? 0.25 : -0.25;
    t.set_weights(rows, weights);
    expect_changes(before, t);
    EXPECT_NE(before.hidden_rows(), t.hidden_rows());
  }
}

TEST(ChangedNeighbors, WhereTheDimensionChanges) {
  Delaunay<3> t(std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1.5, 0}});
  const Delaunay<3> before = t.clone();
  t.move(3, std::array{0.25, 0.25, 1.0});
  expect_changes(before, t);
  expect_changes(t, before);
  expect_changes(Delaunay<3>(), t);
}

// ---- Periodic sets ----------------------------------------------------------------------------------------

Pair ordered(Pair pair) {
  const auto first = std::find_if(pair.begin() + 2, pair.end(), [](std::int64_t k) { return k != 0; });
  if (pair[0] == pair[1] ? first == pair.end() || *first > 0 : pair[0] < pair[1]) return pair;
  std::swap(pair[0], pair[1]);
  for (std::size_t l = 2; l < pair.size(); ++l) pair[l] = -pair[l];
  return pair;
}

/// Offsets as if the second points were given `periods` lattice vectors further back.
Pairs all_pairs(const PeriodicTriangulation& t, const std::vector<std::int64_t>& periods = {}) {
  Pairs pairs;
  if (t.affine_dimension() < 1) return pairs;
  const PeriodicFaces edges = faces(t, 1);
  const auto r = static_cast<std::size_t>(t.rank());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto a = static_cast<std::size_t>(edges.vertices[2 * i]),
               b = static_cast<std::size_t>(edges.vertices[2 * i + 1]);
    Pair pair{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)};
    for (std::size_t l = 0; l < r; ++l)
      pair.push_back(edges.offsets[(2 * i + 1) * r + l] - edges.offsets[2 * i * r + l] +
                     (periods.empty() ? 0 : periods[b * r + l] - periods[a * r + l]));
    pairs.insert(ordered(pair));
  }
  return pairs;
}

Pairs moved_back(const Pairs& pairs, const std::vector<std::int64_t>& periods, std::size_t r) {
  Pairs result;
  for (Pair pair : pairs) {
    for (std::size_t l = 0; l < r; ++l)
      pair[2 + l] += periods[static_cast<std::size_t>(pair[1]) * r + l] -
                     periods[static_cast<std::size_t>(pair[0]) * r + l];
    result.insert(pair);
  }
  return result;
}

/// `periods`: by how many lattice vectors the points have jumped, which changes no neighbors.
void expect_changes(const PeriodicTriangulation& before, const PeriodicTriangulation& after,
                    const std::vector<std::int64_t>& periods) {
  const NeighborChanges changes = changed_neighbors(before, after);
  const auto r = static_cast<std::size_t>(before.rank());
  const Pairs first = all_pairs(before), then = all_pairs(after, periods);
  EXPECT_EQ(changes.rank, before.rank());
  EXPECT_EQ(moved_back(listed_pairs(changes.began, changes.began_offsets, changes.rank), periods, r),
            difference(then, first));
  EXPECT_EQ(listed_pairs(changes.ended, changes.ended_offsets, changes.rank), difference(first, then));
}

TEST(ChangedNeighbors, OfPeriodicSteps) {
  for (const auto& [name, box] : test::lattices_in_space())
    for (const auto& [set_name, fractions] : test::sets_in_space(test::scaled_count(260)))
      for (const int rank : {3, 2, 1, 0})
        for (const double length : {0.0, 1e-4, 1e-2}) {
          SCOPED_TRACE(std::string(name) + ", " + set_name + ", rank " + std::to_string(rank) +
                       ", steps of " + std::to_string(length));
          const Lattice lattice = test::of_rank(box, rank);
          std::vector<double> points = test::at_fractions(fractions, box);
          const auto r = static_cast<std::size_t>(rank);
          std::mt19937_64 random(1);
          std::uniform_real_distribution<double> step(-length, length);
          PeriodicDelaunay<> t(PointsView(points, 3), lattice);
          for (int i = 0; i < 3; ++i) {
            std::vector<std::int64_t> periods(points.size() / 3 * r, 0);
            for (std::size_t row = 0; row < points.size() / 3; ++row) {
              for (std::size_t j = 0; j < 3; ++j)
                points[3 * row + j] = test::coarse(points[3 * row + j] + step(random));
              if (r == 0 || random() % 8 != 0) continue;
              const std::size_t l = random() % r;
              periods[row * r + l] = static_cast<std::int64_t>(random() % 3) - 1;
              for (std::size_t j = 0; j < 3; ++j)
                points[3 * row + j] += static_cast<double>(periods[row * r + l]) * lattice.vectors[3 * l + j];
            }
            PeriodicDelaunay<> next = t.moved(PointsView(points, 3));
            expect_changes(t, next, periods);
            // Of a new object it is the same.
            expect_changes(t, PeriodicDelaunay<>(PointsView(points, 3), lattice), periods);
            if (HasFailure()) return;
            t = std::move(next);
          }
        }
}

TEST(ChangedNeighbors, OfPeriodicDuplicatesAndWeights) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  std::vector<double> points = test::random_fractions(900, 12), weights = test::random_fractions(300, 6);
  for (double& x : points) x = test::coarse(x);
  for (double& w : weights) w *= 0.01;
  for (std::size_t i = 0; i < 9; ++i) points[100 + i] = points[500 + i] = points[800 + i];
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> step(-1e-4, 1e-4);
  PeriodicDelaunay<> t(PointsView(points, 3), box);
  PeriodicRegular<> power(PointsView(points, 3), weights, box);
  const std::vector<std::int64_t> none(900, 0);
  for (int i = 0; i < 5; ++i) {
    for (double& x : points) x = test::coarse(x + step(random));
    if (i % 2 == 1)
      for (std::size_t j = 0; j < 9; ++j) points[100 + j] = points[800 + j];
    for (std::size_t row = 0; row < 300; row += 9) weights[row] *= 1.02;
    PeriodicDelaunay<> next = t.moved(PointsView(points, 3));
    expect_changes(t, next, none);
    t = std::move(next);
    PeriodicRegular<> next_power = power.moved(PointsView(points, 3), weights);
    expect_changes(power, next_power, none);
    power = std::move(next_power);
  }
}

}  // namespace
}  // namespace delone
