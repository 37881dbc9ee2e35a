// SPDX-License-Identifier: BSD-3-Clause
// The points of the tiles of a rank, in pages, in its memory; the table of all pages at every rank.
#pragma once

#include "pages/page_order.hpp"
#include "pages/pages.hpp"
#include "ranks.hpp"
#include "share.hpp"
#include "tiles/split_tree.hpp"
#include "tiles/survey.hpp"
#include "tiles/tile_points.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace delone::mpi {

/// Which rank has which tiles: each has consecutive ones.
struct TileOwners {
  std::size_t num_tiles = 1, num_ranks = 1;
  std::size_t first_tile(std::size_t rank) const { return num_tiles * rank / num_ranks; }
  std::size_t owner(std::size_t tile) const { return ((tile + 1) * num_ranks - 1) / num_tiles; }
};

class OwnedPages {
 public:
  /// Sends all points to the ranks of their tiles, which put them into pages. Collective. `points`: those of
  /// the share, or in a periodic set the same in the box. `memory`: of one rank.
  OwnedPages(tiles::PointStream& points, const Share& share, std::int64_t first_row,
             const tiles::Survey& survey, const tiles::SplitTree& tree, Ranks& ranks, std::uint64_t memory);

  /// Points of the input, the same at all ranks, get the first of their rows, and of equal positions the
  /// largest weight. Collective.
  void settle(std::vector<double>& points, std::vector<std::int64_t>& rows, const tiles::SplitTree& tree,
              const Ranks& ranks) const;

  const TileOwners& owners() const { return owners_; }
  /// Of all ranks.
  const pages::PageTable& table() const { return table_; }
  std::size_t owner_of_page(std::size_t page) const;

  bool has(std::size_t page) const { return page >= first_page_ && page < last_page_; }
  /// REQUIRES has(page).
  std::span<const double> records(std::size_t page) const;
  /// Of a tile of this rank.
  tiles::TilePoints points(std::size_t tile) const;

 private:
  void receive(tiles::PointStream& points, const Share& share, std::int64_t first_row,
               const tiles::SplitTree& tree, Ranks& ranks, std::uint64_t memory);
  void make_table(const pages::PageTable& own, const tiles::SplitTree& tree, const Ranks& ranks);
  std::size_t record_size() const { return table_.row_size() + 1; }

  TileOwners owners_;
  std::size_t first_tile_ = 0, last_tile_ = 0, first_page_ = 0, last_page_ = 0;
  pages::PageTable table_;
  std::vector<std::vector<double>> records_;               // of each tile of this rank
  std::vector<std::vector<tiles::Duplicate>> duplicates_;  // the same
};

}  // namespace delone::mpi
