// SPDX-License-Identifier: BSD-3-Clause
// Sites, vertices, regions and rays. Ridges are in voronoi_ridges.cpp.
#include "voronoi/voronoi_builder.hpp"

#include "base/compiler.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "kernel/predicates.hpp"
#include "solve/cell_center.hpp"
#include "solve/outward_direction.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace delone::voronoi {

VoronoiBuilder::VoronoiBuilder(const Triangulation& triangulation,
                               const std::function<double(VertexId)>& weight, unsigned threads, Diagram& out)
    : triangulation_(triangulation),
      weight_(weight),
      threads_(threads),
      out_(out),
      complex_(triangulation.complex()),
      k_(complex_.affine_dimension()),
      d_(static_cast<std::size_t>(triangulation.dimension())),
      axes_(triangulation.axes()) {}

void VoronoiBuilder::sort_cells() {
  row_of_vertex_.resize(1, -1);
  if (k_ < 0) return;
  std::vector<Index> next(2, 0);
  vertex_of_cell_.assign(complex_.num_cell_slots(), -1);
  for (const CellId c : complex_.finite_cells()) {
    round_();
    Index largest = 0;
    for (int i = 0; i <= k_; ++i) largest = std::max(largest, index(complex_.vertex(c, i)));
    if (largest >= row_of_vertex_.size()) {
      row_of_vertex_.resize(largest + 1, -1);
      next.resize(largest + 2, 0);
    }
    for (int i = 0; i <= k_; ++i) row_of_vertex_[index(complex_.vertex(c, i))] = 0;
    vertex_of_cell_[index(c)] = static_cast<SignedIndex>(largest);
    ++next[largest + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  cells_.resize(complex_.num_finite_cells());
  for (Index slot = 0; slot < vertex_of_cell_.size(); ++slot) {
    if (vertex_of_cell_[slot] < 0) continue;
    const Index place = next[static_cast<std::size_t>(vertex_of_cell_[slot])]++;
    cells_[place] = CellId{slot};
    vertex_of_cell_[slot] = static_cast<SignedIndex>(place);
  }
  corners_.reserve(cells_.size() * static_cast<std::size_t>(k_ + 1));
  neighbors_.reserve(corners_.capacity());
  for (const CellId c : cells_)
    for (int i = 0; i <= k_; ++i) {
      corners_.push_back(complex_.vertex(c, i));
      neighbors_.push_back(complex_.neighbor(c, i));
    }
}

void VoronoiBuilder::collect_sites() {
  region_of_vertex_.assign(row_of_vertex_.size(), -1);
  coordinates_.resize(row_of_vertex_.size() * d_);
  if (weight_) weights_.resize(row_of_vertex_.size());
  std::vector<VertexId> site_of_row(triangulation_.num_rows(), infinite_vertex);
  for (Index v = 1; v < row_of_vertex_.size(); ++v) {
    if (row_of_vertex_[v] < 0) continue;
    round_();
    const std::size_t row = triangulation_.row_of(VertexId{v});
    row_of_vertex_[v] = static_cast<SignedIndex>(row);
    if (row >= site_of_row.size()) site_of_row.resize(row + 1, infinite_vertex);
    site_of_row[row] = VertexId{v};
    const auto p = triangulation_.point(VertexId{v});
    std::copy(p.begin(), p.end(), coordinates_.begin() + static_cast<std::ptrdiff_t>(v * d_));
    if (weight_) weights_[v] = weight_(VertexId{v});
  }
  out_.point_region_.assign(site_of_row.size(), -1);
  for (std::size_t row = 0; row < site_of_row.size(); ++row) {
    // Rows increase, so the first row at a vertex precedes its duplicates.
    if (const VertexId v = site_of_row[row]; v != infinite_vertex) {
      region_of_vertex_[index(v)] = static_cast<SignedIndex>(site_of_region_.size());
      site_of_region_.push_back(v);
      out_.sites_.insert(out_.sites_.end(), point(v), point(v) + d_);
      if (weight_) out_.weights_.push_back(weights_[index(v)]);
      out_.region_points_.push_back(static_cast<SignedIndex>(row));
    }
    const VertexId v = triangulation_.vertex_at(row);
    if (index(v) < region_of_vertex_.size()) out_.point_region_[row] = region_of(v);
    if (out_.point_region_[row] >= 0) continue;
    const double* hidden = triangulation::StoredPoints::of_row(triangulation_, row);
    for (std::size_t j = 0; j <= d_; ++j)
      out_.hidden_.push_back(hidden == nullptr ? std::nan("") : j < d_ || weight_ ? hidden[j] : 0.0);
  }
}

void VoronoiBuilder::find_centers() {
  if (k_ < 1) return;
  bool aligned = true;
  for (std::size_t j = 0; j < d_ && aligned; ++j) {
    if (std::binary_search(axes_.begin(), axes_.end(), static_cast<int>(j))) continue;
    for (const VertexId v : site_of_region_) aligned = aligned && point(v)[j] == point(site_of_region_[0])[j];
  }
  const auto corners = static_cast<std::size_t>(k_) + 1;
  constexpr std::size_t block = solve::CenterFinder::block, part = 128 * block;
  centers_.resize(cells_.size() * d_);
  internal::work_in_parts(threads_, cells_.size(), part, [&] {
    return [&, finder = solve::CenterFinder(triangulation_.dimension(), axes_, aligned),
            points = std::vector<const double*>(corners * block),
            weights = std::vector<double>(weight_ ? corners * block : 0)](
               std::size_t begin, std::size_t end, const internal::StopPoint& stop) mutable {
      for (std::size_t first = begin; first < end; first += block) {
        stop();
        const std::size_t count = std::min(block, end - first);
        for (std::size_t cell = 0; cell < count; ++cell)
          for (std::size_t i = 0; i < corners; ++i) {
            const VertexId v = corners_[(first + cell) * corners + i];
            points[cell * corners + i] = point(v);
            if (weight_) weights[cell * corners + i] = weights_[index(v)];
          }
        finder.find_block(count, points.data(), weight_ ? weights.data() : nullptr,
                          centers_.data() + first * d_);
      }
    };
  });
}

Index VoronoiBuilder::root(Index cell) { return has_merged_ ? classes_.root(cell) : cell; }

void VoronoiBuilder::unite(Index a, Index b) {
  if (!has_merged_) {
    classes_ = internal::UnionFind(complex_.num_cell_slots());
    has_merged_ = true;
  }
  classes_.unite(a, b);
}

bool VoronoiBuilder::is_on_sphere(CellId cell, VertexId v) const {
  if (!weight_)
    return triangulation::StoredPoints::in_sphere(triangulation_, cell, {point(v), d_}) == Side::on;
  std::vector<const double*> points;
  std::vector<double> weights;
  for (int i = 0; i <= k_; ++i) {
    points.push_back(point(complex_.vertex(cell, i)));
    weights.push_back(weights_[index(complex_.vertex(cell, i))]);
  }
  return solve::CenterFinder(triangulation_.dimension(), axes_, true)
      .on_sphere(points.data(), weights.data(), point(v), weights_[index(v)]);
}

void VoronoiBuilder::merge_finite_cells() {
  if (k_ < 2) return;
  for (std::size_t place = 0; place < cells_.size(); ++place) {
    round_();
    const CellId c = cells_[place];
    const double* here = centers_.data() + place * d_;
    for (int i = 0; i <= k_; ++i) {
      const CellId other = neighbors_[place * static_cast<std::size_t>(k_ + 1) + static_cast<std::size_t>(i)];
      const SignedIndex there = vertex_of_cell_[index(other)];
      if (there < 0 || static_cast<std::size_t>(there) > place || !std::equal(here, here + d_, center(other)))
        continue;
      if (root(index(c)) == root(index(other))) continue;
      if (is_on_sphere(c, complex_.vertex(other, complex_.mirror_index(c, i)))) unite(index(c), index(other));
    }
  }
}

void VoronoiBuilder::merge_infinite_cells() {
  if (k_ < 2) return;
  const kernel::Flat flat{triangulation_.dimension(), axes_};
  std::vector<const double*> points;
  for (const CellId c : complex_.infinite_cells()) {
    internal::cancellation_point();
    const int apex = complex_.infinite_index(c);
    for (int i = 0; i <= k_; ++i) {
      const CellId other = complex_.neighbor(c, i);
      if (i == apex || index(other) < index(c)) continue;
      const CellId behind = complex_.neighbor(other, complex_.infinite_index(other));
      if (root(index(complex_.neighbor(c, apex))) != root(index(behind))) continue;
      points.clear();
      for (int j = 0; j <= k_; ++j)
        if (j != apex) points.push_back(point(complex_.vertex(c, j)));
      points.push_back(point(complex_.vertex(other, complex_.mirror_index(c, i))));
      if (kernel::orientation(flat, points) == Sign::zero) unite(index(c), index(other));
    }
  }
}

/// Moves each center to the number of its vertex, which is at most its position.
void VoronoiBuilder::number_vertices() {
  if (has_merged_) {
    std::vector<SignedIndex> number_of_root(complex_.num_cell_slots(), -1);
    SignedIndex count = 0;
    for (const CellId c : cells_) {
      SignedIndex& number = number_of_root[root(index(c))];
      if (number < 0) {
        std::copy_n(center(c), d_, centers_.data() + static_cast<std::size_t>(count) * d_);
        number = count++;
      }
      vertex_of_cell_[index(c)] = number;
    }
    centers_.resize(static_cast<std::size_t>(count) * d_);
    centers_.shrink_to_fit();
  }
  out_.vertices_ = std::move(centers_);
}

void VoronoiBuilder::collect_stars() {
  const std::size_t num_regions = site_of_region_.size();
  out_.bounded_.assign(num_regions, k_ > 0 ? 1 : 0);
  for (const CellId c : complex_.infinite_cells())
    for (int i = 0; i <= k_; ++i)
      if (complex_.vertex(c, i) != infinite_vertex)
        out_.bounded_[static_cast<std::size_t>(region_of(complex_.vertex(c, i)))] = 0;
  if (k_ == 2) return;
  auto& offsets = out_.region_offsets_;
  offsets.assign(num_regions + 1, 0);
  const auto for_each_corner = [&](auto&& visit) {
    const VertexId* corner = corners_.data();
    for (std::size_t place = 0; k_ > 0 && place < cells_.size(); ++place)
      for (int i = 0; i <= k_; ++i)
        visit(static_cast<std::size_t>(region_of(*corner++)), static_cast<SignedIndex>(place));
  };
  for_each_corner([&](std::size_t r, SignedIndex) { ++offsets[r + 1]; });
  for (std::size_t r = 0; r < num_regions; ++r) offsets[r + 1] += offsets[r] + (out_.bounded_[r] ? 0 : 1);
  out_.region_vertices_.assign(static_cast<std::size_t>(offsets.back()), -1);
  std::vector<std::int64_t> next(num_regions);
  for (std::size_t r = 0; r < num_regions; ++r) next[r] = offsets[r] + (out_.bounded_[r] ? 0 : 1);
  for_each_corner([&](std::size_t r, SignedIndex place) {
    out_.region_vertices_[static_cast<std::size_t>(next[r]++)] = place;
  });
}

void VoronoiBuilder::keep_cells() {
  if (k_ < 1 || k_ > 3 || out_.kind_ == DataKind::furthest_voronoi) return;
  out_.cell_regions_.reserve(corners_.size());
  for (const VertexId v : corners_) out_.cell_regions_.push_back(region_of(v));
}

/// Merging only shortens lists, so they can move forward in place.
void VoronoiBuilder::collect_regions() {
  corners_ = {};
  neighbors_ = {};
  auto& items = out_.region_vertices_;
  auto& offsets = out_.region_offsets_;
  const std::size_t num_regions = site_of_region_.size();
  if (k_ == 2) return collect_regions_in_plane();
  if (!has_merged_) return;
  auto end = items.begin();
  std::int64_t first = 0;
  for (std::size_t r = 0; r < num_regions; ++r) {
    const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first);
    first = offsets[r + 1];
    internal::cancellation_point();
    const auto last = items.begin() + static_cast<std::ptrdiff_t>(first);
    for (auto item = begin; item != last; ++item)
      if (*item >= 0) *item = vertex_of_cell_[index(cells_[static_cast<std::size_t>(*item)])];
    if (!std::is_sorted(begin, last)) std::sort(begin, last);
    end = std::unique_copy(begin, last, end);
    offsets[r + 1] = end - items.begin();
  }
  items.erase(end, items.end());
  items.shrink_to_fit();
}

/// k = 2. Vertices with close ids are usually close in space, while regions come in input order. So the lists
/// are made in the order of vertices, which keeps the cells in the cache, and then moved to their places.
void VoronoiBuilder::collect_regions_in_plane() {
  const std::size_t num_regions = site_of_region_.size();
  std::vector<SignedIndex> lists;
  lists.reserve(3 * cells_.size() + complex_.num_infinite_cells());
  std::vector<std::size_t> begin(num_regions), size(num_regions);
  for (Index v = 1; v < row_of_vertex_.size(); ++v) {
    if (row_of_vertex_[v] < 0) continue;
    const auto r = static_cast<std::size_t>(region_of_vertex_[v]);
    begin[r] = lists.size();
    round_();
    walk_region(r, VertexId{v}, lists);
    size[r] = lists.size() - begin[r];
  }
  out_.region_vertices_.reserve(lists.size());
  out_.region_offsets_.reserve(num_regions + 1);
  for (std::size_t r = 0; r < num_regions; ++r) {
    constexpr std::size_t ahead = 16;
    if (r + ahead < num_regions) internal::prefetch(lists.data() + begin[r + ahead]);
    const auto first = lists.begin() + static_cast<std::ptrdiff_t>(begin[r]);
    out_.region_vertices_.insert(out_.region_vertices_.end(), first,
                                 first + static_cast<std::ptrdiff_t>(size[r]));
    out_.region_offsets_.push_back(static_cast<std::int64_t>(out_.region_vertices_.size()));
  }
}

/// k = 2: walks once around the site. Cells are coherently oriented, so crossing the edge opposite the vertex
/// that follows the site goes counterclockwise.
void VoronoiBuilder::walk_region(std::size_t region, VertexId site, std::vector<SignedIndex>& items) {
  const auto first = static_cast<std::ptrdiff_t>(items.size());
  const CellId start = complex_.incident_cell(site);
  CellId c = start;
  do {
    const SignedIndex vertex = vertex_of_cell_[index(c)];
    if (static_cast<std::ptrdiff_t>(items.size()) == first || items.back() != vertex) items.push_back(vertex);
    c = complex_.neighbor(c, (complex_.index_of(c, site) + 1) % 3);
  } while (c != start);
  if (static_cast<std::ptrdiff_t>(items.size()) > first + 1 &&
      items.back() == items[static_cast<std::size_t>(first)])
    items.pop_back();
  if (!out_.bounded_[region])
    std::rotate(items.begin() + first, std::find(items.begin() + first, items.end(), -1), items.end());
}

void VoronoiBuilder::collect_rays() {
  if (k_ < 1) return;
  const bool is_inward = triangulation_.kind() == TriangulationKind::furthest_site;
  std::vector<const double*> facet;
  for (const CellId c : complex_.infinite_cells()) {
    round_();
    if (root(index(c)) != index(c)) continue;
    const int apex = complex_.infinite_index(c);
    const CellId behind = complex_.neighbor(c, apex);
    out_.ray_vertices_.push_back(vertex_of_cell_[index(behind)]);
    facet.clear();
    for (int i = 0; i <= k_; ++i) {
      if (i == apex) continue;
      facet.push_back(point(complex_.vertex(c, i)));
      out_.ray_points_.push_back(row_of(complex_.vertex(c, i)));
    }
    const double* opposite = point(complex_.vertex(behind, complex_.mirror_index(c, apex)));
    std::vector<double> direction = solve::outward_direction(facet, opposite, d_);
    if (is_inward)
      for (double& x : direction) x = 0 - x;
    out_.ray_directions_.insert(out_.ray_directions_.end(), direction.begin(), direction.end());
  }
}

}  // namespace delone::voronoi
