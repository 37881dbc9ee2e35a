// SPDX-License-Identifier: BSD-3-Clause
// Records of equal keys come together, however many keys have one hash.
#include "tiles/equal_records.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace delone::tiles {
namespace {

using Words = std::vector<std::int64_t>;

TEST(EqualRecords, ComeTogetherInTheirOrder) {
  random::Generator generator(1);
  for (const std::size_t key_size : {0u, 1u, 3u}) {
    constexpr std::size_t size = 4;
    Words words;
    std::map<Words, std::vector<std::size_t>> expected;
    for (std::size_t record = 0; record < 500; ++record) {
      Words one;
      for (std::size_t i = 0; i < size; ++i)
        one.push_back(i < key_size ? static_cast<std::int64_t>(generator.below(6)) - 3
                                   : static_cast<std::int64_t>(record));
      words.insert(words.end(), one.begin(), one.end());
      one.resize(key_size);
      expected[one].push_back(record);
    }
    std::size_t num_keys = 0;
    for_equal_records(words, size, key_size, [&](std::span<const std::size_t> equal) {
      const auto first = words.begin() + static_cast<std::ptrdiff_t>(equal[0] * size);
      const Words key(first, first + static_cast<std::ptrdiff_t>(key_size));
      EXPECT_TRUE(std::equal(equal.begin(), equal.end(), expected.at(key).begin(), expected.at(key).end()));
      ++num_keys;
    });
    EXPECT_EQ(num_keys, expected.size());
  }
  for_equal_records(Words{}, 3, 2, [](std::span<const std::size_t>) { FAIL() << "there is no record"; });
}

TEST(EqualRecords, BucketsAreInRangeAndFilledEvenly) {
  for (const std::size_t buckets : {1u, 2u, 7u, 1000u}) {
    std::vector<std::size_t> filled(buckets, 0);
    for (std::int64_t x = 0; x < 2000; ++x) {
      const Words key{x, -x, 5};
      const std::size_t bucket = bucket_of_key(key, buckets);
      ASSERT_LT(bucket, buckets);
      EXPECT_EQ(bucket_of_key(key, buckets), bucket);
      ++filled[bucket];
    }
    EXPECT_LT(*std::max_element(filled.begin(), filled.end()), 2 * 2000 / buckets + 12);
  }
  EXPECT_NE(hash_of_key(Words{1, 2}), hash_of_key(Words{2, 1})) << "the order counts";
  EXPECT_NE(hash_of_key(Words{0}), hash_of_key(Words{0, 0}));
}

}  // namespace
}  // namespace delone::tiles
