// SPDX-License-Identifier: BSD-3-Clause
// What engine/ asks of geometry/ while it wraps a set of points: which facets of a cell have no neighbor yet.
#pragma once

#include <delone/types.hpp>

#include <cstdint>

namespace delone {

struct OpenCell {
  const Index* vertices;
  std::uint32_t open_slots;  ///< bit i: the facet opposite vertex i is open
};

}  // namespace delone
