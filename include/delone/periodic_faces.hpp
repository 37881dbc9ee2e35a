// SPDX-License-Identifier: BSD-3-Clause
// Faces of periodic triangulations, each once per period, and their alpha values.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/periodic.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone {

/// The n faces of one dimension j, one of each class of translates, sorted by rows and then offsets. Cells
/// are in the order of PeriodicTriangulation::cells(). The result does not depend on the number of threads.
struct DELONE_EXPORT_TYPE PeriodicFaces {
  int dimension = 0;  ///< j
  int rank = 0;       ///< r
  std::vector<SignedIndex>
      vertices;  ///< n×(j+1) rows; cells as in cells(), others increasing by row and offset
  /// n×(j+1)×r: how the vertices are translated. 0 for the lexicographically smallest vertex of a face.
  std::vector<std::int32_t> offsets;
  std::vector<unsigned char> on_hull;  ///< n: 1 if the face is outside, where r < k

  std::size_t size() const { return on_hull.size(); }
};

/// All faces of dimension j: for j = 0 the vertices, for j = k the cells, and none for k < j ≤ d. Throws
/// Errc::invalid_argument (j < 0 or j > d), unsupported (k > 63, or offsets beyond 32 bits), too_many,
/// out_of_memory, cancelled. Cost: that of the faces of the points in the box and their images.
DELONE_EXPORT PeriodicFaces faces(const PeriodicTriangulation& triangulation, int j,
                                  const Execution& how = {});

/// The alpha values of the faces of one dimension: see FaceValues. A face is in the alpha complex of the
/// whole periodic set if and only if alpha² is at least its value. With PeriodicOptions::unit the values are
/// rounded once more.
struct DELONE_EXPORT_TYPE PeriodicFaceValues {
  PeriodicFaces faces;
  std::vector<double> values;  ///< one per face
};

/// The faces of dimension j and their alpha values. Throws and costs as alpha_values() of the points in the
/// box and their images.
DELONE_EXPORT PeriodicFaceValues alpha_values(const PeriodicTriangulation& triangulation, int j,
                                              const Execution& how = {});

}  // namespace delone
