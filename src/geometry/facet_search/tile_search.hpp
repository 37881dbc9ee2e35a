// SPDX-License-Identifier: BSD-3-Clause
// Lists the vertices that may have the least ratio beyond a facet. Every vertex is examined, many per
// instruction, in binary32. Compiled for several instruction sets; the best one of the machine is chosen at
// run time.
#pragma once

#include "cells/open_cell.hpp"
#include "geometry/facet_search/ratio_keys.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::geometry {

/// Vertices are stored in blocks of this size: the first entries of their images side by side, then the
/// second ones, …, then the lifts.
inline constexpr std::size_t block = 16;
/// The number of blocks is a multiple of this: so many may be processed together.
inline constexpr std::size_t most_together = 8;
/// All facets of a batch are searched for in a tile before the next tile is loaded. In 7D and 8D half of the
/// largest tile takes 16 or 18 kB.
inline constexpr std::size_t most_tile_blocks = 64;
static_assert(most_tile_blocks / 2 % most_together == 0);
static_assert(most_tile_blocks * block - 1 == place_mask);

/// An affine function of images: k coefficients and the constant.
using Affine = const float*;

/// Coefficients of a cell's functions must add up to less, or the cell is too flat for binary32: then keys do
/// not overflow.
inline constexpr double largest_spread = 0x1p40;

/// An open facet of a batch. The ratio of a vertex tells where in the pencil of the facet its sphere is.
struct SoughtFacet {
  std::size_t cell;  ///< in the batch
  std::size_t slot;
  Affine beyond;                        ///< positive beyond the facet
  float least;                          ///< the least ratio, or more
  float listed_up_to;                   ///< all vertices with at most this ratio are listed
  std::size_t num_listed;               ///< vertices whose ratio may be the least
  std::array<std::uint32_t, 6> listed;  ///< their numbers, if there is room for all
};

/// A batch of cells and their open facets.
struct SearchTask {
  int k;
  std::size_t num_blocks;
  const float* images;      ///< and lifts, at a cache line
  std::size_t tile_blocks;  ///< a multiple of most_together
  float* heights;           ///< scratch memory: the functional at the vertices of a tile, at a cache line
  std::span<const cells::OpenCell> cells;
  const float* height_functions;  ///< of each cell, k + 1 numbers
  std::span<SoughtFacet> facets;  ///< in the order of their cells
};

/// Lists for every facet the vertices that may have the least ratio.
void search_tiles(const SearchTask& task);

/// Lists all vertices beyond a facet whose ratio is at most the bound, as far as there is room; returns their
/// number.
std::size_t list_up_to(const SearchTask& task, const SoughtFacet& facet, float bound,
                       std::span<std::uint32_t> list);

}  // namespace delone::geometry
