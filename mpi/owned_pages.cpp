// SPDX-License-Identifier: BSD-3-Clause
#include "owned_pages.hpp"

#include "base/progress_meter.hpp"
#include "io/file.hpp"
#include "tiles/duplicates.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace delone::mpi {

using pages::PageTable;
using pages::Tile;
using tiles::Duplicate;
using tiles::SplitTree;
using tiles::Survey;

OwnedPages::OwnedPages(tiles::PointStream& points, const Share& share, std::int64_t first_row,
                       const Survey& survey, const SplitTree& tree, Ranks& ranks, std::uint64_t memory)
    : owners_{static_cast<std::size_t>(tree.num_tiles), static_cast<std::size_t>(ranks.size())} {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  first_tile_ = owners_.first_tile(rank);
  last_tile_ = owners_.first_tile(rank + 1);
  records_.resize(last_tile_ - first_tile_);
  table_.dimension = survey.dimension;
  table_.weighted = survey.weighted;
  receive(points, share, first_row, tree, ranks, memory);

  PageTable own;
  own.dimension = survey.dimension;
  own.weighted = survey.weighted;
  own.first_point = {0};
  std::uint64_t num_points = 0;
  ranks.together([&] {
    for (std::vector<double>& records : records_) {
      num_points += records.size() / record_size();
      duplicates_.push_back(tiles::take_duplicates(records, table_.row_size()));
      records.shrink_to_fit();
      pages::order_pages(records, pages::points_per_page(survey.num_points), own);
    }
  });
  const auto found = static_cast<std::uint64_t>(ranks.sum(static_cast<std::int64_t>(num_points)));
  ranks.together([&] {
    if (found == survey.num_points) return;
    io::fail(Errc::bad_format, "the input has changed: it had {} points, and now it has {}",
             survey.num_points, found);
  });
  make_table(own, tree, ranks);
}

/// In rounds: every rank reads some rows and deals them out.
void OwnedPages::receive(tiles::PointStream& points, const Share& share, std::int64_t first_row,
                         const SplitTree& tree, Ranks& ranks, std::uint64_t memory) {
  const auto p = static_cast<std::size_t>(ranks.size());
  const std::size_t width = table_.row_size();
  const std::uint64_t round_bytes =
      std::clamp<std::uint64_t>(memory / 32, std::uint64_t{1} << 20, std::uint64_t{64} << 20);
  std::vector<std::vector<double>> to_each(p);
  std::vector<double> rows;
  bool is_done = share.dimension() == 0;
  ranks.together([&] {
    if (!is_done) points.rewind();
  });
  for (;;) {
    ranks.together([&] {
      for (std::vector<double>& some : to_each) some.clear();
      for (std::uint64_t bytes = 0; !is_done && bytes < round_bytes;) {
        internal::cancellation_point();
        if (!points.next(rows)) {
          is_done = true;
          break;
        }
        std::int64_t row = share.first_row(first_row);
        for (std::size_t i = 0; i < rows.size(); i += width) {
          std::vector<double>& to = to_each[owners_.owner(tree.tile_of(&rows[i]))];
          to.insert(to.end(), &rows[i], &rows[i] + width);
          to.push_back(pages::coded_row(row++));
        }
        bytes += rows.size() * sizeof(double);
      }
    });
    const auto from_each = ranks.exchange(to_each);
    for (const std::vector<double>& some : from_each)
      for (std::size_t i = 0; i < some.size(); i += width + 1) {
        std::vector<double>& to = records_[tree.tile_of(&some[i]) - first_tile_];
        to.insert(to.end(), &some[i], &some[i] + width + 1);
      }
    if (ranks.min(is_done ? 1 : 0) == 1) return;
  }
}

/// The rank of its tile has all points at a position.
void OwnedPages::settle(std::vector<double>& points, std::vector<std::int64_t>& rows, const SplitTree& tree,
                        const Ranks& ranks) const {
  const std::size_t width = table_.row_size(), d = static_cast<std::size_t>(table_.dimension),
                    count = points.size() / width;
  std::vector<double> weights(count, -std::numeric_limits<double>::infinity());
  std::vector<std::int64_t> all_rows(count, -1);
  for (std::size_t l = 0; l < count; ++l) {
    const double* const point = points.data() + l * width;
    const std::size_t tile = tree.tile_of(point);
    if (tile < first_tile_ || tile >= last_tile_) continue;
    const std::vector<double>& records = records_[tile - first_tile_];
    for (std::size_t i = 0; i < records.size(); i += width + 1) {
      const double* const record = records.data() + i;
      if (record[0] != point[0] || !std::equal(point, point + d, record)) continue;
      if (table_.weighted && all_rows[l] >= 0 && record[d] <= weights[l]) continue;
      if (table_.weighted) weights[l] = record[d];
      all_rows[l] = pages::row_of(record[width]);
    }
  }
  rows = ranks.max(std::move(all_rows));
  if (!table_.weighted) return;
  for (std::size_t l = 0; l < count; ++l) points[l * width + d] = ranks.max_real(weights[l]);
}

void OwnedPages::make_table(const PageTable& own, const SplitTree& tree, const Ranks& ranks) {
  std::vector<std::uint64_t> sizes, tile_sizes, duplicates;  // of pages, tiles and lists of duplicates
  for (std::size_t page = 0; page < own.num_pages(); ++page) sizes.push_back(own.page_size(page));
  for (const Tile& tile : own.tiles) tile_sizes.push_back(tile.last_page - tile.first_page);
  for (const std::vector<Duplicate>& some : duplicates_) duplicates.push_back(some.size());
  table_.boxes = ranks.gather(own.boxes);
  table_.weights = ranks.gather(own.weights);
  table_.first_point = {0};
  for (const std::uint64_t size : ranks.gather(sizes))
    table_.first_point.push_back(table_.first_point.back() + size);
  for (const std::uint64_t size : ranks.gather(duplicates))
    table_.first_duplicate.push_back(table_.first_duplicate.back() + size);
  table_.tiles = tree.boxes();
  std::size_t page = 0;
  const std::vector<std::uint64_t> all_tile_sizes = ranks.gather(tile_sizes);
  for (std::size_t t = 0; t < table_.tiles.size(); ++t) {
    table_.tiles[t].first_page = page;
    page += static_cast<std::size_t>(all_tile_sizes[t]);
    table_.tiles[t].last_page = page;
  }
  if (first_tile_ == last_tile_) return;
  first_page_ = table_.tiles[first_tile_].first_page;
  last_page_ = table_.tiles[last_tile_ - 1].last_page;
}

std::size_t OwnedPages::owner_of_page(std::size_t page) const {
  const auto tile = std::upper_bound(table_.tiles.begin(), table_.tiles.end(), page,
                                     [](std::size_t p, const Tile& t) { return p < t.last_page; });
  return owners_.owner(static_cast<std::size_t>(tile - table_.tiles.begin()));
}

std::span<const double> OwnedPages::records(std::size_t page) const {
  std::size_t tile = first_tile_;
  while (page >= table_.tiles[tile].last_page) ++tile;
  const std::uint64_t first = table_.first_point[page] - table_.first_point[table_.tiles[tile].first_page];
  return std::span(records_[tile - first_tile_])
      .subspan(static_cast<std::size_t>(first) * record_size(), table_.page_size(page) * record_size());
}

tiles::TilePoints OwnedPages::points(std::size_t tile) const {
  const std::vector<double>& records = records_[tile - first_tile_];
  const std::size_t width = table_.row_size();
  tiles::TilePoints points;
  points.points.reserve(records.size() / (width + 1) * width);
  points.rows.reserve(records.size() / (width + 1));
  for (std::size_t i = 0; i < records.size(); i += width + 1) {
    points.points.insert(points.points.end(), records.data() + i, records.data() + i + width);
    points.rows.push_back(pages::row_of(records[i + width]));
  }
  points.duplicates = duplicates_[tile - first_tile_];
  return points;
}

}  // namespace delone::mpi
