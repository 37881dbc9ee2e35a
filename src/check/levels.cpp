// SPDX-License-Identifier: BSD-3-Clause
#include "check/levels.hpp"

#include "base/axis_scale.hpp"

#include <algorithm>
#include <ostream>
#include <string>

namespace delone {

void internal::check_axis_tolerances(double tolerance, std::span<const double> of_axes, int dimension) {
  if (of_axes.empty()) return;
  try {
    const AxisScale scale(tolerance, of_axes, dimension);
    if (scale.tolerance() == tolerance && std::ranges::equal(scale.tolerances(), of_axes)) return;
  } catch (const Error& error) {
    throw Violation{std::string("the tolerances of the axes: ") + error.what()};
  }
  throw Violation{"the tolerances of the axes are not the tolerance divided by powers of two"};
}

template <PlainData Data>
std::span<const CheckLevel> check_levels() {
  return internal::levels_of<Data>;
}
template std::span<const CheckLevel> check_levels<ComplexData>();
template std::span<const CheckLevel> check_levels<HullData>();
template std::span<const CheckLevel> check_levels<IntersectionData>();
template std::span<const CheckLevel> check_levels<VoronoiData>();

std::ostream& operator<<(std::ostream& out, const CheckReport& report) {
  std::string text = report.ok ? "ok up to level " : "violation at level ";
  text += std::to_string(report.reached.number);
  text.append(", ").append(report.reached.name);
  if (!report.ok) text += ": " + report.violation;
  if (!report.not_examined.empty()) text += "; not examined: " + report.not_examined;
  return out << text;
}

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
    case DataKind::periodic_delaunay:
    case DataKind::periodic_regular:
      return internal::levels_of_periodic;
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
