// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/small_cone.hpp"

#include "kernel/double_double.hpp"
#include "kernel/fractions.hpp"
#include "kernel/int128.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::polyhedra {

using kernel::DoubleDouble;
using kernel::Int128;

namespace {

constexpr double largest_exact = 0x1p53;
/// The sum of 7! products, with a sign, has 14 bits more than they have.
constexpr int bits_of_determinant = 512 - 14;
constexpr std::uint64_t row_bit(std::size_t row) { return std::uint64_t{1} << row; }

/// Each term of a minor, and of a row times minors, has had at most 27 roundings for d ≤ 6: products and sums
/// of d + 1 levels. So the error is below 27·2^−53·(1 + 2^−40) times the sum of the magnitudes of the terms,
/// which itself was computed with at most as many roundings.
constexpr double error_of_magnitude = 0x1p-47;

/// Of integers below 2^53.
Int128 product(double a, double b) {
  return Int128(static_cast<std::int64_t>(a)) * Int128(static_cast<std::int64_t>(b));
}

/// Calls use(row) for the rows of a set, increasing, until it returns false.
template <class Use>
void for_each_row(std::uint64_t set, Use use) {
  for (; set != 0; set &= set - 1)
    if (!use(static_cast<std::size_t>(std::countr_zero(set)))) return;
}

/// Multiplies a row by a power of two so that its entries are integers of that many bits, if there is one.
template <class Entries>
bool try_make_integers(Entries& row, std::size_t size, int most_bits) {
  int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
  for (std::size_t c = 0; c < size; ++c) {
    if (row[c] == 0) continue;
    int exponent = 0;
    const double fraction = std::frexp(row[c], &exponent);  // below 1
    const auto mantissa = static_cast<std::int64_t>(std::abs(fraction) * 0x1p53);
    low = std::min(low, exponent - 53 + std::countr_zero(static_cast<std::uint64_t>(mantissa)));
    high = std::max(high, exponent);
  }
  if (high < low) return true;  // all zeros
  if (high - low > most_bits) return false;
  for (std::size_t c = 0; c < size; ++c) row[c] = std::ldexp(row[c], -low);
  return true;
}

}  // namespace

bool SmallCone::try_find(std::span<const double> matrix, std::span<const double> bounds,
                         std::size_t dimension) {
  vertices_.clear();
  directions_.clear();
  if (dimension == 0 || dimension > most_dimensions || bounds.size() > most_rows) return false;
  dimension_ = dimension;
  RowSet done = 0;
  if (!try_set_rows(matrix, bounds) || !try_begin(done)) return false;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if ((done & row_bit(row)) != 0) continue;
    if (!try_cut(row, done)) return false;
    done |= row_bit(row);
  }
  RowSet on_all = done;
  bool has_vertex = false;
  for (const Ray& ray : rays_) {
    on_all &= ray.zeros;
    has_vertex = has_vertex || (ray.zeros & 1) == 0;
  }
  if (!has_vertex) return true;
  if (on_all != 0) return false;  // flat
  collect();
  return true;
}

/// a·x ≤ b as −a·x + b·x_0 ≥ 0, and x_0 ≥ 0. Rows that hold everywhere are left out.
bool SmallCone::try_set_rows(std::span<const double> matrix, std::span<const double> bounds) {
  const std::size_t d = dimension_;
  const int most_bits = bits_of_determinant / static_cast<int>(d + 1);
  rows_.assign(1, {});
  rows_[0][d] = 1;
  axis_rows_ = {};
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    std::array<double, most_entries> row{};
    std::size_t num_coefficients = 0, last = 0;
    for (std::size_t c = 0; c < d; ++c) {
      row[c] = -matrix[i * d + c];
      if (row[c] == 0) continue;
      ++num_coefficients;
      last = c;
    }
    row[d] = bounds[i];
    if (num_coefficients == 0 && bounds[i] >= 0) continue;
    if (num_coefficients == 1) axis_rows_[last] |= row_bit(rows_.size());
    if (!try_make_integers(row, d + 1, most_bits)) return false;
    rows_.push_back(row);
  }
  return true;
}

/// Begins with a simplicial cone. Which rows look independent is found in binary64; whether they are, by the
/// signs of its rays.
bool SmallCone::try_begin(RowSet& done) {
  const std::size_t d = dimension_;
  std::array<std::array<double, most_entries>, most_entries> reduced;
  std::array<std::uint8_t, most_entries> basis, pivots;
  std::size_t size = 0;
  for (std::size_t i = 0; i < rows_.size() && size <= d; ++i) {
    std::array<double, most_entries> row = rows_[i];
    double before = 0;
    for (std::size_t c = 0; c <= d; ++c) before = std::max(before, std::abs(row[c]));
    for (std::size_t j = 0; j < size; ++j) {
      const double factor = row[pivots[j]] / reduced[j][pivots[j]];
      for (std::size_t c = 0; c <= d; ++c) row[c] -= factor * reduced[j][c];
      row[pivots[j]] = 0;
    }
    std::size_t pivot = 0;
    for (std::size_t c = 1; c <= d; ++c)
      if (std::abs(row[c]) > std::abs(row[pivot])) pivot = c;
    if (!(std::abs(row[pivot]) > 1e-6 * before)) continue;
    reduced[size] = row;
    pivots[size] = static_cast<std::uint8_t>(pivot);
    basis[size++] = static_cast<std::uint8_t>(i);
  }
  if (size <= d) return false;
  for (std::size_t i = 0; i <= d; ++i) done |= row_bit(basis[i]);
  rays_.clear();
  for (std::size_t i = 0; i <= d; ++i) {
    Ray ray;
    for (std::size_t j = 0, k = 0; j <= d; ++j)
      if (j != i) ray.on[k++] = basis[j];
    set_minors(ray);
    const int sign = sign_at(basis[i], ray);
    if (sign == 0) return false;
    if (sign < 0) {
      ray.is_negated = true;
      for (std::size_t c = 0; c <= d; ++c) ray.x[c] = -ray.x[c];
    }
    ray.zeros = done & ~row_bit(basis[i]);
    rays_.push_back(ray);
  }
  return true;
}

bool SmallCone::try_cut(std::size_t row, RowSet done) {
  std::array<std::int8_t, most_rays> signs;
  bool cuts = false;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    signs[i] = static_cast<std::int8_t>(sign_at(row, rays_[i]));
    cuts = cuts || signs[i] < 0;
    if (signs[i] == 0) rays_[i].zeros |= row_bit(row);
  }
  if (!cuts) return true;
  next_.clear();
  for (std::size_t i = 0; i < rays_.size(); ++i)
    if (signs[i] >= 0) next_.push_back(rays_[i]);
  for (std::size_t p = 0; p < rays_.size(); ++p) {
    if (signs[p] <= 0) continue;
    for (std::size_t n = 0; n < rays_.size(); ++n) {
      if (signs[n] >= 0 || !is_edge(rays_[p], rays_[n])) continue;
      const RowSet common = rays_[p].zeros & rays_[n].zeros;
      Ray made;
      if (next_.size() == most_rays || !try_make_ray(common | row_bit(row), common, done, made)) return false;
      next_.push_back(made);
    }
  }
  std::swap(rays_, next_);
  return true;
}

/// Two rays span a face of dimension two if no third ray lies on all rows that both lie on. These have rank
/// d − 1 then, and so at least as many rows.
bool SmallCone::is_edge(const Ray& a, const Ray& b) const {
  const RowSet common = a.zeros & b.zeros;
  if (static_cast<std::size_t>(std::popcount(common)) + 1 < dimension_) return false;
  return std::none_of(rays_.begin(), rays_.end(), [&](const Ray& other) {
    return &other != &a && &other != &b && (other.zeros & common) == common;
  });
}

/// The ray of an edge and the row that cuts it, the one of `zeros` that is not `common`. It lies on no other
/// row of `done`, and on the inner side of those.
bool SmallCone::try_make_ray(RowSet zeros, RowSet common, RowSet done, Ray& made) const {
  const std::size_t d = dimension_;
  made.zeros = zeros;
  std::array<std::uint8_t, 64> candidates;
  std::size_t size = 0;
  for_each_row(common, [&](std::size_t row) {
    candidates[size++] = static_cast<std::uint8_t>(row);
    return true;
  });
  // The first d − 1 of them that are surely independent together with the row.
  std::array<std::size_t, most_dimensions> chosen;
  for (std::size_t i = 0; i + 1 < d; ++i) chosen[i] = i;
  made.on[d - 1] = static_cast<std::uint8_t>(std::countr_zero(zeros & ~common));
  for (;;) {
    for (std::size_t i = 0; i + 1 < d; ++i) made.on[i] = candidates[chosen[i]];
    set_minors(made);
    if (is_surely_a_ray(made)) break;
    std::size_t i = d - 1;
    while (i > 0 && chosen[i - 1] == size - (d - i)) --i;
    if (i == 0) return false;
    ++chosen[i - 1];
    for (std::size_t j = i; j + 1 < d; ++j) chosen[j] = chosen[j - 1] + 1;
  }
  int sign = 0;
  for_each_row(done & ~zeros, [&](std::size_t row) {
    sign = sign_at(row, made);
    return false;
  });
  if (sign == 0) return false;  // never: the cone has no line, and the ray lies on the rows of `zeros` alone
  if (sign < 0) {
    made.is_negated = true;
    for (std::size_t c = 0; c <= d; ++c) made.x[c] = -made.x[c];
  }
  return true;
}

void SmallCone::set_minors(Ray& ray) const {
  const auto entry = [&](std::size_t i, std::size_t c) { return rows_[ray.on[i]][c]; };
  find_minors(dimension_, entry, ray.x.data());
  find_minors<true>(
      dimension_, [&](std::size_t i, std::size_t c) { return std::abs(entry(i, c)); }, ray.magnitudes.data());
  ray.is_exact = true;
  for (std::size_t c = 0; c <= dimension_; ++c)
    ray.is_exact = ray.is_exact && ray.magnitudes[c] < largest_exact;
}

bool SmallCone::is_surely_a_ray(const Ray& ray) const {
  for (std::size_t c = 0; c <= dimension_; ++c)
    if (std::abs(ray.x[c]) > (ray.is_exact ? 0 : error_of_magnitude * ray.magnitudes[c])) return true;
  return false;
}

/// Of an integer.
SmallCone::Wide SmallCone::as_wide(double x) {
  if (std::abs(x) < 0x1p62) return static_cast<std::int64_t>(x);
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return Wide(static_cast<std::int64_t>(fraction * 0x1p53)) * (Wide(1) << (exponent - 53));
}

int SmallCone::sign_at(std::size_t row, const Ray& ray) const {
  const std::array<double, most_entries>& a = rows_[row];
  double sum = 0, magnitude = 0;
  for (std::size_t c = 0; c <= dimension_; ++c) {
    sum += a[c] * ray.x[c];
    magnitude += std::abs(a[c]) * ray.magnitudes[c];
  }
  if (magnitude < largest_exact || std::abs(sum) > error_of_magnitude * magnitude)
    return sum > 0 ? 1 : sum < 0 ? -1 : 0;
  const std::array<Wide, most_entries> x = exact_minors(ray);
  Wide exact = 0;
  for (std::size_t c = 0; c <= dimension_; ++c) exact += as_wide(a[c]) * x[c];
  return ray.is_negated ? -exact.sign() : exact.sign();
}

std::array<SmallCone::Wide, SmallCone::most_entries> SmallCone::exact_minors(const Ray& ray) const {
  std::array<Wide, most_entries> x;
  find_minors(
      dimension_, [&](std::size_t i, std::size_t c) { return as_wide(rows_[ray.on[i]][c]); }, x.data());
  return x;
}

Row SmallCone::exact_ray(const Ray& ray) const {
  const std::array<Wide, most_entries> x = exact_minors(ray);
  Row row;
  for (std::size_t c = 0; c <= dimension_; ++c) row.emplace_back(ray.is_negated ? Wide(-x[c]) : x[c]);
  return row;
}

void SmallCone::collect() {
  std::vector<Corner> corners;
  for (const Ray& ray : rays_) {
    if ((ray.zeros & 1) == 0) {
      corners.push_back({&ray, {}});
      round(corners.back());
      continue;
    }
    directions_.push_back(exact_ray(ray));
    make_primitive(directions_.back());
    directions_.back().pop_back();
  }
  std::sort(directions_.begin(), directions_.end());
  std::sort(corners.begin(), corners.end(), [&](const Corner& a, const Corner& b) { return precedes(a, b); });
  for (const Corner& corner : corners)
    for (std::size_t c = 0; c < dimension_; ++c) vertices_.push_back(corner.at[c]);
}

void SmallCone::round(Corner& corner) const {
  const Ray& ray = *corner.ray;
  if (ray.is_exact) {
    for (std::size_t c = 0; c < dimension_; ++c) corner.at[c] = ray.x[c] / ray.x[dimension_] + 0.0;
    return;
  }
  if (try_round(corner)) return;
  const Row row = exact_ray(ray);
  for (std::size_t c = 0; c < dimension_; ++c) corner.at[c] = kernel::nearest_double(row[c], row.back(), 0);
}

/// In pairs of doubles. Each term of a minor has had at most 27 roundings, of at most 9·2^−106 each, so
/// minors are off by less than 2^−97 times their magnitudes. The quotient q of two of them is corrected once,
/// which leaves less than 2^−98·|q|. The bound of both together is twice what it has to be, for its own
/// roundings. A quotient is rounded if all numbers within the bound are rounded to the same.
bool SmallCone::try_round(Corner& corner) const {
  const Ray& ray = *corner.ray;
  std::array<DoubleDouble, most_entries> x;
  find_minors(
      dimension_,
      [&](std::size_t i, std::size_t c) {
        return DoubleDouble{rows_[ray.on[i]][c], 0};
      },
      x.data());
  const DoubleDouble& divisor = x[dimension_];
  const double size_of_divisor = ray.magnitudes[dimension_];
  if (!(std::abs(divisor.high) > 0x1p-60 * size_of_divisor)) return false;
  for (std::size_t c = 0; c < dimension_; ++c) {
    const double first = x[c].high / divisor.high;
    const double second = (x[c] - DoubleDouble{first, 0} * divisor).high / divisor.high;
    const DoubleDouble quotient = kernel::two_sum(first, second);
    const double bound =
        0x1p-95 * (ray.magnitudes[c] + std::abs(first) * size_of_divisor) / std::abs(divisor.high);
    if (quotient.high + (quotient.low + bound) != quotient.high ||
        quotient.high + (quotient.low - bound) != quotient.high)
      return false;
    corner.at[c] = quotient.high + 0.0;
  }
  return true;
}

/// Coordinates that are rounded to the same are compared exactly.
bool SmallCone::precedes(const Corner& a, const Corner& b) const {
  for (std::size_t c = 0; c < dimension_; ++c) {
    if (a.at[c] != b.at[c]) return a.at[c] < b.at[c];
    if ((a.ray->zeros & b.ray->zeros & axis_rows_[c]) != 0) continue;  // x[c] = b there
    if (a.ray->is_exact && b.ray->is_exact) {
      const Int128 left = product(a.ray->x[c], b.ray->x[dimension_]),
                   right = product(b.ray->x[c], a.ray->x[dimension_]);
      if (left != right) return left < right;
      continue;
    }
    const Row x = exact_ray(*a.ray), y = exact_ray(*b.ray);
    const Integer left = x[c] * y.back(), right = y[c] * x.back();
    if (left != right) return left < right;
  }
  return false;
}

}  // namespace delone::polyhedra
