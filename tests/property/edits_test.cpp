// SPDX-License-Identifier: BSD-3-Clause
// Histories of edits: whatever rows are inserted, removed, moved and weighed anew, the triangulation is that
// of the rows that are left, its ids stay, changes() tells what has changed and undo() takes it back.
#include "edit_history.hpp"
#include "edit_points.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace delone {
namespace {

using test::EditHistory;
using test::EditLists;
using test::EditWorld;
using test::Random;

/// A random history that grows to so many rows and shrinks to none, again and again.
template <class Product>
class RandomEdits {
 public:
  RandomEdits(EditWorld world, int dimension, std::size_t most, std::uint64_t seed)
      : world_(world),
        most_(most),
        random_(seed),
        history_(dimension, options(seed), random_.integer(0, 3) != 0, random_.integer(0, 2) != 0) {}

  static Options options(std::uint64_t seed) {
    Options options;
    options.force_runtime_dimension = seed % 2 == 1;
    return options;
  }

  /// `num_steps` edits, compared with batches every so many.
  void run(std::size_t num_steps, std::size_t steps_of_batch) {
    for (std::size_t step = 0; step < num_steps; ++step) {
      const std::string what = edit();
      if (step % steps_of_batch == 0 || step + 1 == num_steps) history_.compare_with_batch();
      if (step % 97 == 96) history_.check_all_levels();
      if (random_.integer(0, 5) == 0) history_.undo();
      ASSERT_EQ(history_.fault(), "") << "step " << step << ": " << what;
    }
  }

 private:
  std::size_t any_row() { return rows_[random_.bits() % rows_.size()]; }
  std::vector<double> any_point() {
    const int way = random_.integer(0, 7);
    if (rows_.empty() || way > 1) return test::new_point(world_, history_.dimension(), random_);
    return history_.point(any_row());  // a duplicate
  }
  double any_weight() {
    return rows_.empty() || random_.integer(0, 2) != 0 ? test::new_weight(world_, random_)
                                                       : history_.weight(any_row());
  }
  std::vector<double> destination(std::size_t row) {
    return random_.integer(0, 1) == 0 ? any_point()
                                      : test::nudged_point(world_, history_.point(row), random_);
  }

  std::string edit() {
    rows_ = history_.rows();
    if (rows_.size() >= most_) grows_ = false;
    if (rows_.empty()) grows_ = true;
    const int way = random_.integer(0, 99);
    if (way < 4) return housekeeping();
    if (way < 12) return batch();
    if (rows_.empty() || way < (grows_ ? 55 : 25)) {
      const std::vector<double> point = any_point();
      history_.insert(point, any_weight());
      return "insertion";
    }
    const std::size_t row = any_row();
    if (way < 68) {
      history_.remove(row);
      return "removal of row " + std::to_string(row);
    }
    if (EditHistory<Product>::has_weights && way < 80) {
      history_.set_weight(row, any_weight());
      return "another weight of row " + std::to_string(row);
    }
    history_.move(row, destination(row));
    return "move of row " + std::to_string(row);
  }

  std::string housekeeping() {
    switch (random_.integer(0, 3)) {
      case 0:
        history_.compact_ids();
        return "other ids";
      case 1:
        history_.compact();
        return "compaction";
      case 2:
        history_.clone();
        return "copy";
      default: {
        const EditLists inserted = insertions(random_.integer(0, 4));
        history_.insert_range(inserted.insert, inserted.insert_weights);
        return "range";
      }
    }
  }

  EditLists insertions(int count) {
    EditLists lists;
    for (int i = 0; i < count; ++i) {
      const std::vector<double> point = any_point();
      lists.insert.insert(lists.insert.end(), point.begin(), point.end());
      lists.insert_weights.push_back(any_weight());
    }
    return lists;
  }

  /// Few changes, or so many that cells are built anew.
  std::string batch() {
    EditLists lists = insertions(random_.integer(0, 4));
    const int sparse = random_.integer(0, 1) == 0 ? 3 : 12;
    std::vector<std::size_t> order = rows_;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random_.bits() % i]);
    for (const std::size_t row : order) {
      const int way = random_.integer(0, sparse);
      if (way == 0) lists.remove.push_back(row);
      if (way == 1) {
        const std::vector<double> to = destination(row);
        lists.move.push_back(row);
        lists.to.insert(lists.to.end(), to.begin(), to.end());
      }
      if (EditHistory<Product>::has_weights && (way == 1 || way == 2) && random_.integer(0, 1) == 0) {
        lists.reweight.push_back(row);
        lists.weights.push_back(any_weight());
      }
    }
    history_.edit(lists);
    return "batch of " + std::to_string(lists.remove.size()) + " removals, " +
           std::to_string(lists.move.size()) + " moves, " + std::to_string(lists.reweight.size()) +
           " weights and " + std::to_string(lists.insert_weights.size()) + " insertions";
  }

  EditWorld world_;
  std::size_t most_;
  Random random_;
  EditHistory<Product> history_;
  std::vector<std::size_t> rows_;
  bool grows_ = true;
};

/// By dimension and world.
template <class Product>
void expect_histories(int dimension, EditWorld world) {
  // Steps for all worlds together in a usual run; in a large one as many as 10^5, from 5D on 10^4.
  static constexpr std::size_t usual[] = {3600, 3600, 2200, 1000, 360, 180};
  static constexpr std::size_t most[] = {30, 40, 30, 20, 14, 13};
  const auto i = static_cast<std::size_t>(dimension - 1);
  const std::size_t all = test::scale() == test::Scale::large ? (dimension <= 4 ? 100'000 : 10'000)
                                                              : test::scaled_count(usual[i]);
  const std::size_t rounds = test::scale() == test::Scale::large ? 16 : 2;
  // Exact determinants over the whole range of exponents have thousands of bits.
  const std::size_t share = world == EditWorld::exponents && dimension > 2 ? 4 : 1;
  const std::size_t steps = std::max<std::size_t>(1, all / test::edit_worlds.size() / rounds / share);
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::uint64_t seed = 100 * static_cast<std::uint64_t>(dimension) + round;
    SCOPED_TRACE(testing::Message() << test::name(world) << ", " << dimension << "D, seed " << seed);
    RandomEdits<Product> edits(world, dimension, most[i], seed);
    ASSERT_NO_FATAL_FAILURE(edits.run(steps, dimension <= 3 ? 1 : 3));
  }
}

class EditsOf : public testing::TestWithParam<std::tuple<int, EditWorld>> {};
INSTANTIATE_TEST_SUITE_P(Worlds, EditsOf,
                         testing::Combine(testing::Range(1, 7), testing::ValuesIn(test::edit_worlds)),
                         [](const auto& test) {
                           return std::to_string(std::get<0>(test.param)) + "D_" +
                                  test::name(std::get<1>(test.param));
                         });

TEST_P(EditsOf, Delaunay) { std::apply(expect_histories<Delaunay<>>, GetParam()); }
TEST_P(EditsOf, Regular) { std::apply(expect_histories<Regular<>>, GetParam()); }
TEST_P(EditsOf, FurthestSite) { std::apply(expect_histories<FurthestSite<>>, GetParam()); }

}  // namespace
}  // namespace delone
