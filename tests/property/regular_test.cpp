// SPDX-License-Identifier: BSD-3-Clause
// Regular triangulations: against the definition in exact integers, against Delaunay for equal weights, in
// any order of insertion. Weights are small integers on lattices (many hidden points, many ties), negative,
// huge, tiny, or all of them.
#include "brute_force.hpp"
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/regular.hpp>
#include <delone/voronoi.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace delone {
namespace {

using test::BruteForce;
using test::PointSet;
using test::Random;
using test::sorted_cells;

struct WeightedSet {
  PointSet set;
  std::vector<double> weights;
};

enum class Weights { equal, few_integers, reals, negative, wide, heavy_one, nudged };
constexpr Weights all_weights[] = {Weights::equal, Weights::few_integers, Weights::reals, Weights::negative,
                                   Weights::wide,  Weights::heavy_one,    Weights::nudged};

/// Weights for points whose extent is about `scale`.
std::vector<double> make_weights(Weights kind, std::size_t n, double scale, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> weights;
  for (std::size_t i = 0; i < n; ++i) {
    double w = 0;
    if (kind == Weights::equal) w = -3.7;
    if (kind == Weights::few_integers) w = random.integer(0, 3);
    if (kind == Weights::reals) w = random.real() * scale * scale / 4;
    if (kind == Weights::negative) w = -std::floor(random.real() * 5) * scale;
    if (kind == Weights::wide) w = std::ldexp(random.real() - 0.5, random.integer(-1000, 1000));
    if (kind == Weights::heavy_one) w = i == n / 2 ? 1e300 : 1e-300 * random.integer(0, 2);
    if (kind == Weights::nudged) w = random.integer(0, 1) == 1 ? std::nextafter(1.0, 2.0) : 1.0;
    weights.push_back(w);
  }
  return weights;
}

std::string describe(const WeightedSet& s) {
  std::string text = s.set.name + "\n" + test::to_text(s.set.points, s.set.dimension) + "weights:";
  for (std::size_t i = 0; i < std::min<std::size_t>(s.weights.size(), 40); ++i) {
    char number[40];
    std::snprintf(number, sizeof number, " %.17g", s.weights[i]);
    text += number;
  }
  return text;
}

/// The triangulation, what it says of hidden points, and what check() says of it, against the definition.
void expect_definition(const WeightedSet& s) {
  const int d = s.set.dimension;
  const BruteForce oracle(s.set.points, d, {}, s.weights);
  const ComplexData expected = oracle.to_data();
  const Regular<> t(s.set.points, s.weights, d);
  const ComplexData data = t.to_data();
  ASSERT_EQ(t.affine_dimension(), oracle.affine_dimension()) << describe(s);
  ASSERT_TRUE(test::same_cells(sorted_cells(expected), sorted_cells(data))) << describe(s);
  EXPECT_EQ(data.vertex_of_point, expected.vertex_of_point) << describe(s);
  EXPECT_EQ(data.weights, s.weights);
  EXPECT_EQ(data.points, s.set.points);
  EXPECT_EQ(t.hash(), canonical_hash(data));
  EXPECT_EQ(t.hash(), canonical_hash(expected));

  const CheckReport report = check(data, {.canonical = true});
  EXPECT_TRUE(report.ok) << report.violation << describe(s);

  const std::set<SignedIndex> visible(expected.cells.begin(), expected.cells.end());
  std::size_t hidden = 0;
  for (std::size_t row = 0; row < s.set.size(); ++row) {
    const bool is_hidden = !visible.contains(oracle.first_row(static_cast<SignedIndex>(row)));
    hidden += is_hidden;
    EXPECT_EQ(t.is_hidden(row), is_hidden) << row << describe(s);
    EXPECT_EQ(t.vertex_at(row) == invalid_vertex, is_hidden);
    if (!is_hidden) {
      EXPECT_EQ(t.weight(t.vertex_at(row)), s.weights[row]);
      continue;
    }
    const CellId cell = t.hiding_cell(row);
    BruteForce::Rows simplex;
    for (const VertexId v : t.vertices(cell)) simplex.push_back(static_cast<SignedIndex>(t.row_of(v)));
    EXPECT_FALSE(oracle.in_conflict(simplex, static_cast<SignedIndex>(row)));
    for (const Sign sign : oracle.barycentric_signs(simplex, static_cast<SignedIndex>(row)))
      EXPECT_NE(sign, Sign::negative);
    const std::span<const double> point =
        std::span(s.set.points).subspan(row * static_cast<std::size_t>(d), static_cast<std::size_t>(d));
    EXPECT_EQ(t.in_power_sphere(cell, point, s.weights[row]),
              oracle.side_of_sphere(simplex, static_cast<SignedIndex>(row)));
    EXPECT_TRUE(t.conflict_zone(point, s.weights[row]).empty());
  }
  EXPECT_EQ(t.num_hidden(), hidden);
  EXPECT_EQ(t.hidden_rows().size(), hidden);
  EXPECT_EQ(t.num_points(), t.num_vertices() + t.num_duplicates() + t.num_hidden());
  EXPECT_EQ(t.num_vertices(), visible.size());
  EXPECT_EQ(t.complex().finite_vertices().size(), visible.size());
}

/// One by one, every insertion checked against the predicted conflict zone; a heavier copy of a vertex
/// swallows it.
void expect_same_one_by_one(const WeightedSet& s, const std::vector<std::size_t>& order) {
  const auto d = static_cast<std::size_t>(s.set.dimension);
  const Regular<> batch(s.set.points, s.weights, s.set.dimension);
  Regular<> t(s.set.dimension);
  for (const std::size_t row : order) {
    const std::span<const double> point = std::span(s.set.points).subspan(row * d, d);
    const bool in_flat = t.affine_dimension() == s.set.dimension;
    const auto zone = in_flat ? t.conflict_zone(point, s.weights[row]) : std::vector<CellId>{};
    const InsertResult result = t.insert(point, s.weights[row]);
    if (in_flat) {
      ASSERT_EQ(result.inserted, !zone.empty()) << describe(s);
    }
    if (result.vertex != invalid_vertex) {
      ASSERT_EQ(t.weight(result.vertex), s.weights[row]);
    }
  }
  EXPECT_EQ(t.hash(), batch.hash()) << describe(s);
  EXPECT_EQ(t.num_hidden(), batch.num_hidden());
  EXPECT_EQ(t.num_vertices(), batch.num_vertices());
  EXPECT_EQ(t.num_duplicates(), batch.num_duplicates());
  EXPECT_EQ(t.complex().finite_vertices().size(), t.num_vertices());
  for (const VertexId v : t.complex().finite_vertices())
    EXPECT_GE(t.complex().index_of(t.complex().incident_cell(v), v), 0);
  const CheckReport report = check(t.to_data(), {.canonical = true});
  EXPECT_TRUE(report.ok) << report.violation << describe(s);
}

TEST(Regular, FollowsTheDefinition) {
  for (int d = 1; d <= 4; ++d)
    for (std::uint64_t seed = 0; seed < test::scaled_count(6); ++seed)
      for (const Weights kind : all_weights) {
        const std::size_t n = d < 4 ? 12 : 10;
        for (const PointSet& set :
             {test::small_integers(d, n, 0, 2, seed), test::mixed_exponents(d, n - 2, -3, 3, seed + 7),
              test::embedded(test::small_integers(std::max(d - 1, 1), n, 0, 3, seed), d, true, seed)})
          expect_definition({set, make_weights(kind, set.size(), 2, seed + 100)});
      }
}

TEST(Regular, FollowsTheDefinitionAtTheEndsOfTheRange) {
  for (int d = 1; d <= 3; ++d)
    for (std::uint64_t seed = 0; seed < test::scaled_count(2); ++seed)
      for (const double scale : {1e150, 1e-150, 1e300, 0x1p-1070}) {
        const PointSet set = test::scaled(test::small_integers(d, 10, -2, 2, seed), scale);
        for (const Weights kind : all_weights)
          expect_definition({set, make_weights(kind, set.size(), 1, seed)});
        // Weights of the size of the squares, where these are doubles.
        expect_definition({set, make_weights(Weights::reals, set.size(), std::min(scale, 1e150), seed)});
        std::vector<double> extremes;
        for (std::size_t i = 0; i < set.size(); ++i)
          extremes.push_back((i % 2 == 0 ? 1 : -1) * std::numeric_limits<double>::max());
        expect_definition({set, extremes});
      }
}

// Squares of coordinates are nothing in a frame of such weights.
TEST(Regular, FollowsTheDefinitionAmongWeightsFarBeyondTheCoordinates) {
  for (int d = 1; d <= 3; ++d)
    for (std::uint64_t seed = 0; seed < test::scaled_count(d == 1 ? 40 : 5); ++seed) {
      const PointSet set = test::mixed_exponents(d, 9, -4, 0, seed);
      std::vector<double> weights = make_weights(Weights::reals, set.size(), 1, seed);
      weights[1] = -std::numeric_limits<double>::max() / static_cast<double>(1 + seed % 3);
      weights[2] = -std::ldexp(1.0, 900 + static_cast<int>(3 * seed));
      expect_definition({set, weights});
    }
  const std::vector<double> points = {0x1.898684cc094adp-3, 0x1.98ddaa130092ep-4, 0x1.73cf631cd6f05p-2,
                                      0x1.6683a2f491bcdp-2, 0x1.81cebfb1d5b04p-3, 0x1.53198fcd46556p-3,
                                      0x1.ea0dd1fabfe8dp-1};
  const std::vector<double> weights = {0,         -0x1.7e43c8800759cp+996, 1, 1, 0x1.895309a9d3cacp-5,
                                       -1.79e308, 0x1.1466a1092c8ap-2};
  for (const InsertionOrder order : {InsertionOrder::automatic, InsertionOrder::as_given})
    EXPECT_EQ(Regular<1>(points, weights, {.order = order}).hidden_rows(), (std::vector<std::size_t>{0, 5}));
}

TEST(Regular, EqualWeightsGiveDelaunay) {
  for (int d = 1; d <= 6; ++d) {
    const PointSet random = test::mixed_exponents(d, 60, -4, 0, 3), lattice = test::lattice(d, d < 4 ? 4 : 2);
    for (const PointSet& set : {random, lattice})
      for (const double weight : {0.0, -0.0, 1.0, -1e300, 1e-310}) {
        const std::vector<double> weights(set.size(), weight);
        const Regular<> t(set.points, weights, d);
        EXPECT_EQ(t.hash(), Delaunay<>(set.points, d).hash()) << set.name;
        EXPECT_EQ(t.num_hidden(), 0u);
      }
  }
}

TEST(Regular, DoesNotDependOnTheOrder) {
  for (int d = 1; d <= 4; ++d)
    for (const Weights kind : all_weights)
      for (std::uint64_t seed = 0; seed < test::scaled_count(3); ++seed) {
        const PointSet set =
            seed % 2 == 0 ? test::lattice(d, d < 3 ? 5 : 3) : test::small_integers(d, 60, 0, 3, seed);
        const WeightedSet s{set, make_weights(kind, set.size(), 2, seed)};
        expect_same_one_by_one(s, test::random_order(set.size(), seed));
        const auto hash = Regular<>(set.points, s.weights, d).hash();
        for (const InsertionOrder order : {InsertionOrder::as_given, InsertionOrder::shuffled}) {
          const Regular<> other(set.points, s.weights, d,
                                {.seed = seed + 5, .order = order, .force_runtime_dimension = true});
          EXPECT_EQ(other.hash(), hash) << describe(s);
        }
      }
}

TEST(Regular, ManyWeightedPointsPassTheCheck) {
  for (int d = 2; d <= 5; ++d) {
    const std::size_t n = d < 4 ? 1500 : 300;
    Random random(static_cast<std::uint64_t>(d));
    PointSet set{"uniform", d, {}};
    for (std::size_t i = 0; i < n * static_cast<std::size_t>(d); ++i) set.points.push_back(random.real());
    for (const double largest : {1e-3, 0.05, 1.0}) {
      std::vector<double> weights;
      for (std::size_t i = 0; i < n; ++i) weights.push_back(random.real() * largest);
      const Regular<> t(set.points, weights, d);
      const CheckReport report = check(t.to_data(), {.canonical = true});
      EXPECT_TRUE(report.ok) << report.violation;
      // The cached functionals serve weights: nearly all tests are theirs.
      EXPECT_LT(t.statistics().direct + t.statistics().exact,
                t.statistics().filter / 20 + 50 * static_cast<unsigned>(d))
          << d << ' ' << largest;
      expect_same_one_by_one({set, weights}, test::random_order(n, 1));
    }
  }
}

TEST(Regular, TheHeaviestOfSeveralPointsInOnePlaceIsTheVertex) {
  Regular<> t(2);
  const std::vector<double> p{1, 2};
  EXPECT_TRUE(t.insert(p, 1).inserted);
  EXPECT_EQ(t.affine_dimension(), 0);
  EXPECT_FALSE(t.insert(p, 1).inserted);
  EXPECT_EQ(t.insert(p, 0.5).vertex, invalid_vertex);
  EXPECT_EQ(t.conflict_zone(p, 2.0).size(), 1u);
  EXPECT_EQ(t.in_power_sphere(CellId{0}, p, 2.0), Side::inside);
  const InsertResult heavier = t.insert(p, 2);
  EXPECT_TRUE(heavier.inserted);
  EXPECT_EQ(t.weight(heavier.vertex), 2);
  EXPECT_EQ(t.num_vertices(), 1u);
  EXPECT_EQ(t.num_hidden(), 3u);  // the duplicate of a hidden point is hidden
  EXPECT_EQ(t.vertex_at(0), invalid_vertex);
  EXPECT_EQ(t.vertex_at(3), heavier.vertex);
  EXPECT_EQ(t.hiding_cell(2), CellId{0});
  const std::vector<double> more{3, 2, 1, 4, 1, 2}, weights{0, 0, 1.5};
  t.insert_range(more, weights);
  EXPECT_EQ(t.affine_dimension(), 2);
  EXPECT_EQ(t.num_vertices(), 3u);
  EXPECT_EQ(t.num_hidden(), 4u);
  EXPECT_EQ(t.row_of(heavier.vertex), 3u);
  EXPECT_THROW(static_cast<void>(t.point(VertexId{1})), Error);
  EXPECT_TRUE(check(t.to_data()).ok);
  EXPECT_EQ(PowerDiagram(t).num_regions(), 3u);
}

// Hidden points have ids, too: few cells, but vertices that cells with short ids cannot name.
TEST(Regular, VerticesAfterManyHiddenPointsAreLikeOthers) {
  constexpr std::size_t num_hidden = 66'000;
  for (const int d : {4, 5, 6}) {
    SCOPED_TRACE(testing::Message() << "dimension " << d);
    const auto k = static_cast<std::size_t>(d);
    Random random(static_cast<std::uint64_t>(d));
    std::vector<double> visible, light;
    for (std::size_t i = 0; i < 40 * k; ++i) {  // a simplex first, which has all others inside
      const bool is_of_simplex = i < (k + 1) * k;
      visible.push_back(is_of_simplex ? (i / k == i % k + 1 ? 10.0 : 0.0) : random.real());
    }
    for (std::size_t i = 0; i < num_hidden * k; ++i) light.push_back(0.4 + 0.2 * random.real());
    const std::vector<double> no_weights(40, 0.0), light_weights(num_hidden, -100.0);
    const auto hash = Regular<>(visible, no_weights, d).hash();

    Regular<> t(d);
    const std::size_t first = 20 * k;
    t.insert_range(std::span(visible.data(), first), {no_weights.data(), 20});
    t.insert_range(light, light_weights);
    ASSERT_EQ(t.num_hidden(), num_hidden);
    t.insert_range(std::span(visible.data() + first, first), {no_weights.data(), 20});
    EXPECT_EQ(t.num_hidden(), num_hidden);
    EXPECT_EQ(t.hash(), hash);
    EXPECT_GT(index(t.vertex_at(num_hidden + 30)), 65'600u);
    t.compact();
    EXPECT_EQ(t.hash(), hash);

    // One by one, and with ids that were long before a batch came.
    Regular<> online(d);
    online.insert_range(std::span(visible.data(), first), {no_weights.data(), 20});
    online.insert_range(light, light_weights);
    for (std::size_t i = 20; i < 30; ++i) online.insert(std::span(visible.data() + i * k, k), 0.0);
    online.compact();
    online.insert_range(std::span(visible.data() + 30 * k, 10 * k), {no_weights.data(), 10});
    EXPECT_EQ(online.hash(), hash);
    const CheckReport report = check(online.to_data(), {.canonical = true});
    EXPECT_TRUE(report.ok) << report.violation;
  }
}

TEST(Regular, BadInputIsRefused) {
  const std::vector<double> points{0, 0, 1, 0}, one{1};
  const std::vector<double> nan{0, std::nan("")};
  EXPECT_THROW(Regular<>(points, one, 2), Error);
  EXPECT_THROW(Regular<>(points, {}, 2), Error);
  EXPECT_THROW(Regular<>(0), Error);
  try {
    Regular<>(points, nan, 2);
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Errc::not_finite);
    EXPECT_EQ(e.rows(), (std::vector<std::size_t>{1}));
  }
}

TEST(Regular, CompiledDimensions) {
  const std::vector<std::array<double, 3>> points{
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.2, 0.2}};
  const std::vector<double> weights{0, 0, 0, 0, -1};
  const Regular<3> t(points, weights);
  EXPECT_EQ(t.num_finite_cells(), 1u);
  EXPECT_TRUE(t.is_hidden(4));
}

// What check() must find.
TEST(Regular, CheckFindsWhatIsWrong) {
  const std::vector<double> points{0, 0, 4, 0, 0, 4, 4, 4, 1, 1, 1, 1};
  const Regular<> t(points, std::vector<double>{0, 0, 0, 0, -9, -9}, 2);
  const ComplexData good = t.to_data();
  ASSERT_EQ(t.num_hidden(), 2u);
  ASSERT_TRUE(check(good).ok);
  const auto violated = [](const ComplexData& data) { return check(data).reached.name; };
  ComplexData bad = good;
  bad.weights[4] = 5;  // not hidden any more
  EXPECT_FALSE(check(bad).ok);
  EXPECT_EQ(violated(bad), "completeness");
  bad = good;
  bad.vertex_of_point[4] = 0;
  EXPECT_FALSE(check(bad).ok);
  bad = good;
  bad.points[8] = 9;  // outside the hull
  EXPECT_FALSE(check(bad).ok);
  bad = good;
  bad.weights[0] = -1e3;  // the diagonal flips, or vertex 0 does
  bad.weights[3] = 1;
  EXPECT_EQ(check(bad).ok, Regular<>(points, bad.weights, 2).hash() == canonical_hash(bad));
  bad = good;
  bad.weights.pop_back();
  EXPECT_FALSE(check(bad).ok);
  bad = good;
  bad.weights[1] = std::nan("");
  EXPECT_FALSE(check(bad).ok);
}

}  // namespace
}  // namespace delone
