// SPDX-License-Identifier: BSD-3-Clause
// Words come back in the order in which they came, from memory or from files, which do not stay.
#include "tiles/record_buckets.hpp"

#include "../io/io_support.hpp"
#include "file_size_limit.hpp"

#include <filesystem>
#include <numeric>
#include <vector>

namespace delone_test {
namespace {

using namespace delone;
using tiles::RecordBuckets;
using Words64 = std::vector<std::int64_t>;

class RecordBucketsTest : public TemporaryDirectory {
 protected:
  /// Appends n words from `first` on, some at a time.
  static void fill(RecordBuckets& buckets, std::size_t bucket, std::int64_t first, std::size_t n) {
    Words64 words(97);
    for (std::size_t done = 0; done < n; done += words.size()) {
      words.resize(std::min(words.size(), n - done));
      std::iota(words.begin(), words.end(), first + static_cast<std::int64_t>(done));
      buckets.append(bucket, words);
    }
  }
  static Words64 numbers(std::int64_t first, std::size_t n) {
    Words64 words(n);
    std::iota(words.begin(), words.end(), first);
    return words;
  }
};

TEST_F(RecordBucketsTest, AsManyAsTheMemoryAsksFor) {
  EXPECT_EQ(RecordBuckets::count_for(0, 1 << 20), 1u);
  EXPECT_EQ(RecordBuckets::count_for(100, 0), 1u) << "1024 words fit anyway";
  EXPECT_EQ(RecordBuckets::count_for((1 << 17) - 1, 1 << 20), 1u);
  EXPECT_EQ(RecordBuckets::count_for(1 << 17, 1 << 20), 2u);
  EXPECT_EQ(RecordBuckets::count_for(10 << 17, 1 << 20), 11u);
}

TEST_F(RecordBucketsTest, OneStaysInMemory) {
  RecordBuckets buckets(path("b"), 0);
  ASSERT_EQ(buckets.size(), 1u);
  fill(buckets, 0, 5, 700000);
  EXPECT_EQ(num_files(), 0u);
  EXPECT_EQ(buckets.take(0), numbers(5, 700000));
  EXPECT_TRUE(buckets.take(0).empty());
}

TEST_F(RecordBucketsTest, SeveralAreFilesUntilTheyAreTaken) {
  {
    RecordBuckets buckets(path("b"), 1024);  // 512 words stay in memory
    fill(buckets, 3, 1000, 5000);
    fill(buckets, 7, -9, 100);
    fill(buckets, 8, 0, 600);
    EXPECT_EQ(num_files(), 2u);
    EXPECT_EQ(buckets.take(7), numbers(-9, 100));
    EXPECT_EQ(buckets.take(3), numbers(1000, 5000));
    EXPECT_EQ(num_files(), 1u);
    EXPECT_TRUE(buckets.take(3).empty());
    fill(buckets, 3, 1, 2000);  // it can be filled again
    EXPECT_EQ(buckets.take(3), numbers(1, 2000));
    EXPECT_TRUE(buckets.take(1023).empty());
  }
  EXPECT_EQ(num_files(), 0u) << "those that nobody takes do not stay";
}

TEST_F(RecordBucketsTest, DamageAndAFullDiskAreErrors) {
  {
    RecordBuckets buckets(path("b"), 1024);
    fill(buckets, 0, 0, 600);
    fill(buckets, 1, 0, 600);
    file("b-0000.tmp", "too short");
    expect_error(Errc::bad_format, {"b-0000.tmp: truncated: expected 600 numbers"}, [&] { buckets.take(0); });
    std::filesystem::remove(path("b-0001.tmp"));
    RecordBuckets nowhere(path("none/b"), 1024);
    expect_error(Errc::cannot_write, {"b-0002.tmp"}, [&] { fill(nowhere, 2, 0, 600); });
  }
  if (test::FileSizeLimit::exists) {
    RecordBuckets buckets(path("c"), 1024);
    fill(buckets, 0, 0, 600);
    {
      const test::FileSizeLimit full(8192);
      expect_error(Errc::cannot_write, {"c-0000.tmp"}, [&] { fill(buckets, 0, 600, 600); });
      expect_error(Errc::cannot_write, {"c-0001.tmp"}, [&] {
        for (int i = 0; i < 9; ++i) fill(buckets, 1, 0, 600);
      });
    }
  }
  EXPECT_EQ(num_files(), 0u);
}

}  // namespace
}  // namespace delone_test
