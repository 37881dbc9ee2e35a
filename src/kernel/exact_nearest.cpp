// SPDX-License-Identifier: BSD-3-Clause
// The algorithm is described in nearest_in_hull.cpp. With fractions it needs no care, and ends: |z| decreases
// with each round, so no face comes twice.
#include "kernel/exact_nearest.hpp"

#include "kernel/grid.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace delone::kernel {
namespace {

/// Points as integers, and their products.
class ExactPoints {
 public:
  ExactPoints(std::span<const double* const> points, const double* q, std::size_t d) : d_(d) {
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
    for (const double* p : points)
      for (std::size_t j = 0; j < d; ++j)
        coordinates_.push_back(scaled_integer(p[j], grid_) - scaled_integer(q[j], grid_));
  }
  int grid() const { return grid_; }
  /// Few of all pairs come up, so products are kept in a table.
  const Integer& product(int a, int b) {
    const auto low = static_cast<std::uint64_t>(std::min(a, b)),
               high = static_cast<std::uint64_t>(std::max(a, b));
    const auto [at, is_new] = products_.try_emplace(low << 32 | high);
    if (is_new)
      for (std::size_t j = 0; j < d_; ++j)
        at->second += coordinates_[low * d_ + j] * coordinates_[high * d_ + j];
    return at->second;
  }

 private:
  std::size_t d_;
  int grid_;
  std::vector<Integer> coordinates_;
  std::unordered_map<std::uint64_t, Integer> products_;
};

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
    int nearest = 0;
    for (int i = 1; i < m; ++i)
      if (exact.product(i, i) < exact.product(nearest, nearest)) nearest = i;
    face.assign(1, nearest);
    minimize_exactly(exact, face, here);
  }
  for (;;) {
    // The least v_i·z, times the denominator.
    Integer smallest = here.numerators.back();
    int entering = -1;
    for (int i = 0; i < m; ++i) {
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
        const Integer a = weights[i] * here.denominator;
        const Integer b = a - here.numerators[i] * denominator;
        // b = 0 where both weights are 0: the point is the minimum of a face without this one.
        if (leaving < face.size() && a * bottom >= top * b) continue;
        leaving = i;
        top = b == 0 ? Integer(0) : a;
        bottom = b == 0 ? Integer(1) : b;
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
