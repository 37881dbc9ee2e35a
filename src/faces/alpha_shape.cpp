// SPDX-License-Identifier: BSD-3-Clause
// Rings. The walk along the boundary goes from edge to edge around the triangles that it has on its left. If
// it comes to a vertex v again, what lies between is a ring, and is cut off: the parts of one walk belong to
// one body R. Where R has several sectors at v, a curve in R from one of them to another, closed in v,
// separates the gaps between them. So at most one gap is connected with the outside, and the rings around all
// others are clockwise. As R is connected, exactly one ring of R is counterclockwise.
#include <delone/alpha_shape.hpp>
#include <delone/error.hpp>
#include <delone/predicates.hpp>

#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "base/union_find.hpp"
#include "faces/face_rows.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace delone {
namespace {

/// The cells of a complex and the facets of its boundary, which are numbered as in AlphaComplex::boundary().
class Shape {
 public:
  explicit Shape(const AlphaComplex& complex)
      : data_(complex.to_data()),
        facets_(complex.boundary()),
        k_(static_cast<std::size_t>(std::max(complex.affine_dimension(), 0))),
        joined_(data_.num_cells()) {
    cell_of_facet_.reserve(complex.boundary_cells().size());
    internal::QuickRounds round;
    for (std::size_t i = 0; i < data_.neighbors.size() && k_ > 0; ++i) {
      round();
      const std::size_t cell = i / (k_ + 1);
      SignedIndex& across = data_.neighbors[i];
      if (across < 0) {
        across = -1 - static_cast<SignedIndex>(cell_of_facet_.size());
        cell_of_facet_.push_back(cell);
      } else if (static_cast<std::size_t>(across) > cell) {
        joined_.unite(static_cast<Index>(cell), static_cast<Index>(across));
      }
    }
  }

  std::size_t num_facets() const { return cell_of_facet_.size(); }
  std::size_t dimension() const { return k_; }
  std::span<const SignedIndex> facet(std::size_t f) const { return facets_.subspan(f * k_, k_); }
  const double* point(SignedIndex row) const {
    return data_.points.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(data_.dimension);
  }
  std::size_t num_cells() const { return data_.num_cells(); }
  std::size_t num_rows() const { return data_.points.size() / static_cast<std::size_t>(data_.dimension); }
  /// One of the cells of the body that a facet belongs to.
  Index body_of(std::size_t f) { return joined_.root(static_cast<Index>(cell_of_facet_[f])); }

  /// The facet that the cells around a face of facet f lead to, the face opposite its vertex i.
  std::size_t neighbor(std::size_t f, std::size_t i) const {
    std::size_t cell = cell_of_facet_[f];
    std::size_t from = 0;  // the cell's vertices that are not in the face: first the one opposite the facet
    while (contains(facet(f), vertex(cell, from))) ++from;
    std::size_t to = index_of(cell, facet(f)[i]);
    for (;;) {
      const SignedIndex across = data_.neighbors[cell * (k_ + 1) + to];
      if (across < 0) return static_cast<std::size_t>(-1 - across);
      const auto next = static_cast<std::size_t>(across);
      const SignedIndex kept = vertex(cell, from);
      from = 0;
      while (data_.neighbors[next * (k_ + 1) + from] != static_cast<SignedIndex>(cell)) ++from;
      to = index_of(next, kept);
      cell = next;
    }
  }

 private:
  SignedIndex vertex(std::size_t cell, std::size_t i) const { return data_.cells[cell * (k_ + 1) + i]; }
  std::size_t index_of(std::size_t cell, SignedIndex row) const {
    std::size_t i = 0;
    while (vertex(cell, i) != row) ++i;
    return i;
  }
  static bool contains(std::span<const SignedIndex> rows, SignedIndex row) {
    return std::find(rows.begin(), rows.end(), row) != rows.end();
  }

  ComplexData data_;  // a neighbor that is less than 0 is −1 less the number of a facet
  std::span<const SignedIndex> facets_;
  std::size_t k_;
  std::vector<std::size_t> cell_of_facet_;
  internal::UnionFind joined_;
};

/// Numbers roots 0, 1, …, each when it is first asked for.
class Numbering {
 public:
  explicit Numbering(std::size_t n) : numbers_(n, -1) {}
  SignedIndex operator()(Index root) {
    SignedIndex& number = numbers_[root];
    if (number < 0) number = count_++;
    return number;
  }
  SignedIndex count() const { return count_; }

 private:
  std::vector<SignedIndex> numbers_;
  SignedIndex count_ = 0;
};

/// Collects rings, and puts them in order.
class Rings {
 public:
  explicit Rings(Shape& shape) : shape_(shape), place_(shape.num_rows(), -1) {}

  /// The rings of the walk that begins with edge `first`; marks its edges.
  void walk(std::size_t first, std::vector<unsigned char>& is_done) {
    const Index owner = shape_.body_of(first);
    std::size_t edge = first;
    do {
      internal::cancellation_point();
      const SignedIndex row = shape_.facet(edge)[0];
      if (place_[static_cast<std::size_t>(row)] >= 0)
        cut_off(static_cast<std::size_t>(place_[static_cast<std::size_t>(row)]), owner);
      place_[static_cast<std::size_t>(row)] = static_cast<SignedIndex>(path_.size());
      path_.push_back(row);
      is_done[edge] = 1;
      edge = shape_.neighbor(edge, 0);
    } while (edge != first);
    cut_off(0, owner);
  }

  Polygons in_order() const {
    std::vector<const Ring*> outer(shape_.num_cells(), nullptr);
    for (const Ring& ring : rings_)
      if (ring.is_outer) outer[ring.owner] = &ring;
    struct Entry {
      const Ring *outer, *ring;
    };
    std::vector<Entry> entries;
    for (const Ring& ring : rings_) entries.push_back({outer[ring.owner], &ring});
    const auto rows = [&](const Ring* ring) { return std::span(rows_).subspan(ring->first, ring->size); };
    const auto compare = [&](const Ring* a, const Ring* b) {
      if (a == b) return std::strong_ordering::equal;
      const auto x = rows(a), y = rows(b);
      return std::lexicographical_compare_three_way(x.begin(), x.end(), y.begin(), y.end());
    };
    std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
      if (const auto by_polygon = compare(a.outer, b.outer); by_polygon != 0) return by_polygon < 0;
      if (a.ring->is_outer != b.ring->is_outer) return a.ring->is_outer;
      return compare(a.ring, b.ring) < 0;
    });
    Polygons result;
    for (const Entry& entry : entries) {
      internal::cancellation_point();
      if (entry.ring->is_outer && !result.rows.empty())
        result.polygon_offsets.push_back(static_cast<std::int64_t>(result.num_rings()));
      const auto of_ring = rows(entry.ring);
      result.rows.insert(result.rows.end(), of_ring.begin(), of_ring.end());
      result.ring_offsets.push_back(static_cast<std::int64_t>(result.rows.size()));
    }
    if (!entries.empty()) result.polygon_offsets.push_back(static_cast<std::int64_t>(result.num_rings()));
    return result;
  }

 private:
  struct Ring {
    Index owner;
    bool is_outer;
    std::size_t first, size;  // in rows_
  };

  /// Makes a ring of the path from `begin` on.
  void cut_off(std::size_t begin, Index owner) {
    const auto first = path_.begin() + static_cast<std::ptrdiff_t>(begin);
    for (auto i = first; i != path_.end(); ++i) place_[static_cast<std::size_t>(*i)] = -1;
    rings_.push_back({owner, is_counterclockwise(first), rows_.size(), path_.size() - begin});
    std::rotate_copy(first, std::min_element(first, path_.end()), path_.end(), std::back_inserter(rows_));
    path_.resize(begin);
  }

  /// At its lexicographically least point, which is a corner of its convex hull, a ring turns as it does as a
  /// whole.
  bool is_counterclockwise(std::vector<SignedIndex>::const_iterator first) const {
    const auto least = std::min_element(first, path_.cend(), [&](SignedIndex a, SignedIndex b) {
      return std::lexicographical_compare(shape_.point(a), shape_.point(a) + 2, shape_.point(b),
                                          shape_.point(b) + 2);
    });
    const double* const p = shape_.point(least == first ? path_.back() : *std::prev(least));
    const double* const q = shape_.point(*least);
    const double* const r = shape_.point(std::next(least) == path_.cend() ? *first : *std::next(least));
    return orientation(std::array{p[0], p[1], q[0], q[1], r[0], r[1]}, 2) == Sign::positive;
  }

  Shape& shape_;
  std::vector<SignedIndex> path_, place_;  // the present walk; by row, where it is there, or −1
  std::vector<SignedIndex> rows_;
  std::vector<Ring> rings_;
};

}  // namespace

BoundaryComponents boundary_components(const AlphaComplex& complex, const Execution& how) {
  return internal::guarded("the boundary of the alpha complex", [&] {
    const internal::ProgressMeter meter(how.progress);
    Shape shape(complex);
    const std::size_t count = shape.num_facets(), k = shape.dimension();
    BoundaryComponents result;
    result.neighbors.reserve(count * k);
    internal::UnionFind joined(count);
    for (std::size_t f = 0; f < count; ++f) {
      internal::cancellation_point();
      for (std::size_t i = 0; i < k; ++i) {
        const std::size_t across = shape.neighbor(f, i);
        result.neighbors.push_back(static_cast<SignedIndex>(across));
        joined.unite(static_cast<Index>(f), static_cast<Index>(across));
      }
    }
    Numbering component(count), owner(shape.num_cells());
    for (std::size_t f = 0; f < count; ++f) {
      const SignedIndex before = component.count();
      result.components.push_back(component(joined.root(static_cast<Index>(f))));
      if (component.count() > before) result.bodies.push_back(owner(shape.body_of(f)));
    }
    return result;
  });
}

Polygons polygons(const AlphaComplex& complex, const Execution& how) {
  if (complex.dimension() != 2)
    throw Error(Errc::unsupported, "polygons of an alpha complex in dimension " +
                                       std::to_string(complex.dimension()) + "; they are for the plane");
  if (complex.affine_dimension() < 2) return {};
  return internal::guarded("the polygons of the alpha complex", [&] {
    const internal::ProgressMeter meter(how.progress);
    Shape shape(complex);
    Rings rings(shape);
    std::vector<unsigned char> is_done(shape.num_facets(), 0);
    for (std::size_t edge = 0; edge < shape.num_facets(); ++edge)
      if (is_done[edge] == 0) rings.walk(edge, is_done);
    return rings.in_order();
  });
}

double optimal_alpha_value(const Triangulation& triangulation, std::optional<std::size_t> num_components,
                           const Execution& how) {
  internal::require_alpha(triangulation);
  if (num_components == 0) throw Error(Errc::invalid_argument, "an alpha complex of no component");
  const int k = triangulation.affine_dimension();
  if (k < 0) return -std::numeric_limits<double>::infinity();
  return internal::guarded("the alpha values", [&] {
    const internal::ProgressMeter meter(how.progress);
    const std::vector<double> values = alpha_values(triangulation, k, how).values;
    const ComplexData data = triangulation.to_data(false);
    const std::size_t corners = static_cast<std::size_t>(k) + 1;
    internal::QuickRounds round;
    std::vector<double> of_row;  // from which value on a cell contains the vertex
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    of_row.assign(static_cast<std::size_t>(*std::max_element(data.cells.begin(), data.cells.end())) + 1,
                  none);
    for (std::size_t i = 0; i < data.cells.size(); ++i) {
      round();
      double& value = of_row[static_cast<std::size_t>(data.cells[i])];
      if (!(value <= values[i / corners])) value = values[i / corners];
    }
    double covering = -std::numeric_limits<double>::infinity();
    for (const double value : of_row)
      if (value > covering) covering = value;
    if (!num_components) return covering;

    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      round();
      return values[a] < values[b];
    });
    internal::UnionFind joined(values.size());
    std::vector<unsigned char> is_in(values.size(), 0);
    std::size_t count = 0;
    for (std::size_t i = 0;; ++i) {
      round();
      const std::size_t cell = order[i];
      is_in[cell] = 1;
      ++count;
      for (std::size_t m = 0; m < corners; ++m) {
        const SignedIndex across = data.neighbors[cell * corners + m];
        if (across < 0 || is_in[static_cast<std::size_t>(across)] == 0) continue;
        const Index a = joined.root(static_cast<Index>(cell)), b = joined.root(static_cast<Index>(across));
        if (a == b) continue;
        joined.unite(a, b);
        --count;
      }
      const bool is_last = i + 1 == order.size();  // all cells: the convex hull, which is one body
      if (is_last ||
          (values[order[i + 1]] > values[cell] && values[cell] >= covering && count <= *num_components))
        return values[cell];
    }
  });
}

}  // namespace delone
