// SPDX-License-Identifier: BSD-3-Clause
// All points as pages in a scratch file, and what reads them.
#pragma once

#include "io/positioned_file.hpp"
#include "pages/page_order.hpp"
#include "pages/pages.hpp"
#include "tiles/point_stream.hpp"
#include "tiles/split_tree.hpp"
#include "tiles/survey.hpp"
#include "tiles/tile_points.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace delone::tiles {

using pages::Page;
using pages::PageSource;
using pages::PageTable;

struct PageFileOptions {
  std::size_t page_points = 0;  ///< the most points of a page; 0: by the number of points
  /// The most memory to use, in bytes. A quarter of it holds points on their way to the tiles; after that the
  /// points of one tile are in memory at a time, which is an error, out_of_memory, where it is not enough.
  std::uint64_t memory = std::uint64_t{1} << 30;
};

/// Reads the stream once more, from its beginning, and writes all points to `path`, tile by tile in pages.
/// Duplicates go to `path`.duplicates. A file of the same size beside it, `path`.unordered, has the points in
/// the meantime; it is removed, and after an error the others, too. Throws cannot_write; bad_format if the
/// stream has not as many rows as the survey.
PageTable make_page_file(PointStream& points, const Survey& survey, const SplitTree& tree,
                         const std::string& path, const PageFileOptions& options = {});

/// The pages of such a file. All members may be called from several threads at once.
class PageFile final : public PageSource {
 public:
  /// Keeps pages of up to `cache_bytes` in all until drop(). The table has to outlive this. Throws
  /// cannot_open, and bad_format if the file has another size than the table says.
  PageFile(const std::string& path, const PageTable& table, std::size_t cache_bytes = std::size_t{64} << 20);

  /// Never null. Beyond the limit of the cache, the page is read again every time.
  std::shared_ptr<const Page> find(std::size_t page) override;
  /// All points of a tile, in the order of its pages.
  TilePoints read_tile_points(std::size_t tile) const;
  /// Forgets all pages: those that nobody else holds are freed.
  void drop();
  /// How many pages were read from the file.
  std::uint64_t num_reads() const { return num_reads_; }

 private:
  io::PositionedFile file_, duplicates_;
  const PageTable& table_;
  const std::size_t cache_bytes_;
  std::atomic<std::uint64_t> num_reads_ = 0;
  std::mutex mutex_;  // of the members below
  std::unordered_map<std::size_t, std::shared_ptr<const Page>> cache_;
  std::size_t cached_bytes_ = 0;
};

/// For going on later: the files appear whole or not at all. Readers throw bad_format for a file that is not
/// such a one, or damaged.
void write_page_table(const std::string& path, const PageTable& table);
PageTable read_page_table(const std::string& path);
/// The table of the pages in another file, unless one of the files is missing or damaged: then pages are made
/// again.
std::optional<PageTable> find_page_table(const std::string& path, const std::string& pages_path);

}  // namespace delone::tiles
