// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_builder.hpp"

#include "base/compiled_dimension.hpp"
#include "compiled/dispatch.hpp"
#include "hull/hull_fan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::internal {
namespace {

/// Cells have one dimension less than the flat.
std::unique_ptr<HullEngine> boundary_of_simplex(const HullSites& sites, const HullView& view,
                                                const std::vector<Index>& simplex) {
  return with_compiled_dimension(sites.axes.size(), [&](auto dimension) {
    return make_hull_engine<(dimension() > 1 ? dimension() - 1 : 0)>(sites, view, simplex);
  });
}

}  // namespace

ConvexHullBuilder::ConvexHullBuilder(const HullSites& sites, const std::vector<Index>& simplex)
    : sites_(sites),
      view_{std::vector<double>(static_cast<std::size_t>(sites.ambient), 0.0), false, sites.grid, {}, {}} {
  now_.insertions = simplex.size();
  if (simplex.size() == 2) {
    const int axis = sites.axes[0];
    const bool ascending = sites.point(simplex[0])[axis] < sites.point(simplex[1])[axis];
    now_.ends[0] = simplex[ascending ? 0 : 1];
    now_.ends[1] = simplex[ascending ? 1 : 0];
    now_.effort_of_ends.created_cells = 2;
    return;
  }
  const double* first = sites.point(simplex[0]);
  view_.low.assign(first, first + sites.ambient);
  view_.high = view_.low;
  for (Index site = 0; site < sites.size(); ++site) grow_box(sites.point(site), 0);
  choose_center(simplex);
  boundary_ = boundary_of_simplex(sites, view_, simplex);
}

ConvexHullBuilder::ConvexHullBuilder(const HullSites& sites, const ConvexHullBuilder& other)
    : sites_(sites), view_(other.view_), now_(other.now_), threads_(other.threads_) {
  now_.hull_is_current = false;
  const std::lock_guard lock(other.mutex_);
  places_ = other.places_;
  was_shared_ = other.was_shared_;
  ids_tell_of_timing_ = other.ids_tell_of_timing_;
  if (other.boundary_) boundary_ = other.boundary_->copy(sites, view_);
}

/// Seen from a point strictly inside the first simplex, if a double is.
void ConvexHullBuilder::choose_center(const std::vector<Index>& simplex) {
  std::vector<const double*> points;
  for (const Index site : simplex) points.push_back(sites_.point(site));
  const kernel::Flat flat = sites_.flat();
  const Sign orientation = kernel::orientation<0>(flat, points.data(), sites_.grid);
  view_.is_inside = choose_interior_point(
      sites_, simplex, view_.center, [&](const double* point, const kernel::Grid& grid) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double* const vertex = std::exchange(points[i], point);
          const Sign side = kernel::orientation<0>(flat, points.data(), grid);
          points[i] = vertex;
          if (side != orientation) return false;
        }
        return true;
      });
  view_.grid.include(view_.center.data());
}

/// `margin` times the box is added where it has to grow, so that points arriving from ever farther away
/// change it a logarithmic number of times.
void ConvexHullBuilder::grow_box(const double* point, double margin) {
  constexpr double largest = std::numeric_limits<double>::max();
  for (std::size_t j = 0; j < view_.low.size(); ++j) {
    const double extent = std::min(view_.high[j] / 2 - view_.low[j] / 2, largest / 8) * margin;
    if (point[j] < view_.low[j]) view_.low[j] = std::max(point[j] - extent, -largest);
    if (point[j] > view_.high[j]) view_.high[j] = std::min(point[j] + extent, largest);
  }
}

/// k = 1: the ends of a range of numbers.
Insertion ConvexHullBuilder::insert_end(Index site) {
  const int axis = sites_.axes[0];
  const double x = sites_.point(site)[axis];
  const bool below = x < sites_.point(now_.ends[0])[axis];
  if (!below && !(x > sites_.point(now_.ends[1])[axis])) return Insertion::interior;
  now_.ends[below ? 0 : 1] = site;
  ++now_.effort_of_ends.created_cells;
  return Insertion::vertex;
}

void ConvexHullBuilder::include_sites(Index first) {
  if (!boundary_) return;
  bool in_box = true;
  for (Index site = first; site < sites_.size(); ++site) {
    const double* point = sites_.point(site);
    view_.grid.include(point);
    for (std::size_t j = 0; j < view_.low.size(); ++j)
      in_box &= view_.low[j] <= point[j] && point[j] <= view_.high[j];
  }
  if (in_box) return;
  std::vector<double> low = view_.low, high = view_.high;
  for (Index site = first; site < sites_.size(); ++site) grow_box(sites_.point(site), 2.0);
  try {
    boundary_->update_box();
  } catch (...) {
    view_.low = std::move(low);
    view_.high = std::move(high);
    throw;
  }
}

void ConvexHullBuilder::count(Insertion outcome) {
  if (outcome != Insertion::vertex) return;
  ++now_.insertions;
  now_.hull_is_current = false;
  if (was_shared_) ids_tell_of_timing_ = true;
}

Insertion ConvexHullBuilder::insert(Index site) {
  const Insertion outcome = boundary_ ? boundary_->insert(site) : insert_end(site);
  count(outcome);
  return outcome;
}

struct ConvexHullBuilder::SiteBatch final : engine::Batch {
  SiteBatch(ConvexHullBuilder& to, std::span<const Index> all,
            const std::function<void(Index, Insertion)>& listener)
      : builder(to), sites(all), tell(listener) {}

  Index next() override { return place < sites.size() ? sites[place++] + 1 : invalid_index; }
  void placed(Index v, Index at, bool strictly) override {
    const Insertion outcome = at == v    ? Insertion::vertex
                              : strictly ? Insertion::interior
                                         : Insertion::hidden;
    builder.count(outcome);
    tell(v - 1, outcome);
  }

  ConvexHullBuilder& builder;
  std::span<const Index> sites;
  const std::function<void(Index, Insertion)>& tell;
  std::size_t place = 0;
};

void ConvexHullBuilder::insert_all(std::span<const Index> sites,
                                   const std::function<void(Index, Insertion)>& placed) {
  if (boundary_) {
    SiteBatch batch(*this, sites, placed);
    boundary_->insert_all(batch);
  } else {
    for (const Index site : sites) placed(site, insert(site));
  }
}

void ConvexHullBuilder::prepare_for_threads(std::span<const Index> order) {
  places_.add(order, sites_.size());
  ids_tell_of_timing_ = was_shared_ = true;
}

void ConvexHullBuilder::insert_all(std::span<const Index> sites, std::span<const std::size_t> rounds,
                                   unsigned threads, const std::function<void(std::size_t)>& tick,
                                   const std::function<void(Index, Insertion)>& placed) {
  threads_ = threads;
  std::vector<Index> at(sites.size());
  std::vector<char> strictly(sites.size());
  engine::ParallelBatch batch{threads, 1, at, rounds, tick, sites, now_.insertions, strictly};
  boundary_->insert_all(batch);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Insertion outcome = at[i] == sites[i] + 1 ? Insertion::vertex
                              : strictly[i] != 0    ? Insertion::interior
                                                    : Insertion::hidden;
    count(outcome);
    placed(sites[i], outcome);
  }
}

void ConvexHullBuilder::find_surely_interior(std::span<const Index> sites, std::span<char> is_interior,
                                             unsigned threads) const {
  if (boundary_)
    boundary_->find_surely_interior(sites, is_interior, threads);
  else
    std::fill(is_interior.begin(), is_interior.end(), 0);
}

void ConvexHullBuilder::begin_batch() {
  // What is undone is undone slot by slot: cells stay where they are from now on, until they are kept.
  sort_cells();
  before_ = now_;
  if (boundary_) boundary_->begin_batch();
  is_in_batch_ = true;
}
void ConvexHullBuilder::keep_batch() noexcept {
  if (boundary_) boundary_->keep_batch();
  is_in_batch_ = false;
}
void ConvexHullBuilder::undo_batch() noexcept {
  if (boundary_) boundary_->undo_batch();
  ids_tell_of_timing_ = is_in_batch_ = false;  // as when it began
  now_ = before_;
  now_.hull_is_current = false;  // it may have been made for the batch
}

void ConvexHullBuilder::sort_cells() const {
  if (!ids_tell_of_timing_ || is_in_batch_) return;
  places_.add({}, sites_.size());  // sites that came singly
  boundary_->sort_cells(places_.of_vertices(), threads_);
  ids_tell_of_timing_ = false;
  now_.hull_is_current = false;
}

std::size_t ConvexHullBuilder::bytes() const {
  const std::lock_guard lock(mutex_);
  return boundary_ ? boundary_->bytes() : sizeof(now_.ends);
}

const SimplicialHull& ConvexHullBuilder::hull() const {
  const std::lock_guard lock(mutex_);
  sort_cells();
  if (!now_.hull_is_current) {
    hull_ = boundary_ ? boundary_->to_simplicial_hull()
                      : SimplicialHull{1, {now_.ends[0], now_.ends[1]}, {1, 0}, {}};
    now_.hull_is_current = true;
  }
  return hull_;
}

}  // namespace delone::internal
