// SPDX-License-Identifier: BSD-3-Clause
// Diagrams of furthest sites: against the definition, clipped, checked, copied, with a tolerance.
#include "degenerate.hpp"

#include <delone/check.hpp>
#include <delone/error.hpp>
#include <delone/point_sets.hpp>
#include <delone/voronoi.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace delone::voronoi {
namespace {

using ::testing::HasSubstr;

double squared_distance(const double* a, const double* b, std::size_t d) {
  double sum = 0;
  for (std::size_t j = 0; j < d; ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

/// The rows that are furthest from x, but for rounding.
std::vector<SignedIndex> furthest_from(const std::vector<double>& points, const double* x, std::size_t d) {
  double largest = 0;
  for (std::size_t row = 0; row * d < points.size(); ++row)
    largest = std::max(largest, squared_distance(points.data() + row * d, x, d));
  std::vector<SignedIndex> rows;
  for (std::size_t row = 0; row * d < points.size(); ++row)
    if (squared_distance(points.data() + row * d, x, d) >= largest * (1 - 1e-9))
      rows.push_back(static_cast<SignedIndex>(row));
  return rows;
}

void expect_definition(const std::vector<double>& points, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  const FurthestSite<> t(points, dimension);
  const FurthestVoronoi<> v(t);
  EXPECT_EQ(v.kind(), DataKind::furthest_voronoi);
  EXPECT_EQ(v.num_regions(), t.num_vertices());
  EXPECT_EQ(v.num_unbounded_regions(), v.num_regions());
  for (std::size_t r = 0; r < v.num_regions(); ++r)
    for (const SignedIndex vertex : v.region(r)) {
      if (vertex < 0) continue;
      const auto rows = furthest_from(points, v.vertex(static_cast<std::size_t>(vertex)).data(), d);
      EXPECT_THAT(rows, ::testing::Contains(v.region_points()[r])) << "vertex " << vertex;
    }
  std::vector<double> at(d);
  const auto k = static_cast<std::size_t>(std::max(v.affine_dimension(), 0));
  for (std::size_t ray = 0; ray < v.num_rays(); ++ray) {
    const auto start = static_cast<std::size_t>(v.ray_vertices()[ray]);
    for (std::size_t j = 0; j < d; ++j) at[j] = v.vertex(start)[j] + v.ray_directions()[ray * d + j];
    const auto rows = furthest_from(points, at.data(), d);
    for (std::size_t i = 0; i < k; ++i)
      EXPECT_THAT(rows, ::testing::Contains(v.ray_points()[ray * k + i])) << "ray " << ray;
  }
  const CheckReport report = check(v.to_data());
  EXPECT_TRUE(report.ok) << report.violation;
}

TEST(FurthestVoronoi, IsThatOfTheFurthestSites) {
  for (const int d : {1, 2, 3, 4}) {
    expect_definition(make_point_set("uniform", d, 60, 3), d);
    expect_definition(test::small_integers(d, 60, -4, 4, 1).points, d);
  }
  expect_definition({}, 2);
  expect_definition({1, 2}, 2);
  expect_definition({1, 2, 1, 2, 3, 3}, 2);
  expect_definition(test::embedded(test::small_integers(2, 40, -4, 4, 5), 4, true, 2).points, 4);
}

TEST(FurthestVoronoi, CyclesAreInOrder) {
  const FurthestVoronoi<> v(FurthestSite<>(make_point_set("sphere", 2, 40, 1), 2));
  for (std::size_t r = 0; r < v.num_regions(); ++r) {  // counterclockwise: the chain of vertices turns left
    const auto region = v.region(r);
    for (std::size_t i = 1; i + 2 < region.size(); ++i) {
      const auto a = v.vertex(static_cast<std::size_t>(region[i])),
                 b = v.vertex(static_cast<std::size_t>(region[i + 1])),
                 c = v.vertex(static_cast<std::size_t>(region[i + 2]));
      EXPECT_GT((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]), 0) << r;
    }
  }
}

TEST(FurthestVoronoi, RegionsFillABox) {
  for (const int d : {1, 2, 3, 4, 5}) {
    for (const bool degenerate : {false, true}) {
      const std::vector<double> points =
          degenerate ? test::small_integers(d, 40, -2, 2, 1).points : make_point_set("uniform", d, 40, 2);
      const FurthestVoronoi<> v(FurthestSite<>(points, d));
      const Box box = v.bounding_box();
      double volume = 1;
      for (std::size_t j = 0; j < box.low.size(); ++j) volume *= box.high[j] - box.low[j];
      const std::vector<double> volumes = v.region_volumes(box);
      EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), volume, 1e-11 * volume) << d;
      EXPECT_EQ(volumes, v.region_volumes(box, {.threads = 3}));
    }
  }
}

TEST(FurthestVoronoi, ClippedRegionsAreFurthest) {
  for (const int d : {1, 2, 3}) {
    const std::vector<double> points = make_point_set("uniform", d, 40, 2);
    const FurthestVoronoi<> v(FurthestSite<>(points, d));
    const auto width = static_cast<std::size_t>(d);
    v.for_each_clipped_region(v.bounding_box(), [&](std::size_t r, const ClippedRegion& region) {
      if (region.empty()) return;
      std::vector<double> middle(width, 0.0);
      const std::size_t corners = region.corners.size() / width;
      for (std::size_t i = 0; i < region.corners.size(); ++i)
        middle[i % width] += region.corners[i] / static_cast<double>(corners);
      EXPECT_THAT(furthest_from(points, middle.data(), width), ::testing::Contains(v.region_points()[r]));
    });
  }
}

TEST(FurthestVoronoi, CopiesAndTolerances) {
  const FurthestSite<2> t(make_point_set("sphere", 2, 60, 1));
  const FurthestVoronoi<2> v(t), copy = v.clone();
  EXPECT_EQ(copy.kind(), DataKind::furthest_voronoi);
  EXPECT_TRUE(std::ranges::equal(copy.vertices(), v.vertices()));
  const FurthestVoronoi coarse(t, {.tolerance = 1e-3});
  EXPECT_LE(coarse.num_vertices(), v.num_vertices());
  const CheckReport report = check(coarse.to_data());
  EXPECT_TRUE(report.ok) << report.violation;
}

TEST(FurthestVoronoi, FaultsAreFound) {
  const VoronoiData good =
      FurthestVoronoi<>(FurthestSite<>(make_point_set("uniform", 2, 30, 1), 2)).to_data();
  const auto violation = [&](auto damage) {
    VoronoiData data = good;
    damage(data);
    const CheckReport report = check(data);
    EXPECT_FALSE(report.ok);
    return report.violation;
  };
  EXPECT_THAT(violation([](VoronoiData& data) { data.kind = DataKind::voronoi; }),
              HasSubstr("there are 30 regions, not"));
  EXPECT_THAT(violation([](VoronoiData& data) { data.kind = DataKind::delaunay; }),
              HasSubstr("other arrays"));
  EXPECT_THAT(violation([](VoronoiData& data) { data.weights.assign(30, 1); }), HasSubstr("has no weights"));
  EXPECT_THAT(violation([](VoronoiData& data) {
                for (double& x : data.ray_directions) x = -x;
              }),
              HasSubstr("not the inward direction"));
  EXPECT_THAT(violation([](VoronoiData& data) { data.vertices[0] += 1; }), HasSubstr("nearest"));
  EXPECT_THAT(violation([](VoronoiData& data) {
                for (SignedIndex& v : data.region_vertices)
                  if (v >= 0 && v < 2) v = 1 - v;
              }),
              HasSubstr(""));
  VoronoiData nearest = Voronoi<>(Delaunay<>(make_point_set("uniform", 2, 30, 1), 2)).to_data();
  nearest.kind = DataKind::furthest_voronoi;
  EXPECT_FALSE(check(nearest).ok);
  nearest.kind = DataKind::power_diagram;
  EXPECT_THAT(check(nearest).violation, HasSubstr("has weights"));
}

}  // namespace
}  // namespace delone::voronoi
