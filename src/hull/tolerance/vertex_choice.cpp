// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/vertex_choice.hpp"

#include "hull/flat_distance.hpp"
#include "hull/growing_flat.hpp"
#include "hull/hull_analysis.hpp"
#include "hull/hull_state.hpp"
#include "hull/tolerance/cover.hpp"
#include "hull/tolerance/grown_choice.hpp"
#include "kernel/nearest_in_hull.hpp"

#include <algorithm>
#include <cmath>

namespace delone::hull {
namespace {

bool is_less(const double* a, const double* b, int dimension) {
  return std::lexicographical_compare(a, a + dimension, b, b + dimension);
}

std::vector<const double*> points_of(const BoundarySites& sites, const ExtremeSites& extreme) {
  std::vector<const double*> points;
  for (const Index site : extreme.sites()) points.push_back(sites.point(site));
  return points;
}

/// Whether a direction n proves that the distance of v from the hull of its neighbors exceeds the tolerance:
/// it is at least the least n·(v − w), divided by |n|. A computed n·(v − w) is off by at most γ(d+1) of the
/// sum of the absolute products; underflow of those is far below the absolute term, and n is longer than
/// 2^−400.
bool is_far_along(std::span<const double> n, std::span<const double* const> neighbors, const double* v,
                  double tolerance) {
  const std::size_t d = n.size();
  double square = 0;
  for (const double x : n) square += x * x;
  const double length = std::sqrt(square) * (1 + static_cast<double>(d + 4) * kernel::unit_roundoff);
  if (!(length > 0x1p-400 && length < 0x1p400)) return false;
  const double least = tolerance * length * (1 + 4 * kernel::unit_roundoff) + 0x1p-1000;
  const double rounding = 1.01 * static_cast<double>(d + 2) * kernel::unit_roundoff;
  return std::all_of(neighbors.begin(), neighbors.end(), [&](const double* w) {
    double product = 0, parts = 0;
    for (std::size_t j = 0; j < d; ++j) {
      const double term = n[j] * (v[j] - w[j]);
      product += term;
      parts += std::fabs(term);
    }
    return product - rounding * parts > least;
  });
}

/// The direction from the mean of the neighbors to v.
void set_mean_direction(std::span<const double* const> neighbors, const double* v, std::vector<double>& n) {
  std::fill(n.begin(), n.end(), 0.0);
  const double share = 1 / static_cast<double>(neighbors.size());
  for (const double* w : neighbors)
    for (std::size_t j = 0; j < n.size(); ++j) n[j] += (v[j] - w[j]) * share;
}

/// Notes which of the extreme sites are necessary, by their places. Examines each `step`-th one.
void find_necessary(const BoundarySites& sites, const ExtremeSites& extreme, double tolerance,
                    std::size_t step, std::vector<char>& necessary, const std::function<void()>& alive,
                    const DirectionOf& direction_of = {}) {
  const std::size_t h = extreme.size();
  std::vector<char> marks(h, 0);
  std::vector<Index> neighbors;
  std::vector<const double*> points;
  std::vector<double> mean(static_cast<std::size_t>(sites.ambient));
  Cover distances({}, sites.ambient, tolerance, {}, {});
  for (std::size_t v = 0; v < h; v += step) {
    alive();
    if (necessary[v] != 0) continue;
    neighbors.clear();
    marks[v] = 1;
    extreme.add_neighbors(v, marks, neighbors);
    marks[v] = 0;
    for (const Index w : neighbors) marks[w] = 0;
    if (neighbors.empty()) {
      necessary[v] = 1;  // the only site
      continue;
    }
    points.clear();
    for (const Index w : neighbors) points.push_back(sites.point(extreme.site(w)));
    const double* const point = sites.point(extreme.site(v));
    set_mean_direction(points, point, mean);
    necessary[v] = is_far_along(mean, points, point, tolerance) ||
                   (direction_of && is_far_along(direction_of(extreme.site(v)), points, point, tolerance)) ||
                   distances.exceeds(points, point);
  }
}

VertexChoice choice_of(Cover& cover, const ExtremeSites& extreme) {
  VertexChoice choice;
  std::vector<Index> places = cover.kept();
  std::sort(places.begin(), places.end());
  for (const Index place : places) choice.sites.push_back(extreme.site(place));
  choice.max_distance = cover.max_distance();
  return choice;
}

/// The choice among the sites that are extreme in the projection on the axes; none if they do not cover all.
std::optional<NearFlatChoice> choose_projected(const BoundarySites& sites, const ExtremeSites& extreme,
                                               std::vector<int> axes, double tolerance,
                                               const std::function<void()>& alive) {
  std::vector<char> allowed(extreme.size(), 0), required(extreme.size(), 0);
  std::optional<ExtremeSites> projected;
  std::vector<Index> place_of;  // by place among the projected ones: among all
  std::vector<Index> projected_place(extreme.size(), invalid_index);
  if (axes.empty()) {
    allowed[0] = 1;
  } else {
    std::vector<double> coordinates;
    for (const Index site : extreme.sites())
      for (const int axis : axes) coordinates.push_back(sites.point(site)[axis]);
    HullState state(static_cast<int>(axes.size()));
    state.insert_range(coordinates, {});
    if (state.affine_hull().dimension() < static_cast<int>(axes.size())) return std::nullopt;
    const HullAnalysis analysis(state);
    projected.emplace(state.sites(), analysis.facet_sites());
    std::vector<char> necessary(projected->size(), 0);
    find_necessary(state.sites(), *projected, tolerance, 1, necessary, alive);
    for (std::size_t i = 0; i < projected->size(); ++i) {
      const auto place = static_cast<Index>(state.row(projected->site(i)));
      place_of.push_back(place);
      projected_place[place] = static_cast<Index>(i);
      allowed[place] = 1;
      required[place] = necessary[i];
    }
  }
  std::vector<char> marks(place_of.size(), 0);
  std::vector<Index> list;
  const auto add_neighbors = [&](std::size_t p, std::vector<char>& is_marked, std::vector<Index>& result) {
    if (projected_place[p] == invalid_index) return;
    list.clear();
    projected->add_neighbors(projected_place[p], marks, list);
    for (const Index i : list) {
      marks[i] = 0;
      if (std::exchange(is_marked[place_of[i]], 1) == 0) result.push_back(place_of[i]);
    }
  };
  Cover cover(points_of(sites, extreme), sites.ambient, tolerance, add_neighbors, alive);
  for (std::size_t p = 0; p < required.size(); ++p)
    if (required[p] != 0) cover.require(static_cast<Index>(p));
  if (!cover.complete(allowed)) return std::nullopt;
  cover.reduce();
  return NearFlatChoice{std::move(axes), choice_of(cover, extreme)};
}

/// Whether a first choice is grown: if there are many sites of full dimension, and few cells.
bool grows(const BoundarySites& sites, std::size_t num_sites) {
  constexpr std::size_t least_sites = 256;
  constexpr int most_dimensions = 4;
  return num_sites >= least_sites && sites.ambient >= 2 && sites.ambient <= most_dimensions &&
         sites.dimension() == sites.ambient;
}

/// Whether no point that a flat grows by is within the tolerance of it, by the least height of their simplex.
bool is_far_from_flats(GrowingFlat flat, int dimension, double tolerance) {
  for (int k = 0; k < dimension; ++k) flat.grow();
  kernel::NearestInHull heights;
  return heights.least_height_down(flat.basis(), dimension) > tolerance;
}

}  // namespace

ExtremeSites::ExtremeSites(const BoundarySites& sites, const Lists& facet_sites) {
  std::vector<char> is_extreme(sites.size(), 0);
  for (const Index site : facet_sites.items) is_extreme[site] = 1;
  for (Index site = 0; site < sites.size(); ++site)
    if (is_extreme[site] != 0) sites_.push_back(site);
  std::sort(sites_.begin(), sites_.end(),
            [&](Index a, Index b) { return is_less(sites.point(a), sites.point(b), sites.ambient); });
  std::vector<Index> place_of(sites.size(), invalid_index);
  for (std::size_t i = 0; i < sites_.size(); ++i) place_of[sites_[i]] = static_cast<Index>(i);
  facets_ = facet_sites;
  for (Index& site : facets_.items) site = place_of[site];
  if (facets_.size() == 2 && sites_.size() == 2) {  // a segment
    facets_ = {};
    facets_.add(std::vector<Index>{0, 1});
  }
  facets_of_ = lists_with_each(facets_, sites_.size());
}

void ExtremeSites::add_neighbors(std::size_t place, std::vector<char>& marks,
                                 std::vector<Index>& list) const {
  for (const Index f : facets_of_[place])
    for (const Index v : facets_[f])
      if (std::exchange(marks[v], 1) == 0) list.push_back(v);
}

VertexChoice choose_vertices(const BoundarySites& sites, const ExtremeSites& extreme, double tolerance,
                             const std::function<void()>& alive, const DirectionOf& direction_of) {
  std::vector<char> necessary(extreme.size(), 0);
  constexpr std::size_t sample = 256;
  const std::size_t step = extreme.size() / sample + 1;
  // The directions of all may cost more than a sample.
  find_necessary(sites, extreme, tolerance, step, necessary, alive, step == 1 ? direction_of : nullptr);
  const auto found = static_cast<std::size_t>(std::count(necessary.begin(), necessary.end(), 1));
  // Where few of a sample are necessary, the others that are will be kept anyway, and cannot be dropped.
  const bool is_grown = 2 * found * step < extreme.size() && grows(sites, extreme.size());
  if (!is_grown && step > 1) find_necessary(sites, extreme, tolerance, 1, necessary, alive, direction_of);
  if (std::find(necessary.begin(), necessary.end(), 0) == necessary.end()) return {extreme.sites(), 0};
  Cover cover(
      points_of(sites, extreme), sites.ambient, tolerance,
      [&](std::size_t p, std::vector<char>& marks, std::vector<Index>& list) {
        extreme.add_neighbors(p, marks, list);
      },
      alive);
  std::vector<Index> required;
  for (std::size_t p = 0; p < necessary.size(); ++p)
    if (necessary[p] != 0) required.push_back(static_cast<Index>(p));
  for (const Index p : required) cover.require(p);
  if (is_grown) {
    const std::vector<const double*> points = points_of(sites, extreme);
    const GrownChoice grown = grow_choice(points, sites.ambient, tolerance, required, alive);
    std::vector<char> is_kept(points.size(), 0);
    for (const Index p : grown.kept) {
      is_kept[p] = 1;
      if (necessary[p] == 0) cover.keep(p);
    }
    const auto d = static_cast<std::size_t>(sites.ambient);
    for (std::size_t p = 0; p < points.size() && !grown.corners.empty(); ++p)
      if (is_kept[p] == 0) cover.approach(static_cast<Index>(p), std::span(grown.corners).subspan(p * d, d));
  }
  cover.complete(std::vector<char>(extreme.size(), 1));
  cover.reduce();
  return choice_of(cover, extreme);
}

std::optional<NearFlatChoice> choose_in_flat(const BoundarySites& sites, const ExtremeSites& extreme,
                                             int dimension, double tolerance,
                                             const std::function<void()>& alive) {
  GrowingFlat flat(points_of(sites, extreme), sites.ambient);
  if (is_far_from_flats(flat, dimension, tolerance)) return std::nullopt;
  for (int k = 0; k < dimension; ++k) {
    if (is_near_flat(flat.basis(), flat.farthest(), sites.ambient, tolerance))
      if (auto choice = choose_projected(sites, extreme, flat.axes(), tolerance, alive)) return choice;
    flat.grow();
  }
  return std::nullopt;
}

}  // namespace delone::hull
