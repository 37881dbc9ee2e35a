// SPDX-License-Identifier: BSD-3-Clause
// Which vertices become one, which ridges go. What is left is numbered and written in simplified_arrays.cpp.
#include "voronoi/diagram_simplifier.hpp"

#include "base/progress_meter.hpp"
#include "base/spread.hpp"
#include "kernel/linear_bound.hpp"
#include "voronoi/roundoff.hpp"

#include <delone/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delone::voronoi {

DiagramSimplifier::DiagramSimplifier(const Diagram& exact, const internal::AxisScale& scale)
    : in_(exact),
      tolerance_(scale.tolerance()),
      k_(static_cast<std::size_t>(std::max(exact.affine_dimension(), 0))),
      d_(static_cast<std::size_t>(exact.dimension())),
      num_vertices_(exact.num_vertices()),
      scaled_(scale.is_one() ? std::vector<double>() : scale.scaled(exact.vertices_)),
      representative_(num_vertices_),
      first_ray_(exact.num_rays()),
      is_gone_(exact.num_ridges(), 0),
      is_dropped_(num_vertices_, 0),
      width_(k_, d_) {
  std::iota(representative_.begin(), representative_.end(), Index{0});
  std::iota(first_ray_.begin(), first_ray_.end(), Index{0});
}

bool DiagramSimplifier::comes_before(Index v, Index w) const {
  const double *p = at(v), *q = at(w);
  for (std::size_t j = 0; j < d_; ++j)
    if (p[j] != q[j]) return p[j] < q[j];
  return v < w;
}

/// Both ends are within ε of a representative, so no coordinate differs by more than 2ε; the bounds that
/// decide later are at least the computed differences.
std::vector<std::pair<Index, Index>> DiagramSimplifier::short_edges() const {
  std::vector<std::pair<Index, Index>> edges;
  const double most = 2 * tolerance_ * (1 + 8 * u);
  const auto visit = [&](SignedIndex v, SignedIndex w) {
    if (v < 0 || w < 0) return;
    const double *p = at(v), *q = at(w);
    for (std::size_t j = 0; j < d_; ++j)
      if (!(std::abs(p[j] - q[j]) <= most)) return;
    edges.emplace_back(static_cast<Index>(v), static_cast<Index>(w));
  };
  if (k_ == 1)
    for (std::size_t r = 0; r < in_.num_regions(); ++r)
      if (const auto ends = in_.region(r); ends.size() == 2) visit(ends[0], ends[1]);
  if (k_ == 2 || k_ == 3)
    for (std::size_t i = 0; i < in_.num_ridges(); ++i) {
      internal::cancellation_point();
      const auto list = in_.ridge(i);
      for (std::size_t a = 0; a + 1 < list.size(); ++a) visit(list[a], list[a + 1]);
      if (list.size() > 2) visit(list.back(), list.front());
    }
  std::vector<double> first;  // coordinates of the vertices of a ridge: most pairs differ in these
  for (std::size_t i = 0; k_ > 3 && i < in_.num_ridges(); ++i) {
    internal::cancellation_point();
    const auto list = in_.ridge(i);
    first.clear();
    for (const SignedIndex v : list) first.push_back(v < 0 ? std::nan("") : at(v)[0]);
    for (std::size_t a = 0; a < list.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (std::abs(first[a] - first[b]) <= most) visit(list[b], list[a]);
  }
  return edges;
}

/// Of vertices with the same coordinates and as many ridges, it makes no difference which comes first: their
/// balls are the same, and so are the connected parts of what is left in these.
void DiagramSimplifier::cluster_vertices() {
  const auto edges = short_edges();
  if (edges.empty()) return;
  std::vector<std::size_t> starts;  // of the vertices next to each
  std::vector<Index> next;
  internal::spread(num_vertices_, starts, next, [&](const auto& put) {
    for (const auto& [v, w] : edges) {
      put(v, w);
      put(w, v);
    }
  });
  std::vector<Index> num_ridges(num_vertices_, 0), order;
  for (const SignedIndex v : in_.ridge_vertices_)
    if (v >= 0) ++num_ridges[static_cast<std::size_t>(v)];
  for (Index v = 0; v < num_vertices_; ++v)
    if (starts[v] < starts[v + 1]) order.push_back(v);
  std::sort(order.begin(), order.end(), [&](Index v, Index w) {
    return num_ridges[v] != num_ridges[w] ? num_ridges[v] > num_ridges[w] : comes_before(v, w);
  });
  std::vector<unsigned char> has_one(num_vertices_, 0);
  std::vector<Index> cluster;
  for (const Index center : order) {
    if (has_one[center] != 0) continue;
    internal::cancellation_point();
    has_one[center] = 1;
    cluster.assign(1, center);
    for (std::size_t c = 0; c < cluster.size(); ++c) {
      for (std::size_t edge = starts[cluster[c]]; edge < starts[cluster[c] + 1]; ++edge) {
        const Index v = next[edge];
        if (has_one[v] != 0) continue;
        const double moved = kernel::distance_bound(at(center), at(v), d_, u);
        if (!(moved <= tolerance_)) continue;
        max_displacement_ = std::max(max_displacement_, moved);
        has_one[v] = 1;
        representative_[v] = center;
        cluster.push_back(v);
        is_changed_ = true;
      }
    }
  }
}

/// Whether the rows lie in the hyperplane of a ray's hull facet.
bool DiagramSimplifier::in_one_facet(std::span<const SignedIndex> ray,
                                     std::span<const SignedIndex> rows) const {
  std::vector<double> points;
  for (const auto list : {ray, rows})
    for (const SignedIndex row : list) {
      const auto site = in_.site(region_of_row(row));
      points.insert(points.end(), site.begin(), site.end());
    }
  return affine_dimension(points, static_cast<int>(d_)) < static_cast<int>(k_);
}

/// Directions are off by less than 10⁻¹², so rays of one direction are close in a list sorted by one of its
/// coordinates.
void DiagramSimplifier::merge_rays() {
  if (k_ < 2 || !is_changed_) return;
  for (Index ray = 0; ray < in_.num_rays(); ++ray) rays_by_vertex_.emplace_back(in_.ray_vertices_[ray], ray);
  std::sort(rays_by_vertex_.begin(), rays_by_vertex_.end());
  constexpr double close = 1e-11;
  std::vector<unsigned char> is_shared(num_vertices_, 0);
  for (std::size_t v = 0; v < num_vertices_; ++v)
    if (representative_[v] != v) is_shared[representative_[v]] = 1;
  std::vector<Index> rays;
  const auto vertex_of = [&](Index ray) { return representative(in_.ray_vertices_[ray]); };
  const auto direction = [&](Index ray) { return in_.ray_directions_.data() + ray * d_; };
  const auto points_of = [&](Index ray) { return in_.ray_points().subspan(ray * k_, k_); };
  for (Index ray = 0; ray < in_.num_rays(); ++ray)
    if (is_shared[static_cast<std::size_t>(vertex_of(ray))] != 0) rays.push_back(ray);
  std::sort(rays.begin(), rays.end(), [&](Index a, Index b) {
    if (vertex_of(a) != vertex_of(b)) return vertex_of(a) < vertex_of(b);
    if (direction(a)[0] != direction(b)[0]) return direction(a)[0] < direction(b)[0];
    return a < b;
  });
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t j = i; j-- > 0 && vertex_of(rays[j]) == vertex_of(rays[i]) &&
                            direction(rays[i])[0] - direction(rays[j])[0] <= close;) {
      const double *p = direction(rays[i]), *q = direction(rays[j]);
      const bool is_close =
          std::equal(p, p + d_, q, [](double x, double y) { return std::abs(x - y) <= close; });
      if (!is_close || !in_one_facet(points_of(rays[i]), points_of(rays[j]))) continue;
      first_ray_[rays[i]] = first_ray_[rays[j]];
      break;
    }
}

bool DiagramSimplifier::is_moved(std::span<const SignedIndex> list) const {
  return std::any_of(list.begin(), list.end(), [&](SignedIndex v) { return representative(v) != v; });
}

double DiagramSimplifier::circumference(std::span<const SignedIndex> part) const {
  double sum = 0;
  for (std::size_t i = 0; i < part.size(); ++i)
    sum += kernel::distance_bound(at(part[i]), at(part[(i + 1) % part.size()]), d_, 0);
  return sum;
}

void DiagramSimplifier::represent(std::span<const SignedIndex> list, bool is_cycle,
                                  std::vector<SignedIndex>& result) const {
  result.clear();
  for (const SignedIndex v : list) result.push_back(representative(v));
  if (!is_cycle) {
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return;
  }
  result.erase(std::unique(result.begin(), result.end()), result.end());
  while (result.size() > 1 && result.front() == result.back()) result.pop_back();
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t j = i + 1; j < result.size(); ++j) {
      if (result[i] != result[j]) continue;
      const auto begin = result.begin() + static_cast<std::ptrdiff_t>(i),
                 end = result.begin() + static_cast<std::ptrdiff_t>(j);
      const std::vector<SignedIndex> part(begin, end);
      std::vector<SignedIndex> rest(result.begin(), begin);
      rest.insert(rest.end(), end, result.end());
      const bool keeps_rest = rest[0] < 0 || !(circumference(part) > circumference(rest));
      result = keeps_rest ? rest : part;
      i = static_cast<std::size_t>(-1);  // from the beginning
      break;
    }
}

void DiagramSimplifier::cut_cycles_of_regions() {
  if (!is_changed_) return;
  std::vector<SignedIndex> before, after;
  for (std::size_t r = 0; r < in_.num_regions(); ++r) {
    const auto list = in_.region(r);
    if (!is_moved(list)) {
      cycles_.insert(cycles_.end(), list.begin(), list.end());
    } else {
      represent(list, true, after);
      const auto side = [r](SignedIndex a, SignedIndex b) {
        return std::array{static_cast<SignedIndex>(r), std::min(a, b), std::max(a, b)};
      };
      std::vector<std::array<SignedIndex, 3>> old_sides, new_sides;
      for (std::size_t i = 0; i < list.size(); ++i)
        old_sides.push_back(side(representative(list[i]), representative(list[(i + 1) % list.size()])));
      for (std::size_t i = 0; i < after.size(); ++i)
        new_sides.push_back(side(after[i], after[(i + 1) % after.size()]));
      std::sort(old_sides.begin(), old_sides.end());
      std::sort(new_sides.begin(), new_sides.end());
      std::set_difference(old_sides.begin(), old_sides.end(), new_sides.begin(), new_sides.end(),
                          std::back_inserter(lost_));
      cycles_.insert(cycles_.end(), after.begin(), after.end());
    }
    cycle_offsets_.push_back(static_cast<std::int64_t>(cycles_.size()));
  }
  lost_.erase(std::remove_if(lost_.begin(), lost_.end(), [](const auto& side) { return side[1] == side[2]; }),
              lost_.end());
}

std::span<const Index> DiagramSimplifier::regions_of(SignedIndex vertex) {
  if (region_starts_.empty())
    internal::spread(num_vertices_, region_starts_, regions_at_, [&](const auto& put) {
      for (Index r = 0; r < in_.num_regions(); ++r)
        for (const SignedIndex v : in_.region(r))
          if (v >= 0) put(static_cast<std::size_t>(v), r);
    });
  const auto v = static_cast<std::size_t>(vertex);
  return std::span(regions_at_).subspan(region_starts_[v], region_starts_[v + 1] - region_starts_[v]);
}

/// Of a bounded ridge with the given vertices: those of the exact diagram, or representatives in its place.
bool DiagramSimplifier::is_thin(std::size_t i, std::span<const SignedIndex> vertices, bool is_exact) {
  // Most ridges are wide, and a few vertices show it.
  const std::size_t count = vertices.size();
  if (k_ == 3 && d_ == 3 && count > 2 &&
      kernel::is_wide_triangle(at(vertices[0]), at(vertices[count / 3]), at(vertices[2 * count / 3]),
                               tolerance_))
    return false;
  corners_.clear();
  for (std::size_t c = 0; c <= k_ && k_ + 1 < vertices.size(); ++c)
    corners_.push_back(at(vertices[c * vertices.size() / (k_ + 1)]));
  if (width_.is_wide(corners_, tolerance_)) return false;
  corners_.clear();
  for (const SignedIndex v : vertices) corners_.push_back(at(v));
  if (width_.is_wide(corners_, tolerance_)) return false;
  if (k_ <= 3) return width_.bound(corners_) <= tolerance_;
  // The facets of the ridge are what it shares with further regions.
  std::vector<std::pair<Index, SignedIndex>> shared;
  const std::size_t a = region_of_row(in_.ridge_points_[2 * i]),
                    b = region_of_row(in_.ridge_points_[2 * i + 1]);
  for (const SignedIndex v : in_.ridge(i))
    for (const Index r : regions_of(v))
      if (r != a && r != b) shared.emplace_back(r, is_exact ? v : representative(v));
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
  for (std::size_t first = 0, last = 0; first < shared.size(); first = last) {
    facet_.clear();
    for (; last < shared.size() && shared[last].first == shared[first].first; ++last)
      facet_.push_back(at(shared[last].second));
    // A lower face that counts as a facet is in one, and has a larger distance.
    if (facet_.size() + 1 >= k_ && width_.facet_bound(corners_, facet_) <= tolerance_) return true;
  }
  return false;
}

/// Whether the two rays of an unbounded polygon (k = 3) have become one. Each is dual to a hull facet with
/// both sites of the ridge.
bool DiagramSimplifier::is_single_ray(std::size_t i) const {
  const auto list = in_.ridge(i);
  if (k_ != 3 || list.size() < 3) return false;
  const auto rows = in_.ridge_points().subspan(2 * i, 2);
  Index found[2] = {invalid_index, invalid_index};
  const SignedIndex ends[2] = {list[1], list.back()};
  for (int e = 0; e < 2; ++e)
    for (auto at_end =
             std::lower_bound(rays_by_vertex_.begin(), rays_by_vertex_.end(), std::pair{ends[e], Index{0}});
         at_end != rays_by_vertex_.end() && at_end->first == ends[e]; ++at_end)
      if (in_one_facet(in_.ray_points().subspan(at_end->second * k_, k_), rows))
        found[e] = first_ray_[at_end->second];
  return found[0] != invalid_index && found[0] == found[1];
}

void DiagramSimplifier::choose_ridges() {
  if (!is_changed_) {
    // Without short edges no segment is thin. If all ridges are wide, nothing changes.
    bool any = false;
    for (std::size_t i = 0; k_ > 2 && i < in_.num_ridges() && !any; ++i)
      any = in_.ridge(i)[0] >= 0 && is_thin(i, in_.ridge(i), true);
    if (!any) return;
  }
  offsets_.assign(1, 0);
  offsets_.reserve(in_.num_ridges() + 1);
  items_.reserve(in_.ridge_vertices_.size());
  std::vector<SignedIndex> after;
  const bool is_merged = is_changed_;
  for (std::size_t i = 0; i < in_.num_ridges(); ++i) {
    internal::cancellation_point();
    const auto list = in_.ridge(i);
    const bool moved = is_merged && is_moved(list);
    after.assign(list.begin(), list.end());
    if (moved) represent(list, k_ == 3, after);
    bool goes = false;
    if (list[0] < 0) {
      goes = moved && after.size() == 2 && is_single_ray(i);
    } else if (k_ > 1) {
      goes = after.size() < k_ || is_thin(i, list, true) || (moved && is_thin(i, after, false));
    }
    if (k_ == 2 && !goes && !lost_.empty())
      for (const std::size_t side : {2 * i, 2 * i + 1})
        goes = goes ||
               std::binary_search(lost_.begin(), lost_.end(),
                                  std::array{static_cast<SignedIndex>(region_of_row(in_.ridge_points_[side])),
                                             std::min(after[0], after[1]), std::max(after[0], after[1])});
    if (goes) {
      is_gone_[i] = 1;
      is_changed_ = true;
    } else {
      items_.insert(items_.end(), after.begin(), after.end());
    }
    offsets_.push_back(static_cast<std::int64_t>(items_.size()));
  }
}

}  // namespace delone::voronoi
