// SPDX-License-Identifier: BSD-3-Clause
// Seams of all parts, matched by all ranks.
#pragma once

#include "owned_pages.hpp"
#include "ranks.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace delone::mpi {

/// As tiles::match_seams(), by all ranks: each has the facets of some hashes, and calls write(t, cells) for
/// its tiles. In memory: what a rank holds is as large as the seams of its tiles. Collective.
std::int64_t match_seams(const std::string& work, std::span<const std::int64_t> first_cell,
                         const TileOwners& owners, Ranks& ranks,
                         const std::function<void(std::size_t, std::span<const std::int64_t>)>& write);

}  // namespace delone::mpi
