// SPDX-License-Identifier: BSD-3-Clause
// Exact convex hulls in any dimension: the polytope of a set of points with its cells, facets, ridges and
// extreme points.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/error.hpp>
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

/// A length, area or volume: the exact one differs from `value` by at most `error`.
struct Measure {
  double value = 0;
  double error = 0;
};

/// Where a point lies with respect to a hull, exactly.
struct Containment {
  enum class Kind {
    inside,               ///< in the interior (of the hull within its flat)
    on_boundary,          ///< in the relative interior of a face
    outside,              ///< in the affine hull of the points, outside their convex hull
    outside_affine_hull,  ///< not in the affine hull (k < d)
  };
  Kind kind = Kind::outside_affine_hull;
  /// A cell: outside, one that is visible from the query; on the boundary, one whose hyperplane contains it;
  /// inside, one that the ray from an interior point through the query leaves by (any cell if the points span
  /// so little that no double is found in the interior). −1 if there is none.
  SignedIndex cell = -1;
  /// On the boundary: the extreme rows of the smallest face that contains the query, increasing. One row: the
  /// query is a vertex.
  std::vector<SignedIndex> face;
};

struct HullInsertResult {
  std::size_t row = 0;     ///< the row of the new point
  bool inserted = false;   ///< the boundary has changed; false for a duplicate, an interior point, and some
                           ///< boundary points
  bool duplicate = false;  ///< equal to an earlier point
};

/// A convex polytope as the convex hull of points of R^d: what is true of it in every dimension.
/// ConvexHull<D> makes one; functions for all dimensions take a `const Polytope&`.
///
/// `const` members may be called from several threads at once. REQUIRES of queries finite coordinates;
/// otherwise they throw Errc::not_finite, and Errc::bad_dimension unless there are d of them.
class DELONE_EXPORT Polytope {
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

  /// Options::tolerance; 0 for an exact hull.
  double tolerance() const;
  /// No point is farther than this from the hull: a bound, rounded up, that is at most the tolerance. After
  /// insert_extreme_points() the first call may cost an exact hull of the rows; data().max_distance is then
  /// the tolerance.
  double max_distance() const;

  /// The hull as arrays, without `points`; valid until the next insertion. Computed on first use after a
  /// change, O(cells·k³) and more where cells share hyperplanes. The numbers, kinds and measures above and
  /// below do not need it. Cells are numbered in no particular order; for k = 1 cell 0 is the lower end on
  /// the axis.
  ///
  /// `equations` are rounded: for every x of the hull the exact signed distance from the facet's hyperplane
  /// differs from that of the row, evaluated without error, by at most the entry of `equation_errors`. For k
  /// < d the normals are parallel to the flat and the errors infinite.
  const HullData& data() const;
  /// A copy of data(), with the points.
  HullData to_data(bool with_points = true) const;

  /// The k-dimensional volume, and the (k−1)-dimensional volume of the boundary, each a compensated sum over
  /// the cells, both O(m·d³) together. The error bound covers the arithmetic to first order, with slack; it
  /// is infinite where numbers overflow. For k = 1 the area is 2, the number of end points; for k < 1 both
  /// are 0.
  Measure volume() const;
  Measure area() const;

  /// f_0 … f_(k−1), the number of faces of the polytope of each dimension; the Euler–Poincaré relation
  /// Σ(−1)^j·f_j = 1 − (−1)^k holds. Cost up to O(faces · facets · k), memory for all faces of one dimension.
  std::vector<std::size_t> f_vector() const;

  /// Where q lies, exactly. Cost: a walk over cells.
  Containment locate(const AnyPoint<>& query) const;
  bool contains(const AnyPoint<>& query) const;  ///< inside or on the boundary

  /// The cells that are strictly visible from q, increasing: those whose hyperplane has q strictly beyond it.
  /// Empty for a q of the hull or outside the affine hull. O(answer·k⁴).
  std::vector<SignedIndex> visible_cells(const AnyPoint<>& query) const;
  /// The facets that are strictly visible from q, increasing.
  std::vector<SignedIndex> visible_facets(const AnyPoint<>& query) const;

  /// Depends on the coordinates of the cells' vertices and the set of cells only: not on order, seed,
  /// duplicates, interior points.
  CanonicalHash hash() const;
  Statistics statistics() const;

 protected:
  Polytope(int dimension, const Options& options);
  Polytope(detail::Clone, const Polytope& other);
  Polytope(Polytope&&) noexcept;
  Polytope& operator=(Polytope&&) noexcept;
  ~Polytope();

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
/// Which vertices it has: First, those extreme points of all that are farther than ε from the hull of the
/// others. Then the farthest point from what is there is added, while it is farther than ε. In the end
/// points are dropped that the others cover, the last one first. So no vertex can be left out. The choice is
/// a function of the set of points. A point that is no vertex is of the kind `interior` if it is strictly
/// inside, otherwise `boundary`.
///
/// Facets are then sets of cells. One begins with the largest cell that is in none. It grows across ridges
/// while all its vertices are within ε of the hyperplane of that cell, which is that of `equations`. Facets,
/// faces and ridges are those of these sets: where two facets meet there is one ridge, and a face is a set of
/// vertices that some facets have in common. Euler's relation may fail for them if ε is not small beside the
/// facets. num_cells(), hash(), volume(), area(), locate() and visible_cells() are about the cells. (A
/// LowerHull with a tolerance has the exact facets of what it keeps.)
///
/// Points within ε of a flat of fewer dimensions, spanned by few points that are far apart, have their hull
/// there. Cells are those of the projections on axes(); all points are still within ε of the vertices' hull
/// in space. Queries within ε of the flat count as in it. Not every set within ε of some hyperplane is flat
/// in this sense.
///
/// insert() chooses anew at the first question that follows, at a cost of all extreme points; insert_range()
/// at once. A tolerance larger than the extent of the points of a range, with those before it, along every
/// axis is Errc::invalid_argument, unless all points are equal.
///
/// Exact for all finite doubles. Flat input has the hull in its flat, k < d: for k = 1 two end points, each a
/// facet; for k = 0 a single point, without facets. Duplicates are merged. Worst case O(n^⌊d/2⌋) cells.
template <int D = dynamic>
class ConvexHull : public Polytope {
  static_assert(D >= 1 || D == dynamic, "the dimension of the space is at least 1");

 public:
  using Coordinates =
      std::span<const double, D == dynamic ? std::dynamic_extent : static_cast<std::size_t>(D)>;

  /// The hull of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit ConvexHull(int dimension, const Options& options = {}) requires(D == dynamic)
      : Polytope(dimension, options) {}
  explicit ConvexHull(const Options& options = {}) requires(D != dynamic) : Polytope(D, options) {}
  /// The hull of points. Throws as insert_range().
  ConvexHull(AnyPoints<> points, int dimension, const Options& options = {}) requires(D == dynamic)
      : Polytope(dimension, options) {
    insert_range(std::move(points));
  }
  explicit ConvexHull(PointsView points, const Options& options = {}) requires(D == dynamic)
      : Polytope(points.dimension(), options) {
    insert_range(points);
  }
  explicit ConvexHull(AnyPoints<D> points, const Options& options = {}) requires(D != dynamic)
      : Polytope(D, options) {
    insert_range(std::move(points));
  }
  ConvexHull(ConvexHull&&) noexcept = default;
  ConvexHull& operator=(ConvexHull&&) noexcept = default;

  /// A deep copy. Cost: that of copying the cells and the points. Throws Errc::out_of_memory.
  ConvexHull clone() const { return ConvexHull(detail::Clone{}, *this); }

  /// Inserts points as the next rows. If it throws (not_finite, bad_dimension, cancelled, too_many,
  /// out_of_memory), the hull is as it was. A point outside the affine hull of all earlier ones rebuilds it.
  void insert_range(AnyPoints<D> points) {
    points.require_dimension(dimension());
    insert_coordinates(points.coordinates());
  }
  /// Inserts the extreme ones of points, into a hull that is empty. Others may become rows, too, but all
  /// vertices of cells are extreme: where many points lie in the hyperplanes of facets, there are far fewer
  /// cells than with all points, and other ones. Returns which of the points each row is, in no particular
  /// order; of equal points it is the first. Kinds and counts are those of the rows. Cost: one or two passes
  /// over the points more than the hull of the extreme ones. Throws as above, and Errc::invalid_argument if
  /// there are rows already.
  std::vector<SignedIndex> insert_extreme_points(AnyPoints<D> points) {
    points.require_dimension(dimension());
    return insert_extreme_coordinates(points.coordinates());
  }
  /// Inserts one point as the next row; errors as above.
  HullInsertResult insert(const AnyPoint<D>& point) { return insert_point(point); }

  /// The coordinates of a row.
  Coordinates point(std::size_t row) const { return Coordinates(Polytope::point(row)); }
  Containment locate(const AnyPoint<D>& query) const { return Polytope::locate(query.coordinates()); }
  bool contains(const AnyPoint<D>& query) const { return Polytope::contains(query.coordinates()); }
  std::vector<SignedIndex> visible_cells(const AnyPoint<D>& query) const {
    return Polytope::visible_cells(query.coordinates());
  }
  std::vector<SignedIndex> visible_facets(const AnyPoint<D>& query) const {
    return Polytope::visible_facets(query.coordinates());
  }

 private:
  ConvexHull(detail::Clone clone, const ConvexHull& other) : Polytope(clone, other) {}
};

ConvexHull(int, const Options& = {})->ConvexHull<dynamic>;
ConvexHull(PointsView, const Options& = {})->ConvexHull<dynamic>;
template <class Points>
ConvexHull(Points&&, int, const Options& = {}) -> ConvexHull<dynamic>;
template <class Points>
requires(detail::dimension_of_range<Points>() > 0) ConvexHull(Points&&, const Options& = {})
->ConvexHull<detail::dimension_of_range<Points>()>;

}  // namespace delone
