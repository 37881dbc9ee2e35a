// SPDX-License-Identifier: BSD-3-Clause
// The shape of an alpha complex, the union of its cells: closed surfaces around it, polygons in the plane,
// and the least radius at which it covers all points. Singular faces, which are in no cell, do not belong to
// it: it is what the field calls the regularised alpha shape.
#pragma once

#include <delone/alpha.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace delone {

/// How the facets of AlphaComplex::boundary() make closed surfaces. Around a face of dimension k−2 there may
/// be more than two of them: those are neighbors that enclose the same cells of the complex there. So the
/// neighbors across a facet's faces are mutual, and pieces that only touch are not joined. A *component*
/// consists of all facets that neighbors connect: in space a surface in which two triangles meet at each
/// edge, all of them oriented outward. A *body* consists of all cells that common facets connect. It has one
/// component around it, and others around its cavities, unless these touch the outside in an edge.
struct DELONE_EXPORT_TYPE BoundaryComponents {
  std::vector<SignedIndex> neighbors;   ///< b×k: the facet across the face opposite vertex i
  std::vector<SignedIndex> components;  ///< b: the component of each facet, numbered by their first facets
  std::vector<SignedIndex> bodies;      ///< the body of each component, numbered by their first cells

  std::size_t num_components() const { return bodies.size(); }
};

/// Decided by the cells alone, so exact; for every k. Throws Errc::out_of_memory, cancelled. Cost: O(m·k²)
/// for m cells of the complex, and a copy of the triangulation.
DELONE_EXPORT BoundaryComponents boundary_components(const AlphaComplex& complex, const Execution& how = {});

/// Polygons in the plane. Each is a connected set with an outer ring, counterclockwise, and a clockwise ring
/// around each of its holes. Ring i is rows[ring_offsets[i]] … rows[ring_offsets[i+1]−1], without repeating
/// the first. The rings of polygon i are polygon_offsets[i] … polygon_offsets[i+1]−1, the outer one first.
struct DELONE_EXPORT_TYPE Polygons {
  std::vector<SignedIndex> rows;
  std::vector<std::int64_t> ring_offsets{0}, polygon_offsets{0};

  std::size_t size() const { return polygon_offsets.size() - 1; }
  std::size_t num_rings() const { return ring_offsets.size() - 1; }
  std::span<const SignedIndex> ring(std::size_t i) const {
    return std::span(rows).subspan(static_cast<std::size_t>(ring_offsets[i]),
                                   static_cast<std::size_t>(ring_offsets[i + 1] - ring_offsets[i]));
  }
};

/// The union of the triangles of a complex in the plane. Each polygon is the union of the triangles that
/// common edges connect. No ring visits a point twice: a polygon that touches itself in a point has a hole
/// there, and polygons that touch each other are apart. Two rings of a polygon have finitely many points in
/// common. So the polygons are valid in the sense of the Simple Features of the Open Geospatial Consortium.
/// Each ring begins with its least row; polygons, and the holes of each, are in the order of these rows. So
/// the result does not depend on the order of cells. None if the points are collinear.
///
/// Exact: orientations are decided by orientation(). Throws Errc::unsupported (d ≠ 2), out_of_memory,
/// cancelled. Cost: O(m + b·log b) for m triangles and b edges of the boundary, and a copy of the
/// triangulation.
DELONE_EXPORT Polygons polygons(const AlphaComplex& complex, const Execution& how = {});

/// The least double s for which the alpha complex of the squared radius s
/// - has each vertex of the triangulation in a cell, and
/// - unless `num_components` is nullopt, has at most so many bodies: sets of cells that common facets
/// connect. This is the optimal alpha of Edelsbrunner's "alpha shapes" as CGAL has it. A larger s may give
/// more bodies again, as a cell may come before its neighbors. −infinity without points. Hidden points do not
/// matter.
///
/// Exact, as alpha values are. Throws as alpha_values(); Errc::invalid_argument for 0 components. Cost: that
/// of the alpha values of cells, and O(m·log m) for m cells.
DELONE_EXPORT double optimal_alpha_value(const Triangulation& triangulation,
                                         std::optional<std::size_t> num_components = 1,
                                         const Execution& how = {});

}  // namespace delone
