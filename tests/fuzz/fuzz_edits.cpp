// SPDX-License-Identifier: BSD-3-Clause
// Bytes → a history of edits: rows are inserted, removed, moved and weighed anew, one by one and in batches,
// some of which are refused, cancelled or taken back; ids are made without gaps, cells compacted, copies
// made. After every step, rows, ids and changes are what they should be, and the triangulation is that of all
// rows that are left; in the end it passes every exact check, and is that of the definition if it is small.
#include "brute_force.hpp"
#include "edit_history.hpp"
#include "history.hpp"

#include <delone/delone.hpp>

#include <span>
#include <type_traits>
#include <vector>

namespace {

using namespace delone;
using fuzz::Bytes;
using fuzz::require;
using test::EditHistory;
using test::EditLists;

template <class Product>
class Run {
 public:
  Run(int dimension, Bytes& bytes)
      : bytes_(bytes),
        d_(static_cast<std::size_t>(dimension)),
        style_(static_cast<Bytes::Style>(bytes.below(Bytes::num_styles))),
        history_{dimension, options(), bytes.below(4) != 0, bytes.below(3) != 0} {}

  void run() {
    const std::size_t most_steps = d_ <= 3 ? 40 : 20;
    for (std::size_t step = 0; !bytes_.empty() && step < most_steps; ++step) {
      rows_ = history_.rows();
      act();
      history_.compare_with_batch();
      require(history_.fault().empty(), history_.fault().c_str());
    }
    history_.check_all_levels();
    require(history_.fault().empty(), history_.fault().c_str());
    compare_with_definition();
  }

 private:
  Options options() {
    Options options;
    options.force_runtime_dimension = bytes_.below(3) == 0;
    options.progress = [this](double) { return !is_cancelled_; };
    return options;
  }

  std::size_t any_row() { return rows_[bytes_.below(rows_.size())]; }
  std::vector<double> any_point() {
    if (!rows_.empty() && bytes_.below(6) == 0) return history_.point(any_row());
    return bytes_.row(d_, style_);
  }
  double any_weight() {
    if (!EditHistory<Product>::has_weights) return 0;
    return !rows_.empty() && bytes_.below(3) == 0 ? history_.weight(any_row()) : bytes_.coordinate(style_);
  }

  void act() {
    const std::size_t most = d_ <= 3 ? 24 : d_ <= 5 ? 14 : 11;
    const std::size_t way = rows_.size() >= most ? 3 + bytes_.below(9) : bytes_.below(12);
    if (way < 3 || rows_.empty()) {
      const std::vector<double> point = any_point();
      history_.insert(point, any_weight());
    } else if (way < 5) {
      history_.remove(any_row());
    } else if (way < 7) {
      const std::size_t row = any_row();
      history_.move(row, any_point());
    } else if (way == 7) {
      const std::size_t row = any_row();
      history_.set_weight(row, any_weight());
    } else if (way == 8) {
      history_.edit(batch());
    } else if (way == 9) {
      history_.undo();
    } else if (way == 10) {
      fail();
    } else {
      keep_house();
    }
  }

  void keep_house() {
    switch (bytes_.below(4)) {
      case 0:
        history_.compact_ids();
        break;
      case 1:
        history_.compact();
        break;
      case 2:
        history_.clone();
        break;
      default: {
        const EditLists inserted = insertions();
        history_.insert_range(inserted.insert, inserted.insert_weights);
      }
    }
  }

  EditLists insertions() {
    EditLists lists;
    for (std::size_t n = bytes_.below(4); n > 0; --n) {
      const std::vector<double> point = any_point();
      lists.insert.insert(lists.insert.end(), point.begin(), point.end());
      lists.insert_weights.push_back(any_weight());
    }
    return lists;
  }
  EditLists batch() {
    EditLists lists = insertions();
    const std::size_t sparse = 3 + bytes_.below(5);
    for (const std::size_t row : rows_) {
      const std::size_t way = bytes_.below(sparse);
      if (way == 0) {
        lists.remove.push_back(row);
        continue;
      }
      if (way == 1) {
        const std::vector<double> to = any_point();
        lists.move.push_back(row);
        lists.to.insert(lists.to.end(), to.begin(), to.end());
      }
      if (EditHistory<Product>::has_weights && way < 3 && bytes_.below(2) == 0) {
        lists.reweight.push_back(row);
        lists.weights.push_back(any_weight());
      }
    }
    return lists;
  }

  /// What is refused or cancelled leaves nothing behind.
  void fail() {
    EditLists lists = batch();
    const std::size_t way = bytes_.below(4);
    if (way == 0) lists.remove.push_back(history_.num_rows());
    if (way == 1 && !lists.remove.empty()) lists.remove.push_back(lists.remove.front());
    if (way == 2 && !lists.to.empty()) lists.to.back() = std::nan("");
    is_cancelled_ = true;
    const bool is_refused = history_.try_in_vain(lists);
    is_cancelled_ = false;
    require(is_refused || way > 0, "a row that is not there was removed");
  }

  void compare_with_definition() const {
    const std::vector<std::size_t> left = history_.rows();
    if (d_ > 3 || left.size() > 9) return;
    std::vector<double> points, weights;
    for (const std::size_t row : left) {
      points.insert(points.end(), history_.point(row).begin(), history_.point(row).end());
      weights.push_back(history_.weight(row));
    }
    const test::BruteForce truth(
        points, static_cast<int>(d_), {},
        EditHistory<Product>::has_weights ? std::span<const double>(weights) : std::span<const double>(),
        std::is_same_v<Product, FurthestSite<>>);
    require(canonical_hash(truth.to_data()) == history_.product().hash(),
            "the history is not what the definition says");
  }

  Bytes& bytes_;
  std::size_t d_;
  Bytes::Style style_;
  bool is_cancelled_ = false;
  EditHistory<Product> history_;
  std::vector<std::size_t> rows_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const int dimension = 1 + static_cast<int>(bytes.below(7));
  switch (bytes.below(3)) {
    case 0:
      Run<Delaunay<>>(dimension, bytes).run();
      break;
    case 1:
      Run<Regular<>>(dimension, bytes).run();
      break;
    default:
      Run<FurthestSite<>>(dimension, bytes).run();
  }
  return 0;
}
