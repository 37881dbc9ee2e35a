// SPDX-License-Identifier: BSD-3-Clause
// Distances from the hull of what is kept only fall as more is kept. So a bound found earlier stays an upper
// bound, and the greatest of them is looked at again until it is up to date: then it belongs to the farthest
// point. Once covered, a point stays covered until a point of its witness is dropped.
#include "hull/tolerance/cover.hpp"

#include "kernel/determinant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace delone::internal {

namespace {

constexpr std::size_t most_neighbors = 256;  // more are not worth a look
constexpr std::size_t few = 24;              // points, or rounds
constexpr std::size_t most_of_group = 32;

}  // namespace

Cover::Cover(std::vector<const double*> points, int dimension, double tolerance, AddNeighbors add_neighbors,
             std::function<void()> alive)
    : points_(std::move(points)),
      dimension_(dimension),
      tolerance_(tolerance),
      add_neighbors_(std::move(add_neighbors)),
      alive_(std::move(alive)),
      states_(points_.size()),
      users_(points_.size()),
      marks_(points_.size(), 0) {
  if (points_.size() <= most_of_group * few) return;
  std::vector<Index> all(points_.size());
  std::iota(all.begin(), all.end(), Index{0});
  divide(all);
}

/// Halves points along the longest edge of their box until they are a group.
void Cover::divide(std::span<Index> all) {
  const auto d = static_cast<std::size_t>(dimension_);
  Group group{{}, std::vector<double>(points_[all[0]], points_[all[0]] + d), {}};
  group.high = group.low;
  for (const Index p : all)
    for (std::size_t j = 0; j < d; ++j) {
      group.low[j] = std::min(group.low[j], points_[p][j]);
      group.high[j] = std::max(group.high[j], points_[p][j]);
    }
  if (all.size() <= most_of_group) {
    group.points.assign(all.begin(), all.end());
    groups_.push_back(std::move(group));
    return;
  }
  std::size_t axis = 0;
  for (std::size_t j = 1; j < d; ++j)
    if (group.high[j] / 2 - group.low[j] / 2 > group.high[axis] / 2 - group.low[axis] / 2) axis = j;
  const std::size_t half = all.size() / 2;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(half), all.end(),
                   [&](Index a, Index b) { return points_[a][axis] < points_[b][axis]; });
  divide(all.first(half));
  divide(all.subspan(half));
}

/// A computed n·(q − w) is off by at most γ(d+1) of the sum of the absolute products. Rounding is monotonic,
/// so the computed least product of a box is at most those of its points: a box whose least one says so is
/// skipped.
Cover::Support Cover::support(const double* q) const {
  const auto d = static_cast<std::size_t>(dimension_);
  const double rounding = 1.01 * static_cast<double>(d + 2) * kernel::unit_roundoff;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Support result{infinity, infinity, kept_[0]};
  const auto include = [&](Index v) {
    double product = 0, parts = 0;
    for (std::size_t j = 0; j < d; ++j) {
      const double term = normal_[j] * (q[j] - points_[v][j]);
      product += term;
      parts += std::fabs(term);
    }
    if (!(product >= result.least)) result.least = product, result.point = v;
    if (!(product - rounding * parts >= result.certain)) result.certain = product - rounding * parts;
  };
  if (groups_.empty() || kept_.size() < 4 * groups_.size()) {
    for (const Index v : kept_) include(v);
    return result;
  }
  for (const Index v : local_) include(v);
  for (const Group& group : groups_) {
    double product = 0, parts = 0;
    for (std::size_t j = 0; j < d; ++j) {
      const double a = normal_[j] * (q[j] - group.low[j]), b = normal_[j] * (q[j] - group.high[j]);
      product += std::min(a, b);
      parts += std::max(std::fabs(a), std::fabs(b));
    }
    if (product >= result.least && product - rounding * parts >= result.certain) continue;
    for (const Index v : group.points)
      if (states_[v].is_kept) include(v);
  }
  return result;
}

bool Cover::exceeds(std::span<const double* const> points, const double* q) {
  nearest_.find(points, q, dimension_);
  if (nearest_.upper() <= tolerance_) return false;
  if (nearest_.lower() > tolerance_) return true;
  return kernel::nearest_in_hull_exactly(points, q, dimension_, nearest_.face()).compare(tolerance_) ==
         Sign::positive;
}

void Cover::keep(Index p) {
  states_[p].is_kept = true;
  kept_.push_back(p);
}

void Cover::require(Index p) {
  states_[p].is_required = true;
  keep(p);
}

/// Whether p is covered by the points of the pool; if so, it has a witness now.
bool Cover::look(Index p, std::span<const Index> pool) {
  if (pool.empty()) return false;
  pool_points_.clear();
  for (const Index v : pool) pool_points_.push_back(points_[v]);
  nearest_.find(pool_points_, points_[p], dimension_);
  State& state = states_[p];
  state.upper = nearest_.upper();
  std::vector<int> face(nearest_.face().begin(), nearest_.face().end());
  state.is_covered = nearest_.upper() <= tolerance_;
  if (!state.is_covered && nearest_.lower() <= tolerance_) {
    const kernel::ExactNearest exact =
        kernel::nearest_in_hull_exactly(pool_points_, points_[p], dimension_, face);
    state.is_covered = exact.compare(tolerance_) != Sign::positive;
    face = exact.face;
  }
  if (!state.is_covered) return false;
  state.witness.clear();
  for (const int i : face) {
    const Index v = pool[static_cast<std::size_t>(i)];
    state.witness.push_back(v);
    users_[v].push_back(p);
  }
  return true;
}

/// The neighbors of p that are kept, and theirs, increasing; none if they are too many. The set of neighbors
/// is what counts, not their order.
void Cover::find_local(Index p) {
  near_.assign(1, p);
  marks_[p] = 1;
  std::size_t done = 0;
  for (int ring = 0; ring < 2; ++ring)
    for (const std::size_t end = near_.size(); done < end && near_.size() <= most_neighbors; ++done)
      add_neighbors_(near_[done], marks_, near_);
  local_.clear();
  for (const Index v : near_) {
    marks_[v] = 0;
    if (states_[v].is_kept) local_.push_back(v);
  }
  if (near_.size() > most_neighbors) local_.clear();
  std::sort(local_.begin(), local_.end());
}

/// The same for all kept points. The nearest point of a few of them, neighbors at first, is found, then the
/// kept point that is farthest beyond its supporting plane joins them, until there is none: so the others are
/// only multiplied by a normal.
///
/// For each n ≠ 0 the distance from the hull is at least the least n·(q − w) of the kept points w, divided by
/// |n|.
bool Cover::cover(Index p) {
  alive_();
  states_[p].seen = kept_.size();
  if (kept_.size() <= few) return look(p, kept_);
  find_local(p);
  if (local_.empty()) local_.push_back(kept_[0]);
  const auto d = static_cast<std::size_t>(dimension_);
  const double* const q = points_[p];
  normal_.resize(d);
  for (std::size_t round = 0; round < few; ++round) {
    if (look(p, local_)) return true;
    std::fill(normal_.begin(), normal_.end(), 0.0);
    double square = 0, weight = 0;
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const double share = nearest_.weights()[i];
      if (share == 0) continue;
      weight += share;
      for (std::size_t j = 0; j < d; ++j) normal_[j] += share * (q[j] - points_[local_[i]][j]);
    }
    for (double& x : normal_) x /= weight, square += x * x;
    const double length = std::sqrt(square) * (1 + static_cast<double>(d + 4) * kernel::unit_roundoff);
    if (!(length > 0x1p-400 && length < 0x1p400)) break;
    const auto [least, certain, farthest] = support(q);
    const bool is_new = std::find(local_.begin(), local_.end(), farthest) == local_.end();
    if (is_new && least < square * (1 - 0x1p-40)) {
      local_.push_back(farthest);
      continue;
    }
    if (certain > tolerance_ * length * (1 + 4 * kernel::unit_roundoff) + 0x1p-1000) return false;
    break;
  }
  return look(p, kept_);
}

/// Keeps what covers a point that may not be kept itself.
bool Cover::add_witness_of(Index p, const std::vector<char>& allowed) {
  std::vector<Index> all;
  for (std::size_t v = 0; v < allowed.size(); ++v)
    if (allowed[v] != 0) all.push_back(static_cast<Index>(v));
  if (!look(p, all)) return false;
  for (const Index v : states_[p].witness)
    if (!states_[v].is_kept) keep(v);
  return true;
}

bool Cover::complete(const std::vector<char>& allowed) {
  if (kept_.empty()) keep(static_cast<Index>(std::find(allowed.begin(), allowed.end(), 1) - allowed.begin()));
  using Entry = std::pair<double, std::int64_t>;  // of equal bounds the first point comes first
  std::priority_queue<Entry> queue;
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (!states_[p].is_kept && !cover(static_cast<Index>(p)))
      queue.emplace(states_[p].upper, -static_cast<std::int64_t>(p));
  while (!queue.empty()) {
    const auto p = static_cast<Index>(-queue.top().second);
    queue.pop();
    if (states_[p].is_kept) continue;
    if (states_[p].seen != kept_.size()) {
      if (!cover(p)) queue.emplace(states_[p].upper, -static_cast<std::int64_t>(p));
    } else if (allowed[p] != 0) {
      keep(p);
    } else if (!add_witness_of(p, allowed)) {
      return false;
    }
  }
  return true;
}

/// Whether p, no longer kept, and all whose witnesses it was in are covered; if not, nothing has changed.
bool Cover::can_drop(Index p) {
  std::vector<Index> concerned{p};
  for (const Index u : users_[p]) {
    const auto& witness = states_[u].witness;
    if (!states_[u].is_kept && std::find(witness.begin(), witness.end(), p) != witness.end())
      concerned.push_back(u);
  }
  std::sort(concerned.begin() + 1, concerned.end());
  concerned.erase(std::unique(concerned.begin() + 1, concerned.end()), concerned.end());
  const auto at = std::find(kept_.begin(), kept_.end(), p);
  const auto place = at - kept_.begin();
  kept_.erase(at);
  states_[p].is_kept = false;
  std::vector<State> before;
  for (const Index u : concerned) {
    before.push_back(states_[u]);
    if (!kept_.empty() && cover(u)) continue;
    for (std::size_t i = 0; i < before.size(); ++i) states_[concerned[i]] = std::move(before[i]);
    states_[p].is_kept = true;
    kept_.insert(kept_.begin() + place, p);
    return false;
  }
  return true;
}

void Cover::reduce() {
  for (const std::vector<Index> order(kept_.rbegin(), kept_.rend()); const Index p : order)
    if (!states_[p].is_required) can_drop(p);
}

double Cover::max_distance() const {
  double largest = 0;
  for (const State& state : states_)
    if (!state.is_kept) largest = std::max(largest, std::min(state.upper, tolerance_));
  return largest;
}

}  // namespace delone::internal
