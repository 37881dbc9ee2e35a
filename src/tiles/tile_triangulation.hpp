// SPDX-License-Identifier: BSD-3-Clause
// One tile of a triangulation: its own points, and round by round the points of other tiles that its cells
// are in conflict with, until no cell with a vertex of its own is. These cells are then cells of the whole
// triangulation, and all that have such a vertex are among them.
//
// Why. A cell that no point of the whole set is in conflict with, ties perturbed by coordinates alone, is a
// cell of the whole. The star of a point of the tile, closed by cells of the whole, is its whole star. So
// nothing has to be merged, and tiles agree wherever they meet.
#pragma once

#include "pages/page_tree.hpp"
#include "tiles/finished_tile.hpp"
#include "tiles/surroundings.hpp"
#include "tiles/survey.hpp"
#include "tiles/tile_points.hpp"
#include "triangulation/row_triangulation.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace delone::tiles {

using pages::Page;
using pages::Tile;

struct TileOptions {
  unsigned threads = 1;
  std::function<bool(double)> progress = {};
  bool try_all_points = false;  ///< instead of asking for those that are needed
};

/// What a tile has cost.
struct TileEffort {
  double insert_seconds = 0, ask_seconds = 0;
};

class TileTriangulation {
 public:
  /// `number`: of the tile in the table. All references outlive the object. Without `surroundings`: those of
  /// an open set.
  TileTriangulation(const Survey& survey, const PageTree& tree, PageSource& source, std::size_t number,
                    TilePoints own, const TileOptions& options,
                    std::unique_ptr<Surroundings> surroundings = nullptr);

  /// Inserts what the last round has found, and asks for all cells that are new. Returns whether there is
  /// more to do: points to insert, or pages to wait for.
  bool advance();
  /// REQUIRES that advance() has returned false. Ends the triangulation.
  FinishedTile finish();

  const TileEffort& effort() const { return effort_; }
  std::size_t num_foreign() const { return num_foreign_; }
  std::size_t num_rounds() const { return num_rounds_; }
  /// The memory of cells and points, in bytes.
  std::size_t bytes() const;

 private:
  class Asking;

  const Triangulation& triangulation() const { return made_->get(); }
  const Tile& tile() const { return tree_.table().tiles[number_]; }
  void insert(std::vector<double> rows);
  void enter_vertices();
  void insert_found();
  void insert_one_by_one();
  void take_found(const ForeignPlace& place, double* point);
  /// Whether all points can be tried where questions take too long. Translates are too many for that.
  bool can_try_all_points() const { return surroundings_->rank() == 0; }
  void ask();
  std::vector<std::uint32_t> pages_by_distance() const;
  bool try_all_points();
  std::uint64_t pages_worth_all_points() const;
  void insert_if_needed(const Page& page, std::size_t slot);

  const Survey& survey_;
  const PageTree& tree_;
  PageSource& source_;
  const std::size_t number_;
  const TileOptions options_;
  std::optional<triangulation::RowTriangulation> made_;  // until it ends
  TilePoints own_;
  std::vector<std::int64_t> rows_;       // of all points that were inserted, in that order
  std::vector<std::uint8_t> is_own_;     // by vertex id
  std::vector<std::int64_t> row_of_;     // by vertex id
  std::vector<std::uint32_t> shifts_;    // of all points that were inserted, if the set is periodic
  std::vector<std::uint32_t> shift_of_;  // by vertex id, the same
  std::size_t num_rows_done_ = 0;        // rows whose vertices are entered above
  Index first_new_vertex_ = 1;           // of the last insertion
  std::unique_ptr<Surroundings> surroundings_;
  std::vector<ForeignPlace> found_;  // to be inserted next
  std::vector<CellId> waiting_;      // cells whose questions wait for pages
  std::size_t num_foreign_ = 0, num_rounds_ = 0;
  bool has_asked_ = false;
  std::atomic<bool> asks_in_vain_ = false;      // questions take too long: all points are tried instead
  std::atomic<std::uint64_t> pages_asked_ = 0;  // by all rounds
  std::uint64_t most_pages_asked_ = 0;          // beyond that it is faster to try all points
  std::vector<std::uint32_t> pages_to_try_;     // the next one last
  CellId last_cell_ = invalid_cell;             // where the last point that was tried is
  TileEffort effort_;
};

}  // namespace delone::tiles
