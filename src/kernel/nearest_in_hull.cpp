// SPDX-License-Identifier: BSD-3-Clause
// Let v_i = p_i − q. Wolfe's algorithm keeps affinely independent points, the face, and the point z of their
// hull with the least norm, where all weights are positive. If v_i·z ≥ z·z for all i, z is nearest. Otherwise
// the point with the least v_i·z joins the face, and z moves towards the point of the face's flat with the
// least norm; points whose weights become zero on the way leave. |z| decreases with each round, so no face
// comes twice.
//
// Bounds. The differences ṽ_i are rounded once, and scaled by a common power of two that makes the largest of
// their coordinates less than 1 and at least 1/2: |ṽ − v| ≤ u·|v| + 2^−1000 per coordinate. The absolute term
// is the underflow of scaling. An axis with numbers beyond 2^1020 is divided by 16 first; unless all its
// numbers are equal, two of them then differ by at least 2^960, against which what underflows is nothing,
// too.
//
// Upper: the point z = Σ w_i·v_i / Σ w_i. With m products and sums, and the error of ṽ, the coordinate j of
// the computed numerator is off by at most γ(m+2)·Σ w_i·|ṽ_ij|, and the sum of weights by γ(m).
//
// Lower: for every n ≠ 0, the hull lies in the halfspace {x: n·x ≥ min n·v_i}, so its distance from 0 is at
// least that minimum divided by |n|. A computed n·ṽ_i is off by at most γ(d+2)·Σ_j |n_j|·|ṽ_ij|. The best n
// is z. Here it is the component of a v_i orthogonal to the edges of the face, found by orthogonalizing
// twice: its angle with them is right up to a few roundings also if z is small beside the face, where the
// rounded Σ w_i·v_i points anywhere.
//
// Absolute terms of 2^−500 cover underflow of products; the factors below cover second-order terms, the
// rounding of the bounds themselves and of the square roots.
#include "kernel/nearest_in_hull.hpp"

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

constexpr double least = 0x1p-500;

/// An upper bound on the norm of a vector whose coordinates are at most 2^400.
double norm_up(std::span<const double> x) {
  double sum = 0;
  bool zero = true;
  for (const double c : x) {
    sum += c * c;
    zero = zero && c == 0;
  }
  const double rounding = static_cast<double>(x.size() + 4) * unit_roundoff;
  return zero ? 0 : std::sqrt(sum) * (1 + rounding) + least;
}

double scale_up(double x, int exponent) {
  const double y = std::ldexp(x, exponent);
  const bool is_exact = std::fabs(y) >= std::numeric_limits<double>::min() || x == 0;
  return is_exact ? y : std::nextafter(y, std::numeric_limits<double>::infinity());
}

double scale_down(double x, int exponent) {
  const double y = std::ldexp(x, exponent);
  if (std::isinf(y)) return std::numeric_limits<double>::max();
  const bool is_exact = y >= std::numeric_limits<double>::min() || x == 0;
  return is_exact ? y : std::max(0.0, std::nextafter(y, -1.0));
}

double dot(const double* a, const double* b, std::size_t d) {
  double sum = 0;
  for (std::size_t j = 0; j < d; ++j) sum += a[j] * b[j];
  return sum;
}

}  // namespace

void NearestInHull::set_differences(std::span<const double* const> points, const double* q) {
  differences_.resize(m_ * d_);
  double largest = 0;
  int shift = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    double size = std::fabs(q[j]);
    for (const double* p : points) size = std::max(size, std::fabs(p[j]));
    if (size > 0x1p1020) shift = 4;
  }
  for (std::size_t j = 0; j < d_; ++j) {
    double size = std::fabs(q[j]);
    for (const double* p : points) size = std::max(size, std::fabs(p[j]));
    const bool is_huge = size > 0x1p1020;
    for (std::size_t i = 0; i < m_; ++i) {
      const double x = is_huge ? points[i][j] / 16 - q[j] / 16 : points[i][j] - q[j];
      differences_[i * d_ + j] = shift == 0 || is_huge ? x : x / 16;
      largest = std::max(largest, std::fabs(differences_[i * d_ + j]));
    }
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  has_underflow_ = false;
  for (double& x : differences_) {
    const double y = std::ldexp(x, -exponent);
    has_underflow_ = has_underflow_ || (x != 0 && std::fabs(y) < least);
    x = y;
  }
  exponent_ = exponent + shift;
}

std::size_t NearestInHull::nearest_vertex() const {
  std::size_t nearest = 0;
  double least_square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < m_; ++i) {
    const double square = dot(difference(static_cast<int>(i)), difference(static_cast<int>(i)), d_);
    if (square >= least_square) continue;
    least_square = square;
    nearest = i;
  }
  return nearest;
}

/// Sets minimum_ and normal_ for face_. Returns false if its points are dependent, as far as binary64 can
/// tell.
bool NearestInHull::minimize_on_face() {
  const std::size_t n = face_.size() - 1;
  const double* base = difference(face_[0]);
  basis_.resize(n * d_);
  triangle_.assign(n * n, 0.0);
  minimum_.assign(n + 1, 0.0);
  normal_.assign(base, base + d_);
  if (n > d_) return false;
  const auto row = [&](std::size_t i) { return basis_.data() + i * d_; };
  for (std::size_t i = 0; i < n; ++i) {
    const double* p = difference(face_[i + 1]);
    for (std::size_t j = 0; j < d_; ++j) row(i)[j] = p[j] - base[j];
    const double length = std::sqrt(dot(row(i), row(i), d_));
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t s = 0; s < i; ++s) {
        const double part = dot(row(s), row(i), d_);
        triangle_[s * n + i] += part;
        for (std::size_t j = 0; j < d_; ++j) row(i)[j] -= part * row(s)[j];
      }
    const double height = std::sqrt(dot(row(i), row(i), d_));
    if (!(height > 0x1p-50 * length)) return false;
    triangle_[i * n + i] = height;
    for (std::size_t j = 0; j < d_; ++j) row(i)[j] /= height;
  }
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t s = 0; s < n; ++s) {
      const double part = dot(row(s), normal_.data(), d_);
      minimum_[s + 1] -= part;
      for (std::size_t j = 0; j < d_; ++j) normal_[j] -= part * row(s)[j];
    }
  double rest = 1;
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t s = i + 1; s < n; ++s) minimum_[i + 1] -= triangle_[i * n + s] * minimum_[s + 1];
    minimum_[i + 1] /= triangle_[i * n + i];
    rest -= minimum_[i + 1];
  }
  minimum_[0] = rest;
  return true;
}

/// The point with the weights on_face_.
void NearestInHull::set_point() {
  point_.assign(d_, 0.0);
  for (std::size_t i = 0; i < face_.size(); ++i) {
    const double* v = difference(face_[i]);
    for (std::size_t j = 0; j < d_; ++j) point_[j] += on_face_[i] * v[j];
  }
}

void NearestInHull::descend() {
  face_.assign(1, static_cast<int>(nearest_vertex()));
  on_face_.assign(1, 1.0);
  minimize_on_face();
  normal_kept_ = normal_;
  std::vector<int> best_face = face_;
  std::vector<double> best_weights = on_face_;
  const auto steps = 3 * m_ + 20;
  for (std::size_t step = 0; step < steps; ++step) {
    // The normal is z up to rounding.
    const double square = dot(normal_.data(), normal_.data(), d_);
    double smallest = square - 4 * static_cast<double>(d_) * unit_roundoff * (square + std::sqrt(square));
    int entering = -1;
    for (std::size_t i = 0; i < m_; ++i) {
      const double product = dot(normal_.data(), difference(static_cast<int>(i)), d_);
      if (product >= smallest) continue;
      smallest = product;
      entering = static_cast<int>(i);
    }
    if (entering < 0 || std::find(face_.begin(), face_.end(), entering) != face_.end()) break;
    face_.push_back(entering);
    on_face_.push_back(0.0);
    bool moved = false;
    while (minimize_on_face()) {
      double share = 1;
      std::size_t leaving = face_.size();
      for (std::size_t i = 0; i < face_.size(); ++i) {
        if (minimum_[i] > 0) continue;
        const double here = on_face_[i] / (on_face_[i] - minimum_[i]);
        if (leaving < face_.size() && !(here < share)) continue;
        share = here >= 0 ? std::min(here, 1.0) : 0;
        leaving = i;
      }
      if (leaving == face_.size()) {
        on_face_ = minimum_;
        moved = true;
        break;
      }
      for (std::size_t i = 0; i < face_.size(); ++i)
        on_face_[i] = std::max(0.0, on_face_[i] + share * (minimum_[i] - on_face_[i]));
      face_.erase(face_.begin() + static_cast<std::ptrdiff_t>(leaving));
      on_face_.erase(on_face_.begin() + static_cast<std::ptrdiff_t>(leaving));
      if (face_.empty()) break;
    }
    const bool is_nearer = moved && dot(normal_.data(), normal_.data(), d_) < square;
    if (!is_nearer) {
      face_ = best_face;
      on_face_ = best_weights;
      break;
    }
    normal_kept_ = normal_;
    best_face = face_;
    best_weights = on_face_;
  }
}

void NearestInHull::set_bounds() {
  const auto count = static_cast<double>(m_), dimension = static_cast<double>(d_);
  set_point();
  double sum = 0;
  for (const double w : on_face_) sum += w;
  const double rounding = 1.01 * (count + 3) * unit_roundoff;
  for (std::size_t j = 0; j < d_; ++j) {
    double parts = 0;
    bool is_zero = !has_underflow_;
    for (std::size_t i = 0; i < face_.size(); ++i) {
      const double size = std::fabs(difference(face_[i])[j]);
      parts += on_face_[i] * size;
      is_zero = is_zero && size == 0;
    }
    const double error = is_zero ? 0 : rounding * parts + least;
    point_[j] = (std::fabs(point_[j]) + error) * (1 + 4 * unit_roundoff);
  }
  upper_ = scale_up(norm_up(point_) / sum * (1 + (count + 6) * unit_roundoff), exponent_);

  lower_ = 0;
  double largest = 0;
  for (const double x : normal_kept_) largest = std::max(largest, std::fabs(x));
  if (largest == 0) return;
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (double& x : normal_kept_) x = std::ldexp(x, -exponent);
  const double dot_rounding = 1.01 * (dimension + 3) * unit_roundoff;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < m_; ++i) {
    const double* v = difference(static_cast<int>(i));
    double product = 0, parts = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      product += normal_kept_[j] * v[j];
      parts += std::fabs(normal_kept_[j] * v[j]);
    }
    smallest = std::min(smallest, product - dot_rounding * parts - least);
  }
  if (!(smallest > 0)) return;
  const double lower = smallest / norm_up(normal_kept_) * (1 - 4 * unit_roundoff);
  lower_ = std::min(scale_down(lower, exponent_), upper_);
}

void NearestInHull::find(std::span<const double* const> points, const double* q, int dimension) {
  d_ = static_cast<std::size_t>(dimension);
  m_ = points.size();
  set_differences(points, q);
  descend();
  // In increasing order, and without points that rounding left at zero.
  weights_.assign(m_, 0.0);
  double sum = 0;
  for (std::size_t i = 0; i < face_.size(); ++i) sum += on_face_[i];
  for (std::size_t i = 0; i < face_.size(); ++i)
    weights_[static_cast<std::size_t>(face_[i])] = on_face_[i] / sum;
  face_.clear();
  on_face_.clear();
  for (std::size_t i = 0; i < m_; ++i) {
    if (!(weights_[i] > 0)) continue;
    face_.push_back(static_cast<int>(i));
    on_face_.push_back(weights_[i]);
  }
  set_bounds();
}

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
