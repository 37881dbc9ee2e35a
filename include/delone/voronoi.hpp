// SPDX-License-Identifier: BSD-3-Clause
// Voronoi and power diagrams, of nearest and of furthest sites: the dual of a Delaunay, regular or
// furthest-site triangulation as arrays, volumes of regions, clipping to a box.
#pragma once

#include <delone/data.hpp>
#include <delone/delaunay.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/furthest_site.hpp>
#include <delone/points.hpp>
#include <delone/regular.hpp>
#include <delone/types.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delone {

namespace voronoi {
class DiagramSimplifier;
class VoronoiBuilder;
}  // namespace voronoi

namespace detail {

/// What a product refuses to be made from: all types but what it is the dual of and itself.
template <class T, class Dual, class Product>
concept OtherThan = !std::derived_from<T, Dual> && !std::same_as<T, Product>;

}  // namespace detail

/// A region clipped to a box, as geometry: d ≤ 3.
struct ClippedRegion {
  std::vector<double> corners;  ///< m×d
  /// d = 3: the corners of each face, counterclockwise seen from outside. d = 2: one face, the polygon,
  /// counterclockwise. d = 1: one face, the two ends. Empty if region and box have no interior in common.
  std::vector<std::vector<Index>> faces;
  bool empty() const { return faces.empty(); }
};

/// All regions clipped to a convex polytope, as arrays: d = 2 or 3. A vertex is one entry of `vertices` in
/// whatever regions it belongs to, so regions that share a face have the same vertices there. Lists of lists
/// are offsets into one array, as in Diagram.
struct DELONE_EXPORT_TYPE ClippedRegions {
  int dimension = 2;             ///< d
  std::vector<double> vertices;  ///< v×d
  /// The vertices of each face, counterclockwise seen from outside its region. d = 2: a region has one face,
  /// the polygon, counterclockwise.
  std::vector<SignedIndex> face_vertices;
  std::vector<std::int64_t> face_offsets{0};
  std::vector<std::int64_t> region_offsets{0};  ///< of the faces of each region; none if it has no interior
  /// The region on the other side of each face; for d = 2 of each edge, from an entry of face_vertices to the
  /// next one of its face. −1 on the boundary of the polytope.
  std::vector<SignedIndex> neighbors;

  std::size_t num_vertices() const { return vertices.size() / static_cast<std::size_t>(dimension); }
  std::size_t num_faces() const { return face_offsets.size() - 1; }
  std::size_t num_regions() const { return region_offsets.size() - 1; }
};

/// The parts of a diagram to make.
enum class DiagramParts {
  regions,  ///< vertices, regions, rays: the smaller part of the work. Without ridges there are no volumes
            ///< and no clipping
  all,
};

/// What a diagram has.
struct DiagramOptions {
  DiagramParts parts = DiagramParts::all;
  /// ε ≥ 0, a distance: smaller details are left out of the diagram, see Diagram. 0: the exact diagram.
  double tolerance = 0;
  /// A tolerance for each axis, in place of `tolerance`; see Diagram.
  std::vector<double> axis_tolerances = {};
};

/// A diagram of sites in R^d: for each site (distinct point) the region of the points of the flat that are
/// not nearer to, or of no smaller power with respect to, any other site. This is its interface for every
/// dimension: make a Voronoi<D>, a PowerDiagram<D> or, with regions of the points that are not further from
/// any other site, a FurthestVoronoi<D>; functions for all dimensions take a `const Diagram&`. Owns its data:
/// the triangulation may change or be destroyed afterwards.
///
/// Points that span only a k-flat have their diagram inside the flat: vertices, rays and volumes are those of
/// R^k, in d coordinates. One point (k = 0) has one region, everything, without vertices; no point (k = −1)
/// has none.
///
/// *Vertices* are the distinct centres of the spheres of the finite cells. Whether two cells have one sphere
/// is decided exactly, so a cospherical set of points makes one vertex. Each coordinate is the double nearest
/// to the exact one (ties to even; ±infinity beyond the range of doubles), and thus does not depend on how
/// ties of the triangulation were decided. *Regions* are in the order of the sites' first input rows: without
/// duplicates and hidden points region i is that of point i. *Ridges* are the facets between two regions, of
/// dimension k−1 exactly: two regions that only touch in less have none. −1 stands for infinity in lists of
/// vertices. The arrays are those of `scipy.spatial.Voronoi`, lists of lists as offsets into one array: list
/// i is entries offsets[i] … offsets[i+1]−1.
///
/// *Tolerance.* Rounded coordinates make slivers, which cause vertices and ridges that the unrounded points
/// do not have. With a tolerance ε > 0 the exact diagram is made first and then simplified, in a canonical
/// order:
/// - Vertices become one, a *representative* among them, if each is within ε of it and edges no longer than
///   2ε connect them (k > 3: common ridges). Representatives are those of most ridges, ties by coordinates.
///   So there are no chains: no vertex moves further than ε.
/// - Bounded ridges of *width* at most ε, before or after that, are gone, and those left with fewer than k
///   vertices. The width of a ridge is its length for k = 2, otherwise the least distance within which all
///   its vertices are from one of its facets (of its edges' lines for k = 3). It has none for k = 1.
/// - k = 3: a vertex that lost a ridge, and is now within ε of a straight edge in every ridge that has it, is
///   taken out of them, with all others between the same ends.
/// - Vertices in no ridge any more are gone. Regions list the vertices of their ridges; a region whose
///   ridges are all gone keeps its site and lists none. Unbounded ridges stay, unless their rays become one:
///   rays of one vertex across hull facets that lie in one hyperplane exactly.
/// All distances are certified: upper bounds, rounding included, are compared with ε. Details that are not
/// proved to be within ε stay, as do vertices with infinite coordinates. Two vertices next to each other in a
/// region (k = 2) or ridge (k = 3) may have lost the ridge between them if merging them would have moved a
/// vertex too far. Volumes and clipped regions are those of the exact regions, so volumes add up as before.
///
/// With DiagramOptions::axis_tolerances each axis has a tolerance t_j of its own. Axes are first multiplied
/// by powers of two, at least 1, for which the tolerances agree but for a factor below 2, and are lowered to
/// the least of them, ε. All distances above are those after that, so no vertex moves further along axis j
/// than t_j.
///
/// Functions that take the number of a vertex, ridge or region REQUIRE that there is one; a hardened build
/// (DELONE_HARDENED) checks this and throws Errc::invalid_argument.
///
/// Cost: one solve of k equations per cell, and the size of the output; a tolerance adds a pass over the
/// ridges, and keeps the exact diagram in memory if it changed anything. Constructors throw
/// Errc::invalid_argument (a tolerance that is negative or not finite, or larger than the longest side of the
/// bounding box of two sites or more; tolerances of axes that are not d numbers, all 0 or none), cancelled,
/// out_of_memory. Arrays and volumes do not depend on the number of threads, to the last bit.
class DELONE_EXPORT Diagram {
 public:
  DataKind kind() const { return kind_; }                     ///< voronoi, power_diagram, furthest_voronoi
  int dimension() const { return dimension_; }                ///< d
  int affine_dimension() const { return affine_dimension_; }  ///< k
  std::size_t num_points() const { return point_region_.size(); }
  std::size_t num_vertices() const { return vertices_.size() / ambient(); }
  std::size_t num_regions() const { return region_points_.size(); }
  std::size_t num_unbounded_regions() const;
  std::size_t num_ridges() const { return ridge_points_.size() / 2; }
  std::size_t num_rays() const { return ray_vertices_.size(); }

  /// num_vertices()×d coordinates.
  std::span<const double> vertices() const { return vertices_; }
  std::span<const double> vertex(std::size_t i) const {
    require(i < num_vertices(), "the number of a vertex");
    return std::span(vertices_).subspan(i * ambient(), ambient());
  }

  /// Whether the diagram has ridges: DiagramParts::all. Volumes, clipping and files need them and otherwise
  /// throw Errc::invalid_argument.
  bool has_ridges() const { return has_ridges_; }
  /// num_ridges()×2 input rows: the two sites of each ridge. Their bisector contains the ridge.
  std::span<const SignedIndex> ridge_points() const { return ridge_points_; }
  /// The vertices of a ridge; −1 first if it is unbounded. In cyclic order for k = 3, counterclockwise about
  /// the direction from ridge_points[2i] to ridge_points[2i+1] when k = d; increasing for k > 3. One vertex
  /// for k = 1, two entries for k = 2.
  std::span<const SignedIndex> ridge(std::size_t i) const {
    require(i < num_ridges(), "the number of a ridge");
    return list(ridge_vertices_, ridge_offsets_, i);
  }
  std::span<const SignedIndex> ridge_vertices() const { return ridge_vertices_; }
  std::span<const std::int64_t> ridge_offsets() const { return ridge_offsets_; }

  /// The vertices of a region; −1 first if it is unbounded. In cyclic order for k = 2 (counterclockwise when
  /// k = d), otherwise increasing.
  std::span<const SignedIndex> region(std::size_t i) const {
    require(i < num_regions(), "the number of a region");
    return list(region_vertices_, region_offsets_, i);
  }
  std::span<const SignedIndex> region_vertices() const { return region_vertices_; }
  std::span<const std::int64_t> region_offsets() const { return region_offsets_; }
  bool is_bounded(std::size_t region) const {
    require(region < num_regions(), "the number of a region");
    return bounded_[region] != 0;
  }
  /// The first input row at the site of each region, increasing.
  std::span<const SignedIndex> region_points() const { return region_points_; }
  /// The region of each input row; −1 for a hidden point.
  std::span<const SignedIndex> point_region() const { return point_region_; }
  /// The d coordinates of the site of a region, and its weight (0 in a Voronoi diagram).
  std::span<const double> site(std::size_t region) const {
    require(region < num_regions(), "the number of a region");
    return std::span(sites_).subspan(region * ambient(), ambient());
  }
  double weight(std::size_t region) const {
    require(region < num_regions(), "the number of a region");
    return weights_.empty() ? 0 : weights_[region];
  }

  /// ε, the tolerance it was made with; the largest that is used if axes have their own.
  double tolerance() const { return tolerance_; }
  /// The tolerances of the axes that are used; empty if all are tolerance().
  std::span<const double> axis_tolerances() const { return axis_tolerances_; }
  /// A bound, rounded up, on the distance of an exact vertex from the one that replaced it, and of a vertex
  /// removed from straight edges from these edges; at most ε. 0 if nothing was merged. Axes are scaled as
  /// said above.
  double max_displacement() const { return max_displacement_; }

  /// A plain copy, with the points of all input rows: the data of files. Throws Errc::invalid_argument
  /// without ridges.
  VoronoiData to_data() const;

  /// The unbounded edges, one for each facet of the convex hull (hull facets in one hyperplane whose cells
  /// have one sphere share theirs): the vertex each starts from, its direction (num_rays()×d unit vectors in
  /// the flat, rounded: outward, of furthest sites inward), and the k sites of a hull facet it is equally
  /// near to (num_rays()×k input rows).
  std::span<const SignedIndex> ray_vertices() const { return ray_vertices_; }
  std::span<const double> ray_directions() const { return ray_directions_; }
  std::span<const SignedIndex> ray_points() const { return ray_points_; }

  /// The (k−1)-volume of each ridge: a length for k = 2, an area for k = 3, 1 for k = 1; infinity for
  /// unbounded ridges and those with a vertex beyond the range of double precision. Combinatorics are exact;
  /// sums are in binary64, relative error about 10⁻¹⁵ times the shape's condition. Cost: O(output) for k ≤ 3;
  /// beyond, at most (k−1)! simplices per cell and ridge.
  std::vector<double> ridge_volumes(const Execution& how = {}) const;
  /// The k-volume of each region; infinity for unbounded regions, and for k = 0. Volumes are as accurate as
  /// those of site_cells(), wherever the sites are. For furthest sites, and for k > 12, they are sums over
  /// ridges. Cost: that of site_cells().
  std::vector<double> region_volumes(const Execution& how = {}) const;
  /// The d-volume of each region within a box: always of dimension d, regions of flat input being those of
  /// R^d, prisms over the ones in the flat. The volumes add up to that of the box up to rounding. The
  /// combinatorics of every cut are exact. Cost: regions that lie inside the box as region_volumes(); others
  /// one by one, 2^d corners and more. Throws Errc::invalid_argument (no ridges, or a box not of d finite
  /// numbers low < high), unsupported (d > 12), out_of_memory.
  std::vector<double> region_volumes(const Box& box, const Execution& how = {}) const;
  /// Calls `visit` with each region clipped to the box, in order. Throws as region_volumes(box);
  /// Errc::unsupported for d > 3.
  void for_each_clipped_region(const Box& box,
                               const std::function<void(std::size_t region, const ClippedRegion&)>& visit,
                               const Execution& how = {}) const;
  /// The regions clipped to the box and to halfspaces a·x + c ≤ 0, rows of d + 1 numbers a, c. Unbounded
  /// regions are no special case.
  ///
  /// Combinatorics are exact: vertices, edges and faces are those of the exact regions, degenerate ones
  /// included, each region is closed, and they fill the polytope without gaps or overlaps. Each coordinate of
  /// a vertex is the double nearest to the exact one; different vertices may be rounded to the same numbers.
  /// Faces need not be plane to the last digit. Does not depend on the threads. Throws as
  /// region_volumes(box); Errc::unsupported for d = 1 and d > 3, invalid_argument if there are not d + 1
  /// finite numbers in each row or a = 0, too_many. Cost: about that of the volumes of regions that the box
  /// cuts, an exact solution for each vertex, and while it works some hundred bytes for each.
  ClippedRegions clipped_regions(const Box& box, std::span<const double> halfspaces = {},
                                 const Execution& how = {}) const;
  /// The bounding box of the sites, enlarged on each side by `margin` times its longest side (1 if that is
  /// 0). Throws Errc::invalid_argument unless the margin is a number ≥ 0.
  Box bounding_box(double margin = 0.1) const;

 protected:
  /// `weight`: the weight of each vertex; empty if points have no weights.
  Diagram(const Triangulation& triangulation, const std::function<double(VertexId)>& weight,
          const DiagramOptions& options, const Execution& how);
  Diagram(detail::Clone, const Diagram& other);
  Diagram(Diagram&&) noexcept = default;
  Diagram& operator=(Diagram&&) noexcept = default;
  ~Diagram() = default;

 private:
  friend class voronoi::VoronoiBuilder;
  friend class voronoi::DiagramSimplifier;
  Diagram(const Diagram&) = default;
  std::size_t ambient() const { return static_cast<std::size_t>(dimension_); }
  static void require([[maybe_unused]] bool is_in_range, [[maybe_unused]] const char* what) {
    if (DELONE_HARDENED && !is_in_range) detail::throw_out_of_range(what);
  }
  static std::span<const SignedIndex> list(const std::vector<SignedIndex>& items,
                                           const std::vector<std::int64_t>& offsets, std::size_t i) {
    return std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                    static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
  }
  double ridge_volume(std::size_t ridge, const std::vector<std::vector<Index>>& cells_of_region) const;
  std::vector<std::vector<Index>> cells_of_regions() const;
  std::vector<double> volumes_of(const std::vector<unsigned char>& wanted, unsigned threads) const;
  double bisector_distance(std::size_t from, std::size_t to) const;
  void require_ridges() const;
  void simplify();
  void check_box(const Box& box) const;
  bool is_inside(std::size_t region, const Box& box) const;

  int dimension_ = 1, affine_dimension_ = -1;
  DataKind kind_ = DataKind::voronoi;
  bool has_ridges_ = true;
  std::vector<double> sites_, weights_;  // by region
  std::vector<double>
      hidden_;  // d coordinates and the weight of each row without a region, NaN if not inserted
  std::vector<double> vertices_;
  std::vector<SignedIndex> ridge_points_, ridge_vertices_, region_vertices_, region_points_, point_region_;
  std::vector<std::int64_t> ridge_offsets_{0}, region_offsets_{0};
  std::vector<unsigned char> bounded_;  // by region
  std::vector<SignedIndex> ray_vertices_, ray_points_;
  std::vector<double> ray_directions_;
  // With ridges: the k+1 regions of every finite cell, from which volumes are computed; for k > 3 also its
  // vertex, for volumes of ridges.
  std::vector<SignedIndex> cell_regions_, cell_vertex_;
  double tolerance_ = 0, max_displacement_ = 0;
  std::vector<double> axis_tolerances_;
  // The diagram before it was simplified, and the number there of each ridge; null if nothing changed.
  std::shared_ptr<const Diagram> exact_;
  std::vector<Index> ridge_of_exact_;
};

/// The Voronoi diagram of points of R^D: for each site the region of the points of the flat that are not
/// nearer to any other site. The dual of their Delaunay triangulation.
template <int D = dynamic>
class Voronoi : public Diagram {
 public:
  /// Throws as described for Diagram.
  explicit Voronoi(const Delaunay<D>& triangulation, const DiagramOptions& options = {},
                   const Execution& how = {})
      : Diagram(triangulation, {}, options, how) {}
  /// Does not compile for other triangulations, whose dual is another diagram, or for a `Triangulation`,
  /// which may be any.
  template <detail::OtherThan<Delaunay<D>, Voronoi<D>> Other>
  explicit Voronoi(const Other&, const DiagramOptions& = {}, const Execution& = {})
      : Voronoi(refused<Other>()) {}
  Voronoi(Voronoi&&) noexcept = default;
  Voronoi& operator=(Voronoi&&) noexcept = default;

  /// A deep copy. Throws Errc::out_of_memory.
  Voronoi clone() const { return Voronoi(detail::Clone{}, *this); }

  detail::Coordinates<D> vertex(std::size_t i) const { return detail::Coordinates<D>(Diagram::vertex(i)); }
  detail::Coordinates<D> site(std::size_t region) const {
    return detail::Coordinates<D>(Diagram::site(region));
  }

 private:
  Voronoi(detail::Clone clone, const Voronoi& other) : Diagram(clone, other) {}
  template <class Other>
  static const Delaunay<D>& refused() {
    static_assert(
        detail::always_false<Other>,
        "a Voronoi diagram is made from a delone::Delaunay triangulation of the same D; the dual of a "
        "delone::Regular one is a delone::PowerDiagram, of a delone::FurthestSite one a "
        "delone::FurthestVoronoi diagram");
  }
};

template <int D>
Voronoi(const Delaunay<D>&, const DiagramOptions& = {}, const Execution& = {}) -> Voronoi<D>;

/// The power diagram of weighted points of R^D: as the Voronoi diagram, with the power |x − p|² − weight in
/// place of the squared distance, and the centres of power spheres as vertices. Hidden points have no region;
/// a region need not contain its site. The dual of the regular triangulation.
template <int D = dynamic>
class PowerDiagram : public Diagram {
 public:
  /// Throws as described for Diagram.
  explicit PowerDiagram(const Regular<D>& triangulation, const DiagramOptions& options = {},
                        const Execution& how = {})
      : Diagram(
            triangulation, [&triangulation](VertexId v) { return triangulation.weight(v); }, options, how) {}
  /// Does not compile for other triangulations.
  template <detail::OtherThan<Regular<D>, PowerDiagram<D>> Other>
  explicit PowerDiagram(const Other&, const DiagramOptions& = {}, const Execution& = {})
      : PowerDiagram(refused<Other>()) {}
  PowerDiagram(PowerDiagram&&) noexcept = default;
  PowerDiagram& operator=(PowerDiagram&&) noexcept = default;

  /// A deep copy. Throws Errc::out_of_memory.
  PowerDiagram clone() const { return PowerDiagram(detail::Clone{}, *this); }

  detail::Coordinates<D> vertex(std::size_t i) const { return detail::Coordinates<D>(Diagram::vertex(i)); }
  detail::Coordinates<D> site(std::size_t region) const {
    return detail::Coordinates<D>(Diagram::site(region));
  }

 private:
  PowerDiagram(detail::Clone clone, const PowerDiagram& other) : Diagram(clone, other) {}
  template <class Other>
  static const Regular<D>& refused() {
    static_assert(detail::always_false<Other>,
                  "a power diagram is made from a delone::Regular triangulation of the same D; the dual of a "
                  "delone::Delaunay one is a delone::Voronoi diagram");
  }
};

template <int D>
PowerDiagram(const Regular<D>&, const DiagramOptions& = {}, const Execution& = {}) -> PowerDiagram<D>;

/// The diagram of furthest sites of points of R^D: for each extreme point the region of the points of the
/// flat that are not further from any other. All regions are unbounded, and a region does not contain its
/// site; the other points are hidden, and have none. The dual of the furthest-site triangulation.
template <int D = dynamic>
class FurthestVoronoi : public Diagram {
 public:
  explicit FurthestVoronoi(const FurthestSite<D>& triangulation, const DiagramOptions& options = {},
                           const Execution& how = {})
      : Diagram(triangulation, {}, options, how) {}
  /// Other triangulations have another dual.
  template <detail::OtherThan<FurthestSite<D>, FurthestVoronoi<D>> Other>
  explicit FurthestVoronoi(const Other&, const DiagramOptions& = {}, const Execution& = {})
      : FurthestVoronoi(refused<Other>()) {}
  FurthestVoronoi(FurthestVoronoi&&) noexcept = default;
  FurthestVoronoi& operator=(FurthestVoronoi&&) noexcept = default;

  /// A deep copy. Throws Errc::out_of_memory.
  FurthestVoronoi clone() const { return FurthestVoronoi(detail::Clone{}, *this); }

  detail::Coordinates<D> vertex(std::size_t i) const { return detail::Coordinates<D>(Diagram::vertex(i)); }
  detail::Coordinates<D> site(std::size_t region) const {
    return detail::Coordinates<D>(Diagram::site(region));
  }

 private:
  FurthestVoronoi(detail::Clone clone, const FurthestVoronoi& other) : Diagram(clone, other) {}
  template <class Other>
  static const FurthestSite<D>& refused() {
    static_assert(detail::always_false<Other>,
                  "a diagram of furthest sites is made from a delone::FurthestSite triangulation of the same "
                  "D; the dual of a delone::Delaunay one is a delone::Voronoi diagram");
  }
};

template <int D>
FurthestVoronoi(const FurthestSite<D>&, const DiagramOptions& = {}, const Execution& = {})
    -> FurthestVoronoi<D>;

}  // namespace delone
