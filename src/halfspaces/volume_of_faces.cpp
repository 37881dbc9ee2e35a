// SPDX-License-Identifier: BSD-3-Clause
// The cells of the boundary of the dual cone are the corners of a simple polytope, whose facets are the
// sites: where more than d hyperplanes meet, several corners are at one place.
#include "halfspaces/halfspace_cone.hpp"
#include "halfspaces/halfspace_vertex.hpp"
#include "halfspaces/intersection_arrays.hpp"
#include "solve/simple_polytope.hpp"

#include <vector>

namespace delone::halfspaces {

double volume_of_faces(const IntersectionParts& parts) {
  if (parts.state != IntersectionState::full || !parts.cone) return 0;
  const SimplicialHull hull = parts.cone->make_hull();
  const std::size_t d = hull.corners();
  std::vector<const double*> rows;
  for (const Index site : hull.cells) rows.push_back(parts.sites.point(site));
  const std::vector<double> corners = meeting_points(rows, parts.sites.axes);
  solve::SimplePolytope polytope;
  polytope.start(d, d);
  std::vector<std::size_t> labels(d);
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    const auto cell = hull.cell(c);
    labels.assign(cell.begin(), cell.end());
    polytope.add_corner(corners.data() + c * d, labels);
  }
  return polytope.volume();
}

}  // namespace delone::halfspaces
