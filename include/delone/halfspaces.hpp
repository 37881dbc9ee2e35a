// SPDX-License-Identifier: BSD-3-Clause
// Exact intersections of halfspaces in any dimension: vertices, rays, facets and redundant halfspaces of a
// polyhedron that is given by inequalities.
#pragma once

#include <delone/data.hpp>
#include <delone/error.hpp>
#include <delone/export.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace delone {

/// The vertices of an intersection of halfspaces, as the same members of IntersectionData.
struct DELONE_EXPORT_TYPE IntersectionVertices {
  bool bounded = false;
  std::vector<double> vertices;
  std::vector<SignedIndex> vertex_offsets, vertex_halfspaces;

  std::size_t num_vertices() const { return vertex_offsets.empty() ? 0 : vertex_offsets.size() - 1; }
};

/// A polyhedron, the intersection of halfspaces n·x + c ≤ 0 of R^d: what is true of it in every dimension.
/// Make a HalfspaceIntersection<D>; functions for all dimensions take a `const HalfspaceIntersectionBase&`.
///
/// `const` members may be called from several threads at once. What is computed on first use throws
/// Errc::out_of_memory if there is not enough memory.
class DELONE_EXPORT HalfspaceIntersectionBase {
 public:
  int dimension() const;  ///< d
  /// k, the rank of the normals; d−k is the dimension of the lineality space. 0 if state() is not full.
  int rank() const;
  std::size_t num_halfspaces() const;
  IntersectionState state() const;
  /// Flat and empty intersections: at most d+1 rows whose halfspaces have no interior point in common;
  /// increasing.
  std::span<const SignedIndex> witness() const { return data().witness; }
  std::span<const double> interior_point() const { return data().interior_point; }
  bool is_bounded() const { return data().bounded; }
  std::size_t num_vertices() const { return data().num_vertices(); }
  std::size_t num_facets() const { return data().num_facets(); }
  std::size_t count(HalfspaceKind kind) const;  ///< rows of that kind

  /// The arrays, without `halfspaces`; computed on first use after a change, valid until the next one.
  const IntersectionData& data() const;
  /// The same arrays, valid while the pointer is kept; no later change of this object changes them.
  std::shared_ptr<const IntersectionData> shared_data() const;
  /// Some of these arrays, made anew at each call. Costs less than the first call of data().
  IntersectionVertices to_vertices() const;
  /// A copy of data(), with the halfspaces.
  IntersectionData to_data() const;

  /// The d-volume of the convex hull of the rounded vertices; infinity if unbounded, 0 if flat or empty. The
  /// error is that of the sum, as for ConvexHullBase::volume(); rounding the vertices has its own. Cost: that
  /// of this hull, which from d = 5 on may take far longer than the intersection because rounded vertices do
  /// not lie in the hyperplanes of their facets.
  Measure volume() const;
  /// Volume and surface area of the convex hull of the rounded dual points (and of the origin, if unbounded).
  /// NaN for k < d.
  Measure dual_volume() const;
  Measure dual_area() const;

  /// The number of simplices of the dual boundary, those at infinity included. O(1).
  std::size_t num_cells() const;
  Statistics statistics() const;

 protected:
  HalfspaceIntersectionBase(const AnyPoints<>& halfspaces, int dimension, const Options& options);
  HalfspaceIntersectionBase(const AnyPoints<>& halfspaces, int dimension,
                            std::span<const double> interior_point, const Options& options);
  HalfspaceIntersectionBase(detail::Clone, const HalfspaceIntersectionBase& other);
  HalfspaceIntersectionBase(HalfspaceIntersectionBase&&) noexcept;
  HalfspaceIntersectionBase& operator=(HalfspaceIntersectionBase&&) noexcept;
  ~HalfspaceIntersectionBase();

  void insert_rows(const AnyPoints<>& halfspaces);
  /// The volume, up to rounding, of a bounded intersection from its faces; 0 if flat or empty. Not changed by
  /// vertices of more than d facets, and far faster than volume(), but without a bound of the error.
  double volume_of_faces() const;

 private:
  struct DELONE_HIDDEN Impl;
  std::unique_ptr<Impl> impl_;
};

/// The intersection of halfspaces n·x + c ≤ 0 of R^D, given as rows (n, c) of D+1 doubles; of R^d, d chosen
/// at run time, if D is dynamic.
///
/// Method: a row is dual to a point, n/−(n·p + c) for an interior point p; facets of the convex hull of these
/// points and of the origin are dual to the vertices, those that contain the origin to directions to infinity
/// (Preparata and Muller 1979, doi:10.1016/0304-3975(79)90055-0). Dual points are not representable, but
/// every decision is the sign of a determinant of the rows as they were given, whatever p is
/// (docs/predicates.md). So the result is exact for all finite doubles, does not depend on p, on the order of
/// the rows or on their lengths, and is rounded only at the end: coordinates of vertices are the nearest
/// doubles, and vertices of more than k facets are found to be one.
///
/// The interior point is given, or found: by an exact linear program (the largest t with n·x + c + w·t ≤ 0
/// for all rows, w near |n|), solved by the dual simplex method in integers with Bland's rule against
/// cycling; rounding decides nothing. If no double is strictly inside, as between two neighboring doubles,
/// the exact solution is used and reported rounded. An intersection without interior points is a result, see
/// state() and witness(); to_polyhedron() (polyhedron.hpp) has the vertices and rays of a flat one.
///
/// Cost: that of the convex hull of m+1 points, one solve per vertex, a walk per redundant row.
template <int D = dynamic>
class HalfspaceIntersection : public HalfspaceIntersectionBase {
  static_assert(D >= 1 || D == dynamic, "the dimension of the space is at least 1");

 public:
  /// The numbers of a row, as a template argument of AnyPoint and AnyPoints.
  static constexpr int row_size = D == dynamic ? dynamic : D + 1;

  /// Finds an interior point. Throws Errc::bad_dimension (dimension < 1, or a number of entries that is not a
  /// multiple of d+1), not_finite (rows() names the rows), cancelled, too_many, out_of_memory, time_limit,
  /// and invalid_argument for a tolerance.
  HalfspaceIntersection(const AnyPoints<>& halfspaces, int dimension,
                        const Options& options = {}) requires(D == dynamic)
      : HalfspaceIntersectionBase(halfspaces, dimension, options) {}
  explicit HalfspaceIntersection(const AnyPoints<row_size>& halfspaces,
                                 const Options& options = {}) requires(D != dynamic)
      : HalfspaceIntersectionBase(rows(halfspaces), D, options) {}
  /// Takes an interior point of d numbers. Throws Errc::invalid_argument if it is not strictly inside all
  /// halfspaces (a trivial row requires nothing), and rows() names those that it violates; otherwise as
  /// above.
  HalfspaceIntersection(const AnyPoints<>& halfspaces, int dimension, const AnyPoint<>& interior_point,
                        const Options& options = {}) requires(D == dynamic)
      : HalfspaceIntersectionBase(halfspaces, dimension, interior_point, options) {}
  HalfspaceIntersection(const AnyPoints<row_size>& halfspaces, const AnyPoint<D>& interior_point,
                        const Options& options = {}) requires(D != dynamic)
      : HalfspaceIntersectionBase(rows(halfspaces), D, interior_point, options) {}
  HalfspaceIntersection(HalfspaceIntersection&&) noexcept = default;
  HalfspaceIntersection& operator=(HalfspaceIntersection&&) noexcept = default;

  /// A deep copy. Throws Errc::out_of_memory.
  HalfspaceIntersection clone() const { return HalfspaceIntersection(detail::Clone{}, *this); }

  /// Adds halfspaces as the next rows: all or none. Everything is rebuilt if the rank rises, and by every
  /// call if there is no interior point. Throws Errc::invalid_argument unless the interior point is strictly
  /// inside the new halfspaces, otherwise as the constructors; the intersection is then unchanged.
  void insert_range(const AnyPoints<row_size>& halfspaces) { insert_rows(rows(halfspaces)); }
  /// Adds one halfspace. Cost and errors as for insert_range().
  void insert(const AnyPoint<row_size>& halfspace) { insert_rows(halfspace.coordinates()); }

 private:
  HalfspaceIntersection(detail::Clone clone, const HalfspaceIntersection& other)
      : HalfspaceIntersectionBase(clone, other) {}
  static const AnyPoints<>& rows(const AnyPoints<>& halfspaces) requires(D == dynamic) { return halfspaces; }
  static AnyPoints<> rows(const AnyPoints<row_size>& halfspaces) requires(D != dynamic) {
    return halfspaces.coordinates();
  }
};

template <class Rows, class... Arguments>
HalfspaceIntersection(Rows&&, int, Arguments&&...) -> HalfspaceIntersection<dynamic>;
template <class Rows>
requires(detail::dimension_of_range<Rows>() > 1) HalfspaceIntersection(Rows&&, const Options& = {})
->HalfspaceIntersection<detail::dimension_of_range<Rows>() - 1>;
template <class Rows>
requires(detail::dimension_of_range<Rows>() > 1)
    HalfspaceIntersection(Rows&&, const AnyPoint<detail::dimension_of_range<Rows>() - 1>&,
                          const Options& = {})
->HalfspaceIntersection<detail::dimension_of_range<Rows>() - 1>;

}  // namespace delone
