// SPDX-License-Identifier: BSD-3-Clause
// All points as pages in a scratch file. See page_file.hpp. A page is its points, row_size() doubles each,
// and then their rows, 64 bits each; pages follow each other without gaps.
#include "tiles/page_file.hpp"

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"
#include "io/file.hpp"
#include "tiles/duplicates.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

namespace delone::tiles {

using pages::row_of;

namespace {

/// Pages are read and written in pieces of about so many bytes.
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

std::size_t record_bytes(const PageTable& table) { return (table.row_size() + 1) * sizeof(double); }

/// Removes a file at the end, unless it is kept.
class Leftover {
 public:
  explicit Leftover(std::string path) : path_(std::move(path)) {}
  Leftover(const Leftover&) = delete;
  Leftover& operator=(const Leftover&) = delete;
  ~Leftover() {
    if (!path_.empty()) platform::remove_file(path_);
  }
  void keep() { path_.clear(); }

 private:
  std::string path_;
};

/// The records of all tiles, in blocks: a full one goes to the file, the last of each tile stays in memory.
class Buckets {
 public:
  Buckets(std::string path, std::size_t num_tiles, std::size_t record_size, std::uint64_t memory)
      : path_(std::move(path)), leftover_(path_), buckets_(num_tiles) {
    constexpr std::uint64_t largest_block = std::uint64_t{1} << 20;
    const std::uint64_t share = std::min(memory / num_tiles, largest_block) / sizeof(double);
    block_size_ = std::max<std::size_t>(static_cast<std::size_t>(share) / record_size, 1) * record_size;
  }

  void add(std::size_t tile, const double* row, std::size_t row_size, std::int64_t number) {
    std::vector<double>& block = buckets_[tile].block;
    if (block.empty()) block.reserve(block_size_);
    block.insert(block.end(), row, row + row_size);
    block.push_back(pages::coded_row(number));
    if (block.size() == block_size_) flush(buckets_[tile]);
  }

  std::size_t size(std::size_t tile) const {
    return buckets_[tile].offsets.size() * block_size_ + buckets_[tile].block.size();
  }
  /// Moves all records of a tile to `records`.
  void take(std::size_t tile, std::vector<double>& records) {
    Bucket& bucket = buckets_[tile];
    records.resize(size(tile));
    double* to = records.data();
    for (const std::uint64_t offset : bucket.offsets) {
      internal::cancellation_point();
      file_->read(offset, to, block_size_ * sizeof(double));
      to += block_size_;
    }
    std::copy(bucket.block.begin(), bucket.block.end(), to);
    bucket = {};
  }

 private:
  struct Bucket {
    std::vector<std::uint64_t> offsets;
    std::vector<double> block;
  };

  void flush(Bucket& bucket) {
    internal::cancellation_point();
    if (!file_) file_.emplace(path_, io::PositionedFile::Mode::write);
    file_->write(end_, bucket.block.data(), block_size_ * sizeof(double));
    bucket.offsets.push_back(end_);
    end_ += block_size_ * sizeof(double);
    bucket.block.clear();
  }

  std::string path_;
  Leftover leftover_;
  std::vector<Bucket> buckets_;
  std::size_t block_size_ = 0;  // in doubles
  std::optional<io::PositionedFile> file_;
  std::uint64_t end_ = 0;
};

void distribute(PointStream& points, const Survey& survey, const SplitTree& tree, Buckets& buckets) {
  const auto row_size = static_cast<std::size_t>(points.dimension());
  std::vector<double> rows;
  std::uint64_t number = 0;
  points.rewind();
  while (points.next(rows)) {
    internal::cancellation_point();
    for (std::size_t i = 0; i < rows.size(); i += row_size)
      buckets.add(tree.tile_of(&rows[i]), &rows[i], row_size, static_cast<std::int64_t>(number++));
  }
  if (number != survey.num_points)
    io::fail(Errc::bad_format, "the input has changed: it had {} points, and now it has {}",
             survey.num_points, number);
}

std::string_view bytes_of(const auto& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0])};
}

/// Writes the pages of the last tile of the table.
void write_pages(const std::vector<double>& records, PageTable& table, io::PositionedFile& file,
                 std::vector<double>& piece) {
  const std::size_t row_size = table.row_size(), record_size = row_size + 1;
  const Tile& tile = table.tiles.back();
  std::uint64_t offset = table.first_point[tile.first_page] * record_bytes(table);
  const double* record = records.data();
  piece.clear();
  for (std::size_t page = tile.first_page; page < tile.last_page; ++page) {
    const std::size_t size = table.page_size(page);
    for (std::size_t i = 0; i < size; ++i)
      piece.insert(piece.end(), record + i * record_size, record + i * record_size + row_size);
    for (std::size_t i = 0; i < size; ++i) piece.push_back(record[i * record_size + row_size]);
    record += size * record_size;
    if (piece.size() * sizeof(double) < piece_bytes && page + 1 < tile.last_page) continue;
    internal::cancellation_point();
    file.write(offset, piece.data(), piece.size() * sizeof(double));
    table.pages_content.add(bytes_of(piece));
    offset += piece.size() * sizeof(double);
    piece.clear();
  }
}

}  // namespace

PageTable make_page_file(PointStream& points, const Survey& survey, const SplitTree& tree,
                         const std::string& path, const PageFileOptions& options) {
  PageTable table;
  table.dimension = survey.dimension;
  table.weighted = survey.weighted;
  table.first_point = {0};
  const auto num_tiles = static_cast<std::size_t>(tree.num_tiles);
  Buckets buckets(path + ".unordered", num_tiles, table.row_size() + 1, options.memory / 4);
  distribute(points, survey, tree, buckets);

  const std::string path_of_duplicates = path + ".duplicates";
  Leftover leftover(path), leftover_duplicates(path_of_duplicates);
  io::PositionedFile file(path, io::PositionedFile::Mode::write),
      duplicates_file(path_of_duplicates, io::PositionedFile::Mode::write);
  const std::size_t page_points =
      options.page_points > 0 ? options.page_points : pages::points_per_page(survey.num_points);
  std::vector<Tile> boxes = tree.boxes();
  std::vector<double> records, piece;
  for (std::size_t t = 0; t < num_tiles; ++t) {
    if (const std::uint64_t bytes = buckets.size(t) * sizeof(double); bytes > options.memory / 4 * 3)
      io::fail(Errc::out_of_memory,
               "tile {} has {} points, which take {} bytes; more memory is needed, or more tiles", t,
               bytes / record_bytes(table), bytes);
    buckets.take(t, records);
    const std::vector<Duplicate> duplicates = take_duplicates(records, table.row_size());
    duplicates_file.write(table.first_duplicate.back() * sizeof(Duplicate), duplicates.data(),
                          duplicates.size() * sizeof(Duplicate));
    table.duplicates_content.add(bytes_of(duplicates));
    table.first_duplicate.push_back(table.first_duplicate.back() + duplicates.size());
    pages::order_pages(records, page_points, table);
    write_pages(records, table, file, piece);
    table.tiles.back().low = std::move(boxes[t].low);
    table.tiles.back().high = std::move(boxes[t].high);
  }
  file.close();
  duplicates_file.close();
  leftover.keep();
  leftover_duplicates.keep();
  return table;
}

PageFile::PageFile(const std::string& path, const PageTable& table, std::size_t cache_bytes)
    : file_(path), duplicates_(path + ".duplicates"), table_(table), cache_bytes_(cache_bytes) {
  const auto require = [](const io::PositionedFile& file, std::uint64_t expected) {
    if (const std::uint64_t found = file.size(); found != expected)
      io::fail(Errc::bad_format, "{}: expected {} bytes, found {}", file.name(), expected, found);
  };
  require(file_, table.num_points() * record_bytes(table));
  require(duplicates_, table.first_duplicate.back() * sizeof(Duplicate));
}

std::shared_ptr<const Page> PageFile::find(std::size_t page) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = cache_.find(page); found != cache_.end()) return found->second;
  }
  const std::size_t size = table_.page_size(page), row_size = table_.row_size();
  std::vector<double> numbers(size * (row_size + 1));
  file_.read(table_.first_point[page] * record_bytes(table_), numbers.data(),
             numbers.size() * sizeof(double));
  auto read = std::make_shared<Page>();
  for (std::size_t j = 0; j < row_size; ++j)
    for (std::size_t i = 0; i < Page::stride_of(size); ++i)
      read->coordinates.push_back(numbers[std::min(i, size - 1) * row_size + j]);
  for (std::size_t i = 0; i < size; ++i) read->rows.push_back(row_of(numbers[size * row_size + i]));
  ++num_reads_;
  constexpr std::size_t overhead = 256;  // of the entry and the allocations
  const std::size_t bytes = read->size() * record_bytes(table_) + overhead;
  const std::lock_guard lock(mutex_);
  if (cached_bytes_ + bytes > cache_bytes_) return read;
  const auto [place, is_new] = cache_.emplace(page, std::move(read));  // another thread may have been faster
  if (is_new) cached_bytes_ += bytes;
  return place->second;
}

TilePoints PageFile::read_tile_points(std::size_t tile) const {
  const Tile& all = table_.tiles[tile];
  TilePoints points;
  const std::size_t size = table_.first_point[all.last_page] - table_.first_point[all.first_page],
                    row_size = table_.row_size();
  points.points.reserve(size * row_size);
  points.rows.reserve(size);
  std::vector<double> piece;
  for (std::size_t first = all.first_page; first < all.last_page;) {
    internal::cancellation_point();
    std::size_t last = first + 1;
    while (last < all.last_page &&
           (table_.first_point[last] - table_.first_point[first]) * record_bytes(table_) < piece_bytes)
      ++last;
    piece.resize((table_.first_point[last] - table_.first_point[first]) * (row_size + 1));
    file_.read(table_.first_point[first] * record_bytes(table_), piece.data(), piece.size() * sizeof(double));
    const double* from = piece.data();
    for (; first < last; ++first) {
      const std::size_t on_page = table_.page_size(first);
      points.points.insert(points.points.end(), from, from + on_page * row_size);
      from += on_page * row_size;
      for (std::size_t i = 0; i < on_page; ++i) points.rows.push_back(row_of(from[i]));
      from += on_page;
    }
  }
  points.duplicates.resize(table_.first_duplicate[tile + 1] - table_.first_duplicate[tile]);
  duplicates_.read(table_.first_duplicate[tile] * sizeof(Duplicate), points.duplicates.data(),
                   points.duplicates.size() * sizeof(Duplicate));
  return points;
}

void PageFile::drop() {
  const std::lock_guard lock(mutex_);
  cache_.clear();
  cached_bytes_ = 0;
}

}  // namespace delone::tiles
