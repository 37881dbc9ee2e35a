// SPDX-License-Identifier: BSD-3-Clause
// The rays of a cone by trying all sets of rows, in fractions: an oracle for small cones that shares nothing
// with the library.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace delone::brute_force {

using Number = boost::multiprecision::cpp_rational;
using Vector = std::vector<Number>;
using Matrix = std::vector<Vector>;

inline Number dot(const Vector& a, const Vector& b) {
  Number sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// A basis of {x ∈ R^n : rows·x = 0}, by the elimination of Gauss and Jordan.
inline Matrix null_space(Matrix rows, std::size_t n) {
  std::vector<std::size_t> pivots;
  for (std::size_t column = 0, top = 0; column < n && top < rows.size(); ++column) {
    std::size_t pivot = top;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[top]);
    const Number factor = rows[top][column];
    for (Number& x : rows[top]) x /= factor;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == top) continue;
      const Number multiple = rows[i][column];
      for (std::size_t c = 0; c < n; ++c) rows[i][c] -= multiple * rows[top][c];
    }
    pivots.push_back(column);
    ++top;
  }
  Matrix basis;
  for (std::size_t free = 0; free < n; ++free) {
    if (std::find(pivots.begin(), pivots.end(), free) != pivots.end()) continue;
    Vector vector(n, Number(0));
    vector[free] = 1;
    for (std::size_t i = 0; i < pivots.size(); ++i) vector[pivots[i]] = -rows[i][free];
    basis.push_back(vector);
  }
  return basis;
}

/// The vector orthogonal to the basis that differs from x by vectors of the space, divided by the magnitude
/// of its first entry that is not 0.
inline Vector normal_form(Vector x, const Matrix& basis) {
  Matrix orthogonal;
  for (Vector vector : basis) {
    for (const Vector& other : orthogonal) {
      const Number factor = dot(vector, other) / dot(other, other);
      for (std::size_t i = 0; i < x.size(); ++i) vector[i] -= factor * other[i];
    }
    orthogonal.push_back(vector);
  }
  for (const Vector& other : orthogonal) {
    const Number factor = dot(x, other) / dot(other, other);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= factor * other[i];
  }
  const auto first = std::find_if(x.begin(), x.end(), [](const Number& entry) { return entry != 0; });
  if (first == x.end()) return x;
  const Number size = abs(*first);
  for (Number& entry : x) entry /= size;
  return x;
}

struct Cone {
  std::set<Vector> rays;  ///< in normal form
  Matrix lines;           ///< a basis
};

/// {x ∈ R^n : rows·x ≥ 0, equations·x = 0}.
inline Cone find_cone(const Matrix& rows, const Matrix& equations, std::size_t n) {
  Cone cone;
  Matrix all = equations;
  all.insert(all.end(), rows.begin(), rows.end());
  cone.lines = null_space(all, n);
  Matrix fixed = equations;
  fixed.insert(fixed.end(), cone.lines.begin(), cone.lines.end());
  const std::size_t dimension = null_space(fixed, n).size();
  if (dimension == 0) return cone;
  std::vector<char> chosen(rows.size(), 0);
  if (rows.size() + 1 < dimension) return cone;
  std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(dimension - 1), 1);
  do {
    Matrix zero = fixed;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (chosen[i]) zero.push_back(rows[i]);
    const Matrix solutions = null_space(zero, n);
    if (solutions.size() != 1) continue;
    for (const int sign : {1, -1}) {
      Vector x = solutions.front();
      for (Number& entry : x) entry *= sign;
      if (std::all_of(rows.begin(), rows.end(), [&](const Vector& row) { return dot(row, x) >= 0; }))
        cone.rays.insert(normal_form(x, cone.lines));
    }
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return cone;
}

}  // namespace delone::brute_force
