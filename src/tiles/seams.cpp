// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/seams.hpp"

#include "base/progress_meter.hpp"
#include "io/atomic_file.hpp"
#include "tiles/part_file.hpp"
#include "tiles/record_buckets.hpp"
#include "tiles/seam_records.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace delone::tiles {

namespace {

/// For every seam of every tile the global cell across it, −1 where there is none, and its offsets; more of
/// them than fit in memory are in files by ranges of tiles.
class Answers {
 public:
  Answers(const std::string& work, std::span<const std::int64_t> counts, std::size_t rank,
          std::uint64_t memory)
      : width_(1 + rank), counts_(counts.begin(), counts.end()), range_of_tile_(counts.size()) {
    const std::uint64_t most = std::max<std::uint64_t>(memory / 8, 1024);  // numbers in memory at once
    std::uint64_t in_range = 0;
    std::size_t range = 0;
    for (std::size_t t = 0; t < counts_.size(); ++t) {
      const std::uint64_t count = static_cast<std::uint64_t>(counts_[t]) * width_;
      if (in_range > 0 && in_range + count > most) ++range, in_range = 0;
      in_range += count;
      range_of_tile_[t] = range;
    }
    buckets_ = std::make_unique<RecordBuckets>(path_in(work, "answers"), range + 1);
    if (range == 0) start(0);
  }

  /// `words`: tile, seam, cell, offsets.
  void put(std::span<const std::int64_t> words) {
    if (buckets_->size() == 1) return set(words);
    buckets_->append(range_of_tile_[static_cast<std::size_t>(words[0])], words);
  }
  void take(const std::function<void(std::size_t, std::span<const std::int64_t>)>& write) {
    for (std::size_t range = 0, t = 0; range < buckets_->size(); ++range) {
      if (buckets_->size() > 1) {
        start(range);
        const std::vector<std::int64_t> words = buckets_->take(range);
        for (std::size_t i = 0; i < words.size(); i += 2 + width_)
          set(std::span(words).subspan(i, 2 + width_));
      }
      for (; t < counts_.size() && range_of_tile_[t] == range; ++t) write(t, cells_[t - first_]);
    }
  }

 private:
  void start(std::size_t range) {
    cells_.clear();
    first_ = 0;
    while (first_ < counts_.size() && range_of_tile_[first_] < range) ++first_;
    for (std::size_t t = first_; t < counts_.size() && range_of_tile_[t] == range; ++t) {
      cells_.emplace_back(static_cast<std::size_t>(counts_[t]) * width_, 0);
      for (std::size_t at = 0; at < cells_.back().size(); at += width_) cells_.back()[at] = -1;
    }
  }
  void set(std::span<const std::int64_t> words) {
    std::copy(words.begin() + 2, words.end(),
              cells_[static_cast<std::size_t>(words[0]) - first_].begin() +
                  static_cast<std::ptrdiff_t>(static_cast<std::size_t>(words[1]) * width_));
  }

  std::size_t width_;
  std::vector<std::int64_t> counts_;
  std::vector<std::size_t> range_of_tile_;
  std::unique_ptr<RecordBuckets> buckets_;
  std::vector<std::vector<std::int64_t>> cells_;  ///< of the tiles from first_ on
  std::size_t first_ = 0;
};

}  // namespace

std::string seam_records_name(std::size_t tile) { return fmt::format("seams-{:04}.bin", tile); }

io::FileContent append_seam_records(const std::string& work, std::size_t tile, const FinishedTile& finished) {
  const std::string path = path_in(work, seam_records_name(tile));
  return io::guarded(io::output_name(path), [&] {
    const TileData& data = finished.data;
    const auto corners = static_cast<std::size_t>(std::max(data.affine_dimension + 1, 1)),
               r = static_cast<std::size_t>(data.rank), k = (corners - 1) * (1 + r);
    io::AtomicFile file(path);
    file.track_content();
    const std::array<std::int64_t, seam_header_words> header{
        static_cast<std::int64_t>(k), static_cast<std::int64_t>(r),
        static_cast<std::int64_t>(finished.seams.size())};
    file.write(header.data(), sizeof(header));
    std::vector<std::int64_t> record;
    std::vector<std::vector<std::int64_t>> facet(corners - 1);  // of each vertex the row and the offsets
    for (std::size_t s = 0; s < finished.seams.size(); ++s) {
      const auto [cell, index] = finished.seams[s];
      for (std::size_t i = 0, at = 0; i < corners; ++i) {
        if (i == static_cast<std::size_t>(index)) continue;
        const std::size_t place = static_cast<std::size_t>(cell) * corners + i;
        facet[at].assign(1, data.rows[static_cast<std::size_t>(data.cells[place])]);
        for (std::size_t l = 0; l < r; ++l) facet[at].push_back(data.cell_offsets[place * r + l]);
        ++at;
      }
      std::sort(facet.begin(), facet.end());
      record.clear();
      for (const std::vector<std::int64_t>& vertex : facet) {
        record.push_back(vertex[0]);
        for (std::size_t l = 1; l <= r; ++l) record.push_back(vertex[l] - facet[0][l]);
      }
      record.insert(record.end(),
                    {static_cast<std::int64_t>(tile), cell, index, static_cast<std::int64_t>(s)});
      for (std::size_t l = 1; l <= r; ++l) record.push_back(facet[0][l]);
      file.write(record.data(), record.size() * sizeof(std::int64_t));
    }
    const io::FileContent content = file.content();
    file.commit();
    return content;
  });
}

std::int64_t match_seams(const std::string& work, std::span<const std::int64_t> first_cell,
                         std::uint64_t memory,
                         const std::function<void(std::size_t, std::span<const std::int64_t>)>& write) {
  return io::guarded(io::output_name(work), [&]() -> std::int64_t {
    const std::size_t tiles = first_cell.size();
    std::vector<std::int64_t> counts(tiles);
    std::size_t k = 0, rank = 0;
    std::uint64_t words = 0;
    for (std::size_t t = 0; t < tiles; ++t) {
      const SeamReader reader(work, t);
      counts[t] = reader.header().count;
      if (counts[t] == 0) continue;
      const auto k_of_tile = static_cast<std::size_t>(reader.header().k);
      const auto rank_of_tile = static_cast<std::size_t>(reader.header().rank);
      if (words > 0 && (k != k_of_tile || rank != rank_of_tile))
        io::fail(Errc::bad_format,
                 "the parts do not fit together: facets of {} vertices in tile {}, of {} before it",
                 k_of_tile / (1 + rank_of_tile), t, k / (1 + rank));
      k = k_of_tile;
      rank = rank_of_tile;
      words += static_cast<std::uint64_t>(counts[t]) * reader.words();
    }
    // A bucket takes its records and at most half as much for their order; the answers take an eighth.
    RecordBuckets buckets(path_in(work, "facets"), RecordBuckets::count_for(words, memory / 2));
    for (std::size_t t = 0; t < tiles; ++t) {
      if (counts[t] == 0) continue;
      SeamReader reader(work, t);
      reader.for_each([&](std::span<const std::int64_t> record) {
        if (record[k] != static_cast<std::int64_t>(t) || record[k + 3] < 0 || record[k + 3] >= counts[t])
          reader.refuse(record);
        buckets.append(bucket_of_key(record.first(k), buckets.size()), record);
      });
    }
    Answers answers(work, counts, rank, memory);
    std::vector<std::int64_t> answer;
    std::int64_t unmatched = 0;
    for (std::size_t b = 0; b < buckets.size(); ++b) {
      internal::cancellation_point();
      match_seam_records(buckets.take(b), k, rank,
                         [&](std::span<const std::int64_t> a, std::span<const std::int64_t> c) {
                           if (a.data() == c.data()) {
                             ++unmatched;
                             return;
                           }
                           for (const auto& [one, other] : {std::pair(a, c), std::pair(c, a)}) {
                             answer.assign({one[k], one[k + 3]});
                             add_answer(one, other, k, rank, first_cell, answer);
                             answers.put(answer);
                           }
                         });
    }
    answers.take(write);
    return unmatched;
  });
}

}  // namespace delone::tiles
