// SPDX-License-Identifier: BSD-3-Clause
// Distances of a point from flats and from the convex hull of a few points with rationals, by trying
// simplices: slow, and independent of the library.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
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

/// Whether q is within a distance of the convex hull of a few points, proved by a simplex of at most d + 1 of
/// them. Binary64 chooses the simplices that are tried.
inline bool is_within(const std::vector<const double*>& points, const double* q, std::size_t d,
                      double distance) {
  struct Candidate {
    double square;
    std::vector<const double*> simplex;
  };
  double scale = 0;
  for (const double* p : points)
    for (std::size_t j = 0; j < d; ++j) scale = std::max(scale, std::fabs(p[j] / 4 - q[j] / 4));
  std::vector<Candidate> candidates;
  std::vector<const double*> simplex;
  const auto add = [&] {
    const std::size_t n = simplex.size() - 1;
    std::vector<std::vector<double>> edges(n, std::vector<double>(d)), a(n, std::vector<double>(n + 1, 0.0));
    std::vector<double> t(d), weights(n);
    const auto unit = [&](double x, double y) { return scale == 0 ? 0.0 : (x / 4 - y / 4) / scale; };
    for (std::size_t j = 0; j < d; ++j) t[j] = unit(q[j], simplex[0][j]);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < d; ++j) edges[i][j] = unit(simplex[i + 1][j], simplex[0][j]);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c <= n; ++c)
        for (std::size_t j = 0; j < d; ++j) a[r][c] += edges[r][j] * (c < n ? edges[c][j] : t[j]);
    for (std::size_t s = 0; s < n; ++s) {
      std::size_t pivot = s;
      for (std::size_t r = s + 1; r < n; ++r)
        if (std::fabs(a[r][s]) > std::fabs(a[pivot][s])) pivot = r;
      std::swap(a[pivot], a[s]);
      if (a[s][s] == 0) return;
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t c = n + 1; c-- > s && r != s;) a[r][c] -= a[r][s] / a[s][s] * a[s][c];
    }
    double rest = 1;
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = a[i][n] / a[i][i];
      rest -= weight;
      if (weight < -1e-6) return;
      for (std::size_t j = 0; j < d; ++j) t[j] -= weight * edges[i][j];
    }
    if (rest < -1e-6) return;
    double square = 0;
    for (const double x : t) square += x * x;
    candidates.push_back({square, simplex});
  };
  const auto visit = [&](auto& self, std::size_t next) -> void {
    if (!simplex.empty()) add();
    if (simplex.size() > d) return;
    for (std::size_t i = next; i < points.size(); ++i) {
      simplex.push_back(points[i]);
      self(self, i + 1);
      simplex.pop_back();
    }
  };
  visit(visit, 0);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.square < b.square; });
  if (candidates.size() > 60) candidates.resize(60);
  const Rational bound = Rational(distance) * Rational(distance);
  return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
    const auto square = squared_distance_from_flat(candidate.simplex, q, d, true);
    return square && *square <= bound;
  });
}

}  // namespace delone::test
