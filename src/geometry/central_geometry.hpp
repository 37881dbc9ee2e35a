// SPDX-License-Identifier: BSD-3-Clause
// Joins the kernel to the engine for boundaries. Of a convex hull, cells are the facets of a simplicial
// polytope in a flat of dimension k + 1, and a point q is in conflict with a cell iff it is beyond its
// hyperplane. Of halfspaces, vertices are homogeneous rows (n, c), and a row q is in conflict with a cell iff
// it is beyond the linear hyperplane of the cell's rows; the cells bound a cone.
//
// All is relative to a centre o strictly inside. Functionals are h(x) = 1 + g·X, where X is x relative to o
// in units of the box, so h(o) = 1: the cells' functionals are the points of the polar polytope. Cells and o
// make the simplices of a fan; the walls between them are what a walk crosses.
//
// Of homogeneous rows, the filter works on the section of the cone with a hyperplane: x is the dual point n/s
// with s = −(n·p + c), p an interior point. These are pairs of doubles, so that their images in the box are
// off by less than one rounding, as those of points are. Decisions are determinants of the rows as given.
#pragma once

#include "cells/cell_memory.hpp"
#include "geometry/central_view.hpp"
#include "geometry/coordinate_functional.hpp"
#include "geometry/functionals.hpp"
#include "geometry/kept_rows.hpp"
#include "geometry/lattice.hpp"
#include "kernel/coordinate_plane.hpp"
#include "kernel/hull_stages.hpp"
#include "sites/boundary_sites.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace delone::geometry {

using internal::StageCounts;
using sites::BoundarySites;

/// A row to be tested against cells.
template <int K>
struct CentralQuery {
  explicit CentralQuery(const double* at, std::size_t size) : point(at), row(size) {}
  const double* point;
  LatticeBounds bounds;                     // nothing of homogeneous rows: dual points lie on no grid
  kernel::Buffer<double, K + (K > 0)> row;  // the image
};

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class CentralGeometry {
  static constexpr int D = K > 0 ? K + 1 : 0;  // of the flat, or of the space of dual points

 public:
  using Query = CentralQuery<K>;

  /// Vertex v is site v − 1. `inner`: vertices on no common hyperplane, for a view whose centre is not
  /// inside: then the filter is never certain. The references must outlive this object; what they refer to
  /// may grow.
  CentralGeometry(CellMemory<K>& cells, const BoundarySites& sites, const CentralView& view,
                  std::vector<Index> inner)
      : cells_(cells),
        sites_(sites),
        view_(view),
        inner_(std::move(inner)),
        scale_(static_cast<std::size_t>(sites.dimension()), std::numeric_limits<double>::quiet_NaN()),
        functionals_(cells),
        images_(scale_.size()) {
    functionals_.set_frame();
  }

  /// The same for another thread. The cells are shared, and so are the images of the vertices, all of which
  /// must be there (prepare_rows()). `shared` must outlive this object, and its images must stay where they
  /// are.
  struct ForThread {};
  CentralGeometry(const CentralGeometry& shared, ForThread)
      : cells_(shared.cells_),
        sites_(shared.sites_),
        view_(shared.view_),
        inner_(shared.inner_),
        scale_(shared.scale_),
        lattice_(shared.lattice_),
        functionals_(shared.functionals_),
        images_(shared.images_, KeptRows::ForThread()) {}

  static constexpr bool has_plateaus = true;
  bool can_walk() const { return view_.is_inside; }

  int dimension() const { return static_cast<int>(size()) - 1; }

  /// Adopts the view's box, and computes the images of all sites. All cells must be created again after it.
  /// Throws std::bad_alloc, and then changes nothing.
  void update_box() {
    // Images of dual points, which are off by a few roundings more, are at most 1/2.
    const int margin = sites_.is_homogeneous() ? 2 : 1;
    std::vector<double> scale(size());
    for (std::size_t r = 0; r < size(); ++r) {
      const double center = center_at(r), half = std::max(view_.high[r] - center, center - view_.low[r]);
      // A power of two. Boxes that are too large or too small to be scaled have none, and the filter is never
      // certain.
      scale[r] = view_.is_inside && half > 0x1p-900 && half < 0x1p900
                     ? std::ldexp(1.0, -std::ilogb(half) - margin)
                     : std::numeric_limits<double>::quiet_NaN();
    }
    Lattice lattice(scale);
    const auto n = static_cast<Index>(sites_.size());
    images_.reserve(n);
    scale_ = std::move(scale);
    lattice_ = std::move(lattice);
    std::fill_n(images_.row(0), size(), 0.0);
    if (n > 0) write_rows(1, n);
  }

  /// Makes room for the images of vertices up to `last` and what the first star of one thread would find out.
  /// Throws std::bad_alloc, and then changes nothing.
  void prepare_rows(Index last) { reserve_star(last, 1); }
  /// Computes the images of vertices first … last. Several threads may do so for different ones.
  void write_rows(Index first, Index last) {
    for (Index v = first; v <= last; ++v) write_image(v, images_.row(v));
  }

  /// A query at a vertex, whose point, or dual point, is in the box.
  Query query_at(Index v) const {
    if (!sites_.is_homogeneous()) return make_query(point(v));
    Query q(point(v), size());
    write_dual_image(v, q.row.data());
    return q;
  }
  /// REQUIRES sites that are points, and a point in the flat and in the box.
  Query make_query(const double* point) const {
    Query q(point, size());
    q.bounds = lattice_.bounds(view_.grid, sites_.axes);
    write_point_image(point, q.row.data());
    return q;
  }
  /// The row of a vertex, as given.
  const double* point(Index vertex) const { return sites_.point(vertex - 1); }
  bool is_at(Index vertex, const Query& q) const {
    return kernel::equal_rows(sites_.flat(), point(vertex), q.point);
  }

  auto evaluator(const Query& q) const { return functionals_.evaluator(q.row.data()); }
  /// The same at a vertex of cells.
  auto evaluator_at(Index v) const { return functionals_.evaluator(images_.data() + v * size()); }
  /// The negative of g·X as a function n·(x − o) of points: writes n, returns the threshold.
  double hyperplane(Index cell, double* normal) const {
    const double* const g = functionals_.coefficients(cell);
    for (std::size_t r = 0; r < size(); ++r) normal[r] = -g[r] * scale_[r];
    return functionals_.threshold(cell);
  }
  bool is_infinite(Index) const { return false; }
  /// There is no tighter one.
  void thresholds_at(std::span<const Index> cells, const Query&, double* thresholds) const {
    std::fill_n(thresholds, cells.size(), std::numeric_limits<double>::infinity());
  }
  /// Whether q is proved to be exactly on the hyperplane, if the value is within the threshold: by the value,
  /// or since the hyperplane is that of a coordinate.
  bool proves_tie(Index cell, double value, const Query& q) const {
    if (functionals_.proves_zero(cell, value, q.bounds)) return true;
    if (std::fabs(value) > functionals_.threshold(cell)) return false;
    const auto vertex = [layout = cells_.layout(), links = cells_.links(cell)](int i) {
      return layout.vertex(links, i);
    };
    return kernel::common_axis(sites_.flat(), q.point, [&](int i) { return point(vertex(i)); }) !=
           kernel::no_axis;
  }
  /// The exact side of q: positive inside.
  Sign exact_side(const Index* vertices, int, const Query& q, StageCounts& counts) const {
    return side(vertices, q.point, counts);
  }
  /// The side of the perturbed q if it is on the hyperplane, never zero. REQUIRES that q is none of the
  /// vertices.
  Sign perturbed_side(const Index* vertices, const Query& q, StageCounts& counts) const {
    ++counts.perturbed;
    if (const int r = view_.is_inside ? common_axis(vertices, q.point) : kernel::no_axis;
        r != kernel::no_axis)
      return kernel::perturbed_side_in_coordinate_plane<D>(sites_.flat(), gather(vertices).data(), q.point, r,
                                                           view_.center.data(), view_.grid);
    const double* inner = view_.center.data();
    if (!view_.is_inside || !view_.grid.is_small()) {
      // Of determinants of sites alone more are seen to be zero without wide arithmetic.
      StageCounts uncounted;
      inner = point(*std::find_if(inner_.begin(), inner_.end(), [&](Index v) {
        return side(vertices, point(v), uncounted) != Sign::zero;
      }));
    }
    return kernel::perturbed_hull_side<D>(sites_.flat(), gather(vertices).data(), q.point, inner, view_.grid);
  }
  /// The exact side of a row, zero on the hyperplane.
  Sign side(const Index* vertices, const double* row, StageCounts& counts) const {
    return kernel::hull_side<D>(sites_.flat(), gather(vertices).data(), row, view_.grid, counts);
  }
  /// On which side of the wall between o and the facet `slot` of a cell q is, exactly: positive on the side
  /// of the cell.
  Sign side_of_facet(const Index* vertices, int slot, const Query& q) const {
    auto rows = gather(vertices);
    rows[static_cast<std::size_t>(slot)] = q.point;
    if (const int r = common_axis(vertices, q.point); r != kernel::no_axis)
      return kernel::side_off_coordinate_plane<D>(sites_.flat(), rows.data(), r, view_.center.data(),
                                                  view_.grid);
    StageCounts uncounted;
    return kernel::hull_side<D>(sites_.flat(), rows.data(), view_.center.data(), view_.grid, uncounted);
  }

  /// Makes room for a star of vertex v. Throws std::bad_alloc, and then changes nothing.
  void reserve_star(Index v, std::size_t facets) {
    functionals_.reserve_star(facets);
    images_.reserve(v);
  }
  /// Computes what is cached for the created cells of a star of vertex v at q; returns the facets for whose
  /// cells that is too inaccurate: these cells must be created one by one.
  std::span<const std::uint32_t> create_star(Index v, const Query& q, std::span<const HorizonFacet> facets) {
    images_.set(v, q.row.data());
    return functionals_.combine(facets, images_.data(), q.row.data(), q.bounds);
  }
  /// Says nothing of a cell: exact stages decide.
  void give_up(Index cell, bool) { functionals_.give_up(cell, false); }
  /// Takes over what is cached of a cell in the same hyperplane.
  void adopt_hyperplane(Index cell, Index from) { copy_functional(cells_, cell, from); }
  /// Computes what is cached for a cell: by elimination, unless its hyperplane is that of a coordinate.
  void create(Index cell, const Index* vertices, int, int) {
    const double* const first = point(vertices[0]);
    if (const int r = common_axis(vertices, first);
        r != kernel::no_axis &&
        write_coordinate_functional(cells_, cell, r, point_image(first, static_cast<std::size_t>(r))))
      return;
    kernel::Buffer<double, D * D> rows(size() * size());
    for (std::size_t i = 0; i < size(); ++i) write_image(vertices[i], rows.data() + i * size());
    functionals_.solve(cell, rows.data());
  }

 private:
  /// k: of vertices of a cell, and of numbers of an image.
  std::size_t size() const { return K > 0 ? K + 1 : scale_.size(); }
  double center_at(std::size_t r) const {
    return sites_.is_homogeneous() ? view_.dual_of_center[r]
                                   : view_.center[static_cast<std::size_t>(sites_.axes[r])];
  }
  void write_image(Index v, double* image) const {
    if (sites_.is_homogeneous())
      write_dual_image(v, image);
    else
      write_point_image(point(v), image);
  }
  double point_image(const double* point, std::size_t r) const {
    const auto axis = static_cast<std::size_t>(sites_.axes[r]);
    return (point[axis] - view_.center[axis]) * scale_[r];
  }
  void write_point_image(const double* point, double* image) const {
    for (std::size_t r = 0; r < size(); ++r) image[r] = point_image(point, r);
  }
  /// The difference of two pairs, rounded once up to terms of second order (docs/predicates.md,
  /// "Halfspaces").
  void write_dual_image(Index v, double* image) const {
    const std::size_t k = size();
    const double* dual = sites_.dual(v - 1);
    const double* center = view_.dual_of_center.data();
    for (std::size_t j = 0; j < k; ++j) {
      const double difference = dual[j] - center[j], part = difference - dual[j];
      const double lost = (dual[j] - (difference - part)) - (center[j] + part);
      image[j] = (difference + (lost + (dual[k + j] - center[k + j]))) * scale_[j];
    }
  }
  auto gather(const Index* vertices) const {
    kernel::Buffer<const double*, D> rows(size());
    for (std::size_t i = 0; i < size(); ++i) rows[i] = point(vertices[i]);
    return rows;
  }

  /// The axis of the flat whose hyperplane q and the vertices of a cell are in, if there is one.
  int common_axis(const Index* vertices, const double* q) const {
    return kernel::common_axis(sites_.flat(), q, [&](int i) { return point(vertices[i]); });
  }

  CellMemory<K>& cells_;
  const BoundarySites& sites_;
  const CentralView& view_;
  std::vector<Index> inner_;
  std::vector<double> scale_;  // per axis
  Lattice lattice_;
  Functionals<K, false> functionals_;
  KeptRows images_;
};

}  // namespace delone::geometry
