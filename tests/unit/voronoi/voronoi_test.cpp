// SPDX-License-Identifier: BSD-3-Clause
// Boxes and volumes of diagrams: what is refused, boxes of one point and of the whole range, and volumes of
// diagrams of few sites, in flats and in many dimensions.
#include <delone/voronoi.hpp>

#include "error_code.hpp"

#include <delone/point_sets.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace delone::voronoi {
namespace {

using test::code_of;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using Sites = std::vector<double>;

constexpr double inf = std::numeric_limits<double>::infinity();

double sum_of(const std::vector<double>& volumes) {
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

TEST(Diagram, BoxesAreFiniteAndOfTheSpace) {
  const Voronoi<> diagram(Delaunay<>(Sites{0, 0, 1, 0, 0, 1}, 2));
  const auto code = [&](const Box& box) {
    const Errc of_volumes = code_of([&] { diagram.region_volumes(box); });
    EXPECT_EQ(code_of([&] { diagram.for_each_clipped_region(box, [](auto, const auto&) {}); }), of_volumes);
    return of_volumes;
  };
  EXPECT_EQ(code({{0}, {1}}), Errc::invalid_argument);
  EXPECT_EQ(code({{0, 0}, {1, 1, 1}}), Errc::invalid_argument);
  EXPECT_EQ(code({{0, 0}, {1, inf}}), Errc::invalid_argument);
  EXPECT_EQ(code({{0, std::nan("")}, {1, 1}}), Errc::invalid_argument);
  EXPECT_EQ(code({{0, 1}, {1, 1}}), Errc::invalid_argument) << "low is below high";
  const Voronoi<> wide(Delaunay<>(make_point_set("uniform", 13, 3, 1), 13));
  EXPECT_EQ(code_of([&] { wide.region_volumes(Box{Sites(13, 0.0), Sites(13, 1.0)}); }), Errc::unsupported);
  const Voronoi<> space(Delaunay<>(make_point_set("uniform", 4, 9, 1), 4));
  EXPECT_EQ(code_of([&] {
              space.for_each_clipped_region({Sites(4, 0.0), Sites(4, 1.0)}, [](auto, const auto&) {});
            }),
            Errc::unsupported);
  EXPECT_NEAR(sum_of(space.region_volumes({Sites(4, 0.0), Sites(4, 1.0)})), 1, 1e-12);
}

TEST(Diagram, WithoutRidgesHasNoVolumes) {
  const Voronoi<> diagram(Delaunay<>(make_point_set("uniform", 2, 20, 1), 2),
                          {.parts = DiagramParts::regions});
  EXPECT_EQ(code_of([&] { diagram.ridge_volumes(); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { diagram.region_volumes(); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { diagram.region_volumes(diagram.bounding_box()); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { diagram.to_data(); }), Errc::invalid_argument);
  EXPECT_EQ(diagram.num_ridges(), 0u);
  EXPECT_EQ(diagram.num_regions(), 20u);
}

TEST(Diagram, BoundingBoxesContainAllSites) {
  const Voronoi<> square(Delaunay<>(Sites{0, 0, 4, 0, 0, 2}, 2));
  EXPECT_THAT(square.bounding_box(0.25).low, ElementsAre(-1, -1));
  EXPECT_THAT(square.bounding_box(0.25).high, ElementsAre(5, 3));
  const Box tight = square.bounding_box(0);
  EXPECT_THAT(tight.low, ElementsAre(-0x1p-1074, -0x1p-1074)) << "by the next double";
  EXPECT_EQ(tight.high[0], std::nextafter(4.0, 5.0));
  for (const double wrong : {-0.1, inf, std::nan("")})
    EXPECT_EQ(code_of([&] { square.bounding_box(wrong); }), Errc::invalid_argument) << wrong;
  const Voronoi<> one(Delaunay<>(Sites{7, 8}, 2));
  EXPECT_THAT(one.bounding_box().low, ElementsAre(6, 7));
  EXPECT_THAT(one.bounding_box().high, ElementsAre(8, 9));
  const Voronoi<> none{Delaunay<>(2)};
  EXPECT_THAT(none.bounding_box().high, ElementsAre(1, 1));
  constexpr double largest = std::numeric_limits<double>::max();
  const Box all = Voronoi<>(Delaunay<>(Sites{-largest, 0, largest, 0}, 2)).bounding_box(1);
  EXPECT_THAT(all.low, ElementsAre(-largest, -largest));
  EXPECT_THAT(all.high, ElementsAre(largest, largest));
}

TEST(Diagram, VolumesOfFewSites) {
  const Voronoi<> line(Delaunay<>(Sites{0, 2, 6}, 1));
  EXPECT_THAT(line.ridge_volumes(), ElementsAre(1, 1));
  EXPECT_THAT(line.region_volumes(), ElementsAre(inf, 3, inf));
  EXPECT_THAT(line.region_volumes({{-2}, {5}}), ElementsAre(3, 3, 1));
  const Voronoi<> one(Delaunay<>(Sites{7, 8}, 2));
  EXPECT_THAT(one.region_volumes(), ElementsAre(inf));
  EXPECT_THAT(one.region_volumes({{0, 0}, {2, 3}}), ElementsAre(6)) << "all of the box, wherever the site is";
  const Voronoi<> none{Delaunay<>(2)};
  EXPECT_TRUE(none.region_volumes().empty());
  EXPECT_TRUE(none.region_volumes({{0, 0}, {1, 1}}).empty());
}

TEST(Diagram, OfAFlatRegionsInABoxArePrisms) {
  // On a line of the plane: lengths in the flat, areas in a box.
  const Voronoi<> diagram(Delaunay<>(Sites{0, 1, 2, 1, 6, 1}, 2));
  EXPECT_EQ(diagram.affine_dimension(), 1);
  EXPECT_THAT(diagram.region_volumes(), ElementsAre(inf, 3, inf));
  EXPECT_THAT(diagram.region_volumes({{-1, 0}, {8, 3}}), ElementsAre(DoubleEq(6), DoubleEq(9), DoubleEq(12)));
}

TEST(Diagram, AreasOfRidgesInSpaceAndBeyond) {
  // The region of the middle one of a lattice is a unit cube; its ridges are cubes of one dimension less.
  for (const int d : {2, 3, 4}) {
    Sites sites;
    std::size_t middle = 0, count = 1;
    for (int j = 0; j < d; ++j) count *= 3;
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t rest = i;
      bool is_middle = true;
      for (int j = 0; j < d; ++j, rest /= 3) {
        sites.push_back(static_cast<double>(rest % 3));
        is_middle = is_middle && rest % 3 == 1;
      }
      if (is_middle) middle = i;
    }
    const Voronoi<> diagram(Delaunay<>(sites, d));
    const std::vector<double> volumes = diagram.region_volumes(), ridges = diagram.ridge_volumes();
    EXPECT_EQ(static_cast<std::size_t>(
                  std::count_if(volumes.begin(), volumes.end(), [](double x) { return x < inf; })),
              1u);
    EXPECT_NEAR(volumes[middle], 1, 1e-12);
    for (std::size_t i = 0; i < diagram.num_ridges(); ++i)
      if (diagram.ridge_points()[2 * i] == static_cast<SignedIndex>(middle) ||
          diagram.ridge_points()[2 * i + 1] == static_cast<SignedIndex>(middle)) {
        EXPECT_NEAR(ridges[i], 1, 1e-12) << d;
      }
    EXPECT_NEAR(sum_of(diagram.region_volumes(
                    {Sites(static_cast<std::size_t>(d), -1.0), Sites(static_cast<std::size_t>(d), 3.0)})),
                std::pow(4, d), 1e-9);
  }
}

TEST(Diagram, HiddenPointsHaveDataAndNoRegion) {
  const PowerDiagram<> diagram(Regular<>(Sites{0, 0, 4, 0, 0, 4, 1, 1}, Sites{0, 1, 2, -50}, 2));
  EXPECT_EQ(diagram.kind(), DataKind::power_diagram);
  EXPECT_EQ(diagram.point_region()[3], -1);
  const VoronoiData data = diagram.to_data();
  EXPECT_THAT(data.points, ElementsAre(0, 0, 4, 0, 0, 4, 1, 1));
  EXPECT_THAT(data.weights, ElementsAre(0, 1, 2, -50));
}

}  // namespace
}  // namespace delone::voronoi
