// SPDX-License-Identifier: BSD-3-Clause
// Hulls against the definition: cells, facets, extreme points, kinds of points and numbers of faces, for sets
// of up to 12 points of all kinds of degeneracy.
#include "hull_brute_force.hpp"
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/convex_hull.hpp>

#include <gtest/gtest.h>

namespace delone {
namespace {

using test::PointSet;

test::Cells lists(const std::vector<SignedIndex>& offsets, const std::vector<SignedIndex>& items) {
  test::Cells result;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i)
    result.emplace_back(items.begin() + offsets[i], items.begin() + offsets[i + 1]);
  std::sort(result.begin(), result.end());
  return result;
}

void expect_equal(const test::HullBruteForce& oracle, const ConvexHullBase& actual, bool with_cells) {
  const HullData data = actual.to_data();
  const int k = data.affine_dimension;
  EXPECT_EQ(k, oracle.affine_dimension());
  EXPECT_EQ(data.vertex_of_point, oracle.first_row());
  for (std::size_t row = 0; row < data.num_points(); ++row)
    EXPECT_EQ(static_cast<int>(data.point_kinds[row]),
              static_cast<int>(oracle.kind(static_cast<SignedIndex>(row))))
        << "row " << row;
  EXPECT_EQ(data.vertices, oracle.extreme_rows());
  EXPECT_TRUE(test::same_cells(oracle.extreme_facets(), lists(data.facet_offsets, data.facet_vertices)));
  EXPECT_EQ(actual.f_vector(), oracle.f_vector());
  if (k >= 2) {
    EXPECT_EQ(data.num_ridges(), oracle.f_vector()[static_cast<std::size_t>(k - 2)]);
  }
  const CheckReport report = check(data);
  EXPECT_TRUE(report.ok) << report.violation;
  if (with_cells) {
    EXPECT_TRUE(test::same_cells(oracle.cells(), test::sorted_cells(data.cells, k - 1)));
  }
  if (k < 2) return;
  const auto corners = static_cast<std::size_t>(k);
  for (std::size_t c = 0; c < data.num_cells(); ++c) {
    const std::span<const SignedIndex> cell(data.cells.data() + c * corners, corners);
    bool any = false;
    for (std::size_t row = 0; row < data.num_points(); ++row) {
      const Sign sign = oracle.orientation(static_cast<SignedIndex>(row), cell);
      EXPECT_NE(sign, Sign::negative);
      any |= sign == Sign::positive;
    }
    EXPECT_TRUE(any);
  }
}

void expect_brute_force(const PointSet& set, bool with_cells = true) {
  SCOPED_TRACE(set.name + "\n" + test::to_text(set.points, set.dimension));
  const test::HullBruteForce oracle(set.points, set.dimension);
  const auto d = static_cast<std::size_t>(set.dimension);
  {
    SCOPED_TRACE("batch");
    expect_equal(oracle, ConvexHull(set.points, set.dimension), with_cells);
  }
  SCOPED_TRACE("one by one");
  ConvexHull hull(set.dimension);
  for (std::size_t row = 0; row < set.size(); ++row) {
    const HullInsertResult result = hull.insert(std::span(set.points).subspan(row * d, d));
    EXPECT_EQ(result.row, row);
    EXPECT_EQ(result.duplicate, oracle.first_row()[row] != static_cast<SignedIndex>(row));
  }
  expect_equal(oracle, hull, with_cells);
}

class HullBruteForceIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, HullBruteForceIn, ::testing::Range(1, 6),
                         ::testing::PrintToStringParamName());

TEST_P(HullBruteForceIn, DegenerateSetsAgree) {
  const std::size_t rounds = test::scaled_count(GetParam() <= 3 ? 3 : 1);
  for (std::uint64_t seed = 0; seed < rounds; ++seed)
    for (const PointSet& set : test::degenerate_sets(GetParam(),
                                                     GetParam() == 5   ? 8
                                                     : GetParam() == 4 ? 9
                                                                       : 11 - seed % 4,
                                                     seed)) {
      // Carrying out the perturbation takes numbers of 12·k·4000 bits when coordinates span all exponents.
      const bool moderate = std::all_of(set.points.begin(), set.points.end(), [](double x) {
        return x == 0 || (std::fabs(x) > 1e-9 && std::fabs(x) < 1e17);
      });
      expect_brute_force(set, moderate);
      if (HasFailure()) return;
    }
}

TEST_P(HullBruteForceIn, SmallIntegersAgree) {
  const int d = GetParam();
  const std::size_t rounds = test::scaled_count(d <= 2 ? 400 : d == 3 ? 120 : d == 4 ? 15 : 4);
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    test::Random random(seed);
    const int high = random.integer(1, 4);
    expect_brute_force(test::small_integers(d, static_cast<std::size_t>(random.integer(1, d <= 3 ? 12 : 10)),
                                            -random.integer(0, 2), high, seed));
    if (HasFailure()) return;
  }
}

TEST_P(HullBruteForceIn, GeneralPositionAgrees) {
  const std::size_t rounds = test::scaled_count(GetParam() <= 3 ? 40 : 5);
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    PointSet set{"real numbers", GetParam(), {}};
    test::Random random(seed);
    const int n = random.integer(1, 11);
    for (int i = 0; i < n * GetParam(); ++i) set.points.push_back(random.real());
    expect_brute_force(set);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace delone
