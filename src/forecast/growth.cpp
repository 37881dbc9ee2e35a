// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/growth.hpp"

#include "forecast/model/cell_counts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::cost_model {
namespace {

/// What there is from the largest sample to the whole, as logarithms of ratios.
struct Step {
  double weight = 0;
  double cells = 0, infinite = 0, created = 0, seconds = 0, bytes = 0;
};

/// Smaller samples say less about the growth of larger ones.
bool says_something(const SampleCost& sample) { return sample.points >= 2 * sample.affine_dimension + 2; }

/// A curve as it holds for points of k dimensions among d coordinates.
Curve adapted(Curve curve, int d) {
  if (curve.affine_dimension < d) curve.wrapping_nanoseconds = 0;  // points in a flat are inserted
  return curve;
}

/// How badly a curve, moved to the last sample, fits the others: the mean square of logarithms.
double misfit(const Curve& curve, std::span<const SampleCost> samples, int d) {
  const auto offset = [&](const SampleCost& sample) {
    return std::log(sample.cells / cost_of(curve, d, sample.points, sample.points).cells);
  };
  const double last = offset(samples.back());
  double sum = 0, weights = 0, weight = 1;
  for (std::size_t i = samples.size() - 1; i-- > 0 && says_something(samples[i]); weight *= 0.7) {
    const double difference = offset(samples[i]) - last;
    sum += weight * difference * difference;
    weights += weight;
  }
  // How far off it is says something, too, but less.
  constexpr double of_level = 0.15;
  return (weights > 0 ? sum / weights : 0) + of_level * last * last;
}

Step step_along(const Curve& curve, const SampleCost& last, int d, double n, double vertices) {
  const Cost from = cost_of(curve, d, last.points, last.points), to = cost_of(curve, d, n, vertices);
  Step step;
  step.cells = std::log(to.cells / from.cells);
  step.infinite = std::log(to.infinite_cells / from.infinite_cells) - step.cells;
  step.created = std::log(to.created_cells / from.created_cells) - step.cells;
  step.seconds = std::log(to.seconds / from.seconds);
  step.bytes = std::log(to.bytes / (to.cells + to.infinite_cells));
  return step;
}

/// Without a model: the slope of the last two samples beyond proportional growth falls as the share of points
/// near the border does.
double generic_growth(std::span<const SampleCost> samples, double vertices) {
  const SampleCost& last = samples.back();
  double excess = 0;
  const double k = last.affine_dimension;
  if (samples.size() > 1 && samples[samples.size() - 2].cells > 0 &&
      samples[samples.size() - 2].points < last.points) {
    const SampleCost& before = samples[samples.size() - 2];
    excess = std::log(last.cells / before.cells) / std::log(last.points / before.points) - 1;
    excess *= std::pow(last.points / before.points, -0.5 / k);
  }
  return std::log(vertices / last.points) + excess * k * (1 - std::pow(vertices / last.points, -1 / k));
}

}  // namespace

Grown grown(std::span<const SampleCost> samples, int d, double n, double vertices) {
  const SampleCost& last = samples.back();
  const int k = last.affine_dimension;
  std::vector<Curve> candidates;
  for (const Curve& curve : curves()) {
    if (curve.affine_dimension != k || curve.growth == Growth::lattice) continue;
    // Kinds that are not wrapped are those that take exact arithmetic.
    const bool may_wrap = k == d && is_worth_wrapping(k, n);
    if (may_wrap && (curve.wrapping_nanoseconds == 0) != last.is_hard) continue;
    candidates.push_back(adapted(curve, d));
  }
  if (candidates.empty()) candidates.push_back(adapted(curve_of_spread(k), d));
  std::vector<double> misfits;
  for (const Curve& curve : candidates) misfits.push_back(misfit(curve, samples, d));
  const double least = *std::min_element(misfits.begin(), misfits.end());
  // The standard deviation of logarithms of numbers of cells, between samples and about the curves.
  const double noise = std::sqrt(0.02 * 0.02 + 0.1 / last.points);
  std::vector<Step> steps;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Step step = step_along(candidates[i], last, d, n, vertices);
    step.weight = std::exp(-(misfits[i] - least) / (2 * noise * noise));
    if (step.weight > 1e-3) steps.push_back(step);
  }
  Step mean;
  for (const Step& step : steps) {
    mean.weight += step.weight;
    mean.cells += step.weight * step.cells;
    mean.infinite += step.weight * step.infinite;
    mean.created += step.weight * step.created;
    mean.seconds += step.weight * (step.seconds - step.cells);
    mean.bytes += step.weight * step.bytes;
  }
  mean.cells /= mean.weight;
  // The worse the best curve fits, the more counts what the samples say by themselves.
  const double trust = 1 / (1 + least / (25 * noise * noise));
  const double by_curves = mean.cells;
  mean.cells = trust * by_curves + (1 - trust) * generic_growth(samples, vertices);
  double variance = 0;
  for (const Step& step : steps)
    variance += step.weight / mean.weight * (step.cells - mean.cells) * (step.cells - mean.cells);

  Grown result;
  Cost& cost = result.cost;
  cost.affine_dimension = k;
  cost.vertices = vertices;
  const double most = most_cells(k, vertices);
  cost.cells = std::min(last.cells * std::exp(mean.cells), most);
  cost.infinite_cells =
      std::min(cost.cells * last.infinite_cells / last.cells * std::exp(mean.infinite / mean.weight),
               std::max(most - cost.cells, k + 1.0));
  cost.created_cells =
      std::max(cost.cells + cost.infinite_cells,
               cost.cells * last.created_cells / last.cells * std::exp(mean.created / mean.weight));
  cost.seconds = last.seconds * std::exp(mean.cells + mean.seconds / mean.weight);
  cost.bytes = std::exp(mean.bytes / mean.weight) * (cost.cells + cost.infinite_cells);
  const double doublings = std::log2(std::max(vertices / last.points, 1.0));
  result.factor = std::exp(std::sqrt(variance) + 0.03 * doublings + 0.02);
  return result;
}

}  // namespace delone::cost_model
