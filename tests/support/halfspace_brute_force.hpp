// SPDX-License-Identifier: BSD-3-Clause
// Intersections of halfspaces by their definition, in rational numbers: every k rows are tried for a vertex,
// every k−1 for a direction, every d+1 for a proof that there is no interior point.
#pragma once

#include <delone/halfspaces.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace delone::test {

using Rational = boost::multiprecision::cpp_rational;
using RationalRow = std::vector<Rational>;

/// Row-echelon form; returns the pivot columns.
inline std::vector<std::size_t> eliminate(std::vector<RationalRow>& rows, std::size_t columns) {
  std::vector<std::size_t> pivots;
  for (std::size_t c = 0; c < columns && pivots.size() < rows.size(); ++c) {
    std::size_t r = pivots.size();
    while (r < rows.size() && rows[r][c] == 0) ++r;
    if (r == rows.size()) continue;
    std::swap(rows[r], rows[pivots.size()]);
    RationalRow& pivot = rows[pivots.size()];
    const Rational scale = pivot[c];
    for (Rational& x : pivot) x /= scale;
    for (std::size_t other = 0; other < rows.size(); ++other) {
      if (other == pivots.size() || rows[other][c] == 0) continue;
      const Rational factor = rows[other][c];
      for (std::size_t j = 0; j < rows[other].size(); ++j) rows[other][j] -= factor * rows[pivots.size()][j];
    }
    pivots.push_back(c);
  }
  return pivots;
}

inline std::size_t rank_of(std::vector<RationalRow> rows) {
  return rows.empty() ? 0 : eliminate(rows, rows.front().size()).size();
}

/// Calls visit(indices) for every subset of `size` of n.
template <class Visit>
void for_each_subset(std::size_t n, std::size_t size, Visit visit) {
  if (size > n) return;
  std::vector<std::size_t> chosen(size);
  for (std::size_t i = 0; i < size; ++i) chosen[i] = i;
  for (;;) {
    visit(chosen);
    std::size_t i = size;
    while (i > 0 && chosen[i - 1] == n - size + i - 1) --i;
    if (i == 0) return;
    ++chosen[i - 1];
    for (std::size_t j = i; j < size; ++j) chosen[j] = chosen[j - 1] + 1;
  }
}

class HalfspaceBruteForce {
 public:
  using Rows = std::vector<SignedIndex>;

  /// `axes`: columns to work in where the normals do not span all.
  HalfspaceBruteForce(std::span<const double> halfspaces, int dimension)
      : d_(static_cast<std::size_t>(dimension)) {
    for (std::size_t i = 0; i < halfspaces.size(); i += d_ + 1)
      rows_.emplace_back(halfspaces.begin() + static_cast<std::ptrdiff_t>(i),
                         halfspaces.begin() + static_cast<std::ptrdiff_t>(i + d_ + 1));
    find_state();
    rank_ = rank_of(normals(all_rows(), all_columns()));
  }

  IntersectionState state() const { return state_; }
  std::size_t rank() const { return rank_; }
  /// Whether the given rows alone have no interior point.
  static bool has_no_interior(std::span<const double> halfspaces, int dimension,
                              std::span<const SignedIndex> rows) {
    std::vector<double> some;
    const auto width = static_cast<std::size_t>(dimension) + 1;
    for (const SignedIndex r : rows)
      for (std::size_t j = 0; j < width; ++j)
        some.push_back(halfspaces[static_cast<std::size_t>(r) * width + j]);
    return HalfspaceBruteForce(some, dimension).state() != IntersectionState::full;
  }

  /// Finds vertices and directions in these columns. REQUIRES that they have full rank.
  void solve(const std::vector<int>& axes) {
    axes_.assign(axes.begin(), axes.end());
    const std::size_t k = axes_.size();
    for_each_subset(rows_.size(), k, [&](const std::vector<std::size_t>& chosen) {
      std::vector<RationalRow> system;
      for (const std::size_t r : chosen) {
        system.push_back(restricted(r));
        system.back().push_back(-rows_[r][d_]);
      }
      if (eliminate(system, k).size() < k) return;
      RationalRow x;
      for (const RationalRow& row : system) x.push_back(row[k]);
      add(x, true, vertices);
    });
    for_each_subset(rows_.size(), k - 1, [&](const std::vector<std::size_t>& chosen) {
      std::vector<RationalRow> system;
      for (const std::size_t r : chosen) system.push_back(restricted(r));
      const auto pivots = eliminate(system, k);
      if (pivots.size() + 1 < k) return;
      std::size_t free = 0;
      while (free < pivots.size() && pivots[free] == free) ++free;
      RationalRow u(k, Rational(0));
      u[free] = 1;
      for (std::size_t i = 0; i < pivots.size(); ++i) u[pivots[i]] = -system[i][free];
      Rational largest = 0;
      for (const Rational& x : u) largest = std::max(largest, Rational(abs(x)));
      for (Rational& x : u) x /= largest;
      add(u, false, directions);
      for (Rational& x : u) x = -x;
      add(u, false, directions);
    });
  }

  /// Exact points, or directions scaled to a largest entry of 1, with all rows that hold with equality.
  std::map<RationalRow, Rows> vertices, directions;

  HalfspaceKind kind(std::size_t r) const {
    if (!has_normal(r)) return HalfspaceKind::trivial;
    if (first_of(r) != r) return HalfspaceKind::duplicate;
    std::vector<RationalRow> touched;
    bool at_vertex = false;
    for (const auto& [x, tight] : vertices)
      if (contains(tight, r)) {
        touched.push_back(x);
        touched.back().push_back(1);
        at_vertex = true;
      }
    for (const auto& [u, tight] : directions)
      if (contains(tight, r)) {
        touched.push_back(u);
        touched.back().push_back(0);
      }
    if (!at_vertex) return HalfspaceKind::redundant;
    return rank_of(touched) == axes_.size() ? HalfspaceKind::facet : HalfspaceKind::touching;
  }
  std::size_t first_of(std::size_t r) const {
    if (!has_normal(r)) return r;
    for (std::size_t other = 0; other < r; ++other)
      if (has_normal(other) && are_proportional(rows_[other], rows_[r])) return other;
    return r;
  }
  /// The rows that hold with equality and define facets.
  Rows facets_among(const Rows& tight) const {
    Rows result;
    for (const SignedIndex r : tight)
      if (kind(static_cast<std::size_t>(r)) == HalfspaceKind::facet) result.push_back(r);
    return result;
  }
  /// Whether two of the points and directions are joined by an edge.
  bool is_edge(const Rows& tight, const Rows& other) const {
    Rows common;
    std::set_intersection(tight.begin(), tight.end(), other.begin(), other.end(), std::back_inserter(common));
    std::vector<RationalRow> found;
    for (const SignedIndex r : common) found.push_back(restricted(static_cast<std::size_t>(r)));
    return rank_of(found) + 1 == axes_.size();
  }

 private:
  bool has_normal(std::size_t r) const {
    return std::any_of(rows_[r].begin(), rows_[r].end() - 1, [](const Rational& x) { return x != 0; });
  }
  static bool contains(const Rows& rows, std::size_t r) {
    return std::binary_search(rows.begin(), rows.end(), static_cast<SignedIndex>(r));
  }
  static bool are_proportional(const RationalRow& a, const RationalRow& b) {
    std::size_t j = 0;
    while (a[j] == 0 && b[j] == 0) ++j;
    if (a[j] == 0 || b[j] == 0 || a[j] * b[j] < 0) return false;
    for (std::size_t c = 0; c < a.size(); ++c)
      if (a[c] * b[j] != b[c] * a[j]) return false;
    return true;
  }
  std::vector<std::size_t> all_rows() const {
    std::vector<std::size_t> all(rows_.size());
    for (std::size_t r = 0; r < all.size(); ++r) all[r] = r;
    return all;
  }
  std::vector<std::size_t> all_columns() const {
    std::vector<std::size_t> all(d_);
    for (std::size_t j = 0; j < d_; ++j) all[j] = j;
    return all;
  }
  std::vector<RationalRow> normals(const std::vector<std::size_t>& rows,
                                   const std::vector<std::size_t>& columns) const {
    std::vector<RationalRow> result;
    for (const std::size_t r : rows) {
      result.emplace_back();
      for (const std::size_t c : columns) result.back().push_back(rows_[r][c]);
    }
    return result;
  }
  RationalRow restricted(std::size_t r) const { return normals({r}, axes_).front(); }

  void add(const RationalRow& z, bool is_vertex, std::map<RationalRow, Rows>& found) const {
    if (found.count(z) > 0) return;
    Rows tight;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Rational sum = is_vertex ? rows_[r][d_] : Rational(0);
      const RationalRow n = restricted(r);
      for (std::size_t j = 0; j < n.size(); ++j) sum += n[j] * z[j];
      if (sum > 0 && (is_vertex || has_normal(r))) return;
      if (sum == 0 && has_normal(r)) tight.push_back(static_cast<SignedIndex>(r));
    }
    found.emplace(z, tight);
  }

  /// No interior point iff some rows have λ > 0 with Σλ·n = 0 and Σλ·c ≥ 0; no point at all iff that sum can
  /// be positive.
  void find_state() {
    for (std::size_t size = 1; size <= d_ + 1; ++size)
      for_each_subset(rows_.size(), size, [&](const std::vector<std::size_t>& chosen) {
        std::vector<RationalRow> system(d_, RationalRow(size));
        for (std::size_t i = 0; i < size; ++i)
          for (std::size_t j = 0; j < d_; ++j) system[j][i] = rows_[chosen[i]][j];
        const auto pivots = eliminate(system, size);
        if (pivots.size() + 1 != size) return;
        std::size_t free = 0;
        while (free < pivots.size() && pivots[free] == free) ++free;
        Rational sum = rows_[chosen[free]][d_];
        for (std::size_t i = 0; i < pivots.size(); ++i) {
          if (system[i][free] >= 0) return;
          sum -= system[i][free] * rows_[chosen[pivots[i]]][d_];
        }
        if (size == 1 && sum == 0) return;  // 0 ≤ 0 always holds
        if (sum > 0) state_ = IntersectionState::empty;
        if (sum == 0 && state_ == IntersectionState::full) state_ = IntersectionState::flat;
      });
  }

  std::size_t d_, rank_ = 0;
  std::vector<RationalRow> rows_;
  std::vector<std::size_t> axes_;
  IntersectionState state_ = IntersectionState::full;
};

/// Whether a double is one of the nearest to a number.
inline bool is_nearest(double x, const Rational& exact) {
  const Rational error = abs(Rational(x) - exact);
  const auto beyond = [&](double towards) {
    const double next = std::nextafter(x, towards);
    return !std::isfinite(next) || error <= abs(Rational(next) - exact);
  };
  return beyond(INFINITY) && beyond(-INFINITY);
}

}  // namespace delone::test
