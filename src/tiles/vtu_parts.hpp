// SPDX-License-Identifier: BSD-3-Clause
// The parts of a folder as ParaView opens them: part-0000.vtu and so on, and tiles.pvtu, which names them.
#pragma once

#include <delone/tiles.hpp>

#include <string>

namespace delone::tiles {

/// Throws unsupported for d > 3: call it before the work begins, too.
void require_vtu(const std::string& folder, int dimension);

/// Reads the parts, one after the other, and writes a .vtu for each: points with the rows of the input
/// ("row"), cells with their global ids ("cell"). Then writes tiles.pvtu.
void write_vtu_parts(const std::string& folder, const TilesIndex& index);

}  // namespace delone::tiles
