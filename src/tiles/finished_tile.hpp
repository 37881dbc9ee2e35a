// SPDX-License-Identifier: BSD-3-Clause
// What a finished tile hands over: its part of the triangulation, without the cells across the seams, and its
// share of the hash.
#pragma once

#include "complex/canonical_hash.hpp"

#include <delone/tiles.hpp>

#include <cstdint>
#include <vector>

namespace delone::tiles {

/// A facet of a cell of the part whose neighbor is in no part that is known: the cell of another part with
/// the same facet, or none beyond the convex hull.
struct Seam {
  std::int32_t cell = 0;   ///< of this part
  std::int32_t index = 0;  ///< of the opposite vertex
};

struct FinishedTile {
  /// Its seams are empty, and offsets in terms of the vectors that translations consist of; neighbors at a
  /// seam are −2 − s, s the number in `seams`.
  TileData data;
  std::vector<Seam> seams;
  /// Of the points of the tile and the cells of the part. With weights: `hash` without them, `weighted_hash`
  /// with them; the whole uses that if weights differ.
  /// In a periodic set they are left to periodic_part.hpp.
  complex::HashAccumulator hash, weighted_hash;
  std::int64_t num_vertices = 0, num_duplicates = 0, num_hidden = 0, num_hull_facets = 0;
  double least_weight = 0, largest_weight = 0;  ///< of its vertices
  std::int64_t num_foreign = 0, num_rounds = 0;
};

}  // namespace delone::tiles
