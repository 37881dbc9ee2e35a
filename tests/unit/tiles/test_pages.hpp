// SPDX-License-Identifier: BSD-3-Clause
// Points in pages in memory, cut into tiles by medians along the longest side of their box.
#pragma once

#include "kernel/predicates.hpp"
#include "pages/pages.hpp"
#include "tiles/tile_triangulation.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace delone_test {

using namespace delone;
using namespace delone::pages;
using namespace delone::tiles;

class TestPages final : public PageSource {
 public:
  /// `points`: rows of d numbers, and the weight if `weighted`.
  TestPages(std::vector<double> points, int dimension, std::size_t num_tiles, bool weighted = false,
            std::size_t page_size = 8)
      : points_(std::move(points)),
        width_(static_cast<std::size_t>(dimension) + (weighted ? 1 : 0)),
        page_size_(page_size) {
    for (double& x : points_) x += 0.0;  // −0 is 0
    const std::size_t n = points_.size() / width_;
    survey.dimension = table.dimension = dimension;
    survey.weighted = table.weighted = weighted;
    survey.num_points = n;
    std::map<std::vector<double>, std::int64_t> first;
    std::vector<std::int64_t> distinct;
    for (std::size_t row = 0; row < n; ++row) {
      const double* const p = point(static_cast<std::int64_t>(row));
      const auto [found, is_new] =
          first.emplace(std::vector<double>(p, p + width_), static_cast<std::int64_t>(row));
      if (is_new)
        distinct.push_back(static_cast<std::int64_t>(row));
      else
        duplicates_[found->second].push_back(static_cast<std::int64_t>(row));
    }
    make_survey(distinct);
    const double infinity = std::numeric_limits<double>::infinity();
    table.first_point = {0};
    cut(distinct, num_tiles, std::vector<double>(static_cast<std::size_t>(dimension), -infinity),
        std::vector<double>(static_cast<std::size_t>(dimension), infinity));
  }

  std::shared_ptr<const Page> find(std::size_t page) override { return pages_[page]; }

  TilePoints own(std::size_t tile) const {
    TilePoints own;
    for (std::size_t p = table.tiles[tile].first_page; p < table.tiles[tile].last_page; ++p) {
      for (std::size_t i = 0; i < pages_[p]->size(); ++i) {
        own.points.resize(own.points.size() + width_);
        pages_[p]->copy_point(i, own.points.data() + own.points.size() - width_);
      }
      own.rows.insert(own.rows.end(), pages_[p]->rows.begin(), pages_[p]->rows.end());
    }
    for (const std::int64_t row : own.rows)
      if (const auto found = duplicates_.find(row); found != duplicates_.end())
        for (const std::int64_t duplicate : found->second) own.duplicates.push_back({duplicate, row});
    return own;
  }

  Survey survey;
  PageTable table;

 private:
  const double* point(std::int64_t row) const {
    return points_.data() + static_cast<std::size_t>(row) * width_;
  }

  void make_survey(const std::vector<std::int64_t>& distinct) {
    const auto d = static_cast<std::size_t>(survey.dimension);
    kernel::AffineHull hull(survey.dimension);
    std::vector<std::int64_t> rows;
    for (const std::int64_t row : distinct)
      if (hull.dimension() < survey.dimension && hull.add(point(row))) rows.push_back(row);
    survey.affine_dimension = hull.dimension();
    if (distinct.empty()) return;
    survey.low.assign(point(distinct[0]), point(distinct[0]) + d);
    survey.high = survey.low;
    survey.lowest_weight = std::numeric_limits<double>::infinity();
    survey.largest_weight = -survey.lowest_weight;
    for (const std::int64_t row : distinct) {
      for (std::size_t j = 0; j < d; ++j) {
        survey.low[j] = std::min(survey.low[j], point(row)[j]);
        survey.high[j] = std::max(survey.high[j], point(row)[j]);
      }
      if (!survey.weighted) continue;
      survey.lowest_weight = std::min(survey.lowest_weight, point(row)[d]);
      survey.largest_weight = std::max(survey.largest_weight, point(row)[d]);
    }
    for (std::size_t j = 0; j < d; ++j) {
      const auto less = [&](std::int64_t a, std::int64_t b) { return point(a)[j] < point(b)[j]; };
      rows.push_back(*std::min_element(distinct.begin(), distinct.end(), less));
      rows.push_back(*std::max_element(distinct.begin(), distinct.end(), less));
    }
    for (const std::int64_t row : rows) {
      survey.landmark_rows.push_back(row);
      survey.landmarks.insert(survey.landmarks.end(), point(row), point(row) + width_);
    }
  }

  /// The axis of the longest side, and the rows ordered by their coordinates from that axis on, cyclically.
  std::size_t order(std::vector<std::int64_t>& rows) const {
    const auto d = static_cast<std::size_t>(survey.dimension);
    std::size_t axis = 0;
    double longest = -1;
    for (std::size_t j = 0; j < d; ++j) {
      const auto less = [&](std::int64_t a, std::int64_t b) { return point(a)[j] < point(b)[j]; };
      const auto [low, high] = std::minmax_element(rows.begin(), rows.end(), less);
      const double side = point(*high)[j] / 2 - point(*low)[j] / 2;
      if (side > longest) longest = side, axis = j;
    }
    std::sort(rows.begin(), rows.end(), [&](std::int64_t a, std::int64_t b) {
      for (std::size_t i = 0; i < d; ++i)
        if (const std::size_t j = (axis + i) % d; point(a)[j] != point(b)[j])
          return point(a)[j] < point(b)[j];
      return a < b;
    });
    return axis;
  }
  bool is_same_place(std::int64_t a, std::int64_t b) const {
    return std::equal(point(a), point(a) + survey.dimension, point(b));
  }

  void cut(std::vector<std::int64_t> rows, std::size_t num_tiles, std::vector<double> low,
           std::vector<double> high) {
    if (num_tiles <= 1) {
      Tile tile{table.num_pages(), 0, low, high};
      make_pages(std::move(rows));
      tile.last_page = table.num_pages();
      table.tiles.push_back(tile);
      return;
    }
    std::size_t middle = rows.size() * (num_tiles / 2) / num_tiles, axis = 0;
    std::vector<double> left_high = high, right_low = low;
    if (!rows.empty()) {
      axis = order(rows);
      while (middle > 0 && middle < rows.size() && is_same_place(rows[middle - 1], rows[middle])) ++middle;
      if (middle > 0) right_low[axis] = std::max(right_low[axis], point(rows[middle - 1])[axis]);
      if (middle < rows.size()) left_high[axis] = std::min(left_high[axis], point(rows[middle])[axis]);
    }
    const auto at = rows.begin() + static_cast<std::ptrdiff_t>(middle);
    cut({rows.begin(), at}, num_tiles / 2, low, left_high);
    cut({at, rows.end()}, num_tiles - num_tiles / 2, right_low, high);
  }
  void make_pages(std::vector<std::int64_t> rows) {
    if (rows.empty()) return;
    if (rows.size() > page_size_) {
      order(rows);
      const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2);
      make_pages({rows.begin(), middle});
      make_pages({middle, rows.end()});
      return;
    }
    auto page = std::make_shared<Page>();
    const auto d = static_cast<std::size_t>(survey.dimension);
    std::vector<double> low(d, std::numeric_limits<double>::infinity()), high(d, -low[0]);
    double weight = -std::numeric_limits<double>::infinity();
    for (const std::int64_t row : rows) {
      page->rows.push_back(row);
      for (std::size_t j = 0; j < d; ++j) {
        low[j] = std::min(low[j], point(row)[j]);
        high[j] = std::max(high[j], point(row)[j]);
      }
      if (survey.weighted) weight = std::max(weight, point(row)[d]);
    }
    for (std::size_t j = 0; j < width_; ++j)
      for (std::size_t i = 0; i < Page::stride_of(rows.size()); ++i)
        page->coordinates.push_back(point(rows[std::min(i, rows.size() - 1)])[j]);
    table.first_point.push_back(table.first_point.back() + rows.size());
    table.boxes.insert(table.boxes.end(), low.begin(), low.end());
    table.boxes.insert(table.boxes.end(), high.begin(), high.end());
    if (survey.weighted) table.weights.push_back(weight);
    pages_.push_back(std::move(page));
  }

  std::vector<double> points_;
  const std::size_t width_, page_size_;
  std::map<std::int64_t, std::vector<std::int64_t>> duplicates_;
  std::vector<std::shared_ptr<const Page>> pages_;
};

/// All tiles of a set, one after the other.
inline std::vector<FinishedTile> all_tiles(TestPages& pages, const TileOptions& options = {}) {
  const PageTree tree(pages.table);
  std::vector<FinishedTile> result;
  for (std::size_t i = 0; i < pages.table.tiles.size(); ++i) {
    TileTriangulation tile(pages.survey, tree, pages, i, pages.own(i), options);
    while (tile.advance()) {
    }
    result.push_back(tile.finish());
  }
  return result;
}

}  // namespace delone_test
