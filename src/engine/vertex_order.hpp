// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <delone/types.hpp>

#include <span>

namespace delone::engine {

/// What is known of the vertices that cells have, for sorting these (sort_cells.hpp).
struct VertexOrder {
  Index size;  ///< all ids are before it, or places if there are any
  /// Some may be those of no vertex. Which ones does not matter then.
  bool has_gaps = false;
  std::span<const Index> places = {};  ///< by id, those in the order of insertion
};

}  // namespace delone::engine
