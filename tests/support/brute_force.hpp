// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay, regular or furthest-site triangulation by its definition: every subset of k+1 points is tried
// against every other point, in integers without error. Slow and simple, and independent of the
// library's predicates, so that the two can disagree.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/types.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace delone::test {

using Integer = boost::multiprecision::cpp_int;
using Matrix = std::vector<std::vector<Integer>>;

/// The determinant of a square matrix by fraction-free elimination (Bareiss 1968): all divisions are exact.
inline Integer determinant(Matrix a) {
  const std::size_t n = a.size();
  Integer previous = 1;
  bool negative = false;
  for (std::size_t p = 0; p < n; ++p) {
    std::size_t pivot = p;
    while (pivot < n && a[pivot][p] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != p) {
      std::swap(a[pivot], a[p]);
      negative = !negative;
    }
    for (std::size_t i = p + 1; i < n; ++i)
      for (std::size_t j = p + 1; j < n; ++j)
        a[i][j] = Integer(a[i][j] * a[p][p] - a[i][p] * a[p][j]) / previous;
    previous = a[p][p];
  }
  return negative ? Integer(-previous) : previous;
}

/// The columns in which an elimination finds pivots, as far left as possible: their number is the rank.
inline std::vector<std::size_t> pivot_columns(Matrix a) {
  std::vector<std::size_t> pivots;
  for (std::size_t column = 0; !a.empty() && column < a[0].size(); ++column) {
    const std::size_t p = pivots.size();
    std::size_t pivot = p;
    while (pivot < a.size() && a[pivot][column] == 0) ++pivot;
    if (pivot == a.size()) continue;
    std::swap(a[pivot], a[p]);
    for (std::size_t i = p + 1; i < a.size(); ++i) {
      const Integer factor = a[i][column];
      for (std::size_t j = column; j < a[i].size(); ++j)
        a[i][j] = Integer(a[i][j] * a[p][column] - factor * a[p][j]);
    }
    pivots.push_back(column);
  }
  return pivots;
}

inline Sign sign_of(const Integer& x) { return x < 0 ? Sign::negative : x > 0 ? Sign::positive : Sign::zero; }

/// The largest e so that all numbers are multiples of 2^e; 0 if all are 0.
inline int common_exponent(std::span<const double> numbers) {
  int lowest = 0;
  bool any = false;
  for (const double x : numbers)
    if (x != 0) {
      int exponent;
      auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
      for (exponent -= 53; mantissa % 2 == 0; ++exponent) mantissa /= 2;
      lowest = any ? std::min(lowest, exponent) : exponent;
      any = true;
    }
  return lowest;
}

/// Points as integers: all coordinates in units of 2^lowest, which changes no orientation, sphere or order.
inline Matrix scaled_to_integers(std::span<const double> coordinates, int dimension, int lowest) {
  Matrix rows;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (i % static_cast<std::size_t>(dimension) == 0) rows.emplace_back();
    int exponent;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(coordinates[i], &exponent), 53));
    // For numbers with few bits the shift is negative, and drops zeros only.
    const int shift = exponent - 53 - lowest;
    const Integer value = mantissa;
    rows.back().push_back(mantissa == 0 ? Integer(0)
                          : shift >= 0  ? Integer(value << shift)
                                        : Integer(value / (Integer(1) << -shift)));
  }
  return rows;
}
inline Matrix scaled_to_integers(std::span<const double> coordinates, int dimension) {
  return scaled_to_integers(coordinates, dimension, common_exponent(coordinates));
}

/// Exact answers about n points of R^d and, if given, some queries (rows n, n+1, …), which are not vertices.
/// Points may have weights, which lower their lifts; then vertices() are the distinct weighted points, some
/// of them hidden. `furthest`: all lifts are negated.
class BruteForce {
 public:
  using Rows = std::vector<SignedIndex>;

  BruteForce(std::span<const double> points, int dimension, std::span<const double> queries = {},
             std::span<const double> weights = {}, bool furthest = false)
      : d_(static_cast<std::size_t>(dimension)),
        num_points_(points.size() / d_),
        coordinates_(points.begin(), points.end()),
        weights_(weights.begin(), weights.end()),
        may_hide_(furthest || !weights.empty()) {
    coordinates_.insert(coordinates_.end(), queries.begin(), queries.end());
    int lowest = common_exponent(coordinates_);
    // A weight is a number of units of an area.
    if (!weights.empty()) lowest = std::min(lowest, (common_exponent(weights) - 1) / 2 - 1);
    rows_ = scaled_to_integers(coordinates_, dimension, lowest);
    const Matrix weight_rows = scaled_to_integers(weights, 1, 2 * lowest);
    for (const auto& row : rows_) {
      Integer lift = 0;
      for (const Integer& x : row) lift += x * x;
      if (lifts_.size() < weight_rows.size()) lift -= weight_rows[lifts_.size()][0];
      lifts_.push_back(furthest ? Integer(-lift) : lift);
    }
    for (std::size_t row = 0; row < num_points_; ++row) {
      std::size_t first = 0;
      while (rows_[first] != rows_[row] || lifts_[first] != lifts_[row]) ++first;
      first_row_.push_back(static_cast<SignedIndex>(first));
      if (first == row) vertices_.push_back(static_cast<SignedIndex>(row));
    }
    find_flat();
  }

  int affine_dimension() const { return static_cast<int>(basis_.size()) - 1; }
  /// The distinct points: the first row of each.
  const Rows& vertices() const { return vertices_; }
  SignedIndex first_row(SignedIndex row) const { return first_row_[at(row)]; }
  bool equal(SignedIndex a, SignedIndex b) const {
    return rows_[at(a)] == rows_[at(b)] && lifts_[at(a)] == lifts_[at(b)];
  }

  /// Whether the point of this row lies in the affine hull of the points.
  bool in_flat(SignedIndex row) const {
    Matrix differences;
    for (std::size_t i = 1; i < basis_.size(); ++i) differences.push_back(difference(basis_[i], basis_[0]));
    if (basis_.empty()) return false;
    differences.push_back(difference(row, basis_[0]));
    return pivot_columns(differences).size() == basis_.size() - 1;
  }

  /// The sign of det(p_i − p_0) on the axes of the flat; k+1 rows.
  Sign orientation(const Rows& simplex) const { return sign_of(determinant(edges(simplex))); }

  /// The signs of the barycentric coordinates of a point of the flat with respect to a simplex that is not
  /// flat.
  std::vector<Sign> barycentric_signs(const Rows& simplex, SignedIndex row) const {
    std::vector<Sign> signs;
    const Sign whole = orientation(simplex);
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      Rows replaced = simplex;
      replaced[i] = row;
      signs.push_back(orientation(replaced) * whole);
    }
    return signs;
  }

  /// |x|² − a·x − b, which vanishes at the vertices of a simplex that is not flat: its sign is − inside, 0
  /// on, + outside the sphere. By Cramer's rule a = slope/scale on a·(v_i − v_0) = |v_i|² − |v_0|².
  struct Sphere {
    Rows simplex;
    Integer scale;
    std::vector<Integer> slope;
  };
  Sphere sphere(const Rows& simplex) const {
    const Matrix e = edges(simplex);
    Sphere result{simplex, determinant(e), {}};
    for (std::size_t j = 0; j < e.size(); ++j) {
      Matrix replaced = e;
      for (std::size_t i = 0; i < e.size(); ++i)
        replaced[i][j] = lifts_[at(simplex[i + 1])] - lifts_[at(simplex[0])];
      result.slope.push_back(determinant(replaced));
    }
    return result;
  }
  /// The sign of the distance: negative inside.
  Sign in_sphere(const Sphere& sphere, SignedIndex row) const {
    const SignedIndex origin = sphere.simplex[0];
    Integer value = sphere.scale * (lifts_[at(row)] - lifts_[at(origin)]);
    for (std::size_t j = 0; j < sphere.slope.size(); ++j)
      value -= sphere.slope[j] * (rows_[at(row)][axes_[j]] - rows_[at(origin)][axes_[j]]);
    return sign_of(value) * sign_of(sphere.scale);
  }
  Sign in_sphere(const Rows& simplex, SignedIndex row) const { return in_sphere(sphere(simplex), row); }

  Side side_of_sphere(const Rows& simplex, SignedIndex row) const {
    return static_cast<Side>(-static_cast<int>(in_sphere(simplex, row)));
  }

  /// Whether the point is inside the sphere when the lift of every point is raised by its own ε, larger ε for
  /// lexicographically larger coordinates. False for a vertex of the simplex.
  bool in_conflict(const Rows& simplex, SignedIndex row) const { return in_conflict(sphere(simplex), row); }
  bool in_conflict(const Sphere& sphere, SignedIndex row) const {
    const Rows& simplex = sphere.simplex;
    if (const Sign sign = in_sphere(sphere, row); sign != Sign::zero) return sign == Sign::negative;
    for (const SignedIndex vertex : simplex)
      if (equal(vertex, row)) return false;
    // Raising q by ε moves it out. Raising v_i by ε raises the sphere's plane at q by ε times the coordinate
    // of q at v_i.
    Rows involved = simplex;
    involved.push_back(row);
    std::sort(involved.begin(), involved.end(),
              [&](SignedIndex a, SignedIndex b) { return rows_[at(a)] > rows_[at(b)]; });
    const std::vector<Sign> signs = barycentric_signs(simplex, row);
    for (const SignedIndex next : involved) {
      if (next == row) return false;
      const auto i =
          static_cast<std::size_t>(std::find(simplex.begin(), simplex.end(), next) - simplex.begin());
      if (signs[i] != Sign::zero) return signs[i] == Sign::positive;
    }
    return false;
  }

  /// The cells: increasing rows of distinct points, sorted.
  std::vector<Rows> cells() const {
    std::vector<Rows> result;
    const std::size_t size = basis_.size();
    if (size == 0) return result;
    std::vector<bool> chosen(vertices_.size(), false);
    std::fill_n(chosen.begin(), size, true);
    do {
      Rows simplex;
      for (std::size_t i = 0; i < vertices_.size(); ++i)
        if (chosen[i]) simplex.push_back(vertices_[i]);
      if (orientation(simplex) == Sign::zero) continue;
      const Sphere empty = sphere(simplex);
      const bool is_empty = std::none_of(vertices_.begin(), vertices_.end(),
                                         [&](SignedIndex vertex) { return in_conflict(empty, vertex); });
      if (is_empty) result.push_back(simplex);
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    std::sort(result.begin(), result.end());
    return result;
  }

  /// The triangulation as plain data, cells positively oriented on the axes of the flat.
  ComplexData to_data() const {
    ComplexData data;
    data.dimension = static_cast<int>(d_);
    data.affine_dimension = affine_dimension();
    data.points.assign(coordinates_.begin(),
                       coordinates_.begin() + static_cast<std::ptrdiff_t>(num_points_ * d_));
    data.vertex_of_point = first_row_;
    for (Rows cell : cells()) {
      if (orientation(cell) == Sign::negative) std::swap(cell[0], cell[1]);
      data.cells.insert(data.cells.end(), cell.begin(), cell.end());
    }
    data.weights = weights_;
    if (may_hide_)
      for (SignedIndex& row : data.vertex_of_point)
        if (std::find(data.cells.begin(), data.cells.end(), row) == data.cells.end()) row = -1;
    return data;
  }

 private:
  static std::size_t at(SignedIndex row) { return static_cast<std::size_t>(row); }

  std::vector<Integer> difference(SignedIndex a, SignedIndex b) const {
    std::vector<Integer> result;
    for (std::size_t j = 0; j < d_; ++j) result.push_back(rows_[at(a)][j] - rows_[at(b)][j]);
    return result;
  }

  Matrix edges(const Rows& simplex) const {
    Matrix result;
    for (std::size_t i = 1; i < simplex.size(); ++i) {
      result.emplace_back();
      for (const std::size_t axis : axes_)
        result.back().push_back(rows_[at(simplex[i])][axis] - rows_[at(simplex[0])][axis]);
    }
    return result;
  }

  void find_flat() {
    Matrix differences;
    for (const SignedIndex vertex : vertices_) {
      if (basis_.empty()) {
        basis_.push_back(vertex);
        continue;
      }
      if (basis_.size() == d_ + 1) break;
      differences.push_back(difference(vertex, basis_[0]));
      if (auto pivots = pivot_columns(differences); pivots.size() == differences.size()) {
        axes_ = std::move(pivots);
        basis_.push_back(vertex);
      } else {
        differences.pop_back();
      }
    }
  }

  std::size_t d_, num_points_;
  std::vector<double> coordinates_, weights_;
  bool may_hide_;
  Matrix rows_;
  std::vector<Integer> lifts_;
  Rows first_row_, vertices_, basis_;
  std::vector<std::size_t> axes_;
};

}  // namespace delone::test
