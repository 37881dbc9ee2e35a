// SPDX-License-Identifier: BSD-3-Clause
#include "front_ends/convex_hull_builder.hpp"

#include "kernel/hull_stages.hpp"
#include "random.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace delone::front_ends {

ConvexHullBuilder::ConvexHullBuilder(const HullSites& sites, std::vector<Index> simplex)
    : sites_(&sites),
      simplex_(std::move(simplex)),
      certified_(static_cast<int>(simplex_.size()) - 1, difference_scale(sites)),
      fan_(sites.ambient, certified_.scale()) {
  const std::size_t k = simplex_.size() - 1;
  hull_.dimension = static_cast<int>(k);
  if (k == 1 && sites.point(simplex_[1])[sites.axes[0]] > sites.point(simplex_[0])[sites.axes[0]])
    std::swap(simplex_[0], simplex_[1]);  // cell 0, opposite site 0, is the lower end
  for (std::size_t c = 0; c <= k; ++c)
    for (std::size_t i = 0; i <= k; ++i)
      if (i != c) {
        hull_.cells.push_back(simplex_[i]);
        hull_.neighbors.push_back(static_cast<Index>(i));
      }
  resize(k + 1);
  for (std::size_t c = 0; c <= k; ++c) orient(c);
  if (k > 1)
    fan_.choose_center(sites, simplex_, [&](const double* point, const kernel::Grid& grid) {
      for (std::size_t c = 0; c <= k; ++c)
        if (side_of_cell(sites, hull_, c, point, grid, scratch_) != Sign::positive) return false;
      return true;
    });
  for (std::size_t c = 0; c <= k; ++c) update_normal(c);
  created_cells_ = k + 1;
  insertions_ = k + 1;
}

ConvexHullBuilder::ConvexHullBuilder(const HullSites& sites, const ConvexHullBuilder& other) : ConvexHullBuilder(other) {
  sites_ = &sites;
}
ConvexHullBuilder ConvexHullBuilder::moved_to(const HullSites& sites) const { return ConvexHullBuilder(sites, *this); }

/// Exchanges two vertices of a cell of the first simplex if that turns it outwards.
void ConvexHullBuilder::orient(std::size_t c) {
  if (hull_.dimension == 1) return;
  if (side_of_cell(*sites_, hull_, c, sites_->point(simplex_[c]), sites_->grid, scratch_) == Sign::positive) return;
  const std::size_t at = c * hull_.corners();
  std::swap(hull_.cells[at], hull_.cells[at + 1]);
  std::swap(hull_.neighbors[at], hull_.neighbors[at + 1]);
}

void ConvexHullBuilder::update_normal(std::size_t c) {
  double* normal = normals_.data() + c * certified_.stride();
  certified_.compute(*sites_, hull_.cell(c), hull_.dimension == 1 && c == 0, normal);
  if (fan_.has_center()) fan_.update(*sites_, hull_, c, normal);
}

void ConvexHullBuilder::resize(std::size_t cells) {
  hull_.cells.resize(cells * hull_.corners());
  hull_.neighbors.resize(cells * hull_.corners());
  normals_.resize(cells * certified_.stride());
  fan_.resize(cells, hull_.corners());
  marks_.resize(cells, Mark::unseen);
}

bool ConvexHullBuilder::in_conflict(std::size_t c, const double* q) {
  const std::span<const Index> cell = hull_.cell(c);
  Sign side = certified_.side(*sites_, normals_.data() + c * certified_.stride(), sites_->point(cell[0]), q);
  if (side != Sign::zero) {
    ++stages_.filter;
    return side == Sign::negative;
  }
  gather(c);
  side = kernel::hull_side<0>(sites_->flat(), scratch_.data(), q, sites_->grid, stages_);
  if (side == Sign::zero) {
    ++stages_.perturbed;
    const double* inner = inner_site(c);
    gather(c);
    side = kernel::perturbed_hull_side<0>(sites_->flat(), scratch_.data(), q, inner, sites_->grid);
  }
  return side == Sign::negative;
}

void ConvexHullBuilder::gather(std::size_t c) {
  scratch_.clear();
  for (const Index site : hull_.cell(c)) scratch_.push_back(sites_->point(site));
}

/// A site off the hyperplane of cell c: one of any k+1 that span the flat.
const double* ConvexHullBuilder::inner_site(std::size_t c) {
  for (const Index site : simplex_) {
    gather(c);
    StageCounts uncounted;
    if (kernel::hull_side<0>(sites_->flat(), scratch_.data(), sites_->point(site), sites_->grid, uncounted) != Sign::zero)
      return sites_->point(site);
  }
  return nullptr;  // not reached
}

/// k = 1: the ends of a range of numbers.
bool ConvexHullBuilder::insert_end(Index site) {
  const int axis = sites_->axes[0];
  const double x = sites_->point(site)[axis];
  const std::size_t c = x < sites_->point(hull_.cells[0])[axis] ? 0 : x > sites_->point(hull_.cells[1])[axis] ? 1 : 2;
  if (c == 2) return false;
  hull_.cells[c] = site;
  update_normal(c);
  ++created_cells_;
  ++insertions_;
  return true;
}

/// A cell in conflict with q, or the number of cells if there is none. The fan does not change when the perturbation moves
/// sites on its rays, so q is hidden iff it is not beyond the cell of its cone, perturbed.
std::size_t ConvexHullBuilder::find_conflict(const double* q) {
  const std::size_t m = hull_.num_cells();
  if (fan_.has_center()) {
    std::size_t c = fan_.descend(*sites_, hull_, q, last_);
    if (in_conflict(c, q)) return c;
    c = fan_.walk(*sites_, hull_, q, c, sites_->grid);
    return in_conflict(c, q) ? c : m;
  }
  std::size_t c = 0;
  while (c < m && !in_conflict(c, q)) ++c;
  return c;
}

/// All cells in conflict, which are connected, and the ridges around them.
void ConvexHullBuilder::find_zone(std::size_t first, const double* q) {
  dead_.assign(1, first);
  survivors_.clear();
  horizon_.clear();
  marks_[first] = Mark::in_conflict;
  for (std::size_t next = 0; next < dead_.size(); ++next)
    for (std::size_t i = 0; i < hull_.corners(); ++i) {
      const Index across = hull_.neighbors_of(dead_[next])[i];
      if (marks_[across] == Mark::unseen) {
        const bool conflict = in_conflict(across, q);
        auto& list = conflict ? dead_ : survivors_;
        list.push_back(across);
        marks_[across] = conflict ? Mark::in_conflict : Mark::not_in_conflict;
      }
      if (marks_[across] == Mark::not_in_conflict) horizon_.push_back({dead_[next], i});
    }
}

void ConvexHullBuilder::forget_marks() {
  for (const auto* list : {&dead_, &survivors_})
    for (const std::size_t c : *list)
      if (c < marks_.size()) marks_[c] = Mark::unseen;
}

bool ConvexHullBuilder::insert(Index site) {
  if (hull_.dimension == 1) return insert_end(site);
  const std::size_t k = hull_.corners(), m = hull_.num_cells();
  const double* q = sites_->point(site);
  const std::size_t first = find_conflict(q);
  if (first == m) return false;
  try {
    find_zone(first, q);
    const std::size_t total = std::max(m, m - dead_.size() + horizon_.size());
    if (total > max_index) throw Error(Errc::too_many, "the hull has more cells than this build has ids");
    const Cone cone = make_cone(site);
    if (total * k > hull_.cells.capacity()) {
      const std::size_t grown = total + total / 2;
      hull_.cells.reserve(grown * k);
      hull_.neighbors.reserve(grown * k);
      normals_.reserve(grown * certified_.stride());
      fan_.reserve(grown, k);
      marks_.reserve(grown);
    }
    replace_zone(cone);
  } catch (...) {
    forget_marks();
    throw;
  }
  forget_marks();
  created_cells_ += horizon_.size();
  ++insertions_;
  return true;
}

/// New cells: a dead cell with the new site in place of the vertex opposite the horizon's ridge, so oriented alike. Ridges that
/// contain the site are shared by two of them: they are found by sums of mixed ids, and compared.
ConvexHullBuilder::Cone ConvexHullBuilder::make_cone(Index site) const {
  const std::size_t k = hull_.corners(), born = horizon_.size();
  Cone cone{std::vector<Index>(born * k), std::vector<Index>(born * k, invalid_index), std::vector<Index>(born)};
  const auto same_ridge = [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a / k * k; i < a / k * k + k; ++i) {
      bool found = i == a;
      for (std::size_t j = b / k * k; j < b / k * k + k && !found; ++j) found = j != b && cone.cells[i] == cone.cells[j];
      if (!found) return false;
    }
    return true;
  };
  std::unordered_multimap<std::uint64_t, std::size_t> open;
  for (std::size_t b = 0; b < born; ++b) {
    const auto [c, slot] = horizon_[b];
    cone.places[b] = static_cast<Index>(b < dead_.size() ? dead_[b] : hull_.num_cells() + b - dead_.size());
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < k; ++i) {
      cone.cells[b * k + i] = i == slot ? site : hull_.cells[c * k + i];
      sum += random::mix(cone.cells[b * k + i] + std::uint64_t{1});
    }
    for (std::size_t i = 0; i < k; ++i) {
      if (i == slot) continue;
      const std::size_t at = b * k + i;
      const std::uint64_t key = sum - random::mix(cone.cells[at] + std::uint64_t{1});
      auto [first, last] = open.equal_range(key);
      while (first != last && !same_ridge(at, first->second)) ++first;
      if (first == last) {
        open.emplace(key, at);
        continue;
      }
      cone.neighbors[at] = static_cast<Index>(first->second / k);
      cone.neighbors[first->second] = static_cast<Index>(b);
      open.erase(first);
    }
  }
  return cone;
}

/// Puts the cone in the places of the dead cells, and of new ones at the end. Memory has been reserved: it cannot fail.
void ConvexHullBuilder::replace_zone(const Cone& cone) {
  const std::size_t k = hull_.corners(), m = hull_.num_cells(), born = horizon_.size();
  std::vector<Index> survivor_of(born), mirror_of(born);
  for (std::size_t b = 0; b < born; ++b) {
    const Index survivor = survivor_of[b] = hull_.neighbors[horizon_[b].cell * k + horizon_[b].slot];
    // In the plane both neighbors of a survivor may be in the zone, and even be one cell: the vertices tell.
    const auto is_mirror = [&](std::size_t i) {
      if (hull_.neighbors[survivor * k + i] != horizon_[b].cell) return false;
      for (std::size_t j = 0; j < k; ++j) {
        const auto first = cone.cells.begin() + static_cast<std::ptrdiff_t>(b * k),
                   last = first + static_cast<std::ptrdiff_t>(k);
        if (j != i && std::find(first, last, hull_.cells[survivor * k + j]) == last) return false;
      }
      return true;
    };
    while (!is_mirror(mirror_of[b])) ++mirror_of[b];
  }
  if (born > dead_.size()) resize(m + born - dead_.size());
  for (std::size_t b = 0; b < born; ++b) {
    const std::size_t place = cone.places[b];
    hull_.neighbors[survivor_of[b] * k + mirror_of[b]] = cone.places[b];
    for (std::size_t i = 0; i < k; ++i) {
      hull_.cells[place * k + i] = cone.cells[b * k + i];
      hull_.neighbors[place * k + i] = i == horizon_[b].slot ? survivor_of[b] : cone.places[cone.neighbors[b * k + i]];
    }
    update_normal(place);
  }
  last_ = cone.places[0];
  if (born < dead_.size()) close_gaps(born);
}

/// More cells died than were born: the last cells move to the places that are left.
void ConvexHullBuilder::close_gaps(std::size_t born) {
  const std::size_t k = hull_.corners(), m = hull_.num_cells(), left = m - (dead_.size() - born);
  const auto gaps = std::span(dead_).subspan(born);
  std::sort(gaps.begin(), gaps.end());
  std::size_t from = m;
  for (const std::size_t to : gaps) {
    if (to >= left) break;
    do --from;
    while (std::binary_search(gaps.begin(), gaps.end(), from));
    for (std::size_t i = 0; i < k; ++i) {
      hull_.cells[to * k + i] = hull_.cells[from * k + i];
      const Index across = hull_.neighbors[to * k + i] = hull_.neighbors[from * k + i];
      for (std::size_t j = 0; j < k; ++j)
        if (hull_.neighbors[across * k + j] == from) hull_.neighbors[across * k + j] = static_cast<Index>(to);
    }
    std::copy_n(normals_.begin() + static_cast<std::ptrdiff_t>(from * certified_.stride()), certified_.stride(),
                normals_.begin() + static_cast<std::ptrdiff_t>(to * certified_.stride()));
    if (fan_.has_center()) fan_.move(from, to, k);
    if (last_ == from) last_ = to;
  }
  resize(left);
}

}  // namespace delone::front_ends
