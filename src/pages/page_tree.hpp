// SPDX-License-Identifier: BSD-3-Clause
// A tree of boxes over all pages, and the search for the point that answers a question.
#pragma once

#include "pages/pages.hpp"
#include "pages/question.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace delone::pages {

/// The boxes of pages in a tree of eight children per node: it divides tiles first, and then the pages of
/// each.
class PageTree {
 public:
  explicit PageTree(const PageTable& table);

  struct Child {
    std::uint32_t first_page = 0, last_page = 0;
    std::uint32_t node = 0;  ///< 0: a single page
  };
  struct Node {
    std::array<Child, boxes_per_node> children;
    unsigned used = 0;  ///< the bits of the children that there are
  };
  const PageTable& table() const { return table_; }
  bool is_empty() const { return nodes_.empty(); }
  const Node& node(std::size_t i) const { return nodes_[i]; }
  /// As find_open_boxes() reads them.
  const double* boxes(std::size_t i) const { return boxes_.data() + i * numbers_per_node_; }

 private:
  struct Range {
    std::size_t first_page, last_page, first_tile, last_tile;
    std::size_t size() const { return last_page - first_page; }
  };
  std::pair<Range, Range> split(const Range& range) const;
  std::size_t build(const Range& range);

  const PageTable& table_;
  const std::size_t numbers_per_node_;
  std::vector<Node> nodes_;
  std::vector<double> boxes_;
};

/// Which points of other tiles a tile has inserted: those are never answers.
class KnownPoints {
 public:
  explicit KnownPoints(std::size_t num_pages) : num_pages_(num_pages) {}
  bool contains(std::size_t page, std::size_t slot) const {
    if (place_of_page_.empty()) return false;
    const std::uint32_t place = place_of_page_[page];
    return place != none && bits_[place][slot];
  }
  void add(std::size_t page, std::size_t slot, std::size_t page_size) {
    if (place_of_page_.empty()) place_of_page_.assign(num_pages_, none);
    std::uint32_t& place = place_of_page_[page];
    if (place == none) {
      place = static_cast<std::uint32_t>(bits_.size());
      bits_.emplace_back(page_size, false);
    }
    bits_[place][slot] = true;
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::size_t num_pages_;
  std::vector<std::uint32_t> place_of_page_;  // none before the first point
  std::vector<std::vector<bool>> bits_;
};

/// The place of a point in the pages.
struct PointPlace {
  std::uint32_t page = 0, slot = 0;
  friend auto operator<=>(const PointPlace&, const PointPlace&) = default;
};

/// What a search has found.
struct Answer {
  bool is_open = false;     ///< a point is in conflict: `place`
  bool is_waiting = false;  ///< a page that may hold a better one is not here yet
  PointPlace place;
  double key = 0;
};

/// Searches the pages of other tiles. One per thread.
class PageSearch {
 public:
  /// The pages first … last − 1 are the tile's own.
  PageSearch(const PageTree& tree, PageSource& source, const KnownPoints& known, std::size_t first,
             std::size_t last)
      : tree_(tree),
        source_(source),
        known_(known),
        first_(first),
        last_(last),
        point_(tree.table().row_size()) {}

  /// The point in conflict with the smallest key. `is_in_conflict(x)` decides where rounded numbers do not.
  template <int D, class Exact>
  Answer find(const Question<D>& question, const Exact& is_in_conflict) {
    return find_better(question, is_in_conflict, known_, {});
  }
  /// The same where other points are known, and an answer that may be the better one.
  template <int D, class Exact>
  Answer find_better(const Question<D>& question, const Exact& is_in_conflict, const KnownPoints& known,
                     Answer best) {
    const QuestionForm form = question.form();
    int num_missing = 0;
    stack_.clear();
    if (!tree_.is_empty()) stack_.push_back({0, 0, false});
    while (!stack_.empty()) {
      const Entry entry = stack_.back();
      stack_.pop_back();
      if (!entry.is_page) {
        open_node(entry.number, form, best);
        continue;
      }
      // What has been found since may rule the page out; its points tell as fast as its box.
      const auto page = source_.find(entry.number);
      ++num_visited;
      if (page)
        search_page(*page, entry.number, question, form, is_in_conflict, known, best);
      else if (best.is_waiting = true; ++num_missing == most_missing)
        break;
    }
    return best;
  }

  std::uint64_t num_visited = 0;  ///< pages
  std::uint64_t num_exact = 0;    ///< points that rounded numbers did not decide

 private:
  /// So many pages are wanted at most for one question at a time: those nearest to it, which are likely to
  /// make it smaller.
  static constexpr int most_missing = 4;

  /// Puts the children of a node that may hold a better answer on the stack, the nearest last, to be taken
  /// first.
  void open_node(std::size_t number, const QuestionForm& form, const Answer& best);

  template <int D, class Exact>
  void search_page(const Page& page, std::size_t number, const Question<D>& question,
                   const QuestionForm& form, const Exact& is_in_conflict, const KnownPoints& known,
                   Answer& best) {
    const auto d = static_cast<std::size_t>(tree_.table().dimension);
    for (std::size_t first = 0; first < page.size(); first += most_points_at_once) {
      const std::size_t count = std::min(page.size() - first, most_points_at_once);
      for (std::uint64_t bits =
               find_points_not_outside(d, form, page.coordinates.data() + first, page.stride(), count);
           bits != 0; bits &= bits - 1) {
        test_point(page, number, first + static_cast<std::size_t>(std::countr_zero(bits)), question,
                   is_in_conflict, known, best);
      }
    }
  }
  template <int D, class Exact>
  void test_point(const Page& page, std::size_t number, std::size_t slot, const Question<D>& question,
                  const Exact& is_in_conflict, const KnownPoints& known, Answer& best) {
    if (known.contains(number, slot)) return;
    page.copy_point(slot, point_.data());
    const double* const x = point_.data();
    const double key = question.key(x);
    // Of equal keys the point at the first place, so that the answer does not depend on the path.
    const PointPlace place{static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(slot)};
    if (best.is_open && !(key < best.key || (key == best.key && place < best.place))) return;
    if (question.side(x) == QuestionSide::unsure) {
      ++num_exact;
      if (!is_in_conflict(x)) return;
    }
    best.is_open = true;
    best.key = key;
    best.place = place;
  }

  struct Entry {
    double distance;
    std::uint32_t number;  ///< of a node or a page
    bool is_page;
  };

  const PageTree& tree_;
  PageSource& source_;
  const KnownPoints& known_;
  const std::size_t first_, last_;
  std::vector<Entry> stack_;
  std::vector<double> point_;
};

}  // namespace delone::pages
