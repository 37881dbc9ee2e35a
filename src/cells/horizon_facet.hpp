// SPDX-License-Identifier: BSD-3-Clause
// A facet between a cell in conflict with a query point and one that is not. A new cell is made from it.
#pragma once

#include <delone/types.hpp>

namespace delone::cells {

struct HorizonFacet {
  double dead_value;      ///< h̃(q) of the cell in conflict
  double survivor_value;  ///< h̃(q) of the cell that is not
  Index dead;  ///< at first the number of the cell in conflict in the zone, later its id, which a new cell
               ///< may have by now
  Index survivor;           ///< the cell that is not
  Index created;            ///< the cell that joins q to the facet
  Index dead_opposite;      ///< the dead cell's vertex opposite the facet
  Index survivor_opposite;  ///< the survivor's vertex opposite the facet
  int slot;                 ///< of the facet in the dead cell, and of q in the new one
};

}  // namespace delone::cells
