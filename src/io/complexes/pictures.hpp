// SPDX-License-Identifier: BSD-3-Clause
// The formats of one kind of data only: pictures and meshes. The data have been validated; the caller commits
// the file.
#pragma once

#include <delone/data.hpp>
#include <delone/voronoi.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace delone::io {

class AtomicFile;

/// OFF for d = 3, nOFF otherwise.
void write_off(AtomicFile& file, const ComplexData& data);
/// A bounded intersection in space: facets as polygons. Throws unsupported for others.
void write_off(AtomicFile& file, const IntersectionData& data);
/// Simplices for VTK: of points of their own, and of an unstructured grid of many pieces.
template <class Id>
struct VtuSimplices {
  int dimension = 0, affine_dimension = -1;
  std::span<const double> points;            ///< d coordinates each
  std::span<const Id> cells;                 ///< k+1 numbers of points each
  std::span<const std::int64_t> rows = {};   ///< point data "row", if there are any
  std::optional<std::int64_t> first_cell{};  ///< cell data "cell": numbers from this one on
  DataKind kind = DataKind::unknown;         ///< for a comment
};
/// VTK's XML format for unstructured grids, arrays appended as raw bytes. Throws unsupported for d > 3.
template <class Id>
void write_vtu(AtomicFile& file, const VtuSimplices<Id>& simplices);
void write_vtu(AtomicFile& file, const ComplexData& data);
/// The regions clipped to the box. Throws unsupported unless d = 2 or 3.
void write_vtu(AtomicFile& file, const Diagram& diagram, const Box& box);
/// Binary little-endian PLY: points, and segments or triangles; of tetrahedra the boundary. Throws
/// unsupported for d > 3, and invalid_argument for tetrahedra without neighbors.
void write_ply(AtomicFile& file, const ComplexData& data);
/// Throws unsupported unless d = 2.
void write_svg(AtomicFile& file, const ComplexData& data);
void write_svg(AtomicFile& file, const Diagram& diagram, const Box& box);

}  // namespace delone::io
