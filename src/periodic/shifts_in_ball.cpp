// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/shifts_in_ball.hpp"

#include "base/progress_meter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::periodic {

ShiftsInBall::ShiftsInBall(const PeriodicSet& set, const Extent& extent)
    : set_(set),
      extent_(extent),
      radial_(set.dimension),
      fraction_of_p_(set.rank),
      step_(set.rank),
      slack_(set.rank),
      k_(set.rank),
      low_(set.rank),
      high_(set.rank),
      steps_(set.rank * set.rank),
      of_p_(set.rank),
      of_step_(set.rank),
      at_(set.rank),
      beyond_(extent.num_free_directions()),
      depth_(extent.num_free_directions()) {
  for (std::size_t i = 0; i < set.rank; ++i)
    for (std::size_t j = 0; j < set.rank; ++j) steps_[i * set.rank + j] = along(i, set.period.vector(j));
  for (const double largest : set.largest) size_ += largest;
}

double ShiftsInBall::along(std::size_t i, const double* x) const {
  double sum = 0;
  for (std::size_t j = 0; j < set_.dimension; ++j) sum += extent_.lattice_direction(i)[j] * x[j];
  return sum;
}

/// What find_range() needs of p and c.
void ShiftsInBall::set_ball(const double* p, const double* c) {
  const std::size_t d = set_.dimension;
  const Period& period = set_.period;
  double squared = 0;
  along_ = 0;
  for (std::size_t j = 0; j < d; ++j) squared += (c[j] - p[j]) * (c[j] - p[j]);
  radius_ = std::sqrt(squared);
  double along_slack = 0, lateral = 0, magnitude_of_c = size_;
  for (std::size_t j = 0; j < d; ++j) {
    radial_[j] = c[j] - p[j];
    magnitude_of_c += std::abs(c[j]);
  }
  slack_of_distance_ = 0x1p-40 * magnitude_of_c;
  for (std::size_t i = 0; i < set_.rank; ++i) {
    of_p_[i] = along(i, p);
    of_step_[i] = along(i, radial_.data());
  }
  for (std::size_t i = 0; i < set_.rank; ++i) {
    double step = 0, magnitude = 0;
    for (std::size_t j = 0; j < d; ++j) {
      step += period.gradient(i)[j] * (c[j] - p[j]);
      magnitude += std::abs(period.gradient(i)[j]) * (std::abs(c[j]) + std::abs(p[j]));
    }
    step_[i] = step;
    fraction_of_p_[i] = period.fraction(i, p);
    slack_[i] = 0x1p-44 * magnitude + 2 * extent_.fraction_slack(i);
    along_slack += slack_[i] / period.gradient_length(i);
  }
  for (std::size_t j = 0; j < d; ++j) {
    double coordinate = 0;
    for (std::size_t i = 0; i < set_.rank; ++i) {
      coordinate += step_[i] * period.vector(i)[j];
      along_slack +=
          0x1p-44 * std::abs(step_[i] * period.vector(i)[j]) + slack_[i] * std::abs(period.vector(i)[j]);
    }
    lateral += coordinate * coordinate;
  }
  along_ = std::sqrt(lateral) + along_slack;
  for (std::size_t i = 0; i < beyond_.size(); ++i) {
    double b = 0, at = 0;
    for (std::size_t j = 0; j < d; ++j) {
      b += extent_.free_direction(i)[j] * (c[j] - p[j]);
      at += extent_.free_direction(i)[j] * p[j];
    }
    beyond_[i] = std::abs(b) + 0x1p-44 * radius_;
    depth_[i] = std::max(b >= 0 ? extent_.high(i) - at : at - extent_.low(i), 0.0);
    // A direction that rounding may turn to the other side.
    if (std::abs(b) <= 0x1p-44 * radius_) depth_[i] = extent_.high(i) - extent_.low(i);
  }
  gain_ = set_.weighted ? std::max(extent_.largest_weight() - p[d], 0.0) : 0.0;
}

/// The shifts with images that the ball around p + part·(c − p) may have.
void ShiftsInBall::find_range(double part) {
  double squared = part * along_ * part * along_ + gain_;
  for (std::size_t i = 0; i < beyond_.size(); ++i) {
    const double b = part * beyond_[i], t = depth_[i];
    squared += b <= t ? b * b : t * (2 * b - t);
  }
  const double radius = std::sqrt(squared) * (1 + 0x1p-30);
  squared_radius_ = radius * radius;
  for (std::size_t i = 0; i < set_.rank; ++i) {
    const int reach = set_.period.reach(i);
    const double middle = fraction_of_p_[i] + part * step_[i],
                 width = radius * set_.period.gradient_length(i) + slack_[i];
    const double low = std::floor(middle - width), high = std::floor(middle + width);
    // Comparisons with NaN are false.
    low_[i] = low > -reach ? static_cast<std::int32_t>(std::min<double>(low, reach)) : -reach;
    high_[i] = high < reach ? static_cast<std::int32_t>(std::max<double>(high, -reach)) : reach;
  }
  for (std::size_t i = 0; i < set_.rank; ++i) at_[i] = of_p_[i] + part * of_step_[i];
}

/// Those with the k_ from `chosen` on, which have copies at this squared distance at least.
void ShiftsInBall::each_from(std::size_t chosen, double squared,
                             void (*visit)(const void*, std::span<const std::int32_t>), const void* context) {
  if (chosen == 0) {
    visit(context, k_);
    return;
  }
  const std::size_t i = chosen - 1;
  for (k_[i] = low_[i]; k_[i] <= high_[i]; ++k_[i]) {
    internal::cancellation_point();
    double at = at_[i];
    for (std::size_t j = i; j < set_.rank; ++j) at -= k_[j] * steps_[i * set_.rank + j];
    const double apart =
        std::max({extent_.lattice_low(i) - at, at - extent_.lattice_high(i), 0.0}) - slack_of_distance_;
    const double sum = squared + (apart > 0 ? apart * apart : 0.0);
    if (sum > squared_radius_) continue;
    each_from(i, sum, visit, context);
  }
}

}  // namespace delone::periodic
