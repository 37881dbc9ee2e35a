// SPDX-License-Identifier: BSD-3-Clause
// The check of the tiles of a periodic set.
#pragma once

#include <delone/check.hpp>
#include <delone/tiles.hpp>

#include <string>

namespace delone::tiles {

/// Puts all parts together in memory, as the triangulation of the vertices, and examines it as check() does.
/// At level 6 the rows, counts and hash are those of index.json, too. Throws Errc::too_many if there are more
/// points or cells than in a triangulation in one piece.
CheckReport check_periodic_tiles(const std::string& folder, const TilesIndex& index,
                                 const CheckOptions& options);

}  // namespace delone::tiles
