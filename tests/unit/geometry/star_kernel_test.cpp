// SPDX-License-Identifier: BSD-3-Clause
// The pencil's bound holds: |h̃ − h| ≤ its bound in exact rational arithmetic and no certified sign is wrong,
// for cells of all four kinds (made of finite and infinite cells in all combinations), in full dimension and
// in flats, with weights and without, and for hulls; on random, lattice and near-degenerate points,
// thresholds for single queries included.
#include "base/random.hpp"
#include "brute_force.hpp"
#include "engine/build.hpp"
#include "geometry/central_geometry.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "kernel/predicates.hpp"
#include "scale.hpp"

#include <delone/types.hpp>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace delone::geometry {
namespace {

using test::Integer;
using Rational = boost::multiprecision::cpp_rational;
using IntegerRow = std::vector<Integer>;

Integer integer(double x) { return Integer(static_cast<long long>(x)); }
Rational quotient(Integer numerator, Integer denominator) {
  if (denominator < 0) return {-numerator, -denominator};  // Boost 1.74 takes positive denominators only
  return {numerator, denominator};
}

enum class Shape { random, lattice, nudged_lattice, thin, surface };

/// Distinct points with integer coordinates, so many that half of them can be queries.
struct Sample {
  Shape shape;
  int k, ambient;  ///< the points are in a k-flat of R^ambient that projects one-to-one on the first k axes
  bool weighted;
  std::size_t n;

  std::string name() const {
    static constexpr const char* shapes[] = {"random", "lattice", "nudged lattice", "thin", "surface"};
    return std::string(shapes[static_cast<int>(shape)]) + (weighted ? ", weighted, " : ", ") +
           std::to_string(k) + "-flat of R^" + std::to_string(ambient);
  }

  /// One after the other, `ambient` coordinates and the weight if there is one. All are multiples of `unit`.
  std::vector<double> points(random::Generator& generator, int unit = 1) const {
    const auto below = [&](std::uint64_t bound) { return static_cast<std::int64_t>(generator.below(bound)); };
    std::vector<std::int64_t> slopes;
    for (int j = k; j < ambient; ++j)
      for (int i = 0; i <= k; ++i) slopes.push_back(below(7) - 3);
    const auto side = static_cast<std::uint64_t>(std::ceil(std::pow(1.5 * static_cast<double>(n), 1.0 / k)));
    std::vector<double> result;
    std::set<std::vector<std::int64_t>> seen;
    while (seen.size() < n) {
      std::vector<std::int64_t> x;
      for (int i = 0; i < k; ++i) {
        constexpr std::int64_t spacing = 1 << 24;
        if (shape == Shape::random) {
          x.push_back(below(1 << 26));
        } else if (shape ==
                   Shape::surface) {  // a parabola over the first coordinate: cells are flat, spheres large
          x.push_back(i + 1 < k || k == 1 ? below(1 << 26) : x[0] * (x[0] >> 13) >> 14);
        } else if (shape == Shape::thin) {  // the last coordinate is 2^20 times smaller
          x.push_back(below(i + 1 < k ? 1 << 26 : 1 << 6));
        } else {
          x.push_back(below(side) * spacing + (shape == Shape::nudged_lattice ? below(3) - 1 : 0));
        }
      }
      if (!seen.insert(x).second) continue;
      for (int j = k; j < ambient; ++j) {
        const std::int64_t* slope = slopes.data() + (j - k) * (k + 1);
        std::int64_t sum = slope[k] * 1000003;
        for (int i = 0; i < k; ++i) sum += slope[i] * x[static_cast<std::size_t>(i)];
        x.push_back(sum);
      }
      for (const std::int64_t entry : x) result.push_back(static_cast<double>(entry * unit));
      if (weighted)
        result.push_back(static_cast<double>(below(shape == Shape::lattice ? 3 : std::int64_t{1} << 44)));
    }
    return result;
  }
};

/// The affine function that vanishes at m given points of R^m, up to a factor: m coefficients and the
/// constant.
IntegerRow vanishing_at(const std::vector<const IntegerRow*>& points) {
  IntegerRow result;
  for (std::size_t column = 0; column <= points.size(); ++column) {
    test::Matrix minor;
    for (const IntegerRow* point : points) {
      minor.push_back(*point);
      minor.back().erase(minor.back().begin() + static_cast<std::ptrdiff_t>(column));
    }
    result.push_back(column % 2 == 0 ? test::determinant(minor) : Integer(-test::determinant(minor)));
  }
  return result;
}

Integer value_at(const IntegerRow& function, const IntegerRow& row) {
  Integer sum = 0;
  for (std::size_t j = 0; j < row.size(); ++j) sum += function[j] * row[j];
  return sum;
}

/// How many cells of what origin were tested: [A infinite][B infinite], or by elimination.
struct Tally {
  std::array<std::array<std::size_t, 2>, 2> cells{};
  std::size_t eliminated = 0, pairs = 0, certified = 0, certified_near = 0;
  std::size_t beyond_box = 0;  ///< values so large that their thresholds hold for their signs only
};

/// A geometry that remembers what each cell was made from.
template <class Base>
struct Recording : Base {
  using Base::Base;
  struct Origin {
    bool a_infinite = false, b_infinite = false, eliminated = true;
  };

  std::span<const std::uint32_t> create_star(Index v, const typename Base::Query& q,
                                             std::span<const HorizonFacet> facets) {
    for (const HorizonFacet& facet : facets) {
      if (origins.size() <= facet.created) origins.resize(2 * (facet.created + 1));
      origins[facet.created] = {this->is_infinite(facet.dead), this->is_infinite(facet.survivor), false};
    }
    const auto weak = Base::create_star(v, q, facets);
    for (const std::uint32_t i : weak) origins[facets[i].created].eliminated = true;
    return weak;
  }
  void count(Index cell, Tally& tally) const {
    const Origin origin = cell < origins.size() ? origins[cell] : Origin();
    ++(origin.eliminated ? tally.eliminated : tally.cells[origin.a_infinite][origin.b_infinite]);
  }

  std::vector<Origin> origins;
};

/// Compares what the filter says of a cell at a query with the truth: `numerator`/`denominator` is h up to a
/// positive factor, and h is `scale` times it. `exactly`: also the value, within its bound.
template <class G>
void expect_right(const G& geometry, const typename G::Query& q, Index cell, const Integer& numerator,
                  const Integer& denominator, double scale, bool exactly, Tally& tally) {
  const auto h = geometry.evaluator(q);
  double threshold;
  geometry.thresholds_at({&cell, 1}, q, &threshold);
  const double value = h.value(cell),
               error = threshold < h.threshold(cell) ? threshold : h.error(cell, value);
  threshold = std::min(threshold, h.threshold(cell));
  const Sign said = value < -threshold ? Sign::negative : value > threshold ? Sign::positive : Sign::zero;
  ++tally.pairs;
  if (said != Sign::zero) {
    ++tally.certified;
    tally.certified_near += std::fabs(value) <= h.threshold(cell);
    tally.beyond_box += h.threshold(cell) < std::fabs(value) && error > 1.25 * h.threshold(cell);
    ASSERT_EQ(said, test::sign_of(numerator) * test::sign_of(denominator)) << "cell " << cell;
  }
  if (exactly && std::isfinite(error)) {
    const Rational truth = quotient(numerator, denominator) * Rational(scale);
    ASSERT_LE(abs(Rational(value) - truth), Rational(error)) << "cell " << cell;
  }
}

/// Thresholds for a query do not depend on which cells are treated together.
template <class G>
void expect_same_thresholds_together(const G& geometry, const typename G::Query& q,
                                     const std::vector<Index>& cells, random::Generator& generator) {
  for (std::size_t first = 0; first < cells.size();) {
    const auto some =
        std::span(cells).subspan(first).first(std::min(cells.size() - first, 1 + generator.below(20)));
    std::vector<double> together(some.size());
    geometry.thresholds_at(some, q, together.data());
    for (std::size_t i = 0; i < some.size(); ++i) {
      double alone;
      geometry.thresholds_at(some.subspan(i, 1), q, &alone);
      ASSERT_EQ(together[i], alone) << "cell " << some[i];
    }
    first += some.size();
  }
}

/// The magnitude of the determinant of the edges between corners in the frame, without one coordinate of all,
/// if there is such.
Rational determinant_of_edges(const std::vector<IntegerRow>& corners, std::size_t left_out,
                              const Frame& frame, const std::vector<int>& axes) {
  test::Matrix edges;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    edges.emplace_back();
    for (std::size_t r = 0; r < axes.size(); ++r)
      if (r != left_out) edges.back().push_back(corners[i][r] - corners[0][r]);
  }
  Rational determinant(abs(test::determinant(edges)));
  for (std::size_t r = 0; r < axes.size(); ++r)
    if (r != left_out) determinant *= Rational(frame.extent_ratio(axes[r]) * frame.lift_scale());
  return determinant;
}

/// Triangulates the first half of a sample, and compares at all of its points.
template <int K>
void expect_right_triangulation(const Sample& sample, std::uint64_t seed, Tally& tally) {
  SCOPED_TRACE(sample.name() + ", seed " + std::to_string(seed));
  random::Generator generator(seed);
  const std::vector<double> all = sample.points(generator);
  const std::size_t size = static_cast<std::size_t>(sample.ambient) + (sample.weighted ? 1 : 0),
                    n = all.size() / size;
  std::vector<double> coordinates(size, 0.0),
      low(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(size)), high = low;
  coordinates.insert(coordinates.end(), all.begin(), all.end());
  kernel::Grid grid(sample.ambient, sample.weighted);
  for (std::size_t i = 0; i < n; ++i) {
    grid.include(all.data() + i * size);
    for (std::size_t j = 0; j < size; ++j) {
      low[j] = std::min(low[j], all[i * size + j]);
      high[j] = std::max(high[j], all[i * size + j]);
    }
  }
  std::vector<int> axes(K);
  std::iota(axes.begin(), axes.end(), 0);
  const Frame frame(low, high, sample.weighted ? kernel::RowForm::weighted_point : kernel::RowForm::point);
  engine::Build<K, Recording<DelaunayGeometry<K>>> build(K, cells::ids_for(n), axes, sample.ambient,
                                                         coordinates, grid, frame);
  engine::CellStore<K>& cells = build.cells();
  Recording<DelaunayGeometry<K>>& geometry = build.geometry();

  kernel::AffineHull hull(sample.ambient);
  std::vector<Index> simplex, others;
  for (Index v = 1; v <= n / 2; ++v) (hull.add(geometry.point(v)) ? simplex : others).push_back(v);
  ASSERT_EQ(hull.dimension(), K);
  if (geometry.orientation(simplex.data()) == Sign::negative) std::swap(simplex[0], simplex[1]);
  geometry.set_rows(static_cast<Index>(n));
  build.seed(simplex);
  for (const Index v : others) build.insert(v);

  std::vector<IntegerRow> rows;  // (axes, lift, 1)
  for (Index v = 0; v <= n; ++v) {
    const double* x = geometry.point(v);
    IntegerRow row;
    for (const int axis : axes) row.push_back(integer(x[axis]));
    Integer lift = sample.weighted ? Integer(-integer(x[sample.ambient])) : Integer(0);
    for (int j = 0; j < sample.ambient; ++j) lift += integer(x[j]) * integer(x[j]);
    row.push_back(lift);
    row.push_back(1);
    rows.push_back(std::move(row));
  }
  const auto without_lift = [](IntegerRow row) {
    row.erase(row.begin() + K);
    return row;
  };
  std::vector<Index> alive;
  for (Index cell = 0; cell < cells.num_slots(); ++cell)
    if (!cells.is_vacant(cell)) alive.push_back(cell);
  for (Index v = 1; v <= n; ++v)
    ASSERT_NO_FATAL_FAILURE(
        expect_same_thresholds_together(geometry, geometry.make_query(geometry.point(v)), alive, generator));
  for (const Index cell : alive) {
    geometry.count(cell, tally);
    const auto vertices = cells.vertices(cell);
    const int infinite_slot = cells.infinite_slot(cell);
    std::vector<IntegerRow> corners;
    for (int i = 0; i <= K; ++i)
      if (i != infinite_slot)
        corners.push_back(infinite_slot < 0 ? rows[vertices[i]] : without_lift(rows[vertices[i]]));
    std::vector<const IntegerRow*> pointers;
    for (const IntegerRow& corner : corners) pointers.push_back(&corner);
    const IntegerRow function = vanishing_at(pointers);
    Integer denominator;
    double scale;
    std::size_t normal = K;
    if (infinite_slot < 0) {
      denominator = function[K];
      scale = frame.lift_scale() * frame.lift_scale();
    } else {
      if (std::isinf(geometry.threshold(cell))) continue;  // too flat, and never certain
      const double* functional = build.memory().records().functional(cell);
      normal = static_cast<std::size_t>(
          std::find_if(functional, functional + K, [](double g) { return std::fabs(g) == 1; }) - functional);
      ASSERT_LT(normal, K);
      denominator = function[normal];
      if (functional[normal] < 0) denominator = -denominator;
      scale = frame.extent_ratio(axes[normal]) * frame.lift_scale();
    }
    ASSERT_LE(Rational(certificate::determinant(
                  std::bit_cast<std::uint64_t>(*build.memory().records().certificate(cell)))),
              determinant_of_edges(corners, normal, frame, axes))
        << "cell " << cell;
    for (Index v = 1; v <= n; ++v) {
      const auto q = geometry.make_query(geometry.point(v));
      const Integer numerator = value_at(function, infinite_slot < 0 ? rows[v] : without_lift(rows[v]));
      if (infinite_slot >= 0 && v <= n / 2) {
        ASSERT_GE(test::sign_of(numerator) * test::sign_of(denominator), Sign::zero);
      }
      ASSERT_NO_FATAL_FAILURE(
          expect_right(geometry, q, cell, numerator, denominator, scale, (cell + v) % 16 == 0, tally));
    }
  }
}

/// The same for the hull of points in full dimension or in a flat; K is the dimension of its cells.
template <int K>
void expect_right_hull(const Sample& sample, std::uint64_t seed, Tally& tally) {
  SCOPED_TRACE("hull, " + sample.name() + ", seed " + std::to_string(seed));
  random::Generator generator(seed);
  const std::vector<double> points =
      sample.points(generator, K + 2);  // so that the centre of K + 2 points is exact
  const auto size = static_cast<std::size_t>(sample.ambient);
  const auto n = static_cast<Index>(points.size() / size);
  std::vector<int> axes(K + 1);
  std::iota(axes.begin(), axes.end(), 0);
  kernel::Grid grid(sample.ambient);
  kernel::AffineHull hull(sample.ambient);
  std::vector<Index> simplex, others;
  std::vector<double> low(size, std::numeric_limits<double>::infinity()), high(size, -low[0]),
      center(size, 0.0);
  for (Index v = 1; v <= n; ++v) {
    const double* x = points.data() + (v - 1) * size;
    grid.include(x);
    if (v <= n / 2) (hull.add(x) ? simplex : others).push_back(v);
    for (std::size_t j = 0; j < size; ++j) {
      low[j] = std::min(low[j], x[j]);
      high[j] = std::max(high[j], x[j]);
    }
  }
  ASSERT_EQ(hull.dimension(), K + 1);
  for (const Index v : simplex)
    for (std::size_t j = 0; j < size; ++j) center[j] += points[(v - 1) * size + j] / (K + 2);
  grid.include(center.data());

  BoundarySites sites(sample.ambient);
  sites.coordinates = points;
  sites.axes = axes;
  CentralView view(grid);
  view.center = center;
  view.is_inside = true;
  for (const int axis : axes) {
    view.low.push_back(low[static_cast<std::size_t>(axis)]);
    view.high.push_back(high[static_cast<std::size_t>(axis)]);
  }
  engine::Build<K, Recording<CentralGeometry<K>>> build(K, cells::ids_for(n), sites, view, simplex);
  engine::CellStore<K>& cells = build.cells();
  Recording<CentralGeometry<K>>& geometry = build.geometry();
  geometry.update_box();
  const Index last = simplex.back();
  simplex.pop_back();
  StageCounts uncounted;
  if (geometry.side(simplex.data(), geometry.point(last), uncounted) == Sign::negative)
    std::swap(simplex[0], simplex[1]);
  build.seed(simplex, last);
  for (const Index v : others) build.insert(v);

  std::vector<IntegerRow> rows(1);  // (axes, 1)
  const auto append = [&](const double* x) {
    rows.emplace_back();
    for (const int axis : axes) rows.back().push_back(integer(x[axis]));
    rows.back().push_back(1);
  };
  for (Index v = 1; v <= n; ++v) append(geometry.point(v));
  append(center.data());
  for (Index cell = 0; cell < cells.num_slots(); ++cell) {
    if (cells.is_vacant(cell)) continue;
    geometry.count(cell, tally);
    std::vector<const IntegerRow*> corners;
    for (int i = 0; i <= K; ++i) corners.push_back(&rows[cells.vertex(cell, i)]);
    const IntegerRow function = vanishing_at(corners);
    const Integer denominator = value_at(function, rows.back());
    for (Index v = 1; v <= n; ++v) {
      const auto q = geometry.make_query(geometry.point(v));
      ASSERT_NO_FATAL_FAILURE(expect_right(geometry, q, cell, value_at(function, rows[v]), denominator, 1,
                                           (cell + v) % 16 == 0, tally));
    }
  }
}

constexpr Shape shapes[] = {Shape::random, Shape::lattice, Shape::nudged_lattice, Shape::thin,
                            Shape::surface};

template <int K>
void expect_right_triangulations(std::size_t n, std::size_t rounds) {
  std::size_t certified_near = 0, beyond_box = 0;
  for (const int ambient : {K, K + 1, K + 3})
    for (const bool weighted : {false, true}) {
      Tally tally;
      for (const Shape shape : shapes)
        for (std::uint64_t seed = 0; seed < test::scaled_count(rounds); ++seed)
          expect_right_triangulation<K>({shape, K, ambient, weighted, n}, seed, tally);
      // There were cells of all origins, and the filter decided.
      for (const bool a_infinite : {false, true})
        for (const bool b_infinite : {false, true})
          EXPECT_GT(tally.cells[a_infinite][b_infinite], 0u)
              << K << "-flat of R^" << ambient << ": A infinite " << a_infinite << ", B infinite "
              << b_infinite;
      EXPECT_GT(tally.certified, tally.pairs / 2);
      certified_near += tally.certified_near;
      beyond_box += tally.beyond_box;
    }
  EXPECT_GT(certified_near, 0u);
  if constexpr (K <= 4) {
    EXPECT_GT(beyond_box, 0u);
  }
}

TEST(Pencil, KeepsItsBoundInThePlaneAndInPlanes) { expect_right_triangulations<2>(80, 3); }
TEST(Pencil, KeepsItsBoundInSpaceAndInFlatsOfThreeDimensions) {
  expect_right_triangulations<3>(test::scaled_size(60, 36), 2);
}
TEST(Pencil, KeepsItsBoundInFourDimensions) { expect_right_triangulations<4>(test::scaled_size(36, 24), 1); }
TEST(Pencil, KeepsItsBoundInFiveDimensions) { expect_right_triangulations<5>(test::scaled_size(34, 20), 1); }
TEST(Pencil, KeepsItsBoundInSixDimensions) { expect_right_triangulations<6>(test::scaled_size(28, 18), 1); }
TEST(Pencil, KeepsItsBoundInSevenDimensions) { expect_right_triangulations<7>(test::scaled_size(28, 24), 1); }

template <int K>
void expect_right_hulls(std::size_t n, std::size_t rounds) {
  for (const int ambient : {K + 1, K + 3}) {
    Tally tally;
    for (const Shape shape : shapes)
      for (std::uint64_t seed = 0; seed < test::scaled_count(rounds); ++seed)
        expect_right_hull<K>({shape, K + 1, ambient, false, n}, seed, tally);
    EXPECT_GT(tally.cells[0][0], 0u);
    EXPECT_GT(tally.certified, tally.pairs / 2);
  }
}

TEST(Pencil, KeepsItsBoundOnHulls) {
  expect_right_hulls<2>(100, 5);
  expect_right_hulls<3>(60, 3);
}

}  // namespace
}  // namespace delone::geometry
