// SPDX-License-Identifier: BSD-3-Clause
// Seams of all parts, matched by all ranks.
#pragma once

#include "owned_pages.hpp"
#include "ranks.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace delone::mpi {

/// As tiles::match_seams(), by all ranks: each has the facets of some hashes, and writes the seams of its
/// tiles. In memory: what a rank holds is as large as the seams of its tiles. Collective.
std::int64_t match_seams(const std::string& folder, const std::string& work,
                         std::span<const std::int64_t> first_cell, const TileOwners& owners, Ranks& ranks);

}  // namespace delone::mpi
