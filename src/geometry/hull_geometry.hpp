// SPDX-License-Identifier: BSD-3-Clause
// Joins the kernel to the engine for convex hulls: cells are the facets of a simplicial polytope in a flat of
// dimension k + 1, and a point q is in conflict with a cell iff it is beyond its hyperplane.
//
// All is relative to a point o strictly inside. Functionals are h(x) = 1 + g·X, where X is x relative to o
// in units of the box, so h(o) = 1: the cells' functionals are the points of the polar polytope. Cells and o
// make the simplices of a fan; the walls between them are what a walk crosses.
#pragma once

#include "cells/cell_memory.hpp"
#include "geometry/functionals.hpp"
#include "geometry/kept_rows.hpp"
#include "geometry/lattice.hpp"
#include "kernel/hull_stages.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::geometry {

/// A point to be tested against cells.
template <int K>
struct HullQuery {
  explicit HullQuery(const double* at, std::size_t size) : point(at), row(size) {}
  const double* point;
  LatticeBounds bounds;
  kernel::Buffer<double, K + (K > 0)> row;
};

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class HullGeometry {
  static constexpr int D = K > 0 ? K + 1 : 0;  // of the flat

 public:
  using Query = HullQuery<K>;

  /// `coordinates`: the points, `ambient` doubles each; vertex v is point v − 1. `center` is o; if it is not
  /// strictly inside the simplex of the vertices `inner`, the filter is never certain. `grid` is one for the
  /// points and o. The references must outlive this object; what they refer to may grow.
  HullGeometry(CellMemory<K>& cells, std::vector<int> axes, int ambient,
               const std::vector<double>& coordinates, const kernel::Grid& grid,
               const std::vector<double>& center, bool center_is_inside, std::vector<Index> inner)
      : axes_(std::move(axes)),
        ambient_(ambient),
        coordinates_(coordinates),
        grid_(grid),
        center_(center),
        center_is_inside_(center_is_inside),
        inner_(std::move(inner)),
        scale_(axes_.size(), std::numeric_limits<double>::quiet_NaN()),
        functionals_(cells),
        rows_(axes_.size()) {
    functionals_.set_frame();
  }

  /// The same for another thread. The cells are shared, and so are the rows of the vertices, all of which
  /// must be there (prepare_rows()). `shared` must outlive this object, and its rows must stay where they
  /// are.
  struct ForThread {};
  HullGeometry(const HullGeometry& shared, ForThread)
      : axes_(shared.axes_),
        ambient_(shared.ambient_),
        coordinates_(shared.coordinates_),
        grid_(shared.grid_),
        center_(shared.center_),
        center_is_inside_(shared.center_is_inside_),
        inner_(shared.inner_),
        scale_(shared.scale_),
        lattice_(shared.lattice_),
        functionals_(shared.functionals_),
        rows_(shared.rows_, KeptRows::ForThread()) {}

  static constexpr bool has_plateaus = true;
  bool can_walk() const { return center_is_inside_; }

  int dimension() const { return K > 0 ? K : static_cast<int>(axes_.size()) - 1; }

  /// Adopts the box of all points, and computes their rows. All cells must be created anew after it. Throws
  /// std::bad_alloc, and then changes nothing.
  void set_box(const double* low, const double* high) {
    std::vector<double> scale(axes_.size());
    for (std::size_t r = 0; r < axes_.size(); ++r) {
      const auto axis = static_cast<std::size_t>(axes_[r]);
      const double half = std::max(high[axis] - center_[axis], center_[axis] - low[axis]);
      // A power of two. Boxes that are too large or too small to be scaled have none, and the filter is never
      // certain.
      scale[r] = center_is_inside_ && half > 0x1p-900 && half < 0x1p900
                     ? std::ldexp(1.0, -std::ilogb(half) - 1)
                     : std::numeric_limits<double>::quiet_NaN();
    }
    Lattice lattice(scale);
    const std::size_t n = coordinates_.size() / static_cast<std::size_t>(ambient_);
    rows_.reserve(static_cast<Index>(n));
    scale_ = std::move(scale);
    lattice_ = std::move(lattice);
    std::fill_n(rows_.row(0), axes_.size(), 0.0);
    if (n > 0) write_rows(1, static_cast<Index>(n));
  }

  /// Makes room for the rows of vertices up to `last` and what the first star of one thread would find out.
  /// Throws std::bad_alloc, and then changes nothing.
  void prepare_rows(Index last) { reserve_star(last, 1); }
  /// Computes the rows of vertices first … last. Several threads may do so for different ones.
  void write_rows(Index first, Index last) {
    for (Index v = first; v <= last; ++v) write_row(point(v), rows_.row(v));
  }

  /// A query at the point of a vertex.
  Query query_at(Index v) const { return make_query(point(v)); }
  /// REQUIRES a point in the flat and in the box.
  Query make_query(const double* point) const {
    Query q(point, axes_.size());
    q.bounds = lattice_.bounds(grid_, axes_);
    write_row(point, q.row.data());
    return q;
  }
  const double* point(Index vertex) const {
    return coordinates_.data() + (static_cast<std::size_t>(vertex) - 1) * static_cast<std::size_t>(ambient_);
  }
  bool is_at(Index vertex, const Query& q) const {
    return kernel::equal_points(point(vertex), q.point, ambient_);
  }

  auto evaluator(const Query& q) const { return functionals_.evaluator(q.row.data()); }
  /// The negative of g·X as a function n·(x − o) of points: writes n, returns the threshold.
  double hyperplane(Index cell, double* normal) const {
    const double* const g = functionals_.coefficients(cell);
    for (std::size_t r = 0; r < axes_.size(); ++r) normal[r] = -g[r] * scale_[r];
    return functionals_.threshold(cell);
  }
  bool is_infinite(Index) const { return false; }
  /// There is no tighter one.
  void thresholds_at(std::span<const Index> cells, const Query&, double* thresholds) const {
    std::fill_n(thresholds, cells.size(), std::numeric_limits<double>::infinity());
  }
  /// Whether a value within the threshold proves that q is exactly on the hyperplane.
  bool proves_tie(Index cell, double value, const Query& q) const {
    return functionals_.proves_zero(cell, value, q.bounds);
  }
  /// The exact side of q: positive inside.
  Sign exact_side(const Index* vertices, int, const Query& q, StageCounts& counts) const {
    return side(vertices, q.point, counts);
  }
  /// The side of the perturbed q if it is on the hyperplane, never zero. REQUIRES that q is none of the
  /// vertices.
  Sign perturbed_side(const Index* vertices, const Query& q, StageCounts& counts) const {
    ++counts.perturbed;
    const double* inner = center_.data();
    if (!center_is_inside_) {
      StageCounts uncounted;
      inner = point(*std::find_if(inner_.begin(), inner_.end(), [&](Index v) {
        return side(vertices, point(v), uncounted) != Sign::zero;
      }));
    }
    return kernel::perturbed_hull_side<D>(flat(), gather(vertices).data(), q.point, inner, grid_);
  }
  /// The exact side of a point, zero on the hyperplane.
  Sign side(const Index* vertices, const double* point, StageCounts& counts) const {
    return kernel::hull_side<D>(flat(), gather(vertices).data(), point, grid_, counts);
  }

  /// On which side of the wall between o and the facet `slot` of a cell q is, exactly: positive on the side
  /// of the cell.
  Sign side_of_facet(const Index* vertices, int slot, const Query& q) const {
    auto points = gather(vertices);
    points[static_cast<std::size_t>(slot)] = q.point;
    StageCounts uncounted;
    return kernel::hull_side<D>(flat(), points.data(), center_.data(), grid_, uncounted);
  }

  /// Makes room for a star of vertex v. Throws std::bad_alloc, and then changes nothing.
  void reserve_star(Index v, std::size_t facets) {
    functionals_.reserve_star(facets);
    rows_.reserve(v);
  }
  /// Computes what is cached for the created cells of a star of vertex v at q; returns the facets for whose
  /// cells that is too inaccurate: these cells must be created one by one.
  std::span<const std::uint32_t> create_star(Index v, const Query& q, std::span<const HorizonFacet> facets) {
    rows_.set(v, q.row.data());
    return functionals_.combine(facets, rows_.data(), q.row.data(), q.bounds);
  }
  /// Says nothing of a cell: exact stages decide.
  void give_up(Index cell, bool) { functionals_.give_up(cell, false); }
  /// Computes what is cached for a cell by elimination.
  void create(Index cell, const Index* vertices, int, int) {
    const std::size_t n = axes_.size();
    kernel::Buffer<double, D * D> rows(n * n);
    for (std::size_t i = 0; i < n; ++i) write_row(point(vertices[i]), rows.data() + i * n);
    functionals_.solve(cell, rows.data());
  }

 private:
  kernel::Flat flat() const { return {ambient_, axes_}; }
  void write_row(const double* point, double* row) const {
    for (std::size_t r = 0; r < axes_.size(); ++r) {
      const auto axis = static_cast<std::size_t>(axes_[r]);
      row[r] = (point[axis] - center_[axis]) * scale_[r];
    }
  }
  auto gather(const Index* vertices) const {
    kernel::Buffer<const double*, D> points(axes_.size());
    for (std::size_t i = 0; i < axes_.size(); ++i) points[i] = point(vertices[i]);
    return points;
  }

  std::vector<int> axes_;
  int ambient_;
  const std::vector<double>& coordinates_;
  const kernel::Grid& grid_;
  const std::vector<double>& center_;
  bool center_is_inside_;
  std::vector<Index> inner_;   // vertices that are on no common hyperplane
  std::vector<double> scale_;  // per axis of the flat
  Lattice lattice_;
  Functionals<K, false> functionals_;
  KeptRows rows_;
};

}  // namespace delone::geometry
