// SPDX-License-Identifier: BSD-3-Clause
// The exact stages of the conflict test of Delaunay, regular and furthest-site triangulations, for cells
// given by their vertices. Knows points, but no cached functionals.
#pragma once

#include "geometry/hole_search/hole_search.hpp"
#include "geometry/plane_pencil.hpp"
#include "kernel/buffer.hpp"
#include "kernel/stages.hpp"
#include "kernel/tie_kernel.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::geometry {

using internal::StageCounts;

/// A point to be tested against cells: its coordinates (then its weight, if points have one), and a grid that
/// all vertices and the point itself lie on.
struct PointQuery {
  const double* point;
  const kernel::Grid* grid;
  int compared;  ///< how many entries a vertex must share with the query to be at it; without the weight, a
                 ///< vertex with its coordinates is
};

/// K is the dimension of the flat, or 0 when it is chosen at run time.
template <int K>
class PointPredicates {
 public:
  /// `coordinates`: the points of the vertices, `ambient` doubles each and then the weight if points have
  /// one, indexed by vertex id (vertex 0 is a dummy). They must outlive this object; they may grow.
  PointPredicates(std::vector<int> axes, int ambient, kernel::RowForm form,
                  const std::vector<double>& coordinates)
      : axes_(std::move(axes)), ambient_(ambient), form_(form), coordinates_(coordinates) {}

  using HoleSearch = geometry::HoleSearch;

  static constexpr bool has_plateaus = false;
  static constexpr bool can_walk() { return true; }

  int dimension() const { return K > 0 ? K : static_cast<int>(axes_.size()); }
  const std::vector<int>& axes() const { return axes_; }
  const double* point(Index vertex) const {
    return coordinates_.data() +
           static_cast<std::size_t>(vertex) * static_cast<std::size_t>(flat().row_size());
  }
  /// Whether a point is outside of a finite cell where the functional is positive: outside of its sphere.
  /// With weights, and for furthest points, it may be anywhere.
  bool is_outside_where_positive() const { return form_ == kernel::RowForm::point; }
  /// Whether a vertex may be in no cell.
  bool may_hide() const { return form_ != kernel::RowForm::point; }
  bool is_at(Index vertex, const PointQuery& q) const {
    return kernel::equal_points(point(vertex), q.point, q.compared);
  }

  /// Stages direct_ and exact_: the sign of h(q) for the cell of these k+1 vertices, `infinite_slot` −1 for a
  /// finite cell. REQUIRES that q is none of the vertices.
  Sign exact_side(const Index* vertices, int infinite_slot, const PointQuery& q, StageCounts& counts) const {
    auto points = gather(vertices);
    const kernel::Flat flat = this->flat();
    if (infinite_slot >= 0) {
      points[static_cast<std::size_t>(infinite_slot)] = q.point;
      return -kernel::orientation<K>(flat, points.data(), *q.grid, counts);
    }
    return kernel::in_sphere<K>(flat, points.data(), q.point, *q.grid, counts);
  }
  /// Stage perturbed_, for a finite cell with h(q) = 0: never zero.
  Sign perturbed_side(const Index* vertices, const PointQuery& q, StageCounts& counts) const {
    ++counts.perturbed;
    return kernel::perturbed_in_sphere<K>(flat(), gather(vertices).data(), q.point, *q.grid);
  }

  /// The same for many cells, several per instruction where the grid is small.
  void perturbed_sides(std::span<const Index* const> cells, const PointQuery& q, Sign* sides,
                       StageCounts& counts) const {
    const kernel::Flat flat = this->flat();
    if (flat.ambient != flat.dimension() || !kernel::can_break_together(flat.ambient) ||
        !q.grid->is_small()) {
      for (const Index* vertices : cells) *sides++ = perturbed_side(vertices, q, counts);
      return;
    }
    counts.perturbed += cells.size();
    const bool is_tiny = q.grid->is_tiny() && kernel::can_break_in_binary32(flat.ambient);
    kernel::Buffer<double, K> key_weights(axes_.size()), per_unit(axes_.size());
    for (const int axis : axes_) {
      const auto j = static_cast<std::size_t>(axis);
      key_weights[j] = is_tiny ? q.grid->tiny_key_weight(axis) : q.grid->key_weight(axis);
      if (is_tiny) per_unit[j] = q.grid->per_unit(axis);
    }
    kernel::break_ties({flat.ambient, cells, coordinates_.data(), static_cast<std::size_t>(flat.row_size()),
                        q.point, key_weights.data(), is_tiny ? per_unit.data() : nullptr, sides});
  }

  /// The side of a finite cell that a vertex is on, ties perturbed, if all are on a small grid of their own
  /// and no two at one point: that takes a part of the time of the other predicates.
  std::optional<Sign> quick_side(const Index* vertices, Index v) const {
    if constexpr (is_quick)
      if (ambient_ == K && form_ == kernel::RowForm::point)
        return kernel::side_of_small<K>(gather(vertices).data(), point(v));
    return std::nullopt;
  }

  /// The sign of h(q) for a finite cell, zero on a tie: that of the power of q with respect to the cell's
  /// sphere or, for furthest points, its opposite.
  Sign unperturbed_side(const Index* vertices, const PointQuery& q) const {
    StageCounts uncounted;
    return kernel::in_sphere<K>(flat(), gather(vertices).data(), q.point, *q.grid, uncounted);
  }

  /// The exact sign of the barycentric coordinate of q at vertex `slot` of a finite, positively oriented
  /// cell.
  Sign side_of_facet(const Index* vertices, int slot, const PointQuery& q) const {
    auto points = gather(vertices);
    points[static_cast<std::size_t>(slot)] = q.point;
    return kernel::orientation<K>(flat(), points.data(), *q.grid);
  }

  /// Of the given vertices, the one that is strictly beyond facet `slot` of a finite cell and whose sphere
  /// through the facet has no other of them inside; infinite_vertex if none is beyond, and nothing on a tie.
  /// The cell may be oriented either way. `grid`: one that all vertices lie on. REQUIRES that none of them is
  /// a vertex of the cell.
  std::optional<Index> first_beyond(const Index* cell, int slot, std::span<const Index> vertices,
                                    const kernel::Grid& grid) const {
    std::vector<Index> simplex(cell, cell + dimension() + 1);
    const Sign inner = kernel::orientation<K>(flat(), gather(simplex.data()).data(), grid);
    StageCounts uncounted;
    return first_in_pencil(simplex.data(), slot, -inner, vertices, grid, false, uncounted);
  }
  /// The same where vertices beyond make simplices of a given orientation in the slot. What is in the slot
  /// may be anything, and the simplex is something else afterwards. Ties are perturbed.
  Index first_in_pencil(Index* simplex, int slot, Sign orientation, std::span<const Index> vertices,
                        const kernel::Grid& grid, StageCounts& counts) const {
    return *first_in_pencil(simplex, slot, orientation, vertices, grid, true, counts);
  }

  /// In the plane: the side of an edge that a vertex is on, positive on its left; zero if it takes more than
  /// rounded numbers to tell.
  Sign certain_side(Index from, Index to, Index v) const requires(K == 2) {
    if (ambient_ != K) return Sign::zero;
    return -PlanePencil(point(from), point(to)).view(point(v)).side();  // which is positive on the right
  }

  /// In the plane: of vertices that make positively oriented triangles with two others, as (from, v, to), the
  /// number of the one whose circle has no other of them inside. Ties are perturbed. REQUIRES that there is
  /// one.
  std::size_t first_of_plane(Index from, Index to, std::span<const Index> vertices, const kernel::Grid& grid,
                             StageCounts& counts) const requires(K == 2) {
    if (form_ != kernel::RowForm::point || ambient_ != K) {
      Index simplex[] = {from, 0, to};
      const Index first = first_in_pencil(simplex, 1, Sign::positive, vertices, grid, counts);
      return static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), first) - vertices.begin());
    }
    const PlanePencil pencil(point(from), point(to));
    std::size_t first = vertices.size();
    PlanePencil::View of_first{};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const PlanePencil::View view = pencil.view(point(vertices[i]));
      Sign side = view.side();
      if (side == Sign::zero) {
        const Index triangle[] = {from, vertices[i], to};
        side = kernel::orientation<K>(flat(), gather(triangle).data(), grid);
      }
      if (side != Sign::positive) continue;
      if (first < vertices.size()) {
        side = view.against(of_first);
        if (side == Sign::zero) {
          const Index triangle[] = {from, vertices[first], to};
          const PointQuery q{point(vertices[i]), &grid, flat().row_size()};
          side = exact_side(triangle, -1, q, counts);
          if (side == Sign::zero) side = perturbed_side(triangle, q, counts);
        }
        if (side != Sign::negative) continue;
      }
      first = i;
      of_first = view;
    }
    return first;
  }

  /// Takes those out of `vertices` that lie in the plane of facet `slot` of a cell because they share a
  /// coordinate with all vertices of the facet. REQUIRES that these are affinely independent.
  void drop_coplanar(const Index* cell, int slot, std::vector<Index>& vertices) const {
    const double* const any = point(cell[slot == 0 ? 1 : 0]);
    for (const int axis : axes_) {
      const auto is_level = [&](Index v) { return point(v)[axis] == any[axis]; };
      int i = 0;
      while (i <= dimension() && (i == slot || is_level(cell[i]))) ++i;
      if (i <= dimension()) continue;
      std::erase_if(vertices, is_level);
      return;
    }
  }

  /// Writes rows of the vertices, which have numbers from 1 on, and of the center, which has the number after
  /// theirs unless it is one of them, to be searched with rounded numbers: relative to the center, and scaled
  /// to magnitudes of at most 1.
  void place(std::span<const Index> vertices, Index center, HoleSearch& search) {
    const auto ambient = static_cast<std::size_t>(ambient_);
    const double* const origin = point(center);
    low_.assign(point(vertices.front()), point(vertices.front()) + ambient);
    high_ = low_;
    for (const Index v : vertices)
      for (std::size_t j = 0; j < ambient; ++j) {
        low_[j] = std::min(low_[j], point(v)[j]);
        high_[j] = std::max(high_[j], point(v)[j]);
      }
    scales_.resize(ambient);
    for (std::size_t j = 0; j < ambient; ++j)
      scales_[j] = std::max(std::fabs(low_[j] - origin[j]), std::fabs(high_[j] - origin[j]));
    scale_of_lift_ = std::numeric_limits<double>::infinity();
    for (double& scale : scales_) {
      scale = scale > 0 ? std::ldexp(1.0, -std::clamp(std::ilogb(scale), -1000, 1000) - 1) : 1.0;
      scale_of_lift_ = std::min(scale_of_lift_, scale);
    }
    center_ = center;
    for (std::size_t i = 0; i < vertices.size(); ++i) place_one(vertices[i], search.row(i + 1));
    place_one(center, search.row(vertices.size() + 1));
    search.arrange();
  }
  /// Whether facet `slot` of a cell lies in a side of the box of the vertices that were placed last, and the
  /// vertex in the slot beyond that side: then none of them is where that one is.
  bool is_in_side_of_box(const Index* cell, int slot) const {
    const double *const any = point(cell[slot == 0 ? 1 : 0]), *const opposite = point(cell[slot]);
    for (const int axis : axes_) {
      const auto j = static_cast<std::size_t>(axis);
      const bool is_beyond =
          (any[j] == high_[j] && opposite[j] > high_[j]) || (any[j] == low_[j] && opposite[j] < low_[j]);
      if (!is_beyond) continue;
      int i = 0;
      while (i <= dimension() && (i == slot || point(cell[i])[j] == any[j])) ++i;
      if (i > dimension()) return true;
    }
    return false;
  }
  /// The row of one more vertex near that center.
  void place_one(Index v, double* row) const {
    const auto ambient = static_cast<std::size_t>(ambient_);
    const double *const x = point(v), *const origin = point(center_);
    double lift = 0;
    for (std::size_t j = 0; j < ambient; ++j) {
      const double t = (x[j] - origin[j]) * scale_of_lift_;
      lift += t * t;
    }
    if (form_ == kernel::RowForm::furthest_point) lift = -lift;
    if (form_ == kernel::RowForm::weighted_point)
      lift -= (x[ambient] - origin[ambient]) * scale_of_lift_ * scale_of_lift_;
    for (const int axis : axes_) {
      const auto j = static_cast<std::size_t>(axis);
      *row++ = (x[j] - origin[j]) * scales_[j];
    }
    *row = lift;
  }

 protected:
  kernel::Flat flat() const { return {ambient_, axes_, form_}; }
  auto gather(const Index* vertices) const {
    const int size = dimension() + 1;
    kernel::Buffer<const double*, K + (K > 0)> points(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) points[static_cast<std::size_t>(i)] = point(vertices[i]);
    return points;
  }

  std::vector<int> axes_;

 private:
  /// Whether there are predicates for small grids of the points at hand.
  static constexpr bool is_quick = K >= 2 && K <= 5;

  /// Of vertices that make a simplex of that orientation in the slot, the one whose sphere has no other of
  /// them inside. Ties are perturbed, or else nothing is returned.
  std::optional<Index> first_in_pencil(Index* simplex, int slot, Sign orientation,
                                       std::span<const Index> vertices, const kernel::Grid& grid,
                                       bool perturbs, StageCounts& counts) const {
    Index first = index(infinite_vertex);
    int place = slot;
    if (orientation == Sign::negative) {  // so that the simplices are positive
      place = slot == 0 ? 1 : 0;
      simplex[slot] = simplex[place];
    }
    if constexpr (is_quick) {
      constexpr std::size_t most = 64;
      if (perturbs && vertices.size() <= most && !grid.is_small() && ambient_ == K &&
          form_ == kernel::RowForm::point) {
        const double* candidates[most];
        for (std::size_t i = 0; i < vertices.size(); ++i) candidates[i] = point(vertices[i]);
        simplex[place] = simplex[place == 0 ? 1 : 0];
        const std::optional<std::size_t> found =
            kernel::first_in_pencil_of_small<K>(gather(simplex).data(), place, candidates, vertices.size());
        if (found) {
          counts.direct += vertices.size();
          return *found < vertices.size() ? vertices[*found] : first;
        }
      }
    }
    Index& apex = simplex[place];
    for (const Index v : vertices) {
      apex = v;
      if (kernel::orientation<K>(flat(), gather(simplex).data(), grid) != Sign::positive) continue;
      if (first == index(infinite_vertex)) {
        first = v;
        continue;
      }
      apex = first;
      const PointQuery q{point(v), &grid, flat().row_size()};
      Sign side = exact_side(simplex, -1, q, counts);
      if (side == Sign::zero && !perturbs) return std::nullopt;
      if (side == Sign::zero) side = perturbed_side(simplex, q, counts);
      if (side == Sign::negative) first = v;
    }
    return first;
  }

  int ambient_;
  kernel::RowForm form_;
  const std::vector<double>& coordinates_;
  // Of place().
  Index center_ = index(infinite_vertex);
  std::vector<double> low_, high_;  // the box of the vertices
  std::vector<double> scales_;
  double scale_of_lift_ = 1;
};

}  // namespace delone::geometry
