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

/// For every seam of every tile the global cell across it, −1 where there is none; more of them than fit in
/// memory are in files by ranges of tiles.
class Answers {
 public:
  Answers(const std::string& work, std::span<const std::int64_t> counts, std::uint64_t memory)
      : counts_(counts.begin(), counts.end()), range_of_tile_(counts.size()) {
    const std::uint64_t most = std::max<std::uint64_t>(memory / 8, 1024);  // numbers in memory at once
    std::uint64_t in_range = 0;
    std::size_t range = 0;
    for (std::size_t t = 0; t < counts_.size(); ++t) {
      const auto count = static_cast<std::uint64_t>(counts_[t]);
      if (in_range > 0 && in_range + count > most) ++range, in_range = 0;
      in_range += count;
      range_of_tile_[t] = range;
    }
    buckets_ = std::make_unique<RecordBuckets>(path_in(work, "answers"), range + 1);
    if (range == 0) start(0);
  }

  void put(std::int64_t tile, std::int64_t seam, std::int64_t cell) {
    if (buckets_->size() == 1) return set(tile, seam, cell);
    const std::array<std::int64_t, 3> words{tile, seam, cell};
    buckets_->append(range_of_tile_[static_cast<std::size_t>(tile)], words);
  }
  void take(const std::function<void(std::size_t, std::span<const std::int64_t>)>& write) {
    for (std::size_t range = 0, t = 0; range < buckets_->size(); ++range) {
      if (buckets_->size() > 1) {
        start(range);
        const std::vector<std::int64_t> words = buckets_->take(range);
        for (std::size_t i = 0; i < words.size(); i += 3) set(words[i], words[i + 1], words[i + 2]);
      }
      for (; t < counts_.size() && range_of_tile_[t] == range; ++t) write(t, cells_[t - first_]);
    }
  }

 private:
  void start(std::size_t range) {
    cells_.clear();
    first_ = 0;
    while (first_ < counts_.size() && range_of_tile_[first_] < range) ++first_;
    for (std::size_t t = first_; t < counts_.size() && range_of_tile_[t] == range; ++t)
      cells_.emplace_back(static_cast<std::size_t>(counts_[t]), -1);
  }
  void set(std::int64_t tile, std::int64_t seam, std::int64_t cell) {
    cells_[static_cast<std::size_t>(tile) - first_][static_cast<std::size_t>(seam)] = cell;
  }

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
    const auto corners = static_cast<std::size_t>(std::max(data.affine_dimension + 1, 1)), k = corners - 1;
    io::AtomicFile file(path);
    file.track_content();
    const std::array<std::int64_t, seam_header_words> header{
        static_cast<std::int64_t>(k), static_cast<std::int64_t>(finished.seams.size())};
    file.write(header.data(), sizeof(header));
    std::vector<std::int64_t> record;
    for (std::size_t s = 0; s < finished.seams.size(); ++s) {
      const auto [cell, index] = finished.seams[s];
      record.clear();
      for (std::size_t i = 0; i < corners; ++i)
        if (i != static_cast<std::size_t>(index))
          record.push_back(
              data.rows[static_cast<std::size_t>(data.cells[static_cast<std::size_t>(cell) * corners + i])]);
      std::sort(record.begin(), record.end());
      record.insert(record.end(),
                    {static_cast<std::int64_t>(tile), cell, index, static_cast<std::int64_t>(s)});
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
    std::size_t k = 0;
    std::uint64_t words = 0;
    for (std::size_t t = 0; t < tiles; ++t) {
      const SeamReader reader(work, t);
      counts[t] = reader.header().count;
      if (counts[t] == 0) continue;
      const auto k_of_tile = static_cast<std::size_t>(reader.header().k);
      if (words > 0 && k != k_of_tile)
        io::fail(Errc::bad_format,
                 "the parts do not fit together: facets of {} vertices in tile {}, of {} before it",
                 k_of_tile, t, k);
      k = k_of_tile;
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
    Answers answers(work, counts, memory);
    std::int64_t unmatched = 0;
    for (std::size_t b = 0; b < buckets.size(); ++b) {
      internal::cancellation_point();
      match_seam_records(buckets.take(b), k,
                         [&](std::span<const std::int64_t> a, std::span<const std::int64_t> c) {
                           if (a.data() == c.data()) {
                             ++unmatched;
                             return;
                           }
                           answers.put(a[k], a[k + 3], first_cell[static_cast<std::size_t>(c[k])] + c[k + 1]);
                           answers.put(c[k], c[k + 3], first_cell[static_cast<std::size_t>(a[k])] + a[k + 1]);
                         });
    }
    answers.take(write);
    return unmatched;
  });
}

}  // namespace delone::tiles
