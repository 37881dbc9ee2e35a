// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/growth.hpp"

#include "forecast/model/cell_counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace delone::cost_model {
namespace {

using Samples = std::span<const SampleCost>;

/// Points spread evenly: how their cells grow is known up to their border.
double log_spread(int k, double v) { return std::log(cost_of_spread(k, k, v, v, true).cells); }

/// log(cells), beyond that of as many points spread evenly.
double offset(const SampleCost& sample) {
  return std::log(sample.cells) - log_spread(sample.affine_dimension, sample.points);
}

/// How offsets go on. A Poisson process is the limit of all sets with a density, and what is different at
/// their border falls like v^(−1/k). On surfaces and curves the offset has a slope in log(v); it falls in the
/// same way, or it stays.
enum class Law { vanishing, falling, straight };
constexpr std::array<double, 3> credit{1, 0.7, 0.3};  // of each before the samples are seen

/// log(cells) of v points.
double continued(Samples samples, Law law, double v) {
  const SampleCost& last = samples.back();
  const double k = last.affine_dimension, growth = v / last.points;
  const double spread = log_spread(last.affine_dimension, v);
  if (law == Law::vanishing) return spread + offset(last) * std::pow(growth, -1 / k);
  // Over a wide step, as the samples scatter.
  constexpr double wide = 2.5;
  std::size_t i = samples.size() - 1;
  while (i > 0 && samples[i].points * wide > last.points) --i;
  const double step = last.points / samples[i].points;
  double slope = step > 1 ? (offset(last) - offset(samples[i])) / std::log(step) : 0;
  if (law == Law::falling) slope *= std::pow(step, -0.5 / k);  // it is that of the middle of the step
  return spread + offset(last) +
         slope * (law == Law::straight ? std::log(growth) : k * (1 - std::pow(growth, -1 / k)));
}

/// Whether the samples are large enough to say how larger ones grow.
bool tell_growth(Samples samples) {
  return samples.size() > 1 && samples[samples.size() - 2].points >= 2 * samples.back().affine_dimension + 2;
}

/// How far a law is off where it is known: the largest sample, forecast from smaller ones. A mean square of
/// logarithms, and none without such samples.
double misfit(Samples samples, Law law) {
  const double actual = std::log(samples.back().cells);
  double sum = 0, weights = 0, weight = 1;
  for (std::size_t known = samples.size(); known-- > 0 && weight > 0.2; weight /= 2) {
    const Samples smaller = samples.first(known);
    if (!tell_growth(smaller)) break;
    const double error = continued(smaller, law, samples.back().points) - actual;
    sum += weight * error * error;
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

/// The number of infinite cells is a power of v, as far as the samples tell.
double infinite_per_cell(Samples samples, double vertices) {
  const SampleCost& last = samples.back();
  const double ratio = last.infinite_cells / last.cells;
  if (!tell_growth(samples)) {  // as of points that are spread evenly
    const int k = last.affine_dimension;
    const Cost from = cost_of_spread(k, last.points), to = cost_of_spread(k, std::max(vertices, last.points));
    return from.infinite_cells > 0
               ? ratio * (to.infinite_cells / to.cells) / (from.infinite_cells / from.cells)
               : ratio;
  }
  const SampleCost& before = samples[samples.size() - 2];
  if (!(before.points < last.points)) return ratio;
  const double slope =
      std::log(ratio * before.cells / before.infinite_cells) / std::log(last.points / before.points);
  return ratio * std::pow(vertices / last.points, std::clamp(slope, -1.0, 0.0));
}

}  // namespace

GrownCells grown_cells(Samples samples, double vertices) {
  const SampleCost& last = samples.back();
  // The standard deviation of logarithms of numbers of cells, between samples.
  const double noise = 0.02 * 0.02 + 0.3 / last.points;
  std::array<double, credit.size()> weights{}, results{};
  const bool is_known = tell_growth(samples.first(samples.size() - 1));
  double sum = 0, mean = 0, variance = 0;
  for (std::size_t i = 0; i < credit.size(); ++i) {
    const Law law = static_cast<Law>(i);
    results[i] = continued(samples, law, vertices);
    weights[i] = is_known ? credit[i] * std::exp(-misfit(samples, law) / (2 * noise)) : i == 0 ? 1.0 : 0.0;
    sum += weights[i];
  }
  if (!(sum > 0)) weights = {0, 1, 0}, sum = 1;  // none fits
  for (std::size_t i = 0; i < credit.size(); ++i) mean += weights[i] / sum * results[i];
  for (std::size_t i = 0; i < credit.size(); ++i)
    variance += weights[i] / sum * (results[i] - mean) * (results[i] - mean);
  const int k = last.affine_dimension;
  const double growth = std::max(vertices / last.points, 1.0);
  // What is different from points that are spread evenly may stay, and how these grow is known to a factor.
  const double stays = is_known ? 0 : std::abs(offset(last)) * (1 - std::pow(growth, -1.0 / k));
  const double spread = k <= largest_measured_dimension ? 0 : 0.15 * std::log(growth);
  return {std::min(std::exp(mean), most_cells(k, vertices)),
          std::exp(std::sqrt(variance) + stays + spread + 0.03 * std::log2(growth) + 0.02)};
}

Cost grown_cost(Samples samples, int d, double n, double vertices, double cells) {
  const SampleCost& last = samples.back();
  const int k = last.affine_dimension;
  const bool wraps = k == d && !last.is_hard;  // points in a flat are inserted
  const Cost from = cost_of_spread(k, d, last.points, last.points, wraps),
             to = cost_of_spread(k, d, n, vertices, wraps);
  const auto step = [&](double Cost::*member) {  // per cell
    return (to.*member / to.cells) / (from.*member / from.cells);
  };
  Cost cost;
  cost.affine_dimension = k;
  cost.vertices = vertices;
  cost.cells = cells;
  cost.infinite_cells = std::min(cells * infinite_per_cell(samples, vertices),
                                 std::max(most_cells(k, vertices) - cells, k + 1.0));
  const double all = cells + cost.infinite_cells;
  cost.created_cells = std::max(cells * last.created_cells / last.cells * step(&Cost::created_cells), all);
  cost.seconds = cells * last.seconds / last.cells * step(&Cost::seconds);
  cost.bytes = bytes_of(k, d, n, vertices, all, wraps);
  return cost;
}

}  // namespace delone::cost_model
