// SPDX-License-Identifier: BSD-3-Clause
// Traversals of the read-only complex: stars, links, faces. Nothing is written to the complex, so that any
// number of threads may traverse it; sets of visited cells are local.
#include <delone/complex.hpp>

#include "base/compiler.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <bit>

namespace delone {

namespace {

// A set of cells in open addressing, for walks whose size is not known beforehand.
class CellSet {
 public:
  // True if the cell was not in the set.
  bool insert(CellId cell) {
    if (2 * (size_ + 1) > table_.size()) grow();
    const bool is_new = place(cell);
    size_ += is_new;
    return is_new;
  }

 private:
  bool place(CellId cell) {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = (static_cast<std::uint64_t>(index(cell)) * 0x9e3779b97f4a7c15u >> 20) & mask;
    for (; table_[at] != invalid_cell; at = (at + 1) & mask)
      if (table_[at] == cell) return false;
    table_[at] = cell;
    return true;
  }
  void grow() {
    std::vector<CellId> old(std::max<std::size_t>(64, 2 * table_.size()), invalid_cell);
    old.swap(table_);
    for (const CellId cell : old)
      if (cell != invalid_cell) place(cell);
  }

  std::vector<CellId> table_;
  std::size_t size_ = 0;
};

}  // namespace

std::vector<VertexId> Complex::finite_vertices() const {
  std::vector<VertexId> result;
  result.reserve(num_finite_vertices_);
  for (Index v = 1; v < num_vertex_slots_; ++v)
    if (is_vertex(VertexId{v})) result.push_back(VertexId{v});
  return result;
}

std::vector<CellId> Complex::star(VertexId v) const {
  std::vector<CellId> cells;
  if (dimension_ < 0) return cells;
  if (DELONE_HARDENED && !is_vertex(v)) detail::throw_out_of_range("the id of a vertex");
  CellSet visited;
  cells.push_back(incident_cell(v));
  visited.insert(cells.front());
  // The star of a vertex of a sphere is connected through facets that contain the vertex.
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const CellId c = cells[next];
    for (int i = 0; i <= dimension_; ++i)
      if (vertex(c, i) != v && visited.insert(neighbor(c, i))) cells.push_back(neighbor(c, i));
  }
  return cells;
}

std::vector<Facet> Complex::link(VertexId v) const {
  std::vector<Facet> facets;
  for (const CellId c : star(v)) facets.push_back({c, index_of(c, v)});
  return facets;
}

void Complex::prefetch(CellId c) const { internal::prefetch(row(c)); }

std::vector<VertexId> Complex::adjacent_vertices(VertexId v) const {
  std::vector<VertexId> result;
  for (const CellId c : star(v))
    for (int i = 0; i <= dimension_; ++i)
      if (vertex(c, i) != v && !is_infinite(vertex(c, i))) result.push_back(vertex(c, i));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Facet> Complex::facets(bool with_infinite) const {
  std::vector<Facet> result;
  for (const CellId c : all_cells()) {
    const int infinite = infinite_index(c);
    if (infinite >= 0 && !with_infinite) continue;
    for (int i = 0; i <= dimension_; ++i) {
      const CellId other = neighbor(c, i);
      // A hull facet is named by its finite cell, any other facet by the lower of its two cells.
      if (infinite == i) continue;
      if (c < other || (infinite < 0 && is_infinite(other))) result.push_back({c, i});
    }
  }
  return result;
}

std::vector<Facet> Complex::hull_facets() const {
  std::vector<Facet> result;
  result.reserve(num_infinite_cells_);
  for (const CellId c : infinite_cells()) {
    const int i = infinite_index(c);
    result.push_back({neighbor(c, i), mirror_index(c, i)});
  }
  return result;
}

std::vector<VertexId> Complex::faces(int j) const {
  if (j < 0 || j > dimension_)
    throw Error(Errc::invalid_argument, "delone::Complex::faces: dimension " + std::to_string(j) +
                                            " is outside 0…" + std::to_string(dimension_));
  const std::size_t width = static_cast<std::size_t>(j);  // vertices of a face after its lowest

  // Visits the faces of every finite cell as increasing rows, combinations of its sorted vertices in
  // lexicographic order.
  const auto for_each_face = [&](auto&& visit) {
    std::vector<VertexId> sorted, face(width + 1);
    std::vector<std::size_t> choice(width + 1);
    for (const CellId c : finite_cells()) {
      const VerticesOfCell all = vertices(c);
      sorted.assign(all.begin(), all.end());
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t i = 0; i <= width; ++i) choice[i] = i;
      while (true) {
        for (std::size_t i = 0; i <= width; ++i) face[i] = sorted[choice[i]];
        visit(face);
        std::size_t i = width + 1;
        while (i > 0 && choice[i - 1] == sorted.size() - (width + 1) + (i - 1)) --i;
        if (i == 0) break;
        ++choice[i - 1];
        for (; i <= width; ++i) choice[i] = choice[i - 1] + 1;
      }
    }
  };

  // Faces are first spread over their lowest vertices; what is left to sort is small and close together in
  // memory.
  std::vector<std::size_t> end_of(static_cast<std::size_t>(num_vertex_slots_) + 1, 0);
  for_each_face([&](const std::vector<VertexId>& face) { ++end_of[index(face[0]) + 1]; });
  for (std::size_t v = 1; v < end_of.size(); ++v) end_of[v] += end_of[v - 1];
  std::vector<VertexId> rest(end_of.back() * width);
  std::vector<std::size_t> next(end_of.begin(), end_of.end() - 1);
  for_each_face([&](const std::vector<VertexId>& face) {
    std::copy(face.begin() + 1, face.end(),
              rest.begin() + static_cast<std::ptrdiff_t>(width * next[index(face[0])]++));
  });

  std::vector<VertexId> result;
  std::vector<const VertexId*> rows;
  for (std::size_t v = 1; v + 1 < end_of.size(); ++v) {
    rows.clear();
    for (std::size_t at = end_of[v]; at < end_of[v + 1]; ++at) rows.push_back(rest.data() + at * width);
    std::sort(rows.begin(), rows.end(), [width](const VertexId* a, const VertexId* b) {
      return std::lexicographical_compare(a, a + width, b, b + width);
    });
    const auto last = std::unique(rows.begin(), rows.end(), [width](const VertexId* a, const VertexId* b) {
      return std::equal(a, a + width, b);
    });
    for (auto row = rows.begin(); row != last; ++row) {
      result.push_back(VertexId{static_cast<Index>(v)});
      result.insert(result.end(), *row, *row + width);
    }
  }
  return result;
}

}  // namespace delone
