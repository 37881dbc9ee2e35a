// SPDX-License-Identifier: BSD-3-Clause
// The faces of one dimension of a triangulation, as arrays.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone {

/// Faces of one dimension j: n of them, each once. Their order depends on the order of cells and vertices
/// only (Triangulation::sort_cells()), not on the number of threads, and is the same in all lists of faces of
/// dimension j. Cells are in the order of Triangulation::to_data(), vertices in that of their rows.
struct DELONE_EXPORT_TYPE Faces {
  int dimension = 0;                   ///< j
  std::vector<SignedIndex> vertices;   ///< n×(j+1) point rows; cells as in to_data(), others increasing
  std::vector<SignedIndex> cells;      ///< n: a cell that contains the face, a row of to_data().cells
  std::vector<unsigned char> on_hull;  ///< n: 1 if the face lies in the boundary of the hull

  std::size_t size() const { return cells.size(); }
  std::span<const SignedIndex> face(std::size_t i) const {
    const std::size_t corners = static_cast<std::size_t>(dimension) + 1;
    return std::span(vertices).subspan(i * corners, corners);
  }
};

/// All finite faces of dimension j. j = 0: the vertices; j = k: the finite cells; none for k < j ≤ d, which
/// needs flat points. Throws Errc::invalid_argument (j < 0 or j > d), unsupported (k > 63), too_many,
/// out_of_memory, cancelled. Cost: O(m·k) for facets of m cells, j = k−1; otherwise that of finding the faces
/// of all dimensions from j on, O(Σ_i n_i·i²) if there are n_i of dimension i.
DELONE_EXPORT Faces faces(const Triangulation& triangulation, int j, const Execution& how = {});

}  // namespace delone
