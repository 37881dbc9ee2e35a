// SPDX-License-Identifier: BSD-3-Clause
// What joins the kernel to the engine: the conflict test of Delaunay, regular and furthest-site triangulations, from the cached
// functional of a cell (stage filter_) to the exact stages. A point q is in conflict with a cell iff h(q) < 0.
#pragma once

#include "geometry/frame.hpp"
#include "geometry/functionals.hpp"
#include "geometry/lattice.hpp"
#include "kernel/stages.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace delone::geometry {

/// A point to be tested against cells: its coordinates (then its weight, if points have one), its image in the frame, and a
/// grid that all vertices and the point itself lie on.
template <int K>
struct Query {
  Query(const double* at, const kernel::Grid& grid_of_all, std::size_t dimension, int row_size)
      : point(at), grid(&grid_of_all), compared(row_size), row(dimension + 1) {}
  const double* point;
  const kernel::Grid* grid;
  int compared;  ///< how many entries a vertex at the query must share: without the weight, any vertex at its coordinates is
  LatticeBounds bounds;
  kernel::Buffer<double, K + (K > 0)> row;  ///< the image on the axes of the flat and the lift; not a number outside the frame
};

template <int K>
class DelaunayGeometry {
 public:
  using Query = geometry::Query<K>;

  /// `coordinates`: the points of the vertices, `ambient` doubles each and then the weight if the frame is of weighted points,
  /// indexed by vertex id (vertex 0 is a dummy). Both references must outlive this object; they may grow.
  DelaunayGeometry(CellMemory<K>& cells, std::vector<int> axes, int ambient, const std::vector<double>& coordinates,
                   const kernel::Grid& grid, Frame frame)
      : axes_(std::move(axes)),
        ambient_(ambient),
        coordinates_(coordinates),
        grid_(grid),
        frame_(std::move(frame)),
        functionals_(cells) {
    adopt_frame();
  }

  int dimension() const { return K > 0 ? K : static_cast<int>(axes_.size()); }
  const Frame& frame() const { return frame_; }
  /// All cells must be created anew after it. The rows of the first `vertices` vertices are computed, that of the infinite
  /// vertex apart.
  void set_frame(Frame frame, Index vertices) {
    frame_ = std::move(frame);
    adopt_frame();
    set_rows(vertices);
  }
  /// Computes the rows of vertices 1 … `vertices`.
  void set_rows(Index vertices) {
    rows_.reserve((static_cast<std::size_t>(vertices) + 1) * row_size());
    std::fill_n(rows_.data(), row_size(), 0.0);
    for (Index v = 1; v <= vertices; ++v) write_row(point(v), rows_.data() + v * row_size());
  }

  /// A query at the point of a vertex.
  Query make_query(const double* point) const { return make_query(point, grid_); }

  /// A query anywhere; `grid` is one for the vertices and the point, and must outlive the query.
  Query make_query(const double* point, const kernel::Grid& grid) const {
    Query q(point, grid, axes_.size(), flat().row_size());
    q.bounds = lattice_.bounds(grid, axes_);
    if (frame_.contains(point))
      write_row(point, q.row.data());
    else
      std::fill_n(q.row.data(), dimension() + 1, std::numeric_limits<double>::quiet_NaN());
    return q;
  }

  const double* point(Index vertex) const {
    return coordinates_.data() + static_cast<std::size_t>(vertex) * static_cast<std::size_t>(flat().row_size());
  }
  bool is_at(Index vertex, const Query& q) const { return kernel::equal_points(point(vertex), q.point, q.compared); }

  /// h̃(q), approximately the functional of the cell. Functionals of finite cells are comparable with each other.
  double value(Index cell, const Query& q) const { return evaluator(q).value(cell); }
  auto evaluator(const Query& q) const { return functionals_.evaluator(q.row.data()); }
  bool is_infinite(Index cell) const { return functionals_.is_infinite(cell); }
  /// |value − h| stays below it for all queries in the frame. Stage filter_: a value beyond it has the sign of h.
  double threshold(Index cell) const { return functionals_.threshold(cell); }

  /// Stage filter_, too: whether a value within the threshold proves that h(q) is exactly zero.
  bool proves_tie(Index cell, double value, const Query& q) const { return functionals_.proves_zero(cell, value, q.bounds); }

  /// Stages direct_ and exact_: the sign of h(q) for the cell of these k+1 vertices, `infinite_slot` −1 for a finite cell.
  /// REQUIRES that q is none of the vertices.
  Sign exact_side(const Index* vertices, int infinite_slot, const Query& q, StageCounts& counts) const {
    auto points = gather(vertices);
    const kernel::Flat flat = this->flat();
    if (infinite_slot >= 0) {
      points[static_cast<std::size_t>(infinite_slot)] = q.point;
      return -kernel::orientation<K>(flat, points.data(), *q.grid, counts);
    }
    return kernel::in_sphere<K>(flat, points.data(), q.point, *q.grid, counts);
  }
  /// Stage perturbed_, for a finite cell with h(q) = 0: never zero.
  Sign perturbed_side(const Index* vertices, const Query& q, StageCounts& counts) const {
    ++counts.perturbed;
    return kernel::perturbed_in_sphere<K>(flat(), gather(vertices).data(), q.point, *q.grid);
  }

  /// The sign of h(q) for a finite cell, ties not perturbed: that of the power of q with respect to its sphere, or, for
  /// furthest points, its opposite.
  Sign unperturbed_side(const Index* vertices, const Query& q) const {
    StageCounts uncounted;
    return kernel::in_sphere<K>(flat(), gather(vertices).data(), q.point, *q.grid, uncounted);
  }

  /// The exact sign of the barycentric coordinate of q at vertex `slot` of a finite, positively oriented cell.
  Sign side_of_facet(const Index* vertices, int slot, const Query& q) const {
    auto points = gather(vertices);
    points[static_cast<std::size_t>(slot)] = q.point;
    return kernel::orientation<K>(flat(), points.data(), *q.grid);
  }

  /// The orientation of k+1 finite vertices.
  Sign orientation(const Index* vertices) const { return kernel::orientation<K>(flat(), gather(vertices).data(), grid_); }

  /// Computes what is cached for a cell by elimination. `apex` is the slot of a finite vertex.
  void create(Index cell, const Index* vertices, int infinite_slot, int apex);

  /// Makes room for a star of vertex v. Throws std::bad_alloc, and then changes nothing.
  void reserve_star(Index v, std::size_t facets) {
    functionals_.reserve_star(facets);
    rows_.reserve(growing((static_cast<std::size_t>(v) + 1) * row_size()));
  }
  /// Computes what is cached for the created cells of a star of vertex v at q, from the cells on the two sides of each facet.
  /// Returns the facets for whose cells that would be too inaccurate: they must be created singly.
  std::span<const std::uint32_t> create_star(Index v, const Query& q, std::span<const HorizonFacet> facets) {
    std::copy_n(q.row.data(), row_size(), rows_.data() + v * row_size());
    return functionals_.combine(facets, rows_.data(), q.row.data(), q.bounds);
  }

 private:
  void adopt_frame() {
    functionals_.set_frame(frame_, axes_);
    lattice_ = Lattice(frame_, axes_);
  }

  int axis(int r) const { return axes_[static_cast<std::size_t>(r)]; }
  kernel::Flat flat() const { return {ambient_, axes_, frame_.form()}; }

  std::size_t row_size() const { return static_cast<std::size_t>(dimension()) + 1; }
  std::size_t growing(std::size_t size) const { return size <= rows_.capacity() ? size : size + size / 2; }
  void write_row(const double* point, double* row) const {
    for (int r = 0; r < dimension(); ++r) row[r] = frame_.image(point, axis(r));
    row[dimension()] = frame_.lift(point);
  }

  auto gather(const Index* vertices) const {
    const int size = dimension() + 1;
    kernel::Buffer<const double*, K + (K > 0)> points(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) points[static_cast<std::size_t>(i)] = point(vertices[i]);
    return points;
  }

  std::vector<int> axes_;
  int ambient_;
  const std::vector<double>& coordinates_;
  const kernel::Grid& grid_;
  Frame frame_;
  Lattice lattice_;
  Functionals<K> functionals_;
  GrowableArray<double> rows_;  // of the vertices in the frame
};

template <int K>
void DelaunayGeometry<K>::create(Index cell, const Index* vertices, int infinite_slot, int apex) {
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
    functionals_.template solve<false>(cell, rows.data(), true);
  } else {
    // The sign that makes h negative where a point in the slot of the infinite vertex would make a positively oriented cell
    // (docs/predicates.md, "Signs").
    const int position = infinite_slot - (infinite_slot > apex ? 1 : 0);
    functionals_.template solve<true>(cell, rows.data(), (apex + position + k) % 2 == 0);
  }
}

}  // namespace delone::geometry
