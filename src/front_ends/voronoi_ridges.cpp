// SPDX-License-Identifier: BSD-3-Clause
// Ridges: the duals of edges, and which edges have one. Where no two cells share a sphere every edge has.
#include "front_ends/voronoi_builder.hpp"

#include <delone/predicates.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace delone {

void VoronoiBuilder::add_ridge(VertexId s, VertexId t, std::span<const SignedIndex> vertices) {
  out_.ridge_points_.push_back(std::min(row_of(s), row_of(t)));
  out_.ridge_points_.push_back(std::max(row_of(s), row_of(t)));
  out_.ridge_vertices_.insert(out_.ridge_vertices_.end(), vertices.begin(), vertices.end());
  out_.ridge_offsets_.push_back(static_cast<std::int64_t>(out_.ridge_vertices_.size()));
}

void VoronoiBuilder::collect_ridges() {
  if (k_ == 1)
    for (const CellId c : cells_)
      if (vertex_of_cell_[index(c)] >= 0)
        add_ridge(complex_.vertex(c, 0), complex_.vertex(c, 1), {&vertex_of_cell_[index(c)], 1});
  if (k_ == 2) collect_ridges_in_plane();
  if (k_ == 3) collect_ridges_in_space();
  if (k_ > 3) collect_ridges_by_region();
}

void VoronoiBuilder::collect_ridges_in_plane() {
  for (const CellId c : cells_)
    for (int i = 0; i < 3; ++i) {
      const CellId other = complex_.neighbor(c, i);
      const VertexId s = complex_.vertex(c, (i + 1) % 3), t = complex_.vertex(c, (i + 2) % 3);
      if (index(other) < index(c) || s == infinite_vertex || t == infinite_vertex) continue;
      if (root(index(c)) == root(index(other))) continue;
      std::array<SignedIndex, 2> ends{vertex_of_cell_[index(c)], vertex_of_cell_[index(other)]};
      if (ends[1] < 0) std::swap(ends[0], ends[1]);
      add_ridge(s, t, ends);
    }
}

/// k = 3: the cells around an edge in cyclic order, from the one with the smallest slot. The dual is a polygon if these are of
/// at least three classes; classes are met in one run each, as they are faces of a convex polygon's boundary.
void VoronoiBuilder::collect_ridges_in_space() {
  // An edge by its corners, and the other two corners such that the four are an even permutation.
  constexpr int edges[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  std::vector<Index> ring;
  std::vector<SignedIndex> vertices;
  for (const CellId c : cells_) {
    for (const auto& edge : edges) {
      VertexId s = complex_.vertex(c, edge[0]), t = complex_.vertex(c, edge[1]);
      if (s == infinite_vertex || t == infinite_vertex) continue;
      // Most edges are seen first from another cell, which the two cells beside this one tell without a walk.
      if (index(complex_.neighbor(c, edge[2])) < index(c) || index(complex_.neighbor(c, edge[3])) < index(c)) continue;
      int leave = edge[2];
      VertexId pivot = complex_.vertex(c, edge[3]);
      if (row_of(s) > row_of(t)) {  // counterclockwise about the direction from the smaller to the larger
        std::swap(s, t);
        leave = edge[3];
        pivot = complex_.vertex(c, edge[2]);
      }
      ring.assign(1, index(c));
      CellId at = complex_.neighbor(c, leave);
      for (; index(at) > index(c); at = complex_.neighbor(at, leave)) {
        ring.push_back(index(at));
        VertexId fresh = infinite_vertex;
        for (int i = 0; i < 4; ++i) {
          const VertexId v = complex_.vertex(at, i);
          if (v == pivot)
            leave = i;
          else if (v != s && v != t)
            fresh = v;
        }
        pivot = fresh;
      }
      if (at != c) continue;  // seen from another cell
      if (has_merged_) {
        for (Index& cell : ring) cell = root(cell);
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        if (ring.size() < 3) continue;
      }
      vertices.clear();
      for (const Index cell : ring)
        if (vertices.empty() || vertices.back() != -1 || vertex_of_cell_[cell] != -1) vertices.push_back(vertex_of_cell_[cell]);
      if (vertices.front() == -1 && vertices.back() == -1) vertices.pop_back();
      const auto infinity = std::find(vertices.begin(), vertices.end(), -1);
      if (infinity != vertices.end()) std::rotate(vertices.begin(), infinity, vertices.end());
      add_ridge(s, t, vertices);
    }
  }
}

/// k > 3: the cells of each region, sorted by the other regions they belong to.
void VoronoiBuilder::collect_ridges_by_region() {
  const auto corners = static_cast<std::size_t>(k_) + 1;
  std::vector<std::size_t> offsets(site_of_region_.size() + 1, 0);
  const auto for_each_corner = [&](auto&& visit) {
    for (const CellId c : complex_.cells())
      for (std::size_t i = 0; i < corners; ++i)
        if (const VertexId v = complex_.vertex(c, static_cast<int>(i)); v != infinite_vertex)
          visit(static_cast<std::size_t>(region_of(v)), c);
  };
  for_each_corner([&](std::size_t r, CellId) { ++offsets[r + 1]; });
  for (std::size_t r = 0; r < site_of_region_.size(); ++r) offsets[r + 1] += offsets[r];
  std::vector<Index> cells(offsets.back());
  std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
  for_each_corner([&](std::size_t r, CellId c) { cells[next[r]++] = index(c); });

  std::vector<std::pair<SignedIndex, Index>> entries;  // another region, a cell of both
  std::vector<Index> star;
  std::vector<SignedIndex> vertices;
  for (std::size_t r = 0; r < site_of_region_.size(); ++r) {
    entries.clear();
    for (std::size_t e = offsets[r]; e < offsets[r + 1]; ++e)
      for (std::size_t i = 0; i < corners; ++i) {
        const VertexId v = complex_.vertex(CellId{cells[e]}, static_cast<int>(i));
        if (v != infinite_vertex && region_of(v) > static_cast<SignedIndex>(r)) entries.emplace_back(region_of(v), cells[e]);
      }
    std::sort(entries.begin(), entries.end());
    for (std::size_t first = 0, last = 0; first < entries.size(); first = last) {
      star.clear();
      vertices.clear();
      for (; last < entries.size() && entries[last].first == entries[first].first; ++last) {
        star.push_back(entries[last].second);
        vertices.push_back(vertex_of_cell_[star.back()]);
      }
      const VertexId s = site_of_region_[r], t = site_of_region_[static_cast<std::size_t>(entries[first].first)];
      if (has_merged_ && !is_ridge(s, t, star)) continue;
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      add_ridge(s, t, vertices);
    }
  }
}

/// The finite vertices of the cells of a class, sorted.
std::span<const VertexId> VoronoiBuilder::class_vertices(Index root, std::vector<VertexId>& storage) const {
  if (const auto found = sites_of_class_.find(root); found != sites_of_class_.end()) return found->second;
  storage.clear();
  for (const VertexId v : complex_.vertices(CellId{root}))
    if (v != infinite_vertex) storage.push_back(v);
  std::sort(storage.begin(), storage.end());
  return storage;
}

bool VoronoiBuilder::is_ridge(VertexId s, VertexId t, std::span<const Index> star) {
  if (sites_of_class_.empty()) {
    for (const CellId c : complex_.cells())
      if (root(index(c)) != index(c)) sites_of_class_[root(index(c))];
    for (const CellId c : complex_.cells())
      if (const auto found = sites_of_class_.find(root(index(c))); found != sites_of_class_.end())
        for (const VertexId v : complex_.vertices(c))
          if (v != infinite_vertex) found->second.push_back(v);
    for (auto& [unused, sites] : sites_of_class_) {
      std::sort(sites.begin(), sites.end());
      sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    }
  }
  std::vector<VertexId> common, kept, storage;
  bool is_first = true;
  for (const Index cell : star) {
    const auto sites = class_vertices(root(cell), storage);
    if (is_first) {
      common.assign(sites.begin(), sites.end());
    } else {
      kept.clear();
      std::set_intersection(common.begin(), common.end(), sites.begin(), sites.end(), std::back_inserter(kept));
      common.swap(kept);
    }
    is_first = false;
    if (common.size() == 2) return true;
  }
  // Sites between s and t in a power diagram may have regions without interior, which coincide with the ridge.
  for (const VertexId v : common) {
    if (v == s || v == t) continue;
    std::vector<double> three;
    for (const VertexId w : {s, t, v}) three.insert(three.end(), point(w), point(w) + d_);
    if (affine_dimension(three, static_cast<int>(d_)) > 1) return false;
  }
  return true;
}

}  // namespace delone
