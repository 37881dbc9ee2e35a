// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/cell_classes.hpp"

#include "base/quick_rounds.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>

namespace delone::periodic {

namespace {

VertexId smallest_vertex(const GhostTriangulation& ghosts, const Complex& complex, CellId cell) {
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
    const VertexId smallest = smallest_vertex(ghosts, complex, cell);
    if (!ghosts.is_own(smallest)) continue;
    canonical.number_of_slot[slot] = static_cast<SignedIndex>(canonical.cells.size());
    canonical.cells.push_back(cell);
    canonical.smallest.push_back(smallest);
  }
  return canonical;
}

CellClasses::CellClasses(const GhostTriangulation& ghosts, const PeriodicSet& set)
    : ghosts_(ghosts),
      complex_(ghosts.triangulation().complex()),
      canonical_(find_canonical_cells(ghosts)),
      r_(set.rank),
      corners_(static_cast<std::size_t>(complex_.affine_dimension() + 1)),
      first_of_row_(set.num_points() + 1, 0),
      by_row_(canonical_.cells.size()) {
  for (std::size_t number = 0; number < by_row_.size(); ++number)
    ++first_of_row_[row_of_smallest(number) + 1];
  for (std::size_t row = 1; row < first_of_row_.size(); ++row) first_of_row_[row] += first_of_row_[row - 1];
  std::vector<std::size_t> next(first_of_row_.begin(), first_of_row_.end() - 1);
  for (std::size_t number = 0; number < by_row_.size(); ++number)
    by_row_[next[row_of_smallest(number)]++] = number;
}

bool CellClasses::has_own(CellId cell) const {
  return std::ranges::any_of(complex_.vertices(cell), [&](VertexId v) { return ghosts_.is_own(v); });
}

bool CellClasses::has_moved(CellId cell, VertexId v, const Offset& offset) const {
  return std::ranges::any_of(complex_.vertices(cell),
                             [&](VertexId w) { return w != infinite_vertex && is_moved(w, v, offset); });
}

bool CellClasses::is_moved(VertexId w, VertexId v, const Offset& offset) const {
  const auto of_w = ghosts_.offset_of(w), of_v = ghosts_.offset_of(v);
  if (ghosts_.image_of(w).row != ghosts_.image_of(v).row) return false;
  for (std::size_t l = 0; l < r_; ++l)
    if (of_w[l] != of_v[l] - offset[l]) return false;
  return true;
}

Translate CellClasses::find_class(CellId cell) const {
  if (complex_.is_infinite(cell)) return {-1, Offset(r_)};
  if (const SignedIndex number = canonical_.number_of_slot[index(cell)]; number >= 0)
    return {number, Offset(r_)};
  const VertexId smallest = smallest_vertex(ghosts_, complex_, cell);
  const Offset moved = offset_of(smallest);
  const std::uint32_t row = ghosts_.image_of(smallest).row;
  for (std::size_t at = first_of_row_[row]; at < first_of_row_[row + 1]; ++at) {
    const CellId candidate = canonical_.cells[by_row_[at]];
    if (std::ranges::all_of(complex_.vertices(cell),
                            [&](VertexId v) { return has_moved(candidate, v, moved); }))
      return {static_cast<SignedIndex>(by_row_[at]), moved};
  }
  return {-1, moved};
}

Translate CellClasses::find_neighbor(CellId cell, int i) const {
  const VerticesOfCell vertices = complex_.vertices(cell);
  if (corners_ == 1) return {-1, Offset(r_)};
  for (std::size_t l = 0; l < corners_; ++l)
    if (l != static_cast<std::size_t>(i) && ghosts_.is_own(vertices[l]))
      return find_class(complex_.neighbor(cell, i));
  // No vertex of the facet is in the box: the same facet at a translate of one that is.
  const VertexId first = vertices[i == 0 ? 1 : 0];
  const Offset moved = offset_of(first);
  for (const CellId other : complex_.star(own_vertex(first))) {
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

}  // namespace delone::periodic
