// SPDX-License-Identifier: BSD-3-Clause
// Distances from the hull of what is kept only fall as more is kept. So a bound found earlier stays an upper
// bound, and the greatest of them is looked at again until it is up to date: then it belongs to the farthest
// point. Once covered, a point stays covered until a point of its witness is dropped.
#include "hull/tolerance/cover.hpp"

#include "base/infinity.hpp"
#include "hull/tolerance/simplex_projection.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace delone::hull {

namespace {

constexpr std::size_t most_neighbors = 256;  // more are not worth a look
constexpr std::size_t most_rounds = 64;
constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
constexpr std::size_t most_first = 16;  // kept points to begin with when one is dropped

/// An upper bound on the length of a direction; 0 if it is too long or too short to prove anything.
double length_up(std::span<const double> n) {
  double square = 0;
  for (const double x : n) square += x * x;
  const double length = std::sqrt(square) * (1 + static_cast<double>(n.size() + 4) * kernel::unit_roundoff);
  return length > 0x1p-400 && length < 0x1p400 ? length : 0;
}

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
      normals_(points_.size() * static_cast<std::size_t>(dimension), 0.0),
      marks_(points_.size(), 0) {}

/// Makes the tree, if there is none yet. Points that are covered are never kept, see approach().
void Cover::plant() {
  if (tree_) return;
  std::vector<Index> members;
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (!states_[p].is_covered) members.push_back(static_cast<Index>(p));
  tree_.emplace(points_, dimension_, std::move(members));
  for (const Index p : kept_) tree_->insert(p);
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
  if (tree_) tree_->insert(p);
}

void Cover::require(Index p) {
  states_[p].is_required = true;
  keep(p);
}

/// Whether p is covered by the points of the pool; if so, its face is a witness now.
bool Cover::look(Index p, std::span<const Index> pool) {
  if (pool.empty()) return false;
  pool_points_.clear();
  for (const Index v : pool) pool_points_.push_back(points_[v]);
  nearest_.find(pool_points_, points_[p], dimension_);
  State& state = states_[p];
  state.upper = nearest_.upper();
  state.face.clear();
  for (const int i : nearest_.face()) state.face.push_back(pool[static_cast<std::size_t>(i)]);
  state.is_covered = nearest_.upper() <= tolerance_;
  if (!state.is_covered && nearest_.lower() <= tolerance_) {
    const kernel::ExactNearest exact =
        kernel::nearest_in_hull_exactly(pool_points_, points_[p], dimension_, nearest_.face());
    state.is_covered = exact.compare(tolerance_) != Sign::positive;
    state.face.clear();
    for (const int i : exact.face) state.face.push_back(pool[static_cast<std::size_t>(i)]);
  }
  set_normal(p, pool);
  if (state.is_covered)
    for (const Index v : state.face) users_[v].push_back(p);
  return state.is_covered;
}

/// Whether p is within the tolerance of its projection into the simplex of d points, as far as that is easily
/// seen; if so, they are a witness now.
bool Cover::project(Index p, std::span<const Index> corners) {
  const auto d = static_cast<std::size_t>(dimension_);
  pool_points_.clear();
  for (const Index v : corners) pool_points_.push_back(points_[v]);
  State& state = states_[p];
  const auto distance = project_into_simplex(pool_points_, points_[p], normals_.data() + p * d);
  if (!distance || *distance > tolerance_) return false;
  state.upper = *distance;
  state.face.assign(corners.begin(), corners.end());
  state.is_covered = true;
  for (const Index v : corners) users_[v].push_back(p);
  return true;
}

/// The normal of p: from the point that was found to p.
void Cover::set_normal(Index p, std::span<const Index> pool) {
  const auto d = static_cast<std::size_t>(dimension_);
  double* const normal = normals_.data() + p * d;
  std::fill_n(normal, d, 0.0);
  double weight = 0;
  for (const int i : nearest_.face()) {
    const auto at = static_cast<std::size_t>(i);
    const double share = nearest_.weights()[at];
    weight += share;
    for (std::size_t j = 0; j < d; ++j) normal[j] += share * (points_[p][j] - points_[pool[at]][j]);
  }
  for (std::size_t j = 0; j < d; ++j) normal[j] /= weight;
}

/// Kept points to begin with, increasing: those of the last face, or of those that had the dropped one in
/// theirs; otherwise neighbors of p, and theirs, unless they are too many. The set of points is what counts,
/// not their order.
void Cover::find_local(Index p) {
  local_.clear();
  for (const std::vector<Index>* list : {&states_[p].face, &first_of_drop_})
    for (const Index v : *list)
      if (states_[v].is_kept) local_.push_back(v);
  if (local_.empty()) {
    near_.assign(1, p);
    marks_[p] = 1;
    std::size_t done = 0;
    for (int ring = 0; ring < 2; ++ring)
      for (const std::size_t end = near_.size(); done < end && near_.size() <= most_neighbors; ++done)
        add_neighbors_(near_[done], marks_, near_);
    for (const Index v : near_) {
      marks_[v] = 0;
      if (states_[v].is_kept && near_.size() <= most_neighbors) local_.push_back(v);
    }
  }
  std::sort(local_.begin(), local_.end());
  local_.erase(std::unique(local_.begin(), local_.end()), local_.end());
  if (local_.empty())
    local_.push_back(*std::find_if(kept_.begin(), kept_.end(), [&](Index v) { return states_[v].is_kept; }));
}

/// One step: p is covered, or it is farther than the tolerance from all and its distance is final, or it is
/// nearer than it was. The nearest point of a few kept points is known; the kept point that is farthest
/// beyond its supporting plane joins them. So the others are only multiplied by a normal, and most of them
/// not even that (support_tree.hpp).
///
/// For each n ≠ 0 the distance from the hull is at least the least n·(q − w) of the kept points w, divided by
/// |n|.
Cover::Step Cover::step(Index p) {
  const auto d = static_cast<std::size_t>(dimension_);
  const std::span<const double> normal(normals_.data() + p * d, d);
  const double square = std::inner_product(normal.begin(), normal.end(), normal.begin(), 0.0);
  if (const double length = length_up(normal); length > 0) {
    const auto [least, certain, farthest] = tree_->support(points_[p], normal, local_);
    const bool is_new = std::find(local_.begin(), local_.end(), farthest) == local_.end();
    if (is_new && least < square * (1 - 0x1p-40)) {
      local_.push_back(farthest);
      return look(p, local_) ? Step::covered : Step::nearer;
    }
    if (certain > least_beyond(length)) return Step::far;
  }
  return look_at_all(p) ? Step::covered : Step::far;
}

/// A point with larger products n·(q − w) for a direction of this length is farther than the tolerance.
double Cover::least_beyond(double length) const {
  return tolerance_ * length * (1 + 4 * kernel::unit_roundoff) + 0x1p-1000;
}

bool Cover::look_at_all(Index p) {
  local_.clear();
  for (const Index v : kept_)
    if (states_[v].is_kept) local_.push_back(v);
  return look(p, local_);
}

/// Whether p is covered. The search also ends when p is found to be nearer than `enough`. Otherwise, the
/// distance is final.
bool Cover::cover(Index p, double enough) {
  alive_();
  State& state = states_[p];
  const bool is_known = !state.face.empty() && std::all_of(state.face.begin(), state.face.end(),
                                                           [&](Index v) { return states_[v].is_kept; });
  if (is_known) {
    local_ = state.face;
  } else {
    find_local(p);
    if (look(p, local_)) return true;
  }
  for (std::size_t round = 0; round < most_rounds; ++round) {
    const Step made = step(p);
    if (made == Step::covered) return true;
    state.seen = made == Step::far ? kept_.size() : never;
    if (made == Step::far || state.upper < enough) return false;
  }
  state.seen = kept_.size();
  return look_at_all(p);
}

/// Keeps what covers a point that may not be kept itself.
bool Cover::add_witness_of(Index p, const std::vector<char>& allowed) {
  std::vector<Index> all;
  for (std::size_t v = 0; v < allowed.size(); ++v)
    if (allowed[v] != 0) all.push_back(static_cast<Index>(v));
  if (!look(p, all)) return false;
  for (const Index v : states_[p].face)
    if (!states_[v].is_kept) keep(v);
  return true;
}

bool Cover::complete(const std::vector<char>& allowed) {
  if (kept_.empty()) keep(static_cast<Index>(std::find(allowed.begin(), allowed.end(), 1) - allowed.begin()));
  plant();
  using Entry = std::pair<double, std::int64_t>;  // of equal bounds the first point comes first
  std::priority_queue<Entry> queue;
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (!states_[p].is_kept && !states_[p].is_covered && !cover(static_cast<Index>(p), internal::infinity))
      queue.emplace(states_[p].upper, -static_cast<std::int64_t>(p));
  while (!queue.empty()) {
    const auto p = static_cast<Index>(-queue.top().second);
    queue.pop();
    if (states_[p].is_kept) continue;
    if (states_[p].seen != kept_.size()) {
      const double next = queue.empty() ? 0 : queue.top().first;
      if (!cover(p, next)) queue.emplace(states_[p].upper, -static_cast<std::int64_t>(p));
    } else if (allowed[p] != 0) {
      keep(p);
    } else if (!add_witness_of(p, allowed)) {
      return false;
    }
  }
  return true;
}

/// Whether the mean of the unit normals of some points proves that p is farther than the tolerance from all
/// that is kept.
bool Cover::is_far_along_normals(Index p, std::span<const Index> points) {
  if (tree_->size() == 0) return false;
  const auto d = static_cast<std::size_t>(dimension_);
  mean_.assign(d, 0.0);
  for (const Index u : points) {
    const double* const normal = normals_.data() + u * d;
    const double length = std::sqrt(std::inner_product(normal, normal + d, normal, 0.0));
    if (!(length > 0x1p-400 && length < 0x1p400)) continue;
    for (std::size_t j = 0; j < d; ++j) mean_[j] += normal[j] / length;
  }
  const double length = length_up(mean_);
  local_.clear();
  for (const Index v : first_of_drop_)
    if (states_[v].is_kept) local_.push_back(v);
  return length > 0 && tree_->support(points_[p], mean_, local_).certain > least_beyond(length);
}

/// Sets the kept points to begin with, each once: those in the witnesses that lose the dropped one. They are
/// all around it.
void Cover::find_first_of_drop(std::span<const Index> covered) {
  first_of_drop_.clear();
  for (const Index u : covered)
    for (const Index v : states_[u].face)
      if (states_[v].is_kept && first_of_drop_.size() < most_first && std::exchange(marks_[v], 1) == 0)
        first_of_drop_.push_back(v);
  for (const Index v : first_of_drop_) marks_[v] = 0;
}

/// Whether p, no longer kept, and all whose witnesses it was in are covered; if not, nothing has changed.
/// kept_ still holds it.
bool Cover::can_drop(Index p) {
  std::vector<Index> concerned{p};
  for (const Index u : users_[p]) {
    const auto& face = states_[u].face;
    if (!states_[u].is_kept && std::find(face.begin(), face.end(), p) != face.end()) concerned.push_back(u);
  }
  std::sort(concerned.begin() + 1, concerned.end());
  concerned.erase(std::unique(concerned.begin() + 1, concerned.end()), concerned.end());
  states_[p].is_kept = false;
  tree_->erase(p);
  find_first_of_drop(std::span(concerned).subspan(1));
  if (is_far_along_normals(p, std::span(concerned).subspan(1))) {
    states_[p].is_kept = true;
    tree_->insert(p);
    return false;
  }
  std::vector<State> before;
  for (const Index u : concerned) {
    before.push_back(states_[u]);
    if (tree_->size() > 0 && cover(u, 0)) continue;
    for (std::size_t i = 0; i < before.size(); ++i) states_[concerned[i]] = std::move(before[i]);
    states_[p].is_kept = true;
    tree_->insert(p);
    return false;
  }
  return true;
}

void Cover::reduce() {
  for (const std::vector<Index> order(kept_.rbegin(), kept_.rend()); const Index p : order)
    if (!states_[p].is_required) can_drop(p);
  first_of_drop_.clear();
  std::erase_if(kept_, [&](Index p) { return !states_[p].is_kept; });
}

/// Makes the bound of a covered point smaller, until no kept point is beyond its plane.
void Cover::refine(Index p) {
  const auto d = static_cast<std::size_t>(dimension_);
  local_ = states_[p].face;
  for (std::size_t round = 0; round < most_rounds && states_[p].upper > 0; ++round) {
    const std::span<const double> normal(normals_.data() + p * d, d);
    const double square = std::inner_product(normal.begin(), normal.end(), normal.begin(), 0.0);
    const SupportTree::Support support = tree_->support(points_[p], normal, local_);
    const bool is_new = std::find(local_.begin(), local_.end(), support.point) == local_.end();
    if (!is_new || !(support.least < square * (1 - 0x1p-40))) return;
    local_.push_back(support.point);
    const double before = states_[p].upper;
    look(p, local_);
    states_[p].upper = std::min(states_[p].upper, before);
  }
}

/// As in complete(): the greatest bound is made smaller until it is the distance of its point.
double Cover::max_distance() {
  std::priority_queue<std::pair<double, Index>> queue;
  for (std::size_t p = 0; p < states_.size(); ++p)
    if (!states_[p].is_kept) queue.emplace(states_[p].upper, static_cast<Index>(p));
  while (!queue.empty()) {
    const auto [upper, p] = queue.top();
    alive_();
    refine(p);
    if (states_[p].upper == upper) return std::min(upper, tolerance_);
    queue.pop();
    queue.emplace(states_[p].upper, p);
  }
  return 0;
}

}  // namespace delone::hull
