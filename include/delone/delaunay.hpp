// SPDX-License-Identifier: BSD-3-Clause
// Exact Delaunay triangulations in any dimension: built from a range of points, or point by point.
#pragma once

#include <delone/complex.hpp>
#include <delone/error.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone {

/// Where a query point lies, exactly.
struct Location {
  enum class Kind {
    in_cell,              ///< in the interior of a finite cell
    on_face,              ///< in the relative interior of a face of dimension 1 … k−1
    on_vertex,            ///< equal to a vertex
    outside_hull,         ///< in the affine hull of the points, outside their convex hull
    outside_affine_hull,  ///< not in the affine hull (k < d)
  };
  Kind kind = Kind::outside_affine_hull;
  CellId cell = invalid_cell;  ///< a cell that contains the face; outside the hull: an infinite cell in
                               ///< conflict with the query
  std::vector<VertexId> face;  ///< the vertices of the smallest face that contains the query; empty outside
  int face_dimension() const { return static_cast<int>(face.size()) - 1; }
};

struct InsertResult {
  VertexId vertex = invalid_vertex;  ///< the vertex at that point; invalid_vertex if the point is hidden
  bool inserted = false;             ///< false: a duplicate of an earlier point, or hidden
};

/// The Delaunay triangulation of points in R^d, d chosen at run time.
///
/// Method: incremental insertion with symbolic perturbation of ties; Hornus and Boissonnat, "An efficient
/// implementation of Delaunay triangulations in medium dimensions", INRIA RR-6743 (2008); perturbation after
/// Devillers and Teillaud, "Perturbations for Delaunay and weighted Delaunay 3D triangulations",
/// doi:10.1016/j.comgeo.2010.09.010.
///
/// Exact for all finite doubles. The result is a function of the set of points: the cells do not depend on
/// order or seed. Input that spans only a k-flat is triangulated inside its flat. Duplicates are merged.
/// `const` members may be called from several threads at once. Expected cost for uniform points: O(n) cells
/// and time per dimension; worst case O(n^⌈d/2⌉) cells. In 7 and 8 dimensions a first batch of at most 4000
/// points leaves what only queries and insertions need, O(k³) time and 8(k+2) bytes per cell, to the first of
/// them, which throws Errc::out_of_memory if that fails.
class Triangulation {
 public:
  /// The triangulation of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit Triangulation(int dimension, const Options& options = {});
  /// The triangulation of n×d coordinates, row-major. Throws as insert_range().
  Triangulation(std::span<const double> coordinates, int dimension, const Options& options = {});
  Triangulation(PointsView points, const Options& options = {});
  /// The same, of a vector that is taken over: see insert_range().
  Triangulation(std::vector<double>&& coordinates, int dimension, const Options& options = {});
  Triangulation(Triangulation&&) noexcept;
  Triangulation& operator=(Triangulation&&) noexcept;
  ~Triangulation();

  /// Inserts n points (n·d coordinates) as the next n rows, all of them or none: after any error (not_finite,
  /// bad_dimension, cancelled, too_many, out_of_memory) the triangulation is as it was.
  void insert_range(std::span<const double> coordinates);
  /// The same, and the vector's memory is released before most cells are created: the peak is lower by the
  /// size of the points. After not_finite and bad_dimension the vector is as it was, too.
  void insert_range(std::vector<double>&& coordinates);
  /// Inserts one point (d coordinates) as the next row; `hint` is a cell near it. Expected cost with a good
  /// hint: the size of the conflict zone; without: also a walk past a few cells, from a vertex close by
  /// (docs/decisions/0006-walks-start-at-a-vertex-close-by.md). A batch is still faster.
  InsertResult insert(std::span<const double> point, std::optional<CellId> hint = std::nullopt);

  /// Releases what only insertions need: from then on a cell takes 8(k+1) bytes, and the ids of cells change,
  /// without gaps. Everything keeps working: queries are as exact as ever and some ten times slower, and the
  /// next insertion first restores what was released, O(k³) per cell. Cost O(cells·k), and for a moment the
  /// memory of both. Throws Errc::out_of_memory, and then changes nothing.
  void compact();

  int dimension() const;           ///< d
  int affine_dimension() const;    ///< k ≤ d; 0 for one distinct point, −1 for none
  std::size_t num_points() const;  ///< rows inserted, duplicates and hidden points included
  std::size_t num_rows() const;    ///< the same
  Index num_vertices() const;      ///< distinct points that are not hidden
  std::size_t num_duplicates() const;
  Index num_finite_cells() const { return complex().num_finite_cells(); }
  Index num_infinite_cells() const { return complex().num_infinite_cells(); }

  /// The combinatorial structure; valid until the next insertion.
  Complex complex() const;
  Complex::CellRange finite_cells() const { return complex().finite_cells(); }
  Complex::CellRange cells() const { return complex().cells(); }
  std::vector<VertexId> vertices(CellId c) const { return complex().vertices(c); }
  std::vector<CellId> neighbors(CellId c) const { return complex().neighbors(c); }

  /// The d coordinates of a finite vertex.
  std::span<const double> point(VertexId v) const;
  /// The first input row at a finite vertex.
  std::size_t row_of(VertexId v) const;
  /// The vertex at an input row, row < num_rows(); invalid_vertex for a row that was not inserted, or is
  /// hidden.
  VertexId vertex_at(std::size_t row) const;
  /// The k coordinate axes onto which the affine hull projects one-to-one, increasing; all d axes when k = d.
  std::vector<int> axes() const;

  /// Where q lies, exactly. Cost: a walk from the hint. REQUIRES d finite coordinates.
  Location locate(std::span<const double> query, std::optional<CellId> hint = std::nullopt) const;
  /// The cells in conflict with q: those an insertion of q would destroy, ties perturbed as an insertion
  /// would. Empty for a duplicate of a vertex and for a point outside the affine hull.
  std::vector<CellId> conflict_zone(std::span<const double> query,
                                    std::optional<CellId> hint = std::nullopt) const;

  /// The sign of (squared distance to the circumcenter − squared radius) of a finite cell at q, exactly:
  /// negative inside.
  Sign in_sphere(CellId cell, std::span<const double> query) const;

  /// A plain copy: cells of point rows in the order of finite_cells().
  ComplexData to_data(bool with_points = true) const;
  CanonicalHash hash() const;
  Statistics statistics() const;

 protected:
  struct Impl;
  explicit Triangulation(std::unique_ptr<Impl> impl);
  /// insert_range(), which calls `release` as soon as it has copied the coordinates.
  void insert_and_release(std::span<const double> coordinates, const std::function<void()>& release);
  Impl& impl() { return *impl_; }
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

namespace detail {

/// A class of the size of D doubles that, if it names its entries' type, holds doubles.
template <int D, class Element>
constexpr bool is_point_of_old() {
  if constexpr (requires { typename Element::value_type; })
    return sizeof(Element) == D * sizeof(double) && std::same_as<typename Element::value_type, double>;
  else
    return sizeof(Element) == D * sizeof(double) && std::is_class_v<Element>;
}

/// The coordinates of a contiguous range of points of D doubles each, or of doubles.
template <int D, class Range>
std::span<const double> as_coordinates(const Range& points) {
  using Element = std::remove_cv_t<std::ranges::range_value_t<Range>>;
  static_assert(std::same_as<Element, double> || is_point_of_old<D, Element>(),
                "a point must be D contiguous doubles, such as std::array<double, D>");
  return {reinterpret_cast<const double*>(std::ranges::data(points)),
          std::ranges::size(points) * sizeof(Element) / sizeof(double)};
}

}  // namespace detail

/// The Delaunay triangulation of points in R^D. Compiled for D = 1…8; larger D uses the run-time-dimension
/// engine.
template <int D>
class Delaunay : public Triangulation {
  static_assert(D >= 1, "the dimension of the space is at least 1");

 public:
  using Point = std::array<double, D>;

  explicit Delaunay(const Options& options = {}) : Triangulation(D, options) {}
  /// From any contiguous range of points of D doubles each, or of doubles (D per point).
  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range> &&
      (!std::same_as<std::remove_cvref_t<Range>, Delaunay>)explicit Delaunay(const Range& points,
                                                                             const Options& options = {})
      : Triangulation(detail::as_coordinates<D>(points), D, options) {}
  /// From a container that is taken over: see Triangulation::insert_range().
  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range> && detail::Expiring<Range> &&
      (!std::same_as<Range, Delaunay>)explicit Delaunay(Range&& points, const Options& options = {})
      : Triangulation(D, options) {
    insert_range(std::move(points));
  }

  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range>
  void insert_range(const Range& points) { Triangulation::insert_range(detail::as_coordinates<D>(points)); }
  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range> && detail::Expiring<Range>
  void insert_range(Range&& points) {
    insert_and_release(detail::as_coordinates<D>(points), [&] { const Range taken = std::move(points); });
  }
};

}  // namespace delone
