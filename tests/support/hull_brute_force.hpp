// SPDX-License-Identifier: BSD-3-Clause
// Convex hulls by their definition, in integers without error: every set of k points is tried against every
// other point. The perturbation is made with actual numbers: each point moves towards an inner point by its
// own power of a huge number, so that plain arithmetic finds here what the library derives from signs.
#pragma once

#include "brute_force.hpp"
#include "compare.hpp"

#include <delone/convex_hull.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace delone::test {

class HullBruteForce {
 public:
  using Row = SignedIndex;
  using Rows = std::vector<Row>;

  HullBruteForce(std::span<const double> points, int dimension)
      : d_(static_cast<std::size_t>(dimension)), points_(scaled_to_integers(points, dimension)) {
    for (std::size_t row = 0; row < points_.size(); ++row) {
      std::size_t first = 0;
      while (points_[first] != points_[row]) ++first;
      first_row_.push_back(static_cast<Row>(first));
      if (first == row) distinct_.push_back(static_cast<Row>(row));
    }
    find_axes();
    find_facets();
  }

  int affine_dimension() const { return static_cast<int>(basis_.size()) - 1; }
  const Rows& first_row() const { return first_row_; }
  /// The facets as sets of all points in them, increasing rows.
  const std::vector<Rows>& facets() const { return facets_; }

  PointKind kind(Row row) const {
    if (first_row_[at(row)] != row) return PointKind::duplicate;
    if (affine_dimension() == 0) return PointKind::extreme;
    const Rows face = smallest_face(row);
    return face.empty() ? PointKind::interior : face.size() == 1 ? PointKind::extreme : PointKind::boundary;
  }
  Rows extreme_rows() const {
    Rows rows;
    for (const Row row : distinct_)
      if (kind(row) == PointKind::extreme) rows.push_back(row);
    return rows;
  }
  /// The extreme points of each facet.
  Cells extreme_facets() const {
    Cells result;
    const Rows extreme = extreme_rows();
    for (const Rows& facet : facets_) result.push_back(common(facet, extreme));
    std::sort(result.begin(), result.end());
    return result;
  }
  /// All faces, as intersections of facets, counted by their dimension.
  std::vector<std::size_t> f_vector() const {
    std::set<Rows> faces(facets_.begin(), facets_.end());
    for (bool grown = true; grown;) {
      grown = false;
      for (const Rows& face : std::vector<Rows>(faces.begin(), faces.end()))
        for (const Rows& facet : facets_)
          if (Rows cut = common(face, facet); !cut.empty()) grown |= faces.insert(std::move(cut)).second;
    }
    std::vector<std::size_t> counts(static_cast<std::size_t>(std::max(affine_dimension(), 0)), 0);
    for (const Rows& face : faces) ++counts[span_of(face)];
    return counts;
  }

  /// The cells of the perturbed boundary: increasing rows, sorted.
  Cells cells() const {
    Cells result;
    const std::size_t k = basis_.size() - 1;
    if (basis_.size() < 2) return result;
    const Matrix moved = moved_points();
    for_each_subset(k, [&](const Rows& rows) {
      Sign side = Sign::zero;
      for (const Row other : distinct_) {
        if (std::find(rows.begin(), rows.end(), other) != rows.end()) continue;
        Matrix matrix;
        for (const Row row : rows) matrix.push_back(moved[at(row)]);
        matrix.push_back(moved[at(other)]);
        const Sign sign = sign_of(determinant(std::move(matrix)));
        if (sign == Sign::zero || sign == -side) return;
        side = sign;
      }
      result.push_back(rows);
    });
    std::sort(result.begin(), result.end());
    return result;
  }

  /// The sign of (x, cell) on the axes for the given rows.
  Sign orientation(Row x, std::span<const Row> cell) const {
    Matrix matrix;
    for (const Row row : cell) {
      matrix.emplace_back();
      for (const std::size_t axis : axes_)
        matrix.back().push_back(points_[at(row)][axis] - points_[at(x)][axis]);
    }
    return sign_of(determinant(std::move(matrix)));
  }

 private:
  static std::size_t at(Row row) { return static_cast<std::size_t>(row); }
  static Rows common(const Rows& a, const Rows& b) {
    Rows result;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
  }

  /// The pivot columns of the differences from the first row.
  std::vector<std::size_t> pivots(const Rows& rows) const {
    Matrix a;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      a.emplace_back();
      for (std::size_t j = 0; j < d_; ++j)
        a.back().push_back(points_[at(rows[i])][j] - points_[at(rows[0])][j]);
    }
    return pivot_columns(std::move(a));
  }
  std::size_t span_of(const Rows& rows) const { return pivots(rows).size(); }

  void find_axes() {
    for (const Row row : distinct_) {
      basis_.push_back(row);
      if (span_of(basis_) + 1 < basis_.size()) basis_.pop_back();
    }
    if (!basis_.empty()) axes_ = pivots(basis_);
  }

  template <class Visit>
  void for_each_subset(std::size_t size, Visit visit) const {
    std::vector<bool> chosen(distinct_.size(), false);
    std::fill_n(chosen.begin(), size, true);
    do {
      Rows rows;
      for (std::size_t i = 0; i < distinct_.size(); ++i)
        if (chosen[i]) rows.push_back(distinct_[i]);
      visit(rows);
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
  }

  void find_facets() {
    if (basis_.size() < 2) return;
    std::set<Rows> found;
    for_each_subset(basis_.size() - 1, [&](const Rows& rows) {
      Rows on;
      Sign side = Sign::zero;
      for (const Row other : distinct_) {
        const Sign sign = orientation(other, rows);
        if (sign == Sign::zero) {
          on.push_back(other);
          continue;
        }
        if (sign == -side) return;
        side = sign;
      }
      if (side != Sign::zero && span_of(on) + 2 == basis_.size()) found.insert(on);
    });
    facets_.assign(found.begin(), found.end());
  }

  Rows smallest_face(Row row) const {
    Rows face;
    bool any = false;
    for (const Rows& facet : facets_)
      if (std::binary_search(facet.begin(), facet.end(), row)) {
        face = any ? common(face, facet) : facet;
        any = true;
      }
    return face;
  }

  /// Homogeneous rows (x, 1)·M^(rank + 1) + (o, o_w) with rank 0 for the lexicographically largest point, o
  /// the sum of a basis: a point moved towards o by about M^−(rank + 1). Only first powers of these enter
  /// determinants, whose other factors are integers below M/(n+1).
  Matrix moved_points() const {
    std::size_t bits = 1;
    for (const auto& point : points_)
      for (const Integer& x : point)
        if (x != 0) bits = std::max<std::size_t>(bits, msb(Integer(abs(x))) + 1);
    const std::size_t k = axes_.size();
    const std::size_t huge = (k + 1) * (bits + 8) + 16;
    std::vector<Integer> center(k + 1, Integer(0));
    for (const Row row : basis_) {
      for (std::size_t j = 0; j < k; ++j) center[j] += points_[at(row)][axes_[j]];
      center[k] += 1;
    }
    Rows order = distinct_;
    std::sort(order.begin(), order.end(), [&](Row a, Row b) { return points_[at(a)] > points_[at(b)]; });
    Matrix moved(points_.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
      auto& row = moved[at(order[rank])];
      for (std::size_t j = 0; j <= k; ++j) {
        const Integer x = j < k ? points_[at(order[rank])][axes_[j]] : Integer(1);
        row.push_back(Integer((x << (huge * (rank + 1))) + center[j]));
      }
    }
    return moved;
  }

  std::size_t d_;
  Matrix points_;
  Rows first_row_, distinct_, basis_;
  std::vector<std::size_t> axes_;
  std::vector<Rows> facets_;
};

}  // namespace delone::test
