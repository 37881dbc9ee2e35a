// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/sampling.hpp"

#include "base/platform.hpp"
#include "base/stopwatch.hpp"
#include "forecast/growth.hpp"
#include "forecast/quantities.hpp"

#include <delone/arithmetic.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace delone::cost_model {
namespace {

class Sampling {
 public:
  Sampling(const SampledSet& set, const ForecastOptions& options)
      : set_(set), options_(options), spent_(set.spent), most_seconds_(hardest(options)) {}

  Forecast run() {
    if (set_.num_points == 0) return finish({}, {1, 1});
    for (std::size_t m = first_size();; m = next_size(m)) {
      m = std::min(m, set_.most);
      if (!build(m)) return stopped();
      const bool is_complete = m == set_.most && set_.most_is_all;
      const auto [cost, factor] = whole(is_complete);
      if (is_complete) return finish(cost, {1, 1.25});
      const double budget = std::min(std::max(cost.seconds / 20, least_budget), options_.sample_seconds);
      const bool is_enough = samples_.back().created_cells >= least_created;
      const double next = spent_ + next_seconds(static_cast<double>(next_size(m)) / static_cast<double>(m));
      if (m == set_.most || (is_enough && next > budget))
        return finish(cost, {factor, samples_.back().seconds < 0.01 ? 1.5 : 1.3});
      if (!is_enough && next > 2 * most_seconds_) return stopped();
    }
  }

 private:
  static constexpr double least_budget = 0.3;
  /// A sample with fewer cells tells too little, however long it took.
  static constexpr double least_created = 20000;

  /// After so many seconds samples end, also within one of them: the work of a small sample may have no
  /// bound that is known before, as in many dimensions or where many signs take exact arithmetic.
  static double hardest(const ForecastOptions& options) {
    constexpr double least = 1, ahead = 0.2;
    return std::max(options.sample_seconds, least) + ahead;
  }

  /// If the machine is busy with other work, the clock on the wall ends samples a little later.
  bool is_overdue() const {
    constexpr double wait = 0.1;
    return stopwatch_.seconds() > most_seconds_ + wait;
  }

  /// The cost of sets in many dimensions grows fast. Beyond the compiled ones the first samples have hardly
  /// more points than a simplex.
  std::size_t first_size() const {
    const int d = set_.dimension;
    return static_cast<std::size_t>(d <= 5                            ? 8 * (d + 1)
                                    : d <= largest_measured_dimension ? 2 * d + 4
                                                                      : d + 3);
  }
  std::size_t next_size(std::size_t m) const {
    const std::size_t simplex = static_cast<std::size_t>(set_.dimension) + 1;
    if (set_.dimension > largest_measured_dimension && m < 2 * simplex) return simplex + 2 * (m - simplex);
    return static_cast<std::size_t>((set_.dimension <= 5 ? 2 : 1.5) * static_cast<double>(m)) + 1;
  }

  /// False if there is no time for it.
  bool build(std::size_t m) {
    const double begin = platform::thread_seconds();
    const std::vector<double> points = set_.sample(m);
    const double start = platform::thread_seconds(), last = begin + most_seconds_ - spent_;
    if (!(start < last) || is_overdue()) return false;
    bool is_late = false;
    const auto goes_on = [&](double) {
      const ArithmeticScope arithmetic;  // progress functions run in the state of the caller
      is_late = platform::thread_seconds() > last || is_overdue();
      return !is_late;
    };
    std::optional<Delaunay<>> built;
    try {
      built.emplace(points, set_.dimension, Options{.progress = goes_on});
    } catch (const Error& error) {
      if (error.code() != Errc::cancelled || !is_late) throw;
      return false;
    }
    const Delaunay<>& t = *built;
    const double end = platform::thread_seconds();
    spent_ += end - begin;
    const Statistics statistics = t.statistics();
    if (!samples_.empty() && samples_.back().affine_dimension < t.affine_dimension()) samples_.clear();
    samples_.push_back(
        {static_cast<double>(t.num_vertices()), t.affine_dimension(),
         static_cast<double>(t.num_finite_cells()), static_cast<double>(t.num_infinite_cells()),
         std::max(static_cast<double>(statistics.created_cells), 1.0), end - start, is_hard(statistics)});
    largest_ = m;
    return true;
  }

  /// Whether so many signs are too close to 0 for rounded numbers that cells cannot be wrapped.
  static bool is_hard(const Statistics& statistics) {
    return static_cast<double>(statistics.exact + statistics.perturbed) >
           1e-3 * static_cast<double>(statistics.filter + statistics.direct);
  }

  /// What a sample takes that is larger than the last by a factor.
  double next_seconds(double stretch) const {
    const SampleCost& last = samples_.back();
    double exponent = 2;
    if (samples_.size() > 1) {
      const SampleCost& before = samples_[samples_.size() - 2];
      if (before.points < last.points && before.seconds > 0)
        exponent =
            std::max(std::log(last.seconds / before.seconds) / std::log(last.points / before.points), 1.2);
    }
    return last.seconds * std::pow(stretch, exponent);
  }

  struct Whole {
    Cost cost;
    double factor;  ///< by which the number of cells may be wrong
  };
  Whole whole(bool is_complete) const {
    const auto n = static_cast<double>(set_.num_points);
    const SampleCost& last = samples_.back();
    if (last.affine_dimension < 1) return {cost_of_spread(1, set_.dimension, n, last.points, false), 1.1};
    const double vertices = is_complete ? last.points : set_.num_distinct;
    GrownCells cells = is_complete || set_.known_cells == 0 ? grown_cells(samples_, vertices)
                                                            : GrownCells{set_.known_cells, 1.3};
    return {grown_cost(samples_, set_.dimension, n, vertices, cells.cells), cells.factor};
  }

  Forecast finish(const Cost& cost, const Uncertainty& about) const {
    Forecast result = as_forecast(cost, set_.dimension, set_.num_points, options_.threads, about);
    result.num_sampled = largest_;
    if (!set_.most_is_all) {
      result.vertices.low = std::floor(0.98 * cost.vertices);
      result.vertices.high = std::min(std::ceil(1.02 * cost.vertices), static_cast<double>(set_.num_points));
    }
    return result;
  }

  /// Where a sample has been stopped, smaller ones tell what they can; without any, points that are spread
  /// evenly do.
  Forecast stopped() const {
    if (!samples_.empty() && samples_.back().affine_dimension >= 1) {
      const auto [cost, factor] = whole(false);
      const bool is_enough = samples_.back().created_cells >= least_created;
      return finish(cost, {is_enough ? factor : 2 * factor, 3});
    }
    const auto n = static_cast<double>(set_.num_points);
    const Cost cost = cost_of_spread(set_.dimension, set_.dimension, n, set_.num_distinct, true);
    return finish(cost, {10 * cost.factor, 10});
  }

  const SampledSet& set_;
  const ForecastOptions& options_;
  std::vector<SampleCost> samples_;
  std::size_t largest_ = 0;
  double spent_;
  const double most_seconds_;
  internal::Stopwatch stopwatch_;
};

}  // namespace

void require_options(const ForecastOptions& options) {
  if (!(options.sample_seconds > 0) || std::isinf(options.sample_seconds))
    throw Error(Errc::invalid_argument, "sample_seconds: a finite number of seconds above 0 was expected");
}

Forecast forecast_by_samples(const SampledSet& set, const ForecastOptions& options) {
  return Sampling(set, options).run();
}

}  // namespace delone::cost_model
