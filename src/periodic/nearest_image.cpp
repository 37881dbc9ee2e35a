// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/nearest_image.hpp"

#include "base/progress_meter.hpp"

#include <algorithm>

namespace delone::periodic {

void NearestImage::find(const double* q, const std::int32_t* wraps, VertexId start) {
  x_.assign(q, q + parts_.dimension);
  std::fill(shift_.begin(), shift_.end(), 0);
  offset.resize(parts_.rank);
  other_.resize(parts_.rank);
  go_to(start);
  const bool has_ties = go_to_nearest();
  take(wraps);
  if (has_ties) choose_first(wraps);
}

/// To the point of a vertex, in the box.
void NearestImage::go_to(VertexId v) {
  at_ = v;
  if (parts_.ghosts.is_own(v)) return;
  const Offset k = parts_.classes.offset_of(v);
  parts_.subtract(k, x_);
  for (std::size_t i = 0; i < parts_.rank; ++i) shift_[i] += k[i];
  at_ = parts_.classes.own_vertex(v);
}

/// Returns whether other points are as near.
bool NearestImage::go_to_nearest() {
  bool has_ties = false;
  for (bool moved = true; moved;) {
    internal::cancellation_point();
    moved = has_ties = false;
    const queries::Power least = power_of(at_);
    for (const VertexId v : neighbors(at_)) {
      const queries::Power there = power_of(v);
      if (queries::certainly_less(least, there, parts_.dimension)) continue;
      const Sign sign =
          queries::certainly_less(there, least, parts_.dimension) ? Sign::negative : compare(v, at_);
      has_ties = has_ties || sign == Sign::zero;
      if (sign != Sign::negative) continue;
      go_to(v);
      moved = true;
      break;
    }
  }
  return has_ties;
}

void NearestImage::take(const std::int32_t* wraps) {
  row = parts_.row_of(at_);
  parts_.given_offset(at_, shift_, wraps, offset.data());
  squared_distance = queries::power(x_.data(), parts_.point(at_), parts_.dimension, 0.0).value;
}

/// Chooses among all points as near as this one. Edges between them connect them.
void NearestImage::choose_first(const std::int32_t* wraps) {
  const std::vector<double> q = [&] {
    std::vector<double> x = x_;
    Offset back(parts_.rank);
    for (std::size_t i = 0; i < parts_.rank; ++i) back[i] = -shift_[i];
    parts_.subtract(back, x);
    return x;
  }();
  std::vector<Site> found{{at_, shift_}};
  std::set<Site> seen{found.front()};
  for (std::size_t next = 0; next < found.size(); ++next) {
    internal::cancellation_point();
    at_ = found[next].first;
    shift_ = found[next].second;
    x_ = q;
    parts_.subtract(shift_, x_);
    parts_.given_offset(at_, shift_, wraps, other_.data());
    const std::uint32_t other_row = parts_.row_of(at_);
    if (other_row < row || (other_row == row && other_ < offset)) take(wraps);
    for (const VertexId v : neighbors(at_)) {
      if (queries::certainly_less(power_of(at_), power_of(v), parts_.dimension) ||
          compare(v, at_) != Sign::zero)
        continue;
      Site site{parts_.classes.own_vertex(v), shift_};
      const auto of_image = parts_.ghosts.offset_of(v);
      for (std::size_t i = 0; i < parts_.rank; ++i) site.second[i] += of_image[i];
      if (seen.insert(site).second) found.push_back(std::move(site));
    }
  }
}

}  // namespace delone::periodic
