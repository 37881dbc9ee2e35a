// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <delone/tiles.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace delone::tiles {

/// delone::check_tiles() with about `memory` bytes besides those of one part; 0: as many as the largest part
/// has, and 64 MiB at least.
CheckReport check_tiles(const std::string& folder, const CheckOptions& options, unsigned threads,
                        std::uint64_t memory, std::optional<PointsView> input = std::nullopt);

}  // namespace delone::tiles
