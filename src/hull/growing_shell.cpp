// SPDX-License-Identifier: BSD-3-Clause
// Covered. Let o be a point of the hull, v_i the vertices of a cell and w_i ≥ 0 weights with Σw_i ≤ 1: then
// z = o + Σw_i·(v_i − o) is in the hull. The weights are computed, rounded, and scaled if their sum exceeds
// 1; so it exceeds 1 by at most η = (d+4)·u. If it does, z divided by it is in the hull, and |z − that| ≤
// η·Σw_i·|v_i − o|. The computed p − z is off in each coordinate by at most γ(d+3) of the sum of the
// magnitudes of its terms. The distance of p from the hull is at most the norm of p − z, and these. Products
// that underflow are far below the absolute term.
#include "hull/growing_shell.hpp"

#include "base/infinity.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace delone::hull {

namespace {

constexpr double unit = kernel::unit_roundoff;
constexpr int most_steps = 100;  // of a walk

}  // namespace

GrowingShell::GrowingShell(PointSieve& sieve, double tolerance, std::function<void()> alive)
    : sieve_(sieve),
      d_(sieve.box().center.size()),
      tolerance_(tolerance),
      alive_(std::move(alive)),
      difference_(d_),
      weights_(d_) {}
GrowingShell::~GrowingShell() = default;

bool GrowingShell::is_possible() {
  const auto& reach = sieve_.box().reach;
  return std::all_of(reach.begin(), reach.end(), [](double x) { return x > 0x1p-300 && x < 0x1p300; }) &&
         shell().boundary() != nullptr && boundary().has_center() && boundary().engine() != nullptr;
}

bool GrowingShell::run(const Limits& limits) {
  constexpr int most_rounds = 64;
  for (std::size_t i = 0; i < sieve_.num_remaining(); ++i)
    if (!sieve_.is_in_shell(i)) open_.push_back(i);
  for (int round = 0; !open_.empty(); ++round) {
    alive_();
    if (round == most_rounds || sieve_.shell_rows().size() > limits.vertices || products_ > limits.products)
      return false;
    cover();
    if (!open_.empty() && !extend()) return false;
  }
  std::sort(covered_.begin(), covered_.end());
  return true;
}

std::size_t GrowingShell::cell_of(std::size_t point_number) {
  if (!cones_) {
    cones_ = std::make_unique<CellCones>(shell(), boundary().center().data());
    cell_ = 0;
  }
  set_out_for(point(point_number));
  for (int step = 0; step < most_steps; ++step) {
    const std::size_t least = weigh(*cones_);
    if (weights_[least] >= 0) break;
    cell_ = across(*cones_, least, step);
  }
  return cell_;
}

/// Sets weights_ to the nonnegative ones nearest to those of p in the cone of a cell, and returns a bound
/// on the distance.
double GrowingShell::distance_up(const CellCones& cones, std::size_t cell) {
  double sum = 0, square = 0, moved = 0;
  for (double& w : weights_) sum += w = std::max(w, 0.0);
  if (sum > 1)
    for (double& w : weights_) w /= sum;
  const auto dimension = static_cast<double>(d_);
  for (std::size_t j = 0; j < d_; ++j) {
    double rest = difference_[j], size = 0;
    for (std::size_t i = 0; i < d_; ++i) {
      const double term = weights_[i] * cones.edge(cell, i, j);
      rest -= term;
      size += std::fabs(term);
    }
    moved += size;
    const double most = std::fabs(rest) + 1.01 * (dimension + 3) * unit * (size + std::fabs(difference_[j]));
    square += most * most;
  }
  return (std::sqrt(square) + 1.01 * (dimension + 4) * unit * moved) * (1 + (dimension + 8) * unit) +
         underflow_slack;
}

/// The next walk goes to this point.
void GrowingShell::set_out_for(const double* p) {
  const double* const center = boundary().center().data();
  for (std::size_t j = 0; j < d_; ++j) difference_[j] = p[j] - center[j];
}

/// Sets weights_ to those of the point in the cone where the walk is, and sum_; returns the least of them.
std::size_t GrowingShell::weigh(CellCones& cones) {
  const double* const inverse = cones.inverse(cell_);
  std::size_t least = 0;
  sum_ = 0;
  for (std::size_t i = 0; i < d_; ++i) {
    double w = 0;
    for (std::size_t j = 0; j < d_; ++j) w += inverse[i * d_ + j] * difference_[j];
    weights_[i] = w;
    sum_ += w;
    if (!(w >= weights_[least])) least = i;
  }
  return least;
}

/// Where a walk goes on, after so many steps. Flat cones lead nowhere in particular.
std::size_t GrowingShell::across(const CellCones& cones, std::size_t least, int step) const {
  const bool is_flat = !(sum_ > -internal::infinity && sum_ < internal::infinity);
  return cones.hull().neighbors_of(cell_)[is_flat ? static_cast<std::size_t>(step) % d_ : least];
}

/// Walks to the cone of a point and returns a bound on its distance; cell_ is where it ends.
double GrowingShell::walk(CellCones& cones, const double* p) {
  set_out_for(p);
  double best = internal::infinity;
  for (int step = 0; step < most_steps; ++step) {
    const std::size_t least = weigh(cones);
    const bool is_in_cone = weights_[least] >= 0;
    if (weights_[least] > -0x1p-20) {
      best = std::min(best, distance_up(cones, cell_));
      if (best <= tolerance_ || is_in_cone) return best;
    }
    cell_ = across(cones, least, step);
  }
  return best;
}

/// Takes out the open points that are covered or in the interior; sets cells_ for the others.
void GrowingShell::cover() {
  cones_ = std::make_unique<CellCones>(shell(), boundary().center().data());
  CellCones& cones = *cones_;
  const compiled::BoundaryEngine& engine = *boundary().engine();
  std::vector<Index> start(1);
  cells_.clear();
  cell_ = 0;
  std::size_t left = 0;
  for (const std::size_t i : open_) {
    const double distance = walk(cones, point(i));
    if (distance <= tolerance_) {
      start[0] = cones.hull().slots[cell_];
      if (sum_ < 1 - 0x1p-30 && compiled::descend(engine, point(i), start).second == Sign::positive) continue;
      covered_.push_back(i);
    } else {
      open_[left++] = i;
      cells_.push_back(static_cast<Index>(cell_));
    }
  }
  open_.resize(left);
}

/// Adds the farthest points beyond cells whose cones have open points.
bool GrowingShell::extend() {
  const SimplicialHull& hull = shell().hull();
  std::sort(cells_.begin(), cells_.end());
  cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
  LinearFunctions functions{boundary().center(), std::vector<double>(cells_.size() * d_)};
  std::vector<double> heights;
  for (std::size_t f = 0; f < cells_.size(); ++f) {
    double* const normal = functions.normals.data() + f * d_;
    const double threshold = compiled::hyperplane(*boundary().engine(), hull.slots[cells_[f]], normal);
    const double square = std::inner_product(normal, normal + d_, normal, 0.0);
    heights.push_back(1 + threshold + std::sqrt(square) * tolerance_);
    if (heights.back() < internal::infinity) continue;
    std::fill_n(normal, d_, 0.0);
    heights.back() = internal::infinity;
  }
  std::vector<double> points;
  for (const std::size_t i : open_) points.insert(points.end(), point(i), point(i) + d_);
  std::vector<std::size_t> farther;
  for (const bool tilted : {true, false}) {
    products_ += open_.size() * functions.size();
    const std::vector<std::size_t> farthest = sieve_.extremes_among(points, functions, tilted);
    for (std::size_t f = 0; f < farthest.size(); ++f) {
      if (farthest[f] == Extreme::nowhere) continue;
      const double* const x = points.data() + farthest[f] * d_;
      double value = 0;
      for (std::size_t j = 0; j < d_; ++j)
        value += functions.normals[f * d_ + j] * (x[j] - functions.origin[j]);
      if (value > heights[f]) farther.push_back(open_[farthest[f]]);
    }
    if (!farther.empty()) break;
  }
  if (farther.empty()) return cover_by_all();
  std::sort(farther.begin(), farther.end());
  farther.erase(std::unique(farther.begin(), farther.end()), farther.end());
  cones_.reset();
  sieve_.add_to_shell(farther);
  std::erase_if(open_, [&](std::size_t i) { return sieve_.is_in_shell(i); });
  return true;
}

/// The nearest points of the open ones in the hull of all vertices; false if one of them is not covered.
bool GrowingShell::cover_by_all() {
  constexpr std::size_t most_open = 256;
  if (open_.size() > most_open) return false;
  std::vector<const double*> vertices;
  for (Index site = 0; site < shell().sites().size(); ++site) vertices.push_back(shell().sites().point(site));
  for (const std::size_t i : open_) {
    nearest_.find(vertices, point(i), static_cast<int>(d_));
    if (!(nearest_.upper() <= tolerance_)) return false;
    covered_.push_back(i);
  }
  open_.clear();
  return true;
}

}  // namespace delone::hull
