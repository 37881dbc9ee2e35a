// SPDX-License-Identifier: BSD-3-Clause
// Readers of points and readers and writers of triangulations. Every error is a delone::Error that names file
// and place.
#pragma once

#include <delone/complex.hpp>
#include <delone/convex_hull.hpp>
#include <delone/halfspaces.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace delone {

/// Points as read from a file.
struct PointTable {
  int dimension = 0;
  std::vector<double> coordinates;        ///< n×d, row-major
  std::vector<std::string> column_names;  ///< of a CSV/TSV/PLY header, after selection; may be empty
  std::size_t num_points() const {
    return dimension < 1 ? 0 : coordinates.size() / static_cast<std::size_t>(dimension);
  }
};

struct ReadOptions {
  std::string format;  ///< "npy", "csv", "tsv", "txt", "xyz", "pts", "off", "ply", "qhull"; empty: by
                       ///< extension, "-" is qhull
  std::vector<std::string>
      columns;  ///< csv, tsv, txt: names, or 0-based numbers where there is no header; empty: all
};

/// Reads points from a file, or from standard input when the path is "-". Values must be finite.
///   npy          2-D (n,d) or 1-D (n,) arrays of float32/64 and (u)int8…64, C or Fortran order, either byte
///                order; integers must be exact in binary64
///   csv tsv      optional header line (recognised when a field of the first line is not a number), '#'
///                comments, quotes
///   txt xyz pts  white space separated rows of coordinates, '#' comments; the leading count and comment
///                line of the chemists' xyz format are not supported
///   off          OFF / nOFF / COFF vertices
///   ply          ascii and binary, the properties x, y, z
///   qhull        dimension, count, rows (rbox's output; the rest of the first line is a comment)
/// Errors: cannot_open; bad_format with "FILE:LINE: …" or "FILE: row N: …"; not_finite with rows();
/// bad_dimension for dimension 0; unsupported; out_of_memory.
PointTable read_points(const std::string& path, const ReadOptions& options = {});

/// Writes a triangulation; the format is `format` or the extension of the path:
///   npz   points (n,d) float64, cells (m,k+1), neighbors (m,k+1), vertex_of_point (n,), affine_dimension ();
///         stored, readable by numpy.load
///   vtu   k ≤ 3 and d ≤ 3 (padded with zeros): vertices, segments, triangles or tetrahedra, for ParaView
///   off   OFF for d = 3, nOFF otherwise; cells as index lists
///   json  the same members as npz
///   svg   d = 2: a picture
///   txt   Qhull's `i` form: number of cells, then one line of point rows per cell
///   npy   the cells array only
/// The file appears whole or not at all (written beside, then renamed). "-" is standard output, for the text
/// formats; txt unless `format` says otherwise. Errors: cannot_write, unsupported; invalid_argument where the
/// arrays disagree.
void write_complex(const std::string& path, const ComplexData& data, const std::string& format = {});

/// Writes a convex hull (with its points), in the formats of write_complex(). npz and json hold the arrays of
/// HullData, kinds of points as numbers 0 … 3 in the order of PointKind; the other formats hold the cells, as
/// a triangulation of dimension k−1. Errors as write_complex().
void write_hull(const std::string& path, const HullData& data, const std::string& format = {});

/// Reads a triangulation back: npz (ours; also any .npz with `points` and `cells` or `simplices`), json,
/// off/nOFF.
ComplexData read_complex(const std::string& path, const std::string& format = {});

/// Reads a hull back that write_hull() wrote as npz or json. The shapes of all arrays are checked;
/// check_hull() examines what they hold.
HullData read_hull(const std::string& path, const std::string& format = {});

/// Reads whichever a file holds: a hull if it has the array facet_of_cell, an intersection of halfspaces if
/// it has first_of_halfspace, else a triangulation.
std::variant<ComplexData, HullData, IntersectionData> read_any(const std::string& path,
                                                               const std::string& format = {});

/// Writes points as .npy, .csv, .tsv, .txt/.xyz/.pts, .off, or qhull form ("-" is standard output), by
/// extension or `format`.
void write_points(const std::string& path, const PointTable& points, const std::string& format = {});

}  // namespace delone
