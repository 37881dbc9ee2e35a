// SPDX-License-Identifier: BSD-3-Clause
#include "check/levels.hpp"

namespace delone {

template <PlainData Data>
std::span<const CheckLevel> check_levels() {
  return internal::levels_of<Data>;
}
template std::span<const CheckLevel> check_levels<ComplexData>();
template std::span<const CheckLevel> check_levels<HullData>();
template std::span<const CheckLevel> check_levels<IntersectionData>();
template std::span<const CheckLevel> check_levels<VoronoiData>();

std::span<const CheckLevel> check_levels(DataKind kind) {
  switch (kind) {
    case DataKind::unknown:
    case DataKind::delaunay:
    case DataKind::regular:
      return check_levels<ComplexData>();
    case DataKind::furthest_site:
      return internal::levels_of_furthest_site;
    case DataKind::alpha_complex:
    case DataKind::trimmed:
      return internal::levels_of_part;
    case DataKind::alpha_boundary:
      return internal::levels_of_boundary;
    case DataKind::lower_hull:
      return internal::levels_of_lower_hull;
    case DataKind::upper_hull:
      return internal::levels_of_upper_hull;
    case DataKind::hull_boundary:
    case DataKind::convex_hull:
      return check_levels<HullData>();
    case DataKind::halfspace_intersection:
      return check_levels<IntersectionData>();
    case DataKind::voronoi:
    case DataKind::power_diagram:
    case DataKind::furthest_voronoi:
      break;
  }
  return check_levels<VoronoiData>();
}

}  // namespace delone
