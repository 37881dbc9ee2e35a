// SPDX-License-Identifier: BSD-3-Clause
// What the triangulations of points have in common: Delaunay, regular and furthest-site, of any dimension.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/edit.hpp>
#include <delone/error.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace delone {

enum class TriangulationKind : std::uint8_t { delaunay, regular, furthest_site };

/// Where a query point lies, exactly.
struct Location {
  enum class Kind : std::uint8_t {
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

/// A triangulation of points in R^d: what holds for Delaunay<D>, Regular<D> and FurthestSite<D> alike. Make
/// one of these, and pass it as a `const Triangulation&` to functions that take any.
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
/// points postpones what only queries and insertions need: the first of them spends O(k³) time and 8(k+2)
/// bytes per cell on it, and throws Errc::out_of_memory if the memory is not there.
///
/// An object that was moved from may be assigned to and destroyed, and nothing else. The same holds for all
/// products.
///
/// *Hidden points.* In a regular or furthest-site triangulation some points are not vertices. Insertions and
/// edits may hide a vertex; a hidden point may become a vertex when others are removed, moved or reweighted.
/// A Delaunay triangulation hides no point.
///
/// *Edits.* Points can be removed, moved, reweighted and inserted, one by one or many at once: remove(),
/// move(), edit(). Whatever the history, the result is that of inserting all remaining rows at once. An edit
/// happens entirely or not at all: after any error (a row that does not exist, not_finite, cancelled,
/// out_of_memory) the triangulation is unchanged.
///
/// Ids are stable. A row keeps its number, and a vertex its id, as long as it exists, hidden or not. Edits do
/// not reuse numbers and ids, so gaps appear (has_row(), Complex::finite_vertices()); compact_ids() closes
/// them. A vertex exists as long as a row remains at its place; a row that is alone there and moves takes the
/// vertex along.
class DELONE_EXPORT Triangulation {
 public:
  Triangulation(const Triangulation&) = delete;
  Triangulation& operator=(const Triangulation&) = delete;

  TriangulationKind kind() const;

  /// Releases what only insertions need. Afterwards a cell takes 8(k+1) bytes, and cells have other ids,
  /// without gaps. Everything keeps working: queries are as exact as before and about ten times slower, and
  /// the next insertion first restores what was released, O(k³) per cell. Cost O(cells·k); both copies are in
  /// memory for a moment. Nothing can be undone afterwards. Throws Errc::out_of_memory, and then changes
  /// nothing.
  void compact();

  /// Renumbers the cells without gaps by their vertices: by the newest vertex, then by a hash of all. The
  /// order of cells, and of the vertices in each, is then the same for every number of threads, until the
  /// next insertion. Has no effect if a single thread built the triangulation, whatever Options::threads was.
  /// Uses up to Options::threads threads. Cost O(cells·k²), and for a moment 16 bytes per cell. Nothing can
  /// be undone afterwards unless the last change made all cells. Throws Errc::out_of_memory, cancelled, and
  /// then leaves the cells as they are.
  void sort_cells();

  int dimension() const;           ///< d
  int affine_dimension() const;    ///< k ≤ d; 0 for one distinct point, −1 for none
  std::size_t num_points() const;  ///< existing rows, duplicates and hidden points included
  std::size_t num_rows() const;    ///< one more than the largest row number, removed rows included
  /// Whether a row exists; false if it was removed. Throws Errc::invalid_argument unless row < num_rows().
  bool has_row(std::size_t row) const;
  Index num_vertices() const;  ///< distinct points that are not hidden
  std::size_t num_duplicates() const;
  Index num_finite_cells() const { return complex().num_finite_cells(); }
  Index num_infinite_cells() const { return complex().num_infinite_cells(); }
  Index num_all_cells() const { return complex().num_all_cells(); }

  /// The combinatorial structure; valid until the next insertion or edit.
  Complex complex() const;
  Complex::CellRange finite_cells() const { return complex().finite_cells(); }
  Complex::CellRange infinite_cells() const { return complex().infinite_cells(); }
  Complex::CellRange all_cells() const { return complex().all_cells(); }
  /// The k+1 vertices of a cell, and its neighbors: neighbor i is opposite vertex i. Without allocation.
  /// REQUIRES complex().is_cell(c).
  VerticesOfCell vertices(CellId c) const { return complex().vertices(c); }
  NeighborsOfCell neighbors(CellId c) const { return complex().neighbors(c); }

  /// The d coordinates of a finite vertex; valid until the next insertion or edit. Throws
  /// Errc::invalid_argument if v is not a finite vertex.
  std::span<const double> point(VertexId v) const;
  /// The first input row at a finite vertex. Throws as point().
  std::size_t row_of(VertexId v) const;
  /// The vertex at an input row; invalid_vertex if the row was removed or is hidden. Throws
  /// Errc::invalid_argument unless row < num_rows().
  VertexId vertex_at(std::size_t row) const;
  /// The k coordinate axes onto which the affine hull projects one-to-one, increasing; all d axes when k = d.
  std::vector<int> axes() const;

  /// Whether the point of an input row is hidden. O(1). Throws Errc::invalid_argument unless row <
  /// num_rows().
  bool is_hidden(std::size_t row) const;
  /// The number of hidden rows: num_points() = num_vertices() + num_duplicates() + num_hidden(). O(rows).
  std::size_t num_hidden() const;
  /// The hidden rows, increasing. O(rows).
  std::vector<std::size_t> hidden_rows() const;

  /// Removes one row, or several. Removing a row that is alone at its place costs about as much as 0.7 (2D)
  /// to 5 (6D) insertions there. Hidden points that may become vertices are inserted again; if they are most
  /// of the points, everything is rebuilt. The first edit also scans all rows, and in a regular or
  /// furthest-site triangulation locates each hidden point. Throws Errc::invalid_argument, naming the row and
  /// its place in the list, if a row does not exist or is listed twice; cancelled, out_of_memory and
  /// time_limit (Options).
  void remove(std::size_t row) { remove(std::span(&row, 1)); }
  void remove(std::span<const std::size_t> rows);

  /// From now on changes() tells what each insertion, edit and undo() did. Until the next change, a record is
  /// kept in memory as by record_undo(); if all cells were replaced, it has only the ids of the old ones. A
  /// single insertion or edit then takes up to twice as long. One thread inserts a batch; if it has more
  /// points than the triangulation, several threads rebuild all cells instead.
  void record_changes(bool wanted = true);
  /// What the last edit, insertion or undo() did; a call without any row or point does not count. The first
  /// call makes the lists, unless the next change comes before it and makes them: O(cells that changed), and
  /// after a batch O(cells). Empty after compact_ids() and compact(), and after sort_cells() unless the last
  /// change made all cells: then the lists have their new ids. Throws Errc::invalid_argument unless
  /// record_changes() is on, out_of_memory.
  const Changes& changes() const;
  /// Those of changes().removed_cells that were infinite, in ascending order. Throws as changes().
  const std::vector<CellId>& removed_infinite_cells() const;

  /// From now on undo() can take back the last edit or insertion; a call without any row or point does not
  /// count. A single insertion or edit takes up to twice as long. Until the next change, a record is kept in
  /// memory: 8(k+1) + 4 bytes for each cell that was destroyed, about 16 bytes and the point for each row and
  /// vertex that changed, and all old cells if the affine dimension changed or everything was rebuilt. If an
  /// edit fails after it has begun, nothing can be undone.
  void record_undo(bool wanted = true);
  bool can_undo() const;
  /// Takes back the last edit or insertion: all members answer as before it, ids included. An undo cannot be
  /// undone. Cost: that of the change. Throws Errc::invalid_argument unless can_undo().
  void undo();

  /// While something is recorded, a call that makes all cells also sorts them, as sort_cells() does. That
  /// takes up to about a third of the time of a batch. From now on such calls leave it out. Call sort_cells()
  /// when you need ids of cells; before the next change, it keeps what is recorded.
  void sort_cells_later(bool wanted = true);

  /// Renumbers rows and vertices without gaps, in their present order, and returns the new numbers. Nothing
  /// can be undone afterwards. O(cells·k + rows). Throws Errc::out_of_memory, and then changes nothing.
  CompactedIds compact_ids();

  /// Where the query lies, exactly. Cost: a walk from the hint, a cell near the query. Throws
  /// Errc::bad_dimension unless the query has d coordinates, not_finite, invalid_argument if the hint is not
  /// a cell, out_of_memory.
  Location locate(const AnyPoint<>& query, std::optional<CellId> hint = std::nullopt) const;

  /// A plain copy: cells of point rows, in the order of finite_cells(); with_points = false leaves the points
  /// out.
  ComplexData to_data(bool with_points = true) const;
  /// The hash of the vertices' coordinates and the set of cells, see CanonicalHash. O(n·d + cells·k).
  CanonicalHash hash(const Execution& how = {}) const;
  /// What the triangulation has cost so far. O(1).
  Statistics statistics() const;

 protected:
  struct DELONE_HIDDEN Impl;

  Triangulation(TriangulationKind kind, int dimension, const Options& options);
  Triangulation(detail::Clone, const Triangulation& other);
  Triangulation(Triangulation&&) noexcept;
  Triangulation& operator=(Triangulation&&) noexcept;
  ~Triangulation();

  /// Inserts points as the next rows; `weights` has one per point, or is empty: all are 0.
  template <int D>
  void insert_points(AnyPoints<D>& points, std::span<const double> weights = {}) {
    points.require_dimension(dimension());
    insert_points(points.coordinates(), weights, [&points] { points.release(); });
  }
  InsertResult insert_point(std::span<const double> point, double weight, std::optional<CellId> hint);
  /// An Edit of any D: coordinates one after the other.
  struct RowEdits {
    std::span<const std::size_t> remove = {}, move = {}, reweight = {};
    std::span<const double> to = {}, weights = {}, insert = {}, insert_weights = {};
    bool is_empty() const {
      return remove.empty() && move.empty() && reweight.empty() && to.empty() && weights.empty() &&
             insert.empty() && insert_weights.empty();
    }
  };
  void apply(const RowEdits& edits);
  template <int D>
  void apply(const Edit<D>& edit) {
    edit.to.require_dimension(dimension(), "move");
    edit.insert.require_dimension(dimension(), "insert");
    apply(RowEdits{edit.remove, edit.move, edit.reweight, edit.to.coordinates(), edit.weights,
                   edit.insert.coordinates(), edit.insert_weights});
  }
  std::vector<CellId> conflict_zone_of(std::span<const double> query, double weight,
                                       std::optional<CellId> hint) const;
  Side side_of_sphere(CellId cell, std::span<const double> query, double weight) const;
  double weight_of(VertexId v) const;
  CellId find_hiding_cell(std::size_t row, std::optional<CellId> hint) const;

  const Impl& impl() const { return *impl_; }

 private:
  /// `release` is called as soon as the coordinates have been copied.
  void insert_points(std::span<const double> coordinates, std::span<const double> weights,
                     const std::function<void()>& release);

  std::unique_ptr<Impl> impl_;
};

namespace detail {

/// The coordinates of one point: of D numbers, or of a number known at run time.
template <int D>
using Coordinates = std::span<const double, D == dynamic ? std::dynamic_extent : static_cast<std::size_t>(D)>;

template <int D>
using OwnPoint = std::conditional_t<D == dynamic, std::vector<double>, std::array<double, (D > 0 ? D : 1)>>;

}  // namespace detail

}  // namespace delone
