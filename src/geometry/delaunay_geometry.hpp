// SPDX-License-Identifier: BSD-3-Clause
// Joins the kernel to the engine: the conflict test of Delaunay, regular and furthest-site triangulations,
// from the cached functional of a cell (stage filter_) to the exact stages. A point q is in conflict with a
// cell iff h(q) < 0.
#pragma once

#include "geometry/frame.hpp"
#include "geometry/functionals.hpp"
#include "geometry/lattice.hpp"
#include "geometry/point_predicates.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace delone::geometry {

/// A point to be tested against cells: its image in the frame, and what its grid proves.
template <int K>
struct Query : PointQuery {
  Query(const double* at, const kernel::Grid& grid_of_all, std::size_t dimension, int row_size)
      : PointQuery{at, &grid_of_all, row_size}, row(dimension + 1) {}
  LatticeBounds bounds;
  /// The image on the axes of the flat, and the lift; NaN outside the frame.
  kernel::Buffer<double, K + (K > 0)> row;
};

template <int K>
class DelaunayGeometry : public PointPredicates<K> {
  using PointPredicates<K>::flat;
  using PointPredicates<K>::gather;

 public:
  using Query = geometry::Query<K>;

  /// `coordinates`: the points of the vertices, `ambient` doubles each and then the weight if the frame is of
  /// weighted points, indexed by vertex id (vertex 0 is a dummy). Both references must outlive this object;
  /// they may grow.
  DelaunayGeometry(CellMemory<K>& cells, std::vector<int> axes, int ambient,
                   const std::vector<double>& coordinates, const kernel::Grid& grid, Frame frame)
      : PointPredicates<K>(std::move(axes), ambient, frame.form(), coordinates),
        grid_(grid),
        frame_(std::move(frame)),
        functionals_(cells) {
    adopt_frame(Lattice(frame_, axes_));
  }

  /// The same for another thread. The cells are shared, and so are the rows of the vertices, all of which
  /// must be there (prepare_rows()). `shared` must outlive this object, and its rows must stay where they
  /// are.
  struct ForThread {};
  DelaunayGeometry(const DelaunayGeometry& shared, ForThread)
      : PointPredicates<K>(shared),
        grid_(shared.grid_),
        frame_(shared.frame_),
        lattice_(shared.lattice_),
        bounds_(shared.bounds_),
        bounds_revision_(shared.bounds_revision_),
        functionals_(shared.functionals_),
        computes_rows_(shared.computes_rows_),
        shared_rows_(shared.rows_.data()),
        has_all_rows_(true) {}

  using PointPredicates<K>::dimension;
  using PointPredicates<K>::point;
  const Frame& frame() const { return frame_; }
  const kernel::Grid& grid() const { return grid_; }
  /// All cells must be created again after it. Sets the rows of the first `vertices` vertices. Throws
  /// std::bad_alloc, and then changes nothing.
  void set_frame(Frame frame, Index vertices) {
    Lattice lattice(frame, axes_);
    if (!computes_rows_) rows_.reserve((static_cast<std::size_t>(vertices) + 1) * row_size());
    frame_ = std::move(frame);
    adopt_frame(std::move(lattice));
    set_rows(vertices);
  }
  /// Sets the rows of vertices 1 … `vertices`, unless rows are computed where they are needed.
  void set_rows(Index vertices) {
    if (!computes_rows_) keep_rows(vertices);
  }
  /// Computes these rows and stores them, in any case.
  void keep_rows(Index vertices) {
    rows_.reserve((static_cast<std::size_t>(vertices) + 1) * row_size());
    std::fill_n(rows_.data(), row_size(), 0.0);
    for (Index v = 1; v <= vertices; ++v) write_row(point(v), rows_.data() + v * row_size());
  }

  /// Computes the row of a vertex that has moved, if there is one; or of all up to one.
  void rewrite_row(Index v) {
    if (!computes_rows_ && (static_cast<std::size_t>(v) + 1) * row_size() <= rows_.capacity())
      write_rows(v, v);
  }
  void rewrite_rows(Index last) {
    for (Index v = 1; v <= last; ++v) rewrite_row(v);
  }

  /// Makes room for the rows of vertices up to `last` and what the first star of one thread would find out.
  /// Throws std::bad_alloc, and then changes nothing.
  void prepare_rows(Index last) { reserve_star(last, 1); }
  /// Computes the rows of vertices first … last. Several threads may do so for different ones.
  void write_rows(Index first, Index last) {
    if (computes_rows_) return;
    for (Index v = first; v <= last; ++v) write_row(point(v), rows_.data() + v * row_size());
  }

  /// The images and lifts of the vertices, k + 1 doubles each. REQUIRES keep_rows().
  const double* kept_rows() const { return rows_.data(); }

  /// A query at the point of a vertex.
  Query query_at(Index v) const { return make_query(point(v)); }
  /// A query at a point that the grid of the vertices includes.
  Query make_query(const double* at) const { return make_query(at, grid_); }

  /// A query anywhere; `grid` is one for the vertices and the point, and must outlive the query.
  Query make_query(const double* at, const kernel::Grid& grid) const {
    Query q(at, grid, axes_.size(), flat().row_size());
    q.bounds =
        &grid == &grid_ && grid.revision() == bounds_revision_ ? bounds_ : lattice_.bounds(grid, axes_);
    if (frame_.contains(at))
      write_row(at, q.row.data());
    else
      std::fill_n(q.row.data(), dimension() + 1, std::numeric_limits<double>::quiet_NaN());
    return q;
  }

  /// h̃(q), approximately the functional of the cell. Functionals of finite cells are comparable with each
  /// other.
  double value(Index cell, const Query& q) const { return evaluator(q).value(cell); }
  auto evaluator(const Query& q) const { return functionals_.evaluator(q.row.data()); }
  bool is_infinite(Index cell) const { return functionals_.is_infinite(cell); }
  /// Stage filter_: a value beyond it has the sign of h, for all queries in the frame.
  double threshold(Index cell) const { return functionals_.threshold(cell); }

  /// Thresholds of several cells for this query alone, which are tighter and cost more.
  void thresholds_at(std::span<const Index> cells, const Query& q, double* thresholds) const {
    functionals_.thresholds_at(cells, rows(), q.row.data(), thresholds);
  }

  /// Also stage filter_: whether a value within the threshold proves that h(q) is exactly zero.
  bool proves_tie(Index cell, double value, const Query& q) const {
    return functionals_.proves_zero(cell, value, q.bounds);
  }

  /// The orientation of k+1 finite vertices.
  Sign orientation(const Index* vertices) const {
    return kernel::orientation<K>(flat(), gather(vertices).data(), grid_);
  }

  /// The same as that of the predicates, where the grid of all vertices is not small: on a small one, values
  /// of functionals prove ties.
  std::optional<Sign> quick_side(const Index* vertices, Index v) const {
    if (grid_.is_small()) return std::nullopt;
    return PointPredicates<K>::quick_side(vertices, v);
  }

  using PointPredicates<K>::first_of_plane;
  /// The same on the grid of the vertices.
  std::size_t first_of_plane(Index from, Index to, std::span<const Index> vertices, StageCounts& counts) const
      requires(K == 2) {
    return first_of_plane(from, to, vertices, grid_, counts);
  }

  /// Computes what is cached for a cell by elimination. `apex` is the slot of a finite vertex. Returns the
  /// orientation of the vertices, or zero if that is not certain, the cell is infinite, or the apex is not in
  /// slot 0.
  Sign create(Index cell, const Index* vertices, int infinite_slot, int apex);

  /// Says nothing of a cell: exact stages decide.
  void give_up(Index cell, bool infinite) { functionals_.give_up(cell, infinite); }

  /// The same for finite cells, many at once, apexes in slot 0. REQUIRES keep_rows().
  void create(std::span<const Index> cells, std::span<const Index* const> vertices, Sign* orientations);

  /// The same for vertices that have numbers, by which `rows` has their rows; where an orientation is zero,
  /// the cell must be created by itself.
  void create_from_rows(std::span<const Index> cells, std::span<const Index* const> vertices,
                        const double* rows, Sign* orientations) {
    for (std::size_t first = 0; first < cells.size(); first += simplex_lanes) {
      const std::size_t count = std::min(simplex_lanes, cells.size() - first);
      functionals_.solve(cells.subspan(first, count), vertices.subspan(first, count), rows,
                         orientations + first);
    }
  }
  /// The same for one finite cell of the plane, from the rows of its vertices. Throws nothing.
  Sign create_triangle(Index cell, const double* rows) requires(K == 2) {
    return functionals_.template solve<false>(cell, rows, true);
  }
  /// Copies what is cached for a cell, k + 2 numbers, and puts it back. REQUIRES that the frame is the same.
  void save(Index cell, double* to) const { functionals_.save(cell, to); }
  void put_back(Index cell, const double* from) { functionals_.put_back(cell, from); }
  /// The row of a vertex: k images and the lift.
  void write_row_of(Index v, double* row) const { write_row(point(v), row); }
  /// Prefetches what write_row_of() and value_at() read of a vertex.
  [[gnu::always_inline]] void prefetch_row(Index v) const { rows().prefetch(v, dimension()); }
  /// The functional of a cell at a vertex.
  double value_at(Index cell, Index v) const {
    const auto row = rows().template row<K>(v, dimension());
    if constexpr (std::is_pointer_v<std::remove_cv_t<decltype(row)>>)
      return functionals_.evaluator(row).value(cell);
    else
      return functionals_.evaluator(row.data()).value(cell);
  }
  /// The same at a row.
  double value_at_row(Index cell, const double* row) const { return functionals_.value(cell, row); }

  /// Makes room for a star of vertex v. Throws std::bad_alloc, and then changes nothing.
  void reserve_star(Index v, std::size_t facets) {
    functionals_.reserve_star(facets);
    if (grid_.revision() != bounds_revision_) {
      bounds_ = lattice_.bounds(grid_, axes_);
      bounds_revision_ = grid_.revision();
    }
    if (computes_rows_ || has_all_rows_) return;
    const std::size_t size = (static_cast<std::size_t>(v) + 1) * row_size();
    rows_.reserve(growing(size));
    rows_.prepare(size);
  }
  /// Computes what is cached for the created cells of a star of vertex v at q, from the cells on the two
  /// sides of each facet. Returns the facets for whose cells that is too inaccurate: these cells must be
  /// created one by one.
  std::span<const std::uint32_t> create_star(Index v, const Query& q, std::span<const HorizonFacet> facets) {
    if (!computes_rows_ && !has_all_rows_)
      std::memcpy(rows_.data() + v * row_size(), q.row.data(), row_size() * sizeof(double));
    return functionals_.combine(facets, rows(), q.row.data(), q.bounds);
  }

 private:
  void adopt_frame(Lattice lattice) {
    functionals_.set_frame(frame_, axes_);
    lattice_ = std::move(lattice);
    bounds_revision_ = 0;
    bounds_ = {};
    computes_rows_ =
        can_compute_rows(K) && dimension() == frame_.ambient() && frame_.form() == kernel::RowForm::point;
  }
  VertexRows rows() const {
    if (!computes_rows_) return has_all_rows_ ? shared_rows_ : rows_.data();
    return rows_of(point(0));
  }
  /// Rows of points that lie one after the other in memory.
  VertexRows rows_of(const double* points) const {
    return {points, frame_.center().data(), frame_.scale().data(), frame_.lift_scale()};
  }

  int axis(int r) const { return axes_[static_cast<std::size_t>(r)]; }

  std::size_t row_size() const { return static_cast<std::size_t>(dimension()) + 1; }
  std::size_t growing(std::size_t size) const { return size <= rows_.capacity() ? size : size + size / 2; }
  void write_row(const double* at, double* row) const {
    if constexpr (can_compute_rows(K)) {
      if (computes_rows_) {
        const auto computed = rows_of(at).template row<K>(0, K);
        std::copy(computed.begin(), computed.end(), row);
        return;
      }
    }
    for (int r = 0; r < dimension(); ++r) row[r] = frame_.image(at, axis(r));
    row[dimension()] = frame_.lift(at);
  }

  using PointPredicates<K>::axes_;

  const kernel::Grid& grid_;
  Frame frame_;
  Lattice lattice_;
  LatticeBounds bounds_;  // for the grid of the vertices in this revision; in revision 0 they prove nothing
  std::uint64_t bounds_revision_ = 0;
  Functionals<K> functionals_;
  bool computes_rows_ = false;
  internal::GrowableArray<double> rows_{
      internal::Pages::large};           // of the vertices in the frame, if they are kept
  const double* shared_rows_ = nullptr;  // those of another thread's geometry, if it
  bool has_all_rows_ = false;
};

template <int K>
Sign DelaunayGeometry<K>::create(Index cell, const Index* vertices, int infinite_slot, int apex) {
  const int k = dimension();
  kernel::Buffer<double, (K > 0) * (K + 1) * (K + 1)> rows(static_cast<std::size_t>((k + 1) * (k + 1)));
  double* row = rows.data();
  const auto append = [&](int slot) {
    write_row(point(vertices[slot]), row);
    row += k + 1;
  };
  append(apex);
  for (int i = 0; i <= k; ++i)
    if (i != apex && i != infinite_slot) append(i);
  if (infinite_slot < 0) {
    const Sign sign = functionals_.template solve<false>(cell, rows.data(), true);
    return apex == 0 ? sign : Sign::zero;
  } else {
    // The sign that makes h negative where a point in the slot of the infinite vertex would make a positively
    // oriented cell (docs/predicates.md, "Signs").
    const int position = infinite_slot - (infinite_slot > apex ? 1 : 0);
    functionals_.template solve<true>(cell, rows.data(), (apex + position + k) % 2 == 0);
    return Sign::zero;
  }
}

template <int K>
void DelaunayGeometry<K>::create(std::span<const Index> cells, std::span<const Index* const> vertices,
                                 Sign* orientations) {
  for (std::size_t first = 0; first < cells.size(); first += simplex_lanes) {
    const std::size_t count = std::min(simplex_lanes, cells.size() - first);
    functionals_.solve(cells.subspan(first, count), vertices.subspan(first, count), rows_.data(),
                       orientations + first);
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (orientations[i] == Sign::zero) orientations[i] = create(cells[i], vertices[i], -1, 0);
}

}  // namespace delone::geometry
