// SPDX-License-Identifier: BSD-3-Clause
// Triangulations of more points than memory holds: a folder of parts, triangulated separately, which together
// are the triangulation of all points.
#pragma once

#include <delone/check.hpp>
#include <delone/complex.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/periodic.hpp>
#include <delone/points.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace delone {

/// The predicted cost of tiles, from a sample and a model: docs/tiles.md.
struct TilesForecast {
  std::int64_t num_points = 0;
  std::size_t num_tiles = 1;
  double cells_per_point = 0;        ///< in a sample
  double foreign_share = 0;          ///< points of other tiles that a tile inserts, divided by its own
  std::uint64_t bytes_per_tile = 0;  ///< memory of a tile at its peak
};

/// How a set is cut into tiles. The triangulation never depends on it; the part of a cell does.
struct TilesOptions {
  /// The most memory to use, in bytes, mapped pages included; 0: three quarters of what is free (2 GiB if the
  /// system does not report it). Includes the program itself and the arrays of the caller.
  std::uint64_t memory = 0;
  /// The number of tiles; 0: as few as the memory allows.
  std::size_t tiles = 0;
  unsigned threads = 1;  ///< as Execution::threads
  /// Whether a column of the input holds weights: the triangulation is then regular.
  bool weighted = false;
  /// The lattice of a periodic set, as of PeriodicDelaunay; without vectors: an open set.
  Lattice lattice;
  double unit = 0;  ///< of a periodic set, as PeriodicOptions::unit
  /// The format of the input: as ReadOptions::format, or raw: little-endian doubles, `columns` of them in a
  /// row; empty: by extension.
  std::string format;
  int columns = 0;
  /// The columns of a file with the coordinates, by names or numbers from 0 as ReadOptions::columns; empty:
  /// all others. `weights` is the column with the weights; empty: the last.
  std::vector<std::string> coordinates;
  std::string weights;
  /// Continue from what an earlier call with the same arguments has left in the folder.
  bool resume = true;
  bool vtu = false;  ///< also write tiles.pvtu and a .vtu per part, d ≤ 3
  /// As Execution::progress.
  std::function<bool(double)> progress = {};
  /// Called once, before the first tile; return false to cancel (Errc::cancelled).
  std::function<bool(const TilesForecast&)> forecast = {};
  /// Called before files of an earlier call are made again because they are damaged or missing, with a line
  /// on each, as "out/part-0002.npz: truncated: 1000 bytes, not 52344"; return false to cancel.
  std::function<bool(const std::vector<std::string>&)> damage = {};
};

/// One part of the folder: a tile and its cost.
struct TilePart {
  std::string file;               ///< within the folder: "part-0000.npz"
  std::int64_t first_cell = 0;    ///< the global id of its first cell
  std::int64_t num_cells = 0;     ///< finite cells of the part
  std::int64_t num_points = 0;    ///< input rows in the tile
  std::int64_t num_vertices = 0;  ///< distinct points of the tile that are not hidden
  std::int64_t num_foreign = 0;   ///< points of other tiles that had to be inserted
  std::int64_t num_rounds = 0;    ///< rounds of questions
  // The sizes in bytes and the checksums, CRC-32 as in zip archives, of the file and of part-0000.seams.npy.
  std::int64_t num_bytes = 0, crc32 = 0, num_seam_bytes = 0, seam_crc32 = 0;
};

/// The contents of a folder of tiles: its index.json.
struct TilesIndex {
  int dimension = 0, affine_dimension = -1;
  bool weighted = false;
  Lattice lattice;  ///< of a periodic set, on its grid
  double unit = 0;  ///< of a periodic set, as PeriodicOptions::unit
  std::int64_t num_points = 0, num_vertices = 0, num_duplicates = 0, num_hidden = 0, num_cells = 0;
  std::int64_t num_hull_facets = 0;
  CanonicalHash hash;  ///< that of the whole triangulation, as Triangulation or PeriodicTriangulation::hash()
  std::vector<TilePart> parts;
};

/// The contents of the file of one part. A cell belongs to the tile of its lexicographically smallest vertex.
///
/// In a periodic set each row has one point, its translate in the box of the lattice: with coefficients in
/// [0, 1) in terms of short vectors that span the same lattice. (For a box along the axes these are the given
/// vectors.) The points of the tile itself come first. Offsets count from these points. Cells also have seams
/// where they meet translates of their own part.
struct TileData {
  int dimension = 0, affine_dimension = -1;
  int rank = 0;                     ///< r: the vectors of the lattice; 0: an open set
  std::vector<std::int64_t> rows;   ///< v: the input row of each point below, the first of equal ones
  std::vector<double> points;       ///< v×d: the vertices of the cells, those of other tiles included
  std::vector<double> weights;      ///< v, or none
  std::vector<std::int32_t> cells;  ///< m×(k+1): numbers of points; positively oriented when k = d
  /// m×(k+1): the cell of this part across the facet opposite each vertex; −1 outside the convex hull; −2 −
  /// s: the cell seams[s] of another part.
  std::vector<std::int32_t> neighbors;
  std::vector<std::int64_t> seams;  ///< global ids of cells
  /// m×(k+1)×r: by how many vectors of the lattice each vertex is translated; 0 for the smallest.
  std::vector<std::int32_t> cell_offsets;
  std::vector<std::int32_t> seam_offsets;   ///< of each seam r: by how many the cell there is translated
  std::vector<std::int64_t> own_rows;       ///< the input rows of the tile, increasing
  std::vector<std::int64_t> vertex_of_row;  ///< for each of them the first equal row; −1: hidden

  std::size_t num_points() const { return rows.size(); }
  std::size_t num_cells() const {
    return affine_dimension < 0 ? 0 : cells.size() / static_cast<std::size_t>(affine_dimension + 1);
  }
};

/// The Delaunay triangulation, or the regular one, of the points of a file, as a folder of parts: the cells
/// and the hash that Delaunay or Regular have in memory, for any number of tiles. The files are the same for
/// every number of threads. After an error, or if the process is killed, finished parts stay, and the same
/// call continues with the remaining tiles. Only one process at a time may work in a folder.
///
/// With `resume` the same call on a finished folder reads all files, and compares them with the sizes and
/// checksums in index.json. Parts and seams that are damaged or missing are made again; the index and all
/// other files stay as they are. Once index.json is there, the folder outlasts a power cut.
///
/// Method: docs/decisions/0016-tiles-are-certified-not-merged.md. Cost: that of the triangulation times about
/// 1 + foreign_share of the forecast, and several times as much from five dimensions on and on hypersurfaces
/// (docs/tiles.md); three passes over the input; scratch files of twice the size of the points.
///
/// Throws as read_points(), Errc::not_finite with rows(); invalid_argument for a folder that holds anything
/// else or tiles of other points; with a lattice as PeriodicDelaunay; bad_format for a damaged index.json,
/// and if a part does not become what it was; out_of_memory if no number of tiles fits; unsupported (vtu for
/// d > 3 or with a lattice, and a lattice of which more than 2^20 translations have to be looked at);
/// cannot_write; cancelled.
DELONE_EXPORT TilesIndex make_tiles(const std::string& input, const std::string& folder,
                                    const TilesOptions& options = {});
/// The same for points in memory: rows of d coordinates, and a weight if `weighted`.
DELONE_EXPORT TilesIndex make_tiles(PointsView rows, const std::string& folder,
                                    const TilesOptions& options = {});

/// The index of a finished folder; its numbers agree with each other. Throws Errc::cannot_open, bad_format.
DELONE_EXPORT TilesIndex read_tiles_index(const std::string& folder);
/// Part number i of a finished folder, with its seams. Throws Errc::invalid_argument if there is no part i,
/// cannot_open, bad_format naming the file, or the array, that is not as index.json says.
DELONE_EXPORT TileData read_tile(const std::string& folder, std::size_t i);

/// A folder of tiles that is not finished: the number of all tiles, and of finished ones.
struct UnfinishedTiles {
  std::size_t num_tiles = 0, num_finished = 0;
};
/// nullopt if the path is not such a folder. Changes nothing.
DELONE_EXPORT std::optional<UnfinishedTiles> find_unfinished_tiles(const std::string& folder);

/// Examines a folder of tiles part by part: the levels of check() for triangulations, seams included. Needs
/// the memory of three parts (at least 64 MiB) and writes scratch files into the folder. CheckReport::cells
/// are global ids, points are rows of the input. Proves that the cells are the Delaunay or regular
/// triangulation of their vertices, that every row is in one part, and that index.json is right. Coordinates
/// of duplicates and hidden points are not in the folder: of these rows nothing else is proved. A part that
/// cannot be read is a violation of level 1. The parts of a periodic set are put together in memory, and
/// examined at the levels of PeriodicTriangulation; too_many beyond 2^31 points or cells. Throws as
/// read_tiles_index(), Errc::invalid_argument as check() and for furthest_site and cells without orientation,
/// cannot_write, out_of_memory.
DELONE_EXPORT CheckReport check_tiles(const std::string& folder, const CheckOptions& options = {},
                                      const Execution& how = {});
/// The same, and at level 6 against the input: rows of d coordinates, and a weight if points have weights.
/// Vertices are these points, and duplicates are equal to their vertices: a triangulation of all points,
/// except that nothing is proved about hidden ones. Also throws Errc::unsupported for a periodic set,
/// bad_dimension, and invalid_argument for another number of points.
DELONE_EXPORT CheckReport check_tiles(const std::string& folder, PointsView input,
                                      const CheckOptions& options = {}, const Execution& how = {});

}  // namespace delone
