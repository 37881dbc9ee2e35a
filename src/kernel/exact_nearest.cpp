// SPDX-License-Identifier: BSD-3-Clause
// The algorithm is described in nearest_in_hull.cpp. With fractions it needs no care, and ends: |z| decreases
// with each round, so no face comes twice. Points that binary64 proves to
// be no nearer are not made integers of.
#include "kernel/exact_nearest.hpp"

#include "kernel/determinant.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

namespace delone::kernel {
namespace {

constexpr double allowance = 0x1p-1000;

/// Points as integers, and their products.
class ExactPoints {
 public:
  ExactPoints(std::span<const double* const> points, const double* q, std::size_t d)
      : given_(points), q_(q), d_(d) {
    grid_ = trailing_exponent(0.0);
    bool any = false;
    const auto note = [&](double x) {
      if (x == 0) return;
      grid_ = any ? std::min(grid_, trailing_exponent(x)) : trailing_exponent(x);
      any = true;
    };
    for (std::size_t j = 0; j < d; ++j) {
      note(q[j]);
      for (const double* p : points) note(p[j]);
    }
    if (!any) grid_ = 0;
  }
  int grid() const { return grid_; }
  /// The integers p − q of a point, made on first use: few points need them.
  const std::vector<Integer>& coordinates(std::size_t a) {
    std::vector<Integer>& result = coordinates_[a];
    for (std::size_t j = result.size(); j < d_; ++j)
      result.push_back(scaled_integer(given_[a][j], grid_) - scaled_integer(q_[j], grid_));
    return result;
  }
  /// Few of all pairs come up, so products are kept in a table.
  const Integer& product(int a, int b) {
    const auto low = static_cast<std::uint64_t>(std::min(a, b)),
               high = static_cast<std::uint64_t>(std::max(a, b));
    const auto [at, is_new] = products_.try_emplace(low << 32 | high);
    if (is_new) {
      const std::vector<Integer>&x = coordinates(low), &y = coordinates(high);
      for (std::size_t j = 0; j < d_; ++j) at->second += x[j] * y[j];
    }
    return at->second;
  }
  /// The point that seems nearest in binary64.
  int near() const {
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < given_.size(); ++i) {
      double square = 0;
      for (std::size_t j = 0; j < d_; ++j) square += (given_[i][j] - q_[j]) * (given_[i][j] - q_[j]);
      if (square < least) least = square, nearest = static_cast<int>(i);
    }
    return nearest;
  }
  void set_normal(std::span<const int> face, const Fractions& z);
  bool is_surely_behind(int point) const;

 private:
  std::span<const double* const> given_;
  const double* q_;
  std::size_t d_;
  int grid_;
  std::vector<double> normal_;  // z divided by a power of two
  double height_ = 0;           // at least z·z divided by it
  std::unordered_map<std::size_t, std::vector<Integer>> coordinates_;
  std::unordered_map<std::uint64_t, Integer> products_;
};

/// z, scaled to less than 1 and rounded, for is_surely_behind().
void ExactPoints::set_normal(std::span<const int> face, const Fractions& z) {
  normal_.assign(d_, 0.0);
  double largest = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    Integer sum(0);
    for (std::size_t s = 0; s < face.size(); ++s)
      sum += z.numerators[s] * coordinates(static_cast<std::size_t>(face[s]))[j];
    normal_[j] = nearest_double(sum, z.denominator, grid_);
    largest = std::max(largest, std::fabs(normal_[j]));
  }
  int exponent = 0;
  height_ = std::numeric_limits<double>::infinity();
  if (!std::isfinite(largest) || largest == 0) return;
  std::frexp(largest, &exponent);
  for (double& x : normal_) x = std::ldexp(x, -exponent);
  height_ =
      nearest_double(z.numerators.back(), z.denominator, 2 * grid_ - exponent) * (1 + 4 * unit_roundoff) +
      allowance;
}

/// Whether v·z ≥ z·z for certain. Of n, that is z scaled, a coordinate is off by u of it, or by u·2^−900 if
/// it has underflowed; a difference by u; products and sums by γ(d+1) of the magnitude, or by underflow,
/// which is far below the allowance.
bool ExactPoints::is_surely_behind(int point) const {
  const double* const p = given_[static_cast<std::size_t>(point)];
  double product = 0, parts = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    const double v = p[j] - q_[j];
    product += normal_[j] * v;
    parts += std::max(std::fabs(normal_[j]), 0x1p-900) * std::fabs(v);
  }
  return product - 1.01 * static_cast<double>(d_ + 4) * unit_roundoff * parts > height_ + allowance;
}

/// The point of the flat of the face with the least norm: weights and squared norm, by Lagrange's conditions
/// Σ_j G_ij·w_j = |z|², Σ w_j = 1. Returns false if the points are affinely dependent.
bool minimize_exactly(ExactPoints& points, std::span<const int> face, Fractions& result) {
  const std::size_t n = face.size() + 1;
  std::vector<Integer> matrix, augmented;
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < n; ++c) {
      Integer entry(r + 1 == n && c + 1 == n ? 0 : c + 1 == n ? -1 : 1);
      if (r + 1 < n && c + 1 < n) entry = points.product(face[r], face[c]);
      matrix.push_back(entry);
      augmented.push_back(std::move(entry));
    }
    augmented.emplace_back(r + 1 == n ? 1 : 0);
  }
  if (exact_determinant(std::move(matrix), n) == 0) return false;
  result = solve_exactly(std::move(augmented), n);
  if (result.denominator < 0) {
    result.denominator = -result.denominator;
    for (Integer& x : result.numerators) x = -x;
  }
  return true;
}

}  // namespace

ExactNearest nearest_in_hull_exactly(std::span<const double* const> points, const double* q, int dimension,
                                     std::span<const int> guess) {
  ExactPoints exact(points, q, static_cast<std::size_t>(dimension));
  const auto m = static_cast<int>(points.size());
  std::vector<int> face(guess.begin(), guess.end());
  Fractions here;
  const auto all_positive = [](const Fractions& point) {
    return std::all_of(point.numerators.begin(), point.numerators.end() - 1,
                       [](const Integer& x) { return x > 0; });
  };
  if (face.empty() || !minimize_exactly(exact, face, here) || !all_positive(here)) {
    face.assign(1, exact.near());
    minimize_exactly(exact, face, here);
  }
  for (;;) {
    // The least v_i·z, times the denominator.
    Integer smallest = here.numerators.back();
    int entering = -1;
    exact.set_normal(face, here);
    for (int i = 0; i < m; ++i) {
      if (exact.is_surely_behind(i)) continue;
      Integer product(0);
      for (std::size_t s = 0; s < face.size(); ++s) product += here.numerators[s] * exact.product(i, face[s]);
      if (product >= smallest) continue;
      smallest = std::move(product);
      entering = i;
    }
    if (entering < 0) break;
    // Weights of the moving point: numerators over a common denominator.
    std::vector<Integer> weights(here.numerators.begin(), here.numerators.end() - 1);
    Integer denominator = here.denominator;
    face.push_back(entering);
    weights.emplace_back(0);
    for (;;) {
      // Independent: z is orthogonal to the flat of the face, and the new point is not at the same product.
      minimize_exactly(exact, face, here);
      // The least share s = a_i/(a_i − b_i) with weights a/A now and b/B at the minimum, where b_i ≤ 0.
      std::size_t leaving = face.size();
      Integer top(0), bottom(1);
      for (std::size_t i = 0; i < face.size(); ++i) {
        if (here.numerators[i] > 0) continue;
        Integer a = weights[i] * here.denominator;
        Integer b = a - here.numerators[i] * denominator;
        // b = 0 where both weights are 0: the point is the minimum of a face without this one.
        if (leaving < face.size() && a * bottom >= top * b) continue;
        leaving = i;
        if (b == 0) b = 1;  // and a is 0
        top = std::move(a);
        bottom = std::move(b);
      }
      if (leaving == face.size()) break;
      for (std::size_t i = 0; i < face.size(); ++i)
        weights[i] = weights[i] * here.denominator * (bottom - top) + here.numerators[i] * denominator * top;
      denominator *= here.denominator * bottom;
      Integer common = denominator;
      for (const Integer& x : weights) common = boost::multiprecision::gcd(common, x);
      denominator /= common;
      for (Integer& x : weights) x /= common;
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(leaving));
      weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(leaving));
    }
  }
  ExactNearest result;
  std::vector<std::size_t> order(face.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return face[a] < face[b]; });
  for (const std::size_t i : order) {
    result.face.push_back(face[i]);
    result.numerators.push_back(here.numerators[i]);
  }
  result.denominator = here.denominator;
  result.squared = here.numerators.back();
  result.grid = exact.grid();
  return result;
}

Sign ExactNearest::compare(double tolerance) const {
  // squared/denominator·2^(2g) − t²·2^(2h)
  const int other = tolerance == 0 ? grid : trailing_exponent(tolerance);
  const Integer root = scaled_integer(tolerance, other);
  Integer left = squared, right = root * root * denominator;
  const int shift = 2 * (grid - other);
  if (shift >= 0)
    left <<= shift;
  else
    right <<= -shift;
  return left > right ? Sign::positive : left < right ? Sign::negative : Sign::zero;
}

Sign ExactNearest::compare(const ExactNearest& other) const {
  Integer left = squared * other.denominator, right = other.squared * denominator;
  const int shift = 2 * (grid - other.grid);
  if (shift >= 0)
    left <<= shift;
  else
    right <<= -shift;
  return left > right ? Sign::positive : left < right ? Sign::negative : Sign::zero;
}

}  // namespace delone::kernel
