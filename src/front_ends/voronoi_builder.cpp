// SPDX-License-Identifier: BSD-3-Clause
// Sites, vertices, regions and rays. Ridges are in voronoi_ridges.cpp.
#include "front_ends/voronoi_builder.hpp"

#include "front_ends/voronoi_center.hpp"
#include "kernel/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace delone {

VoronoiBuilder::VoronoiBuilder(const Triangulation& triangulation, const std::function<double(VertexId)>& weight,
                               VoronoiDiagram& out)
    : triangulation_(triangulation),
      weight_(weight),
      out_(out),
      complex_(triangulation.complex()),
      k_(complex_.dimension()),
      d_(static_cast<std::size_t>(triangulation.dimension())),
      axes_(triangulation.axes()) {}

void VoronoiBuilder::collect_sites() {
  for (const CellId c : complex_.finite_cells())
    for (int i = 0; i <= k_; ++i) {
      const Index v = index(complex_.vertex(c, i));
      if (v >= row_of_vertex_.size()) row_of_vertex_.resize(v + 1, -1);
      row_of_vertex_[v] = 0;
    }
  region_of_vertex_.assign(row_of_vertex_.size(), -1);
  coordinates_.resize(row_of_vertex_.size() * d_);
  if (weight_) weights_.resize(row_of_vertex_.size());
  std::vector<VertexId> site_of_row(triangulation_.num_points(), infinite_vertex);
  for (Index v = 1; v < row_of_vertex_.size(); ++v) {
    if (row_of_vertex_[v] < 0) continue;
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
    // The first row at a vertex comes before the others.
    if (const VertexId v = site_of_row[row]; v != infinite_vertex) {
      region_of_vertex_[index(v)] = static_cast<SignedIndex>(site_of_region_.size());
      site_of_region_.push_back(v);
      out_.sites_.insert(out_.sites_.end(), point(v), point(v) + d_);
      if (weight_) out_.weights_.push_back(weights_[index(v)]);
      out_.region_points_.push_back(static_cast<SignedIndex>(row));
    }
    const VertexId v = triangulation_.vertex_at(row);
    if (index(v) < region_of_vertex_.size()) out_.point_region_[row] = region_of(v);
  }
}

void VoronoiBuilder::sort_cells() {
  if (k_ < 0) return;
  std::vector<Index> next(row_of_vertex_.size() + 1, 0);
  const auto largest_vertex = [&](CellId c) {
    Index largest = 0;
    for (int i = 0; i <= k_; ++i) largest = std::max(largest, index(complex_.vertex(c, i)));
    return largest;
  };
  for (const CellId c : complex_.cells()) ++next[largest_vertex(c) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  cells_.resize(complex_.num_cells());
  for (const CellId c : complex_.cells()) cells_[next[largest_vertex(c)]++] = c;
  vertex_of_cell_.assign(complex_.num_cell_slots(), -1);
  SignedIndex count = 0;
  for (const CellId c : cells_)
    if (!complex_.is_infinite(c)) vertex_of_cell_[index(c)] = count++;
}

void VoronoiBuilder::find_centers() {
  if (k_ < 1) return;
  bool aligned = true;
  for (std::size_t j = 0; j < d_ && aligned; ++j) {
    if (std::binary_search(axes_.begin(), axes_.end(), static_cast<int>(j))) continue;
    for (const VertexId v : site_of_region_) aligned = aligned && point(v)[j] == point(site_of_region_[0])[j];
  }
  front_ends::CenterFinder finder(triangulation_.dimension(), axes_, aligned);
  const auto corners = static_cast<std::size_t>(k_) + 1;
  std::vector<const double*> points(corners);
  std::vector<double> weights(corners);
  centers_.resize(complex_.num_finite_cells() * d_);
  double* center = centers_.data();
  for (const CellId c : cells_) {
    if (vertex_of_cell_[index(c)] < 0) continue;
    for (std::size_t i = 0; i < corners; ++i) {
      const VertexId v = complex_.vertex(c, static_cast<int>(i));
      points[i] = point(v);
      if (weight_) weights[i] = weights_[index(v)];
    }
    finder.find(points.data(), weight_ ? weights.data() : nullptr, center);
    center += d_;
  }
}

Index VoronoiBuilder::root(Index cell) {
  while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
  return cell;
}

/// The smaller slot becomes the root.
void VoronoiBuilder::unite(Index a, Index b) {
  a = root(a);
  b = root(b);
  parent_[std::max(a, b)] = std::min(a, b);
  has_merged_ = true;
}

bool VoronoiBuilder::is_on_sphere(CellId cell, VertexId v) const {
  if (!weight_) return triangulation_.in_sphere(cell, {point(v), d_}) == Sign::zero;
  std::vector<const double*> points;
  std::vector<double> weights;
  for (int i = 0; i <= k_; ++i) {
    points.push_back(point(complex_.vertex(cell, i)));
    weights.push_back(weights_[index(complex_.vertex(cell, i))]);
  }
  return front_ends::CenterFinder(triangulation_.dimension(), axes_, true)
      .on_sphere(points.data(), weights.data(), point(v), weights_[index(v)]);
}

void VoronoiBuilder::merge_finite_cells() {
  parent_.resize(complex_.num_cell_slots());
  std::iota(parent_.begin(), parent_.end(), Index{0});
  if (k_ < 2) return;
  for (const CellId c : cells_) {
    if (vertex_of_cell_[index(c)] < 0) continue;
    for (int i = 0; i <= k_; ++i) {
      const CellId other = complex_.neighbor(c, i);
      if (index(other) < index(c) || vertex_of_cell_[index(other)] < 0) continue;
      if (!std::equal(center(c), center(c) + d_, center(other)) || root(index(c)) == root(index(other))) continue;
      if (is_on_sphere(c, complex_.vertex(other, complex_.mirror_index(c, i)))) unite(index(c), index(other));
    }
  }
}

void VoronoiBuilder::merge_infinite_cells() {
  if (k_ < 2) return;
  const kernel::Flat flat{triangulation_.dimension(), axes_};
  std::vector<const double*> points;
  for (const CellId c : complex_.infinite_cells()) {
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

/// Centres move to the number of their vertex, which is at most their place.
void VoronoiBuilder::number_vertices() {
  if (k_ < 1) return;
  std::vector<SignedIndex> number_of_root(has_merged_ ? complex_.num_cell_slots() : 0, -1);
  SignedIndex count = 0;
  for (const CellId c : cells_) {
    SignedIndex& vertex = vertex_of_cell_[index(c)];
    if (vertex < 0) continue;
    SignedIndex* number = has_merged_ ? &number_of_root[root(index(c))] : nullptr;
    if (number != nullptr && *number >= 0) {
      vertex = *number;
      continue;
    }
    std::copy_n(center(c), d_, centers_.data() + static_cast<std::size_t>(count) * d_);
    vertex = count++;
    if (number != nullptr) *number = vertex;
  }
  centers_.resize(static_cast<std::size_t>(count) * d_);
  out_.vertices_ = std::move(centers_);
  if (has_merged_) out_.vertices_.shrink_to_fit();
}

void VoronoiBuilder::collect_regions() {
  const std::size_t num_regions = site_of_region_.size();
  out_.bounded_.assign(num_regions, k_ > 0 ? 1 : 0);
  for (const CellId c : complex_.infinite_cells())
    for (int i = 0; i <= k_; ++i)
      if (complex_.vertex(c, i) != infinite_vertex)
        out_.bounded_[static_cast<std::size_t>(region_of(complex_.vertex(c, i)))] = 0;
  out_.region_offsets_.reserve(num_regions + 1);
  if (k_ == 2) {
    for (std::size_t r = 0; r < num_regions; ++r) walk_region(static_cast<Index>(r), site_of_region_[r]);
    return;
  }
  // Lists by vertex id, filled in sorted order and hence nearly sorted; then in the order of regions.
  std::vector<std::size_t> ends(row_of_vertex_.size() + 1, 0);
  std::vector<SignedIndex> items;
  if (k_ > 0) {
    const auto for_each_corner = [&](auto&& visit) {
      for (const CellId c : cells_)
        for (int i = 0; vertex_of_cell_[index(c)] >= 0 && i <= k_; ++i) visit(index(complex_.vertex(c, i)), c);
    };
    for_each_corner([&](Index v, CellId) { ++ends[v + 1]; });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    items.resize(ends.back());
    for_each_corner([&](Index v, CellId c) { items[ends[v]++] = vertex_of_cell_[index(c)]; });
  }
  out_.region_vertices_.reserve(items.size() + out_.num_unbounded_regions());
  for (std::size_t r = 0; r < num_regions; ++r) {
    const Index v = index(site_of_region_[r]);
    const auto first = items.begin() + static_cast<std::ptrdiff_t>(v == 0 ? 0 : ends[v - 1]);
    auto last = items.begin() + static_cast<std::ptrdiff_t>(ends[v]);
    if (!std::is_sorted(first, last)) std::sort(first, last);
    last = std::unique(first, last);
    if (!out_.bounded_[r]) out_.region_vertices_.push_back(-1);
    out_.region_vertices_.insert(out_.region_vertices_.end(), first, last);
    out_.region_offsets_.push_back(static_cast<std::int64_t>(out_.region_vertices_.size()));
  }
}

/// k = 2: once around the site. Cells are coherently oriented, so crossing the edge opposite the vertex that follows the site
/// goes counterclockwise.
void VoronoiBuilder::walk_region(Index region, VertexId site) {
  auto& items = out_.region_vertices_;
  const auto first = static_cast<std::ptrdiff_t>(items.size());
  const CellId start = complex_.incident_cell(site);
  CellId c = start;
  do {
    const SignedIndex vertex = vertex_of_cell_[index(c)];
    if (static_cast<std::ptrdiff_t>(items.size()) == first || items.back() != vertex) items.push_back(vertex);
    c = complex_.neighbor(c, (complex_.index_of(c, site) + 1) % 3);
  } while (c != start);
  if (static_cast<std::ptrdiff_t>(items.size()) > first + 1 && items.back() == items[static_cast<std::size_t>(first)])
    items.pop_back();
  if (!out_.bounded_[region])
    std::rotate(items.begin() + first, std::find(items.begin() + first, items.end(), -1), items.end());
  out_.region_offsets_.push_back(static_cast<std::int64_t>(items.size()));
}

void VoronoiBuilder::collect_rays() {
  if (k_ < 1) return;
  std::vector<const double*> facet;
  for (const CellId c : complex_.infinite_cells()) {
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
    const std::vector<double> direction = front_ends::outward_direction(facet, opposite, d_);
    out_.ray_directions_.insert(out_.ray_directions_.end(), direction.begin(), direction.end());
  }
}

void VoronoiBuilder::keep_cells() {
  if (k_ <= 3) return;
  for (const CellId c : cells_) {
    if (vertex_of_cell_[index(c)] < 0) continue;
    out_.cell_vertex_.push_back(vertex_of_cell_[index(c)]);
    for (int i = 0; i <= k_; ++i) out_.cell_regions_.push_back(region_of(complex_.vertex(c, i)));
  }
}

}  // namespace delone
