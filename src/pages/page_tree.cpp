// SPDX-License-Identifier: BSD-3-Clause
// Building the tree of boxes, and opening its nodes.
#include "pages/page_tree.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace delone::pages {

PageTree::PageTree(const PageTable& table)
    : table_(table),
      numbers_per_node_((2 * static_cast<std::size_t>(table.dimension) + (table.weighted ? 1 : 0)) *
                        boxes_per_node) {
  if (table.num_pages() > 0) build({0, table.num_pages(), 0, table.tiles.size()});
}

/// Between two tiles as long as there are several, then in the middle.
std::pair<PageTree::Range, PageTree::Range> PageTree::split(const Range& range) const {
  if (range.last_tile - range.first_tile > 1) {
    const std::size_t tile = (range.first_tile + range.last_tile) / 2, page = table_.tiles[tile].first_page;
    return {{range.first_page, page, range.first_tile, tile}, {page, range.last_page, tile, range.last_tile}};
  }
  const std::size_t page = (range.first_page + range.last_page) / 2;
  return {{range.first_page, page, 0, 0}, {page, range.last_page, 0, 0}};
}

/// The node of these pages, after the nodes of their parts have been built. Returns its number.
std::size_t PageTree::build(const Range& range) {
  std::vector<Range> parts{range};
  while (parts.size() < boxes_per_node) {
    const auto largest = std::max_element(parts.begin(), parts.end(),
                                          [](const Range& a, const Range& b) { return a.size() < b.size(); });
    if (largest->size() <= 1) break;
    const auto [left, right] = split(*largest);
    *largest = left;
    parts.insert(largest + 1, right);
  }
  parts.erase(std::remove_if(parts.begin(), parts.end(), [](const Range& part) { return part.size() == 0; }),
              parts.end());
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  boxes_.resize(boxes_.size() + numbers_per_node_, 0.0);
  const auto d = static_cast<std::size_t>(table_.dimension);
  for (std::size_t child = 0; child < parts.size(); ++child) {
    const Range& part = parts[child];
    const std::size_t below = part.size() > 1 ? build(part) : 0;
    nodes_[number].children[child] = {static_cast<std::uint32_t>(part.first_page),
                                      static_cast<std::uint32_t>(part.last_page),
                                      static_cast<std::uint32_t>(below)};
    nodes_[number].used |= 1u << child;
    double* const boxes = boxes_.data() + number * numbers_per_node_ + child;
    for (std::size_t axis = 0; axis <= d; ++axis) {
      if (axis == d && !table_.weighted) break;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      if (below == 0) {
        low = axis == d ? low : table_.low(part.first_page)[axis];
        high = axis == d ? table_.weights[part.first_page] : table_.high(part.first_page)[axis];
      } else {
        const double* const inner = boxes_.data() + below * numbers_per_node_ + 2 * axis * boxes_per_node;
        for (std::size_t i = 0; i < boxes_per_node; ++i) {
          if ((nodes_[below].used >> i & 1) == 0) continue;
          low = std::min(low, inner[i]);
          high = std::max(high, inner[(axis == d ? 0 : boxes_per_node) + i]);
        }
      }
      boxes[2 * axis * boxes_per_node] = axis == d ? high : low;
      if (axis < d) boxes[(2 * axis + 1) * boxes_per_node] = high;
    }
  }
  return number;
}

void PageSearch::open_node(std::size_t number, const QuestionForm& form, const Answer& best) {
  const auto d = static_cast<std::size_t>(tree_.table().dimension);
  double distances[boxes_per_node];
  const PageTree::Node& node = tree_.node(number);
  unsigned open =
      node.used & find_open_boxes(d, form, tree_.boxes(number), best.is_open, best.key, distances);
  const std::size_t first = stack_.size();
  for (; open != 0; open &= open - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(open));
    const PageTree::Child& child = node.children[i];
    if (child.first_page >= first_ && child.last_page <= last_) continue;
    stack_.push_back({distances[i], child.node != 0 ? child.node : child.first_page, child.node == 0});
  }
  std::sort(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end(),
            [](const Entry& a, const Entry& b) {
              return a.distance != b.distance ? a.distance > b.distance : a.number > b.number;
            });
}

}  // namespace delone::pages
