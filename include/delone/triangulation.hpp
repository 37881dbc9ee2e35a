// SPDX-License-Identifier: BSD-3-Clause
// What the triangulations of points have in common: Delaunay, regular and furthest-site, of any dimension.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/edit.hpp>
#include <delone/error.hpp>
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

/// A triangulation of points in R^d: what holds for Delaunay<D>, Regular<D> and FurthestSite<D> alike. They
/// are made as one of these, and passed as a `const Triangulation&` to what takes any.
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
///
/// An object that was moved from may be assigned to and destroyed, and nothing else. The same holds for all
/// products.
///
/// *Hidden points.* In a regular or furthest-site triangulation some points are no vertices. A vertex may
/// become hidden by insertions and edits, and a hidden point may become a vertex when others are removed,
/// moved or weighed anew. A Delaunay triangulation hides no point.
///
/// *Edits.* Points can be removed, moved, given other weights and inserted, one by one or many at once:
/// remove(), move(), edit(). Whatever the history, the result is that of all rows that are left, inserted at
/// once. An edit takes place whole or not at all: after any error (a row that is not there, not_finite,
/// cancelled, out_of_memory) everything is as it was.
///
/// Ids are stable. A row keeps its number, and a vertex its id, as long as it is there, hidden or not; edits
/// do not use them again, so that they get gaps (has_row(), Complex::finite_vertices()), until compact_ids().
/// A vertex stays as long as a row is left at its place, and a row that moves alone takes its vertex along.
class DELONE_EXPORT Triangulation {
 public:
  Triangulation(const Triangulation&) = delete;
  Triangulation& operator=(const Triangulation&) = delete;

  TriangulationKind kind() const;

  /// Releases what only insertions need: from then on a cell takes 8(k+1) bytes, and the ids of cells change,
  /// without gaps. Everything keeps working: queries are as exact as ever and some ten times slower, and the
  /// next insertion first restores what was released, O(k³) per cell. Cost O(cells·k), and for a moment the
  /// memory of both. After it nothing can be undone. Throws Errc::out_of_memory, and then changes nothing.
  void compact();

  /// Gives cells ids by their vertices, without gaps: by the newest, and by a hash of all. Then the order of
  /// cells, and of the vertices in each, is the same however many threads have built the triangulation, until
  /// the next insertion. Does nothing where one thread has built it whatever Options::threads said. Uses up
  /// to so many threads. Cost O(cells·k²), and for a moment 16 bytes per cell. After it nothing can be
  /// undone. Throws Errc::out_of_memory, and then changes nothing.
  void sort_cells();

  int dimension() const;           ///< d
  int affine_dimension() const;    ///< k ≤ d; 0 for one distinct point, −1 for none
  std::size_t num_points() const;  ///< rows that are there, duplicates and hidden points included
  std::size_t num_rows() const;    ///< one more than the number of the last row, with those that were removed
  bool has_row(std::size_t row) const;  ///< whether a row, row < num_rows(), is there: not if it was removed
  Index num_vertices() const;           ///< distinct points that are not hidden
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
  VerticesOfCell vertices(CellId c) const { return complex().vertices(c); }
  NeighborsOfCell neighbors(CellId c) const { return complex().neighbors(c); }

  /// The d coordinates of a finite vertex.
  std::span<const double> point(VertexId v) const;
  /// The first input row at a finite vertex.
  std::size_t row_of(VertexId v) const;
  /// The vertex at an input row, row < num_rows(); invalid_vertex for a row that was removed, or is hidden.
  VertexId vertex_at(std::size_t row) const;
  /// The k coordinate axes onto which the affine hull projects one-to-one, increasing; all d axes when k = d.
  std::vector<int> axes() const;

  /// Whether the point of an input row, row < num_rows(), is hidden. O(1).
  bool is_hidden(std::size_t row) const;
  /// How many rows are hidden: num_points() = num_vertices() + num_duplicates() + num_hidden(). O(rows).
  std::size_t num_hidden() const;
  /// The rows that are hidden, increasing. O(rows).
  std::vector<std::size_t> hidden_rows() const;

  /// Removes a row, or many. Cost of one that is the only one at its place: that of some insertions there,
  /// from 1.2 in 2D to five in 6D. Hidden points that may come back are inserted, too, or if they
  /// are most of what is there, everything is built anew. The first edit also looks at all rows, and in a
  /// regular or furthest-site triangulation finds a cell for each hidden point. Throws
  /// Errc::invalid_argument, naming a row and its place in the list, if it is not there or is given twice.
  void remove(std::size_t row) { remove(std::span(&row, 1)); }
  void remove(std::span<const std::size_t> rows);

  /// Has changes() tell from now on what every insertion, edit and undo() does. Such a call then takes up to
  /// twice as long. A batch of insertions takes up to three times as long, as one thread inserts the points
  /// one by one; if they are more than those that are there, all cells are built anew instead.
  void record_changes(bool wanted = true);
  /// What the last edit, insertion or undo() did; one without any row or point does not count. After
  /// compact_ids(), compact() and sort_cells() nothing. Throws Errc::invalid_argument unless record_changes()
  /// is on.
  const Changes& changes() const;

  /// Has undo() take back the last edit or insertion from now on; one without any row or point does not
  /// count. Costs time as record_changes() does. Until the next one, memory for the cells
  /// that it killed is kept, 8(k+1) + 4 bytes each, and for every row and vertex that it changed, some 16
  /// bytes and its point; the cells themselves where it raised or lowered the affine dimension, or built
  /// anew. After an edit that has begun and fails, nothing can be taken back.
  void record_undo(bool wanted = true);
  bool can_undo() const;
  /// Takes back the last edit or insertion: everything that members tell is as it was, ids included. Cannot
  /// be taken back itself. Cost: that of the change. Throws Errc::invalid_argument unless can_undo().
  void undo();

  /// Gives rows and vertices numbers without gaps, in their present order, and tells what they have become.
  /// After it nothing can be undone. O(cells·k + rows). Throws Errc::out_of_memory, and then changes nothing.
  CompactedIds compact_ids();

  /// Where q lies, exactly. Cost: a walk from the hint. REQUIRES d finite coordinates.
  Location locate(const AnyPoint<>& query, std::optional<CellId> hint = std::nullopt) const;

  /// A plain copy: cells of point rows in the order of finite_cells().
  ComplexData to_data(bool with_points = true) const;
  /// `threads`: as for canonical_hash() below.
  CanonicalHash hash(unsigned threads = 1) const;
  Statistics statistics() const;

 protected:
  struct DELONE_HIDDEN Impl;

  Triangulation(TriangulationKind kind, int dimension, const Options& options);
  Triangulation(detail::Clone, const Triangulation& other);
  Triangulation(Triangulation&&) noexcept;
  Triangulation& operator=(Triangulation&&) noexcept;
  ~Triangulation();

  /// Inserts points as the next rows; `weights` are as many, or none: all are 0.
  template <int D>
  void insert_points(AnyPoints<D>& points, std::span<const double> weights = {}) {
    points.require_dimension(dimension());
    insert_points(points.coordinates(), weights, [&points] { points.release(); });
  }
  InsertResult insert_point(std::span<const double> point, double weight, std::optional<CellId> hint);
  /// An Edit of any D: coordinates one after the other.
  struct RowEdits {
    std::span<const std::size_t> remove = {}, move = {}, weigh = {};
    std::span<const double> to = {}, weights = {}, insert = {}, insert_weights = {};
    bool is_empty() const {
      return remove.empty() && move.empty() && weigh.empty() && to.empty() && weights.empty() &&
             insert.empty() && insert_weights.empty();
    }
  };
  void apply(const RowEdits& edits);
  template <int D>
  void apply(const Edit<D>& edit) {
    edit.to.require_dimension(dimension(), "move");
    edit.insert.require_dimension(dimension(), "insert");
    apply(RowEdits{edit.remove, edit.move, edit.weigh, edit.to.coordinates(), edit.weights,
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

/// canonical_hash() by several threads: at most so many; 0: as many as there are cores, where the data are
/// large enough to gain by them.
DELONE_EXPORT CanonicalHash canonical_hash(const ComplexData& data, unsigned threads);

}  // namespace delone
