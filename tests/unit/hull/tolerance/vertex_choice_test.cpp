// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/vertex_choice.hpp"

#include "hull/hull_analysis.hpp"
#include "kernel/nearest_in_hull.hpp"
#include "rounded_sets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;

struct Example {
  Example(int d, const std::vector<double>& points) : state(d) {
    state.insert_range(points, {});
    const HullAnalysis analysis(state);
    extreme.emplace(state.sites(), analysis.facet_sites());
  }
  VertexChoice choose(double tolerance) const {
    return choose_vertices(state.sites(), *extreme, tolerance, [] {});
  }
  HullState state;
  std::optional<ExtremeSites> extreme;
};

std::vector<double> random_points(int d, std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> points(n * static_cast<std::size_t>(d));
  for (double& x : points) x = normal(random);
  return points;
}

TEST(ExtremeSites, AreInLexicographicOrderAndKnowTheirFacets) {
  const Example square(2, {1, 1, 0, 0, 1, 0, 0, 1, 0.5, 0.5});
  EXPECT_THAT(square.extreme->sites(), ElementsAre(1, 3, 2, 0));
  std::vector<char> marks(4, 0);
  std::vector<Index> list;
  marks[0] = 1;
  square.extreme->add_neighbors(0, marks, list);
  std::sort(list.begin(), list.end());
  EXPECT_THAT(list, ElementsAre(1, 2));
}

bool exceeds(const HullState& state, const std::vector<Index>& kept, Index v, double tolerance) {
  std::vector<const double*> points;
  for (const Index w : kept) points.push_back(state.sites().point(w));
  return kernel::nearest_in_hull_exactly(points, state.sites().point(v), state.sites().ambient)
             .compare(tolerance) == Sign::positive;
}

// By the definition, with the distances from all others instead of neighbors.
TEST(VertexChoice, NecessaryVerticesAreKept) {
  for (int d = 2; d <= 4; ++d)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Example example(d, random_points(d, 40, seed));
      for (const double tolerance : {0.05, 0.3}) {
        const VertexChoice choice = example.choose(tolerance);
        for (const Index v : example.extreme->sites()) {
          std::vector<Index> others = example.extreme->sites();
          std::erase(others, v);
          if (exceeds(example.state, others, v, tolerance)) {
            EXPECT_NE(std::find(choice.sites.begin(), choice.sites.end(), v), choice.sites.end());
          }
        }
      }
    }
}

TEST(VertexChoice, CoversAllAndNoneCanBeLeftOut) {
  for (int d = 2; d <= 4; ++d)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Example example(d, random_points(d, 60, seed));
      for (const double tolerance : {1e-9, 0.1, 0.4}) {
        const VertexChoice choice = example.choose(tolerance);
        EXPECT_LE(choice.max_distance, tolerance);
        const auto covers = [&](const std::vector<Index>& kept, double distance) {
          const auto& all = example.extreme->sites();
          return std::none_of(all.begin(), all.end(),
                              [&](Index v) { return exceeds(example.state, kept, v, distance); });
        };
        EXPECT_TRUE(covers(choice.sites, choice.max_distance));
        for (const Index v : choice.sites) {
          std::vector<Index> fewer = choice.sites;
          std::erase(fewer, v);
          EXPECT_FALSE(covers(fewer, tolerance));
        }
      }
    }
}

TEST(VertexChoice, ATurnedBoxHasEight) {
  const test::Shape box = test::subdivided_box("box", {1, 2, 3}, 6, false);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const VertexChoice choice = Example(3, test::turned(box, seed)).choose(1e-14);
    EXPECT_EQ(choice.sites.size(), 8u);
    EXPECT_GT(choice.max_distance, 0);
  }
}

TEST(VertexChoice, InAFlatOfFewerDimensions) {
  test::Shape sheet = test::subdivided_box("sheet", {2, 3, 0}, 5, false);
  const Example example(3, test::turned(sheet, 4));
  ASSERT_EQ(example.state.affine_hull().dimension(), 3);
  const auto choice = choose_in_flat(example.state.sites(), *example.extreme, 3, 1e-14, [] {});
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->axes.size(), 2u);
  EXPECT_EQ(choice->vertices.sites.size(), 4u);
  EXPECT_FALSE(choose_in_flat(example.state.sites(), *example.extreme, 3, 1e-17, [] {}));
}

TEST(VertexChoice, OfALineAndOfAPoint) {
  std::vector<double> line;
  for (int i = 0; i <= 20; ++i) line.insert(line.end(), {0.1 * i, 0.3 * i, 0.7 * i});
  const Example example(3, line);
  const auto choice = choose_in_flat(example.state.sites(), *example.extreme, 3, 1e-14, [] {});
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->axes, std::vector{2});
  EXPECT_EQ(choice->vertices.sites.size(), 2u);
  const Example cluster(2, {0, 0, 0x1p-40, 0, 0, 0x1p-40});
  const auto point = choose_in_flat(cluster.state.sites(), *cluster.extreme, 2, 0x1p-39, [] {});
  ASSERT_TRUE(point);
  EXPECT_THAT(point->axes, ::testing::IsEmpty());
  EXPECT_EQ(point->vertices.sites.size(), 1u);
}

}  // namespace
}  // namespace delone::hull
