// SPDX-License-Identifier: BSD-3-Clause
// The way of a tile whose questions take too long: every point of the other tiles is located in its
// triangulation, the nearest page first.
#include "base/progress_meter.hpp"
#include "base/stopwatch.hpp"
#include "tiles/tile_triangulation.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace delone::tiles {

/// The pages of other tiles, the nearest to the box of this one last.
std::vector<std::uint32_t> TileTriangulation::pages_by_distance() const {
  const pages::PageTable& table = tree_.table();
  const auto d = static_cast<std::size_t>(table.dimension);
  std::vector<double> low(table.low(tile().first_page), table.high(tile().first_page)),
      high(table.high(tile().first_page), table.high(tile().first_page) + d);
  for (std::size_t page = tile().first_page; page < tile().last_page; ++page)
    for (std::size_t j = 0; j < d; ++j) {
      low[j] = std::min(low[j], table.low(page)[j]);
      high[j] = std::max(high[j], table.high(page)[j]);
    }
  std::vector<std::pair<double, std::uint32_t>> pages;
  for (std::size_t page = 0; page < table.num_pages(); ++page) {
    if (page >= tile().first_page && page < tile().last_page) continue;
    double distance = 0;
    for (std::size_t j = 0; j < d; ++j) {
      const double off = std::max({0.0, table.low(page)[j] - high[j], low[j] - table.high(page)[j]});
      distance += off * off;
    }
    pages.emplace_back(distance, static_cast<std::uint32_t>(page));
  }
  std::sort(pages.begin(), pages.end(), std::greater<>());
  std::vector<std::uint32_t> numbers;
  for (const auto& page : pages) numbers.push_back(page.second);
  return numbers;
}

/// Inserts every point of another tile that is in conflict with a cell that has a vertex of this one. Each is
/// tried once: a point is in conflict with the star of a vertex if it would take a part of its Voronoi or
/// power region, and regions only become smaller as points are inserted. Returns whether
/// there is more to do: a page is not here yet.
bool TileTriangulation::try_all_points() {
  const internal::Stopwatch trying;
  while (!pages_to_try_.empty()) {
    const std::uint32_t number = pages_to_try_.back();
    const auto page = source_.find(number);
    if (!page) {  // the next ones are wanted, too
      for (std::size_t i = 1; i <= std::min<std::size_t>(pages_to_try_.size(), 64); ++i)
        source_.find(pages_to_try_[pages_to_try_.size() - i]);
      break;
    }
    pages_to_try_.pop_back();
    for (std::size_t slot = 0; slot < page->size(); ++slot)
      if (!surroundings_->knows(number, slot)) insert_if_needed(*page, slot);
    internal::cancellation_point();
  }
  effort_.insert_seconds += trying.seconds();
  ++num_rounds_;
  return !pages_to_try_.empty();
}

void TileTriangulation::insert_if_needed(const Page& page, std::size_t slot) {
  const auto d = static_cast<std::size_t>(survey_.dimension);
  std::vector<double> row(tree_.table().row_size());
  page.copy_point(slot, row.data());
  const std::span<const double> point(row.data(), d);
  const double weight = survey_.weighted ? row[d] : 0;
  const std::vector<CellId> zone =
      triangulation::StoredPoints::conflict_zone(triangulation(), point, last_cell_, weight);
  if (zone.empty()) return;
  last_cell_ = zone.front();
  const Complex complex = triangulation().complex();
  const bool is_needed = std::any_of(zone.begin(), zone.end(), [&](CellId cell) {
    const VerticesOfCell vertices = complex.vertices(cell);
    return std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) { return is_own_[index(v)] != 0; });
  });
  if (!is_needed) return;
  const InsertResult result = made_->insert_row(row, last_cell_);
  rows_.push_back(page.rows[slot]);
  enter_vertices();
  ++num_foreign_;
  last_cell_ = triangulation().complex().incident_cell(result.vertex);
}

}  // namespace delone::tiles
