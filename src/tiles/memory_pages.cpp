// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/memory_pages.hpp"

#include "pages/page_order.hpp"
#include "tiles/point_stream.hpp"
#include "tiles/split_tree.hpp"
#include "tiles/survey.hpp"

#include <algorithm>
#include <utility>

namespace delone::tiles {

using pages::Page;

class MemoryPages::Source final : public PageSource {
 public:
  std::shared_ptr<const Page> find(std::size_t page) override { return pages[page]; }
  std::vector<std::shared_ptr<const Page>> pages;
};

MemoryPages::MemoryPages(std::span<const double> rows, int dimension, std::size_t num_tiles,
                         std::size_t page_points) {
  const auto stream = stream_of(PointsView(rows, dimension));
  const SurveyResult result = make_survey(*stream, false, rows.size() / static_cast<std::size_t>(dimension));
  survey_ = result.survey;
  table_.dimension = dimension;
  table_.first_point = {0};
  const SplitTree tree = make_split_tree(result.sample, dimension, num_tiles);
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<std::vector<double>> records(static_cast<std::size_t>(tree.num_tiles));
  for (std::size_t at = 0; at < rows.size(); at += d) {
    std::vector<double>& of_tile = records[tree.tile_of(&rows[at])];
    of_tile.insert(of_tile.end(), &rows[at], &rows[at] + d);
    of_tile.push_back(pages::coded_row(static_cast<std::int64_t>(at / d)));
  }
  auto source = std::make_unique<Source>();
  std::vector<Tile> boxes = tree.boxes();
  for (std::size_t t = 0; t < records.size(); ++t) {
    duplicates_.push_back(take_duplicates(records[t], d));
    pages::order_pages(records[t], page_points > 0 ? page_points : pages::points_per_page(survey_.num_points),
                       table_);
    table_.tiles.back().low = std::move(boxes[t].low);
    table_.tiles.back().high = std::move(boxes[t].high);
    const double* record = records[t].data();
    for (std::size_t page = source->pages.size(); page < table_.num_pages(); ++page) {
      source->pages.push_back(pages::page_of_records({record, table_.page_size(page) * (d + 1)}, d));
      record += table_.page_size(page) * (d + 1);
    }
  }
  source_ = std::move(source);
}

TilePoints MemoryPages::points(std::size_t tile) const {
  TilePoints points;
  points.duplicates = duplicates_[tile];
  for (std::size_t p = table_.tiles[tile].first_page; p < table_.tiles[tile].last_page; ++p) {
    const auto page = source_->find(p);
    for (std::size_t i = 0; i < page->size(); ++i) {
      points.rows.push_back(page->rows[i]);
      points.points.resize(points.points.size() + table_.row_size());
      page->copy_point(i, points.points.data() + points.points.size() - table_.row_size());
    }
  }
  return points;
}

}  // namespace delone::tiles
