// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/double_description.hpp"

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/stopwatch.hpp"
#include "polyhedra/insertion.hpp"
#include "polyhedra/ray_graph.hpp"
#include "polyhedra/ray_numbers.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace delone::polyhedra {
namespace {

/// The state between two steps. What a step computes changes it only when all of it is known, so a step can
/// be repeated with other integers.
class Steps {
 public:
  Steps(const PointedCone& cone, unsigned threads, Tier first)
      : cone_(cone), threads_(threads), tier_(first), progress_(no_function_, cone.rows.size()) {}

  /// Goes on until all calls have taken this many seconds. Returns whether it has come to the end.
  bool run_until(double seconds) {
    try {
      return try_until(seconds);
    } catch (const Error& error) {
      if (!graph_ || (error.code() != Errc::time_limit && error.code() != Errc::out_of_memory)) throw;
      throw Error(error.code(), std::string(error.what()) + "; " + std::to_string(graph_->rays().size()) +
                                    " vertices and rays of an intermediate polyhedron, of " +
                                    std::to_string(row_) + " of " + std::to_string(cone_.rows.size()) +
                                    " rows: their number may grow differently from this forecast");
    }
  }
  double seconds() const { return seconds_; }
  /// The share of the rows that have been taken.
  double fraction() const { return static_cast<double>(row_) / static_cast<double>(cone_.rows.size()); }
  PointedRays result() {
    if (tier_ == Tier::small) return result(small_);
    return tier_ == Tier::medium ? result(medium_) : result(large_);
  }
  /// Whether nine of ten rays of the intermediate cone are simple.
  bool are_simple() const {
    const std::size_t simple = graph_->num_simple_rays(), all = graph_->rays().size();
    return 10 * simple >= 9 * all;
  }

 private:
  bool try_until(double seconds) {
    stopwatch_.restart();
    seconds_left_ = seconds - seconds_;
    if (tier_ == Tier::small && !try_all(small_)) {
      medium_.take(small_);
      small_ = {};
      tier_ = Tier::medium;
    }
    if (tier_ == Tier::medium && !try_all(medium_)) {
      large_.take(medium_);
      medium_ = {};
      tier_ = Tier::large;
    }
    if (tier_ == Tier::large) try_all(large_);
    seconds_ += stopwatch_.seconds();
    return row_ == cone_.rows.size();
  }
  template <class T>
  bool try_all(RayNumbers<T>& numbers) {
    if (!numbers.has_rows() && !numbers.try_set_rows(cone_.rows)) return false;
    if (!graph_ && !try_begin(numbers)) return false;
    for (; row_ < cone_.rows.size(); ++row_) {
      if (stopwatch_.seconds() > seconds_left_) return true;
      progress_(row_);
      if (graph_->cuts(row_) && !try_step(numbers)) return false;
    }
    return true;
  }
  template <class T>
  bool try_begin(RayNumbers<T>& numbers) {
    numbers.clear_rays();
    for (const Row& ray : cone_.first_rays)
      if (!numbers.try_add_ray(ray)) return false;
    RayGraph graph(cone_.rows);
    const std::size_t d = cone_.first_rays.size();
    for (RayId ray = 0; ray < d; ++ray) {
      std::vector<std::uint64_t> zeros(words_for(cone_.rows.size()), 0);
      for (std::size_t row = 0; row < d; ++row)
        if (row != ray) insert(zeros, row);
      const std::uint32_t first_negative = numbers.find_signs_of(ray, d, zeros);
      graph.add(zeros, first_negative);
    }
    graph.connect_all();
    graph_ = std::move(graph);
    row_ = d;
    return true;
  }
  template <class T>
  bool try_step(RayNumbers<T>& numbers) {
    NewRays made;
    made.edges = graph_->edges_cut_by(row_);
    if (!numbers.try_cut(row_, *graph_, made, threads_)) return false;
    std::vector<RayId> ids;
    graph_->commit(row_, made, ids);
    numbers.commit(*graph_, ids);
    graph_->connect(row_, threads_);
    return true;
  }
  template <class T>
  PointedRays result(RayNumbers<T>& numbers) {
    const std::vector<RayId> ids = graph_->rays();
    PointedRays result;
    result.zeros = BitRows(ids.size(), cone_.rows.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const ConstBits zeros = graph_->zeros(ids[i]);
      std::copy(zeros.begin(), zeros.end(), result.zeros[i].begin());
    }
    graph_.reset();  // before large rows are made
    numbers.end_steps();
    result.rays.resize(ids.size());
    constexpr std::size_t part = 1024;
    internal::for_parts(threads_, ids.size(), part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          for (std::size_t i = first; i < last; ++i) {
                            stop();
                            result.rays[i] = numbers.ray(ids[i]);
                          }
                        });
    return result;
  }

  const PointedCone& cone_;
  const unsigned threads_;
  Tier tier_;
  internal::Stopwatch stopwatch_;
  double seconds_ = 0, seconds_left_ = 0;
  const std::function<bool(double)> no_function_;
  internal::ProgressMeter progress_;
  std::optional<RayGraph> graph_;
  std::size_t row_ = 0;
  RayNumbers<std::int64_t> small_;
  RayNumbers<Int128> medium_;
  RayNumbers<Integer> large_;
};

/// When insertion is tried, too, in cones of few dimensions: the first time after `first_seconds`. A try may
/// take `factor` times as long as the steps so far, but no longer than the steps still need if the rest of
/// the rows takes as long in proportion. All tries together may take no longer than all steps. So they at
/// most double the time, unless that estimate is too high. A try that is stopped tells its share of the
/// rows. All of them take at least as long in proportion, and there is no other try before that much time is
/// allowed.
struct Trial {
  std::size_t least_dimensions, most_dimensions;
  bool needs_simple_rays;
  double first_seconds, factor;
};
constexpr Trial trials[] = {{3, 6, true, 0.005, 5}, {7, 7, true, 0.05, 5}, {3, 5, false, 0.04, 1}};

/// By insertion, if it ends before the steps do.
std::optional<PointedRays> try_insertion(const PointedCone& cone, const Trial& trial, Steps& steps) {
  constexpr double margin = 1.2;
  double needed = 0.02;  // insertion looks at the clock about this often
  double spent = 0;
  for (double seconds = trial.first_seconds; !steps.run_until(seconds); seconds *= 2) {
    if (trial.needs_simple_rays && !steps.are_simple()) return std::nullopt;
    const double so_far = steps.seconds(), rest = so_far / steps.fraction() - so_far;
    const double allowed = std::min({trial.factor * so_far, rest, so_far + rest - spent});
    if (allowed < needed) continue;
    InsertedRays found = find_rays_by_insertion(cone, allowed);
    if (found.rays || !found.can_go_on) return std::move(found.rays);
    spent += allowed;
    needed = margin * allowed / std::max(found.fraction, 0.01);
  }
  return std::nullopt;
}

}  // namespace

PointedRays find_rays_by_steps(const PointedCone& cone, unsigned threads, Tier first) {
  Steps steps(cone, threads, first);
  steps.run_until(std::numeric_limits<double>::infinity());
  return steps.result();
}

PointedRays find_rays_of_pointed(const PointedCone& cone, unsigned threads) {
  Steps steps(cone, threads, Tier::small);
  const std::size_t d = cone.first_rays.size();
  for (const Trial& trial : trials)
    if (trial.least_dimensions <= d && d <= trial.most_dimensions)
      if (auto rays = try_insertion(cone, trial, steps)) return std::move(*rays);
  steps.run_until(std::numeric_limits<double>::infinity());
  return steps.result();
}

}  // namespace delone::polyhedra
