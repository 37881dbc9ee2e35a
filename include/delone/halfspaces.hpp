// SPDX-License-Identifier: BSD-3-Clause
// Exact intersections of halfspaces in any dimension: vertices, rays, facets and redundant halfspaces of a
// polyhedron that is given by inequalities.
#pragma once

#include <delone/error.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace delone {

/// What the points that satisfy all inequalities are.
enum class IntersectionState : std::uint8_t {
  full,   ///< a polyhedron with interior points
  flat,   ///< some points, but none strictly inside all halfspaces: they lie in a hyperplane
  empty,  ///< none
};

/// What a row is to the intersection. Exactly one of them holds.
enum class HalfspaceKind : std::uint8_t {
  facet,  ///< its hyperplane contains a facet: the intersection would be larger without it (and without its
          ///< duplicates)
  touching,   ///< redundant; its hyperplane touches the intersection in less than a facet
  redundant,  ///< redundant; its hyperplane does not meet the intersection
  duplicate,  ///< a positive multiple of an earlier row, which has a kind of its own
  trivial,    ///< a normal of zeros and an offset ≤ 0: no condition at all
};

/// An intersection of halfspaces as plain arrays. Rows are input rows (0-based). Lists of lists are offsets
/// into one array: list i is entries offsets[i] … offsets[i+1]−1. Where state is not `full`, only the members
/// up to `witness` are filled.
///
/// k, the rank of the normals, is d unless the intersection contains lines. With k < d it is the sum of the
/// linear space of `lineality` and of a polyhedron in k of the coordinates, `axes`; vertices, directions and
/// edges are those of that polyhedron, their other coordinates 0.
struct IntersectionData {
  int dimension = 0;                                  ///< d
  int rank = 0;                                       ///< k
  IntersectionState state = IntersectionState::full;  ///< whether there are interior points
  std::vector<double> halfspaces;  ///< m×(d+1), as given: normal n and offset c of n·x + c ≤ 0
  std::vector<SignedIndex>
      first_of_halfspace;            ///< m: the first row that is the same halfspace; itself if it is trivial
  std::vector<SignedIndex> witness;  ///< flat, empty: at most d+1 rows that have no interior point in common
  std::vector<double> interior_point;   ///< d: strictly inside all halfspaces, given or found
  bool interior_point_is_exact = true;  ///< false: what is strictly inside is a point near it, see the class
  bool bounded = false;                 ///< whether the intersection is a polytope
  std::vector<int> axes;                ///< k coordinates on which the normals project one-to-one, increasing
  std::vector<double> vertices;         ///< v×d, each coordinate the double nearest to the exact one
  std::vector<SignedIndex> vertex_offsets,
      vertex_halfspaces;           ///< the rows of the facets that meet in a vertex
  std::vector<double> directions;  ///< r×d unit vectors: the extreme directions to infinity
  std::vector<SignedIndex> direction_offsets,
      direction_halfspaces;                   ///< the rows of the facets that contain a direction
  std::vector<SignedIndex> edges;             ///< e×2 vertices, increasing: the bounded edges
  std::vector<SignedIndex> rays;              ///< u×2, a vertex and a direction: the unbounded edges
  std::vector<SignedIndex> facet_halfspaces;  ///< f: the row of each facet, increasing
  /// The vertices of each facet; for k = 3 along its border, counterclockwise seen from outside when k = d,
  /// otherwise increasing.
  std::vector<SignedIndex> facet_offsets, facet_vertices;
  /// The directions of each facet; for k = 3 of the two rays, the one that leaves the last vertex first.
  std::vector<SignedIndex> facet_direction_offsets, facet_directions;
  std::vector<double> lineality;     ///< (d−k)×d unit vectors: a basis of the lines in the intersection
  std::vector<HalfspaceKind> kinds;  ///< m
  std::vector<double> dual_points;  ///< m×d: n/−(n·p + c) with p the interior point, rounded; 0 if trivial
  std::vector<double>
      dual_equations;  ///< v×(d+1): the facet dual to a vertex, unit normal and offset, rounded

  std::size_t num_halfspaces() const { return first_of_halfspace.size(); }
  std::size_t num_vertices() const { return vertex_offsets.empty() ? 0 : vertex_offsets.size() - 1; }
  std::size_t num_directions() const { return direction_offsets.empty() ? 0 : direction_offsets.size() - 1; }
  std::size_t num_edges() const { return edges.size() / 2; }
  std::size_t num_rays() const { return rays.size() / 2; }
  std::size_t num_facets() const { return facet_halfspaces.size(); }
  std::span<const double> vertex(std::size_t i) const { return row_of(vertices, i); }
  std::span<const double> direction(std::size_t i) const { return row_of(directions, i); }
  std::span<const SignedIndex> halfspaces_of_vertex(std::size_t i) const {
    return list(vertex_halfspaces, vertex_offsets, i);
  }
  std::span<const SignedIndex> halfspaces_of_direction(std::size_t i) const {
    return list(direction_halfspaces, direction_offsets, i);
  }
  std::span<const SignedIndex> facet(std::size_t i) const { return list(facet_vertices, facet_offsets, i); }
  std::span<const SignedIndex> directions_of_facet(std::size_t i) const {
    return list(facet_directions, facet_direction_offsets, i);
  }

 private:
  std::span<const double> row_of(const std::vector<double>& items, std::size_t i) const {
    const auto d = static_cast<std::size_t>(dimension);
    return std::span(items).subspan(i * d, d);
  }
  static std::span<const SignedIndex> list(const std::vector<SignedIndex>& items,
                                           const std::vector<SignedIndex>& offsets, std::size_t i) {
    return std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                    static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
  }
};

/// A polyhedron, the intersection of halfspaces n·x + c ≤ 0 of R^d: what is true of it in every dimension.
/// HalfspaceIntersection<D> makes one; functions for all dimensions take a `const Polyhedron&`.
///
/// `const` members may be called from several threads at once.
class Polyhedron {
 public:
  int dimension() const;  ///< d
  /// k, the rank of the normals; d−k is the dimension of the lineality space. 0 where state() is not full.
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
  /// A copy of data(), with the halfspaces.
  IntersectionData to_data() const;

  /// The d-volume of the convex hull of the rounded vertices; infinity if unbounded, 0 if flat or empty.
  /// Cost: that hull, which from d = 5 on may take far longer than the intersection, as rounded vertices are
  /// not in the hyperplanes of their facets.
  double volume() const;
  /// Volume and surface area of the convex hull of the rounded dual points (and of the origin, if unbounded).
  /// NaN for k < d.
  double dual_volume() const;
  double dual_area() const;

  /// The number of simplices of the dual boundary, those at infinity included.
  std::size_t num_cells() const;
  Statistics statistics() const;

 protected:
  struct Clone {};
  Polyhedron(const AnyPoints<>& halfspaces, int dimension, const Options& options);
  Polyhedron(const AnyPoints<>& halfspaces, int dimension, std::span<const double> interior_point,
             const Options& options);
  Polyhedron(Clone, const Polyhedron& other);
  Polyhedron(Polyhedron&&) noexcept;
  Polyhedron& operator=(Polyhedron&&) noexcept;
  ~Polyhedron();

  void insert_rows(const AnyPoints<>& halfspaces);

 private:
  struct Impl;
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
/// the rows or on their lengths, and is rounded only in the end: coordinates of vertices are the nearest
/// doubles, and vertices of more than k facets are found to be one.
///
/// The interior point is given, or found: by an exact linear program (the largest t with n·x + c + w·t ≤ 0
/// for all rows, w near |n|), solved by the dual simplex method in integers with Bland's rule against
/// cycling; rounding decides nothing. Where no double is strictly inside, as between two neighboring doubles,
/// the exact solution serves and is reported rounded. An intersection without interior points is a result,
/// see state() and witness().
///
/// Cost: that of the convex hull of m+1 points, one solve per vertex, a walk per redundant row.
template <int D = dynamic>
class HalfspaceIntersection : public Polyhedron {
  static_assert(D >= 1 || D == dynamic, "the dimension of the space is at least 1");

 public:
  /// The numbers of a row, as a template argument of AnyPoint and AnyPoints.
  static constexpr int row_size = D == dynamic ? dynamic : D + 1;

  /// Finds an interior point. Throws bad_dimension (dimension < 1, or a number of entries that is no multiple
  /// of d+1), not_finite (rows() names the rows), cancelled, too_many, out_of_memory.
  HalfspaceIntersection(const AnyPoints<>& halfspaces, int dimension,
                        const Options& options = {}) requires(D == dynamic)
      : Polyhedron(halfspaces, dimension, options) {}
  explicit HalfspaceIntersection(const AnyPoints<row_size>& halfspaces,
                                 const Options& options = {}) requires(D != dynamic)
      : Polyhedron(rows(halfspaces), D, options) {}
  /// With an interior point. Throws invalid_argument, rows() naming them, if it is not strictly inside all
  /// halfspaces (a trivial row asks for nothing); otherwise as above.
  HalfspaceIntersection(const AnyPoints<>& halfspaces, int dimension, const AnyPoint<>& interior_point,
                        const Options& options = {}) requires(D == dynamic)
      : Polyhedron(halfspaces, dimension, interior_point, options) {}
  HalfspaceIntersection(const AnyPoints<row_size>& halfspaces, const AnyPoint<D>& interior_point,
                        const Options& options = {}) requires(D != dynamic)
      : Polyhedron(rows(halfspaces), D, interior_point, options) {}
  HalfspaceIntersection(HalfspaceIntersection&&) noexcept = default;
  HalfspaceIntersection& operator=(HalfspaceIntersection&&) noexcept = default;

  /// A deep copy. Throws Errc::out_of_memory.
  HalfspaceIntersection clone() const { return HalfspaceIntersection(Clone{}, *this); }

  /// Adds halfspaces as the next rows. The interior point must be strictly inside them, or invalid_argument
  /// is thrown. A rank that rises rebuilds all, as does every call where there is no interior point. If it
  /// throws, nothing has changed.
  void insert_range(const AnyPoints<row_size>& halfspaces) { insert_rows(rows(halfspaces)); }
  /// Adds one halfspace; as above.
  void insert(const AnyPoint<row_size>& halfspace) { insert_rows(halfspace.coordinates()); }

 private:
  HalfspaceIntersection(Clone clone, const HalfspaceIntersection& other) : Polyhedron(clone, other) {}
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

enum class IntersectionCheckLevel : int {
  storage = 1,  ///< array sizes; rows, vertices and directions in range
  support = 2,  ///< the rows of each vertex meet in one point that satisfies all rows, and its coordinates
                ///< are that point, rounded; the same for directions; all exactly
  completeness = 3,  ///< every edge at every vertex is listed and leads to a listed vertex or direction;
                     ///< facets and kinds are right: so nothing is missing
};

struct IntersectionCheckReport {
  bool ok = false;
  IntersectionCheckLevel reached = IntersectionCheckLevel::storage;  ///< the highest level examined
  std::string violation;                                             ///< the first violation; empty when ok
  std::vector<std::size_t> vertices;                                 ///< the vertices concerned
  std::vector<std::size_t> halfspaces;                               ///< the rows concerned
};

/// Examines an intersection (with its halfspaces), level after level, stopping at the first violation, in
/// integers and independently of how it was made; `lineality` and the dual arrays, which are rounded, are not
/// looked at. The graph of a polyhedron is connected, so level 3 proves that no vertex is missing. Flat and
/// empty intersections are examined by their witness only. Cost: v·m determinants for level 2; for level 3
/// the number of (k−1)-subsets of the rows of each vertex, times their number: k where k facets meet, many in
/// very degenerate vertices.
IntersectionCheckReport check_halfspaces(const IntersectionData& data,
                                         IntersectionCheckLevel up_to = IntersectionCheckLevel::completeness);

/// Writes an intersection; the format is `format` or the extension of the path: npz, json (the arrays of
/// IntersectionData), off (k = d = 3 and bounded: vertices and facets as polygons). The file appears whole or
/// not at all; "-" is standard output (json, off). Errors: cannot_write, unsupported, out_of_memory.
void write_halfspaces(const std::string& path, const IntersectionData& data, const std::string& format = {});

/// Reads an intersection back that write_halfspaces() wrote as npz or json. The shapes of all arrays are
/// checked; check_halfspaces() examines what they hold. Errors: cannot_open; bad_format, bad_dimension,
/// not_finite naming the member.
IntersectionData read_halfspaces(const std::string& path, const std::string& format = {});

}  // namespace delone
