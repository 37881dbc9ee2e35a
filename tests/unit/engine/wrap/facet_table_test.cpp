// SPDX-License-Identifier: BSD-3-Clause
// The table of open facets against a hash table of the standard library.
#include "engine/wrap/facet_table.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace delone::engine {
namespace {

/// A table and what it should be.
class Compared {
 public:
  void reserve(std::size_t count) { table_.reserve(count); }
  /// Meets several keys at once, those that are repeated only once.
  void match(std::vector<std::uint64_t> keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    for (const std::uint64_t key : keys) table_.prefetch(key);
    std::vector<std::uint32_t> others(keys.size());
    table_.match(keys, next_value_, others.data());
    for (std::size_t i = 0; i < keys.size(); ++i, ++next_value_) {
      const auto found = expected_.find(keys[i]);
      ASSERT_EQ(others[i], found == expected_.end() ? FacetTable::none : found->second) << "key " << keys[i];
      if (found == expected_.end())
        expected_.emplace(keys[i], next_value_);
      else
        expected_.erase(found);
    }
    ASSERT_EQ(table_.size(), expected_.size());
  }
  /// Meets all keys that are there once more.
  void empty() {
    std::vector<std::uint64_t> keys;
    for (const auto& [key, value] : expected_) keys.push_back(key);
    for (const std::uint64_t key : keys) ASSERT_NO_FATAL_FAILURE(match({key}));
    EXPECT_EQ(table_.size(), 0u);
  }
  std::size_t size() const { return expected_.size(); }

 private:
  FacetTable table_;
  std::unordered_map<std::uint64_t, std::uint32_t> expected_;
  std::uint32_t next_value_ = 0;
};

/// Meets keys in random order, `count` times in all, and then once more those that are there.
void expect_the_same(Compared& compared, const std::vector<std::uint64_t>& keys, std::size_t count,
                     random::Generator& generator, std::size_t step = 100) {
  for (std::size_t i = 0, left = 0; i < test::scaled_count(count);) {
    std::vector<std::uint64_t> met(1 + generator.below(FacetTable::most_at_once));
    for (std::uint64_t& key : met) key = keys[generator.below(keys.size())];
    if (left < met.size()) compared.reserve(left = std::max(step, met.size()));
    left -= met.size();
    i += met.size();
    ASSERT_NO_FATAL_FAILURE(compared.match(met));
  }
}

std::vector<std::uint64_t> random_keys(std::size_t count, random::Generator& generator) {
  std::vector<std::uint64_t> keys(count);
  for (auto& key : keys) key = generator.bits() | 1;
  return keys;
}

TEST(FacetTable, PairsKeysWhetherFewOrManyAreOpen) {
  random::Generator generator(1);
  for (const std::size_t num_keys : {std::size_t{1}, std::size_t{8}, std::size_t{100}, std::size_t{4000},
                                     test::scaled_size(300000, 30000)}) {
    SCOPED_TRACE(testing::Message() << num_keys << " keys");
    Compared compared;
    ASSERT_NO_FATAL_FAILURE(expect_the_same(compared, random_keys(num_keys, generator), 1000000, generator));
    ASSERT_NO_FATAL_FAILURE(compared.empty());
  }
}

// A line has room for five keys. They come and go in all orders, in the line and apart.
TEST(FacetTable, KeepsApartWhatALineHasNoRoomFor) {
  random::Generator generator(2);
  for (const std::size_t num_keys : {4, 6, 7, 12, 40}) {
    SCOPED_TRACE(testing::Message() << num_keys << " keys in a line");
    std::vector<std::uint64_t> keys;
    for (std::uint64_t i = 0; i < num_keys; ++i)
      keys.push_back(generator.bits() << 50 | std::uint64_t{12345} << 20 | i);
    Compared compared;
    ASSERT_NO_FATAL_FAILURE(expect_the_same(compared, keys, 300000, generator));
    ASSERT_NO_FATAL_FAILURE(compared.empty());
    ASSERT_NO_FATAL_FAILURE(expect_the_same(compared, keys, 1000, generator));
  }
}

TEST(FacetTable, KeepsItsKeysWhenItGrows) {
  random::Generator generator(3);
  // In few lines of a small table, and in more of a larger one.
  std::vector<std::uint64_t> keys = random_keys(20000, generator);
  for (std::size_t i = 0; i < keys.size(); i += 2) keys[i] &= ~(std::uint64_t{0x3f8} << 20);
  for (const std::size_t step : {1, 64, 1000, 30000}) {
    SCOPED_TRACE(testing::Message() << "room for " << step << " keys at a time");
    Compared compared;
    for (int round = 0; round < 3; ++round) {
      ASSERT_NO_FATAL_FAILURE(expect_the_same(compared, keys, 100000, generator, step));
      EXPECT_GT(compared.size(), test::scaled_count(5000));
    }
    ASSERT_NO_FATAL_FAILURE(compared.empty());
  }
}

}  // namespace
}  // namespace delone::engine
