// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/record_buckets.hpp"

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"
#include "io/file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <utility>

namespace delone::tiles {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

}  // namespace

std::size_t RecordBuckets::count_for(std::uint64_t words, std::uint64_t memory) {
  const std::uint64_t words_in_bucket = std::max<std::uint64_t>(memory / sizeof(std::int64_t), 1024);
  return static_cast<std::size_t>(words / words_in_bucket) + 1;
}

RecordBuckets::RecordBuckets(std::string prefix, std::size_t buckets)
    : prefix_(std::move(prefix)),
      // All buffers together take some 4 MiB, and blocks of one page at least.
      flush_at_(std::max<std::size_t>((std::size_t{1} << 19) / std::max<std::size_t>(buckets, 1), 512)),
      buffers_(std::max<std::size_t>(buckets, 1)),
      written_(buffers_.size(), 0) {}

RecordBuckets::~RecordBuckets() {
  for (std::size_t b = 0; b < written_.size(); ++b)
    if (written_[b] > 0) platform::remove_file(path(b));
}

std::string RecordBuckets::path(std::size_t bucket) const {
  return fmt::format("{}-{:04}.tmp", prefix_, bucket);
}

void RecordBuckets::append(std::size_t bucket, std::span<const std::int64_t> words) {
  std::vector<std::int64_t>& buffer = buffers_[bucket];
  buffer.insert(buffer.end(), words.begin(), words.end());
  if (buffers_.size() > 1 && buffer.size() >= flush_at_) flush(bucket);
}

void RecordBuckets::flush(std::size_t bucket) {
  internal::cancellation_point();
  std::vector<std::int64_t>& buffer = buffers_[bucket];
  if (buffer.empty()) return;
  const std::string name = path(bucket);
  errno = 0;
  File file(platform::open_file(name, written_[bucket] == 0 ? "wb" : "ab"));
  if (!file) io::fail(Errc::cannot_write, "{}: {}", io::output_name(name), io::error_text(errno));
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  const std::uint64_t before = std::exchange(written_[bucket], written_[bucket] + buffer.size());
  if (std::fwrite(buffer.data(), sizeof(std::int64_t), buffer.size(), file.get()) != buffer.size() ||
      std::fclose(file.release()) != 0) {
    written_[bucket] = std::max<std::uint64_t>(before, 1);  // there is a file to remove
    io::fail(Errc::cannot_write, "{}: {}", io::output_name(name), io::error_text(errno));
  }
  buffer.clear();
}

std::vector<std::int64_t> RecordBuckets::take(std::size_t bucket) {
  if (written_[bucket] == 0) return std::exchange(buffers_[bucket], {});
  flush(bucket);
  buffers_[bucket] = {};
  const std::string name = path(bucket);
  std::vector<std::int64_t> words(static_cast<std::size_t>(written_[bucket]));
  errno = 0;
  File file(platform::open_file(name, "rb"));
  if (!file) io::fail(Errc::cannot_open, "{}: {}", io::input_name(name), io::error_text(errno));
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  if (std::fread(words.data(), sizeof(std::int64_t), words.size(), file.get()) != words.size())
    io::fail(Errc::bad_format, "{}: truncated: expected {} numbers", io::input_name(name), words.size());
  file.reset();
  platform::remove_file(name);
  written_[bucket] = 0;
  return words;
}

}  // namespace delone::tiles
