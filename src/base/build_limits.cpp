// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_limits.hpp"

#include "base/platform.hpp"
#include "base/require_tolerance.hpp"
#include "messages/readable.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>

namespace delone::internal {
namespace {

constexpr double least_fraction = 0.02, least_seconds = 0.02, least_bytes = std::size_t{4} << 20;

/// So close to the limit the construction ends: the memory that is written between two looks.
constexpr std::size_t most_margin = std::size_t{64} << 20;
std::size_t margin(std::size_t memory) { return std::min(memory / 8, most_margin); }

/// The least limit under which so much memory is no error.
double limit_for(double memory) {
  return std::min(memory * 8 / 7, memory + static_cast<double>(most_margin));
}

/// The exponent with which a cost has grown. Where it has grown by less than `least_growth`, that is noise.
double exponent(double from, double to, double log_ratio, double least_growth) {
  constexpr double least = 1, most = 5;  // ⌈d/2⌉ in 9D; the fraction is one of points
  if (!(from > 0 && to - from >= least_growth)) return least;
  return std::clamp(std::log(to / from) / log_ratio, least, most);
}

/// Where half of the last fraction had passed.
const Passed& half_of(const std::vector<Passed>& passed) {
  return *std::find_if(passed.begin(), passed.end(),
                       [&](const Passed& p) { return p.fraction >= passed.back().fraction / 2; });
}

/// "about 3 GB (2 GB to 4 GB)", and at least what has been used.
std::string in_words(double value, double factor, double used, std::string (*words)(double)) {
  return "about " + words(std::max(value, used)) + " (" + words(std::max(value / factor, used)) + " to " +
         words(std::max(value, used) * factor) + ")";
}

}  // namespace

WholeCost extrapolated(const std::vector<Passed>& passed, bool may_grow) {
  if (passed.empty() || passed.back().fraction < least_fraction) return {};
  const Passed& first = passed.front();
  const Passed& last = passed.back();
  const Passed& half = half_of(passed);
  const double log_ratio = std::log(last.fraction / half.fraction), stretch = 1 / last.fraction;
  if (!may_grow || !(log_ratio > 0.1)) {
    const double factor = 1.1 * std::pow(stretch, may_grow ? 0.5 : 0.1);
    return {first.bytes + (last.bytes - first.bytes) * stretch, last.seconds * stretch, factor, 1.2 * factor};
  }
  const auto grown = [&](double before, double from, double to, double least_growth) {
    const double power = exponent(from - before, to - before, log_ratio, least_growth);
    return before + (to - before) * std::pow(stretch, power);
  };
  const double factor = 1.1 * std::pow(stretch, 0.25);
  return {grown(first.bytes, half.bytes, last.bytes, least_bytes),
          grown(first.seconds, half.seconds, last.seconds, least_seconds), factor, 1.2 * factor};
}

WholeCost extrapolated(const std::vector<Passed>& passed, const CostModel& model, double bytes_before) {
  WholeCost whole = model(1);
  if (!passed.empty() && passed.back().fraction >= least_fraction) {
    const Passed& last = passed.back();
    const Passed& half = half_of(passed);
    const WholeCost none = model(0), at_last = model(last.fraction), at_half = model(half.fraction);
    const double log_stretch = -std::log(last.fraction), log_ratio = std::log(last.fraction / half.fraction);
    // `from`, `to`: at half and at last.
    const auto go_on = [&](double& value, double& factor, double WholeCost::*member, double at_last_factor,
                           double from, double to, double least) {
      const double beside = std::log(to / (at_last.*member - none.*member));
      if (!(to >= least) || !std::isfinite(beside)) return;
      double seen = 0, slope = 0;
      if (from >= least && log_ratio > 0.1) {
        const double beside_at_half = std::log(from / (at_half.*member - none.*member));
        if (std::isfinite(beside_at_half)) {
          seen = beside - beside_at_half;
          slope = std::clamp(seen / log_ratio, -1.0, 1.0);
        }
      }
      // A slope may vanish at once or stay as it is: at most the middle, less if it is little more than
      // noise, and a range of both.
      constexpr double noise = 0.2;
      const double all = slope * log_stretch, share = 0.5 * std::abs(seen) / (std::abs(seen) + noise);
      value *= std::exp(beside + share * all);
      factor = 1.05 * std::exp((1 - share) * std::abs(all) + 0.05 * log_stretch) *
               std::max(factor / std::max(at_last_factor, 1.0), 1.0);
    };
    go_on(whole.bytes, whole.bytes_factor, &WholeCost::bytes, at_last.bytes_factor, half.bytes - bytes_before,
          last.bytes - bytes_before, least_bytes);
    go_on(whole.seconds, whole.seconds_factor, &WholeCost::seconds, at_last.seconds_factor, half.seconds,
          last.seconds, least_seconds);
  }
  whole.bytes += bytes_before;
  return whole;
}

BuildLimits::BuildLimits(std::size_t memory, double seconds, const char* items)
    : memory_(memory), seconds_(seconds), items_(items) {
  require_time_limit(seconds);
  if (memory == 0 && seconds == 0) return;
  bytes_before_ = static_cast<double>(platform::resident_memory());
  look_ = [this](double fraction) { return look(fraction); };
  meter_.emplace(look_);
}

void BuildLimits::count_items(bool counts) {
  counts_items_ = counts;
  passed_.clear();
}

bool BuildLimits::look(double fraction) {
  last_ = {fraction, stopwatch_.seconds(), static_cast<double>(platform::resident_memory())};
  constexpr double step = 1.05;
  if (fraction > 0 && (passed_.empty() || fraction >= step * passed_.back().fraction))
    passed_.push_back(last_);
  if (memory_ > 0 && last_.bytes > near_limit()) throw_at_memory();
  if (seconds_ > 0 && last_.seconds > seconds_)
    throw Error(Errc::time_limit, message(messages::readable_seconds(seconds_)));
  return true;
}

double BuildLimits::near_limit() const { return static_cast<double>(memory_ - margin(memory_)); }

void BuildLimits::throw_at_memory() {
  throw Error(Errc::out_of_memory, message(messages::readable_bytes(static_cast<double>(memory_))));
}

WholeCost BuildLimits::whole() const {
  std::vector<Passed> passed;
  if (counts_items_) {
    passed = passed_;
    if (last_.fraction > 0) passed.push_back(last_);
  }
  return model_ ? extrapolated(passed, model_, bytes_before_) : extrapolated(passed, !independent_);
}

std::string BuildLimits::message(const std::string& limit) const {
  std::string text = "stopped at the limit of " + limit;
  const double percent = 100 * last_.fraction;
  if (!counts_items_)
    text += " while cells were made";
  else if (percent >= 1)
    text += " with " + std::to_string(static_cast<int>(percent)) + " % of the " + items_ + " inserted";
  else
    text += std::string(" with less than 1 % of the ") + items_ + " inserted";
  const WholeCost cost = whole();
  if (cost.seconds > 0)
    text += "; the whole would have taken " +
            in_words(cost.bytes, cost.bytes_factor, last_.bytes, messages::readable_bytes) + " and " +
            in_words(cost.seconds, cost.seconds_factor, last_.seconds, messages::readable_seconds);
  if (cost.seconds > 0 && memory_ > 0) {
    // Not below the limit that was too low, and so rough that it has to differ from it in its words.
    const double least = last_.bytes > near_limit() ? 1.1 * static_cast<double>(memory_) : 0;
    text += ", for which a limit of memory of " +
            messages::readable_bytes(
                std::max(limit_for(std::max(cost.bytes, last_.bytes) * cost.bytes_factor), least)) +
            " would do";
  }
  return text;
}

}  // namespace delone::internal
