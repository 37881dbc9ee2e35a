// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/halfspace_cone.hpp"

#include "base/compiled_dimension.hpp"
#include "compiled/dispatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::internal {
namespace {

Sign orientation_of(const DualSites& sites, const std::vector<const double*>& rows) {
  StageCounts uncounted;
  return kernel::homogeneous_orientation<0>(sites.flat(), rows.data(), uncounted);
}

}  // namespace

HalfspaceCone::HalfspaceCone(const DualSites& sites, std::vector<Index> simplex, const InteriorPoint& p)
    : sites_(sites) {
  now_.insertions = simplex.size();
  const auto k = static_cast<std::size_t>(sites.dimension());
  if (k == 1) {
    const bool ordered =
        orientation_of(sites, {sites.row(simplex[0]), sites.row(simplex[1])}) == Sign::positive;
    now_.ends[0] = simplex[ordered ? 0 : 1];
    now_.ends[1] = simplex[ordered ? 1 : 0];
    return;
  }
  view_.low.assign(k, 0.0);
  view_.high.assign(k, 0.0);
  for (Index site = 0; site < sites.size(); ++site) grow_box(site);
  choose_center(simplex, p);
  boundary_ = with_compiled_dimension(k, [&](auto dimension) {
    return make_halfspace_engine<(dimension() > 1 ? dimension() - 1 : 0)>(sites_, view_, std::move(simplex));
  });
}

HalfspaceCone::HalfspaceCone(const DualSites& sites, const HalfspaceCone& other)
    : sites_(sites),
      view_(other.view_),
      now_(other.now_),
      is_surely_inside_(other.is_surely_inside_),
      threads_(other.threads_) {
  const std::lock_guard lock(other.mutex_);
  places_ = other.places_;
  was_shared_ = other.was_shared_;
  ids_tell_of_timing_ = other.ids_tell_of_timing_;
  if (other.boundary_) boundary_ = other.boundary_->copy(sites, view_);
}

/// The sum of the simplex' rows, each times a power of two near 1/s: dual points count alike. Sums of few
/// bits are tried first, as they keep determinants of lattices exact.
void HalfspaceCone::choose_center(const std::vector<Index>& simplex, const InteriorPoint& p) {
  std::vector<const double*> rows;
  for (const Index site : simplex) rows.push_back(sites_.row(site));
  const Sign orientation = orientation_of(sites_, rows);
  std::vector<int> axes(sites_.axes.begin(), sites_.axes.end() - 1);
  view_.dual_of_center.assign(2 * axes.size(), 0.0);
  for (const bool coarse : {true, false}) {
    view_.center.assign(sites_.row_size, 0.0);
    for (const double* row : rows) {
      double s = -row[sites_.row_size - 1];
      for (std::size_t j = 0; j + 1 < sites_.row_size; ++j) s -= row[j] * p.rounded[j];
      if (!(s > 0 && std::isfinite(s))) s = *std::max_element(row, row + sites_.row_size);
      if (!(s > 0)) s = 1;
      for (std::size_t j = 0; j < sites_.row_size; ++j) view_.center[j] += std::ldexp(row[j], -std::ilogb(s));
    }
    for (double& x : view_.center)
      if (const double unit = coarse && std::isfinite(x) && x != 0 ? std::ldexp(1.0, std::ilogb(x) - 10) : 0;
          unit > 0)
        x = std::nearbyint(x / unit) * unit;
    if (!std::all_of(view_.center.begin(), view_.center.end(), [](double x) { return std::isfinite(x); }))
      continue;
    view_.is_inside = true;
    for (std::size_t i = 0; i < rows.size() && view_.is_inside; ++i) {
      const double* const row = std::exchange(rows[i], view_.center.data());
      view_.is_inside = orientation_of(sites_, rows) == orientation;
      rows[i] = row;
    }
    if (!view_.is_inside) continue;
    dual_point(view_.center.data(), p, axes, view_.dual_of_center.data());
    return;
  }
}

/// Twice the box is added where it has to grow, so that rows arriving ever closer to p change it a
/// logarithmic number of times.
bool HalfspaceCone::grow_box(Index site) {
  constexpr double largest = std::numeric_limits<double>::max();
  const double* dual = sites_.dual(site);
  bool grown = false;
  for (std::size_t j = 0; j < view_.low.size(); ++j) {
    const double margin = boundary_ ? std::min(view_.high[j] - view_.low[j], largest / 8) : 0;
    if (dual[j] < view_.low[j]) view_.low[j] = dual[j] - margin, grown = true;
    if (dual[j] > view_.high[j]) view_.high[j] = dual[j] + margin, grown = true;
  }
  return grown;
}

/// Makes sure that the box contains sites.
void HalfspaceCone::include(std::span<const Index> sites) {
  std::vector<double> low = view_.low, high = view_.high;
  bool has_grown = false;
  for (const Index site : sites) has_grown |= grow_box(site);
  if (!has_grown) return;
  try {
    boundary_->update_box();
  } catch (...) {
    view_.low = std::move(low);
    view_.high = std::move(high);
    throw;
  }
}

void HalfspaceCone::insert_end(Index site) {
  if (orientation_of(sites_, {sites_.row(now_.ends[0]), sites_.row(site)}) == Sign::negative)
    now_.ends[0] = site, ++now_.insertions;
  if (orientation_of(sites_, {sites_.row(now_.ends[1]), sites_.row(site)}) == Sign::positive)
    now_.ends[1] = site, ++now_.insertions;
}

struct HalfspaceCone::SiteBatch final : engine::Batch {
  SiteBatch(HalfspaceCone& to, std::span<const Index> all, const std::function<void(std::size_t)>& listener)
      : cone(to), sites(all), tell(listener) {}

  Index next() override { return place < sites.size() ? sites[place++] + 1 : invalid_index; }
  void placed(Index v, Index at, bool strictly) override {
    cone.is_surely_inside_[v - 1] = at != v && strictly ? 1 : 0;
    cone.now_.insertions += at == v;
    tell(place);
  }

  HalfspaceCone& cone;
  std::span<const Index> sites;
  const std::function<void(std::size_t)>& tell;
  std::size_t place = 0;
};

unsigned HalfspaceCone::insert_all(std::span<const Index> sites, std::span<const std::size_t> rounds,
                                   const Options& options, const std::function<void(std::size_t)>& progress) {
  if (!boundary_) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      insert_end(sites[i]);
      progress(i + 1);
    }
    return 1;
  }
  include(sites);
  is_surely_inside_.resize(sites_.size(), 0);
  const unsigned threads = prepare_for_threads(sites, options);
  if (threads > 1) {
    insert_in_threads(sites, rounds, threads, progress);
  } else {
    SiteBatch batch(*this, sites, progress);
    boundary_->insert_all(batch);
  }
  return threads;
}

/// How many threads insert sites. Where several may, notes the order of sites; no function of timing is that
/// of their rows.
unsigned HalfspaceCone::prepare_for_threads(std::span<const Index> sites, const Options& options) {
  const bool is_shared =
      options.order != InsertionOrder::as_given && boundary_->shares_batches_of(sites.size());
  if (!is_shared && !was_shared_) return 1;
  places_.add(sites, sites_.size());
  ids_tell_of_timing_ = was_shared_ = true;
  if (!is_shared) return 1;
  return engine::threads_for_batch(options.threads, sites.size(), sites_.dimension() - 1);
}

void HalfspaceCone::insert_in_threads(std::span<const Index> sites, std::span<const std::size_t> rounds,
                                      unsigned threads, const std::function<void(std::size_t)>& progress) {
  threads_ = threads;
  std::vector<Index> at(sites.size());
  std::vector<char> strictly(sites.size());
  engine::ParallelBatch batch{threads, 1, at, rounds, progress, sites, now_.insertions, strictly};
  boundary_->insert_all(batch);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const bool is_vertex = at[i] == sites[i] + 1;
    is_surely_inside_[sites[i]] = !is_vertex && strictly[i] != 0 ? 1 : 0;
    now_.insertions += is_vertex;
  }
}

void HalfspaceCone::sort_cells() const {
  if (!ids_tell_of_timing_) return;
  places_.add({}, sites_.size());  // sites that came singly
  boundary_->sort_cells(places_.of_vertices(), threads_);
  ids_tell_of_timing_ = false;
}

void HalfspaceCone::leave_out(Index site) {
  is_surely_inside_.resize(sites_.size(), 0);
  is_surely_inside_[site] = 1;
}

void HalfspaceCone::begin_batch() {
  // What is undone is undone slot by slot: cells stay where they are from now on, until they are kept.
  sort_cells();
  before_ = now_;
  if (boundary_) boundary_->begin_batch();
}
void HalfspaceCone::keep_batch() noexcept {
  if (boundary_) boundary_->keep_batch();
}
void HalfspaceCone::undo_batch() noexcept {
  if (boundary_) boundary_->undo_batch();
  ids_tell_of_timing_ = false;  // as when it began
  now_ = before_;
}

std::size_t HalfspaceCone::bytes() const {
  const std::lock_guard lock(mutex_);
  return boundary_ ? boundary_->bytes() : sizeof(now_.ends);
}

SimplicialHull HalfspaceCone::hull() const {
  const std::lock_guard lock(mutex_);
  sort_cells();
  return boundary_ ? boundary_->to_simplicial_hull()
                   : SimplicialHull{1, {now_.ends[0], now_.ends[1]}, {1, 0}, {}};
}

std::vector<std::pair<Index, Index>> HalfspaceCone::coplanar_neighbors(const SimplicialHull& hull) const {
  return boundary_ ? boundary_->coplanar_neighbors(hull) : std::vector<std::pair<Index, Index>>{};
}

Sign HalfspaceCone::side(const SimplicialHull& hull, std::size_t c, Index site) const {
  if (boundary_) return boundary_->side(hull.slots[c], site);
  const Sign sign = orientation_of(sites_, {sites_.row(now_.ends[c]), sites_.row(site)});
  return c == 1 ? -sign : sign;
}

std::optional<Index> HalfspaceCone::cell_through(const SimplicialHull& hull, Index site) const {
  if (!boundary_ || is_surely_inside_[site] != 0) return std::nullopt;  // for k = 1 a ray between two others
  const auto slot = boundary_->cell_through(site);
  if (!slot) return std::nullopt;
  return static_cast<Index>(std::lower_bound(hull.slots.begin(), hull.slots.end(), *slot) -
                            hull.slots.begin());
}

}  // namespace delone::internal
