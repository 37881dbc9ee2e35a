// SPDX-License-Identifier: BSD-3-Clause
// Which of some points is farthest in a direction, while points come and go.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::hull {

/// A tree over points, halved again and again along the longest edge of their box, with a slab around the
/// points of each node. Points are named by their numbers; some are *in*, none at first. What it answers is a
/// function of the points and of which are in.
class SupportTree {
 public:
  /// REQUIRES points of R^dimension that outlive the tree, and at least one of them among the members: the
  /// m points that may come in, each once. O(m·log m).
  SupportTree(std::span<const double* const> points, int dimension, std::vector<Index> members);

  /// O(log n).
  void insert(Index p);
  void erase(Index p);

  /// How many are in.
  std::size_t size() const { return nodes_[0].num_in; }

  struct Support {
    double least;    ///< of the products n·(q − w) of the points w that are in, as computed
    double certain;  ///< what the least product is for certain
    Index point;     ///< with that product
  };
  /// `guess` are points that are in, among which the answer may be: the better, the fewer nodes are opened.
  /// REQUIRES at least one point that is in, and finite numbers; if products overflow, `certain` is not
  /// positive.
  Support support(const double* q, std::span<const double> n, std::span<const Index> guess) const;

 private:
  static constexpr Index most_listed = 8;  // of a leaf at most as many
  struct Node {
    Index begin = 0, end = 0;               // in order_
    Index left = 0, right = 0, parent = 0;  // 0: none
    Index num_in = 0;
    Index listed[most_listed] = {};  // those that are in, if they are no more
  };
  void divide(Index node);
  void list(Node& node) const;
  std::size_t measure(Index node);
  double bound(Index node, const double* q, std::span<const double> n) const;
  std::size_t slab_size() const { return 2 * d_ + 2; }

  std::vector<const double*> points_;
  std::size_t d_;
  std::vector<Index> order_, leaf_of_;
  std::vector<char> is_in_;
  std::vector<Node> nodes_;
  std::vector<double>
      slabs_;  // by node: center, direction across, greatest extent in it, and orthogonal to it
};

}  // namespace delone::hull
