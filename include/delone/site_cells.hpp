// SPDX-License-Identifier: BSD-3-Clause
// Volumes, centroids, surfaces, neighbors and polygons of the cells of a Voronoi or power diagram, from the
// triangulation alone: no diagram is made.
#pragma once

#include <delone/data.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace delone {

class PeriodicTriangulation;

/// Which faces of a cell count.
enum class CellFaces : std::uint8_t {
  /// One for each edge of the triangulation at the site. Where more than k+1 sites have one empty sphere,
  /// some
  /// have no area: which ones, the triangulation says.
  triangulated,
  /// Those of dimension k−1, decided exactly. They do not depend on how ties of the triangulation were
  /// decided.
  proper,
};

/// What site_cells() finds.
struct SiteCellsOptions {
  CellFaces faces = CellFaces::triangulated;
  /// Whether neighbors, areas of faces and distances are listed.
  bool neighbors = false;
  /// Whether vertices are listed, and those of each face in order. Neighbors are listed as well.
  bool vertices = false;
  /// Cells are clipped to this box.
  std::optional<Box> box = std::nullopt;
  /// With a box: cells are clipped to these halfspaces a·x + c ≤ 0 as well, rows of d + 1 numbers a, c.
  std::vector<double> halfspaces = {};
};

/// The cells of sites: those of a Voronoi diagram, with weights those of a power diagram. Arrays have one
/// entry for each input row. The cell of a site belongs to the first row there; a row without a cell (hidden,
/// removed, or a duplicate of an earlier one) has volume, area and number of faces 0, centroid NaN and no
/// neighbors.
struct DELONE_EXPORT_TYPE SiteCells {
  int dimension = 1;                   ///< d
  int rank = 0;                        ///< of a periodic set: r, the number of its lattice vectors
  std::vector<double> volumes;         ///< n; infinity for unbounded cells
  std::vector<double> centroids;       ///< n×d; NaN for unbounded cells
  std::vector<double> areas;           ///< n, of the surface of each cell; infinity for unbounded cells
  std::vector<SignedIndex> num_faces;  ///< n; walls count, see below

  /// If neighbors are wanted: those of row i are entries neighbor_offsets[i] … neighbor_offsets[i+1]−1 of the
  /// arrays below, in increasing order. Walls, the faces on the boundary of the box or a halfspace, come
  /// last, as neighbor −1.
  std::vector<std::int64_t> neighbor_offsets;
  std::vector<SignedIndex> neighbors;  ///< the row of the site on the other side of each face
  std::vector<double> face_areas;      ///< (k−1)-volumes; infinity for unbounded faces
  std::vector<double> distances;       ///< from the site to this neighbor; from the plane of a wall
  std::vector<SignedIndex>
      num_edges;  ///< of each face, the two rays of an unbounded one included; k = 3 only
  /// Of a periodic set, r integers for each neighbor: it is the point of that row, where it was given, plus
  /// Σ_j neighbor_lattice[i·r + j] · lattice vector j. Neighbors of one row are in lexicographic order of
  /// these. A row may occur several times, also that of the cell itself.
  std::vector<std::int32_t> neighbor_lattice;

  /// If vertices are wanted: those of the cell of row i are vertex_offsets[i] … vertex_offsets[i+1]−1, in
  /// lexicographic order of their coordinates. There is one for each finite cell of the triangulation at the
  /// site; with proper faces, one for each empty sphere. It is the center of the sphere, correctly rounded,
  /// as in Diagram. A cell that a box or halfspaces cut has one for each set of d faces that meet; with
  /// proper faces, one for each point where they do. It is correctly rounded as well, so a vertex is the same
  /// to the last bit in all cells that have it. Of a periodic set, vertices lie around the point where it was
  /// given, so that cells across the border are whole.
  std::vector<std::int64_t> vertex_offsets;
  std::vector<double> vertices;  ///< d coordinates each
  /// The vertices of face i, an entry of `neighbors`, are entries face_vertex_offsets[i] …
  /// face_vertex_offsets[i+1]−1 of face_vertices: numbers from 0 on among the vertices of its cell, and −1
  /// for infinity, where an unbounded face has its two rays (k = 2: its one).
  ///   k = 3: in order around the face, counterclockwise seen from the neighbor or from beyond the wall, from
  ///          −1 or the least on; there are num_edges[i].
  ///   k = 2: its two ends; counterclockwise around the site, −1 for a ray.
  ///   else:  increasing.
  /// In a flat, counterclockwise is meant of the coordinates along Triangulation::axes().
  std::vector<std::int64_t> face_vertex_offsets;
  std::vector<SignedIndex> face_vertices;

  std::size_t num_rows() const { return volumes.size(); }
};

/// The cells of the sites of a Delaunay or regular triangulation. Sites that span only a k-flat have their
/// cells inside the flat, as in Diagram; with a box, cells are those of R^d.
///
/// A cell is the sum of signed pieces: simplices from the site over its faces of all dimensions to a center
/// of a cell of the triangulation (docs/tasks/cells.md). A volume is off by at most 10⁻¹² times the sum of
/// the absolute values of its pieces, as long as it is in the range of normal numbers: where rounding errors
/// may be larger, pieces come from wider arithmetic. In a box this holds for the cells that lie inside;
/// others are cut, as by Diagram::region_volumes().
///
/// No result depends on the number of threads or the order of insertion, to the last bit. Cost: time and
/// memory O(m·2^k·k²) and O(output) for m cells of the triangulation, and what cells outside of the box cost.
/// Throws Errc::invalid_argument (a furthest-site triangulation; a box or halfspaces as described for
/// Diagram::clipped_regions(), halfspaces without a box), unsupported (k > 12), cancelled,
/// out_of_memory.
DELONE_EXPORT SiteCells site_cells(const Triangulation& triangulation, const SiteCellsOptions& options = {},
                                   const Execution& how = {});

/// The cells of the points of a periodic set: of each class of translates, the cell around the point where it
/// was given. So centroids may lie outside of the box, and where the set is periodic along all directions
/// volumes add up to that of the box. Lengths are those of the points on the grid; see
/// PeriodicTriangulation::displacement(). Where it is not periodic, cells at its hull are unbounded.
///
/// Accuracy, bits and cost are those of the cells of a triangulation. Throws as above; Errc::unsupported also
/// for a box, and for offsets that do not fit into 32 bits.
DELONE_EXPORT SiteCells site_cells(const PeriodicTriangulation& triangulation,
                                   const SiteCellsOptions& options = {}, const Execution& how = {});

/// Writes cells of sites:
///   npz   the arrays
///   csv   a row for each row of the points: volume, area, num_faces and the centroid, without neighbors; standard
///         output
/// Throws as all writers (io.hpp).
DELONE_EXPORT void write(const std::string& path, const SiteCells& cells, const std::string& format = {});

}  // namespace delone
