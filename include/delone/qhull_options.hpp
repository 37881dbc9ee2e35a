// SPDX-License-Identifier: BSD-3-Clause
// What a text of Qhull's options asks for: for functions that replace those that run Qhull.
#pragma once

#include <delone/export.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace delone {

/// What the options are given to.
enum class QhullProgram { delaunay, voronoi, hull, halfspaces };

/// What those options of Qhull ask for that have a meaning here. The others are about rounding errors,
/// memory, the order of work, or what Qhull's programs print; no result depends on them.
struct QhullOptions {
  bool scaled = false;         ///< Qbb of triangulations and diagrams: scale the height of the paraboloid
  bool last_in_box = false;    ///< Qbb of the others: tolerances count where the last column is scaled to
                               ///< [0, the largest number of the others]
  bool in_cube = false;        ///< QbB: tolerances count where all columns are scaled to [-0.5, 0.5]
  bool at_infinity = false;    ///< Qz of triangulations and diagrams: a point above the paraboloid
  bool keep_coplanar = false;  ///< Qc: rows that are no vertex are listed
  bool furthest_site = false;  ///< Qu of triangulations and diagrams
  bool joggled = false;        ///< QJ: flat input has results
  bool unmerged = false;       ///< Q0, QJ: the default of tolerances is 0
  bool good_visible = true;    ///< QGn: the facets that a row sees; QG-n: those that it does not see
  std::optional<std::uint64_t> good_row = std::nullopt;  ///< that row, from 0; of hulls alone
  double centrum = 0;  ///< Cn, C-n: added to the round-off of a distance; the larger of both
  std::optional<double> roundoff = std::nullopt;  ///< En: takes the place of the round-off of a distance
  double width = 0;                               ///< Wn: the least tolerance
};

/// What options, separated by blanks, mean. Throws Errc::unsupported, with the name of the option and the
/// reason, for an option that asks for a result that delone does not have, or that Qhull does not know.
DELONE_EXPORT QhullOptions parse_qhull_options(std::string_view text, QhullProgram program);

}  // namespace delone
