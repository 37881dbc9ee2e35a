// SPDX-License-Identifier: BSD-3-Clause
// The facets at the seams of all parts, and the cells across them: two records with the same vertices are one
// facet; a facet with one record is on the convex hull.
#pragma once

#include "io/crc32.hpp"
#include "tiles/finished_tile.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace delone::tiles {

/// Writes the seams of a tile to WORK/seams-0000.bin, whole or not at all. Written again, they replace what
/// was there.
io::FileContent append_seam_records(const std::string& work, std::size_t tile, const FinishedTile& finished);
/// The file that append_seam_records() writes.
std::string seam_records_name(std::size_t tile);

/// Finds the cells across the seams of all tiles, of which tile t has the global cells first_cell[t] …, and
/// calls write(t, cells) for each, in a periodic set with the offsets of each cell after it. Uses about
/// `memory` bytes, and scratch files in WORK beyond that. Returns the number of facets without a partner.
/// Throws bad_format if files of WORK are damaged or do not fit together: three cells with one facet, or two
/// of one tile.
std::int64_t match_seams(const std::string& work, std::span<const std::int64_t> first_cell,
                         std::uint64_t memory,
                         const std::function<void(std::size_t, std::span<const std::int64_t>)>& write);

}  // namespace delone::tiles
