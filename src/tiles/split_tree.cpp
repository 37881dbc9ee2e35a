// SPDX-License-Identifier: BSD-3-Clause
// The cut into tiles. See split_tree.hpp.
#include "tiles/split_tree.hpp"

#include "base/progress_meter.hpp"

#include <algorithm>
#include <limits>

namespace delone::tiles {

namespace {

/// Splits the positions of the sample in place.
class Splitter {
 public:
  Splitter(std::span<const double> sample, int dimension) : dimension_(dimension) {
    tree_.dimension = dimension;
    for (std::size_t i = 0; i < sample.size(); i += static_cast<std::size_t>(dimension))
      positions_.push_back(sample.data() + i);
  }

  SplitTree split(std::size_t num_tiles) {
    tree_.num_tiles = 0;
    split(0, positions_.size(), num_tiles);
    return std::move(tree_);
  }

 private:
  /// The node, or tile, of the positions first … last − 1.
  std::int32_t split(std::size_t first, std::size_t last, std::size_t num_tiles) {
    internal::cancellation_point();
    if (num_tiles < 2 || last - first < 2) return -1 - tree_.num_tiles++;
    const int axis = longest_axis_of(first, last);
    const auto is_before = [&](const double* a, const double* b) {
      return pages::compare_along(a, b, axis, dimension_) < 0;
    };
    const auto begin = positions_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = positions_.begin() + static_cast<std::ptrdiff_t>(last);
    std::sort(begin, end, is_before);
    if (!is_before(*begin, end[-1])) return -1 - tree_.num_tiles++;  // one position

    std::size_t tiles_below = num_tiles / 2;
    // Equal positions stay together: of the two ends of those at the quantile, the nearer one.
    const auto quantile = begin + static_cast<std::ptrdiff_t>((last - first) * tiles_below / num_tiles);
    const auto [lower, upper] = std::equal_range(begin, end, *quantile, is_before);
    const bool takes_lower = lower != begin && (upper == end || quantile - lower <= upper - quantile);
    const auto cut = takes_lower ? lower : upper;
    const auto size_below = static_cast<std::size_t>(cut - begin);
    if (cut != quantile)
      tiles_below = std::clamp<std::size_t>((size_below * num_tiles + (last - first) / 2) / (last - first), 1,
                                            num_tiles - 1);

    const std::size_t node = tree_.axes.size();
    tree_.axes.push_back(axis);
    tree_.splitters.insert(tree_.splitters.end(), *cut, *cut + dimension_);
    tree_.below.push_back(0);
    tree_.beyond.push_back(0);
    const std::int32_t below = split(first, first + size_below, tiles_below);
    tree_.below[node] = below;
    const std::int32_t beyond = split(first + size_below, last, num_tiles - tiles_below);
    tree_.beyond[node] = beyond;
    return static_cast<std::int32_t>(node);
  }

  int longest_axis_of(std::size_t first, std::size_t last) const {
    std::vector<double> low(positions_[first], positions_[first] + dimension_), high = low;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t axis = 0; axis < low.size(); ++axis) {
        low[axis] = std::min(low[axis], positions_[i][axis]);
        high[axis] = std::max(high[axis], positions_[i][axis]);
      }
    return pages::longest_axis(low.data(), high.data(), dimension_);
  }

  int dimension_;
  std::vector<const double*> positions_;
  SplitTree tree_;
};

}  // namespace

std::vector<Tile> SplitTree::boxes() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<Tile> tiles(static_cast<std::size_t>(num_tiles));
  Tile whole;
  whole.low.assign(d, -infinity);
  whole.high.assign(d, infinity);
  if (axes.empty()) {
    tiles[0] = whole;
    return tiles;
  }
  // Nodes come after those that they are below or beyond. What is below has coordinates up to that of the
  // splitter, what is beyond from it on; the splitter is in the box of its node.
  std::vector<Tile> nodes(axes.size());
  nodes[0] = whole;
  for (std::size_t n = 0; n < axes.size(); ++n) {
    const auto axis = static_cast<std::size_t>(axes[n]);
    const double cut = splitters[n * d + axis];
    const auto box_of = [&](std::int32_t child) -> Tile& {
      return child >= 0 ? nodes[static_cast<std::size_t>(child)]
                        : tiles[static_cast<std::size_t>(-1 - child)];
    };
    Tile& lower = box_of(below[n]) = nodes[n];
    lower.high[axis] = cut;
    Tile& upper = box_of(beyond[n]) = nodes[n];
    upper.low[axis] = cut;
  }
  return tiles;
}

SplitTree make_split_tree(std::span<const double> sample, int dimension, std::size_t num_tiles) {
  return Splitter(sample, dimension).split(std::max<std::size_t>(num_tiles, 1));
}

}  // namespace delone::tiles
