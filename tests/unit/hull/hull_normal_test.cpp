// SPDX-License-Identifier: BSD-3-Clause
// Certified normals against exact orientations, and the bounds of volumes, areas and equations against exact
// values.
#include "hull/hull_normal.hpp"
#include "hull/hull_measure.hpp"

#include "base/compiled_dimension.hpp"

#include "brute_force.hpp"
#include "degenerate.hpp"
#include "hull_support.hpp"

#include <delone/convex_hull.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delone::hull {
namespace {

/// Calls work(normals) with those compiled for d dimensions, and with those for any number.
template <class Work>
void for_both_normals(int d, Work work) {
  internal::with_compiled_dimension(static_cast<std::size_t>(d),
                                    [&](auto k) { work(HullNormalsIn<k()>(d)); });
  work(HullNormals(d));
}

class HullNormalIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, HullNormalIn, ::testing::Range(1, 8),
                         ::testing::PrintToStringParamName());

// (1) A side that the normal tells is the exact one. (2) Zero only where the exact side is zero or the points
// are nearly so.
TEST_P(HullNormalIn, WhatIsCertainIsRight) {
  const int d = GetParam();
  std::vector<const double*> scratch;
  std::size_t certain = 0, all = 0;
  for (const test::PointSet& set : test::degenerate_sets(d, 24, 1)) {
    SCOPED_TRACE(set.name);
    const BoundarySites sites = sites_of(set.dimension, set.points);
    if (sites.size() < static_cast<std::size_t>(d) + 1) continue;
    for_both_normals(d, [&](auto normals) {
      std::vector<double> record(normals.stride());
      test::Random random(3);
      for (int i = 0; i < 40; ++i) {
        std::vector<Index> cell;
        for (int j = 0; j < d; ++j) cell.push_back(static_cast<Index>(random.bits() % sites.size()));
        const double* q = sites.point(static_cast<Index>(random.bits() % sites.size()));
        const bool reversed = i % 2 != 0;
        normals.compute(sites, cell, reversed, record.data());
        const Sign sign = normals.side(sites, record.data(), sites.point(cell[0]), q);
        ++all;
        if (sign == Sign::zero) continue;
        ++certain;
        const Sign exact = compiled::side_of_sites(sites, cell, q, sites.grid, scratch);
        EXPECT_EQ(sign, reversed ? -exact : exact);
      }
    });
  }
  EXPECT_GT(certain, all / 20);  // most of these points are duplicates, on one hyperplane, or next to it
}

TEST_P(HullNormalIn, RandomPointsNeedNoExactStage) {
  const int d = GetParam();
  test::PointSet set{"real numbers", d, {}};
  test::Random random(4);
  for (int i = 0; i < 200 * d; ++i) set.points.push_back(random.real());
  const BoundarySites sites = sites_of(set.dimension, set.points);
  for_both_normals(d, [&](auto normals) {
    std::vector<double> record(normals.stride());
    for (Index first = 0; first + static_cast<Index>(d) < sites.size(); first += static_cast<Index>(d) + 1) {
      std::vector<Index> cell(static_cast<std::size_t>(d));
      std::iota(cell.begin(), cell.end(), first);
      normals.compute(sites, cell, false, record.data());
      EXPECT_NE(
          normals.side(sites, record.data(), sites.point(first), sites.point(first + static_cast<Index>(d))),
          Sign::zero);
    }
  });
}

// The normal has an entry ±1, and an exact one within its error: that orthogonal to the edges with that
// entry.
TEST_P(HullNormalIn, AnExactNormalIsWithinTheError) {
  const int d = GetParam();
  if (d < 2) return;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    test::PointSet set = test::small_integers(d, static_cast<std::size_t>(d), -1000, 1000, seed);
    if (seed % 2 == 1)  // thin: far from the origin, and close to each other along the first axis
      for (std::size_t i = 0; i < set.size(); ++i)
        set.points[i * static_cast<std::size_t>(d)] = 1e6 + 0x1p-20 * static_cast<double>(i % 2);
    const BoundarySites sites = sites_of(set.dimension, set.points);
    if (sites.size() < static_cast<std::size_t>(d)) continue;
    std::vector<const double*> points;
    for (Index i = 0; i < static_cast<Index>(d); ++i) points.push_back(sites.point(i));
    internal::with_compiled_dimension(static_cast<std::size_t>(d), [&](auto k) {
      HullNormal<k()> normal(d);
      if (!normal.compute(points.data(), sites.axes, false)) return;
      const auto rows = test::scaled_to_integers(set.points, d);
      std::vector<long double> exact;
      for (int j = 0; j < d; ++j) {
        test::Matrix edges;
        for (std::size_t i = 1; i < rows.size(); ++i) {
          edges.emplace_back();
          for (int c = 0; c < d; ++c)
            if (c != j)
              edges.back().push_back(rows[i][static_cast<std::size_t>(c)] -
                                     rows[0][static_cast<std::size_t>(c)]);
        }
        const auto minor = test::determinant(edges);
        exact.push_back(static_cast<long double>(j % 2 == 0 ? minor : -minor));
      }
      const auto p =
          std::find_if(normal.normal(), normal.normal() + d, [](double x) { return std::fabs(x) == 1; });
      ASSERT_NE(p, normal.normal() + d);
      const long double scale = *p / exact[static_cast<std::size_t>(p - normal.normal())];
      long double square = 0;
      for (std::size_t j = 0; j < exact.size(); ++j) {
        const long double difference = scale * exact[j] - normal.normal()[j];
        square += difference * difference;
      }
      EXPECT_LE(std::sqrt(static_cast<double>(square)), normal.error() + 1e-18) << "seed " << seed;
      EXPECT_LE(normal.error(), seed % 2 == 0 ? 1e-9 : 0.125 * normal.length()) << "seed " << seed;
    });
  }
}

TEST_P(HullNormalIn, VolumesOfSimplicesAreWithinTheirBounds) {
  const int d = GetParam();
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    // Every other simplex is nearly flat.
    test::PointSet set = test::small_integers(d, static_cast<std::size_t>(d) + 1, -1000, 1000, seed);
    if (seed % 2 == 1)
      for (std::size_t i = 0; i < set.size(); ++i)
        set.points[i * static_cast<std::size_t>(d)] = 1e6 + 0x1p-20 * static_cast<double>(i);
    const BoundarySites sites = sites_of(set.dimension, set.points);
    std::vector<const double*> points;
    for (Index i = 0; i <= static_cast<Index>(d); ++i) points.push_back(sites.point(i));
    const auto rows = test::scaled_to_integers(set.points, d);
    test::Matrix edges;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      edges.emplace_back();
      for (std::size_t j = 0; j < rows[0].size(); ++j) edges.back().push_back(rows[i][j] - rows[0][j]);
    }
    // One power of two scaled all coordinates: found again from a coordinate that is not zero.
    double unit = 1;
    for (std::size_t i = 0; i < set.points.size(); ++i)
      if (set.points[i] != 0) {
        unit = set.points[i] /
               static_cast<double>(rows[i / static_cast<std::size_t>(d)][i % static_cast<std::size_t>(d)]);
        break;
      }
    long double exact = static_cast<long double>(abs(test::determinant(edges)));
    for (int j = 1; j <= d; ++j) exact *= static_cast<long double>(unit) / j;
    const Measure volume = simplex_volume(points, d);
    EXPECT_LE(std::fabs(static_cast<double>(exact - volume.value)), volume.error) << "seed " << seed;
    if (seed % 2 == 0) {
      EXPECT_LE(volume.error, 1e-6 * std::pow(4000.0, d));
    }
  }
}

TEST_P(HullNormalIn, EquationsVanishOnTheirFacets) {
  const int d = GetParam();
  for (const test::PointSet& set : test::degenerate_sets(d, 16, 2)) {
    const ConvexHull hull(set.points, d);
    if (hull.affine_dimension() != d) continue;
    const HullData data = hull.to_data();
    for (std::size_t f = 0; f < data.num_facets(); ++f) {
      if (!std::isfinite(data.equation_errors[f])) continue;
      const double* equation = data.equations.data() + f * (static_cast<std::size_t>(d) + 1);
      for (auto at = data.facet_offsets[f]; at < data.facet_offsets[f + 1]; ++at) {
        long double distance = equation[d], magnitude = std::fabs(equation[d]);
        const auto point =
            hull.point(static_cast<std::size_t>(data.facet_vertices[static_cast<std::size_t>(at)]));
        for (std::size_t j = 0; j < static_cast<std::size_t>(d); ++j) {
          distance += static_cast<long double>(equation[j]) * point[j];
          magnitude += std::fabs(static_cast<long double>(equation[j]) * point[j]);
        }
        EXPECT_LE(std::fabs(distance), data.equation_errors[f] + 1e-18L * magnitude) << set.name;
      }
    }
  }
}

}  // namespace
}  // namespace delone::hull
