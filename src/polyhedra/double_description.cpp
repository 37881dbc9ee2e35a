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
#include <iterator>
#include <limits>
#include <optional>
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
  double seconds() const { return seconds_; }
  PointedRays result() {
    if (tier_ == Tier::small) return result(small_);
    return tier_ == Tier::medium ? result(medium_) : result(large_);
  }
  /// Whether nine of ten rays at present are simple.
  bool are_simple() const {
    const std::size_t simple = graph_->num_simple_rays(), all = graph_->rays().size();
    return 10 * simple >= 9 * all;
  }

 private:
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

/// When insertion is tried, too, in cones of few dimensions: after this many seconds, and again whenever four
/// times as many have passed. Each try may take `factor` times as long as the steps so far. It counts
/// milliseconds in twenties, so there is no try before that.
struct Trial {
  std::size_t most_dimensions;
  bool needs_simple_rays;
  double first_seconds, factor;
};
constexpr Trial trials[] = {{5, false, 0.005, 5}, {6, true, 0.005, 5}, {7, true, 0.02, 1}};

}  // namespace

PointedRays find_rays_by_steps(const PointedCone& cone, unsigned threads, Tier first) {
  Steps steps(cone, threads, first);
  steps.run_until(std::numeric_limits<double>::infinity());
  return steps.result();
}

PointedRays find_rays_of_pointed(const PointedCone& cone, unsigned threads) {
  Steps steps(cone, threads, Tier::small);
  const auto trial = std::find_if(std::begin(trials), std::end(trials), [&](const Trial& t) {
    return cone.first_rays.size() <= t.most_dimensions;
  });
  constexpr double growth = 4;
  if (trial != std::end(trials))
    for (double seconds = trial->first_seconds; !steps.run_until(seconds);
         seconds = growth * steps.seconds()) {
      if (trial->needs_simple_rays && !steps.are_simple()) break;
      if (auto rays = find_rays_by_insertion(cone, trial->factor * steps.seconds())) return std::move(*rays);
    }
  steps.run_until(std::numeric_limits<double>::infinity());
  return steps.result();
}

}  // namespace delone::polyhedra
