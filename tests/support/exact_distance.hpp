// SPDX-License-Identifier: BSD-3-Clause
// The squared distance of a point from the convex hull of a few points with rationals, by trying all
// simplices: slow, and independent of the library.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::test {

using Rational = boost::multiprecision::cpp_rational;

/// The solution of A·x = b; none if A is singular.
inline std::optional<std::vector<Rational>> solve(std::vector<std::vector<Rational>> augmented) {
  const std::size_t n = augmented.size();
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (pivot < n && augmented[pivot][s] == 0) ++pivot;
    if (pivot == n) return std::nullopt;
    std::swap(augmented[pivot], augmented[s]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s || augmented[r][s] == 0) continue;
      const Rational factor = augmented[r][s] / augmented[s][s];
      for (std::size_t c = s; c <= n; ++c) augmented[r][c] -= factor * augmented[s][c];
    }
  }
  std::vector<Rational> x;
  for (std::size_t s = 0; s < n; ++s) x.push_back(augmented[s][n] / augmented[s][s]);
  return x;
}

/// The squared distance of q from the flat through points; none if these are dependent. With `within` only if
/// the nearest point of the flat is in the simplex.
inline std::optional<Rational> squared_distance_from_flat(const std::vector<const double*>& points,
                                                          const double* q, std::size_t d, bool within) {
  std::vector<std::vector<Rational>> edges;
  std::vector<Rational> t;
  for (std::size_t j = 0; j < d; ++j) t.push_back(Rational(q[j]) - Rational(points[0][j]));
  for (std::size_t i = 1; i < points.size(); ++i) {
    edges.emplace_back();
    for (std::size_t j = 0; j < d; ++j)
      edges.back().push_back(Rational(points[i][j]) - Rational(points[0][j]));
  }
  const auto dot = [d](const std::vector<Rational>& a, const std::vector<Rational>& b) {
    Rational sum(0);
    for (std::size_t j = 0; j < d; ++j) sum += a[j] * b[j];
    return sum;
  };
  std::vector<std::vector<Rational>> normal_equations;
  for (const auto& edge : edges) {
    normal_equations.emplace_back();
    for (const auto& other : edges) normal_equations.back().push_back(dot(edge, other));
    normal_equations.back().push_back(dot(edge, t));
  }
  const auto weights = solve(normal_equations);
  if (!weights) return std::nullopt;
  Rational rest(1);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    rest -= (*weights)[i];
    if (within && (*weights)[i] < 0) return std::nullopt;
    for (std::size_t j = 0; j < d; ++j) t[j] -= (*weights)[i] * edges[i][j];
  }
  if (within && rest < 0) return std::nullopt;
  return dot(t, t);
}

/// The least over all simplices of at most d + 1 of the points.
inline Rational squared_distance_from_hull(const std::vector<const double*>& points, const double* q,
                                           std::size_t d) {
  Rational least(-1);
  std::vector<const double*> simplex;
  const auto visit = [&](auto& self, std::size_t next) -> void {
    if (!simplex.empty())
      if (const auto square = squared_distance_from_flat(simplex, q, d, true);
          square && (least < 0 || *square < least))
        least = *square;
    if (simplex.size() > d) return;
    for (std::size_t i = next; i < points.size(); ++i) {
      simplex.push_back(points[i]);
      self(self, i + 1);
      simplex.pop_back();
    }
  };
  visit(visit, 0);
  return least;
}

}  // namespace delone::test
