// SPDX-License-Identifier: BSD-3-Clause
// What joins the kernel to the engine: the conflict test of Delaunay triangulations, from the cached functional of a cell
// (stage filter_) to the exact stages. A point q is in conflict with a cell iff h(q) < 0.
#pragma once

#include "geometry/frame.hpp"
#include "geometry/functionals.hpp"
#include "kernel/stages.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace delone::geometry {

/// A point to be tested against cells: its coordinates, its image in the frame, whether the filter may be used on it, and a
/// grid that all vertices and the point itself lie on.
template <int K>
struct Query {
  Query(const double* at, const kernel::Grid& grid_of_all, std::size_t dimension)
      : point(at), grid(&grid_of_all), image(dimension) {}
  const double* point;
  const kernel::Grid* grid;
  kernel::Buffer<double, K> image;
  double lift = 0;
  bool in_frame = false;
};

template <int K>
class DelaunayGeometry {
 public:
  using Query = geometry::Query<K>;

  /// `coordinates`: the points of the vertices, `flat.ambient` doubles each, indexed by vertex id (vertex 0 is a dummy).
  /// Both references must outlive this object; they may grow.
  DelaunayGeometry(std::vector<int> axes, int ambient, const std::vector<double>& coordinates, const kernel::Grid& grid,
                   Frame frame)
      : axes_(std::move(axes)),
        ambient_(ambient),
        coordinates_(coordinates),
        grid_(grid),
        frame_(std::move(frame)),
        functionals_(dimension()) {
    functionals_.set_frame(frame_, axes_);
  }

  int dimension() const { return K > 0 ? K : static_cast<int>(axes_.size()); }
  const Frame& frame() const { return frame_; }
  void set_frame(Frame frame) {
    frame_ = std::move(frame);
    functionals_.set_frame(frame_, axes_);
  }

  /// A query at the point of a vertex.
  Query make_query(const double* point) const { return make_query(point, grid_); }

  /// A query anywhere; `grid` is one for the vertices and the point, and must outlive the query.
  Query make_query(const double* point, const kernel::Grid& grid) const {
    Query q(point, grid, axes_.size());
    for (int r = 0; r < dimension(); ++r) q.image[static_cast<std::size_t>(r)] = frame_.image(point, axis(r));
    q.lift = frame_.lift(point);
    q.in_frame = frame_.contains(point);
    return q;
  }

  const double* point(Index vertex) const {
    return coordinates_.data() + static_cast<std::size_t>(vertex) * static_cast<std::size_t>(ambient_);
  }
  bool is_at(Index vertex, const Query& q) const { return kernel::equal_points(point(vertex), q.point, ambient_); }

  void reserve_cells(std::size_t cells) { functionals_.reserve(cells); }
  std::size_t bytes() const { return functionals_.bytes(); }

  /// h̃(q), approximately the functional of the cell. Functionals of finite cells are comparable with each other.
  double value(Index cell, const Query& q) const { return functionals_.value(cell, q.image.data(), q.lift); }
  bool is_infinite(Index cell) const { return functionals_.is_infinite(cell); }
  /// |value − h| stays below it for all queries in the frame.
  double threshold(Index cell) const { return functionals_.threshold(cell); }

  /// Stage filter_: the sign of h(q) if h̃(q) = `value` proves it, else zero.
  Sign filter_side(Index cell, double value, const Query& q) const {
    const double bound = q.in_frame ? threshold(cell) : std::numeric_limits<double>::infinity();
    return value < -bound ? Sign::negative : value > bound ? Sign::positive : Sign::zero;
  }

  /// Stages direct_ to perturbed_: the sign of h(q) for the cell of these k+1 vertices, `infinite_slot` −1 for a finite cell.
  /// Zero only for an infinite cell with q exactly on its hyperplane. REQUIRES that q is none of the vertices.
  Sign exact_side(const Index* vertices, int infinite_slot, const Query& q, StageCounts& counts) const {
    auto points = gather(vertices);
    const kernel::Flat flat = this->flat();
    if (infinite_slot >= 0) {
      points[static_cast<std::size_t>(infinite_slot)] = q.point;
      return -kernel::orientation<K>(flat, points.data(), *q.grid, counts);
    }
    const Sign sign = kernel::in_sphere<K>(flat, points.data(), q.point, *q.grid, counts);
    if (sign != Sign::zero) return sign;
    ++counts.perturbed;
    return kernel::perturbed_in_sphere<K>(flat, points.data(), q.point, *q.grid);
  }

  /// The sign of the power of q with respect to the sphere of a finite cell, ties not perturbed.
  Sign unperturbed_side(const Index* vertices, const Query& q) const {
    StageCounts uncounted;
    return kernel::in_sphere<K>(flat(), gather(vertices).data(), q.point, *q.grid, uncounted);
  }

  /// The exact sign of the barycentric coordinate of q at vertex `slot` of a finite, positively oriented cell.
  Sign side_of_facet(const Index* vertices, int slot, const Query& q) const {
    auto points = gather(vertices);
    points[static_cast<std::size_t>(slot)] = q.point;
    return kernel::orientation<K>(flat(), points.data(), *q.grid);
  }

  /// The orientation of k+1 finite vertices.
  Sign orientation(const Index* vertices) const { return kernel::orientation<K>(flat(), gather(vertices).data(), grid_); }

  /// Computes what is cached for a cell by elimination. `apex` is the slot of a finite vertex.
  void create(Index cell, const Index* vertices, int infinite_slot, int apex);

  /// The same for a cell that joins q, in slot `apex`, to the facet between a dead cell and a survivor.
  void create_across(Index cell, const Index* vertices, int infinite_slot, int apex, const Query& q, const FacetSide& dead,
                     const FacetSide& survivor);

 private:
  int axis(int r) const { return axes_[static_cast<std::size_t>(r)]; }
  kernel::Flat flat() const { return {ambient_, axes_}; }

  auto gather(const Index* vertices) const {
    const int size = dimension() + 1;
    kernel::Buffer<const double*, K + (K > 0)> points(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) points[static_cast<std::size_t>(i)] = point(vertices[i]);
    return points;
  }

  std::vector<int> axes_;
  int ambient_;
  const std::vector<double>& coordinates_;
  const kernel::Grid& grid_;
  Frame frame_;
  Functionals<K> functionals_;
};

template <int K>
void DelaunayGeometry<K>::create(Index cell, const Index* vertices, int infinite_slot, int apex) {
  const int k = dimension();
  kernel::Buffer<double, (K > 0) * (K + 1) * (K + 1)> rows(static_cast<std::size_t>((k + 1) * (k + 1)));
  double* row = rows.data();
  const auto append = [&](int slot) {
    const double* x = point(vertices[slot]);
    for (int r = 0; r < k; ++r) *row++ = frame_.image(x, axis(r));
    *row++ = frame_.lift(x);
  };
  append(apex);
  for (int i = 0; i <= k; ++i)
    if (i != apex && i != infinite_slot) append(i);
  if (infinite_slot < 0) {
    functionals_.template solve<false>(cell, rows.data(), true);
  } else {
    // The sign that makes h negative where a point in the slot of the infinite vertex would make a positively oriented cell
    // (docs/predicates.md, "Signs").
    const int position = infinite_slot - (infinite_slot > apex ? 1 : 0);
    functionals_.template solve<true>(cell, rows.data(), (apex + position + k) % 2 == 0);
  }
}

template <int K>
void DelaunayGeometry<K>::create_across(Index cell, const Index* vertices, int infinite_slot, int apex, const Query& q,
                                        const FacetSide& dead, const FacetSide& survivor) {
  const auto value_at_vertex = [&](Index at, Index vertex) { return value(at, make_query(point(vertex))); };
  const bool combined = q.in_frame && functionals_.combine(cell, dead, survivor, q.image.data(), q.lift, value_at_vertex);
  if (!combined) create(cell, vertices, infinite_slot, apex);
}

}  // namespace delone::geometry
