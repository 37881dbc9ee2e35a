// SPDX-License-Identifier: BSD-3-Clause
// A tree of bounding boxes: which items may be near a point.
#pragma once

#include <cstddef>
#include <vector>

namespace delone::queries {

class BoxTree {
 public:
  /// Of n boxes of dimension d ≥ 1: `boxes` has the d lower bounds of a box, then the d upper ones.
  /// O(n·log n).
  BoxTree(std::vector<double> boxes, std::size_t d);

  /// Calls visit(item) for all items whose boxes are within `radius` of q along each axis, and maybe for some
  /// that are farther by a rounding error; in no particular order.
  template <class Visit>
  void visit(const double* q, double radius, Visit visit) const {
    if (!nodes_.empty()) descend(0, q, radius, visit);
  }

 private:
  static constexpr std::size_t largest_leaf = 4;
  struct Node {
    std::size_t first, last;  // of order_
    std::size_t right;        // the left child is the next node; 0 for a leaf
  };

  std::size_t build(std::size_t first, std::size_t last);
  std::size_t longest_axis(std::size_t node) const;

  /// A rounded difference is off by a factor 1 ± u.
  bool is_near(const double* box, const double* q, double radius) const {
    for (std::size_t j = 0; j < d_; ++j) {
      const double below = box[j] - q[j], above = q[j] - box[d_ + j];
      if ((below > above ? below : above) * (1 - 0x1p-50) > radius) return false;
    }
    return true;
  }
  template <class Visit>
  void descend(std::size_t node, const double* q, double radius, Visit& visit) const {
    if (!is_near(bounds_.data() + node * 2 * d_, q, radius)) return;
    const Node& at = nodes_[node];
    if (at.right != 0) {
      descend(node + 1, q, radius, visit);
      descend(at.right, q, radius, visit);
      return;
    }
    for (std::size_t i = at.first; i < at.last; ++i)
      if (is_near(boxes_.data() + order_[i] * 2 * d_, q, radius)) visit(order_[i]);
  }

  std::size_t d_;
  std::vector<double> boxes_, bounds_;  // of items; of nodes
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace delone::queries
