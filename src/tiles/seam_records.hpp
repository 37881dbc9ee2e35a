// SPDX-License-Identifier: BSD-3-Clause
// Records of facets at seams: their files, and the pairs of equal facets.
#pragma once

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"
#include "io/file.hpp"
#include "tiles/equal_records.hpp"
#include "tiles/part_file.hpp"
#include "tiles/seams.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace delone::tiles {

// A file of records begins with the length k of a key, the number r of offsets, and the number of records. A
// record: the key of the facet, which are its vertices as rows of the input, increasing; then tile, cell,
// index of the opposite vertex, number of the seam.
//
// In a periodic set each vertex of the key is a row and r offsets, all vertices translated so that the first
// one has offset 0. The first is that of the smallest row, and of these that of the smallest offset, in
// lexicographic order, which translations keep. So translates of a facet have the same key, and others do
// not. The record ends with the r offsets of the first vertex in the cell.
inline constexpr std::size_t seam_header_words = 3, seam_other_words = 4;

struct SeamHeader {
  std::int64_t k = 0, rank = 0, count = 0;
};

/// Reads the records of one tile in pieces.
class SeamReader {
 public:
  SeamReader(const std::string& work, std::size_t tile)
      : path_(path_in(work, seam_records_name(tile))), file_(nullptr, &std::fclose) {
    errno = 0;
    file_.reset(platform::open_file(path_, "rb"));
    if (!file_) io::fail(Errc::cannot_open, "{}: {}", io::input_name(path_), io::error_text(errno));
    std::array<std::int64_t, seam_header_words> header{};
    read(header.data(), header.size());
    header_ = {header[0], header[1], header[2]};
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path_, error);
    const auto is_count = [](std::int64_t number) { return number >= 0 && number < std::int64_t{1} << 31; };
    const bool fits = is_count(header_.k) && is_count(header_.rank) && is_count(header_.count) &&
                      size == sizeof(std::int64_t) *
                                  (seam_header_words + words() * static_cast<std::uint64_t>(header_.count));
    if (error || !fits)
      io::fail(Errc::bad_format, "{}: damaged or truncated: {} bytes for {} facets with keys of {} numbers",
               io::input_name(path_), size, header_.count, header_.k);
  }

  const SeamHeader& header() const { return header_; }
  std::size_t words() const { return static_cast<std::size_t>(header_.k + header_.rank) + seam_other_words; }

  /// Calls each(record) for all records.
  template <class Each>
  void for_each(const Each& each) {
    constexpr std::size_t records_at_once = 4096;
    std::vector<std::int64_t> piece;
    for (auto left = static_cast<std::size_t>(header_.count); left > 0;) {
      internal::cancellation_point();
      const std::size_t count = std::min(left, records_at_once);
      piece.resize(count * words());
      read(piece.data(), piece.size());
      for (std::size_t i = 0; i < count; ++i)
        each(std::span<const std::int64_t>(piece).subspan(i * words(), words()));
      left -= count;
    }
  }
  [[noreturn]] void refuse(std::span<const std::int64_t> record) const {
    io::fail(Errc::bad_format, "{}: damaged: a record {{{}}} out of range", io::input_name(path_),
             fmt::join(record, ", "));
  }

 private:
  void read(std::int64_t* words, std::size_t count) {
    if (std::fread(words, sizeof(std::int64_t), count, file_.get()) != count)
      io::fail(Errc::bad_format, "{}: truncated", io::input_name(path_));
  }

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  SeamHeader header_;
};

/// Pairs equal facets among records with keys of k numbers, and offsets: each(a, b) for two records, each(a,
/// a) for one without a partner.
template <class Each>
void match_seam_records(std::span<const std::int64_t> words, std::size_t k, std::size_t rank,
                        const Each& each) {
  const std::size_t size = k + seam_other_words + rank;
  for_equal_records(words, size, k, [&](std::span<const std::size_t> equal) {
    const auto record = [&](std::size_t i) { return words.subspan(equal[i] * size, size); };
    const auto a = record(0);
    if (equal.size() == 1) return each(a, a);
    const auto b = record(1);
    if (equal.size() > 2) {
      const auto c = record(2);
      io::fail(
          Errc::bad_format,
          "the parts do not fit together: the facet {{{}}} is that of cell {} of tile {}, cell {} of tile {} "
          "and cell {} of tile {}",
          fmt::join(a.first(k), ", "), a[k + 1], a[k], b[k + 1], b[k], c[k + 1], c[k]);
    }
    if (a[k] == b[k] && rank == 0)
      io::fail(Errc::bad_format, "the seam {{{}}} of tile {} is between its own cells {} and {}",
               fmt::join(a.first(k), ", "), a[k], a[k + 1], b[k + 1]);
    each(a, b);
  });
}

/// Adds the answer to a record whose facet is that of another one: the cell there, and by how much it is
/// translated.
inline void add_answer(std::span<const std::int64_t> record, std::span<const std::int64_t> other,
                       std::size_t k, std::size_t rank, std::span<const std::int64_t> first_cell,
                       std::vector<std::int64_t>& answer) {
  answer.push_back(first_cell[static_cast<std::size_t>(other[k])] + other[k + 1]);
  for (std::size_t l = k + seam_other_words; l < k + seam_other_words + rank; ++l)
    answer.push_back(record[l] - other[l]);
}

}  // namespace delone::tiles
