// SPDX-License-Identifier: BSD-3-Clause
// Hull facets through points and through homogeneous rows: which stage decides, signs against exact integers,
// and the perturbation against actual small numbers for the infinitesimals.
#include "kernel/hull_stages.hpp"

#include "base/random.hpp"
#include "kernel/coordinate_plane.hpp"
#include "kernel/predicates.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace delone::kernel {

namespace {

constexpr double tiny = std::numeric_limits<double>::denorm_min();
constexpr double huge = std::numeric_limits<double>::max();

RowCase rays(int size, std::vector<double> all) { return {RowForm::homogeneous, size, std::move(all)}; }

/// The rows (x, 1) of points, each times a positive number of few bits.
std::vector<double> homogeneous_rows(const std::vector<double>& points, int dimension,
                                     random::Generator* scales = nullptr) {
  std::vector<double> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.push_back(points[i]);
    if ((i + 1) % static_cast<std::size_t>(dimension) == 0) all.push_back(1);
  }
  if (scales == nullptr) return all;
  const auto size = static_cast<std::size_t>(dimension) + 1;
  for (std::size_t i = 0; i < all.size(); i += size) {
    const double scale =
        std::ldexp(static_cast<double>(1 + scales->below(7)), static_cast<int>(scales->below(41)) - 20);
    for (std::size_t j = i; j < i + size; ++j) all[j] *= scale;
  }
  return all;
}

test::Matrix integers(const RowCase& c) {
  int exponent = 0;
  for (const double x : c.numbers)
    if (x != 0) exponent = std::min(exponent, trailing_exponent(x));
  test::Matrix m;
  for (const double* row : c.rows) {
    m.emplace_back();
    for (const int axis : c.axes) m.back().push_back(integer_at(row[axis], exponent));
  }
  return m;
}

template <int K>
Sign orientation_of(const RowCase& c, StageCounts& counts) {
  return homogeneous_orientation<K>(c.flat(), c.rows.data(), counts);
}

TEST(HomogeneousOrientation, DirectStageDecidesAndProvesZeros) {
  StageCounts counts;
  EXPECT_EQ(orientation_of<1>(rays(2, {0.1, 0.2, 0.3, 0.1}), counts), Sign::negative);
  EXPECT_EQ(orientation_of<2>(rays(3, {1, 2, 3, 4, 5, 6, 7, 8, 9}), counts), Sign::zero);
  // Rows and columns may have very different sizes.
  EXPECT_EQ(orientation_of<1>(rays(2, {1e300, 2e300, 3e-300, 1e-300}), counts), Sign::negative);
  EXPECT_EQ(orientation_of<1>(rays(2, {1e300, 2e-300, 3e300, 1e-300}), counts), Sign::negative);
  EXPECT_EQ(orientation_of<1>(rays(2, {huge, tiny, huge, -tiny}), counts), Sign::negative);
  EXPECT_EQ(orientation_of<1>(rays(2, {0, 0, 1, 2}), counts), Sign::zero);
  EXPECT_EQ(orientation_of<1>(rays(2, {0, 1, 0, 2}), counts), Sign::zero);
  EXPECT_EQ(counts.direct, 7u);
  EXPECT_EQ(counts.exact, 0u);
}

TEST(HomogeneousOrientation, ExactStageDecidesTheRest) {
  StageCounts counts;
  const double third = 1.0 / 3;
  EXPECT_EQ(
      orientation_of<1>(rays(2, {third, 0.1, std::nextafter(third, 1), std::nextafter(0.1, 1)}), counts),
      test::sign_of(test::determinant(
          integers(rays(2, {third, 0.1, std::nextafter(third, 1), std::nextafter(0.1, 1)})))));
  EXPECT_EQ(orientation_of<1>(rays(2, {third, 0.1, 2 * third, 0.2}), counts), Sign::zero);
  EXPECT_EQ(orientation_of<2>(
                rays(3, {third, 0.1, 1e300, tiny, third, 0.1, tiny + third, 0.1 + third, 1e300}), counts),
            test::sign_of(test::determinant(
                integers(rays(3, {third, 0.1, 1e300, tiny, third, 0.1, tiny + third, 0.1 + third, 1e300})))));
  EXPECT_GE(counts.exact, 2u);
}

template <int K>
void expect_agreement_with_integers(int k, std::size_t rounds = 600) {
  random::Generator generator(static_cast<std::uint64_t>(k));
  const auto n = static_cast<std::size_t>(k) + 1;
  StageCounts counts;
  for (std::size_t round = 0; round < test::scaled_count(rounds); ++round) {
    RowCase c = rays(k + 1, random_numbers(n * n, round % 6, generator));
    if (round % 12 > 5)  // nearly or exactly dependent
      for (std::size_t j = 0; j < n; ++j)
        c.numbers[(n - 1) * n + j] = c.numbers[j] + (n > 2 ? c.numbers[n + j] : 0);
    const Sign expected = test::sign_of(test::determinant(integers(c)));
    EXPECT_EQ(orientation_of<K>(c, counts), expected) << "k = " << k << ", kind " << round % 12;
    EXPECT_EQ(exact_determinant(c.axes, c.rows.data()), expected);
    std::swap(c.rows[0], c.rows[1]);
    EXPECT_EQ(orientation_of<K>(c, counts), -expected);
    for (std::size_t j = 0; j < n; ++j) c.numbers[j] *= round % 6 == 4 || round % 6 == 5 ? 1 : 0x1p-500;
    EXPECT_EQ(orientation_of<K>(c, counts), -expected);
  }
  EXPECT_GT(counts.direct, counts.exact);
}

TEST(HomogeneousOrientation, AgreesWithExactIntegers) {
  expect_agreement_with_integers<1>(1);
  expect_agreement_with_integers<2>(2);
  expect_agreement_with_integers<3>(3);
  expect_agreement_with_integers<5>(5);
  expect_agreement_with_integers<0>(4);
  expect_agreement_with_integers<0>(9, 24);
}

TEST(HomogeneousOrientation, TakesTheChosenColumns) {
  const RowCase c(RowForm::homogeneous, 4, {1, 7, 2, 9, 3, 8, 4, 9}, {0, 2});
  StageCounts counts;
  EXPECT_EQ(c.flat().dimension(), 1);
  EXPECT_EQ(orientation_of<1>(c, counts), Sign::negative);
  EXPECT_EQ(exact_determinant(c.axes, c.rows.data()), Sign::negative);
}

TEST(HullSide, OfPointsAndOfTheirRowsIsTheSame) {
  random::Generator generator(9);
  for (std::size_t round = 0; round < test::scaled_count(500); ++round) {
    const std::vector<double> points = random_numbers(4 * 3, round % 4, generator);
    const RowCase a(RowForm::point, 3, points), b(RowForm::homogeneous, 4, homogeneous_rows(points, 3));
    StageCounts counts;
    const Sign side = hull_side<3>(a.flat(), a.rows.data(), a.q(), a.grid, counts);
    EXPECT_EQ(hull_side<3>(b.flat(), b.rows.data(), b.q(), b.grid, counts), side);
    EXPECT_EQ(hull_side<0>(b.flat(), b.rows.data(), b.q(), b.grid, counts), side);
    EXPECT_EQ(orientation<3>(a.flat(), a.rows.data(), a.grid), -side);  // (−1)^k
    EXPECT_EQ(delone::homogeneous_orientation(b.numbers, 3), side);
    EXPECT_EQ(counts.direct + counts.exact, 3u);
  }
}

/// The perturbation carried out: every row (of small integers) moves towards `inner` by 2^(−80·rank), the
/// largest the farthest. REQUIRES homogeneous rows, the query last.
Sign side_by_numbers(const RowCase& c, const std::vector<double>& inner) {
  std::vector<std::size_t> order(c.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return compare_rays(c.rows[a], c.rows[b], c.ambient) > 0; });
  test::Matrix m = integers(c);
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    for (std::size_t j = 0; j < m[0].size(); ++j) {
      test::Integer& entry = m[order[rank]][j];
      entry =
          shifted(entry, 1000) + shifted(integer_at(inner[j], 0), 1000 - 80 * (static_cast<int>(rank) + 1));
    }
  return test::sign_of(test::determinant(m));
}

template <int K>
void expect_perturbation_as_by_numbers() {
  random::Generator generator(static_cast<std::uint64_t>(K));
  int ties = 0, inner_rows = 0;
  std::set<Sign> seen;
  constexpr std::size_t size = K + 1;
  for (std::size_t round = 0; round < test::scaled_count(3000); ++round) {
    const bool of_points = round % 2 == 0;
    const std::vector<double> points = random_numbers(size * K, 1, generator);
    RowCase c =
        rays(K + 1, of_points ? homogeneous_rows(points, K) : random_numbers(size * size, 1, generator));
    StageCounts counts;
    if (hull_side<K>(c.flat(), c.rows.data(), c.q(), c.grid, counts) != Sign::zero) continue;
    const auto is_no_ray = [&](const double* row) {
      return std::all_of(row, row + size, [](double x) { return x == 0; });
    };
    if (std::any_of(c.rows.begin(), c.rows.end(), is_no_ray)) continue;
    if (std::any_of(c.rows.begin(), c.rows.end() - 1,
                    [&](const double* row) { return equal_rows(c.flat(), row, c.q()); }))
      continue;
    std::optional<Sign> first;
    for (int attempt = 0; attempt < 4; ++attempt) {  // any row of the inner side gives the same answer
      std::vector<double> inner = random_numbers(size, 1, generator);
      inner.back() = 1;
      const Sign side_of_inner = hull_side<K>(c.flat(), c.rows.data(), inner.data(), c.grid, counts);
      if (side_of_inner == Sign::zero) continue;
      if (side_of_inner == Sign::negative)
        for (double& x : inner) x = -x;
      ++inner_rows;
      const Sign sign = perturbed_hull_side<K>(c.flat(), c.rows.data(), c.q(), inner.data(), c.grid);
      EXPECT_EQ(sign, side_by_numbers(c, inner));
      EXPECT_EQ(first.value_or(sign), sign);
      EXPECT_EQ(perturbed_hull_side<0>(c.flat(), c.rows.data(), c.q(), inner.data(), c.grid), sign);
      if (of_points && side_of_inner == Sign::positive) {
        RowCase p(RowForm::point, K, points);
        p.grid.include(inner.data());
        EXPECT_EQ(perturbed_hull_side<K>(p.flat(), p.rows.data(), p.q(), inner.data(), p.grid), sign);
        EXPECT_EQ(hull_side_perturbed(p.flat(), std::span(p.rows).first(K), inner.data(), p.q()), sign);
      }
      if (first) continue;
      first = sign;
      ++ties;
      seen.insert(sign);
    }
  }
  EXPECT_GT(ties, 10);
  EXPECT_GT(inner_rows, 20);
  // On a line through one ray there is but the opposite ray, always beyond.
  EXPECT_EQ(seen, K == 1 ? std::set<Sign>{Sign::positive} : (std::set<Sign>{Sign::negative, Sign::positive}));
}

TEST(HullPerturbation, AgreesWithInfinitesimalsCarriedOut) {
  expect_perturbation_as_by_numbers<1>();
  expect_perturbation_as_by_numbers<2>();
  expect_perturbation_as_by_numbers<3>();
}

TEST(HullPerturbation, EveryBranch) {
  const auto perturbed = [](std::vector<double> edge_and_query, std::vector<double> inner) {
    RowCase c(RowForm::point, 2, std::move(edge_and_query));
    c.grid.include(inner.data());
    StageCounts counts;
    const Sign side = hull_side<2>(c.flat(), c.rows.data(), inner.data(), c.grid, counts);
    return perturbed_hull_side<2>(c.flat(), c.rows.data(), c.q(), inner.data(), c.grid, side);
  };
  EXPECT_EQ(perturbed({0, 0, 1, 0, 2, 0}, {1, 1}), Sign::positive) << "the query is the largest: it moves in";
  EXPECT_EQ(perturbed({0, 0, 2, 0, 1, 0}, {1, 1}), Sign::negative)
      << "a larger vertex moved in first, q is between";
  EXPECT_EQ(perturbed({2, 0, 0, 0, 1, 0}, {1, -1}), Sign::negative) << "the same from the other side";
  EXPECT_EQ(perturbed({1, 0, 2, 0, 0, 0}, {1, 1}), Sign::positive)
      << "a larger vertex moved in first, q is beyond the other";
  // q is on the edge of two vertices of a triangle, whose third is the largest: of the two the larger
  // decides.
  const std::vector<double> inner{0, 0, 1};
  RowCase c(RowForm::point, 3, {0, 0, 0, 0, 2, 0, 5, 0, 0, 0, 1, 0});
  c.grid.include(inner.data());
  StageCounts counts;
  const Sign side = hull_side<3>(c.flat(), c.rows.data(), inner.data(), c.grid, counts);
  EXPECT_EQ(perturbed_hull_side<3>(c.flat(), c.rows.data(), c.q(), inner.data(), c.grid, side),
            Sign::negative);
}

/// Facets in the hyperplane of a coordinate, perhaps of fewer axes than there are coordinates.
template <int K>
void expect_the_same_in_coordinate_planes() {
  random::Generator generator(static_cast<std::uint64_t>(K) + 10);
  std::map<Sign, int> seen;
  int off_axes = 0, zeros = 0;
  for (std::size_t round = 0; round < test::scaled_count(6000); ++round) {
    const int ambient = K + static_cast<int>(round % 2), r = static_cast<int>(generator.below(K));
    std::vector<double> all =
        random_numbers(static_cast<std::size_t>((K + 2) * ambient), round % 6, generator);
    std::vector<int> axes(static_cast<std::size_t>(K));
    std::iota(axes.begin(), axes.end(), ambient - K);
    const auto at = [&](int row) -> double& {
      return all[static_cast<std::size_t>(row * ambient + axes[static_cast<std::size_t>(r)])];
    };
    for (int row = 1; row <= K; ++row) at(row) = at(0);
    std::vector<double> inner(all.end() - ambient, all.end());
    all.resize(all.size() - inner.size());
    RowCase c(RowForm::point, ambient, all, axes);
    c.grid.include(inner.data());
    StageCounts counts;
    const auto hyperplane = [&] {
      return common_axis(c.flat(), c.q(), [&](int i) { return c.rows[static_cast<std::size_t>(i)]; });
    };
    const Sign side = hull_side<K>(c.flat(), c.rows.data(), inner.data(), c.grid, counts);
    if (inner[static_cast<std::size_t>(axes[static_cast<std::size_t>(r)])] != at(0)) {
      EXPECT_EQ(side_off_coordinate_plane<K>(c.flat(), c.rows.data(), r, inner.data(), c.grid), side);
      EXPECT_EQ(side_off_coordinate_plane<0>(c.flat(), c.rows.data(), r, inner.data(), c.grid), side);
      zeros += side == Sign::zero ? 1 : 0;
    }
    if (side == Sign::zero) continue;
    EXPECT_EQ(hyperplane(), r);
    EXPECT_EQ(hull_side<K>(c.flat(), c.rows.data(), c.q(), c.grid, counts), Sign::zero);
    if (side == Sign::negative) std::swap(c.rows[0], c.rows[1]);
    if (std::any_of(c.rows.begin(), c.rows.end() - 1, [&](const double* row) {
          return std::all_of(axes.begin(), axes.end(), [&](int axis) { return row[axis] == c.q()[axis]; });
        }))
      continue;
    const Sign sign = perturbed_hull_side<K>(c.flat(), c.rows.data(), c.q(), inner.data(), c.grid);
    EXPECT_EQ(perturbed_side_in_coordinate_plane<K>(c.flat(), c.rows.data(), c.q(), r, inner.data(), c.grid),
              sign);
    EXPECT_EQ(perturbed_side_in_coordinate_plane<0>(c.flat(), c.rows.data(), c.q(), r, inner.data(), c.grid),
              sign);
    ++seen[sign];
    at(K) = std::nextafter(at(K), huge);  // q, which RowCase has a copy of
    RowCase moved(RowForm::point, ambient, all, axes);
    off_axes += common_axis(moved.flat(), moved.q(),
                            [&](int i) { return moved.rows[static_cast<std::size_t>(i)]; }) == no_axis
                    ? 1
                    : 0;
  }
  EXPECT_GT(seen[Sign::positive], 100);
  EXPECT_GT(seen[Sign::negative], 100);
  EXPECT_GT(off_axes, 1000);
  EXPECT_GT(zeros, 10);
}

TEST(CoordinatePlane, PredicatesAreThoseOfHulls) {
  expect_the_same_in_coordinate_planes<2>();
  expect_the_same_in_coordinate_planes<3>();
  expect_the_same_in_coordinate_planes<4>();
}

/// The facets of the hull by definition: every k independent rows that no other row is in conflict with.
std::set<std::vector<int>> hull_facets(const RowCase& input, const double* inner,
                                       const std::vector<int>& order) {
  const int k = input.flat().dimension(), n = static_cast<int>(order.size());
  std::set<std::vector<int>> facets;
  for (unsigned subset = 0; subset < 1u << n; ++subset) {
    if (std::popcount(subset) != k) continue;
    std::vector<int> facet;
    std::vector<const double*> rows;
    for (int i = 0; i < n; ++i)
      if ((subset >> i & 1) != 0) {
        facet.push_back(order[static_cast<std::size_t>(i)]);
        rows.push_back(input.rows[static_cast<std::size_t>(facet.back())]);
      }
    if (hull_side(input.flat(), rows, inner, inner) == Sign::zero) continue;
    const bool stands = std::none_of(input.rows.begin(), input.rows.end(), [&](const double* q) {
      return hull_side_perturbed(input.flat(), rows, inner, q) == Sign::negative;
    });
    if (!stands) continue;
    std::sort(facet.begin(), facet.end());
    facets.insert(facet);
  }
  return facets;
}

template <int D>
void expect_closed_hulls() {
  random::Generator generator(static_cast<std::uint64_t>(70 + D));
  int hulls = 0;
  for (std::size_t round = 0; round < test::scaled_count(200); ++round) {
    const std::size_t n = D + 1 + generator.below(static_cast<std::uint64_t>(8 - D));
    std::set<std::vector<double>> distinct;
    while (distinct.size() < n) distinct.insert(random_numbers(D, round % 4 == 3 ? 0 : 1, generator));
    std::vector<double> points;
    for (const auto& p : distinct)
      for (const double x : p) points.push_back(x * static_cast<double>(n));
    if (delone::affine_dimension(points, D) != D) continue;
    ++hulls;
    std::vector<double> inner(D, 0.0),
        inner_row(D + 1, 1.0);  // the centroid; a random row of a cone has no need of one
    for (std::size_t i = 0; i < points.size(); ++i) inner[i % D] += points[i] / static_cast<double>(n);
    std::copy(inner.begin(), inner.end(), inner_row.begin());
    const RowCase of_points(RowForm::point, D, points);
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    const auto facets = hull_facets(of_points, inner.data(), order);
    EXPECT_FALSE(facets.empty());
    if constexpr (D > 1) {
      std::map<std::vector<int>, int> ridges;
      for (const auto& facet : facets)
        for (const int left_out : facet) {
          std::vector<int> ridge = facet;
          ridge.erase(std::find(ridge.begin(), ridge.end(), left_out));
          ++ridges[ridge];
        }
      for (const auto& [ridge, count] : ridges) EXPECT_EQ(count, 2);
    } else {
      EXPECT_EQ(facets.size(), 2u);
    }
    for (int again = 0; again < 2; ++again) {
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[generator.below(i)]);
      EXPECT_EQ(hull_facets(of_points, inner.data(), order), facets);
      // Uniform points times seven are rounded: rays of such lengths are other rays.
      const RowCase of_rays(RowForm::homogeneous, D + 1,
                            homogeneous_rows(points, D, round % 4 == 3 ? nullptr : &generator));
      EXPECT_EQ(hull_facets(of_rays, inner_row.data(), order), facets);
    }
  }
  EXPECT_GT(hulls, 2);
}

TEST(HullPerturbation, MakesOneClosedHullInAnyOrder) {
  expect_closed_hulls<2>();
  expect_closed_hulls<3>();
  expect_closed_hulls<4>();
}

TEST(SideOfHyperplane, EveryStage) {
  const auto side = [](std::vector<double> row, std::vector<double> p, StageCounts& counts) {
    return side_of_hyperplane(row.data(), p.data(), static_cast<int>(p.size()), counts);
  };
  StageCounts counts;
  EXPECT_EQ(side({1, 2, -4}, {1, 1}, counts), Sign::negative);
  EXPECT_EQ(side({0.1, 0.2, 4}, {1, 1}, counts), Sign::positive);
  EXPECT_EQ(counts.exact, 0u);
  EXPECT_EQ(side({1, 2, -3}, {1, 1}, counts), Sign::zero);
  EXPECT_EQ(side({1e300, -1e300, tiny}, {1e300, 1e300}, counts), Sign::positive);
  EXPECT_EQ(side({tiny, 0}, {tiny}, counts), Sign::positive);
  EXPECT_EQ(side({tiny, 0}, {-tiny}, counts), Sign::negative);
  EXPECT_EQ(side({tiny, -tiny}, {1}, counts), Sign::zero);
  EXPECT_EQ(side({huge, -huge, 0}, {huge, huge}, counts), Sign::zero);
  EXPECT_EQ(side({0, 0, 0}, {huge, tiny}, counts), Sign::zero);
  EXPECT_EQ(side({1.0 / 3, -1}, {3}, counts), Sign::negative);  // 3·fl(1/3) < 1
  EXPECT_EQ(counts.direct, 2u);
  EXPECT_EQ(counts.exact, 8u);
  random::Generator generator(3);
  for (std::size_t round = 0; round < test::scaled_count(2000); ++round) {
    std::vector<double> row = random_numbers(4, round % 6, generator);
    const std::vector<double> p = random_numbers(3, (round / 6) % 6, generator);
    if (round % 5 == 0) row[3] = -(row[0] * p[0] + row[1] * p[1] + row[2] * p[2]);
    if (!std::isfinite(row[3])) continue;
    boost::multiprecision::cpp_rational sum(row[3]);
    for (std::size_t j = 0; j < 3; ++j)
      sum += boost::multiprecision::cpp_rational(row[j]) * boost::multiprecision::cpp_rational(p[j]);
    EXPECT_EQ(side(row, p, counts), sum > 0 ? Sign::positive : sum < 0 ? Sign::negative : Sign::zero);
    EXPECT_EQ(static_cast<int>(delone::side_of_hyperplane(row, p, 3)),
              -static_cast<int>(exact_affine_form(row.data(), p.data(), 3)));
  }
}

}  // namespace
}  // namespace delone::kernel
