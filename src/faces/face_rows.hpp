// SPDX-License-Identifier: BSD-3-Clause
// Levels of faces as users see them: by rows of the input.
#pragma once

#include "faces/face_level.hpp"

#include <delone/faces.hpp>
#include <delone/triangulation.hpp>

#include <vector>

namespace delone::internal {

/// Throws Errc::invalid_argument unless 0 ≤ j ≤ d.
void require_face_dimension(const Triangulation& triangulation, int j);

/// Throws Errc::unsupported for a triangulation without an alpha complex.
void require_alpha(const Triangulation& triangulation);

/// The first row at each vertex, by id; −1 where there is none.
std::vector<SignedIndex> rows_of_vertices(const Triangulation& triangulation);

/// The faces of a level that have a mark, or all if there are no marks; vertices of dimension 0 in the order
/// of rows, with `values` in step. Takes what the level holds. `j`: where the level is that of no face.
Faces faces_by_rows(const Triangulation& triangulation, FaceLevel level, int j, unsigned threads,
                    const std::vector<unsigned char>& marks = {}, std::vector<double>* values = nullptr);

}  // namespace delone::internal
