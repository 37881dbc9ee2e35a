// SPDX-License-Identifier: BSD-3-Clause
// Ridges, the duals of edges. If no two cells share a sphere, every edge has a ridge; otherwise is_ridge()
// decides.
#include "base/compiler.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/spread.hpp"
#include "voronoi/voronoi_builder.hpp"

#include <delone/predicates.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace delone::voronoi {

void VoronoiBuilder::add_ridge(VertexId s, VertexId t, std::span<const SignedIndex> vertices) {
  round_();
  out_.ridge_points_.push_back(std::min(row_of(s), row_of(t)));
  out_.ridge_points_.push_back(std::max(row_of(s), row_of(t)));
  out_.ridge_vertices_.insert(out_.ridge_vertices_.end(), vertices.begin(), vertices.end());
  out_.ridge_offsets_.push_back(static_cast<std::int64_t>(out_.ridge_vertices_.size()));
}

/// Calls work(first, last, add) for parts of 0 … size − 1, where add(s, t, vertices) adds a ridge, in the
/// threads of the diagram, each with its own work = make_work(). Ridges are in the order of the parts. One
/// part and thread if cells have merged: classes are not for several threads.
template <class MakeWork>
void VoronoiBuilder::collect_in_parts(std::size_t size, MakeWork make_work) {
  constexpr std::size_t part = 256;
  const std::size_t num_parts = (size + part - 1) / part;
  const unsigned threads = has_merged_ ? 1 : internal::threads_for_parts(threads_, num_parts);
  if (threads == 1) {
    auto work = make_work();
    work(std::size_t{0}, size,
         [&](VertexId s, VertexId t, std::span<const SignedIndex> vertices) { add_ridge(s, t, vertices); });
    return;
  }
  struct Ridges {
    std::vector<SignedIndex> points, vertices;
    std::vector<std::int64_t> sizes;
    std::size_t first = 0, first_vertex = 0;
  };
  std::vector<Ridges> lists(num_parts);
  internal::work_in_parts(threads, size, part, [&] {
    return [&, work = make_work()](std::size_t first, std::size_t last,
                                   const internal::StopPoint& stop) mutable {
      stop();
      Ridges& list = lists[first / part];
      work(first, last, [&](VertexId s, VertexId t, std::span<const SignedIndex> vertices) {
        list.points.push_back(std::min(row_of(s), row_of(t)));
        list.points.push_back(std::max(row_of(s), row_of(t)));
        list.vertices.insert(list.vertices.end(), vertices.begin(), vertices.end());
        list.sizes.push_back(static_cast<std::int64_t>(vertices.size()));
      });
    };
  });
  std::size_t count = 0, entries = 0;
  for (Ridges& list : lists) {
    list.first = std::exchange(count, count + list.sizes.size());
    list.first_vertex = std::exchange(entries, entries + list.vertices.size());
  }
  out_.ridge_points_.resize(2 * count);
  out_.ridge_vertices_.resize(entries);
  out_.ridge_offsets_.assign(count + 1, 0);
  internal::for_parts(threads, num_parts, 1, [&](std::size_t p, std::size_t, const internal::StopPoint&) {
    Ridges& list = lists[p];
    std::copy(list.points.begin(), list.points.end(), out_.ridge_points_.data() + 2 * list.first);
    std::copy(list.vertices.begin(), list.vertices.end(), out_.ridge_vertices_.data() + list.first_vertex);
    auto end = static_cast<std::int64_t>(list.first_vertex);
    for (std::size_t i = 0; i < list.sizes.size(); ++i)
      out_.ridge_offsets_[list.first + i + 1] = end += list.sizes[i];
    list = {};
  });
}

void VoronoiBuilder::collect_ridges() {
  if (k_ == 1)
    for (const CellId c : cells_)
      add_ridge(complex_.vertex(c, 0), complex_.vertex(c, 1), {&vertex_of_cell_[index(c)], 1});
  if (k_ == 2) collect_ridges_in_plane();
  if (k_ == 3) collect_ridges_in_space();
  if (k_ > 3) collect_ridges_by_region();
}

void VoronoiBuilder::collect_ridges_in_plane() {
  collect_in_parts(cells_.size(), [&] {
    return [&](std::size_t first, std::size_t last, auto&& add) {
      for (std::size_t place = first; place < last; ++place)
        for (int i = 0; i < 3; ++i) {
          const CellId c = cells_[place], other = complex_.neighbor(c, i);
          const VertexId s = complex_.vertex(c, (i + 1) % 3), t = complex_.vertex(c, (i + 2) % 3);
          if (index(other) < index(c) && vertex_of_cell_[index(other)] >= 0) continue;
          if (root(index(c)) == root(index(other))) continue;
          std::array<SignedIndex, 2> ends{vertex_of_cell_[index(c)], vertex_of_cell_[index(other)]};
          if (ends[1] < 0) std::swap(ends[0], ends[1]);
          add(s, t, ends);
        }
    };
  });
}

namespace {

/// The cells of a complex of dimension 3, stored in the order of their positions, which keeps walks in the
/// cache.
struct PlacedCell {
  Index vertices[4], neighbors[4];

  Index index_of(Index vertex) const {
    return (vertices[1] == vertex ? 1 : 0) + (vertices[2] == vertex ? 2 : 0) +
           (vertices[3] == vertex ? 3 : 0);
  }
};

/// The cells around the edge from corner a to corner b of a cell, counterclockwise around its direction.
void walk_around(const std::vector<PlacedCell>& cells, Index first, Index a, Index b,
                 std::vector<Index>& ring) {
  // Corners c and d such that (a, b, c, d) is an even permutation.
  constexpr Index others[4][4][2] = {{{0, 0}, {2, 3}, {3, 1}, {1, 2}},
                                     {{3, 2}, {0, 0}, {0, 3}, {2, 0}},
                                     {{1, 3}, {3, 0}, {0, 0}, {0, 1}},
                                     {{2, 1}, {0, 2}, {1, 0}, {0, 0}}};
  const PlacedCell& start = cells[first];
  const Index edge = start.vertices[a] ^ start.vertices[b];
  Index shared = start.vertices[others[a][b][1]];  // the third vertex of the facet just crossed
  ring.assign(1, first);
  for (Index at = start.neighbors[others[a][b][0]]; at != first;) {
    ring.push_back(at);
    const PlacedCell& cell = cells[at];
    at = cell.neighbors[cell.index_of(shared)];
    shared ^= edge ^ cell.vertices[0] ^ cell.vertices[1] ^ cell.vertices[2] ^ cell.vertices[3];
  }
}

}  // namespace

/// k = 3: the cells around each edge in cyclic order, starting from the smaller vertex of the edge and the
/// first cell of both. The dual is a polygon if these cells belong to at least three classes. Each class is
/// one run of the cycle, because classes are faces of the boundary of a convex polytope.
void VoronoiBuilder::collect_ridges_in_space() {
  std::vector<CellId> order = cells_;  // finite cells, then infinite ones
  order.reserve(complex_.num_all_cells());
  for (const CellId c : complex_.infinite_cells()) order.push_back(c);
  std::vector<Index> place_of_cell(complex_.num_cell_slots());
  for (Index place = 0; place < order.size(); ++place) place_of_cell[index(order[place])] = place;
  std::vector<PlacedCell> cells(order.size());
  for (Index place = 0; place < order.size(); ++place)
    for (Index i = 0; i < 4; ++i) {
      const bool is_finite = place < cells_.size();
      const int corner = static_cast<int>(i);
      cells[place].vertices[i] =
          index(is_finite ? corners_[4 * place + i] : complex_.vertex(order[place], corner));
      const CellId neighbor = is_finite ? neighbors_[4 * place + i] : complex_.neighbor(order[place], corner);
      cells[place].neighbors[i] = place_of_cell[index(neighbor)];
    }
  place_of_cell = {};
  corners_ = {};
  neighbors_ = {};

  // A finite cell has six edges, an infinite one three finite ones; a triangulation of S³ has as many edges
  // as vertices and cells.
  out_.ridge_vertices_.reserve(6 * std::size_t{complex_.num_finite_cells()} +
                               3 * std::size_t{complex_.num_infinite_cells()});
  out_.ridge_points_.reserve(2 * (site_of_region_.size() + complex_.num_all_cells()));
  out_.ridge_offsets_.reserve(1 + site_of_region_.size() + complex_.num_all_cells());
  const auto make_work = [&] {
    // met, by vertex: the last s whose edge to it was visited
    return [&, met = std::vector<Index>(row_of_vertex_.size(), 0), ring = std::vector<Index>(),
            vertices = std::vector<SignedIndex>()](std::size_t begin, std::size_t end, auto&& add) mutable {
      for (auto s = static_cast<Index>(begin); s < end; ++s) {
        if (row_of_vertex_[s] < 0) continue;
        const auto region = static_cast<std::size_t>(region_of_vertex_[s]);
        for (const SignedIndex place : out_.region(region)) {
          if (place < 0) continue;
          const auto first = static_cast<Index>(place);
          for (Index b = 0; b < 4; ++b) {
            const Index t = cells[first].vertices[b];
            if (t <= s || met[t] == s) continue;
            met[t] = s;
            const Index a = cells[first].index_of(s);
            if (row_of_vertex_[s] < row_of_vertex_[t])
              walk_around(cells, first, a, b, ring);
            else
              walk_around(cells, first, b, a, ring);
            if (has_merged_) {
              const auto class_of = [&](Index cell) { return root(index(order[cell])); };
              const auto same_class = [&](Index p, Index q) { return class_of(p) == class_of(q); };
              ring.erase(std::unique(ring.begin(), ring.end(), same_class), ring.end());
              if (ring.size() > 1 && same_class(ring.front(), ring.back())) ring.pop_back();
              if (ring.size() < 3) continue;
            }
            vertices.clear();
            for (const Index cell : ring) {
              SignedIndex vertex = cell < cells_.size() ? static_cast<SignedIndex>(cell) : -1;
              if (has_merged_ && vertex >= 0) vertex = vertex_of_cell_[index(order[cell])];
              if (vertex >= 0 || vertices.empty() || vertices.back() >= 0) vertices.push_back(vertex);
            }
            if (!out_.bounded_[region]) {
              if (vertices.front() == -1 && vertices.back() == -1) vertices.pop_back();
              const auto infinity = std::find(vertices.begin(), vertices.end(), -1);
              if (infinity != vertices.end()) std::rotate(vertices.begin(), infinity, vertices.end());
            }
            add(VertexId{s}, VertexId{t}, vertices);
          }
        }
      }
    };
  };
  collect_in_parts(row_of_vertex_.size(), make_work);
  if (has_merged_) {
    out_.ridge_vertices_.shrink_to_fit();
    out_.ridge_points_.shrink_to_fit();
    out_.ridge_offsets_.shrink_to_fit();
  }
}

/// k > 3: distributes the cells of each region over the later regions that they belong to, by counting. The
/// corners of each cell are sorted, so the later regions are those that follow.
void VoronoiBuilder::collect_ridges_by_region() {
  const auto corners = static_cast<std::size_t>(k_) + 1;
  const std::size_t num_regions = site_of_region_.size();
  std::vector<CellId> order = cells_;  // finite cells, then infinite ones
  order.reserve(complex_.num_all_cells());
  for (const CellId c : complex_.infinite_cells()) order.push_back(c);
  std::vector<SignedIndex>& regions = out_.cell_regions_;  // of the corners of these; −1: the infinite vertex
  regions.reserve(order.size() * corners);
  for (const VertexId v : corners_) regions.push_back(region_of(v));
  for (const CellId c : complex_.infinite_cells())
    for (int i = 0; i <= k_; ++i) regions.push_back(region_of(complex_.vertex(c, i)));
  for (auto first = regions.begin(); first != regions.end();) {
    const auto last = first + static_cast<std::ptrdiff_t>(corners);
    for (auto next = first + 1; next != last; ++next)  // insertion sort
      for (auto at = next; at != first && at[-1] > *at; --at) std::swap(at[-1], *at);
    first = last;
  }
  corners_ = {};
  neighbors_ = {};
  // The vertex list of a region still holds its finite cells.
  std::vector<std::size_t> offsets;
  std::vector<Index> infinite_cells;
  internal::spread(num_regions, offsets, infinite_cells, [&](const auto& put) {
    for (std::size_t place = cells_.size(); place < order.size(); ++place)
      for (std::size_t i = 1; i < corners; ++i)
        put(static_cast<std::size_t>(regions[place * corners + i]), static_cast<Index>(place));
  });

  // If no cells merge, every finite cell contributes to an edge for each pair of its corners.
  out_.ridge_vertices_.reserve(cells_.size() * (corners * (corners - 1) / 2) + infinite_cells.size());
  const auto make_work = [&] {
    return [&, count = std::vector<Index>(num_regions, 0), cells = std::vector<Index>(),
            stars = std::vector<Index>(), slots = std::vector<Index>(), others = std::vector<SignedIndex>(),
            vertices = std::vector<SignedIndex>()](std::size_t begin, std::size_t end_of_part,
                                                   auto&& add) mutable {
      for (std::size_t r = begin; r < end_of_part; ++r) {
        internal::cancellation_point();
        cells.clear();
        for (const SignedIndex place : out_.region(r))
          if (place >= 0) cells.push_back(static_cast<Index>(place));
        cells.insert(cells.end(), infinite_cells.begin() + static_cast<std::ptrdiff_t>(offsets[r]),
                     infinite_cells.begin() + static_cast<std::ptrdiff_t>(offsets[r + 1]));
        const auto for_each_later = [&](auto&& visit) {
          for (std::size_t e = 0; e < cells.size(); ++e) {
            constexpr std::size_t ahead = 12;
            if (e + ahead < cells.size()) internal::prefetch(regions.data() + cells[e + ahead] * corners);
            const Index place = cells[e];
            const SignedIndex* const first = regions.data() + place * corners;
            std::size_t not_later = 0;  // counting avoids unpredictable branches
            for (std::size_t i = 0; i < corners; ++i)
              not_later += first[i] <= static_cast<SignedIndex>(r) ? 1 : 0;
            for (std::size_t i = not_later; i < corners; ++i) visit(first[i], place);
          }
        };
        others.clear();
        for_each_later([&](SignedIndex other, Index) {
          if (count[static_cast<std::size_t>(other)]++ == 0) others.push_back(other);
        });
        std::sort(others.begin(), others.end());
        Index end = 0;
        for (const SignedIndex other : others) {
          const Index size = count[static_cast<std::size_t>(other)];
          count[static_cast<std::size_t>(other)] = end;  // now the position where the star grows
          end += size;
        }
        stars.resize(end);
        for_each_later(
            [&](SignedIndex other, Index place) { stars[count[static_cast<std::size_t>(other)]++] = place; });
        Index first = 0;
        for (const SignedIndex other : others) {
          // Finite cells, then infinite ones.
          const auto star = std::span(stars).subspan(first, count[static_cast<std::size_t>(other)] - first);
          first = std::exchange(count[static_cast<std::size_t>(other)], 0);
          const VertexId s = site_of_region_[r], t = site_of_region_[static_cast<std::size_t>(other)];
          if (has_merged_) {
            slots.clear();
            for (const Index place : star) slots.push_back(index(order[place]));
            if (!is_ridge(s, t, slots)) continue;
          }
          vertices.assign(star.back() < cells_.size() ? 0 : 1, -1);
          for (const Index place : star) {
            if (place >= cells_.size()) break;
            vertices.push_back(has_merged_ ? vertex_of_cell_[index(order[place])]
                                           : static_cast<SignedIndex>(place));
          }
          if (has_merged_) {
            std::sort(vertices.begin(), vertices.end());
            vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
          }
          add(s, t, vertices);
        }
      }
    };
  };
  collect_in_parts(num_regions, make_work);
  if (has_merged_) out_.ridge_vertices_.shrink_to_fit();
  // Volumes use the faces of finite cells only.
  regions.resize(cells_.size() * corners);
  regions.shrink_to_fit();
  out_.cell_vertex_.reserve(cells_.size());
  for (const CellId c : cells_) out_.cell_vertex_.push_back(vertex_of_cell_[index(c)]);
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
    for (const CellId c : complex_.all_cells())
      if (root(index(c)) != index(c)) sites_of_class_[root(index(c))];
    for (const CellId c : complex_.all_cells())
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
    internal::cancellation_point();
    const auto sites = class_vertices(root(cell), storage);
    if (is_first) {
      common.assign(sites.begin(), sites.end());
    } else {
      kept.clear();
      std::set_intersection(common.begin(), common.end(), sites.begin(), sites.end(),
                            std::back_inserter(kept));
      common.swap(kept);
    }
    is_first = false;
    if (common.size() == 2) return true;
  }
  // In a power diagram, sites between s and t may have regions without interior, which lie in the ridge.
  for (const VertexId v : common) {
    if (v == s || v == t) continue;
    std::vector<double> three;
    for (const VertexId w : {s, t, v}) three.insert(three.end(), point(w), point(w) + d_);
    if (affine_dimension(three, static_cast<int>(d_)) > 1) return false;
  }
  return true;
}

}  // namespace delone::voronoi
