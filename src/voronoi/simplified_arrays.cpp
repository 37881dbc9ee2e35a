// SPDX-License-Identifier: BSD-3-Clause
// The arrays of a simplified diagram: what is left once vertices have their representatives and thin ridges
// are known.
#include "base/spread.hpp"
#include "kernel/linear_bound.hpp"
#include "voronoi/diagram_simplifier.hpp"

#include <algorithm>
#include <cmath>

namespace delone::voronoi {

/// In the order of their coordinates. A ray keeps the vertex that it starts from.
std::vector<SignedIndex> DiagramSimplifier::vertices_that_lost_ridges() const {
  std::vector<bool> is_candidate(num_vertices_, false);
  for (std::size_t i = 0; i < is_gone_.size(); ++i)
    if (is_gone_[i] != 0)
      for (const SignedIndex v : in_.ridge(i))
        if (v >= 0) is_candidate[static_cast<std::size_t>(representative(v))] = true;
  for (const SignedIndex v : in_.ray_vertices_)
    is_candidate[static_cast<std::size_t>(representative(v))] = false;
  std::vector<SignedIndex> candidates;
  for (Index v = 0; v < num_vertices_; ++v)
    if (is_candidate[v]) candidates.push_back(static_cast<SignedIndex>(v));
  std::sort(candidates.begin(), candidates.end(), [&](SignedIndex v, SignedIndex w) {
    return comes_before(static_cast<Index>(v), static_cast<Index>(w));
  });
  return candidates;
}

bool DiagramSimplifier::is_straight(std::span<const SignedIndex> list, SignedIndex vertex, double& farthest) {
  const auto is_left = [&](SignedIndex v) { return v < 0 || is_dropped_[static_cast<std::size_t>(v)] == 0; };
  if (std::count_if(list.begin(), list.end(), is_left) <= 3) return false;
  const std::size_t n = list.size();
  const auto middle = static_cast<std::size_t>(std::find(list.begin(), list.end(), vertex) - list.begin());
  std::size_t before = middle, after = middle;
  do before = (before + n - 1) % n;
  while (!is_left(list[before]));
  do after = (after + 1) % n;
  while (!is_left(list[after]));
  if (list[before] < 0 || list[after] < 0 || before == after) return false;
  const double* ends[2] = {at(list[before]), at(list[after])};
  if (std::lexicographical_compare(ends[1], ends[1] + d_, ends[0], ends[0] + d_)) std::swap(ends[0], ends[1]);
  line_.set_flat(ends, d_, kernel::unit_roundoff);
  for (std::size_t i = (before + 1) % n; i != after; i = (i + 1) % n) {
    const double distance = line_.segment_bound(at(list[i]));
    if (!(distance <= tolerance_)) return false;
    farthest = std::max(farthest, distance);
  }
  return true;
}

void DiagramSimplifier::drop_straight_vertices() {
  const std::vector<SignedIndex> candidates = vertices_that_lost_ridges();
  if (candidates.empty()) return;
  std::vector<Index> place(num_vertices_, invalid_index);  // in candidates
  for (Index c = 0; c < candidates.size(); ++c) place[static_cast<std::size_t>(candidates[c])] = c;
  std::vector<std::vector<Index>> ridges_of(candidates.size());
  for (Index i = 0; i < is_gone_.size(); ++i)
    for (const SignedIndex v : ridge(i))
      if (v >= 0 && place[static_cast<std::size_t>(v)] != invalid_index)
        ridges_of[place[static_cast<std::size_t>(v)]].push_back(i);
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    double farthest = 0;
    const bool drops = !ridges_of[c].empty() &&
                       std::all_of(ridges_of[c].begin(), ridges_of[c].end(),
                                   [&](Index i) { return is_straight(ridge(i), candidates[c], farthest); });
    if (!drops) continue;
    is_dropped_[static_cast<std::size_t>(candidates[c])] = 1;
    max_displacement_ = std::max(max_displacement_, farthest);
  }
  std::size_t end = 0, item = 0;
  for (std::size_t i = 0; i < is_gone_.size(); ++i) {
    for (; item < static_cast<std::size_t>(offsets_[i + 1]); ++item)
      if (const SignedIndex v = items_[item]; v < 0 || is_dropped_[static_cast<std::size_t>(v)] == 0)
        items_[end++] = v;
    offsets_[i + 1] = static_cast<std::int64_t>(end);
  }
  items_.resize(end);
}

/// In the order of the exact diagram's vertices, which keeps sorted lists sorted.
void DiagramSimplifier::number_vertices(Diagram& out) {
  number_.assign(num_vertices_, -1);
  for (const SignedIndex v : items_)
    if (v >= 0) number_[static_cast<std::size_t>(v)] = 0;
  for (const SignedIndex v : in_.ray_vertices_) number_[static_cast<std::size_t>(representative(v))] = 0;
  SignedIndex count = 0;
  for (std::size_t v = 0; v < num_vertices_; ++v) {
    if (number_[v] < 0) continue;
    number_[v] = count++;
    const auto vertex = in_.vertex(v);
    out.vertices_.insert(out.vertices_.end(), vertex.begin(), vertex.end());
  }
}

void DiagramSimplifier::write_ridges(Diagram& out) const {
  out.ridge_offsets_.assign(1, 0);
  for (std::size_t i = 0; i < is_gone_.size(); ++i) {
    if (is_gone_[i] != 0) continue;
    for (const SignedIndex v : ridge(i))
      out.ridge_vertices_.push_back(v < 0 ? -1 : number_[static_cast<std::size_t>(v)]);
    out.ridge_offsets_.push_back(static_cast<std::int64_t>(out.ridge_vertices_.size()));
    out.ridge_points_.insert(out.ridge_points_.end(),
                             {in_.ridge_points_[2 * i], in_.ridge_points_[2 * i + 1]});
    out.ridge_of_exact_.push_back(static_cast<Index>(i));
  }
}

void DiagramSimplifier::write_regions(Diagram& out) {
  const std::size_t num_regions = in_.num_regions();
  out.region_offsets_.assign(1, 0);
  std::vector<std::size_t> starts;
  std::vector<SignedIndex> lists, list;
  if (k_ > 1)  // the ridges of each region
    internal::spread(num_regions, starts, lists, [&](const auto& put) {
      for (std::size_t end = 0; end < out.ridge_points_.size(); ++end)
        put(region_of_row(out.ridge_points_[end]), static_cast<SignedIndex>(end / 2));
    });
  for (std::size_t r = 0; r < num_regions; ++r) {
    list.clear();
    if (k_ > 2) {
      for (std::size_t i = starts[r]; i < starts[r + 1]; ++i) {
        const auto ridge_of_region = out.ridge(static_cast<std::size_t>(lists[i]));
        list.insert(list.end(), ridge_of_region.begin(), ridge_of_region.end());
      }
      if (in_.bounded_[r] == 0) list.push_back(-1);
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    } else if (k_ == 2) {
      const auto cycle = Diagram::list(cycles_, cycle_offsets_, r);
      if (starts[r] < starts[r + 1] || in_.bounded_[r] == 0)
        for (const SignedIndex v : cycle)
          if (v < 0 || number_[static_cast<std::size_t>(v)] >= 0)
            list.push_back(v < 0 ? -1 : number_[static_cast<std::size_t>(v)]);
    } else {
      represent(in_.region(r), false, list);
      for (SignedIndex& v : list) v = v < 0 ? -1 : number_[static_cast<std::size_t>(v)];
    }
    out.region_vertices_.insert(out.region_vertices_.end(), list.begin(), list.end());
    out.region_offsets_.push_back(static_cast<std::int64_t>(out.region_vertices_.size()));
  }
}

void DiagramSimplifier::write_rays(Diagram& out) const {
  for (Index ray = 0; ray < in_.num_rays(); ++ray) {
    if (first_ray_[ray] != ray) continue;
    const SignedIndex vertex = representative(in_.ray_vertices_[ray]);
    out.ray_vertices_.push_back(number_[static_cast<std::size_t>(vertex)]);
    const auto directions = in_.ray_directions().subspan(ray * d_, d_);
    const auto points = in_.ray_points().subspan(ray * k_, k_);
    out.ray_directions_.insert(out.ray_directions_.end(), directions.begin(), directions.end());
    out.ray_points_.insert(out.ray_points_.end(), points.begin(), points.end());
  }
}

}  // namespace delone::voronoi
