// SPDX-License-Identifier: BSD-3-Clause
// Joins the kernel to the engine for intersections of halfspaces: vertices are homogeneous rows (n, c), and a
// row q is in conflict with a cell iff it is beyond the linear hyperplane of the cell's rows. The cells bound
// a cone.
//
// Decisions are determinants of the rows as given. The filter works on the section of the cone with a
// hyperplane: the dual points n/s with s = −(n·p + c), p an interior point. These are pairs of doubles, so
// that their images in the box are off by less than one rounding, and everything that is proved of the
// functionals of convex hulls holds here (hull_geometry.hpp).
#pragma once

#include "geometry/hull_geometry.hpp"

#include <algorithm>

namespace delone::geometry {

/// Rows and their dual points by site. Vertex v of the engine is site v − 1.
struct DualSites {
  std::size_t row_size = 0;  ///< d + 1
  /// k + 1 columns on which the linear hull of the rows projects one-to-one; the last is column d.
  std::vector<int> axes;
  std::vector<double> rows;  ///< n×(d+1), as given
  /// n×2k: n_j/s on the first k axes, rounded, then the remainders of the rounding.
  std::vector<double> duals;

  int dimension() const { return static_cast<int>(axes.size()) - 1; }
  std::size_t size() const { return row_size == 0 ? 0 : rows.size() / row_size; }
  const double* row(Index site) const { return rows.data() + static_cast<std::size_t>(site) * row_size; }
  const double* dual(Index site) const {
    return duals.data() + static_cast<std::size_t>(site) * 2 * static_cast<std::size_t>(dimension());
  }
  kernel::Flat flat() const { return {static_cast<int>(row_size), axes, kernel::RowForm::homogeneous}; }
};

/// The point of view: a row strictly inside the cone, with its dual point as in DualSites, and a box for all
/// dual points.
struct DualView {
  std::vector<double> center, dual_of_center;
  bool is_inside = false;         ///< whether the centre is strictly inside the cone of the first simplex
  std::vector<double> low, high;  ///< by axis, k each
};

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class HalfspaceGeometry {
  static constexpr int D = K > 0 ? K + 1 : 0;  // of the space of dual points

 public:
  using Query = HullQuery<K>;

  /// The references must outlive this object; what they refer to may grow. `inner`: vertices whose rows are
  /// on no common hyperplane, for a view without a centre.
  HalfspaceGeometry(CellMemory<K>& cells, const DualSites& sites, const DualView& view,
                    std::vector<Index> inner)
      : sites_(sites),
        view_(view),
        inner_(std::move(inner)),
        scale_(static_cast<std::size_t>(sites.dimension()), std::numeric_limits<double>::quiet_NaN()),
        functionals_(cells),
        rows_(scale_.size()) {
    functionals_.set_frame();
  }

  /// The same for another thread; as HullGeometry's.
  struct ForThread {};
  HalfspaceGeometry(const HalfspaceGeometry& shared, ForThread)
      : sites_(shared.sites_),
        view_(shared.view_),
        inner_(shared.inner_),
        scale_(shared.scale_),
        functionals_(shared.functionals_),
        rows_(shared.rows_, KeptRows::ForThread()) {}

  static constexpr bool has_plateaus = true;
  bool can_walk() const { return view_.is_inside; }

  int dimension() const { return K > 0 ? K : static_cast<int>(scale_.size()) - 1; }

  /// Adopts the view's box. All cells must be created anew after it. Throws std::bad_alloc, and then changes
  /// nothing.
  void update_box() {
    const auto n = static_cast<Index>(sites_.size());
    rows_.reserve(n);
    for (std::size_t j = 0; j < scale_.size(); ++j) {
      const double center = view_.is_inside ? view_.dual_of_center[j] : 0;
      const double half = std::max(view_.high[j] - center, center - view_.low[j]);
      // With this scale images are at most 1/2 and a few roundings. Boxes that cannot be scaled have none,
      // and the filter is never certain.
      scale_[j] = view_.is_inside && half > 0x1p-900 && half < 0x1p900
                      ? std::ldexp(1.0, -std::ilogb(half) - 2)
                      : std::numeric_limits<double>::quiet_NaN();
    }
    std::fill_n(rows_.row(0), scale_.size(), 0.0);
    if (n > 0) write_rows(1, n);
  }

  /// As HullGeometry's.
  void prepare_rows(Index last) { reserve_star(last, 1); }
  void write_rows(Index first, Index last) {
    for (Index v = first; v <= last; ++v) write_image(v, rows_.row(v));
  }

  /// REQUIRES a site whose dual point is in the box.
  Query query_at(Index vertex) const {
    Query q(row(vertex), scale_.size());
    write_image(vertex, q.row.data());
    return q;
  }
  const double* row(Index vertex) const { return sites_.row(vertex - 1); }
  bool is_at(Index vertex, const Query& q) const {
    return kernel::equal_rows(sites_.flat(), row(vertex), q.point);
  }

  auto evaluator(const Query& q) const { return functionals_.evaluator(q.row.data()); }
  bool is_infinite(Index) const { return false; }
  /// There is no tighter one.
  void thresholds_at(std::span<const Index> cells, const Query&, double* thresholds) const {
    std::fill_n(thresholds, cells.size(), std::numeric_limits<double>::infinity());
  }
  /// Dual points lie on no grid, so ties are never proved here.
  bool proves_tie(Index, double, const Query&) const { return false; }
  /// The exact side of q: positive inside.
  Sign exact_side(const Index* vertices, int, const Query& q, StageCounts& counts) const {
    return side(vertices, q.point, counts);
  }
  /// The side of the perturbed q if it is on the hyperplane, never zero. REQUIRES that q is none of the
  /// vertices.
  Sign perturbed_side(const Index* vertices, const Query& q, StageCounts& counts) const {
    ++counts.perturbed;
    const double* inner = view_.center.data();
    if (!view_.is_inside) {
      StageCounts uncounted;
      inner = row(*std::find_if(inner_.begin(), inner_.end(),
                                [&](Index v) { return side(vertices, row(v), uncounted) != Sign::zero; }));
    }
    return kernel::perturbed_hull_side<D>(sites_.flat(), gather(vertices).data(), q.point, inner, no_grid_);
  }
  /// The exact side of a row, zero on the hyperplane.
  Sign side(const Index* vertices, const double* row, StageCounts& counts) const {
    return kernel::hull_side<D>(sites_.flat(), gather(vertices).data(), row, no_grid_, counts);
  }
  /// On which side of the wall between the centre and the facet `slot` of a cell q is, exactly: positive on
  /// the side of the cell.
  Sign side_of_facet(const Index* vertices, int slot, const Query& q) const {
    auto rows = gather(vertices);
    rows[static_cast<std::size_t>(slot)] = q.point;
    StageCounts uncounted;
    return kernel::hull_side<D>(sites_.flat(), rows.data(), view_.center.data(), no_grid_, uncounted);
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
    return functionals_.combine(facets, rows_.data(), q.row.data(), {});
  }
  /// Says nothing of a cell: exact stages decide.
  void give_up(Index cell, bool) { functionals_.give_up(cell, false); }
  /// Computes what is cached for a cell by elimination.
  void create(Index cell, const Index* vertices, int, int) {
    const std::size_t n = scale_.size();
    kernel::Buffer<double, D * D> rows(n * n);
    for (std::size_t i = 0; i < n; ++i) write_image(vertices[i], rows.data() + i * n);
    functionals_.solve(cell, rows.data());
  }

 private:
  /// The difference of two pairs, rounded once up to terms of second order (docs/predicates.md,
  /// "Halfspaces").
  void write_image(Index vertex, double* image) const {
    const std::size_t k = scale_.size();
    const double* dual = sites_.dual(vertex - 1);
    const double* center = view_.dual_of_center.data();
    for (std::size_t j = 0; j < k; ++j) {
      const double difference = dual[j] - center[j], part = difference - dual[j];
      const double lost = (dual[j] - (difference - part)) - (center[j] + part);
      image[j] = (difference + (lost + (dual[k + j] - center[k + j]))) * scale_[j];
    }
  }
  auto gather(const Index* vertices) const {
    kernel::Buffer<const double*, D> rows(scale_.size());
    for (std::size_t i = 0; i < scale_.size(); ++i) rows[i] = row(vertices[i]);
    return rows;
  }

  const DualSites& sites_;
  const DualView& view_;
  std::vector<Index> inner_;
  std::vector<double> scale_;  // per axis
  Functionals<K, false> functionals_;
  KeptRows rows_;                  // images
  const kernel::Grid no_grid_{1};  // homogeneous rows need none
};

}  // namespace delone::geometry
