// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/quotient.hpp"

#include "base/quick_rounds.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>

namespace delone::periodic {

namespace {

using Offset = std::vector<std::int64_t>;

/// A cell that is the translate of a canonical one, or outside.
struct Translate {
  SignedIndex number = -1;
  Offset offset;
};

class QuotientMaker {
 public:
  QuotientMaker(const GhostTriangulation& ghosts, const PeriodicSet& set)
      : ghosts_(ghosts),
        set_(set),
        complex_(ghosts.triangulation().complex()),
        canonical_(find_canonical_cells(ghosts)),
        has_wraps_(std::ranges::any_of(set.wraps, [](std::int32_t k) { return k != 0; })),
        r_(set.rank),
        corners_(static_cast<std::size_t>(complex_.affine_dimension() + 1)) {}

  Quotient make() {
    sort_by_rows();
    const std::size_t entries = canonical_.cells.size() * corners_;
    made_.cells.reserve(entries);
    made_.neighbors.reserve(entries);
    made_.cell_offsets.resize(entries * r_);
    made_.neighbor_offsets.resize(entries * r_);
    internal::QuickRounds round;
    Offset offset(r_);
    for (std::size_t number = 0; number < canonical_.cells.size(); ++number) {
      round();
      const CellId cell = canonical_.cells[number];
      const std::uint32_t smallest = row_of_smallest(number);
      for (std::size_t i = 0; i < corners_; ++i) {
        const VertexId v = complex_.vertex(cell, static_cast<int>(i));
        const Image& image = ghosts_.image_of(v);
        if (image.shift != 0 || !is_wrapped_alike(image.row, smallest)) {
          for (std::size_t l = 0; l < r_; ++l)
            offset[l] = std::int64_t{ghosts_.offset_of(v)[l]} - wrap(image.row, l) + wrap(smallest, l);
          set_.to_given_basis(offset, made_.cell_offsets.data() + made_.cells.size() * r_);
        }
        made_.cells.push_back(static_cast<SignedIndex>(image.row));
        add_neighbor(cell, i, smallest);
      }
    }
    return std::move(made_);
  }

 private:
  std::uint32_t row_of_smallest(std::size_t number) const {
    return ghosts_.image_of(canonical_.smallest[number]).row;
  }

  void add_neighbor(CellId cell, std::size_t i, std::uint32_t smallest) {
    std::int32_t* const to = made_.neighbor_offsets.data() + made_.neighbors.size() * r_;
    const SignedIndex inner = find_inner_neighbor(cell, i);
    Translate neighbor;
    if (inner < 0) neighbor = find_neighbor(cell, static_cast<int>(i));
    const SignedIndex number = inner < 0 ? neighbor.number : inner;
    made_.neighbors.push_back(number);
    if (number < 0) return;
    const std::uint32_t of_neighbor = row_of_smallest(static_cast<std::size_t>(number));
    if (inner >= 0 && is_wrapped_alike(of_neighbor, smallest)) return;
    neighbor.offset.resize(r_);
    for (std::size_t l = 0; l < r_; ++l) neighbor.offset[l] += wrap(smallest, l) - wrap(of_neighbor, l);
    set_.to_given_basis(neighbor.offset, to);
  }
  /// The neighbor across a facet with a vertex in the box, if it is canonical: then it is next to the cell as
  /// it is. −1 otherwise.
  SignedIndex find_inner_neighbor(CellId cell, std::size_t i) const {
    const VerticesOfCell vertices = complex_.vertices(cell);
    for (std::size_t l = 0; l < corners_; ++l)
      if (l != i && ghosts_.is_own(vertices[l]))
        return canonical_.number_of_slot[index(complex_.neighbor(cell, static_cast<int>(i)))];
    return -1;
  }
  bool is_wrapped_alike(std::uint32_t a, std::uint32_t b) const {
    if (!has_wraps_ || a == b) return true;
    const auto first = [&](std::uint32_t row) {
      return set_.wraps.begin() + static_cast<std::ptrdiff_t>(row * r_);
    };
    return std::equal(first(a), first(a) + static_cast<std::ptrdiff_t>(r_), first(b));
  }
  std::int64_t wrap(std::uint32_t row, std::size_t l) const { return set_.wraps[row * r_ + l]; }

  /// The numbers of cells by the rows of their smallest vertices.
  void sort_by_rows() {
    first_of_row_.assign(set_.num_points() + 1, 0);
    for (const VertexId v : canonical_.smallest) ++first_of_row_[ghosts_.image_of(v).row + 1];
    for (std::size_t row = 1; row < first_of_row_.size(); ++row) first_of_row_[row] += first_of_row_[row - 1];
    by_row_.resize(canonical_.cells.size());
    std::vector<std::size_t> next(first_of_row_.begin(), first_of_row_.end() - 1);
    for (std::size_t number = 0; number < canonical_.cells.size(); ++number)
      by_row_[next[ghosts_.image_of(canonical_.smallest[number]).row]++] = number;
  }

  /// Whether a cell has the vertex v translated by −offset.
  bool has_moved(CellId cell, VertexId v, const Offset& offset) const {
    return std::ranges::any_of(complex_.vertices(cell),
                               [&](VertexId w) { return w != infinite_vertex && is_moved(w, v, offset); });
  }
  bool is_moved(VertexId w, VertexId v, const Offset& offset) const {
    const auto of_w = ghosts_.offset_of(w), of_v = ghosts_.offset_of(v);
    if (ghosts_.image_of(w).row != ghosts_.image_of(v).row) return false;
    for (std::size_t l = 0; l < r_; ++l)
      if (of_w[l] != of_v[l] - offset[l]) return false;
    return true;
  }
  Offset offset(VertexId v) const {
    const auto of_v = ghosts_.offset_of(v);
    return {of_v.begin(), of_v.end()};
  }

  /// Of a cell with a vertex in the box.
  Translate find_class(CellId cell) const {
    if (complex_.is_infinite(cell)) return {-1, Offset(r_)};
    if (const SignedIndex number = canonical_.number_of_slot[index(cell)]; number >= 0)
      return {number, Offset(r_)};
    const VertexId smallest = smallest_vertex(ghosts_, complex_, cell);
    const Offset moved = offset(smallest);
    const std::uint32_t row = ghosts_.image_of(smallest).row;
    for (std::size_t at = first_of_row_[row]; at < first_of_row_[row + 1]; ++at) {
      const CellId candidate = canonical_.cells[by_row_[at]];
      if (std::ranges::all_of(complex_.vertices(cell),
                              [&](VertexId v) { return has_moved(candidate, v, moved); }))
        return {static_cast<SignedIndex>(by_row_[at]), moved};
    }
    return {-1, moved};
  }

  Translate find_neighbor(CellId cell, int i) const {
    const VerticesOfCell vertices = complex_.vertices(cell);
    if (corners_ == 1) return {-1, Offset(r_)};
    for (std::size_t l = 0; l < corners_; ++l)
      if (l != static_cast<std::size_t>(i) && ghosts_.is_own(vertices[l]))
        return find_class(complex_.neighbor(cell, i));
    // No vertex of the facet is in the box: the same facet at a translate of one that is.
    const VertexId first = vertices[i == 0 ? 1 : 0];
    const Offset moved = offset(first);
    const VertexId own = ghosts_.triangulation().vertex_at(ghosts_.image_of(first).row);
    for (const CellId other : complex_.star(own)) {
      const bool has_facet = [&] {
        for (std::size_t l = 0; l < corners_; ++l)
          if (l != static_cast<std::size_t>(i) && !has_moved(other, vertices[l], moved)) return false;
        return true;
      }();
      if (!has_facet || has_moved(other, vertices[static_cast<std::size_t>(i)], moved)) continue;
      Translate found = find_class(other);
      for (std::size_t l = 0; l < r_; ++l) found.offset[l] += moved[l];
      return found;
    }
    return {-1, Offset(r_)};
  }

 public:
  static VertexId smallest_vertex(const GhostTriangulation& ghosts, const Complex& complex, CellId cell) {
    const auto& points = triangulation::StoredPoints::of(ghosts.triangulation());
    const auto d = static_cast<std::ptrdiff_t>(points.ambient);
    VertexId smallest = complex.vertex(cell, 0);
    const double* least = points.point(index(smallest));
    for (const VertexId v : complex.vertices(cell)) {
      const double* const x = points.point(index(v));
      if (*x > *least || v == smallest) continue;
      if (*x == *least && !std::lexicographical_compare(x, x + d, least, least + d)) continue;
      smallest = v;
      least = x;
    }
    return smallest;
  }

 private:
  const GhostTriangulation& ghosts_;
  const PeriodicSet& set_;
  const Complex complex_;
  const CanonicalCells canonical_;
  const bool has_wraps_;
  const std::size_t r_, corners_;
  std::vector<std::size_t> first_of_row_, by_row_;
  Quotient made_;
};

}  // namespace

CanonicalCells find_canonical_cells(const GhostTriangulation& ghosts) {
  CanonicalCells canonical;
  const Complex complex = ghosts.triangulation().complex();
  canonical.number_of_slot.assign(complex.num_cell_slots(), -1);
  internal::QuickRounds round;
  for (std::size_t slot = 0; slot < complex.num_cell_slots(); ++slot) {
    round();
    const CellId cell{static_cast<Index>(slot)};
    if (!complex.is_cell(cell)) continue;
    const VerticesOfCell vertices = complex.vertices(cell);
    if (std::ranges::find(vertices, infinite_vertex) != vertices.end() ||
        std::ranges::none_of(vertices, [&](VertexId v) { return ghosts.is_own(v); }))
      continue;
    const VertexId smallest = QuotientMaker::smallest_vertex(ghosts, complex, cell);
    if (!ghosts.is_own(smallest)) continue;
    canonical.number_of_slot[slot] = static_cast<SignedIndex>(canonical.cells.size());
    canonical.cells.push_back(cell);
    canonical.smallest.push_back(smallest);
  }
  return canonical;
}

Quotient make_quotient(const GhostTriangulation& ghosts, const PeriodicSet& set) {
  if (ghosts.triangulation().complex().affine_dimension() < 0) return {};
  return QuotientMaker(ghosts, set).make();
}

bool is_simplicial(const GhostTriangulation& ghosts) {
  const Complex complex = ghosts.triangulation().complex();
  internal::QuickRounds round;
  std::vector<std::uint32_t> rows;
  for (std::size_t id = 1; id < complex.num_vertex_slots(); ++id) {
    const VertexId v{static_cast<Index>(id)};
    if (!complex.is_vertex(v) || !ghosts.is_own(v)) continue;
    round();
    rows.assign(1, ghosts.image_of(v).row);
    bool has_ghost = false;
    for (const VertexId w : complex.adjacent_vertices(v)) {
      rows.push_back(ghosts.image_of(w).row);
      has_ghost = has_ghost || !ghosts.is_own(w);
    }
    if (!has_ghost) continue;
    std::sort(rows.begin(), rows.end());
    if (std::adjacent_find(rows.begin(), rows.end()) != rows.end()) return false;
  }
  return true;
}

}  // namespace delone::periodic
