// SPDX-License-Identifier: BSD-3-Clause
#include "queries/box_tree.hpp"

#include "base/progress_meter.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delone::queries {

BoxTree::BoxTree(std::vector<double> boxes, std::size_t d) : d_(d), boxes_(std::move(boxes)) {
  order_.resize(boxes_.size() / (2 * d_));
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) build(0, order_.size());
}

/// Makes the node of these items and those below it.
std::size_t BoxTree::build(std::size_t first, std::size_t last) {
  internal::cancellation_point();
  const std::size_t node = nodes_.size();
  nodes_.push_back({first, last, 0});
  const double* const begin = boxes_.data() + order_[first] * 2 * d_;
  bounds_.insert(bounds_.end(), begin, begin + 2 * d_);
  double* const bounds = bounds_.data() + node * 2 * d_;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double* const box = boxes_.data() + order_[i] * 2 * d_;
    for (std::size_t j = 0; j < d_; ++j) {
      bounds[j] = std::min(bounds[j], box[j]);
      bounds[d_ + j] = std::max(bounds[d_ + j], box[d_ + j]);
    }
  }
  if (last - first <= largest_leaf) return node;
  const std::size_t axis = longest_axis(node), middle = first + (last - first) / 2;
  // Halves are taken before the sum, which then does not overflow.
  const auto center = [&](std::size_t item) {
    const double* const box = boxes_.data() + item * 2 * d_;
    return box[axis] / 2 + box[d_ + axis] / 2;
  };
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last),
                   [&](std::size_t a, std::size_t b) { return center(a) < center(b); });
  build(first, middle);
  const std::size_t right = build(middle, last);
  nodes_[node].right = right;
  return node;
}

std::size_t BoxTree::longest_axis(std::size_t node) const {
  const double* const bounds = bounds_.data() + node * 2 * d_;
  std::size_t longest = 0;
  const auto half_side = [&](std::size_t j) { return bounds[d_ + j] / 2 - bounds[j] / 2; };
  for (std::size_t j = 1; j < d_; ++j)
    if (half_side(j) > half_side(longest)) longest = j;
  return longest;
}

}  // namespace delone::queries
