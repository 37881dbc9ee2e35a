// SPDX-License-Identifier: BSD-3-Clause
// Readers and writers of points, triangulations, convex hulls, intersections of halfspaces, Voronoi and power
// diagrams. Every error is a delone::Error that names file and place; docs/formats.md has the arrays.
//
// A path "-" is standard input or output. `format` names the format; if it is empty, the extension of the
// path does. A file that is written appears whole or not at all (written beside, then renamed); symbolic
// links are written through. Every function may throw unsupported (the format) and out_of_memory; readers
// cannot_open and bad_format; writers cannot_write.
//
// Files compressed by gzip are recognized by their first bytes and read as if they were not compressed; `.gz`
// may follow the extension. Damaged ones are bad_format; a build without zlib throws unsupported.
//
// Input is bounded: a file is refused as soon as its first bytes contradict its format, and a stream with
// more bytes than a limit throws out_of_memory. Streams are everything but regular files (pipes, devices),
// the contents of compressed files, and what is appended to a regular file after it was opened.
#pragma once

#include <delone/data.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace delone {

class Diagram;
class HalfspaceIntersectionBase;
class ConvexHullBase;
class Triangulation;

/// Points as read from a file.
struct PointTable {
  int dimension = 0;
  std::vector<double> coordinates;            ///< n×d, row-major
  std::vector<std::string> column_names;      ///< of a CSV/TSV/PLY header, after selection; may be empty
  int num_values = 0;                         ///< m, the number of columns that ReadOptions::values selects
  std::vector<double> values = {};            ///< n×m, row-major
  std::vector<std::string> value_names = {};  ///< as column_names
  /// The rows of the file that ReadOptions::skip_missing has left out, increasing. The others are points
  /// 0, 1, 2 …, and rows are numbered as in errors: without a header, blank lines and comments.
  std::vector<std::size_t> skipped_rows = {};
  std::size_t num_points() const {
    return dimension < 1 ? 0 : coordinates.size() / static_cast<std::size_t>(dimension);
  }
};

/// The most bytes that are read from a stream by default: 4 GiB.
inline constexpr std::uint64_t default_max_stream_bytes = std::uint64_t{1} << 32;

struct ReadOptions {
  std::string format;  ///< one of those of read_points(); empty: by extension, "-" is qhull
  /// The columns with the coordinates: names in a header, numbers from 0, or ranges of numbers such as "2-5",
  /// both ends included. A name takes precedence over a number; "5-5" always means the number 5. ply: names
  /// of properties. Empty: all columns (of ply: x, y and z) except those of `values`.
  std::vector<std::string> columns;
  std::uint64_t max_stream_bytes = default_max_stream_bytes;
  /// Columns that are not coordinates, chosen in the same way: for PointTable::values.
  std::vector<std::string> values = {};
  /// Leave out rows with a missing value in a column that is read; otherwise they are refused. Missing are
  /// NaN, blank fields, and in text, in any case: - NA N/A #N/A #NA <NA> NaN NULL None, and some more of
  /// pandas (docs/formats.md).
  bool skip_missing = false;
};

/// Reads points. Values must be finite.
///   npy          2-D (n,d) or 1-D (n,) arrays of float32/64 and (u)int8…64, C or Fortran order, either byte
///                order; integers must be exact in binary64
///   csv tsv      optional header line (recognised when a field of the first line is not a number), '#'
///                comments, quotes
///   txt xyz pts  white space separated rows of coordinates, '#' comments
///   xyz          also that of chemists: a count, a comment, then an element, x, y, z per line; the elements,
///                and what follows z, are ignored; one frame
///   off          OFF / nOFF / COFF vertices
///   ply          ascii and binary, the properties x, y, z
///   pdb          x, y, z of the lines ATOM and HETATM; one model
///   las          x, y, z of LAS 1.0 to 1.4
///   qhull        dimension, count, rows (rbox's output; the rest of the first line is a comment)
/// Throws Errc::bad_format with "FILE:LINE: …" or "FILE: row N: …"; not_finite with rows(); bad_dimension for
/// dimension 0; invalid_argument for unknown columns; cancelled; and as all readers. Several threads parse
/// csv, tsv and txt; points and errors do not depend on their number.
DELONE_EXPORT PointTable read_points(const std::string& path, const ReadOptions& options = {},
                                     const Execution& how = {});

/// Writes points: npy, csv, tsv, txt, xyz, pts, off, or qhull, the format of standard output. Throws
/// Errc::not_finite, bad_dimension, invalid_argument, and as all writers.
DELONE_EXPORT void write_points(const std::string& path, const PointTable& points,
                                const std::string& format = {});

/// Writes a table of numbers, which may be infinite or NaN, with its column names: `coordinates` and
/// `column_names` of a PointTable, one row per line.
///   npy          float64 (n,d)
///   csv tsv txt  `nan`, `inf` and `-inf` among the numbers; csv and tsv with a header if there are names;
///                csv is the format of standard output
///   json         {"columns": names, "data": rows}, which pandas.read_json(…, orient="split") reads; null for
///                what is not finite
/// Throws Errc::bad_dimension, invalid_argument, and as all writers.
DELONE_EXPORT void write_table(const std::string& path, const PointTable& table,
                               const std::string& format = {});

/// The contents of a file.
using AnyData = std::variant<ComplexData, HullData, IntersectionData, VoronoiData>;

/// Reads any of these. The member `kind` (in OFF a comment) says which, by the name of a DataKind. If there
/// is none, the names of the arrays tell: an intersection of halfspaces has first_of_halfspace, a diagram
/// ridge_points and point_region, a hull facet_of_cell; everything else is a triangulation of unknown kind.
///   npz   ours; also any .npz of these arrays, and of `points` and `cells` or `simplices`
///   json  the same members; the format of standard input
///   off   OFF, nOFF: a triangulation
/// The shapes of all arrays are checked; check() examines their contents. Throws Errc::bad_format,
/// bad_dimension and not_finite, naming the member; for not_finite rows() names points or halfspaces.
DELONE_EXPORT AnyData read(const std::string& path, const std::string& format = {},
                           std::uint64_t max_stream_bytes = default_max_stream_bytes);

/// As read(). Throws Errc::bad_format, saying what the file holds, if it is of another kind.
template <PlainData Data>
DELONE_EXPORT Data read_as(const std::string& path, const std::string& format = {},
                           std::uint64_t max_stream_bytes = default_max_stream_bytes);

/// Writes a triangulation:
///   npz   points (n,d) float64, cells (m,k+1), neighbors (m,k+1), vertex_of_point (n,), affine_dimension ();
///         stored, readable by numpy.load
///   vtu   k ≤ 3 and d ≤ 3 (padded with zeros): vertices, segments, triangles or tetrahedra, for ParaView
///   off   OFF for d = 3, nOFF otherwise; cells as index lists
///   ply   binary: d ≤ 3; points, segments or triangles; of tetrahedra the boundary, facets without a neighbor,
///         counterclockwise from outside when k = d
///   json  the same members as npz
///   svg   d = 2: a picture
///   txt   Qhull's `i` form: number of cells, then one line of point rows per cell; standard output
///   npy   the cells array only
///   html  a page for a browser: html.hpp
/// Standard output takes the text formats. to_meshio() in Python gives stl, obj, msh and more. Throws
/// Errc::bad_dimension, not_finite; invalid_argument if the arrays disagree; unsupported if the format cannot
/// hold the data; and as all writers.
DELONE_EXPORT void write(const std::string& path, const ComplexData& data, const std::string& format = {});

/// Writes a convex hull (with its points): npz and json hold its arrays, kinds of points as numbers 0 … 3 in
/// the order of PointKind; the other formats of triangulations hold the cells, as a triangulation of
/// dimension k−1. Throws as for those.
DELONE_EXPORT void write(const std::string& path, const HullData& data, const std::string& format = {});

/// Writes an intersection of halfspaces (with its halfspaces):
///   npz   its arrays
///   json  the same members; standard output
///   off   k = d = 3 and bounded: vertices, and facets as polygons
///   html  a page for a browser: html.hpp; invalid_argument without interior points
/// Throws Errc::bad_dimension; invalid_argument if the arrays disagree; and as all writers.
DELONE_EXPORT void write(const std::string& path, const IntersectionData& data,
                         const std::string& format = {});

/// Writes a Voronoi or power diagram:
///   npz   its arrays
///   json  the same members, lists as lists; standard output
/// Throws Errc::bad_dimension; invalid_argument if the arrays disagree; and as all writers.
DELONE_EXPORT void write(const std::string& path, const VoronoiData& data, const std::string& format = {});

/// Writes a diagram, with its ridges, as its arrays (npz, json) or as a picture of its part in a box:
///   svg   d = 2: a picture; the format of standard output is json
///   vtu   d = 2, 3: the regions as polygons or polyhedra, each with its `region` and `point`, for ParaView
///   html  d ≤ 3: a page for a browser: html.hpp
/// `box`: by default bounding_box(). Unbounded regions end at it. npz, json and html store `column_names`.
/// Throws Errc::invalid_argument for a bad box and for a diagram without ridges, and as all writers.
DELONE_EXPORT void write(const std::string& path, const Diagram& diagram, const std::optional<Box>& box = {},
                         const std::string& format = {}, const std::vector<std::string>& column_names = {});

/// Writes the output of Qhull's programs, for programs that parse it: `outputs` lists the names of their
/// output options, separated by commas or blanks, in the order of writing. Numbers have enough digits to read
/// the same double back. Facets are in no particular order.
///   triangulation  qdelaunay Qt (with Qu: furthest-site): o p i Fv Fx Fn FA FS; −1 in Fn is outside the hull
///   hull           qconvex: o n p i Fv Fx Fn FA FS
///   diagram        qvoronoi: o p Fv Fx Fn; −1 in Fn is at infinity; Fv without ridges of fewer than k
///                  vertices, infinity included, as in Qhull: they are unbounded in several directions
///   intersection   qhalf: o p i Fp Fv Fx Fn; bounded, with interior points
/// Throws Errc::invalid_argument for another output; unsupported for regular triangulations, for an
/// intersection that is unbounded, flat or empty, for `i` of facets that are not simplices in 4 dimensions or
/// more, and for diagrams without ridges; and as all writers.
DELONE_EXPORT void write_qhull(const std::string& path, const Triangulation& triangulation,
                               const std::string& outputs);
DELONE_EXPORT void write_qhull(const std::string& path, const ConvexHullBase& hull,
                               const std::string& outputs);
DELONE_EXPORT void write_qhull(const std::string& path, const Diagram& diagram, const std::string& outputs);
DELONE_EXPORT void write_qhull(const std::string& path, const HalfspaceIntersectionBase& intersection,
                               const std::string& outputs);

/// Writes text; errors as for all writers.
DELONE_EXPORT void write_text(const std::string& path, std::string_view text);

/// The file that writing to `path` creates or replaces: the end of a chain of symbolic links, whether or not
/// it exists. Returns `path` itself if the chain has no end.
DELONE_EXPORT std::string write_target(const std::string& path);

}  // namespace delone
