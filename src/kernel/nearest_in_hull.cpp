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
// Proof. Let E be the edges of the face from its first point, y the weights found, z the point, y* and z*
// those of the nearest point of the face's flat. Eᵀ·E·(y − y*) = Eᵀ·z = ρ, so |z − z*| ≤ |ρ|/σ and |y − y*| ≤
// |ρ|/σ² with the least singular value σ of E. If X is an approximate left inverse of E and ‖I − X·E‖ ≤ α <
// 1, then σ ≥ (1 − α)/‖X‖, in Frobenius' norm. If all weights exceed their error, z* is in the face; if
// z*·(v_i − z*) > 0 for all other points, it is nearest and the only one. Errors of ρ: those of z times |E|,
// and the rounding of the products; of X·E: as in linear_bound.hpp, and those of the edges, at most 4u each.
//
// Absolute terms of 2^−500 cover underflow of products; the factors below cover second-order terms, the
// rounding of the bounds themselves and of the square roots.
#include "kernel/nearest_in_hull.hpp"

#include "base/progress_meter.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace delone::kernel {

namespace {

/// At least what underflow changes in any of the sums.
constexpr double underflow = 0x1p-500;

/// An upper bound on the norm of a vector whose coordinates are at most 2^400.
double norm_up(std::span<const double> x) {
  double sum = 0;
  bool zero = true;
  for (const double c : x) {
    sum += c * c;
    zero = zero && c == 0;
  }
  const double rounding = static_cast<double>(x.size() + 4) * unit_roundoff;
  return zero ? 0 : std::sqrt(sum) * (1 + rounding) + underflow;
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
  const bool has_scale = std::abs(exponent) < 1000;  // the same as ldexp(), faster
  const double scale = has_scale ? std::ldexp(1.0, -exponent) : 0;
  for (double& x : differences_) {
    const double y = has_scale ? x * scale : std::ldexp(x, -exponent);
    has_underflow_ = has_underflow_ || (x != 0 && std::fabs(y) < underflow);
    x = y;
  }
  exponent_ = exponent + shift;
  is_shifted_ = shift != 0;
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
  best_face_ = face_;
  best_weights_ = on_face_;
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
      face_ = best_face_;
      on_face_ = best_weights_;
      break;
    }
    normal_kept_ = normal_;
    best_face_ = face_;
    best_weights_ = on_face_;
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
    const double error = is_zero ? 0 : rounding * parts + underflow;
    point_[j] = (std::fabs(point_[j]) + error) * (1 + 4 * unit_roundoff);
  }
  // point_ is |z| with its error now.
  upper_ = scale_up(norm_up(point_) / sum * (1 + (count + 6) * unit_roundoff), exponent_);

  lower_ = 0;
  double largest = 0;
  for (const double x : normal_kept_) largest = std::max(largest, std::fabs(x));
  if (largest == 0) return;
  int exponent = 0;
  std::frexp(largest, &exponent);
  const bool has_scale = std::abs(exponent) < 1000;  // the same as ldexp(), faster
  const double scale = has_scale ? std::ldexp(1.0, -exponent) : 0;
  for (double& x : normal_kept_) x = has_scale ? x * scale : std::ldexp(x, -exponent);
  const double dot_rounding = 1.01 * (dimension + 3) * unit_roundoff;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < m_; ++i) {
    const double* v = difference(static_cast<int>(i));
    double product = 0, parts = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      product += normal_kept_[j] * v[j];
      parts += std::fabs(normal_kept_[j] * v[j]);
    }
    smallest = std::min(smallest, product - dot_rounding * parts - underflow);
  }
  if (!(smallest > 0)) return;
  const double lower = smallest / norm_up(normal_kept_) * (1 - 4 * unit_roundoff);
  lower_ = std::min(scale_down(lower, exponent_), upper_);
}

void NearestInHull::find(std::span<const double* const> points, const double* q, int dimension) {
  internal::cancellation_point();
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
  weight_error_ = std::numeric_limits<double>::infinity();
}

/// An approximate left inverse X = R⁻¹·Qᵀ of the edges of the face, with ‖I − X·E‖ ≤ alpha_ < 1/2 and upper
/// bounds of the norms of E and X. REQUIRES minimize_on_face(). Returns false if alpha_ is not that small.
bool NearestInHull::invert_edges() {
  const std::size_t r = face_.size() - 1;
  const double* base = difference(face_[0]);
  double inverse_square = 0, alpha_square = 0, edge_square = 0;
  inverse_.resize(r * d_);
  for (std::size_t i = r; i-- > 0;)
    for (std::size_t j = 0; j < d_; ++j) {
      double x = basis_[i * d_ + j];
      for (std::size_t s = i + 1; s < r; ++s) x -= triangle_[i * r + s] * inverse_[s * d_ + j];
      x /= triangle_[i * r + i];
      inverse_[i * d_ + j] = x;
      inverse_square += x * x;
    }
  for (std::size_t c = 0; c < r; ++c) {
    const double* p = difference(face_[c + 1]);
    for (std::size_t j = 0; j < d_; ++j) edge_square += (p[j] - base[j]) * (p[j] - base[j]);
    for (std::size_t i = 0; i < r; ++i) {
      double entry = i == c ? 1 : 0;
      for (std::size_t j = 0; j < d_; ++j) entry -= inverse_[i * d_ + j] * (p[j] - base[j]);
      alpha_square += entry * entry;
    }
  }
  const auto dimension = static_cast<double>(d_), rank = static_cast<double>(r);
  edges_norm_ = 1.01 * std::sqrt(edge_square);
  edges_error_ = 4 * unit_roundoff * std::sqrt(rank * dimension);
  inverse_norm_ = 1.01 * std::sqrt(inverse_square);
  alpha_ = 1.01 * std::sqrt(alpha_square) + inverse_norm_ * edges_error_ +
           1.05 * (dimension + 3) * unit_roundoff * (inverse_norm_ * edges_norm_ + std::sqrt(rank));
  return alpha_ < 0.5;
}

void NearestInHull::prove() {
  weight_error_ = std::numeric_limits<double>::infinity();
  if (is_shifted_ || has_underflow_ || !minimize_on_face() || !invert_edges()) return;
  const std::size_t r = face_.size() - 1;
  const double dimension = static_cast<double>(d_), count = static_cast<double>(m_);
  set_point();
  place_ = point_;
  // |z̃ − z| ≤ place_error, as all differences are at most 1, and so are sums of weights, up to rounding.
  const double place_error = 1.05 * (count + 6) * unit_roundoff * std::sqrt(dimension);
  const double* base = difference(face_[0]);
  double rho_square = 0;
  for (std::size_t c = 0; c < r; ++c) {
    const double* p = difference(face_[c + 1]);
    double rho = 0;
    for (std::size_t j = 0; j < d_; ++j) rho += (p[j] - base[j]) * place_[j];
    rho_square += rho * rho;
  }
  const double place = norm_up(place_) + place_error;
  const double rho = 1.01 * std::sqrt(rho_square) + (edges_norm_ + edges_error_) * place_error +
                     edges_error_ * place + 1.05 * (dimension + 3) * unit_roundoff * edges_norm_ * place +
                     underflow;
  const double per_sigma = r == 0 ? 0 : inverse_norm_ / (1 - alpha_);
  const double weight_error = 1.05 * (1 + std::sqrt(static_cast<double>(r))) * rho * per_sigma * per_sigma +
                              4 * (count + 4) * unit_roundoff;
  place_error_ = 1.05 * (rho * per_sigma + place_error);
  if (r > 0)
    for (const double w : on_face_)
      if (!(w > weight_error)) return;
  for (std::size_t i = 0, s = 0; i < m_; ++i) {
    if (s <= r && face_[s] == static_cast<int>(i)) {
      ++s;
      continue;
    }
    if (sign_of_product(difference(static_cast<int>(i))) != Sign::positive) return;
  }
  weight_error_ = weight_error;
}

/// The height over facet i is 1/|P_i| with the row P_i of the pseudoinverse P of E; for the first vertex, P_0
/// is minus the sum of rows. Of all left inverses L it has the least norm of every row, and of their sum.
/// With L = (X·E)⁻¹·X, every row is off from X's by at most α/(1 − α) times the norm of X.
double NearestInHull::least_height_down(std::span<const double* const> points, int dimension) {
  d_ = static_cast<std::size_t>(dimension);
  m_ = points.size();
  set_differences(points, points[0]);
  face_.resize(m_);
  std::iota(face_.begin(), face_.end(), 0);
  if (is_shifted_ || has_underflow_ || !minimize_on_face() || !invert_edges()) return 0;
  double largest = 0;
  point_.assign(d_, 0.0);
  for (std::size_t i = 0; i + 1 < m_; ++i) {
    double square = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      const double x = inverse_[i * d_ + j];
      point_[j] += x;
      square += x * x;
    }
    largest = std::max(largest, square);
  }
  largest = std::max(largest, dot(point_.data(), point_.data(), d_));
  const auto count = static_cast<double>(m_);
  const double rounding =
      1.05 * (static_cast<double>(d_) + count + 4) * unit_roundoff * count * inverse_norm_;
  const double row = std::sqrt(largest) + rounding + 1.01 * count * alpha_ / (1 - alpha_) * inverse_norm_;
  return scale_down((1 - 8 * unit_roundoff) / row, exponent_);
}

/// The sign of z·(v − z), of which z̃·(ṽ − z̃) is computed. With η ≥ |z̃ − z|, the errors of the two factors
/// change it by at most η·(|v − z| + |z|) + u·|v|·|z|, up to second order.
Sign NearestInHull::sign_of_product(const double* v) const {
  double product = 0, size = 0, place = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    product += place_[j] * (v[j] - place_[j]);
    size += v[j] * v[j];
    place += place_[j] * place_[j];
  }
  size = 1.01 * std::sqrt(size) + underflow;
  place = 1.01 * std::sqrt(place) + place_error_ + underflow;
  const double error = 1.05 * (place_error_ * (size + 2 * place) +
                               (static_cast<double>(d_) + 5) * unit_roundoff * place * (size + place)) +
                       underflow;
  return product > error ? Sign::positive : product < -error ? Sign::negative : Sign::zero;
}

Sign NearestInHull::side(const double* p, const double* q) const {
  double v[64];
  if (d_ > std::size(v)) return Sign::zero;
  for (std::size_t j = 0; j < d_; ++j) {
    v[j] = std::ldexp(p[j] - q[j], -exponent_);
    if (!(std::fabs(v[j]) < 0x1p100) || (std::fabs(v[j]) < underflow && p[j] != q[j])) return Sign::zero;
  }
  return sign_of_product(v);
}

double NearestInHull::flat_distance_up(std::span<const double* const> points, const double* q,
                                       int dimension) {
  d_ = static_cast<std::size_t>(dimension);
  m_ = points.size();
  set_differences(points, q);
  face_.resize(m_);
  std::iota(face_.begin(), face_.end(), 0);
  if (!minimize_on_face()) return std::numeric_limits<double>::infinity();
  // As the upper bound of find(), with weights of both signs, whose sum is 1 up to their own rounding.
  double sum = 0, parts = 0;
  for (const double w : minimum_) {
    sum += w;
    parts += std::fabs(w);
  }
  const double rounding = 1.01 * (static_cast<double>(m_) + 3) * unit_roundoff;
  const double least_sum = sum - rounding * parts;
  if (!(least_sum > 0.5)) return std::numeric_limits<double>::infinity();
  on_face_ = minimum_;
  set_point();
  for (std::size_t j = 0; j < d_; ++j) {
    double size = 0;
    for (std::size_t i = 0; i < m_; ++i) size += std::fabs(minimum_[i] * difference(static_cast<int>(i))[j]);
    point_[j] = (std::fabs(point_[j]) + rounding * size + underflow) * (1 + 4 * unit_roundoff);
  }
  return scale_up(norm_up(point_) / least_sum * (1 + 4 * unit_roundoff), exponent_);
}

}  // namespace delone::kernel
