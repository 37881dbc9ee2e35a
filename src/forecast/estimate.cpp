// SPDX-License-Identifier: BSD-3-Clause
// The forecast for given points, from samples of them.
#include <delone/forecast.hpp>

#include "base/guarded.hpp"
#include "base/platform.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "forecast/growth.hpp"
#include "forecast/lattice_points.hpp"
#include "forecast/quantities.hpp"
#include "forecast/sample.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone {
namespace {

using cost_model::Cost;
using cost_model::SampleCost;

class Estimate {
 public:
  Estimate(std::span<const double> coordinates, int dimension, const EstimateOptions& options)
      : coordinates_(coordinates),
        dimension_(dimension),
        n_(coordinates.size() / static_cast<std::size_t>(dimension)),
        options_(options) {}

  Forecast run() {
    if (n_ == 0) return finish({}, {1, 1});
    sample_ = cost_model::sample_of(coordinates_, dimension_, most_sampled);
    const double start = platform::thread_seconds();
    lattice_ = cost_model::find_lattice(coordinates_, dimension_, sample_.rows, sample_.num_distinct);
    spent_ = platform::thread_seconds() - start;
    // The cost of sets in many dimensions grows fast.
    const double stretch = dimension_ <= 5 ? 2 : 1.5;
    auto m = static_cast<std::size_t>(dimension_ <= 5 ? 8 * (dimension_ + 1) : 2 * dimension_ + 4);
    for (;;) {
      m = std::min(m, sample_.rows.size());
      build(m);
      const cost_model::Grown grown = all();
      if (is_complete()) return finish(grown.cost, {1, 1.25});
      const double budget =
          std::min(std::max(grown.cost.seconds / 20, least_budget), options_.sample_seconds);
      const bool is_enough = samples_.back().created_cells >= least_created;
      if (m == sample_.rows.size() || (is_enough && spent_ + next_seconds(stretch) > budget))
        return finish(grown.cost, {grown.factor, seconds_are_rough() ? 1.5 : 1.3});
      m = static_cast<std::size_t>(stretch * static_cast<double>(m)) + 1;
    }
  }

 private:
  static constexpr std::size_t most_sampled = 1 << 18;
  static constexpr double least_budget = 0.3;
  /// A sample with fewer cells tells too little, however long it took.
  static constexpr double least_created = 20000;

  void build(std::size_t m) {
    const auto d = static_cast<std::size_t>(dimension_);
    const double begin = platform::thread_seconds();
    std::vector<double> points;
    if (lattice_.found && m < sample_.rows.size()) {
      points = cost_model::patch_around(coordinates_, dimension_, sample_.rows.front(), m);
    } else {
      for (std::size_t i = 0; i < m; ++i) {
        const double* const point = coordinates_.data() + sample_.rows[i] * d;
        points.insert(points.end(), point, point + d);
      }
    }
    const double start = platform::thread_seconds();
    const Delaunay<> t(points, dimension_);
    const double end = platform::thread_seconds(), seconds = end - start;
    spent_ += end - begin;
    const Statistics statistics = t.statistics();
    const auto distinct = static_cast<double>(t.num_vertices());
    if (!samples_.empty() && samples_.back().affine_dimension < t.affine_dimension()) samples_.clear();
    samples_.push_back({distinct, t.affine_dimension(), static_cast<double>(t.num_finite_cells()),
                        static_cast<double>(t.num_infinite_cells()),
                        std::max(static_cast<double>(statistics.created_cells), 1.0), seconds,
                        is_hard(statistics)});
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

  bool is_complete() const { return sample_.is_all && largest_ == sample_.rows.size(); }
  bool seconds_are_rough() const { return samples_.back().seconds < 0.01; }

  cost_model::Grown all() const {
    const auto n = static_cast<double>(n_);
    const SampleCost& last = samples_.back();
    if (last.affine_dimension < 1) {
      cost_model::Grown point;
      point.cost = cost_model::cost_of(cost_model::curve_of_spread(dimension_), dimension_, n, last.points);
      return point;
    }
    cost_model::Grown result = cost_model::grown(samples_, dimension_, n, sample_.num_distinct);
    if (lattice_.found && !is_complete()) result = of_lattice();
    return result;
  }

  /// The cells are those of the volume, and cost what those of a patch cost.
  cost_model::Grown of_lattice() const {
    const auto n = static_cast<double>(n_);
    const cost_model::Curve* curve = cost_model::find_curve(lattice_.kind, dimension_);
    if (curve == nullptr) curve = cost_model::find_curve("grid", dimension_);
    if (curve == nullptr) return cost_model::grown(samples_, dimension_, n, sample_.num_distinct);
    cost_model::Grown result;
    result.cost = cost_model::cost_of(*curve, dimension_, n, sample_.num_distinct, lattice_.hull_volume);
    const SampleCost& last = samples_.back();
    const double nanoseconds = 1e9 * last.seconds / last.created_cells;
    result.cost.seconds *= nanoseconds / curve->nanoseconds;
    result.factor = 1.3;
    return result;
  }

  Forecast finish(const Cost& cost, const cost_model::Uncertainty& about) const {
    Forecast result = cost_model::as_forecast(cost, dimension_, n_, options_.threads, about);
    result.num_sampled = largest_;
    if (!sample_.is_all && n_ > 0) {
      result.vertices.low = std::floor(0.98 * cost.vertices);
      result.vertices.high = std::min(std::ceil(1.02 * cost.vertices), static_cast<double>(n_));
    }
    return result;
  }

  std::span<const double> coordinates_;
  int dimension_;
  std::size_t n_;
  const EstimateOptions& options_;
  cost_model::Sample sample_;
  cost_model::LatticePoints lattice_;
  std::vector<SampleCost> samples_;
  std::size_t largest_ = 0;
  double spent_ = 0;
};

}  // namespace

Forecast estimate(const AnyPoints<>& points, int dimension, const EstimateOptions& options) {
  internal::require_dimension(dimension);
  points.require_dimension(dimension);
  if (!(options.sample_seconds > 0) || std::isinf(options.sample_seconds))
    throw Error(Errc::invalid_argument, "sample_seconds: a finite number of seconds above 0 was expected");
  const std::span<const double> coordinates = points.coordinates();
  if (coordinates.size() % static_cast<std::size_t>(dimension) != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  internal::require_finite(coordinates, static_cast<std::size_t>(dimension), "a coordinate");
  const internal::ProgressMeter meter(options.progress);
  return internal::guarded("a sample of the points",
                           [&] { return Estimate(coordinates, dimension, options).run(); });
}

}  // namespace delone
