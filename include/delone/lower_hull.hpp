// SPDX-License-Identifier: BSD-3-Clause
// The lower (or upper) part of a convex hull with respect to the last coordinate: the convex envelope of
// heights over compositions, as in phase diagrams.
#pragma once

#include <delone/complex.hpp>
#include <delone/convex_hull.hpp>
#include <delone/data.hpp>
#include <delone/export.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace delone {

enum class HullSide { lower, upper };

/// The convex envelope of points of R^d, d ≥ 2, or the concave one: what is true of it in every dimension.
/// Make a LowerHull<D>.
///
/// The first d−1 coordinates of a point are its *composition*, the last one is its *height* (an energy, say).
/// The envelope consists of simplices of c+1 points, the *cells*, c the affine dimension of the compositions.
/// Seen along the last axis they triangulate the domain, the convex hull of the compositions. Cells in one
/// hyperplane belong to one facet; if all heights are an affine function of the compositions, there is a
/// single facet.
///
/// `const` members may be called from several threads at once. Members with queries throw Errc::bad_dimension
/// for a wrong number of coordinates, and not_finite.
class DELONE_EXPORT LowerHullBase {
 public:
  int dimension() const;              ///< d
  int composition_dimension() const;  ///< c ≤ d−1, the affine dimension of the compositions; −1 for no point
  HullSide side() const;
  std::size_t num_points() const;
  std::size_t num_cells() const;
  std::size_t num_facets() const;

  /// m×(c+1) input rows. Positively oriented in the coordinates of `composition_axes` for c ≥ 1.
  std::span<const SignedIndex> cells() const;
  /// m×(c+1) cells: neighbor i is across the facet opposite vertex i; −1 at the border of the domain.
  std::span<const SignedIndex> neighbors() const;
  /// The facet of each cell.
  std::span<const SignedIndex> facet_of_cell() const;
  /// The rows of the extreme points of this side ("stable" phases), increasing; of equal rows the first.
  std::span<const SignedIndex> vertices() const;
  /// c axes of the compositions on which their flat projects one-to-one.
  std::vector<int> composition_axes() const;

  /// A cell whose domain contains the composition (d−1 numbers), exactly; nullopt outside the domain. Cost: a
  /// walk.
  std::optional<std::size_t> find_cell(const AnyPoint<>& composition) const;

  /// The height of the envelope over each of q compositions (q×(d−1)). Off by no more than a rounding and
  /// 2⁻³⁶ times the range of the heights of the vertices of the smallest face there, and within that range,
  /// however thin the cell: if binary64 cannot guarantee that, exact arithmetic computes it. Outside the
  /// domain +∞ for the lower hull, −∞ for the upper.
  std::vector<double> heights(const AnyPoints<>& compositions) const;

  /// The height of each of q points (q×d) above the envelope ("energy above hull"). The sign is exact: 0 only
  /// for points exactly on the envelope, negative below it. The magnitude is off by no more than a relative
  /// 2⁻³⁶, or the smallest double. −∞ (+∞ for the upper hull) outside the domain. Heights of a magnitude up
  /// to `tolerance` are 0, decided exactly. Throws invalid_argument for a tolerance that is negative, NaN or
  /// infinite.
  std::vector<double> height_above(const AnyPoints<>& points, double tolerance = 0) const;

  /// Options::tolerance; 0 for an exact envelope.
  double tolerance() const;
  /// No point is farther than this below a lower hull (above an upper one), along the last axis: a bound,
  /// rounded up, that is at most the tolerance.
  double max_distance() const;

  /// The cells as plain data: dimension d, affine_dimension c (of the cells). For files and pictures; not a
  /// Delaunay triangulation.
  ComplexData to_data() const;

  /// The convex hull that contains this part: the hull of the points, projected to the composition axes and
  /// the height (negated for the upper hull), and of one point above them all. If a tolerance has dropped
  /// vertices, its rows are the kept ones, in the order of vertices(). Throws Errc::invalid_argument if there
  /// are no points.
  const ConvexHullBase& polytope() const;

 protected:
  LowerHullBase(const AnyPoints<>& points, int dimension, HullSide side, const Options& options);
  LowerHullBase(detail::Clone, const LowerHullBase& other);
  LowerHullBase(LowerHullBase&&) noexcept;
  LowerHullBase& operator=(LowerHullBase&&) noexcept;
  ~LowerHullBase();

 private:
  struct DELONE_HIDDEN Impl;
  std::unique_ptr<Impl> impl_;
};

/// The lower hull of points of R^D, D ≥ 2; of R^d, d chosen at run time, if D is dynamic: the graph of the
/// largest convex function that is nowhere above the points, over the convex hull of their compositions. The
/// upper hull is that of the least concave function that is nowhere below them.
///
/// With Options::tolerance ε > 0 it is the exact lower hull of some of the points, over the same domain, such
/// that no point is more than ε below it along the last axis (decided exactly). They are chosen among the
/// vertices of the exact lower hull: first those with extreme compositions; then, while one is more than ε
/// below the present hull, the farthest below each cell; finally vertices that the others cover are dropped.
/// So no vertex can be omitted. Compositions have no tolerance. The facets are those of the exact lower hull
/// of the chosen points: cells in one hyperplane, exactly. They do not grow across nearly flat ridges, as
/// those of a ConvexHull with a tolerance do. A tolerance larger than the range of the heights is
/// Errc::invalid_argument, unless all heights are equal.
///
/// Exact for all finite doubles; a function of the set of points. Duplicates, flat compositions and points
/// above the hull are ordinary input. Cost: a convex hull of n+1 points.
template <int D = dynamic>
class LowerHull : public LowerHullBase {
  static_assert(D >= 2 || D == dynamic, "a point of a lower hull has a composition and a height");

 public:
  /// The numbers of a composition, as a template argument of AnyPoint and AnyPoints.
  static constexpr int composition_size = D == dynamic ? dynamic : D - 1;

  /// Throws Errc::bad_dimension (d < 2, or a number of coordinates that does not fit), not_finite,
  /// invalid_argument (the tolerance), too_many, out_of_memory, cancelled, time_limit.
  LowerHull(const AnyPoints<>& points, int dimension, HullSide side = HullSide::lower,
            const Options& options = {}) requires(D == dynamic)
      : LowerHullBase(points, dimension, side, options) {}
  explicit LowerHull(PointsView points, HullSide side = HullSide::lower,
                     const Options& options = {}) requires(D == dynamic)
      : LowerHullBase(points, points.dimension(), side, options) {}
  explicit LowerHull(const AnyPoints<D>& points, HullSide side = HullSide::lower,
                     const Options& options = {}) requires(D != dynamic)
      : LowerHullBase(PointsView(points.coordinates(), D), D, side, options) {}
  LowerHull(LowerHull&&) noexcept = default;
  LowerHull& operator=(LowerHull&&) noexcept = default;

  /// A deep copy. Throws Errc::out_of_memory.
  LowerHull clone() const { return LowerHull(detail::Clone{}, *this); }

  std::optional<std::size_t> find_cell(const AnyPoint<composition_size>& composition) const {
    return LowerHullBase::find_cell(composition.coordinates());
  }
  std::vector<double> heights(const AnyPoints<composition_size>& compositions) const {
    if constexpr (D == dynamic)
      return LowerHullBase::heights(compositions);
    else
      return LowerHullBase::heights(compositions.coordinates());
  }
  std::vector<double> height_above(const AnyPoints<D>& points, double tolerance = 0) const {
    if constexpr (D == dynamic)
      return LowerHullBase::height_above(points, tolerance);
    else
      return LowerHullBase::height_above(points.coordinates(), tolerance);
  }

 private:
  LowerHull(detail::Clone clone, const LowerHull& other) : LowerHullBase(clone, other) {}
};

LowerHull(PointsView, HullSide = HullSide::lower, const Options& = {})->LowerHull<dynamic>;
template <class Points>
LowerHull(Points&&, int, HullSide = HullSide::lower, const Options& = {}) -> LowerHull<dynamic>;
template <class Points>
requires(detail::dimension_of_range<Points>() > 0)
    LowerHull(Points&&, HullSide = HullSide::lower, const Options& = {})
->LowerHull<detail::dimension_of_range<Points>()>;

}  // namespace delone
