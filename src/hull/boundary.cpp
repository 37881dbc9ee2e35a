// SPDX-License-Identifier: BSD-3-Clause
#include "hull/boundary.hpp"

#include "base/large_vector.hpp"
#include "kernel/hull_stages.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace delone::hull {

using engine::Outcome;

Boundary::Boundary(const BoundarySites& sites, const std::vector<Index>& simplex, CentralView view)
    : sites_(sites), view_(std::move(view)), is_surely_interior_(sites.size(), 0) {
  now_.insertions = simplex.size();
  if (simplex.size() == 2) {
    now_.ends[0] = simplex[0];
    now_.ends[1] = simplex[1];
    if (side_of_end(0, simplex[1]) == Sign::negative) std::swap(now_.ends[0], now_.ends[1]);
    now_.effort_of_ends.created_cells = 2;
    return;
  }
  const auto k = static_cast<std::size_t>(sites.dimension());
  for (std::size_t r = 0; r < k; ++r) view_.low.push_back(sites.image(simplex[0], r));
  view_.high = view_.low;
  grow_box(0, 0);
  engine_ = compiled::make_boundary_engine(sites, view_, simplex);
}

Boundary::Boundary(const BoundarySites& sites, const Boundary& other)
    : sites_(sites),
      view_(other.view_),
      is_surely_interior_(other.is_surely_interior_),
      now_(other.now_),
      threads_(other.threads_) {
  now_.hull_is_current = false;
  const std::lock_guard lock(other.mutex_);
  places_ = other.places_;
  was_shared_ = other.was_shared_;
  ids_tell_of_timing_ = other.ids_tell_of_timing_;
  if (other.engine_) engine_ = other.engine_->copy(sites, view_);
}

/// For the sites from `first` on. `margin` times the box is added where it has to grow, so that sites
/// arriving from ever farther away change it a logarithmic number of times. Returns whether it has grown.
bool Boundary::grow_box(Index first, double margin) {
  constexpr double largest = std::numeric_limits<double>::max();
  std::vector<double> low = view_.low, high = view_.high;
  for (Index site = first; site < sites_.size(); ++site)
    for (std::size_t r = 0; r < low.size(); ++r) {
      const double x = sites_.image(site, r);
      low[r] = std::min(low[r], x);
      high[r] = std::max(high[r], x);
    }
  bool has_grown = false;
  for (std::size_t r = 0; r < low.size(); ++r) {
    const double extent = std::min(view_.high[r] / 2 - view_.low[r] / 2, largest / 8) * margin;
    if (low[r] < view_.low[r])
      view_.low[r] = std::min(low[r], std::max(low[r] - extent, -largest)), has_grown = true;
    if (high[r] > view_.high[r])
      view_.high[r] = std::max(high[r], std::min(high[r] + extent, largest)), has_grown = true;
  }
  return has_grown;
}

void Boundary::include_sites(Index first) {
  is_surely_interior_.resize(sites_.size(), 0);
  if (!engine_) return;
  std::vector<double> low = view_.low, high = view_.high;
  for (Index site = first; site < sites_.size() && !sites_.is_homogeneous(); ++site)
    view_.grid.include(sites_.point(site));
  if (!grow_box(first, 2.0)) return;
  try {
    engine_->update_box();
  } catch (...) {
    view_.low = std::move(low);
    view_.high = std::move(high);
    throw;
  }
}

Sign Boundary::side_of_end(std::size_t c, Index site) const {
  const double* const end = sites_.point(now_.ends[c]);
  internal::StageCounts uncounted;
  const Sign sign = kernel::hull_side<0>(sites_.flat(), &end, sites_.point(site), sites_.grid, uncounted);
  return (c == 0) == sites_.is_homogeneous() ? sign : -sign;
}

Outcome Boundary::insert_end(Index site) {
  for (const std::size_t c : {0, 1})
    if (side_of_end(c, site) == Sign::negative) {
      now_.ends[c] = site;
      ++now_.effort_of_ends.created_cells;
      return Outcome::done;
    }
  return Outcome::interior;
}

void Boundary::note(Index site, Outcome outcome) {
  is_surely_interior_[site] = outcome == Outcome::interior ? 1 : 0;
  if (outcome != Outcome::done) return;
  ++now_.insertions;
  now_.hull_is_current = false;
  if (was_shared_) ids_tell_of_timing_ = true;
}

void Boundary::replace_cells(const SimplicialHull& hull, std::span<const Index> planes,
                             std::span<const Index> added, std::span<const char> is_inside) {
  if (was_shared_) places_.add(added, sites_.size());
  engine_->replace_cells(hull, planes);
  for (const Index site : added) note(site, is_inside[site] != 0 ? Outcome::interior : Outcome::done);
  ids_tell_of_timing_ = false;
}

Outcome Boundary::insert(Index site) {
  const Outcome outcome = engine_ ? engine_->insert(site + 1, invalid_index).outcome : insert_end(site);
  note(site, outcome);
  return outcome;
}

void Boundary::insert_part(std::span<const Index> sites, std::span<const std::size_t> rounds,
                           unsigned threads, const std::function<void(std::size_t)>& tick) {
  std::vector<Index> at(sites.size());
  std::vector<char> strictly(sites.size());
  engine_->insert_all(
      {threads, 1, at, rounds, tick, sites, static_cast<std::size_t>(now_.insertions), strictly});
  for (std::size_t i = 0; i < sites.size(); ++i)
    note(sites[i], at[i] == sites[i] + 1 ? Outcome::done
                   : strictly[i] != 0    ? Outcome::interior
                                         : Outcome::hidden);
}

void Boundary::insert_all(std::span<const Index> sites, const std::function<void(std::size_t)>& tick) {
  constexpr std::size_t part = 4096;  // at a time, for what is said of each takes memory
  for (std::size_t begin = 0; engine_ && begin < sites.size(); begin += part)
    insert_part(sites.subspan(begin, std::min(part, sites.size() - begin)), {}, 1,
                [&](std::size_t done) { tick(begin + done); });
  for (std::size_t i = 0; !engine_ && i < sites.size(); ++i) {
    insert(sites[i]);
    tick(i + 1);
  }
}

void Boundary::insert_all(std::span<const Index> sites, std::span<const std::size_t> rounds, unsigned threads,
                          const std::function<void(std::size_t)>& tick) {
  if (threads < 2) return insert_all(sites, tick);
  threads_ = threads;
  constexpr std::size_t least_round = 2048;
  std::vector<std::size_t> ends;  // of the rounds to come
  std::vector<Index> outside;
  for (std::size_t begin = 0, end = 0; begin < sites.size(); begin = end) {
    std::span<const Index> next = sites.subspan(begin);
    end = sites.size();
    ends.clear();
    for (const std::size_t round : rounds)
      if (round > begin) ends.push_back(round - begin);
    if (are_many_interior(next)) {
      end = std::min(end, ends.empty() ? std::max(2 * begin, least_round) : begin + ends.front());
      next = next.first(end - begin);
      find_interior(next, threads);
      outside.clear();
      for (const Index site : next)
        if (!is_surely_interior(site)) outside.push_back(site);
      next = outside;
      ends.clear();
    }
    const auto tick_of_all = [&](std::size_t done) { tick(begin + done); };
    if (shares_batches_of(next.size()))
      insert_part(next, ends, threads, tick_of_all);
    else
      insert_all(next, tick_of_all);
  }
}

void Boundary::prepare_for_threads(std::span<const Index> order) {
  places_.add(order, sites_.size());
  ids_tell_of_timing_ = was_shared_ = true;
}

void Boundary::find_interior(std::span<const Index> sites, unsigned threads) {
  std::vector<char> is_interior(sites.size(), 0);
  if (engine_) compiled::find_surely_interior(*engine_, sites, is_interior, threads);
  for (std::size_t i = 0; i < sites.size(); ++i) is_surely_interior_[sites[i]] = is_interior[i];
}

/// Whether at least a quarter of some sites are strictly inside.
bool Boundary::are_many_interior(std::span<const Index> sites) const {
  std::array<Index, 64> sample;
  std::array<char, sample.size()> is_interior;
  if (!engine_ || sites.size() < 2 * sample.size()) return false;
  for (std::size_t i = 0; i < sample.size(); ++i) sample[i] = sites[i * (sites.size() / sample.size())];
  compiled::find_surely_interior(*engine_, sample, is_interior, 1);
  return std::count(is_interior.begin(), is_interior.end(), 1) >= std::ptrdiff_t{sample.size() / 4};
}

void Boundary::drop_interior(std::vector<Index>& sites, unsigned threads) {
  if (!are_many_interior(sites)) return;
  find_interior(sites, threads);
  std::erase_if(sites, [&](Index site) { return is_surely_interior(site); });
}

void Boundary::begin_batch() {
  // What is undone is undone slot by slot: cells stay where they are from now on, until they are kept.
  sort_cells();
  before_ = now_;
  num_sites_before_ = is_surely_interior_.size();
  if (engine_) engine_->begin_batch();
  is_in_batch_ = true;
}
void Boundary::keep_batch() noexcept {
  if (engine_) engine_->keep_batch();
  is_in_batch_ = false;
}
void Boundary::undo_batch() noexcept {
  if (engine_) engine_->undo_batch();
  ids_tell_of_timing_ = is_in_batch_ = false;  // as when it began
  is_surely_interior_.resize(num_sites_before_);
  internal::shrink_large(is_surely_interior_);
  now_ = before_;
  now_.hull_is_current = false;  // it may have been made for the batch
}

void Boundary::sort_cells() const {
  if (!ids_tell_of_timing_ || is_in_batch_) return;
  places_.add({}, sites_.size());  // sites that came singly
  const std::span<const Index> places = places_.of_vertices();
  engine_->sort_cells({*std::max_element(places.begin(), places.end()) + 1, true, places}, threads_);
  ids_tell_of_timing_ = false;
  now_.hull_is_current = false;
}

std::size_t Boundary::bytes() const {
  const std::lock_guard lock(mutex_);
  return engine_ ? compiled::bytes_of(*engine_) : sizeof(now_.ends);
}

SimplicialHull Boundary::hull_of_sorted_cells() const {
  sort_cells();
  if (engine_) return compiled::simplicial_hull_of(*engine_);
  return SimplicialHull{1, {now_.ends[0], now_.ends[1]}, {1, 0}, {}};
}

SimplicialHull Boundary::make_hull() const {
  const std::lock_guard lock(mutex_);
  return hull_of_sorted_cells();
}

const SimplicialHull& Boundary::hull() const {
  const std::lock_guard lock(mutex_);
  sort_cells();
  if (!now_.hull_is_current) hull_ = hull_of_sorted_cells();
  now_.hull_is_current = true;
  return hull_;
}

std::vector<std::pair<Index, Index>> Boundary::coplanar_neighbors(const SimplicialHull& hull) const {
  if (!engine_) return {};
  return compiled::coplanar_neighbors(*engine_, hull);
}

}  // namespace delone::hull
