// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/cover.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A square, the middle of its lower edge pushed out by 1/16 and that of the upper one by 1/4.
const std::vector<double> outline{0, 0, 1, -0.0625, 2, 0, 2, 2, 1, 2.25, 0, 2};

Cover cover_of(const std::vector<double>& coordinates, double tolerance) {
  std::vector<const double*> points;
  for (std::size_t at = 0; at < coordinates.size(); at += 2) points.push_back(coordinates.data() + at);
  const auto no_neighbors = [](std::size_t, std::vector<char>&, std::vector<Index>&) {};
  return {points, 2, tolerance, no_neighbors, [] {}};
}

TEST(Cover, DecidesExactly) {
  Cover cover = cover_of(outline, 0.0625);
  const std::vector<const double*> edge{outline.data(), outline.data() + 4};
  EXPECT_FALSE(cover.exceeds(edge, outline.data() + 2));
  EXPECT_TRUE(cover_of(outline, std::nextafter(0.0625, 0)).exceeds(edge, outline.data() + 2));
}

TEST(Cover, TakesTheFarthestFirstAndWhatIsNeeded) {
  Cover cover = cover_of(outline, 0.0625);
  for (const Index corner : {0, 2, 3, 5}) cover.require(corner);
  EXPECT_TRUE(cover.complete(std::vector<char>(6, 1)));
  EXPECT_THAT(cover.kept(), ElementsAre(0, 2, 3, 5, 4));
  EXPECT_EQ(cover.max_distance(), 0.0625);
  cover.reduce();
  EXPECT_THAT(cover.kept(), ElementsAre(0, 2, 3, 5, 4));
}

TEST(Cover, DropsWhatOthersCover) {
  const std::vector<double> line{0, 0, 1, 0.125, 4, 0, 8, 0};
  Cover cover = cover_of(line, 0.25);
  EXPECT_TRUE(cover.complete(std::vector<char>(4, 1)));  // from the first point on
  EXPECT_THAT(cover.kept(), ElementsAre(0, 3));
  Cover all = cover_of(line, 0.25);
  for (const Index p : {0, 3}) all.require(p);
  EXPECT_TRUE(all.complete(std::vector<char>(4, 1)));
  EXPECT_THAT(all.kept(), ElementsAre(0, 3));
}

TEST(Cover, KeepsWhatCoversAPointThatMayNotBeKept) {
  std::vector<char> allowed(6, 1);
  allowed[1] = 0;
  EXPECT_FALSE(cover_of(outline, 0.03).complete(allowed));
  Cover cover = cover_of(outline, 0.07);
  EXPECT_TRUE(cover.complete(allowed));
  cover.reduce();
  EXPECT_THAT(cover.kept(), ::testing::UnorderedElementsAre(0, 2, 3, 4, 5));
}

// So many that kept points are searched in boxes.
TEST(Cover, OfManyPointsCoversAll) {
  std::vector<double> circle;
  for (int i = 0; i < 3000; ++i)
    circle.insert(circle.end(), {std::cos(i * 0.0020943951), std::sin(i * 0.0020943951)});
  for (const double tolerance : {1e-7, 3e-7, 1e-5}) {
    Cover cover = cover_of(circle, tolerance);
    for (Index p = 0; p < 3000; p += 3) cover.require(p);
    EXPECT_TRUE(cover.complete(std::vector<char>(3000, 1)));
    cover.reduce();
    EXPECT_EQ(cover.kept().size() == 1000, tolerance > 1e-6);
    std::vector<const double*> kept;
    for (const Index p : cover.kept()) kept.push_back(circle.data() + 2 * static_cast<std::size_t>(p));
    for (std::size_t p = 0; p < 3000; p += 7) EXPECT_FALSE(cover.exceeds(kept, circle.data() + 2 * p));
  }
}

std::vector<double> sphere(std::size_t n, double radius) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> x;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = normal(random), b = normal(random), c = normal(random);
    const double scale = radius / std::sqrt(a * a + b * b + c * c);
    x.insert(x.end(), {scale * a, scale * b, scale * c});
  }
  return x;
}

// By the definition: all distances from all that are kept, each time.
TEST(Cover, KeepsWhatIsFarthestFromAllThatAreKept) {
  const std::vector<double> x = sphere(250, 1);
  std::vector<const double*> points;
  for (std::size_t at = 0; at < x.size(); at += 3) points.push_back(x.data() + at);
  const double tolerance = 0.05;
  std::vector<Index> expected{0};
  kernel::NearestInHull nearest;
  for (;;) {
    std::vector<const double*> kept;
    for (const Index p : expected) kept.push_back(points[p]);
    double largest = tolerance;
    Index farthest = invalid_index;
    for (Index p = 0; p < points.size(); ++p) {
      nearest.find(kept, points[p], 3);
      if (nearest.upper() > largest) largest = nearest.upper(), farthest = p;
    }
    if (farthest == invalid_index) break;
    expected.push_back(farthest);
  }
  Cover cover(
      points, 3, tolerance, [](std::size_t, std::vector<char>&, std::vector<Index>&) {}, [] {});
  EXPECT_TRUE(cover.complete(std::vector<char>(points.size(), 1)));
  EXPECT_EQ(cover.kept(), expected);
}

// Many kept and many dropped, also where binary64 overflows or underflows: none can be left out.
TEST(Cover, NoneOfThoseKeptCanBeLeftOut) {
  for (const double radius : {1.0, 0x1p1020, 0x1p-1000}) {
    const std::vector<double> x = sphere(400, radius);
    std::vector<const double*> points;
    for (std::size_t at = 0; at < x.size(); at += 3) points.push_back(x.data() + at);
    Cover cover(
        points, 3, 0.05 * radius, [](std::size_t, std::vector<char>&, std::vector<Index>&) {}, [] {});
    EXPECT_TRUE(cover.complete(std::vector<char>(points.size(), 1)));
    cover.reduce();
    EXPECT_LE(cover.max_distance(), 0.05 * radius);
    std::vector<const double*> kept;
    for (const Index p : cover.kept()) kept.push_back(points[p]);
    const auto is_cover = [&](const std::vector<const double*>& by) {
      return std::none_of(points.begin(), points.end(),
                          [&](const double* q) { return cover.exceeds(by, q); });
    };
    EXPECT_TRUE(is_cover(kept));
    kernel::NearestInHull nearest;
    double largest = 0;
    for (const double* q : points) {
      nearest.find(kept, q, 3);
      largest = std::max(largest, nearest.lower());
    }
    EXPECT_GE(cover.max_distance(), largest);
    if (radius == 1) {
      EXPECT_LE(cover.max_distance(), largest * (1 + 1e-9));
    }
    for (std::size_t i = 0; i < kept.size(); ++i) {
      std::vector<const double*> fewer = kept;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_FALSE(is_cover(fewer));
    }
  }
}

}  // namespace
}  // namespace delone::hull
