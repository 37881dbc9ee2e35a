// SPDX-License-Identifier: BSD-3-Clause
// A facet between a cell in conflict with a query point and one that is not: what a new cell is made from.
#pragma once

#include <delone/types.hpp>

namespace delone {

struct HorizonFacet {
  double dead_value;      ///< h̃(q) of the cell in conflict
  double survivor_value;  ///< h̃(q) of the cell that is not
  Index dead;  ///< the cell in conflict, whose slot may be another's by now; at first its place in the zone
  Index survivor;           ///< the cell that is not
  Index created;            ///< the cell that joins q to the facet
  Index dead_opposite;      ///< the dead cell's vertex opposite the facet
  Index survivor_opposite;  ///< the survivor's vertex opposite the facet
  int slot;                 ///< the facet's in the dead cell, and that of q in the new one
};

}  // namespace delone
