// SPDX-License-Identifier: BSD-3-Clause
// A cell on one side of a facet, as seen from a query point: what a new cell over that facet is made from.
#pragma once

#include <delone/types.hpp>

namespace delone {

struct FacetSide {
  Index cell;      ///< its slot
  double value;    ///< the value of its functional at the query point
  Index opposite;  ///< its vertex opposite the facet
};

}  // namespace delone
