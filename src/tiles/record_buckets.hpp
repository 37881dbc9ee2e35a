// SPDX-License-Identifier: BSD-3-Clause
// More records than memory holds, dealt into buckets that fit: each bucket is a file, unless there is only
// one, which stays in memory. Records are runs of 64-bit integers; what they mean is up to the caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delone::tiles {

class RecordBuckets {
 public:
  /// How many buckets of at most about `memory` bytes hold so many words in all.
  static std::size_t count_for(std::uint64_t words, std::uint64_t memory);

  /// The files are `prefix` and a number; they are removed by take() and by the destructor.
  RecordBuckets(std::string prefix, std::size_t buckets);
  RecordBuckets(const RecordBuckets&) = delete;
  RecordBuckets& operator=(const RecordBuckets&) = delete;
  ~RecordBuckets();

  std::size_t size() const { return buffers_.size(); }
  /// Throws cannot_write with the system's reason.
  void append(std::size_t bucket, std::span<const std::int64_t> words);
  /// All words of a bucket in the order in which they came. The bucket is empty from then on. Throws
  /// cannot_open.
  std::vector<std::int64_t> take(std::size_t bucket);

 private:
  std::string path(std::size_t bucket) const;
  void flush(std::size_t bucket);

  std::string prefix_;
  std::size_t flush_at_;  ///< words
  std::vector<std::vector<std::int64_t>> buffers_;
  std::vector<std::uint64_t> written_;  ///< words in the file
};

}  // namespace delone::tiles
