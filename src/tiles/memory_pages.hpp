// SPDX-License-Identifier: BSD-3-Clause
// Points in memory, cut into tiles and pages: what a page file is on disk.
#pragma once

#include "pages/pages.hpp"
#include "tiles/survey.hpp"
#include "tiles/tile_points.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace delone::tiles {

using pages::PageSource;
using pages::PageTable;

class MemoryPages {
 public:
  /// Rows of d coordinates; 0: as many points per page as for a file.
  MemoryPages(std::span<const double> rows, int dimension, std::size_t num_tiles,
              std::size_t page_points = 0);

  const Survey& survey() const { return survey_; }
  const PageTable& table() const { return table_; }
  PageSource& source() const { return *source_; }
  /// The points of a tile, in the order of its pages.
  TilePoints points(std::size_t tile) const;

 private:
  class Source;

  Survey survey_;
  PageTable table_;
  std::vector<std::vector<Duplicate>> duplicates_;  // of each tile
  std::unique_ptr<PageSource> source_;
};

}  // namespace delone::tiles
