// SPDX-License-Identifier: BSD-3-Clause
// All stages together: signs against exact integers, and every branch of the perturbation.
#include "kernel/stages.hpp"

#include "base/random.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::kernel {
namespace {

TEST(AllStages, AgreeWithExactIntegers) {
  random::Generator generator(11);
  for (int d = 1; d <= 6; ++d)
    for (std::size_t round = 0; round < test::scaled_count(600); ++round) {
      std::vector<double> x;
      const auto kind = round % 5;
      for (int i = 0; i < (d + 2) * d; ++i) {
        const double u = generator.uniform();
        if (kind == 0) x.push_back(u);
        if (kind == 1) x.push_back(std::floor(4 * u));
        if (kind == 2) x.push_back(0.1 * std::floor(4 * u));
        if (kind == 3) x.push_back(4e6 + 0.001 * std::floor(1000 * u));
        if (kind == 4) x.push_back(std::ldexp(u - 0.5, static_cast<int>(generator.below(80)) - 40));
      }
      RowCase c(RowForm::point, d, x);
      const Sign expected = true_orientation_of(lifted_rows(c));
      StageCounts counts;
      EXPECT_EQ(orientation<0>(c.flat(), c.rows.data(), c.grid, counts), expected);
      EXPECT_EQ(exact_orientation(c.flat(), c.rows.data() + 1, c.rows[0]), expected);
      if (expected == Sign::zero) continue;
      if (expected == Sign::negative) std::swap(c.rows[0], c.rows[1]);
      EXPECT_EQ(in_sphere<0>(c.flat(), c.rows.data(), c.q(), c.grid, counts),
                true_side_of_sphere(lifted_rows(c)));
    }
}

TEST(Perturbation, TheQueryDecidesWhenItIsTheLargest) {
  const RowCase c(RowForm::point, 2, {0, 0, 2, 0, 0, 2, 2, 2});  // q = (2,2) is lexicographically largest
  EXPECT_EQ(perturbed_in_sphere<2>(c.flat(), c.rows.data(), c.q(), c.grid), Sign::positive);
}

TEST(Perturbation, ALargerVertexDecidesByTheBarycentricCoordinate) {
  // The vertex (2,2) is largest. q = (0,0) has a negative barycentric coordinate there: lifting (2,2) lowers
  // the sphere at q.
  const RowCase outside(RowForm::point, 2, {2, 0, 2, 2, 0, 2, 0, 0});
  EXPECT_EQ(perturbed_in_sphere<2>(outside.flat(), outside.rows.data(), outside.q(), outside.grid),
            Sign::positive);
  // q = (2,0) against (0,0), (2,2), (0,2): (2,2) is larger than q, and q's barycentric coordinate there is
  // positive.
  const RowCase inside(RowForm::point, 2, {0, 0, 2, 2, 0, 2, 2, 0});
  EXPECT_EQ(perturbed_in_sphere<2>(inside.flat(), inside.rows.data(), inside.q(), inside.grid),
            Sign::negative);
}

TEST(Perturbation, AZeroBarycentricCoordinatePassesToTheNextPoint) {
  // Eight points of a cube are cospherical. q = (1,0,0) has barycentric coordinate 0 at the largest vertex
  // (1,1,1) with respect to a simplex whose face opposite (1,1,1) lies in the plane z = 0 with q; the next
  // larger vertex decides.
  const RowCase c(RowForm::point, 3, {0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 1, 0, 0});
  ASSERT_EQ(orientation<3>(c.flat(), c.rows.data(), c.grid), Sign::positive);
  EXPECT_EQ(perturbed_in_sphere<3>(c.flat(), c.rows.data(), c.q(), c.grid), Sign::negative);
}

/// Corners of a box are cospherical, and barycentric coordinates of many are 0. `length`: of the box along
/// the first axis.
template <int K>
void expect_the_same_on_a_grid_as_without(double length) {
  SCOPED_TRACE(testing::Message() << "dimension " << K << ", a box of length " << length);
  random::Generator generator(static_cast<std::uint64_t>(K));
  Grid fine(K);  // holds the points, and is not small
  for (const double x : {0.0, length, 1.0 / 3})
    fine.include(std::vector<double>(static_cast<std::size_t>(K), x).data());
  int compared = 0, negative = 0;
  while (compared < static_cast<int>(test::scaled_count(400))) {
    std::vector<double> corners;
    for (int i = 0; i < (K + 2) * K; ++i)
      corners.push_back(static_cast<double>(generator.below(2)) * (i % K == 0 ? length : 1));
    RowCase c(RowForm::point, K, std::move(corners));
    const Sign side = orientation<K>(c.flat(), c.rows.data(), c.grid);
    const auto is_at_query = [&](const double* p) { return equal_points(p, c.q(), K); };
    if (side == Sign::zero || std::any_of(c.rows.begin(), c.rows.end() - 1, is_at_query)) continue;
    if (side == Sign::negative) std::swap(c.rows[0], c.rows[1]);
    ASSERT_TRUE(length > 1 || c.grid.is_small());
    const Sign sign = perturbed_in_sphere<K>(c.flat(), c.rows.data(), c.q(), c.grid);
    EXPECT_EQ(sign, perturbed_in_sphere<0>(c.flat(), c.rows.data(), c.q(), fine));
    ++compared;
    negative += sign == Sign::negative;
  }
  EXPECT_GT(negative, 0);
  EXPECT_LT(negative, compared);
}

TEST(Perturbation, IsTheSameOnSmallGridsAsWithoutThem) {
  for (const double length : {1.0, 0x1p20, 0x1p40}) {  // long boxes have few bits per axis, but lifts of many
    expect_the_same_on_a_grid_as_without<2>(length);
    expect_the_same_on_a_grid_as_without<3>(length);
    expect_the_same_on_a_grid_as_without<5>(length);
    expect_the_same_on_a_grid_as_without<6>(length);
    expect_the_same_on_a_grid_as_without<7>(length);
    expect_the_same_on_a_grid_as_without<8>(length);
  }
}

TEST(Perturbation, IsNeverZeroAndAntisymmetricOnCospherical) {
  // Of two triangulations of a square exactly one is chosen: the two diagonals give opposite answers.
  const std::vector<std::vector<double>> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int start = 0; start < 4; ++start) {
    std::vector<double> one, other;
    for (int i : {0, 1, 2, 3})
      one.insert(one.end(), corners[(start + i) % 4].begin(), corners[(start + i) % 4].end());
    for (int i : {1, 2, 3, 0})
      other.insert(other.end(), corners[(start + i) % 4].begin(), corners[(start + i) % 4].end());
    const RowCase a(RowForm::point, 2, one), b(RowForm::point, 2, other);
    EXPECT_EQ(perturbed_in_sphere<2>(a.flat(), a.rows.data(), a.q(), a.grid),
              -perturbed_in_sphere<2>(b.flat(), b.rows.data(), b.q(), b.grid));
  }
}

}  // namespace
}  // namespace delone::kernel
