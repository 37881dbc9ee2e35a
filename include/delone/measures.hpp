// SPDX-License-Identifier: BSD-3-Clause
// Measures of the finite cells of a triangulation: circumscribed spheres and quality.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/faces.hpp>
#include <delone/triangulation.hpp>

#include <cstdint>
#include <vector>

namespace delone {

/// The radius of the sphere through the vertices of each finite cell, in the order of to_data(); weights are
/// ignored. For k = 0: 0. The relative error is certified to be at most 2⁻⁵² (below the normal numbers: two
/// of the smallest double), +infinity beyond the range of doubles. Throws Errc::out_of_memory, cancelled.
/// Cost: O(m·k³) for m cells.
DELONE_EXPORT std::vector<double> circumradii(const Triangulation& triangulation, const Execution& how = {});

/// The centers of these spheres, m×d: each coordinate is the double nearest to the exact one (±infinity
/// beyond the range of doubles). Cells with a common sphere have equal centers. Cost and errors as for
/// circumradii().
DELONE_EXPORT std::vector<double> circumcenters(const Triangulation& triangulation,
                                                const Execution& how = {});

/// How good a cell is. R is the radius of the sphere through its vertices, r that of the inscribed sphere, V
/// the volume, l the lengths of its edges; all are those of a k-simplex. None depends on the scale.
enum class QualityMeasure : std::uint8_t {
  /// k·r/R: 1 for the regular simplex, towards 0 for flat ones; in (0, 1]. Liu and Joe, "Relationship between
  /// tetrahedron shape measures", doi:10.1007/BF01955874.
  radius_ratio,
  /// k(k+1)/2·(V/V₁)^(2/k)/Σl², V₁ the volume of the regular simplex with edges of length 1; for triangles
  /// 4√3·V/Σl², for tetrahedra 12(3V)^(2/3)/Σl². 1 for the regular simplex, towards 0 for flat ones; in (0,
  /// 1]. Same source.
  mean_ratio,
  /// R over the shortest edge; at least √(k/(2k+2)), that of the regular simplex. Slivers, too, can be close
  /// to that. Shewchuk, "Tetrahedral mesh generation by Delaunay refinement", doi:10.1145/276884.276894.
  radius_edge_ratio,
};

/// The quality of each finite cell, in the order of to_data(); 1 for k = 0. The relative error is certified
/// to be below 10⁻⁹ at any scale, from bounds in binary64, in pairs of doubles or, for the thinnest cells,
/// from integers; a ratio that is itself below the normal numbers may be 0, one beyond the range of doubles
/// is +infinity. Throws Errc::out_of_memory, cancelled. Cost: O(m·k³) for m cells.
DELONE_EXPORT std::vector<double> qualities(const Triangulation& triangulation, QualityMeasure measure,
                                            const Execution& how = {});

}  // namespace delone
