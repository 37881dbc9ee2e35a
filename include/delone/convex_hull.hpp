// SPDX-License-Identifier: BSD-3-Clause
// Exact convex hulls in any dimension: the polytope of a set of points with its cells, facets, ridges and
// extreme points.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/error.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace delone {

/// The simplices of the boundary of a convex hull, and its vertices, as the same members of HullData.
struct DELONE_EXPORT_TYPE HullCells {
  int affine_dimension = -1;  ///< k
  std::vector<SignedIndex> cells, neighbors, vertices;

  std::size_t num_cells() const {
    return affine_dimension < 1 ? 0 : cells.size() / static_cast<std::size_t>(affine_dimension);
  }
};

/// Where a point lies with respect to a hull, decided exactly.
struct Containment {
  enum class Kind {
    inside,               ///< in the interior (of the hull within its flat)
    on_boundary,          ///< in the relative interior of a face
    outside,              ///< in the affine hull of the points, outside their convex hull
    outside_affine_hull,  ///< not in the affine hull (k < d)
  };
  Kind kind = Kind::outside_affine_hull;
  /// A cell. Outside: one that is visible from the query. On the boundary: one whose hyperplane contains the
  /// query. Inside: one through which the ray from an interior point through the query leaves the hull (any
  /// cell if no double is found in the interior). −1 if there is none.
  SignedIndex cell = -1;
  /// On the boundary: the extreme rows of the smallest face that contains the query, increasing. One row: the
  /// query is a vertex.
  std::vector<SignedIndex> face;
};

struct HullInsertResult {
  std::size_t row = 0;  ///< the row of the new point
  /// The boundary has changed; false for a duplicate, an interior point, and some boundary points.
  bool inserted = false;
  bool duplicate = false;  ///< equal to an earlier point
};

/// A convex polytope as the convex hull of points of R^d: what is true of it in every dimension. Make a
/// ConvexHull<D>; functions for all dimensions take a `const ConvexHullBase&`.
///
/// `const` members may be called from several threads at once. Members with a query throw Errc::bad_dimension
/// unless it has d coordinates, and not_finite. Members with a row throw invalid_argument unless row <
/// num_points(). What is computed on first use throws out_of_memory if there is not enough memory.
class DELONE_EXPORT ConvexHullBase {
 public:
  int dimension() const;           ///< d
  int affine_dimension() const;    ///< k ≤ d; 0 for one distinct point, −1 for none
  std::size_t num_points() const;  ///< rows inserted, duplicates included
  std::size_t num_duplicates() const;
  std::size_t num_cells() const;                         ///< simplices of the boundary
  std::size_t num_vertices() const;                      ///< extreme points
  std::size_t num_facets() const;                        ///< of the polytope
  std::size_t num_ridges() const;                        ///< of the polytope
  PointKind kind(std::size_t row) const;                 ///< O(1) after the first call
  std::size_t count(PointKind kind) const;               ///< rows of that kind
  std::span<const double> point(std::size_t row) const;  ///< the d coordinates of a row
  std::vector<int> axes() const;                         ///< as Triangulation::axes()

  /// Options::tolerance; 0 for an exact hull. With axis_tolerances the largest that is used.
  double tolerance() const;
  /// No point is farther outside along an axis than this; d numbers. With Options::axis_tolerances those that
  /// are used, lowered as said below; otherwise all are tolerance().
  std::vector<double> axis_tolerances() const;
  /// No point is farther than this from the hull: a bound, rounded up, that is at most the tolerance. With
  /// axis_tolerances where axes are scaled as said below; so it is a distance along the axis of the largest.
  /// After insert_extreme_points() the first call may compute an exact hull of the rows, and
  /// data().max_distance is the tolerance.
  double max_distance() const;

  /// The hull as arrays, without `points`; valid until the next insertion. Computed on first use after a
  /// change, O(cells·k³) and more if cells share hyperplanes. The numbers, kinds and measures above and below
  /// do not need it. Cells are in no particular order; for k = 1 cell 0 is the lower end on the axis.
  ///
  /// `equations` are rounded: for every x of the hull the exact signed distance from the facet's hyperplane
  /// differs from that of the row, evaluated without error, by at most the entry of `equation_errors`. For k
  /// < d the normals are parallel to the flat and the errors infinite.
  const HullData& data() const;
  /// Some of these arrays, made anew at each call. Costs less than the first call of data().
  HullCells to_cells() const;
  /// A copy of data(), with the points.
  HullData to_data(bool with_points = true) const;

  /// The k-dimensional volume, and the (k−1)-dimensional volume of the boundary, each a compensated sum over
  /// the cells, both O(m·d³) together. The error bound covers the arithmetic to first order, with slack; it
  /// is infinite if numbers overflow. For k = 1 the area is 2, the number of end points; for k < 1 both are
  /// 0.
  Measure volume() const;
  Measure area() const;

  /// f_0 … f_(k−1), the number of faces of the polytope of each dimension; the Euler–Poincaré relation
  /// Σ(−1)^j·f_j = 1 − (−1)^k holds. Cost up to O(faces · facets · k), memory for all faces of one dimension.
  /// Throws Errc::cancelled.
  std::vector<std::size_t> f_vector(const Execution& how = {}) const;

  /// Where the query lies, exactly. Cost: a walk over cells.
  Containment locate(const AnyPoint<>& query) const;
  bool contains(const AnyPoint<>& query) const;  ///< inside or on the boundary

  /// The cells that are strictly visible from the query, increasing: those whose hyperplane has it strictly
  /// on the outer side. Empty for a query in the hull or outside the affine hull. O(answer·k⁴).
  std::vector<SignedIndex> visible_cells(const AnyPoint<>& query) const;
  /// The facets that are strictly visible from the query, increasing.
  std::vector<SignedIndex> visible_facets(const AnyPoint<>& query) const;

  /// Depends on the coordinates of the cells' vertices and the set of cells only: not on order, seed,
  /// duplicates, interior points.
  CanonicalHash hash() const;
  /// What the hull has cost so far.
  Statistics statistics() const;

 protected:
  ConvexHullBase(int dimension, const Options& options);
  ConvexHullBase(detail::Clone, const ConvexHullBase& other);
  ConvexHullBase(ConvexHullBase&&) noexcept;
  ConvexHullBase& operator=(ConvexHullBase&&) noexcept;
  ~ConvexHullBase();

  void insert_coordinates(std::span<const double> coordinates);
  std::vector<SignedIndex> insert_extreme_coordinates(std::span<const double> coordinates);
  HullInsertResult insert_point(std::span<const double> point);

 private:
  struct DELONE_HIDDEN Impl;
  std::unique_ptr<Impl> impl_;
};

/// The convex hull of points of R^D; of R^d, d chosen at run time, if D is dynamic.
///
/// Method: incremental insertion. Points that lie in the hyperplane of a cell are moved inwards by
/// infinitesimals, larger ones for lexicographically larger points, so that the boundary is always made of
/// simplices and is a function of the set of points alone (after Devillers and Teillaud, "Perturbations for
/// Delaunay and weighted Delaunay 3D triangulations", doi:10.1016/j.comgeo.2010.09.010). Cells in one
/// hyperplane are then merged into the facets of the polytope, exactly; facets, ridges, faces and extreme
/// points do not depend on the perturbation.
///
/// With Options::tolerance ε > 0 it is the exact convex hull of some of the points, chosen such that no point
/// is farther than ε from it; the distance is Euclidean, and the decision exact. So it is convex and
/// watertight, and its vertices are rows of the input. max_distance() bounds the distances.
///
/// Its vertices are chosen as follows. First, the extreme points that are farther than ε from the hull of all
/// others. Then, while some point is farther than ε from the hull of the chosen ones, the farthest is added.
/// Finally points that the others cover are dropped, the last one first. So no vertex can be omitted. The
/// choice is a function of the set of points. A point that is not a vertex has the kind `interior` if it is
/// strictly inside, otherwise `boundary`.
///
/// Facets are then sets of cells. A facet begins with the largest cell that is not in one yet. It grows
/// across ridges while all its vertices are within ε of the hyperplane of that cell, which is the one in
/// `equations`. Facets, faces and ridges are those of these sets: two facets that meet share one ridge, and a
/// face is a set of vertices that some facets have in common. Euler's relation may fail for them if ε is not
/// small compared with the facets. num_cells(), hash(), volume(), area(), locate() and visible_cells() refer
/// to the cells. (A LowerHull with a tolerance has the exact facets of the points that it keeps.)
///
/// If all points are within ε of a flat of fewer dimensions, spanned by a few points that are far apart, the
/// hull lies in that flat. Cells are those of the projections on axes(); all points are still within ε of the
/// vertices' hull in space. Queries within ε of the flat count as lying in it. Not every set within ε of some
/// hyperplane is flat in this sense.
///
/// With Options::axis_tolerances each axis has a tolerance t_j of its own. Axes are first multiplied by
/// powers of two, at least 1, for which the tolerances agree but for a factor below 2, and are lowered to the
/// least of them, ε. Distances are those after that, so no point is farther outside along axis j than t_j;
/// and a column that is multiplied by a power of two, with its tolerance, has the same hull. All of the above
/// holds with these distances, also what it says of facets and flats.
///
/// After insert() the vertices are chosen again by the next query, at a cost that depends on all extreme
/// points; insert_range() chooses them at once. A tolerance larger than the extent of all points along every
/// axis is Errc::invalid_argument, unless all points are equal.
///
/// Exact for all finite doubles. Flat input has the hull in its flat, k < d: for k = 1 two end points, each a
/// facet; for k = 0 a single point, without facets. Duplicates are merged. Worst case O(n^⌊d/2⌋) cells.
template <int D = dynamic>
class ConvexHull : public ConvexHullBase {
  static_assert(D >= 1 || D == dynamic, "the dimension of the space is at least 1");

 public:
  using Coordinates =
      std::span<const double, D == dynamic ? std::dynamic_extent : static_cast<std::size_t>(D)>;

  /// The hull of no points. Throws Errc::bad_dimension unless dimension ≥ 1, and invalid_argument for
  /// tolerances, see Options, or a time limit that is negative or not finite.
  explicit ConvexHull(int dimension, const Options& options = {}) requires(D == dynamic)
      : ConvexHullBase(dimension, options) {}
  explicit ConvexHull(const Options& options = {}) requires(D != dynamic) : ConvexHullBase(D, options) {}
  /// The hull of points. Throws as insert_range().
  ConvexHull(AnyPoints<> points, int dimension, const Options& options = {}) requires(D == dynamic)
      : ConvexHullBase(dimension, options) {
    insert_range(std::move(points));
  }
  explicit ConvexHull(PointsView points, const Options& options = {}) requires(D == dynamic)
      : ConvexHullBase(points.dimension(), options) {
    insert_range(points);
  }
  explicit ConvexHull(AnyPoints<D> points, const Options& options = {}) requires(D != dynamic)
      : ConvexHullBase(D, options) {
    insert_range(std::move(points));
  }
  ConvexHull(ConvexHull&&) noexcept = default;
  ConvexHull& operator=(ConvexHull&&) noexcept = default;

  /// A deep copy. Cost: that of copying the cells and the points. Throws Errc::out_of_memory.
  ConvexHull clone() const { return ConvexHull(detail::Clone{}, *this); }

  /// Inserts points as the next rows: all or none. A point outside the affine hull of all earlier ones makes
  /// it rebuild everything. Throws Errc::not_finite, bad_dimension, cancelled, too_many, out_of_memory,
  /// time_limit, and invalid_argument for a tolerance larger than the points; the hull is then unchanged.
  void insert_range(AnyPoints<D> points) {
    points.require_dimension(dimension());
    insert_coordinates(points.coordinates());
  }
  /// Inserts the extreme points among the given ones into an empty hull. Others may become rows, too, but all
  /// vertices of cells are extreme: if many points lie in the hyperplanes of facets, there are far fewer
  /// cells than with all points, and different ones. Returns which of the points each row is, in no
  /// particular order; of equal points it is the first. Kinds and counts refer to the rows. Cost: that of the
  /// hull of the extreme points, and one or two passes over all points. Throws as insert_range(), and
  /// Errc::invalid_argument if the hull has rows already.
  std::vector<SignedIndex> insert_extreme_points(AnyPoints<D> points) {
    points.require_dimension(dimension());
    return insert_extreme_coordinates(points.coordinates());
  }
  /// Inserts one point as the next row. Throws Errc::not_finite, bad_dimension, too_many, out_of_memory; the
  /// hull is then unchanged.
  HullInsertResult insert(const AnyPoint<D>& point) { return insert_point(point); }

  /// The coordinates of a row. Throws Errc::invalid_argument unless row < num_points().
  Coordinates point(std::size_t row) const { return Coordinates(ConvexHullBase::point(row)); }
  Containment locate(const AnyPoint<D>& query) const { return ConvexHullBase::locate(query.coordinates()); }
  bool contains(const AnyPoint<D>& query) const { return ConvexHullBase::contains(query.coordinates()); }
  std::vector<SignedIndex> visible_cells(const AnyPoint<D>& query) const {
    return ConvexHullBase::visible_cells(query.coordinates());
  }
  std::vector<SignedIndex> visible_facets(const AnyPoint<D>& query) const {
    return ConvexHullBase::visible_facets(query.coordinates());
  }

 private:
  ConvexHull(detail::Clone clone, const ConvexHull& other) : ConvexHullBase(clone, other) {}
};

ConvexHull(int, const Options& = {})->ConvexHull<dynamic>;
ConvexHull(PointsView, const Options& = {})->ConvexHull<dynamic>;
template <class Points>
ConvexHull(Points&&, int, const Options& = {}) -> ConvexHull<dynamic>;
template <class Points>
requires(detail::dimension_of_range<Points>() > 0) ConvexHull(Points&&, const Options& = {})
->ConvexHull<detail::dimension_of_range<Points>()>;

}  // namespace delone
