// SPDX-License-Identifier: BSD-3-Clause
// The engine against the definition, cell by cell: every subset of up to 12 points in integers without error.
// Batches, single insertions and the engine of run-time dimension; all kinds of degeneracy, and small
// integers full of ties.
#include "brute_force.hpp"

#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

namespace delone {
namespace {

using test::PointSet;

void expect_equal(const test::BruteForce& oracle, const test::Cells& expected, const Triangulation& actual,
                  const PointSet& set) {
  EXPECT_EQ(actual.affine_dimension(), oracle.affine_dimension());
  EXPECT_EQ(actual.num_vertices(), oracle.vertices().size());
  const ComplexData data = actual.to_data();
  EXPECT_TRUE(test::same_cells(expected, test::sorted_cells(data)));
  ASSERT_EQ(data.vertex_of_point.size(), set.size());
  for (std::size_t row = 0; row < set.size(); ++row)
    EXPECT_EQ(data.vertex_of_point[row], oracle.first_row(static_cast<SignedIndex>(row))) << "row " << row;
  for (std::size_t first = 0; first < data.cells.size();
       first += static_cast<std::size_t>(data.affine_dimension) + 1) {
    if (data.affine_dimension < data.dimension) break;
    const test::BruteForce::Rows cell(
        data.cells.begin() + static_cast<std::ptrdiff_t>(first),
        data.cells.begin() + static_cast<std::ptrdiff_t>(first) + data.affine_dimension + 1);
    EXPECT_EQ(oracle.orientation(cell), Sign::positive) << "cell " << test::to_text(cell);
  }
}

void expect_brute_force(const PointSet& set) {
  SCOPED_TRACE(set.name + "\n" + test::to_text(set.points, set.dimension));
  const test::BruteForce oracle(set.points, set.dimension);
  const test::Cells expected = oracle.cells();
  const auto d = static_cast<std::size_t>(set.dimension);
  {
    SCOPED_TRACE("batch");
    expect_equal(oracle, expected, Delaunay<>(set.points, set.dimension), set);
  }
  for (const bool force_runtime_dimension : {false, true}) {
    SCOPED_TRACE(force_runtime_dimension ? "one by one, run-time dimension" : "one by one");
    Options options;
    options.force_runtime_dimension = force_runtime_dimension;
    Delaunay<> triangulation(set.dimension, options);
    for (std::size_t row = 0; row < set.size(); ++row) {
      const InsertResult result = triangulation.insert(std::span(set.points).subspan(row * d, d));
      EXPECT_EQ(result.inserted,
                oracle.first_row(static_cast<SignedIndex>(row)) == static_cast<SignedIndex>(row))
          << "row " << row;
      EXPECT_EQ(result.vertex, triangulation.vertex_at(row));
    }
    expect_equal(oracle, expected, triangulation, set);
  }
}

class BruteForceIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, BruteForceIn, ::testing::Range(1, 6),
                         ::testing::PrintToStringParamName());

TEST_P(BruteForceIn, DegenerateSetsAgree) {
  const std::size_t rounds = test::scaled_count(GetParam() <= 3 ? 10 : GetParam() == 4 ? 4 : 1);
  for (std::uint64_t seed = 0; seed < rounds; ++seed)
    for (const PointSet& set :
         test::degenerate_sets(GetParam(), GetParam() == 5 ? 10 : 12 - seed % 4, seed)) {
      expect_brute_force(set);
      if (HasFailure()) return;
    }
}

TEST_P(BruteForceIn, SmallIntegersAgree) {
  const int d = GetParam();
  const std::size_t rounds = test::scaled_count(d <= 2 ? 1500 : d == 3 ? 600 : d == 4 ? 120 : 40);
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    test::Random random(seed);
    const int high = random.integer(1, 4);
    expect_brute_force(test::small_integers(d, static_cast<std::size_t>(random.integer(1, 12)),
                                            -random.integer(0, 2), high, seed));
    if (HasFailure()) return;
  }
}

TEST_P(BruteForceIn, GeneralPositionAgrees) {
  const std::size_t rounds = test::scaled_count(GetParam() <= 3 ? 200 : 20);
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    PointSet set{"real numbers", GetParam(), {}};
    test::Random random(seed);
    const int n = random.integer(1, 12);
    for (int i = 0; i < n * GetParam(); ++i) set.points.push_back(random.real());
    expect_brute_force(set);
    if (HasFailure()) return;
  }
}

TEST(BruteForceOracle, KnowsTheSquare) {
  // All four corners lie on one circle. Raised most is (1,1), then (1,0): a lone raised point is cut off, so
  // the diagonal joins (1,0) and (0,1).
  const test::BruteForce oracle(std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}, 2);
  EXPECT_EQ(oracle.cells(), (test::Cells{{0, 1, 2}, {1, 2, 3}}));
}

}  // namespace
}  // namespace delone
