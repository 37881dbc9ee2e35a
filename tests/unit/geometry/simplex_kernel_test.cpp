// SPDX-License-Identifier: BSD-3-Clause
// What the SIMD kernel certifies of simplices is true in exact arithmetic, for the rounded images and for the
// points themselves; and the thresholds of their functionals bound the true error.
#include "geometry/simplex_kernel.hpp"

#include "base/random.hpp"
#include "brute_force.hpp"
#include "geometry/functionals.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace delone::geometry {
namespace {

using test::Integer;
using Rational = boost::multiprecision::cpp_rational;
using IntegerRow = std::vector<Integer>;
using Point = std::vector<double>;

/// All coordinates are multiples of 2^−bits.
constexpr int bits = 90;
double rounded(double x) { return std::ldexp(std::nearbyint(std::ldexp(x, bits)), -bits); }
Integer units(double x) {
  int exponent;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int shift = exponent - 53 + bits;
  return shift >= 0 ? Integer(Integer(mantissa) << shift)
                    : Integer(mantissa / (std::int64_t{1} << std::min(-shift, 62)));
}
Rational quotient(Integer numerator, Integer denominator) {
  if (denominator < 0) return {-numerator, -denominator};  // Boost 1.74 takes positive denominators only
  return {numerator, denominator};
}

enum class Shape { random, flat, nearly_flat, lattice, thin, small };
constexpr Shape shapes[] = {Shape::random,  Shape::flat, Shape::nearly_flat,
                            Shape::lattice, Shape::thin, Shape::small};

/// A frame with points in its box. Either images are exact, or, of points near the lower bounds, rounded.
struct Sample {
  Sample(int dimension, bool is_centered)
      : k(dimension), centered(is_centered), low(k_size()), high(k_size()) {
    for (std::size_t j = 0; j < k_size(); ++j) {
      const double extent = centered ? 1 : std::ldexp(1.0, -static_cast<int>(j % 3));
      high[j] = extent * (1 - 0x1p-40) * (centered ? 1 : 2);
      low[j] = centered ? -high[j] : 0;
    }
    frame = Frame(low, high);
    for (int j = 0; j < k; ++j)
      center.push_back(low[static_cast<std::size_t>(j)] / 2 + high[static_cast<std::size_t>(j)] / 2);
    append(Point(center));  // vertex 0, not used
  }
  std::size_t k_size() const { return static_cast<std::size_t>(k); }

  /// A point of the box whose coordinates along each axis are in [0, 1] of its extents.
  Point in_box(const Point& fractions) const {
    Point x;
    for (std::size_t j = 0; j < k_size(); ++j)
      x.push_back(std::clamp(rounded(low[j] + (high[j] - low[j]) * fractions[j]), low[j], high[j]));
    return x;
  }
  Point random_point(random::Generator& generator) const {
    Point fractions(k_size());
    for (double& c : fractions) c = generator.uniform();
    return in_box(fractions);
  }
  void append(Point x) {
    points.push_back(std::move(x));
    for (int j = 0; j < k; ++j) rows.push_back(frame.image(points.back().data(), j));
    rows.push_back(frame.lift(points.back().data()));
  }
  Index last() const { return static_cast<Index>(points.size() - 1); }

  /// Appends the vertices of a simplex.
  void append_simplex(Shape shape, random::Generator& generator) {
    const std::size_t first = points.size();
    const Point base = random_point(generator);
    const double size = std::pow(10.0, -1.0 - static_cast<double>(generator.below(7)));
    // Not centred, lattices are near the lower bounds, where images are rounded.
    const double spacing =
        centered ? 0x1p-4 : 0x1p-60 * static_cast<double>((1 << 30) + 1 + 2 * generator.below(1000));
    for (int i = 0; i <= k; ++i) {
      Point x = random_point(generator);
      if (shape == Shape::small)
        for (std::size_t j = 0; j < k_size(); ++j) x[j] = rounded(base[j] + size * (x[j] - base[j]));
      if (shape == Shape::thin) x[0] = rounded(base[0] + size * size * (x[0] - base[0]));
      if (shape == Shape::lattice || shape == Shape::flat)
        for (double& c : x) c = spacing * static_cast<double>(generator.below(shape == Shape::flat ? 8 : 4));
      append(x);
    }
    Point x(k_size());
    if (shape == Shape::flat) {  // the last is in the plane of the others
      for (std::size_t j = 0; j < k_size(); ++j) {
        const double sum = points[first][j] + points[first + 1][j];
        if (k > 2) points[first + 2][j] = std::min(points[first + 2][j], sum);
        x[j] = k > 2 ? sum - points[first + 2][j] : sum / 2;
      }
    } else if (shape == Shape::nearly_flat) {
      double sum = 0;
      for (int i = 0; i < k; ++i) {
        const double weight = 0.1 + generator.uniform();
        for (std::size_t j = 0; j < k_size(); ++j)
          x[j] += weight * points[first + static_cast<std::size_t>(i)][j];
        sum += weight;
      }
      const double height = std::pow(10.0, -static_cast<double>(generator.below(17)));
      for (std::size_t j = 0; j < k_size(); ++j)
        x[j] = std::clamp(rounded(x[j] / sum + height * (generator.uniform() - 0.5)), low[j], high[j]);
    } else {
      return;
    }
    const std::vector<Point> corners(points.begin() + static_cast<std::ptrdiff_t>(first), points.end() - 1);
    points.resize(first);
    rows.resize(first * (k_size() + 1));
    for (const Point& corner : corners) append(corner);
    append(x);
    for (std::size_t i = points.size() - 1; i > first;
         --i)  // the one in the plane of the others may be any of them
      if (const std::size_t j = first + generator.below(i - first + 1); j != i) {
        std::swap(points[i], points[j]);
        std::swap_ranges(rows.begin() + static_cast<std::ptrdiff_t>(i * (k_size() + 1)),
                         rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * (k_size() + 1)),
                         rows.begin() + static_cast<std::ptrdiff_t>(j * (k_size() + 1)));
      }
  }

  /// The exact image of a vertex, in units, and 1.
  IntegerRow image(Index v) const {
    IntegerRow row;
    for (std::size_t j = 0; j < k_size(); ++j)
      row.push_back((units(points[v][j]) - units(center[j])) *
                    Integer(static_cast<long long>(scale(static_cast<int>(j)))));
    row.push_back(Integer(1) << bits);
    return row;
  }
  /// Its exact lift, in squares of units.
  Integer lift(Index v) const {
    Integer sum = 0;
    for (std::size_t j = 0; j < k_size(); ++j) {
      const Integer c =
          (units(points[v][j]) - units(center[j])) * Integer(static_cast<long long>(frame.lift_scale()));
      sum += c * c;
    }
    return sum;
  }
  /// The image of a vertex as rounded.
  IntegerRow rounded_image(Index v) const {
    IntegerRow row;
    for (std::size_t j = 0; j < k_size(); ++j) row.push_back(units(rows[v * (k_size() + 1) + j]));
    row.push_back(Integer(1) << bits);
    return row;
  }
  double scale(int axis) const { return std::ldexp(1.0, frame.scale_exponent(axis)); }

  int k;
  bool centered;
  Point low, high, center;
  Frame frame;
  std::vector<Point> points;  // of vertices
  std::vector<double> rows;
};

/// The barycentric coordinates of a simplex, without error.
struct Exact {
  /// `corners`: homogeneous.
  explicit Exact(const test::Matrix& corners) : determinant(test::determinant(corners)) {
    if (determinant == 0) return;
    // The inverse, times the determinant: elimination without fractions, above pivots as well.
    const std::size_t n = corners.size();
    test::Matrix a = corners;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) a[i].push_back(i == j ? 1 : 0);
    Integer previous = 1;
    for (std::size_t p = 0; p < n; ++p) {
      std::size_t pivot = p;
      while (a[pivot][p] == 0) ++pivot;
      if (pivot != p) {
        std::swap(a[pivot], a[p]);
        for (Integer& entry : a[p]) entry = -entry;
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (i == p) continue;
        const Integer times = a[i][p];
        for (std::size_t j = 0; j < 2 * n; ++j)
          a[i][j] = Integer(a[i][j] * a[p][p] - times * a[p][j]) / previous;
      }
      previous = a[p][p];
    }
    for (std::size_t i = 0; i < n; ++i)
      inverse.emplace_back(a[i].begin() + static_cast<std::ptrdiff_t>(n), a[i].end());
  }
  /// Times the determinant; x is homogeneous.
  Integer coordinate(std::size_t i, const IntegerRow& x) const {
    Integer sum = 0;
    for (std::size_t r = 0; r < x.size(); ++r) sum += inverse[r][i] * x[r];
    return sum;
  }
  /// The largest Σ|barycentric coordinates| at the corners of the box.
  Rational spread() const {
    const std::size_t k = inverse.size() - 1;
    IntegerRow x(k + 1, Integer(1) << bits);
    Integer largest = 0;
    for (std::size_t corner = 0; corner < std::size_t{1} << k; ++corner) {
      for (std::size_t r = 0; r < k; ++r) x[r] = (corner >> r & 1) != 0 ? x[k] : Integer(-x[k]);
      Integer sum = 0;
      for (std::size_t i = 0; i <= k; ++i) sum += abs(coordinate(i, x));
      largest = std::max(largest, sum);
    }
    return quotient(largest, abs(determinant));
  }

  Integer determinant;
  test::Matrix inverse;  // times the determinant
};

/// Scratch memory of exactly the right size.
class Scratch {
 public:
  explicit Scratch(int k) : lines_(simplex_scratch(k) / simplex_lanes) {}
  double* data() { return lines_.data()->entries; }

 private:
  struct alignas(64) Line {
    double entries[simplex_lanes];
  };
  std::vector<Line> lines_;
};

std::vector<const Index*> pointers(const std::vector<std::vector<Index>>& simplices) {
  std::vector<const Index*> result;
  for (const auto& simplex : simplices) result.push_back(simplex.data());
  return result;
}

/// Appends up to as many simplices as there are lanes.
std::vector<std::vector<Index>> append_simplices(Sample& sample, Shape shape, random::Generator& generator) {
  std::vector<std::vector<Index>> simplices(1 + generator.below(simplex_lanes));
  for (auto& simplex : simplices) {
    simplex.resize(sample.k_size() + 1);
    std::iota(simplex.begin(), simplex.end(), sample.last() + 1);
    sample.append_simplex(shape, generator);
  }
  return simplices;
}

/// The determinant of edges between homogeneous points in units has the same sign as theirs if k is even.
Sign orientation(int k, const Integer& determinant) {
  return test::sign_of(k % 2 == 0 ? determinant : Integer(-determinant));
}

struct Tally {
  std::size_t all = 0, oriented = 0;
};

void expect_true_certificates(int k, bool centered, Shape shape, std::size_t rounds, Tally& tally) {
  const auto width = static_cast<std::size_t>(k) + 1;
  random::Generator generator(static_cast<std::uint64_t>(100 * k + static_cast<int>(shape)));
  for (std::size_t round = 0; round < rounds; ++round) {
    Sample sample(k, centered);
    const auto simplices = append_simplices(sample, shape, generator);
    const auto vertices = pointers(simplices);
    Scratch scratch(k);
    std::vector<SimplexCertificate> certificates(simplices.size());
    const SimplexTask task{k, vertices, sample.rows.data(), scratch.data()};
    solve_simplices(task);
    certify_simplices(task, certificates.data());
    for (std::size_t lane = 0; lane < simplices.size(); ++lane) {
      const SimplexCertificate& proved = certificates[lane];
      ++tally.all;
      if (proved.orientation == Sign::zero) continue;
      ++tally.oriented;
      for (const bool as_rounded : {false, true}) {
        if (as_rounded && centered) continue;
        test::Matrix corners;
        for (const Index v : simplices[lane])
          corners.push_back(as_rounded ? sample.rounded_image(v) : sample.image(v));
        const Exact exact(corners);
        ASSERT_EQ(proved.orientation, orientation(k, exact.determinant)) << "lane " << lane;
        // k + 1 columns in units
        ASSERT_LE(Rational(proved.determinant),
                  Rational(abs(exact.determinant), Integer(1) << bits * (k + 1)));
        ASSERT_GT(proved.determinant, 0);
        ASSERT_GE(Rational(proved.spread), exact.spread());
      }
      const auto functional = [&](std::size_t r) {
        return lane_entry(scratch.data(), width * width + r, lane);
      };
      for (const Index v : simplices[lane]) {
        const double* row = sample.rows.data() + v * width;
        Rational value = Rational(row[k]) + Rational(functional(static_cast<std::size_t>(k)));
        double magnitude = std::fabs(row[k]) + std::fabs(functional(static_cast<std::size_t>(k)));
        for (std::size_t r = 0; r + 1 < width; ++r) {
          value += Rational(functional(r)) * Rational(row[r]);
          magnitude += std::fabs(functional(r) * row[r]);
        }
        ASSERT_LE(abs(value), Rational(proved.residual + 1.01 * (k + 2) * 0x1p-53 * magnitude));
      }
    }
  }
}

constexpr std::size_t usual_rounds[] = {0, 0, 60, 50, 30, 20, 14, 9, 6};

TEST(SimplexKernel, CertifiesOnlyWhatIsTrue) {
  for (int k = 2; k <= 8; ++k)
    for (const bool centered : {true, false})
      for (const Shape shape : shapes) {
        SCOPED_TRACE(testing::Message() << "shape " << static_cast<int>(shape) << ", dimension " << k
                                        << (centered ? "" : ", images are rounded"));
        Tally tally;
        ASSERT_NO_FATAL_FAILURE(
            expect_true_certificates(k, centered, shape, test::scaled_count(usual_rounds[k]), tally));
        if (shape == Shape::flat) {
          EXPECT_EQ(tally.oriented, 0u);
        } else if (shape == Shape::random) {
          EXPECT_GT(static_cast<double>(tally.oriented), 0.9 * static_cast<double>(tally.all));
        } else if (shape == Shape::small) {
          EXPECT_GT(tally.oriented, 0u);
        }
      }
}

TEST(SimplexKernel, SolvesForBarycentricCoordinates) {
  for (int k = 2; k <= 8; ++k) {
    const auto width = static_cast<std::size_t>(k) + 1;
    random::Generator generator(static_cast<std::uint64_t>(k));
    for (std::size_t round = 0; round < test::scaled_count(100); ++round) {
      Sample sample(k, true);
      const auto simplices = append_simplices(sample, Shape::random, generator);
      const auto vertices = pointers(simplices);
      Scratch scratch(k);
      const SimplexTask task{k, vertices, sample.rows.data(), scratch.data()};
      solve_simplices(task);
      for (std::size_t lane = 0; lane < simplices.size(); ++lane) {
        const auto value_at = [&](std::size_t f, Index v, double& magnitude) {
          double value = lane_entry(scratch.data(), f * width + width - 1, lane);
          for (std::size_t r = 0; r + 1 < width; ++r) {
            const double term = lane_entry(scratch.data(), f * width + r, lane);
            value += term * sample.rows[v * width + r];
            magnitude += std::fabs(term);
          }
          return value;
        };
        double magnitude = 0;
        for (std::size_t f = 0; f <= width; ++f)
          for (std::size_t i = 0; i < width; ++i) {
            const Index v = simplices[lane][i];
            const double expected = f == width ? -sample.rows[v * width + width - 1] : f == i ? 1.0 : 0.0;
            const double value = value_at(f, v, magnitude);
            ASSERT_NEAR(value, expected, 1e-13 * (1 + magnitude) * (1 + magnitude))
                << "function " << f << " at vertex " << i;
          }
      }
    }
  }
}

TEST(SimplexKernel, TreatsLanesAlike) {
  for (int k = 2; k <= 8; ++k)
    for (const Shape shape : shapes) {
      random::Generator generator(static_cast<std::uint64_t>(k));
      Sample sample(k, true);
      std::vector<std::vector<Index>> simplices;
      while (simplices.size() < simplex_lanes) simplices = append_simplices(sample, shape, generator);
      const auto vertices = pointers(simplices);
      Scratch together(k), alone(k);
      SimplexCertificate all[simplex_lanes], one;
      const SimplexTask all_at_once{k, vertices, sample.rows.data(), together.data()};
      solve_simplices(all_at_once);
      certify_simplices(all_at_once, all);
      for (std::size_t lane = 0; lane < simplex_lanes; ++lane) {
        const SimplexTask task{k, std::span(vertices).subspan(lane, 1), sample.rows.data(), alone.data()};
        solve_simplices(task);
        certify_simplices(task, &one);
        ASSERT_EQ(one.orientation, all[lane].orientation);
        if (one.orientation == Sign::zero) continue;
        // If one lane needs exchanges of rows, all get them: rounding differs, and so do the bounds.
        ASSERT_NEAR(one.spread, all[lane].spread, 0.05 * one.spread);
        ASSERT_NEAR(one.determinant, all[lane].determinant, 0.05 * one.determinant);
      }
    }
}

template <int K>
void expect_values_within_thresholds(bool centered, Shape shape) {
  SCOPED_TRACE(testing::Message() << "shape " << static_cast<int>(shape) << ", dimension " << K
                                  << (centered ? "" : ", images are rounded"));
  constexpr std::size_t width = K + 1;
  random::Generator generator(static_cast<std::uint64_t>(200 * K + static_cast<int>(shape)));
  Tally tally;
  for (std::size_t round = 0; round < test::scaled_count(usual_rounds[K]); ++round) {
    Sample sample(K, centered);
    const auto simplices = append_simplices(sample, shape, generator);
    const auto vertices = pointers(simplices);
    const Index num_vertices = sample.last();
    for (int i = 0; i < 6; ++i) sample.append(sample.random_point(generator));
    for (int i = 0; i < 6; ++i) {  // near corners of the box and in them
      Point fractions(K);
      for (double& c : fractions) c = (generator.coin() ? 1.0 : 0.0) * (i < 3 ? 1 : 1 - 1e-6);
      sample.append(sample.in_box(fractions));
    }
    CellMemory<K> memory(K);
    memory.reserve(simplices.size());
    Functionals<K> functionals(memory);
    std::vector<int> axes(K);
    std::iota(axes.begin(), axes.end(), 0);
    functionals.set_frame(sample.frame, axes);
    std::vector<Index> cells(simplices.size());
    std::iota(cells.rbegin(), cells.rend(), Index{0});
    for (std::size_t lane = 0; lane < cells.size(); ++lane)
      std::copy(simplices[lane].begin(), simplices[lane].end(), memory.links(cells[lane]));
    std::vector<Sign> signs(cells.size());
    functionals.solve(cells, vertices, sample.rows.data(), signs.data());

    for (std::size_t lane = 0; lane < cells.size(); ++lane) {
      ++tally.all;
      if (signs[lane] == Sign::zero) continue;
      ++tally.oriented;
      test::Matrix corners;
      std::vector<Integer> lifts;
      for (const Index v : simplices[lane]) {
        corners.push_back(sample.image(v));
        lifts.push_back(sample.lift(v));
      }
      const Exact exact(corners);
      ASSERT_EQ(signs[lane], orientation(K, exact.determinant));
      ASSERT_FALSE(functionals.is_infinite(cells[lane]));
      if (std::isinf(functionals.threshold(cells[lane]))) continue;  // claims nothing
      for (Index v = 1; v <= sample.last(); v += v <= num_vertices ? 3 : 1) {
        const double* row = sample.rows.data() + v * width;
        Integer height = sample.lift(v) * exact.determinant;
        const IntegerRow x = sample.image(v);
        for (std::size_t i = 0; i <= K; ++i) height -= exact.coordinate(i, x) * lifts[i];
        const Rational truth = quotient(height, exact.determinant * (Integer(1) << 2 * bits));
        const Rational error = abs(Rational(functionals.evaluator(row).value(cells[lane])) - truth);
        double threshold_at;
        ASSERT_LE(error, Rational(functionals.threshold(cells[lane]))) << "lane " << lane << ", point " << v;
        functionals.thresholds_at({&cells[lane], 1}, sample.rows.data(), row, &threshold_at);
        ASSERT_LE(error, Rational(threshold_at));
      }
    }
  }
  if (shape == Shape::random) {
    EXPECT_GT(static_cast<double>(tally.oriented), 0.9 * static_cast<double>(tally.all));
  }
}

template <int K>
void expect_values_within_thresholds() {
  for (const bool centered : {true, false})
    for (const Shape shape : shapes)
      ASSERT_NO_FATAL_FAILURE(expect_values_within_thresholds<K>(centered, shape));
}

TEST(SimplexKernel, ThresholdsBoundTheTrueErrorOfItsFunctionals) {
  expect_values_within_thresholds<2>();
  expect_values_within_thresholds<3>();
  expect_values_within_thresholds<4>();
  expect_values_within_thresholds<5>();
  expect_values_within_thresholds<6>();
  expect_values_within_thresholds<7>();
  expect_values_within_thresholds<8>();
}

}  // namespace
}  // namespace delone::geometry
