// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_state.hpp"

#include "base/large_vector.hpp"
#include "base/stopwatch.hpp"
#include "complex/canonical_hash.hpp"
#include "hull/box_faces.hpp"
#include "hull/complete_shell.hpp"
#include "hull/hull_fan.hpp"
#include "hull/outermost_sites.hpp"
#include "hull/point_sieve.hpp"
#include "hull/swept_walls.hpp"
#include "order/insertion_order.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace delone::hull {
namespace {

const SimplicialHull no_cells{};

/// Adds the marked rows to others, in increasing order.
void add_marked(std::span<const char> is_marked, std::vector<Index>& rows) {
  const auto others = static_cast<std::ptrdiff_t>(rows.size());
  for (Index row = 0; row < is_marked.size(); ++row)
    if (is_marked[row] != 0) rows.push_back(row);
  std::inplace_merge(rows.begin(), rows.begin() + others, rows.end());
}

}  // namespace

HullState::HullState(const HullState& other)
    : sites_(other.sites_),
      affine_hull_(other.affine_hull_),
      basis_(other.basis_),
      sieved_(other.sieved_),
      earlier_(other.earlier_) {
  if (other.boundary_) boundary_ = std::make_unique<Boundary>(sites_, *other.boundary_);
}

HullState::HullState(const HullState& all, std::span<const Index> vertices, std::vector<int> axes,
                     const Options& options)
    : sites_(all.sites_, sites::GrowingSites::Finished()),
      affine_hull_(all.sites_.ambient),
      earlier_(all.statistics()) {
  // The basis is independent after projection, hence before.
  kernel::AffineHull projected(std::max(1, static_cast<int>(axes.size())));
  std::vector<double> projection(axes.size() + 1, 0.0);
  for (const Index site : vertices) {
    for (std::size_t j = 0; j < axes.size(); ++j) projection[j] = sites_.point(site)[axes[j]];
    if (!projected.add(projection.data())) continue;
    affine_hull_.add(sites_.point(site));
    basis_.push_back(site);
  }
  sites_.axes.clear();
  for (const int axis : projected.axes()) sites_.axes.push_back(axes[static_cast<std::size_t>(axis)]);
  if (affine_hull_.dimension() < 1) return;
  make_boundary();
  std::vector<Index> others(vertices.begin(), vertices.end());
  std::erase_if(others,
                [&](Index site) { return std::find(basis_.begin(), basis_.end(), site) != basis_.end(); });
  put_in_order(others, options);
  boundary_->insert_all(others, [](std::size_t) {});
  // In an order in which each is near the one before, since the walk starts there.
  std::vector<char> is_vertex(sites_.size(), 0);
  for (const Index site : vertices) is_vertex[site] = 1;
  others.clear();
  for (Index site = 0; site < sites_.size(); ++site)
    if (is_vertex[site] == 0) others.push_back(site);
  put_in_order(others, options);
  boundary_->find_interior(others, 1);
}

/// Lets a site raise the affine dimension; true if it did.
bool HullState::raise(Index site) {
  if (affine_hull_.dimension() == sites_.ambient || !affine_hull_.add(sites_.point(site))) return false;
  basis_.push_back(site);
  return true;
}

bool HullState::raises_dimension(const double* point) const {
  return affine_hull_.dimension() < sites_.ambient && !affine_hull_.contains(point);
}

/// What a batch changes, as it was; puts it back in the end, unless it is kept.
class HullState::Rollback {
 public:
  explicit Rollback(HullState& state)
      : state_(state),
        affine_hull_(state.affine_hull_),
        basis_(state.basis_),
        axes_(state.sites_.axes),
        mark_(state.sites_.mark()),
        had_sieved_rows_(!state.sieved_.empty()),
        earlier_(state.earlier_) {}
  ~Rollback() {
    if (is_kept_) return;
    if (has_begun_) {
      state_.boundary_->undo_batch();
    } else if (has_restarted_) {
      state_.boundary_ = std::move(boundary_);
    }
    state_.affine_hull_ = std::move(affine_hull_);
    state_.basis_ = std::move(basis_);
    state_.sites_.axes = std::move(axes_);
    state_.sites_.rollback(mark_);
    if (!had_sieved_rows_) state_.sieved_ = SievedRows();
    state_.earlier_ = earlier_;
  }
  Rollback(const Rollback&) = delete;
  Rollback& operator=(const Rollback&) = delete;

  /// The present builder goes on.
  void begin() {
    state_.boundary_->begin_batch();
    has_begun_ = true;
  }
  /// There will be another builder.
  void restart() {
    boundary_ = std::move(state_.boundary_);
    has_restarted_ = true;
  }
  void keep() {
    if (has_begun_) state_.boundary_->keep_batch();
    is_kept_ = true;
  }

 private:
  HullState& state_;
  kernel::AffineHull affine_hull_;
  std::vector<Index> basis_;
  std::vector<int> axes_;
  sites::GrowingSites::Mark mark_;
  bool had_sieved_rows_;
  Statistics earlier_;
  std::unique_ptr<Boundary> boundary_;
  bool has_begun_ = false, has_restarted_ = false, is_kept_ = false;
};

void HullState::make_boundary() {
  boundary_ = std::make_unique<Boundary>(sites_, basis_, view_from_inside(sites_, basis_));
}

/// Starts again with the simplex of the basis.
void HullState::restart(Rollback& rollback) {
  sites_.axes = affine_hull_.axes();
  note_effort(earlier_);
  rollback.restart();
  if (affine_hull_.dimension() >= 1) make_boundary();
}

/// Adds sites of the hull to the boundary by sweeps of its walls. Returns false, and does nothing, where that
/// cannot be done or does not pay.
bool HullState::sweep_walls(std::span<const Index> sites, const std::function<void(std::size_t)>& tick) {
  const auto swept = hull::sweep_walls(*this, sites, tick);
  if (!swept) return false;
  boundary_->replace_cells(swept->hull, swept->planes, sites, swept->is_inside);
  tick(sites.size());
  return true;
}

/// By as many threads as there are for it. `first`: those that were inserted before into a boundary that
/// began with them, or none. If there are any, the order is no function of timing.
void HullState::insert_in_threads(std::span<const Index> sites, std::span<const std::size_t> rounds,
                                  const Options& options, std::span<const Index> first,
                                  const std::function<void(std::size_t)>& progress) {
  std::vector<Index> order(first.begin(), first.end());
  order.insert(order.end(), sites.begin(), sites.end());
  if (first.empty()) std::sort(order.begin(), order.end());
  boundary_->prepare_for_threads(order);
  const unsigned threads =
      engine::threads_for_batch(options.threads, sites.size(), affine_hull_.dimension() - 1);
  earlier_.threads = std::max(earlier_.threads, threads);
  boundary_->insert_all(sites, rounds, threads, progress);
}

struct HullState::Shell {
  std::vector<Index> sites;    ///< to begin with, if they are known
  bool has_all = false;        ///< whether all points are in their hull
  std::vector<Index> in_hull;  ///< sites that are in the hull of all the others, on its boundary
};

/// Adds the rows of the first batch. Interior ones that a few passes find have no sites.
HullState::Shell HullState::sieve(std::span<const double> coordinates, unsigned threads) {
  PointSieve sieve(coordinates, sites_.ambient, 0, threads);
  const std::vector<char> is_inner = find_inner_rows_of_box_faces(coordinates, sites_.ambient, threads);
  if (!is_inner.empty()) sieve.remove(is_inner);
  sieve.run();
  Shell shell;
  shell.has_all = sieve.has_shell() && complete_shell(sieve);
  std::vector<Index> remaining = sieve.remaining_rows();
  if (!is_inner.empty()) add_marked(is_inner, remaining);
  const std::size_t n = coordinates.size() / ambient();
  if (remaining.size() < n) {
    std::vector<Index> interior;
    interior.reserve(n - remaining.size());
    std::size_t next = 0;
    for (std::size_t row = 0; row < n; ++row)
      if (next < remaining.size() && remaining[next] == row)
        ++next;
      else
        interior.push_back(static_cast<Index>(row));
    sieved_ = SievedRows(coordinates, sites_.ambient, std::move(interior));
  }
  sites_.add_rows(coordinates, &remaining);
  for (Index row = 0; row < is_inner.size(); ++row)
    if (const Index site = sites_.site_of_row(row); is_inner[row] != 0 && sites_.row_of_site(site) == row)
      shell.in_hull.push_back(site);
  for (const Index row : sieve.shell_rows()) shell.sites.push_back(sites_.site_of_row(row));
  std::sort(shell.sites.begin(), shell.sites.end());
  shell.sites.erase(std::unique(shell.sites.begin(), shell.sites.end()), shell.sites.end());
  return shell;
}

/// As if there had been no sieve, so that later rows can be compared with all earlier ones. Strong guarantee.
void HullState::give_sieved_rows_sites() {
  if (sieved_.empty()) return;
  const auto first_site = static_cast<Index>(sites_.size());
  boundary_->reserve(sites_.size() + sieved_.rows().size());
  sites_.give_sites(sieved_.rows(), [&](Index row) { return sieved_.point(row); });
  boundary_->include_sites(first_site);
  for (Index site = first_site; site < sites_.size(); ++site) boundary_->leave_out(site);
  sieved_ = SievedRows();
}

/// Returns where rounds end that cover the whole set.
std::vector<std::size_t> HullState::put_in_order(std::vector<Index>& sites, const Options& options) const {
  std::vector<std::size_t> rounds;
  std::vector<double> coordinates;
  coordinates.reserve(sites.size() * ambient());
  for (const Index site : sites)
    coordinates.insert(coordinates.end(), sites_.point(site), sites_.point(site) + ambient());
  std::vector<Index> order = order::insertion_order({coordinates, sites_.ambient}, options, &rounds);
  for (Index& at : order) at = sites[at];
  sites = std::move(order);
  return rounds;
}

void HullState::insert_range(std::span<const double> coordinates, const Options& options,
                             const std::function<void()>& approve) {
  constexpr std::size_t least_to_sieve = 1024;
  give_sieved_rows_sites();
  Rollback rollback(*this);
  const auto first_site = static_cast<Index>(sites_.size());
  internal::Stopwatch stopwatch;
  Shell shell;
  // With a tolerance an interior row may be outside of what is shown, and needs a site.
  if (first_site == 0 && ambient() > 1 && options.tolerance == 0 &&
      options.order != InsertionOrder::as_given && coordinates.size() >= least_to_sieve * ambient())
    shell = sieve(coordinates, options.threads);
  else
    sites_.add_rows(coordinates);
  earlier_.order_seconds += stopwatch.seconds();

  stopwatch.restart();
  std::vector<Index>& outermost = shell.sites;
  if (outermost.empty() && options.order != InsertionOrder::as_given)
    outermost = outermost_sites(sites_, first_site);
  bool raised = false;
  for (const Index site : outermost) raised |= raise(site);
  for (Index site = first_site; site < sites_.size() && affine_hull_.dimension() < sites_.ambient; ++site)
    raised |= raise(site);
  if (raised) {
    restart(rollback);
  } else if (boundary_) {
    rollback.begin();
    boundary_->include_sites(first_site);
  }
  if (boundary_) {
    // Sites of earlier calls are inserted again into a new boundary.
    std::vector<char> is_done(sites_.size(), 0);
    if (raised)
      for (const Index site : basis_) is_done[site] = 1;
    const bool has_shell = !outermost.empty();
    std::erase_if(outermost, [&](Index site) { return std::exchange(is_done[site], 1) != 0; });
    std::vector<Index> in_hull = std::move(shell.in_hull);
    std::erase_if(in_hull, [&](Index site) { return std::exchange(is_done[site], 1) != 0; });
    std::vector<Index> others;
    for (Index site = raised ? 0 : first_site; site < sites_.size(); ++site)
      if (!is_done[site]) others.push_back(site);
    std::size_t done = 0;
    internal::ProgressMeter progress(options.progress, outermost.size() + others.size() + in_hull.size());
    const auto tick = [&](std::size_t inserted) { progress(done + inserted); };
    boundary_->insert_all(outermost, tick);
    done = outermost.size() + others.size();
    if (has_shell) boundary_->drop_interior(others, options.threads);
    done -= others.size();
    if (shell.has_all) {
      others.insert(others.end(), in_hull.begin(), in_hull.end());
      in_hull.clear();
      if (sweep_walls(others, tick)) others.clear();
    }
    earlier_.build_seconds += stopwatch.seconds();

    stopwatch.restart();
    const std::vector<std::size_t> rounds = put_in_order(others, options);
    earlier_.order_seconds += stopwatch.seconds();

    stopwatch.restart();
    // As given means in that order. Of what is approved of, cells are asked before the batch is kept.
    if (options.order == InsertionOrder::as_given || (approve && !raised) ||
        !boundary_->shares_batches_of(others.size())) {
      boundary_->insert_all(others, tick);
    } else {
      std::vector<Index> first;
      if (raised) first = basis_;
      if (raised) first.insert(first.end(), outermost.begin(), outermost.end());
      insert_in_threads(others, rounds, options, first, tick);
    }
    done += others.size();
    if (!in_hull.empty() && !sweep_walls(in_hull, tick)) boundary_->insert_all(in_hull, tick);
  }
  if (approve) approve();
  earlier_.build_seconds += stopwatch.seconds();
  rollback.keep();
}

HullInsertResult HullState::insert_in_flat(const double* point) {
  give_sieved_rows_sites();
  const sites::GrowingSites::Mark before = sites_.mark();
  HullInsertResult result;
  result.row = num_rows();
  const Index site = sites_.add_row(point);
  result.duplicate = site < before.sites;
  if (result.duplicate) return result;
  try {
    boundary_->include_sites(site);
    result.inserted = boundary_->insert(site) == engine::Outcome::done;
  } catch (...) {
    sites_.rollback(before);
    throw;
  }
  return result;
}

Index HullState::add_without_inserting(const double* point) {
  const Index site = sites_.find(point);
  return site != invalid_index ? site : sites_.add_row(point);
}

std::size_t HullState::num_duplicates() const {
  // Rows without a site are no duplicates unless they are equal to each other.
  const std::size_t of_sieved = sieved_.empty() ? 0 : sieved_.num_duplicates();
  return num_rows() - sieved_.rows().size() - sites_.size() + of_sieved;
}

const SimplicialHull& HullState::hull() const { return boundary_ ? boundary_->hull() : no_cells; }

/// Adds what the builder has done.
void HullState::note_effort(Statistics& sum) const {
  if (!boundary_) return;
  const engine::Effort& effort = boundary_->effort();
  sum.created_cells += effort.created_cells;
  sum.filter += effort.stages.filter;
  sum.direct += effort.stages.direct;
  sum.exact += effort.stages.exact;
  sum.perturbed += effort.stages.perturbed;
}

Statistics HullState::statistics() const {
  Statistics result = earlier_;
  note_effort(result);
  if (boundary_) {
    result.insertions = boundary_->insertions();
    result.cell_bytes = boundary_->bytes();
  }
  return result;
}

}  // namespace delone::hull
