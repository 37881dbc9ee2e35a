// SPDX-License-Identifier: BSD-3-Clause
#include "hull/facet_labels.hpp"

#include "exact_distance.hpp"
#include "hull/hull_state.hpp"
#include "rounded_sets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;

HullState state_of(int d, const std::vector<double>& points) {
  HullState state(d);
  state.insert_range(points, {});
  return state;
}

TEST(FacetLabels, ATurnedCubeHasSix) {
  const test::Shape cube = test::subdivided_box("cube", {1, 1, 1}, 1, false);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HullState state = state_of(3, test::turned(cube, seed));
    const PolytopeFaces faces = label_facets(state.sites(), state.hull(), 1e-14);
    EXPECT_EQ(faces.num_facets(), 6u);
    ASSERT_EQ(faces.seeds.size(), 6u);
    for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ(faces.facet_of_cell[faces.seeds[f]], f);
    EXPECT_EQ(count_ridges(state.hull(), faces), 12u);
    EXPECT_THAT(count_faces(find_facet_sites(state.hull(), faces), 3), ElementsAre(8, 12, 6));
  }
}

// A fan of chords: no facet follows a curve, since all are measured from one seed.
TEST(FacetLabels, DoNotFollowACurve) {
  std::vector<double> circle;
  for (int i = 0; i < 64; ++i) {
    circle.push_back(std::cos(i * 0.098174770424681038));
    circle.push_back(std::sin(i * 0.098174770424681038));
  }
  const HullState state = state_of(2, circle);
  const double sagitta = 1 - std::cos(0.0491);  // of a chord; its ends' neighbors are about 8 times as far
  EXPECT_EQ(label_facets(state.sites(), state.hull(), sagitta).num_facets(), 64u);
  const std::size_t wide = label_facets(state.sites(), state.hull(), 9 * sagitta).num_facets();
  EXPECT_LE(wide, 32u);
  EXPECT_GE(wide, 16u);
}

TEST(FacetLabels, VerticesAreWithinTheToleranceOfTheSeed) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> points;
  for (int i = 0; i < 60; ++i) {
    double x[3], square = 0;
    for (double& c : x) c = normal(random), square += c * c;
    for (const double c : x) points.push_back(c / std::sqrt(square));
  }
  const HullState state = state_of(3, points);
  for (const double tolerance : {1e-3, 0.02, 0.05, 0.2}) {
    const PolytopeFaces faces = label_facets(state.sites(), state.hull(), tolerance);
    const Lists sites = find_facet_sites(state.hull(), faces);
    for (std::size_t f = 0; f < faces.num_facets(); ++f) {
      std::vector<const double*> seed;
      for (const Index site : state.hull().cell(faces.seeds[f])) seed.push_back(state.sites().point(site));
      for (const Index site : sites[f]) {
        const auto square = *test::squared_distance_from_flat(seed, state.sites().point(site), 3, false);
        EXPECT_LE(square, test::Rational(tolerance) * test::Rational(tolerance));
      }
    }
  }
}

TEST(FacetLabels, EndsOfASegmentStayApart) {
  const HullState state = state_of(2, {0, 0, 1, 1});
  EXPECT_THAT(label_facets(state.sites(), state.hull(), 0.5).facet_of_cell, ElementsAre(0, 1));
}

}  // namespace
}  // namespace delone::hull
