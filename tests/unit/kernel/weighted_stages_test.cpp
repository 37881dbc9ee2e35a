// SPDX-License-Identifier: BSD-3-Clause
// Spheres orthogonal to weighted points: which stage decides, signs against exact integers over the whole
// range of doubles, and the perturbation against actual small numbers for the infinitesimals.
#include "base/random.hpp"
#include "kernel/predicates.hpp"
#include "kernel/stages.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <delone/error.hpp>
#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace delone::kernel {

namespace {

RowCase weighted(int dimension, std::vector<double> all) {
  return {RowForm::weighted_point, dimension, std::move(all)};
}

template <int K>
std::optional<Sign> direct(const RowCase& c) {
  return direct_sphere<K>(c.flat(), c.rows.data(), c.q(), c.grid);
}
Sign exact(const RowCase& c) { return exact_sphere(c.flat(), c.rows.data(), c.q()); }

/// in_sphere for vertices in any order.
template <int K>
Sign side(RowCase& c, StageCounts& counts) {
  if (orientation<K>(c.flat(), c.rows.data(), c.grid) == Sign::negative) std::swap(c.rows[0], c.rows[1]);
  return in_sphere<K>(c.flat(), c.rows.data(), c.q(), c.grid, counts);
}

TEST(WeightedSphere, DirectStageDecidesGeneralPosition) {
  RowCase c = weighted(2, {0.1, 0.2, 0.3, 1.3, 0.1, -0.2, 0.4, 0.9, 0.1, 0.5, 0.5, 0.7});
  StageCounts counts;
  EXPECT_EQ(side<2>(c, counts), Sign::negative);
  EXPECT_EQ(counts.direct, 1u);
}

TEST(WeightedSphere, DirectStageProvesZerosOnGrids) {
  // A unit square where weights add one affine function: the four lifted points stay on one hyperplane.
  EXPECT_EQ(direct<2>(weighted(2, {0, 0, 1, 1, 0, 4, 1, 1, 2, 0, 1, -1})), Sign::zero);
  // By elimination and the unit of the grid, where no minors are tabulated or the lattice is too fine.
  const double s = 999;
  const RowCase large = weighted(2, {0, 0, 0, s, 0, 9, s, s, 9 + s, 0, s, s});
  EXPECT_EQ(direct<0>(large), Sign::zero);
  const RowCase scaled =
      weighted(2, {0, 0, 0, std::ldexp(3, -400), 0, std::ldexp(5, -800), std::ldexp(3, -400),
                   std::ldexp(3, -400), std::ldexp(7, -800), 0, std::ldexp(3, -400), std::ldexp(2, -800)});
  EXPECT_FALSE(scaled.grid.is_small());
  EXPECT_EQ(direct<2>(scaled), Sign::zero);
  // One unit of the lift more breaks the tie.
  EXPECT_EQ(direct<0>(weighted(2, {0, 0, 0, s, 0, 9, s, s, 9 + s, 0, s, s + 1})), Sign::positive);
}

TEST(WeightedSphere, TwiceThePrecisionDecidesWhatWeightsCancel) {
  // Lifts of about 1e16 cancel but for one; the last bit of the coordinates decides.
  const double x = 1e8 / 3;
  RowCase c = weighted(1, {0, 0, x, x * x, 2 * x, std::nextafter(4 * x * x, 0)});
  EXPECT_EQ(detail::sphere_by_minors<1>(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
  EXPECT_EQ(detail::sphere_by_elimination<1>(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
  StageCounts counts;
  EXPECT_EQ(side<1>(c, counts), true_side_of_sphere(lifted_rows(c)));
  EXPECT_EQ(counts.direct, 1u);
}

TEST(WeightedSphere, DirectStagePassesOnWhatWeightsCancel) {
  // All lifts cancel but for one weight that no number of twice the precision has beside them.
  RowCase c = weighted(1, {0, 1e-60, 1, 1, 2, 4});
  EXPECT_EQ(direct<1>(c), std::nullopt);
  StageCounts counts;
  EXPECT_EQ(side<1>(c, counts), true_side_of_sphere(lifted_rows(c)));
  EXPECT_EQ(counts.exact, 1u);
}

TEST(WeightedSphere, WithoutDimensionTheHeavierPointWins) {
  StageCounts counts;
  const std::vector<int> no_axes;
  const auto compare = [&](double w, double w_q) {
    const std::vector<double> p{0.5, 7, w}, q{0.5, 7, w_q};
    Grid grid(2, true);
    grid.include(p.data());
    grid.include(q.data());
    const double* vertex = p.data();
    return in_sphere<0>(Flat{2, no_axes, RowForm::weighted_point}, &vertex, q.data(), grid, counts);
  };
  EXPECT_EQ(compare(1, 2), Sign::negative);
  EXPECT_EQ(compare(2, 1), Sign::positive);
  EXPECT_EQ(compare(3, 3), Sign::zero);
  EXPECT_EQ(compare(0, 0), Sign::zero);
  EXPECT_EQ(compare(-1e308, 1e308), Sign::negative);
  EXPECT_EQ(compare(1, std::nextafter(1, 2)), Sign::negative);
  EXPECT_EQ(compare(0, std::numeric_limits<double>::denorm_min()), Sign::negative);
}

TEST(WeightedSphere, WithTheCoordinatesOfAVertexTheHeavierPointWins) {
  for (int slot = 0; slot < 3; ++slot)
    for (const double difference : {1.0, -1.0, 0x1p-50, -0x1p-50}) {
      const std::vector<double> triangle{0.1, 0.2, 1, 2.3, 0.1, 1, 0.4, 3.7, 1};
      std::vector<double> rows = triangle;
      rows.insert(rows.end(), triangle.begin() + 3 * slot, triangle.begin() + 3 * slot + 2);
      rows.push_back(1 + difference);
      RowCase c = weighted(2, rows);
      StageCounts counts;
      EXPECT_EQ(side<2>(c, counts), difference > 0 ? Sign::negative : Sign::positive);
    }
}

/// Random weighted points of kinds that reach all stages; `kind` 0 … 9.
std::vector<double> random_rows(int ambient, int count, std::size_t kind, random::Generator& generator) {
  std::vector<double> all;
  const auto wide = [&](int range) {
    return std::ldexp(generator.uniform() - 0.5,
                      static_cast<int>(generator.below(static_cast<std::uint64_t>(2 * range))) - range);
  };
  for (int i = 0; i < count; ++i) {
    double square = 0;
    for (int j = 0; j < ambient; ++j) {
      double x = generator.uniform();
      if (kind == 1 || kind == 2 || kind == 5) x = std::floor(4 * x);
      if (kind == 3) x = 0.1 * std::floor(4 * x);
      if (kind == 4) x = 4e6 + 0.001 * std::floor(1000 * x);
      if (kind == 6) x = wide(40);
      if (kind == 7) x = wide(1000);
      if (kind == 9) x = std::ldexp(std::floor(4 * x), -535);
      square += x * x;
      all.push_back(x);
    }
    double w = generator.uniform() - 0.5;
    if (kind == 1 || kind == 9) w = std::floor(8 * w);
    if (kind == 2) w = square + std::floor(2 * w);  // lifts that are nearly constant: many ties
    if (kind == 3) w = 0.01 * std::floor(10 * w);
    if (kind == 4) w = square - 1e13 + std::floor(2 * w);
    if (kind == 5) w = std::ldexp(std::floor(8 * w), 300);
    if (kind == 6) w = wide(80);
    if (kind == 7) w = wide(1000);
    if (kind == 8)
      w = square + std::ldexp(w, -static_cast<int>(generator.below(60)));  // cancelled to a few bits
    if (kind == 9) w = std::ldexp(w, -1070);
    all.push_back(w);
  }
  return all;
}

template <int K>
void expect_agreement_with_integers(int d, StageCounts& counts) {
  random::Generator generator(static_cast<std::uint64_t>(100 + d));
  for (std::size_t round = 0; round < test::scaled_count(1000); ++round) {
    RowCase c = weighted(d, random_rows(d, d + 2, round % 10, generator));
    const test::Matrix lifted = lifted_rows(c);
    const Sign orientation_of_points = true_orientation_of(lifted);
    const auto sign = direct<K>(c);
    EXPECT_EQ(sign.value_or(exact(c)), exact(c)) << "kind " << round % 10;
    if (orientation_of_points == Sign::zero) continue;
    EXPECT_EQ(side<K>(c, counts), true_side_of_sphere(lifted)) << "d = " << d << ", kind " << round % 10;
  }
}

TEST(WeightedSphere, AllStagesAgreeWithExactIntegers) {
  StageCounts counts;
  expect_agreement_with_integers<1>(1, counts);
  expect_agreement_with_integers<2>(2, counts);
  expect_agreement_with_integers<3>(3, counts);
  expect_agreement_with_integers<4>(4, counts);
  expect_agreement_with_integers<0>(2, counts);
  expect_agreement_with_integers<0>(5, counts);
  EXPECT_GT(counts.direct, 4 * counts.exact) << "the bound does not even decide random points";
  EXPECT_GT(counts.exact, 0u);
}

TEST(WeightedSphere, InFlatsOfLowerDimensionToo) {
  random::Generator generator(5);
  for (std::size_t round = 0; round < test::scaled_count(1000); ++round) {
    // A plane of R^4 that is steep over the chosen axes: (u, v, 1000u + v, u − 3000v).
    const std::vector<double> plane = random_rows(2, 4, round % 4, generator);
    std::vector<double> all;
    for (std::size_t i = 0; i < plane.size(); i += 3) {
      const double u = std::floor(1024 * plane[i]), v = std::floor(1024 * plane[i + 1]);
      const double square = u * u + v * v + (1000 * u + v) * (1000 * u + v) + (u - 3000 * v) * (u - 3000 * v);
      all.insert(all.end(),
                 {u, v, 1000 * u + v, u - 3000 * v, round % 8 < 4 ? plane[i + 2] : square + plane[i + 2]});
    }
    RowCase c(RowForm::weighted_point, 4, all, {0, 1});
    const test::Matrix lifted = lifted_rows(c);
    if (true_orientation_of(lifted) == Sign::zero) continue;
    StageCounts counts;
    EXPECT_EQ(side<2>(c, counts), true_side_of_sphere(lifted)) << round;
    EXPECT_EQ(side<0>(c, counts), true_side_of_sphere(lifted)) << round;
  }
}

TEST(WeightedSphere, TheBoundCountsWhatWeightsCancelInShortColumns) {
  // The plane (u, v, 2^20·(u − v)) over (u, v), with one point far along the diagonal: two others are short
  // over the axes while their squares are as large as any, and weights cancel these to a few units in the
  // last place.
  random::Generator generator(12);
  int uncertain = 0;
  for (std::size_t round = 0; round < test::scaled_count(300); ++round) {
    std::vector<double> all;
    const auto near = [&] {
      return std::ldexp(static_cast<double>(1 + generator.below(std::uint64_t{1} << 32)), -32);
    };
    const auto add = [&](double u, double v) {
      const double x = std::ldexp(u - v, 20), square = u * u + v * v + x * x;
      const double units = static_cast<double>(generator.below(9)) - 4;
      all.insert(all.end(), {u, v, x, square + units * (std::nextafter(square, INFINITY) - square)});
    };
    add(0x1p20, 0x1p20);
    add(near(), 0);
    add(0, near());
    all.insert(all.end(), {0, 0, 0, 0});
    RowCase c(RowForm::weighted_point, 3, all, {0, 1});
    const auto sign = detail::sphere_by_elimination<2>(c.flat(), c.rows.data(), c.q(), c.grid);
    EXPECT_EQ(sign.value_or(exact(c)), exact(c));
    uncertain += !sign;
    EXPECT_EQ(direct<2>(c).value_or(exact(c)), exact(c));
    StageCounts counts;
    EXPECT_EQ(side<2>(c, counts), true_side_of_sphere(lifted_rows(c)));
  }
  EXPECT_GT(uncertain, 0);
}

TEST(WeightedSphere, EqualWeightsAreNoWeights) {
  random::Generator generator(6);
  for (std::size_t round = 0; round < test::scaled_count(500); ++round) {
    const std::vector<double> plain =
        random_rows(2, 4, round % 5, generator);  // R^3, by misreading the weight as a coordinate
    std::vector<double> with_weight;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      with_weight.push_back(plain[i]);
      if (i % 2 == 1) with_weight.push_back(0.1);
    }
    RowCase a(RowForm::point, 2, plain), b = weighted(2, with_weight);
    a.rows.resize(4), b.rows.resize(4);
    if (orientation<2>(a.flat(), a.rows.data(), a.grid) == Sign::zero) continue;
    StageCounts of_a, of_b;
    EXPECT_EQ(side<2>(a, of_a), side<2>(b, of_b));
    EXPECT_EQ(of_a.exact, of_b.exact);
  }
}

TEST(WeightedSphere, DoesNotDependOnTheOrderOfVerticesNorOnAConstantInTheWeights) {
  random::Generator generator(8);
  for (std::size_t round = 0; round < test::scaled_count(200); ++round) {
    const std::vector<double> all = random_rows(3, 5, 1, generator);
    std::vector<double> points, weights, raised;
    for (std::size_t i = 0; i < 5; ++i) {
      points.insert(points.end(), all.begin() + static_cast<int>(4 * i),
                    all.begin() + static_cast<int>(4 * i) + 3);
      weights.push_back(all[4 * i + 3]);
      raised.push_back(weights.back() + 1024);
    }
    const std::span<const double> q = std::span(points).subspan(12), p = std::span(points).first(12);
    if (delone::orientation(p, 3) == Sign::zero) continue;
    const auto first_weights = std::span<const double>(weights).first(4);
    const Side side = delone::in_power_sphere(p, first_weights, q, weights[4], 3);
    EXPECT_EQ(delone::in_power_sphere(p, std::span<const double>(raised).first(4), q, raised[4], 3), side);
    std::vector<double> turned(p.begin() + 3, p.end()),
        turned_weights(first_weights.begin() + 1, first_weights.end());
    turned.insert(turned.end(), p.begin(), p.begin() + 3);
    turned_weights.push_back(weights[0]);
    EXPECT_EQ(delone::in_power_sphere(turned, turned_weights, q, weights[4], 3), side);
    EXPECT_EQ(delone::in_power_sphere_perturbed(turned, turned_weights, q, weights[4], 3),
              delone::in_power_sphere_perturbed(p, first_weights, q, weights[4], 3));
  }
}

/// The perturbation carried out: the lifts of points of small integers get 2^(−60·rank), the largest point
/// the largest; equal points of different weight, equal ranks.
Sign side_by_numbers(const RowCase& c) {
  test::Matrix lifted = lifted_rows(c);
  std::set<std::vector<double>> coordinates;
  for (const double* row : c.rows) coordinates.insert(std::vector<double>(row, row + c.ambient));
  for (std::size_t i = 0; i < lifted.size(); ++i) {
    const auto place = coordinates.find(std::vector<double>(c.rows[i], c.rows[i] + c.ambient));
    const auto rank = static_cast<int>(std::distance(place, coordinates.end()));
    test::Integer& lift = lifted[i][lifted[i].size() - 2];
    lift = shifted(lift, 600) + shifted(1, 600 - 60 * rank);
  }
  return true_side_of_sphere(lifted);
}

template <int D>
void expect_perturbation_as_by_numbers() {
  random::Generator generator(static_cast<std::uint64_t>(D));
  int ties = 0;
  std::set<Sign> seen;
  for (std::size_t round = 0; round < test::scaled_count(1500); ++round) {
    RowCase c = weighted(D, random_rows(D, D + 2, 1 + round % 2, generator));
    if (true_orientation_of(lifted_rows(c)) == Sign::zero) continue;
    StageCounts counts;
    if (side<D>(c, counts) != Sign::zero) continue;
    if (std::any_of(c.rows.begin(), c.rows.end() - 1,
                    [&](const double* p) { return equal_points(p, c.q(), D + 1); }))
      continue;
    ++ties;
    const Sign sign = perturbed_in_sphere<D>(c.flat(), c.rows.data(), c.q(), c.grid);
    seen.insert(sign);
    EXPECT_EQ(sign, side_by_numbers(c));
    EXPECT_EQ(perturbed_in_sphere<0>(c.flat(), c.rows.data(), c.q(), c.grid), sign);
  }
  EXPECT_GT(ties, 5);
  EXPECT_EQ(seen, (std::set<Sign>{Sign::negative, Sign::positive}));
}

TEST(WeightedPerturbation, AgreesWithInfinitesimalsCarriedOut) {
  expect_perturbation_as_by_numbers<1>();
  expect_perturbation_as_by_numbers<2>();
  expect_perturbation_as_by_numbers<3>();
}

TEST(WeightedPerturbation, EveryBranch) {
  const auto perturbed = [](const RowCase& c) {
    return perturbed_in_sphere<1>(c.flat(), c.rows.data(), c.q(), c.grid);
  };
  // Three lifted points on a line: weights x² flatten the parabola.
  EXPECT_EQ(perturbed(weighted(1, {0, 0, 1, 1, 2, 4})), Sign::positive)
      << "q is the largest: hidden by none, but outside";
  EXPECT_EQ(perturbed(weighted(1, {0, 0, 2, 4, 1, 1})), Sign::negative)
      << "the vertex 2 is lifted, q is between";
  EXPECT_EQ(perturbed(weighted(1, {1, 1, 2, 4, 0, 0})), Sign::positive)
      << "the vertex 2 is lifted, q is beyond";
  // The largest vertex has coefficient 0: q is on the edge of the other two, of which the larger decides.
  const RowCase edge = weighted(2, {0, 0, 0, 2, 0, 4, 3, 1, 10, 1, 0, 1});
  ASSERT_EQ(exact(edge), Sign::zero);
  EXPECT_EQ(perturbed_in_sphere<2>(edge.flat(), edge.rows.data(), edge.q(), edge.grid), Sign::negative);
}

/// All cells of a regular triangulation by its definition, as sets of rows: every simplex that no other point
/// is in conflict with.
template <int D>
std::set<std::vector<int>> regular_cells(const std::vector<double>& all, const std::vector<int>& order) {
  const RowCase input = weighted(D, all);
  const int n = static_cast<int>(order.size());
  std::set<std::vector<int>> cells;
  for (unsigned subset = 0; subset < 1u << n; ++subset) {
    if (std::popcount(subset) != D + 1) continue;
    std::vector<int> cell;
    std::vector<const double*> vertices;
    for (int i = 0; i < n; ++i)
      if ((subset >> i & 1) != 0) {
        cell.push_back(order[static_cast<std::size_t>(i)]);
        vertices.push_back(input.rows[static_cast<std::size_t>(cell.back())]);
      }
    const Sign sign = kernel::orientation(input.flat(), vertices);
    if (sign == Sign::zero) continue;
    const bool stands = std::none_of(input.rows.begin(), input.rows.end(), [&](const double* q) {
      return kernel::in_sphere_perturbed(input.flat(), vertices, sign, q) == Sign::negative;
    });
    if (!stands) continue;
    std::sort(cell.begin(), cell.end());
    cells.insert(cell);
  }
  return cells;
}

/// d!·volume of all cells of a triangulation is that of the hull, and every facet has a cell on either side
/// or is on the hull.
template <int D>
void expect_triangulation(const std::vector<double>& all, const std::set<std::vector<int>>& cells) {
  const RowCase input = weighted(D, all);
  std::map<std::vector<int>, std::vector<int>> apexes;  // of the cells at each facet
  for (const auto& cell : cells)
    for (const int apex : cell) {
      std::vector<int> facet = cell;
      facet.erase(std::find(facet.begin(), facet.end(), apex));
      apexes[facet].push_back(apex);
    }
  for (const auto& [facet, opposite] : apexes) {
    std::vector<const double*> rows;
    for (const int v : facet) rows.push_back(input.rows[static_cast<std::size_t>(v)]);
    const double* const apex = input.rows[static_cast<std::size_t>(opposite[0])];
    const auto side_of = [&](int row) {
      return hull_side(input.flat(), rows, apex, input.rows[static_cast<std::size_t>(row)]);
    };
    ASSERT_LE(opposite.size(), 2u);
    if (opposite.size() == 2) {
      EXPECT_EQ(side_of(opposite[1]), Sign::negative);
      continue;
    }
    for (int row = 0; row < static_cast<int>(input.rows.size()); ++row)
      EXPECT_NE(side_of(row), Sign::negative);
  }
}

template <int D>
void expect_regular_triangulations() {
  random::Generator generator(static_cast<std::uint64_t>(40 + D));
  for (std::size_t round = 0; round < test::scaled_count(300); ++round) {
    const int n = D + 1 + static_cast<int>(generator.below(static_cast<std::uint64_t>(8 - D)));
    const std::vector<double> all = random_rows(D, n, round % 3, generator);
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    {  // equal rows would be one vertex
      std::set<std::vector<double>> rows;
      for (auto row = all.begin(); row != all.end(); row += D + 1)
        rows.insert(std::vector<double>(row, row + D + 1));
      if (rows.size() != order.size()) continue;
    }
    const auto cells = regular_cells<D>(all, order);
    expect_triangulation<D>(all, cells);
    for (int again = 0; again < 3; ++again) {
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[generator.below(i)]);
      EXPECT_EQ(regular_cells<D>(all, order), cells);
    }
  }
}

TEST(WeightedPerturbation, MakesOneRegularTriangulationInAnyOrder) {
  expect_regular_triangulations<1>();
  expect_regular_triangulations<2>();
  expect_regular_triangulations<3>();
}

}  // namespace
}  // namespace delone::kernel
