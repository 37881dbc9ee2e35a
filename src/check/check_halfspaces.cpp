// SPDX-License-Identifier: BSD-3-Clause
// check() of an intersection of halfspaces: everything in integers, from the halfspaces and the lists of rows
// alone.
//
// Level 3. An edge at a vertex v is where the rows of v that hold with equality have rank k − 1; its
// direction u is feasible for all rows of v. A listed vertex w on the same rows lies on that line inside the
// polyhedron, so it is the edge's other end; a listed direction on these rows is u. The graph of a polyhedron
// with a vertex is connected, and every extreme direction is that of a ray: if all edges of all listed
// vertices are listed, all vertices and directions are.
#include "base/progress_meter.hpp"
#include "check/levels.hpp"
#include "halfspaces/halfspace_dual.hpp"
#include "halfspaces/halfspace_vertex.hpp"

#include <delone/arithmetic.hpp>
#include <delone/check.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace delone {
namespace {

using internal::Violation;
using kernel::Fractions;
using kernel::Integer;
using IntegerRow = std::vector<kernel::Integer>;

/// Fraction-free elimination of a matrix to echelon form, in place; returns the rows that were found
/// independent, in order.
std::vector<std::size_t> independent_rows(std::vector<IntegerRow> rows) {
  std::vector<std::size_t> found;
  std::vector<std::pair<std::size_t, IntegerRow>> reduced;  // pivot column, row
  for (std::size_t r = 0; r < rows.size(); ++r) {
    IntegerRow& row = rows[r];
    for (const auto& [pivot, by] : reduced) {
      if (row[pivot] == 0) continue;
      const kernel::Integer factor = row[pivot], scale = by[pivot];
      for (std::size_t j = 0; j < row.size(); ++j) row[j] = row[j] * scale - by[j] * factor;
    }
    const auto pivot = static_cast<std::size_t>(
        std::find_if(row.begin(), row.end(), [](const kernel::Integer& x) { return x != 0; }) - row.begin());
    if (pivot == row.size()) continue;
    found.push_back(r);
    reduced.emplace_back(pivot, row);
  }
  return found;
}

class IntersectionChecker {
 public:
  explicit IntersectionChecker(const IntersectionData& data)
      : data_(data),
        d_(static_cast<std::size_t>(std::max(data.dimension, 0))),
        k_(static_cast<std::size_t>(std::max(data.rank, 0))) {}

  CheckReport check(const CheckOptions& options) {
    const bool is_full = data_.state == IntersectionState::full;
    return internal::run_levels<IntersectionData>(
        options, [&](CheckReport&) { check_storage(); },
        [&](CheckReport&) { is_full ? check_support() : check_witness(); },
        [&](CheckReport&) {
          if (is_full) check_completeness();
        });
  }

 private:
  using Rows = std::vector<SignedIndex>;

  void check_storage() const {
    const auto wrong = [](const char* text) { throw Violation{text}; };
    const std::size_t m = data_.num_halfspaces();
    if (d_ < 1) wrong("the dimension is less than 1");
    if (data_.halfspaces.empty() && m > 0)
      wrong("there are no halfspaces: data() leaves them out, to_data() does not");
    if (data_.halfspaces.size() != m * (d_ + 1))
      wrong("the halfspaces are not as many as first_of_halfspace says");
    for (const double x : data_.halfspaces)
      if (!std::isfinite(x)) wrong("an entry of a halfspace is not finite");
    const auto in_range = [](const std::vector<SignedIndex>& items, std::size_t size) {
      return std::all_of(items.begin(), items.end(),
                         [&](SignedIndex i) { return i >= 0 && static_cast<std::size_t>(i) < size; });
    };
    if (!in_range(data_.first_of_halfspace, m) || !in_range(data_.witness, m)) wrong("a row is out of range");
    if (data_.state != IntersectionState::full) {
      const bool is_bare = !data_.bounded && data_.kinds.empty() && data_.vertices.empty() &&
                           data_.vertex_halfspaces.empty() && data_.directions.empty() &&
                           data_.direction_halfspaces.empty() && data_.edges.empty() && data_.rays.empty() &&
                           data_.facet_halfspaces.empty() && data_.facet_vertices.empty() &&
                           data_.facet_directions.empty();
      if (!is_bare) wrong("an intersection without interior points has faces or kinds");
      return;
    }
    if (!data_.witness.empty()) wrong("an intersection with interior points has a witness");
    const auto are_lists = [](const std::vector<SignedIndex>& offsets,
                              const std::vector<SignedIndex>& items) {
      return !offsets.empty() && offsets.front() == 0 && std::is_sorted(offsets.begin(), offsets.end()) &&
             static_cast<std::size_t>(offsets.back()) == items.size();
    };
    if (!are_lists(data_.vertex_offsets, data_.vertex_halfspaces) ||
        !are_lists(data_.direction_offsets, data_.direction_halfspaces) ||
        !are_lists(data_.facet_offsets, data_.facet_vertices) ||
        !are_lists(data_.facet_direction_offsets, data_.facet_directions))
      wrong("offsets are not those of lists");
    const std::size_t v = data_.num_vertices(), u = data_.num_directions(), f = data_.num_facets();
    if (k_ > d_ || data_.axes.size() != k_ || !std::is_sorted(data_.axes.begin(), data_.axes.end()) ||
        std::any_of(data_.axes.begin(), data_.axes.end(),
                    [&](int a) { return a < 0 || static_cast<std::size_t>(a) >= d_; }))
      wrong("the axes are not as many coordinates as the rank");
    if (data_.vertices.size() != v * d_ || data_.directions.size() != u * d_ || data_.kinds.size() != m ||
        data_.lineality.size() != (d_ - k_) * d_ || data_.interior_point.size() != d_ ||
        data_.facet_offsets.size() != f + 1 || data_.facet_direction_offsets.size() != f + 1 ||
        data_.edges.size() % 2 != 0 || data_.rays.size() % 2 != 0)
      wrong("an array has another size than the others ask for");
    if (!in_range(data_.vertex_halfspaces, m) || !in_range(data_.direction_halfspaces, m) ||
        !in_range(data_.facet_halfspaces, m) || !in_range(data_.facet_vertices, v) ||
        !in_range(data_.facet_directions, u) || !in_range(data_.edges, v))
      wrong("a row, vertex or direction is out of range");
    if (std::adjacent_find(data_.facet_halfspaces.begin(), data_.facet_halfspaces.end(),
                           std::greater_equal<>()) != data_.facet_halfspaces.end())
      wrong("the rows of the facets are not increasing");
    for (std::size_t i = 0; i < data_.rays.size(); ++i)
      if (data_.rays[i] < 0 || static_cast<std::size_t>(data_.rays[i]) >= (i % 2 == 0 ? v : u))
        wrong("a vertex or direction of a ray is out of range");
  }

  /// The row as integers, on the axes and the offset; or on all coordinates.
  IntegerRow row(std::size_t r) const {
    const IntegerRow all = halfspaces::integer_row(&data_.halfspaces[r * (d_ + 1)], d_ + 1);
    IntegerRow result;
    for (const int axis : data_.axes) result.push_back(all[static_cast<std::size_t>(axis)]);
    result.push_back(all[d_]);
    return result;
  }
  static kernel::Integer value(const IntegerRow& row, const IntegerRow& z) {
    kernel::Integer sum = 0;
    for (std::size_t j = 0; j < row.size(); ++j) sum += row[j] * z[j];
    return sum;
  }

  /// Multipliers λ > 0 of the witness' rows, unique up to a factor, with Σλ·n = 0: Σλ·c is 0 for flat,
  /// positive for empty ones.
  void check_witness() const {
    std::vector<std::size_t> rows(data_.witness.begin(), data_.witness.end());
    const auto wrong = [&] {
      throw Violation{.message = "the witness does not prove that there is no interior point",
                      .halfspaces = rows};
    };
    std::vector<IntegerRow> transposed(d_);
    IntegerRow offsets;
    for (const std::size_t r : rows) {
      const IntegerRow all = halfspaces::integer_row(&data_.halfspaces[r * (d_ + 1)], d_ + 1);
      for (std::size_t j = 0; j < d_; ++j) transposed[j].push_back(all[j]);
      offsets.push_back(all[d_]);
    }
    const auto lambda = null_vector(transposed, rows.size());
    if (!lambda) wrong();
    const bool negative = (*lambda)[0] < 0;
    for (const kernel::Integer& x : *lambda)
      if (negative ? x >= 0 : x <= 0) wrong();
    const kernel::Integer sum =
        negative ? kernel::Integer(-value(offsets, *lambda)) : value(offsets, *lambda);
    if (data_.state == IntersectionState::flat ? sum != 0 : sum <= 0) wrong();
  }

  /// The vector, unique up to a factor, on which rows of n entries vanish; nothing if their rank is not n
  /// − 1.
  static std::optional<IntegerRow> null_vector(const std::vector<IntegerRow>& rows, std::size_t n) {
    const std::vector<std::size_t> basis = independent_rows(rows);
    if (n == 0 || basis.size() + 1 != n) return std::nullopt;
    IntegerRow result;
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<kernel::Integer> minor;
      for (const std::size_t r : basis)
        for (std::size_t c = 0; c < n; ++c)
          if (c != j) minor.push_back(rows[r][c]);
      const kernel::Integer det = kernel::exact_determinant(std::move(minor), n - 1);
      result.push_back(j % 2 == 0 ? det : kernel::Integer(-det));
    }
    return result;
  }

  bool has_normal(std::size_t r) const {
    const double* row = &data_.halfspaces[r * (d_ + 1)];
    return std::any_of(row, row + d_, [](double x) { return x != 0; });
  }

  /// With k < d the rows are examined on the axes alone: there they must lose nothing.
  void check_rank() const {
    if (k_ == d_) return;
    std::vector<IntegerRow> normals, on_axes;
    for (std::size_t r = 0; r < data_.num_halfspaces(); ++r) {
      normals.push_back(halfspaces::integer_row(&data_.halfspaces[r * (d_ + 1)], d_));
      on_axes.push_back(row(r));
      on_axes.back().pop_back();
    }
    if (independent_rows(normals).size() == k_ && independent_rows(on_axes).size() == k_) return;
    throw Violation{"the normals have another rank, or project on the axes not one-to-one"};
  }

  void check_interior_point() const {
    // One that is rounded may be beyond the range of doubles, as vertices may.
    if (!std::all_of(data_.interior_point.begin(), data_.interior_point.end(), [this](double x) {
          return data_.interior_point_is_exact ? std::isfinite(x) : !std::isnan(x);
        }))
      throw Violation{"a coordinate of the interior point is not finite"};
    if (!data_.interior_point_is_exact) return;
    std::vector<double> homogeneous = data_.interior_point;
    homogeneous.push_back(1);
    const IntegerRow p = halfspaces::integer_row(homogeneous.data(), d_ + 1);
    for (std::size_t r = 0; r < data_.num_halfspaces(); ++r)
      if (has_normal(r) && value(halfspaces::integer_row(&data_.halfspaces[r * (d_ + 1)], d_ + 1), p) >= 0)
        throw Violation{.message = "the interior point is not strictly inside halfspace " + std::to_string(r),
                        .halfspaces = {r}};
  }

  /// Exact homogeneous coordinates of all vertices and directions, and what is tight where.
  void check_support() {
    check_rank();
    check_interior_point();
    for (std::size_t r = 0; r < data_.num_halfspaces(); ++r) rows_.push_back(row(r));
    is_facet_.assign(rows_.size(), 0);
    for (const SignedIndex r : data_.facet_halfspaces) is_facet_[static_cast<std::size_t>(r)] = 1;
    for (std::size_t v = 0; v < data_.num_vertices(); ++v)
      check_point(v, data_.halfspaces_of_vertex(v), true);
    for (std::size_t u = 0; u < data_.num_directions(); ++u)
      check_point(u, data_.halfspaces_of_direction(u), false);
    std::vector<Rows> lists;
    for (std::size_t v = 0; v < data_.num_vertices(); ++v)
      lists.emplace_back(data_.halfspaces_of_vertex(v).begin(), data_.halfspaces_of_vertex(v).end());
    std::sort(lists.begin(), lists.end());
    if (std::adjacent_find(lists.begin(), lists.end()) != lists.end())
      throw Violation{"a vertex is listed twice"};
  }

  void check_point(std::size_t i, std::span<const SignedIndex> listed, bool is_vertex) {
    const std::string name = (is_vertex ? "vertex " : "direction ") + std::to_string(i);
    std::vector<std::size_t> concerned;
    if (is_vertex) concerned.push_back(i);
    std::vector<IntegerRow> tight;
    for (const SignedIndex r : listed) {
      tight.push_back(rows_[static_cast<std::size_t>(r)]);
      if (!is_vertex) tight.back().pop_back();
    }
    auto z = null_vector(tight, is_vertex ? k_ + 1 : k_);
    if (!z || (is_vertex && z->back() == 0))
      throw Violation{.message = "the rows of " + name + " do not meet in one",
                      .vertices = concerned,
                      .halfspaces = {listed.begin(), listed.end()}};
    bool negate = is_vertex && z->back() < 0;
    if (!is_vertex) {
      std::size_t j = 0;  // the largest: smaller ones may be 0 when they are rounded
      for (std::size_t other = 1; other < k_; ++other)
        if (abs((*z)[other]) > abs((*z)[j])) j = other;
      negate = (data_.direction(i)[static_cast<std::size_t>(data_.axes[j])] < 0) != ((*z)[j] < 0);
    }
    if (negate)
      for (kernel::Integer& x : *z) x = -x;
    const std::vector<double> unit =
        is_vertex ? std::vector<double>{} : halfspaces::unit_vector(*z, data_.axes, d_);
    for (std::size_t j = 0; j < k_; ++j) {
      const auto axis = static_cast<std::size_t>(data_.axes[j]);
      const bool right = is_vertex ? data_.vertex(i)[axis] == kernel::nearest_double((*z)[j], z->back(), 0)
                                   : std::abs(data_.direction(i)[axis] - unit[axis]) <= 1e-14;
      if (!right)
        throw Violation{.message = "a coordinate of " + name + " is not the nearest double",
                        .vertices = concerned};
    }
    for (std::size_t j = 0; j < d_; ++j)
      if ((is_vertex ? data_.vertex(i) : data_.direction(i))[j] != 0 &&
          !std::binary_search(data_.axes.begin(), data_.axes.end(), static_cast<int>(j)))
        throw Violation{.message = "a coordinate of " + name + " that is no axis is not 0",
                        .vertices = concerned};
    if (!is_vertex) z->push_back(0);
    Rows on;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const kernel::Integer side = value(rows_[r], *z);
      if (side > 0)
        throw Violation{.message = name + " is outside of halfspace " + std::to_string(r),
                        .vertices = concerned,
                        .halfspaces = {r}};
      if (side == 0 && is_facet_[r]) on.push_back(static_cast<SignedIndex>(r));
    }
    if (!std::equal(on.begin(), on.end(), listed.begin(), listed.end()))
      throw Violation{.message = name + " does not list the facets that it is on", .vertices = concerned};
    points_.push_back(std::move(*z));
  }

  void check_completeness() {
    if (k_ > 0 && data_.num_vertices() == 0) throw Violation{"there is no vertex"};
    if (data_.bounded != (k_ == d_ && data_.num_directions() == 0)) throw Violation{"`bounded` is wrong"};
    std::vector<std::vector<Rows>> around(data_.num_vertices());  // common rows of each edge
    const auto add = [&](SignedIndex v, std::span<const SignedIndex> other) {
      const auto here = data_.halfspaces_of_vertex(static_cast<std::size_t>(v));
      Rows common;
      std::set_intersection(here.begin(), here.end(), other.begin(), other.end(), std::back_inserter(common));
      around[static_cast<std::size_t>(v)].push_back(std::move(common));
    };
    for (std::size_t e = 0; e < data_.edges.size(); e += 2) {
      if (data_.edges[e] == data_.edges[e + 1]) throw Violation{"an edge joins a vertex to itself"};
      add(data_.edges[e], data_.halfspaces_of_vertex(static_cast<std::size_t>(data_.edges[e + 1])));
      add(data_.edges[e + 1], data_.halfspaces_of_vertex(static_cast<std::size_t>(data_.edges[e])));
    }
    for (std::size_t e = 0; e < data_.rays.size(); e += 2)
      add(data_.rays[e], data_.halfspaces_of_direction(static_cast<std::size_t>(data_.rays[e + 1])));
    for (std::size_t v = 0; v < data_.num_vertices(); ++v) {
      std::sort(around[v].begin(), around[v].end());
      if (around[v] != edges_at(v))
        throw Violation{
            .message = "the edges at vertex " + std::to_string(v) + " are not those that its rows make",
            .vertices = {v}};
    }
    return check_facets();
  }

  /// The sets of rows of all edges at a vertex, sorted.
  std::vector<Rows> edges_at(std::size_t v) const {
    const auto listed = data_.halfspaces_of_vertex(v);
    std::vector<IntegerRow> normals;
    for (const SignedIndex r : listed) {
      normals.push_back(rows_[static_cast<std::size_t>(r)]);
      normals.back().pop_back();
    }
    std::vector<Rows> found;
    std::vector<char> chosen(listed.size(), 0);
    std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(k_ - 1), 1);
    do {
      std::vector<IntegerRow> some;
      for (std::size_t i = 0; i < listed.size(); ++i)
        if (chosen[i]) some.push_back(normals[i]);
      const auto u = k_ == 1 ? std::optional<IntegerRow>(IntegerRow{1}) : null_vector(some, k_);
      if (!u) continue;
      Rows common;
      bool above = false, below = false;
      for (std::size_t i = 0; i < listed.size(); ++i) {
        const kernel::Integer side = value(normals[i], *u);
        if (side == 0) common.push_back(listed[i]);
        above = above || side > 0;
        below = below || side < 0;
      }
      if (!(above && below)) found.push_back(std::move(common));
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void check_facets() const {
    const std::size_t v = data_.num_vertices();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto wrong = [&](const char* what) {
        throw Violation{.message = "halfspace " + std::to_string(r) + what, .halfspaces = {r}};
      };
      const auto first = static_cast<std::size_t>(data_.first_of_halfspace[r]);
      if (!has_normal(r)) {
        if (data_.kinds[r] != HalfspaceKind::trivial || rows_[r].back() > 0)
          wrong(" has no normal and another kind");
        continue;
      }
      if (first != r) {
        const auto a = halfspaces::integer_row(&data_.halfspaces[r * (d_ + 1)], d_ + 1),
                   b = halfspaces::integer_row(&data_.halfspaces[first * (d_ + 1)], d_ + 1);
        kernel::Integer dot = 0;
        for (std::size_t j = 0; j <= d_; ++j) dot += a[j] * b[j];
        if (data_.kinds[r] != HalfspaceKind::duplicate || first > r || dot <= 0 ||
            independent_rows({a, b}).size() != 1)
          wrong(" is no duplicate of the row that it names");
        continue;
      }
      std::vector<IntegerRow> on;
      Rows vertices, directions;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (value(rows_[r], points_[i]) != 0) continue;
        on.push_back(points_[i]);
        (i < v ? vertices : directions).push_back(static_cast<SignedIndex>(i < v ? i : i - v));
      }
      const HalfspaceKind kind = vertices.empty()                    ? HalfspaceKind::redundant
                                 : independent_rows(on).size() == k_ ? HalfspaceKind::facet
                                                                     : HalfspaceKind::touching;
      if (data_.kinds[r] != kind) wrong(" has the wrong kind");
      if ((kind == HalfspaceKind::facet) != (is_facet_[r] != 0)) wrong(" is not rightly listed as a facet");
      if (kind != HalfspaceKind::facet) continue;
      const auto f =
          static_cast<std::size_t>(std::find(data_.facet_halfspaces.begin(), data_.facet_halfspaces.end(),
                                             static_cast<SignedIndex>(r)) -
                                   data_.facet_halfspaces.begin());
      Rows listed(data_.facet(f).begin(), data_.facet(f).end()),
          listed_directions(data_.directions_of_facet(f).begin(), data_.directions_of_facet(f).end());
      std::sort(listed.begin(), listed.end());
      std::sort(listed_directions.begin(), listed_directions.end());
      if (listed != vertices || listed_directions != directions)
        wrong(" does not list the vertices on its facet");
    }
  }

  const IntersectionData& data_;
  std::size_t d_, k_;
  std::vector<IntegerRow> rows_, points_;  // on the axes and the last column; vertices, then directions
  std::vector<char> is_facet_;
};

}  // namespace

CheckReport check(const IntersectionData& data, const CheckOptions& options, const Execution& how) {
  const ArithmeticScope arithmetic;
  const internal::ProgressMeter meter(how.progress);
  return IntersectionChecker(data).check(options);
}

}  // namespace delone
