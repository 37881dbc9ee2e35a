// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/sampling.hpp"

#include "base/platform.hpp"
#include "forecast/growth.hpp"
#include "forecast/quantities.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>

#include <algorithm>
#include <cmath>

namespace delone::cost_model {
namespace {

class Sampling {
 public:
  Sampling(const SampledSet& set, const ForecastOptions& options)
      : set_(set), options_(options), spent_(set.spent) {}

  Forecast run() {
    if (set_.num_points == 0) return finish({}, {1, 1});
    // The cost of sets in many dimensions grows fast.
    const int d = set_.dimension;
    const double stretch = d <= 5 ? 2 : 1.5;
    auto m = static_cast<std::size_t>(d <= 5 ? 8 * (d + 1) : 2 * d + 4);
    for (;;) {
      m = std::min(m, set_.most);
      build(m);
      const bool is_complete = m == set_.most && set_.most_is_all;
      const auto [cost, factor] = whole(is_complete);
      if (is_complete) return finish(cost, {1, 1.25});
      const double budget = std::min(std::max(cost.seconds / 20, least_budget), options_.sample_seconds);
      const bool is_enough = samples_.back().created_cells >= least_created;
      if (m == set_.most || (is_enough && spent_ + next_seconds(stretch) > budget))
        return finish(cost, {factor, samples_.back().seconds < 0.01 ? 1.5 : 1.3});
      m = static_cast<std::size_t>(stretch * static_cast<double>(m)) + 1;
    }
  }

 private:
  static constexpr double least_budget = 0.3;
  /// A sample with fewer cells tells too little, however long it took.
  static constexpr double least_created = 20000;

  void build(std::size_t m) {
    const double begin = platform::thread_seconds();
    const std::vector<double> points = set_.sample(m);
    const double start = platform::thread_seconds();
    const Delaunay<> t(points, set_.dimension);
    const double end = platform::thread_seconds();
    spent_ += end - begin;
    const Statistics statistics = t.statistics();
    if (!samples_.empty() && samples_.back().affine_dimension < t.affine_dimension()) samples_.clear();
    samples_.push_back(
        {static_cast<double>(t.num_vertices()), t.affine_dimension(),
         static_cast<double>(t.num_finite_cells()), static_cast<double>(t.num_infinite_cells()),
         std::max(static_cast<double>(statistics.created_cells), 1.0), end - start, is_hard(statistics)});
    largest_ = m;
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

  const SampledSet& set_;
  const ForecastOptions& options_;
  std::vector<SampleCost> samples_;
  std::size_t largest_ = 0;
  double spent_;
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
