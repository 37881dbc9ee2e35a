// SPDX-License-Identifier: BSD-3-Clause
// A cell with open facets, beyond which geometry/ searches while engine/ wraps a set of points.
#pragma once

#include <delone/types.hpp>

#include <cstdint>

namespace delone {

struct OpenCell {
  const Index* vertices;
  std::uint32_t open_slots;  ///< bit i: the facet opposite vertex i is open
};

}  // namespace delone
