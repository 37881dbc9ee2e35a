// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets of indices.
#pragma once

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace delone::internal {

/// A forest with path halving. The root of a set is its smallest member.
class UnionFind {
 public:
  UnionFind() = default;
  /// n sets of one member each.
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  Index root(Index x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void unite(Index a, Index b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace delone::internal
