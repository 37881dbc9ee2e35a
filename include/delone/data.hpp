// SPDX-License-Identifier: BSD-3-Clause
// Results as plain arrays that own their memory: what files hold (io.hpp), check() examines (check.hpp) and
// to_data() of the classes returns.
//
// Rows are input rows, from 0 on. A list of lists is one array and its offsets: list i is entries
// offsets[i] … offsets[i+1]−1.
#pragma once

#include <delone/export.hpp>
#include <delone/types.hpp>

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone {

/// What data are. Files say it by name (docs/formats.md), and check() proves what it says.
enum class DataKind : std::uint8_t {
  unknown,            ///< not said: a triangulation from elsewhere, Delaunay, or regular if there are weights
  delaunay,           ///< ComplexData: a Delaunay triangulation
  regular,            ///< ComplexData: a regular triangulation
  furthest_site,      ///< ComplexData: a furthest-site Delaunay triangulation
  alpha_complex,      ///< ComplexData: the cells of an alpha complex
  alpha_boundary,     ///< ComplexData: the facets around these cells
  trimmed,            ///< ComplexData: the cells that trim() has left of a triangulation
  lower_hull,         ///< ComplexData: the cells of a lower hull
  upper_hull,         ///< ComplexData: the cells of an upper hull
  periodic_delaunay,  ///< ComplexData: the Delaunay triangulation of a periodic set
  periodic_regular,   ///< ComplexData: the regular triangulation of one
  hull_boundary,      ///< ComplexData: the cells of a convex hull, where a format holds nothing else of it
  convex_hull,        ///< HullData
  halfspace_intersection,  ///< IntersectionData
  voronoi,                 ///< VoronoiData: a Voronoi diagram
  power_diagram,           ///< VoronoiData: a power diagram
  furthest_voronoi,        ///< VoronoiData: a furthest-site Voronoi diagram
};

/// The name of a kind in files: that of the enumerator; "" for unknown.
DELONE_EXPORT std::string_view name_of(DataKind kind);
/// What data of the kind are, in a few words: "a Delaunay triangulation"; "a triangulation" for unknown.
DELONE_EXPORT std::string_view description_of(DataKind kind);
/// The kind of a name; nullopt if no kind has it.
DELONE_EXPORT std::optional<DataKind> find_data_kind(std::string_view name);

namespace detail {

/// Whether a row of points was removed: it has no vertex, and its coordinates are NaN.
inline bool is_removed(std::size_t row, std::span<const SignedIndex> vertices, std::span<const double> points,
                       int dimension) {
  if (vertices.size() <= row || vertices[row] >= 0 || points.empty()) return false;
  // On bits, as code compiled with -ffast-math takes no number for NaN.
  const auto first = std::bit_cast<std::uint64_t>(points[row * static_cast<std::size_t>(dimension)]);
  constexpr std::uint64_t without_sign = 0x7fffffffffffffff, infinity = 0x7ff0000000000000;
  return (first & without_sign) > infinity;
}

}  // namespace detail

/// A triangulation: Delaunay, regular (with weights) or furthest-site; or simplices of another kind.
///
/// Of a periodic set the members from `lattice` on mean what those of PeriodicTriangulation mean; they are
/// empty for other sets.
struct DELONE_EXPORT_TYPE ComplexData {
  int dimension = 0;               ///< d, coordinates per point
  int affine_dimension = -1;       ///< k, dimension of the affine hull of the points; −1 when there is none
  std::vector<double> points;      ///< n×d, as given
  std::vector<SignedIndex> cells;  ///< m×(k+1), point rows; positively oriented when k = d
  /// m×(k+1), neighbor i is opposite vertex i; −1 outside the hull. May be empty: unknown.
  std::vector<SignedIndex> neighbors;
  /// n, the row that each point was merged into (itself for a vertex; −1: hidden or removed). May be empty:
  /// unknown. The coordinates and the weight of a removed row are NaN.
  std::vector<SignedIndex> vertex_of_point;
  std::vector<double> weights{};            ///< n, of a regular triangulation; empty: points have no weights
  std::vector<std::string> column_names{};  ///< d, what the coordinates are called; empty: unknown
  DataKind kind = DataKind::unknown;        ///< what they are
  double tolerance = 0;  ///< of a lower or upper hull: points may be so far beyond it along the last axis
  std::vector<double> lattice{};                 ///< r×d
  std::vector<std::int32_t> cell_offsets{};      ///< m×(k+1)×r
  std::vector<std::int32_t> neighbor_offsets{};  ///< m×(k+1)×r; empty if neighbors are
  std::vector<std::int32_t> point_offsets{};     ///< n×r; may be empty: unknown
  double unit = 0;                               ///< PeriodicOptions::unit

  std::size_t num_points() const {
    return dimension < 1 ? 0 : points.size() / static_cast<std::size_t>(dimension);
  }
  /// Whether a row had been removed from the triangulation when this copy was made.
  bool is_removed(std::size_t row) const {
    return detail::is_removed(row, vertex_of_point, points, dimension);
  }
  bool is_periodic() const {
    return kind == DataKind::periodic_delaunay || kind == DataKind::periodic_regular;
  }
  /// r, the number of lattice vectors.
  std::size_t rank() const {
    return dimension < 1 ? 0 : lattice.size() / static_cast<std::size_t>(dimension);
  }
  std::size_t num_cells() const {
    return affine_dimension < 0 ? 0 : cells.size() / (static_cast<std::size_t>(affine_dimension) + 1);
  }
};

/// The role of an input row in the convex hull. Each row has exactly one.
enum class PointKind : std::uint8_t {
  extreme,    ///< a vertex of the polytope: in no segment between two other points of the hull
  boundary,   ///< on the boundary, in the relative interior of a face of dimension 1 … k−1
  interior,   ///< in the interior (of the hull within its flat)
  duplicate,  ///< equal to an earlier row, which has a kind of its own
};

/// A convex hull; k is the affine dimension.
///
/// A *cell* is a simplex of the boundary, with k vertices. A *facet* is a facet of the polytope; it consists
/// of one cell, or of several if more than k points lie in its hyperplane. Faces are given by their extreme
/// rows, increasing.
struct DELONE_EXPORT_TYPE HullData {
  static constexpr DataKind kind = DataKind::convex_hull;
  int dimension = 0;           ///< d
  int affine_dimension = -1;   ///< k
  std::vector<double> points;  ///< n×d, as given; may be empty
  /// m×k: for x inside, (x, vertices of a cell) is positively oriented on the axes, for k > 1.
  std::vector<SignedIndex> cells;
  std::vector<SignedIndex> neighbors;                      ///< m×k cells: neighbor i is across the ridge
                                                           ///< opposite vertex i
  std::vector<SignedIndex> facet_of_cell;                  ///< m, the facet each cell is part of
  std::vector<SignedIndex> facet_offsets, facet_vertices;  ///< the extreme rows of each facet
  std::vector<SignedIndex> ridge_facets;  ///< r×2, the two facets that meet in each ridge, increasing
  std::vector<SignedIndex> ridge_offsets, ridge_vertices;  ///< the extreme rows of each ridge
  std::vector<double> equations;             ///< f×(d+1): unit outward normal, offset; ≤ 0 inside
  std::vector<double> equation_errors;       ///< f; see data() of the convex hull
  std::vector<SignedIndex> vertices;         ///< the extreme rows, increasing
  std::vector<SignedIndex> vertex_of_point;  ///< n, the first row that is equal to each row
  std::vector<PointKind> point_kinds;        ///< n
  std::vector<int> axes;    ///< k coordinates on which the flat projects one-to-one, increasing
  double tolerance = 0;     ///< 0: the hull is exact, otherwise see ConvexHullBase::tolerance()
  double max_distance = 0;  ///< no point is farther outside of the hull than this
  /// d, see ConvexHullBase::axis_tolerances(); empty if all are `tolerance`
  std::vector<double> axis_tolerances{};
  std::vector<std::string> column_names{};  ///< d, what the coordinates are called; empty: unknown

  std::size_t num_points() const { return vertex_of_point.size(); }
  std::size_t num_cells() const {
    return affine_dimension < 1 ? 0 : cells.size() / static_cast<std::size_t>(affine_dimension);
  }
  std::size_t num_facets() const { return facet_offsets.empty() ? 0 : facet_offsets.size() - 1; }
  std::size_t num_ridges() const { return ridge_facets.size() / 2; }
};

/// What the points that satisfy all inequalities form.
enum class IntersectionState : std::uint8_t {
  full,   ///< a polyhedron with interior points
  flat,   ///< some points, but none strictly inside all halfspaces: they lie in a hyperplane
  empty,  ///< none
};

/// The role of a row in the intersection. Each row has exactly one.
enum class HalfspaceKind : std::uint8_t {
  /// Its hyperplane contains a facet: the intersection would be larger without it (and its duplicates).
  facet,
  touching,   ///< redundant; its hyperplane touches the intersection in less than a facet
  redundant,  ///< redundant; its hyperplane does not meet the intersection
  duplicate,  ///< a positive multiple of an earlier row, which has a kind of its own
  trivial,    ///< a normal of zeros and an offset ≤ 0: no condition at all
};

/// An intersection of halfspaces. If the state is not `full`, only the members up to `witness` are filled.
///
/// k, the rank of the normals, is d unless the intersection contains lines. With k < d it is the sum of the
/// linear space of `lineality` and of a polyhedron in k of the coordinates, `axes`; vertices, directions and
/// edges are those of that polyhedron, their other coordinates 0.
struct DELONE_EXPORT_TYPE IntersectionData {
  static constexpr DataKind kind = DataKind::halfspace_intersection;
  int dimension = 0;                                  ///< d
  int rank = 0;                                       ///< k
  IntersectionState state = IntersectionState::full;  ///< whether there are interior points
  std::vector<double> halfspaces;  ///< m×(d+1), as given: normal n and offset c of n·x + c ≤ 0
  /// m: the first row that is the same halfspace; itself if it is trivial.
  std::vector<SignedIndex> first_of_halfspace;
  std::vector<SignedIndex> witness;  ///< flat, empty: at most d+1 rows that have no interior point in common
  std::vector<double> interior_point;   ///< d: strictly inside all halfspaces, given or found
  bool interior_point_is_exact = true;  ///< false: what is strictly inside is a point near it, see the class
  bool bounded = false;                 ///< whether the intersection is a polytope
  std::vector<int> axes;                ///< k coordinates on which the normals project one-to-one, increasing
  std::vector<double> vertices;         ///< v×d, each coordinate the double nearest to the exact one
  /// The rows of the facets that meet in each vertex.
  std::vector<SignedIndex> vertex_offsets, vertex_halfspaces;
  std::vector<double> directions;  ///< r×d unit vectors: the extreme directions to infinity
  /// The rows of the facets that contain each direction.
  std::vector<SignedIndex> direction_offsets, direction_halfspaces;
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
  std::vector<double> dual_equations;  ///< v×(d+1): the facet dual to a vertex, unit normal, offset, rounded

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

/// A Voronoi diagram, a power diagram (with weights) or a diagram of furthest sites. Members mean what
/// members of the same name of Diagram mean.
struct DELONE_EXPORT_TYPE VoronoiData {
  int dimension = 1, affine_dimension = -1;  ///< d and k
  std::vector<double> points;   ///< n×d, hidden points included; NaN for rows that were not inserted
  std::vector<double> weights;  ///< n, of a power diagram only
  std::vector<double> vertices;
  std::vector<SignedIndex> ridge_points, ridge_vertices, region_vertices, point_region;
  std::vector<std::int64_t> ridge_offsets{0}, region_offsets{0};
  std::vector<SignedIndex> ray_vertices, ray_points;
  std::vector<double> ray_directions;
  double tolerance = 0;                     ///< what the diagram was made with
  std::vector<double> axis_tolerances{};    ///< d, see Diagram; empty if all are `tolerance`
  std::vector<std::string> column_names{};  ///< d, what the coordinates are called; empty: unknown
  DataKind kind = DataKind::unknown;        ///< what they are; unknown: a power diagram if there are weights

  std::size_t num_points() const { return point_region.size(); }
  /// Whether a row of the points was removed from the triangulation: its coordinates are NaN.
  bool is_removed(std::size_t row) const { return detail::is_removed(row, point_region, points, dimension); }
  std::size_t num_vertices() const {
    return dimension < 1 ? 0 : vertices.size() / static_cast<std::size_t>(dimension);
  }
  std::size_t num_ridges() const { return ridge_offsets.empty() ? 0 : ridge_offsets.size() - 1; }
  std::size_t num_regions() const { return region_offsets.empty() ? 0 : region_offsets.size() - 1; }
  std::size_t num_rays() const { return ray_vertices.size(); }
};

/// The four kinds of results.
template <class Data>
concept PlainData = std::same_as<Data, ComplexData> || std::same_as<Data, HullData> ||
    std::same_as<Data, IntersectionData> || std::same_as<Data, VoronoiData>;

/// The closed box low[j] ≤ x[j] ≤ high[j] in R^d.
struct Box {
  std::vector<double> low, high;
};

}  // namespace delone
